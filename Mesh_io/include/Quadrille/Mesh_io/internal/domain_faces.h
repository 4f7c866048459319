// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_DOMAIN_FACES_H
#define QUADRILLE_MESH_IO_INTERNAL_DOMAIN_FACES_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/exceptions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

/// Fills an empty `Surface_mesh`; indices stay as they are. \throws Invalid_input_error if the faces are not manifold.
template <class Point, class Mesh>
void add_faces(const std::vector<Point>& points, const std::vector<std::array<int, 3>>& triangles,
               const std::string& source, Mesh& mesh)
{
  using Vertex = typename Mesh::Vertex_index;
  using Size = typename Mesh::size_type;
  mesh.reserve(Size(points.size()), Size(points.size() + triangles.size()), Size(triangles.size()));
  for (const Point& point : points)
    mesh.add_vertex(point);
  const auto vertex = [](int v) { return Vertex(Size(v)); };
  for (const std::array<int, 3>& t : triangles)
    if (mesh.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2])) == Mesh::null_face())
      throw Invalid_input_error(source + ": the triangles around point " + std::to_string(t[0]) +
                                " do not form a manifold");
}

/// The region of each polygon; unlabelled ones are in a region of their own. `regions` become those of the input, and
/// that one.
inline std::vector<int> regions_of_faces(const Labelled_mesh& input, std::vector<Entity_label>& regions)
{
  std::vector<int> region_of_face(input.polygons.size(), -1);
  std::copy(input.polygon_region.begin(), input.polygon_region.end(), region_of_face.begin());
  regions = input.regions;
  int tag = 0;
  for (const Entity_label& label : input.regions)
    tag = std::max(tag, label.tag);
  for (int& region : region_of_face)
    if (region < 0) {
      if (regions.size() == input.regions.size())
        regions.push_back({tag + 1, {}});
      region = int(regions.size()) - 1;
    }
  return region_of_face;
}

} // namespace internal
} // namespace Quadrille

#endif
