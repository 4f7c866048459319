// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SOLVE_PLANAR_FIELD_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SOLVE_PLANAR_FIELD_H

#include <Quadrille/Frame_edge_constraints.h>
#include <Quadrille/Odeco_field_options.h>
#include <Quadrille/Odeco_frame_field/internal/vertex_restrictions.h>

#include <vector>

namespace Quadrille {
namespace internal {

/// See `odeco_frame_field()`.
Odeco_field_result solve_planar_field(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector2d>& points,
                                      const std::vector<Constrained_halfedge>& edges,
                                      const Odeco_field_options& options, const Field_evaluator& evaluator,
                                      std::vector<Gradient_pair>& gradients);

} // namespace internal
} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Odeco_frame_field/internal/solve_planar_field_impl.h>
#endif

#endif
