// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_REFINE_PATCHES_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_REFINE_PATCHES_H

#include <Quadrille/Length_constraints.h>
#include <Quadrille/Quad_extraction/internal/Quad_checks.h>
#include <Quadrille/Quad_layout.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Edges of quads that are too long for the domain: all four of an inverted quad, and edges of the border that meet.
template <int D>
std::set<std::pair<int, int>> too_coarse_edges(const Indexed_quads<D>& quads, const std::vector<char>& is_inverted)
{
  std::set<std::pair<int, int>> result; // quad, number of its edge
  std::set<std::pair<int, int>> crossing;
  for (const int e : Quad_checks<D>(quads).conflicting_border_edges())
    crossing.insert({at(quads.curve_edges, e).source, at(quads.curve_edges, e).target});
  for (int q = 0; q < size_of(quads.quads); ++q) {
    const std::array<int, 4>& quad = at(quads.quads, q);
    const bool inverted = at(is_inverted, q) != 0;
    for (int i = 0; i < 4 && (inverted || !crossing.empty()); ++i)
      if (inverted || crossing.count({at(quad, i), at(quad, (i + 1) % 4)}))
        result.insert({q, i});
  }
  return result;
}

/// The half-arc on a side of `patch` that holds edge `i` of the quad in column `column` and row `row`, or -1 if the
/// edge is inside.
inline int half_arc_of_edge(const Quad_layout::Patch& patch, const std::vector<int>& lengths, int column, int row,
                            int n_columns, int n_rows, int i)
{
  const std::array<int, 4> distance = {row, n_columns - 1 - column, n_rows - 1 - row, column}; // from the side
  const std::array<int, 4> place = {column, row, n_columns - 1 - column, n_rows - 1 - row};    // along it
  if (at(distance, i) > 0)
    return -1;
  int end = 0;
  for (const int h : at(patch.sides, i)) {
    end += at(lengths, h / 2);
    if (at(place, i) < end)
      return h;
  }
  return -1;
}

/// Asks for half as many quads again, at least one, where edges are too long: on the arcs that they are parts of, or
/// along the patches that they are inside of. `is_inverted` by quad. Returns the number of such places.
///
/// It has to be that arc: a patch would add them elsewhere on its side, and an edge that joins two fixed vertices would
/// stay.
template <int D>
std::size_t refine_patches(const Indexed_quads<D>& quads, const std::vector<char>& is_inverted,
                           const Quad_layout& layout, const std::vector<int>& lengths, Length_constraints& constraints)
{
  std::set<std::vector<int>> places;
  std::vector<int> first_quad(layout.patches.size(), -1);
  for (int q = size_of(quads.quads); q-- > 0;)
    at(first_quad, at(quads.patch, q)) = q;
  for (const auto& [q, i] : too_coarse_edges(quads, is_inverted)) {
    const Quad_layout::Patch& patch = at(layout.patches, at(quads.patch, q));
    const int n_columns = static_cast<int>(sum_of(arcs_of(patch.sides[0]), lengths));
    const int n_rows = static_cast<int>(sum_of(arcs_of(patch.sides[1]), lengths));
    const int number = q - at(first_quad, at(quads.patch, q));
    const int h = half_arc_of_edge(patch, lengths, number % n_columns, number / n_columns, n_columns, n_rows, i);
    places.insert(h < 0 ? arcs_of(at(patch.sides, i % 2)) : std::vector<int>{h / 2});
  }
  for (const std::vector<int>& arcs : places) {
    const int n = static_cast<int>(sum_of(arcs, lengths));
    constraints.require({arcs, n + std::max(1, n / 2)});
  }
  return places.size();
}

} // namespace internal::extraction
} // namespace Quadrille

#endif
