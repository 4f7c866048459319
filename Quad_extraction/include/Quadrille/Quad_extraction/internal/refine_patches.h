// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_REFINE_PATCHES_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_REFINE_PATCHES_H

#include <Quadrille/Length_constraints.h>
#include <Quadrille/Quad_extraction/internal/Quad_checks.h>
#include <Quadrille/Quad_layout.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Where straight-sided quads are too coarse for the domain: patches and the direction (0, 1: along sides 0, 1) in
/// which they need more of them. In both if a quad is inverted, along the border if edges of the border meet.
inline std::set<std::pair<int, int>> too_coarse_patches(const Indexed_quads& quads)
{
  std::set<std::pair<int, int>> result;
  std::set<std::pair<int, int>> crossing;
  for (const int e : Quad_checks(quads).conflicting_border_edges())
    crossing.insert({at(quads.curve_edges, e).source, at(quads.curve_edges, e).target});
  for (int q = 0; q < size_of(quads.quads); ++q) {
    const std::array<int, 4>& quad = at(quads.quads, q);
    const int patch = at(quads.patch, q);
    for (int i = 0; i < 4 && !crossing.empty(); ++i)
      if (crossing.count({at(quad, i), at(quad, (i + 1) % 4)}))
        result.insert({patch, i % 2});
    if (!is_convex(quads.points, quad))
      result.insert({{patch, 0}, {patch, 1}});
  }
  return result;
}

/// Asks for half as many quads again, at least one, in the patches that are too coarse. Returns false if none is.
inline bool refine_patches(const Indexed_quads& quads, const Quad_layout& layout, const std::vector<int>& lengths,
                           Length_constraints& constraints)
{
  const std::set<std::pair<int, int>> places = too_coarse_patches(quads);
  for (const auto& [patch, direction] : places) {
    std::vector<int> arcs = arcs_of(at(at(layout.patches, patch).sides, direction));
    const int n = static_cast<int>(sum_of(arcs, lengths));
    constraints.require({std::move(arcs), n + std::max(1, n / 2)});
  }
  return !places.empty();
}

} // namespace internal::extraction
} // namespace Quadrille

#endif
