// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_MESH_IO_QUAD_TEST_MESHES_H
#define QUADRILLE_TEST_MESH_IO_QUAD_TEST_MESHES_H

#include <Quadrille/Labelled_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

namespace Quadrille {

inline Labelled_mesh quads(const std::vector<std::array<double, 3>>& points,
                           const std::vector<std::vector<int>>& polygons)
{
  Labelled_mesh mesh;
  mesh.points = points;
  mesh.polygons = polygons;
  mesh.polygon_region.assign(polygons.size(), -1);
  return mesh;
}

/// The surface of [-1, 1]^3 in n x n quads per side, normals outwards.
inline Labelled_mesh cube_of_quads(int n)
{
  Labelled_mesh mesh;
  std::map<std::array<int, 3>, int> index;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          std::vector<int> quad;
          for (const auto& [a, b] : {std::array{0, 0}, std::array{1, 0}, std::array{1, 1}, std::array{0, 1}}) {
            std::array<int, 3> steps;
            steps[axis] = side;
            steps[(axis + 1) % 3] = i + (side > 0 ? a : b);
            steps[(axis + 2) % 3] = j + (side > 0 ? b : a);
            const auto [place, is_new] = index.emplace(steps, int(mesh.points.size()));
            if (is_new)
              mesh.points.push_back({2.0 * steps[0] / n - 1, 2.0 * steps[1] / n - 1, 2.0 * steps[2] / n - 1});
            quad.push_back(place->second);
          }
          mesh.polygons.push_back(quad);
        }
  mesh.polygon_region.assign(mesh.polygons.size(), -1);
  return mesh;
}

/// The same on the unit sphere.
inline Labelled_mesh sphere_of_quads(int n)
{
  Labelled_mesh mesh = cube_of_quads(n);
  for (std::array<double, 3>& p : mesh.points) {
    const double norm = std::hypot(p[0], p[1], p[2]);
    p = {p[0] / norm, p[1] / norm, p[2] / norm};
  }
  return mesh;
}

/// Every point p becomes factor p + shift.
inline Labelled_mesh scaled(Labelled_mesh mesh, double factor, const std::array<double, 3>& shift = {0, 0, 0})
{
  for (std::array<double, 3>& p : mesh.points)
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = factor * p[k] + shift[k];
  return mesh;
}

inline Labelled_mesh turned_over(Labelled_mesh mesh)
{
  for (std::vector<int>& polygon : mesh.polygons)
    std::reverse(polygon.begin(), polygon.end());
  return mesh;
}

} // namespace Quadrille

#endif
