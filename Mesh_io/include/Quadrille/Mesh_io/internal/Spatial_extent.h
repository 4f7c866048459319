// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_SPATIAL_EXTENT_H
#define QUADRILLE_MESH_IO_INTERNAL_SPATIAL_EXTENT_H

#include <Quadrille/Labelled_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace Quadrille {
namespace internal {

/// How far z may vary in planar meshes, relative to the extent in x and y: rounding of files with nine digits.
inline constexpr double planarity_tolerance = 1e-9;

/// The bounding box of some points.
struct Spatial_extent {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  void add(const std::array<double, 3>& p)
  {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }

  /// Whether z varies by at most `tolerance` times the extent in x and y; also if there are no points, or some are not
  /// finite.
  bool is_flat(double tolerance) const
  {
    return !(high[2] - low[2] > tolerance * std::max(high[0] - low[0], high[1] - low[1]));
  }
};

/// Whether all points that polygons use lie in a plane z = constant, up to rounding; also if there are none. Linear.
inline bool is_flat(const Labelled_mesh& mesh)
{
  Spatial_extent extent;
  for (const std::vector<int>& polygon : mesh.polygons)
    for (const int v : polygon)
      extent.add(mesh.points[std::size_t(v)]);
  return extent.is_flat(planarity_tolerance);
}

} // namespace internal
} // namespace Quadrille

#endif
