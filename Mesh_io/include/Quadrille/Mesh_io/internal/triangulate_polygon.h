// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_TRIANGULATE_POLYGON_H
#define QUADRILLE_MESH_IO_INTERNAL_TRIANGULATE_POLYGON_H

#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

namespace Quadrille {
namespace internal {

/// Divides a polygon in space, which need not be plane, into triangles of its corners, oriented as it is: those that
/// are flattest together. Empty if there are none.
template <class Point> std::vector<std::array<int, 3>> triangulate_polygon(const std::vector<Point>& outline)
{
  std::vector<CGAL::Triple<int, int, int>> found;
  CGAL::Polygon_mesh_processing::triangulate_hole_polyline(outline, std::back_inserter(found));
  std::vector<std::array<int, 3>> triangles;
  if (found.size() + 2 != outline.size())
    return triangles;
  for (const auto& t : found) {
    triangles.push_back({t.first, t.second, t.third});
    std::sort(triangles.back().begin(), triangles.back().end()); // in the order around the polygon
  }
  return triangles;
}

} // namespace internal
} // namespace Quadrille

#endif
