// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_REPAIR_MESH_H
#define QUADRILLE_REPAIR_MESH_H

#include <Quadrille/Labelled_mesh.h>

#include <cstddef>
#include <string>
#include <vector>

namespace Quadrille {

/// What `repair_mesh()` changed.
struct Mesh_repair_report {
  std::size_t merged_points = 0;     ///< with the one at the other side of a crack, or of an edge without length
  std::size_t dropped_triangles = 0; ///< degenerate or repeated
  std::size_t turned_triangles = 0;  ///< corners in the other order

  bool is_unchanged() const { return merged_points + dropped_triangles + turned_triangles == 0; }
  /// In a sentence.
  std::string text() const;
};

/// Makes a manifold surface of polygons that almost are one.
///
/// * Polygons with more than three corners are divided into triangles.
/// * Triangles without a size are dropped: those with an edge below 1e-10 of their longest one by merging its ends,
///   those whose corners lie on a line by giving the middle corner to the triangle on the other side of the longest
///   edge. Of repeated triangles, one is kept.
/// * Cracks are closed: two border edges whose ends are the same up to 1e-6 of the diagonal of the bounding box (and a
///   tenth of the edges' length) become one, which has the ends of the one that comes first. Where three or more such
///   edges meet, which of them belong together is not known, and they stay.
/// * The triangles of every component that can be oriented are oriented consistently: closed ones outwards, others as
///   the majority is. Components that are consistent stay as they are.
///
/// Points keep their numbers; labels of polygons and lines go along. Nothing else is repaired: `make_surface_domain()`
/// tells what is left. Polygons that cannot be divided, and all polygons if a point does not exist or is not finite,
/// are returned as they are.
/// Complexity: O(n log n), for each layer of flat triangles on top of each other.
Labelled_mesh repair_mesh(const Labelled_mesh& mesh, Mesh_repair_report& report);

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/repair_mesh_impl.h>
#endif

#endif
