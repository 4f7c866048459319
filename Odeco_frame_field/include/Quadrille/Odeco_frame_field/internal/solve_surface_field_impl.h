// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SOLVE_SURFACE_FIELD_IMPL_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SOLVE_SURFACE_FIELD_IMPL_H

#include <Quadrille/Odeco_frame_field/internal/Surface_field.h>
#include <Quadrille/Odeco_frame_field/internal/check_field_arguments.h>
#include <Quadrille/Odeco_frame_field/internal/solve_surface_field.h>
#include <Quadrille/Support/internal/separate_compilation.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

/// Where the surface is given: rounded coordinates would hide what is degenerate.
inline void check_surface(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector3d>& points)
{
  for (std::size_t v = 0; v < points.size(); ++v)
    if (!points[v].allFinite())
      throw Invalid_input_error("vertex " + std::to_string(v) + " has a coordinate that is not a finite number");
  for (int f = 0; f < mesh.number_of_faces(); ++f) {
    const auto& t = mesh.triangle(f);
    const Eigen::Vector3d a = points[std::size_t(t[1])] - points[std::size_t(t[0])],
                          b = points[std::size_t(t[2])] - points[std::size_t(t[0])];
    const double rounding = 1e-14;
    if (!(twice_area(a, b) > rounding * std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()})))
      throw Invalid_input_error("triangle " + std::to_string(f) + " has no area; remove it, or move its corners apart");
  }
}

QUADRILLE_INLINE Surface_field_result solve_surface_field(const Indexed_triangulation& mesh,
                                                          const std::vector<Eigen::Vector3d>& points,
                                                          const std::vector<Constrained_halfedge>& edges,
                                                          const Surface_field_options& options,
                                                          const Field_evaluator& evaluator, Gradients& gradients)
{
  if (mesh.number_of_faces() == 0)
    throw Invalid_input_error("the surface has no triangles");
  check_prescribed_sizes(edges, options.isotropic);
  check_target_sizes(options.target_size, options.target_size_weight);
  check_schedule(options.schedule, options.starts, options.threads);
  if (!options.target_size.empty() && options.target_size.size() != points.size())
    throw Invalid_argument_error("there are " + std::to_string(options.target_size.size()) + " target sizes for " +
                                 std::to_string(points.size()) + " vertices");
  if (!(options.typical_size >= 0) || !std::isfinite(options.typical_size))
    throw Invalid_argument_error("the typical size must be positive and finite (0 lets it be chosen)");
  for (const double weight : {options.weights.odeco, options.weights.area, options.weights.angle, options.weak_weight})
    if (!(weight >= 0) || !std::isfinite(weight))
      throw Invalid_argument_error("the weights of energies must not be negative");
  check_surface(mesh, points);
  if (options.isotropic)
    return Surface_field<3>(mesh, points, edges, options, evaluator).solve(gradients);
  return Surface_field<5>(mesh, points, edges, options, evaluator).solve(gradients);
}

} // namespace internal
} // namespace Quadrille

#endif
