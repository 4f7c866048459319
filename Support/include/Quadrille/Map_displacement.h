// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MAP_DISPLACEMENT_H
#define QUADRILLE_MAP_DISPLACEMENT_H

#include <array>
#include <optional>
#include <vector>

namespace Quadrille {

/// How far apart two corners of a triangulation are to be in a seamless map, along a certain path between them.
///
/// Indices are plain integers: triangle f, in the order of `faces(mesh)`, has the halfedges 3 f, 3 f + 1 and 3 f + 2,
/// beginning with `halfedge(f, mesh)`, and the corner of the vertex that a halfedge leaves has the halfedge's index.
struct Map_displacement {
  int source_corner = -1;
  int target_corner = -1;
  /// In this order, from the triangle of the source to that of the target; each belongs to the triangle that is left.
  std::vector<int> crossed_halfedges;
  /// (u, v) of the target minus (u, v) of the source, continued across the halfedges into the chart of the target's
  /// triangle; empty for a coordinate that is free.
  std::array<std::optional<int>, 2> value;
};

} // namespace Quadrille

#endif
