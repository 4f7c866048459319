// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_REFINE_AROUND_SINGULARITIES_H
#define QUADRILLE_TOOLS_REFINE_AROUND_SINGULARITIES_H

#include <Quadrille/Planar_domain.h>
#include <Quadrille/odeco_frame_field.h>

#include <utility>
#include <vector>

namespace Quadrille {

/// What a field on a triangulation is computed from.
struct Field_problem {
  Planar_domain domain;
  std::vector<Edge_frame_constraint> constraints;
  Odeco_field_options options;
};

/// The same problem with triangles half as large within a few layers of triangles around singular vertices; the field
/// with the given gradients is its initial one.
Field_problem
refine_around_singularities(const Planar_domain& domain, const std::vector<Edge_frame_constraint>& constraints,
                            const Odeco_field_options& options, const std::vector<Gradient_pair>& gradients,
                            const std::vector<std::pair<Planar_domain::vertex_descriptor, int>>& singular_vertices);

} // namespace Quadrille

#endif
