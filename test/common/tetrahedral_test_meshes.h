// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_COMMON_TETRAHEDRAL_TEST_MESHES_H
#define QUADRILLE_TEST_COMMON_TETRAHEDRAL_TEST_MESHES_H

#include <Quadrille/Tetrahedral_mesh.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

/// n x n x n cubes of the given side, each divided into six tetrahedra around a diagonal; the edges of the whole are
/// features.
inline Quadrille::Tetrahedral_mesh cube_of_tetrahedra(int n, double side = 1)
{
  Quadrille::Tetrahedral_mesh mesh;
  const auto vertex = [n](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        mesh.points.push_back({side * i, side * j, side * k});
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        std::array<int, 8> c;
        for (int m = 0; m < 8; ++m)
          c[std::size_t(m)] = vertex(i + m % 2, j + m / 2 % 2, k + m / 4);
        for (const auto& [p, q] : {std::array{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}})
          mesh.tetrahedra.push_back({c[0], c[std::size_t(p)], c[std::size_t(q)], c[7]});
      }
  for (int i = 0; i < n; ++i)
    for (const int p : {0, n})
      for (const int q : {0, n}) {
        mesh.feature_edges.push_back({vertex(i, p, q), vertex(i + 1, p, q)});
        mesh.feature_edges.push_back({vertex(p, i, q), vertex(p, i + 1, q)});
        mesh.feature_edges.push_back({vertex(p, q, i), vertex(p, q, i + 1)});
      }
  return mesh;
}

inline double volume(const Quadrille::Tetrahedral_mesh& mesh, const std::array<int, 4>& t)
{
  const auto point = [&](std::size_t i) { return mesh.point(std::size_t(t[i])); };
  Eigen::Matrix3d edges;
  edges << point(1) - point(0), point(2) - point(0), point(3) - point(0);
  return edges.determinant() / 6;
}

inline double volume(const Quadrille::Tetrahedral_mesh& mesh)
{
  double sum = 0;
  for (const std::array<int, 4>& t : mesh.tetrahedra)
    sum += volume(mesh, t);
  return sum;
}

/// As a set: the corners of each in ascending order.
template <std::size_t n> std::set<std::array<int, n>> as_set(std::vector<std::array<int, n>> simplices)
{
  for (std::array<int, n>& corners : simplices)
    std::sort(corners.begin(), corners.end());
  return {simplices.begin(), simplices.end()};
}

#endif
