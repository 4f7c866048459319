// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SOLVE_PLANAR_FIELD_IMPL_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SOLVE_PLANAR_FIELD_IMPL_H

#include <Quadrille/Odeco_frame_field/internal/Planar_field.h>
#include <Quadrille/Odeco_frame_field/internal/check_field_arguments.h>
#include <Quadrille/Odeco_frame_field/internal/solve_planar_field.h>
#include <Quadrille/Support/internal/separate_compilation.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

QUADRILLE_INLINE Odeco_field_result solve_planar_field(const Indexed_triangulation& mesh,
                                                       const std::vector<Eigen::Vector2d>& points,
                                                       const std::vector<Constrained_halfedge>& edges,
                                                       const Odeco_field_options& options,
                                                       const Field_evaluator& evaluator, Gradients& gradients)
{
  check_field_arguments(edges, options);
  if (!options.target_size.empty() && options.target_size.size() != points.size())
    throw Invalid_argument_error("there are " + std::to_string(options.target_size.size()) + " target sizes for " +
                                 std::to_string(points.size()) + " vertices");
  if (!options.target_metric.empty() && options.target_metric.size() != points.size())
    throw Invalid_argument_error("there are " + std::to_string(options.target_metric.size()) + " target metrics for " +
                                 std::to_string(points.size()) + " vertices");
  if (!options.initial_field.empty() && options.initial_field.size() != points.size())
    throw Invalid_argument_error("the initial field has " + std::to_string(options.initial_field.size()) +
                                 " tensors for " + std::to_string(points.size()) + " vertices");
  if (options.isotropic)
    return Planar_field<3>(mesh, points, edges, options, evaluator).solve(gradients);
  return Planar_field<5>(mesh, points, edges, options, evaluator).solve(gradients);
}

} // namespace internal
} // namespace Quadrille

#endif
