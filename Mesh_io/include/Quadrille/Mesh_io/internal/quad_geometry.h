// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_QUAD_GEOMETRY_H
#define QUADRILLE_MESH_IO_INTERNAL_QUAD_GEOMETRY_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Mesh_io/internal/Nearest_tree.h>
#include <Quadrille/Mesh_io/internal/vector_length.h>

#include <cstddef>
#include <vector>

namespace Quadrille {
namespace internal {

inline Space_kernel::Point_3 space_point(const Labelled_mesh& mesh, int v)
{
  return space_point(mesh.points[std::size_t(v)]);
}

/// Twice the area of a polygon's projection along its direction, at its largest; (p2 - p0) x (p3 - p1) for a quad.
inline Space_kernel::Vector_3 doubled_area_vector(const Labelled_mesh& mesh, const std::vector<int>& polygon)
{
  const Space_kernel::Point_3 apex = space_point(mesh, polygon[0]);
  Space_kernel::Vector_3 sum(0, 0, 0);
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += CGAL::cross_product(space_point(mesh, polygon[i - 1]) - apex, space_point(mesh, polygon[i]) - apex);
  return sum;
}

/// The two triangles beside the diagonal from the first corner of a quad.
inline double area_along_diagonal(const Labelled_mesh& mesh, const std::vector<int>& quad)
{
  const Space_kernel::Point_3 apex = space_point(mesh, quad[0]), middle = space_point(mesh, quad[2]);
  const auto doubled_area = [&](int v) {
    return length_of(CGAL::cross_product(middle - apex, space_point(mesh, v) - apex));
  };
  return 0.5 * (doubled_area(quad[1]) + doubled_area(quad[3]));
}

/// Of length 1, or zero.
inline Space_kernel::Vector_3 direction_of(const Space_kernel::Vector_3& v)
{
  const double length = length_of(v);
  return length > 0 ? v / length : Space_kernel::Vector_3(0, 0, 0);
}

} // namespace internal
} // namespace Quadrille

#endif
