// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_TANGENT_GEOMETRY_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_TANGENT_GEOMETRY_H

#include <Quadrille/Support/internal/Indexed_triangulation.h>
#include <Quadrille/exceptions.h>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

inline constexpr double quarter_turn = 1.57079632679489661923;

inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// What the algorithms of this package know of a surface: every face's edges as vectors of the face's own orthonormal
/// tangent basis, and how these bases turn from face to face. A planar domain is the case of one global basis.
struct Tangent_geometry {
  /// By halfedge: from its source to its target, in the basis of its face.
  std::vector<Eigen::Vector2d> edge_vector;
  /// By halfedge h: what to add to the angle of a direction in the basis of h's face to have its angle in the basis of
  /// the face on the other side. Empty where all faces share one basis.
  std::vector<double> transport;

  const Eigen::Vector2d& edge(int h) const { return edge_vector[std::size_t(h)]; }
  double transport_angle(int h) const { return transport.empty() ? 0.0 : transport[std::size_t(h)]; }
  double area(int f) const { return 0.5 * cross(edge(3 * f), edge(3 * f + 1)); }
  /// The angle of corner h: from halfedge h counterclockwise to the previous edge of its face.
  double corner_angle(int h) const
  {
    const Eigen::Vector2d second = -edge(Indexed_triangulation::prev(h));
    return std::atan2(cross(edge(h), second), edge(h).dot(second));
  }
  /// The gradient of the hat function of corner h in its face.
  Eigen::Vector2d hat_gradient(int h) const
  {
    const Eigen::Vector2d& opposite = edge(Indexed_triangulation::next(h));
    return Eigen::Vector2d(-opposite.y(), opposite.x()) / (2.0 * area(h / 3));
  }
};

/// \throws Invalid_input_error if a coordinate is not finite or a triangle is degenerate or inverted.
inline void check_geometry(const Tangent_geometry& geometry)
{
  for (std::size_t f = 0; 3 * f < geometry.edge_vector.size(); ++f) {
    const double area = geometry.area(int(f));
    if (!std::isfinite(area))
      throw Invalid_input_error("triangle " + std::to_string(f) + " has a coordinate that is not a finite number");
    if (!(area > 0.0))
      throw Invalid_input_error("triangle " + std::to_string(f) +
                                " is degenerate or inverted; all triangles must be oriented counterclockwise");
  }
}

/// \throws Invalid_input_error as `check_geometry`.
inline Tangent_geometry planar_geometry(const Indexed_triangulation& triangulation,
                                        const std::vector<Eigen::Vector2d>& points)
{
  Tangent_geometry geometry;
  geometry.edge_vector.reserve(std::size_t(triangulation.number_of_halfedges()));
  for (int h = 0; h < triangulation.number_of_halfedges(); ++h)
    geometry.edge_vector.push_back(points[std::size_t(triangulation.target(h))] -
                                   points[std::size_t(triangulation.source(h))]);
  check_geometry(geometry);
  return geometry;
}

/// The two gradients (du, dv) of a face, in the basis of the face.
using Gradient_pair = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

/// The length of halfedge h in coordinates that have these gradients in its face.
inline double mapped_length(const Tangent_geometry& geometry, int h, const Gradient_pair& gradients)
{
  return std::hypot(gradients.first.dot(geometry.edge(h)), gradients.second.dot(geometry.edge(h)));
}

/// R^k p for any integer k, R the rotation by +90 degrees. Exact.
inline Eigen::Vector2d rotate_quarters(const Eigen::Vector2d& p, int k)
{
  switch (k & 3) {
  case 0:
    return p;
  case 1:
    return {-p.y(), p.x()};
  case 2:
    return -p;
  default:
    return {p.y(), -p.x()};
  }
}

/// R^k applied to a pair of gradients: the gradients of the turned coordinates R^k (u, v).
inline Gradient_pair rotate_quarters(const Gradient_pair& gradients, int k)
{
  const Eigen::Vector2d& du = gradients.first;
  const Eigen::Vector2d& dv = gradients.second;
  switch (k & 3) {
  case 0:
    return {du, dv};
  case 1:
    return {-dv, du};
  case 2:
    return {-du, -dv};
  default:
    return {dv, -du};
  }
}

} // namespace internal
} // namespace Quadrille

#endif
