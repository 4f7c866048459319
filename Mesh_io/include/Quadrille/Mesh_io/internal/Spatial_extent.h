// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_SPATIAL_EXTENT_H
#define QUADRILLE_MESH_IO_INTERNAL_SPATIAL_EXTENT_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace Quadrille {
namespace internal {

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

} // namespace internal
} // namespace Quadrille

#endif
