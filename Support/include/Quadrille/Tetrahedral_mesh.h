// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TETRAHEDRAL_MESH_H
#define QUADRILLE_TETRAHEDRAL_MESH_H

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace Quadrille {

/// A tetrahedral mesh by indices: what readers fill, and a model of the concept `TetrahedralMesh`.
///
/// Nothing is promised about the tetrahedra; `check_tetrahedral_mesh()` examines them.
struct Tetrahedral_mesh {
  std::vector<std::array<double, 3>> points;
  /// Corners a, b, c, d with (b - a) x (c - a) . (d - a) > 0.
  std::vector<std::array<int, 4>> tetrahedra;
  /// Edges that the file marks as lying on curves of the model, each once, in no particular order.
  std::vector<std::array<int, 2>> feature_edges;

  std::size_t number_of_vertices() const { return points.size(); }
  std::size_t number_of_tetrahedra() const { return tetrahedra.size(); }
  Eigen::Vector3d point(std::size_t v) const { return Eigen::Vector3d::Map(points[v].data()); }
  const std::array<int, 4>& tetrahedron(std::size_t t) const { return tetrahedra[t]; }
};

} // namespace Quadrille

#endif
