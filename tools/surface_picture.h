// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_SURFACE_PICTURE_H
#define QUADRILLE_TOOLS_SURFACE_PICTURE_H

#include <Eigen/Core>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {

/// A triangulated surface and what is drawn on it; all but points and triangles may be empty.
struct Surface_drawing {
  using Triangle = std::array<int, 3>;

  std::vector<std::array<double, 3>> points;
  std::vector<Triangle> triangles; ///< oriented alike
  std::vector<std::array<int, 2>> feature_edges;
  std::vector<std::array<int, 2>> mesh_edges; ///< thin lines
  /// By triangle, the two vectors of its frame, tangent and as long as elements should be.
  std::vector<std::array<Eigen::Vector3d, 2>> frames;
  std::vector<std::pair<int, int>> singular_vertices; ///< with their valences
  std::vector<std::array<Eigen::Vector2d, 3>> uv;     ///< by triangle and corner
  double isoline_spacing = 1;                         ///< in u and v
  Eigen::Vector3d toward_viewer = {0.45, -0.8, 0.4};  ///< not vertical
};

/// A picture as SVG text, without perspective: shaded triangles (back sides only of surfaces with boundary, bluish),
/// feature edges in black, crosses along the frames from blue (small) to red (large) on a selection of triangles that
/// are spread evenly, isolines of u (orange) and v (green) at multiples of the spacing, and dots at singular vertices
/// (red: valence 3, blue: valence 5, violet: others). What other parts of the surface hide is left out. Above 200,000
/// triangles in view these are not shaded.
std::string surface_picture(const Surface_drawing& drawing);

} // namespace Quadrille

#endif
