// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_COMMON_GRID_LAYOUT_H
#define QUADRILLE_TEST_COMMON_GRID_LAYOUT_H

#include <Quadrille/Quad_extraction/internal/Strip_decomposition.h>

#include <vector>

namespace quad_extraction_test {

using Quadrille::Quad_layout;

/// The layout of a rectangle cut into columns and rows of given sizes; only its four corners are critical.
/// Arc i of the bottom has number i, arc j of the left side number (n + 1) m + j, from below.
inline Quad_layout grid_layout(const std::vector<double>& widths, const std::vector<double>& heights)
{
  const int m = static_cast<int>(widths.size());
  const int n = static_cast<int>(heights.size());
  Quad_layout layout;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= m; ++i) {
      Quad_layout::Node node;
      node.border = node.constrained = i == 0 || i == m || j == 0 || j == n;
      node.critical = (i == 0 || i == m) && (j == 0 || j == n);
      layout.nodes.push_back(node);
    }
  const auto node = [m](int i, int j) { return j * (m + 1) + i; };
  const auto add_arc = [&layout](int source, int target, double length, bool border) {
    Quad_layout::Arc arc;
    arc.source = source;
    arc.target = target;
    arc.length = length;
    arc.border = border;
    arc.curve = border ? 0 : -1;
    layout.arcs.push_back(arc);
  };
  for (int j = 0; j <= n; ++j) // the border arc above runs to the left: the domain is on its left
    for (int i = 0; i < m; ++i)
      add_arc(node(j < n ? i : i + 1, j), node(j < n ? i + 1 : i, j), widths[std::size_t(i)], j == 0 || j == n);
  for (int i = 0; i <= m; ++i)
    for (int j = 0; j < n; ++j)
      add_arc(node(i, i > 0 ? j : j + 1), node(i, i > 0 ? j + 1 : j), heights[std::size_t(j)], i == 0 || i == m);
  layout.left_patch.assign(2 * layout.arcs.size(), -1);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < m; ++i) {
      const int below = 2 * (j * m + i);
      const int above = 2 * ((j + 1) * m + i) + (j + 1 < n ? 1 : 0);
      const int left = 2 * ((n + 1) * m + i * n + j) + (i > 0 ? 1 : 0);
      const int right = 2 * ((n + 1) * m + (i + 1) * n + j);
      Quad_layout::Patch patch;
      patch.sides = {{{below}, {right}, {above}, {left}}};
      for (const int h : {below, right, above, left})
        layout.left_patch[std::size_t(h)] = static_cast<int>(layout.patches.size());
      layout.patches.push_back(patch);
    }
  const auto add_line = [&](int first, int step, int count, std::vector<std::vector<int>>& lines) {
    lines.emplace_back();
    for (int k = 0; k < count; ++k)
      lines.back().push_back(2 * (first + k * step));
  };
  for (int j = 1; j < n; ++j)
    add_line(j * m, 1, m, layout.separatrices);
  for (int i = 1; i < m; ++i)
    add_line((n + 1) * m + i * n, 1, n, layout.separatrices);
  std::vector<std::vector<int>> sides;
  add_line(0, 1, m, sides);
  add_line((n + 1) * m + m * n, 1, n, sides);
  add_line(n * m + m - 1, -1, m, sides);
  add_line((n + 1) * m + n - 1, -1, n, sides);
  for (std::vector<int>& side : sides)
    layout.chains.push_back({std::move(side), false});
  layout.strips = Quadrille::internal::extraction::decompose_into_strips(layout);
  return layout;
}

/// Lengths of all arcs of a grid layout from those of columns and rows.
inline std::vector<int> grid_lengths(const std::vector<int>& columns, const std::vector<int>& rows)
{
  std::vector<int> lengths;
  for (std::size_t j = 0; j <= rows.size(); ++j)
    lengths.insert(lengths.end(), columns.begin(), columns.end());
  for (std::size_t i = 0; i <= columns.size(); ++i)
    lengths.insert(lengths.end(), rows.begin(), rows.end());
  return lengths;
}

} // namespace quad_extraction_test

#endif
