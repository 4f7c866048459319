// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_LOCAL_TRIANGLE_SIZES_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_LOCAL_TRIANGLE_SIZES_H

#include <Quadrille/Support/internal/Indexed_triangulation.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

/// Twice the area of a triangle given by two of its edges; signed in the plane.
inline double twice_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
inline double twice_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.cross(b).norm(); }

/// The edge length of an equilateral triangle of the face's area, averaged once over the neighbours.
template <class Point>
std::vector<double> local_triangle_sizes(const Indexed_triangulation& mesh, const std::vector<Point>& points)
{
  const auto n = std::size_t(mesh.number_of_faces());
  std::vector<double> size(n), smoothed(n);
  for (std::size_t f = 0; f < n; ++f) {
    const auto& t = mesh.triangle(int(f));
    const Point& apex = points[std::size_t(t[0])];
    const Point a = points[std::size_t(t[1])] - apex, b = points[std::size_t(t[2])] - apex;
    const double area = 0.5 * twice_area(a, b);
    if (!(area > 0))
      throw Invalid_input_error("triangle " + std::to_string(f) +
                                " has no area or is clockwise; the mesh must be counterclockwise and not degenerate");
    size[f] = std::sqrt(4 / std::sqrt(3.0) * area);
  }
  for (std::size_t f = 0; f < n; ++f) {
    double sum = size[f];
    int count = 1;
    for (int i = 0; i < 3; ++i)
      if (const int g = mesh.opposite(int(3 * f) + i); g >= 0) {
        sum += size[std::size_t(g / 3)];
        ++count;
      }
    smoothed[f] = sum / count;
  }
  return smoothed;
}

} // namespace internal
} // namespace Quadrille

#endif
