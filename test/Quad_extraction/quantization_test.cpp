// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "extraction_helpers.h"

#include <Quadrille/Greedy_quantizer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

using namespace quad_extraction_test;
using Quadrille::Quad_layout;

namespace {

/// The layout of a rectangle cut into columns and rows of given sizes; only its four corners are critical.
Quad_layout grid_layout(const std::vector<double>& widths, const std::vector<double>& heights)
{
  const int m = static_cast<int>(widths.size());
  const int n = static_cast<int>(heights.size());
  Quad_layout layout;
  layout.strips.resize(widths.size() + heights.size());
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= m; ++i) {
      Quad_layout::Node node;
      node.border = node.constrained = i == 0 || i == m || j == 0 || j == n;
      node.critical = (i == 0 || i == m) && (j == 0 || j == n);
      layout.nodes.push_back(node);
    }
  const auto node = [m](int i, int j) { return j * (m + 1) + i; };
  const auto add_arc = [&layout](int source, int target, double length, int strip, bool border) {
    Quad_layout::Arc arc;
    arc.source = source;
    arc.target = target;
    arc.length = length;
    arc.strip = strip;
    arc.border = border;
    arc.curve = border ? 0 : -1;
    layout.strips[std::size_t(strip)].length = length;
    layout.strips[std::size_t(strip)].arcs.push_back(static_cast<int>(layout.arcs.size()));
    layout.arcs.push_back(arc);
  };
  for (int j = 0; j <= n; ++j) // the border arc above runs to the left: the domain is on its left
    for (int i = 0; i < m; ++i)
      add_arc(node(j < n ? i : i + 1, j), node(j < n ? i + 1 : i, j), widths[std::size_t(i)], i, j == 0 || j == n);
  for (int i = 0; i <= m; ++i)
    for (int j = 0; j < n; ++j)
      add_arc(node(i, i > 0 ? j : j + 1), node(i, i > 0 ? j + 1 : j), heights[std::size_t(j)], m + j, i == 0 || i == m);
  layout.left_patch.assign(2 * layout.arcs.size(), -1);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < m; ++i) {
      const int below = 2 * (j * m + i);
      const int above = 2 * ((j + 1) * m + i) + (j + 1 < n ? 1 : 0);
      const int left = 2 * ((n + 1) * m + i * n + j) + (i > 0 ? 1 : 0);
      const int right = 2 * ((n + 1) * m + (i + 1) * n + j);
      Quad_layout::Patch patch;
      patch.half_arcs = {below, right, above, left};
      for (const int h : patch.half_arcs)
        layout.left_patch[std::size_t(h)] = static_cast<int>(layout.patches.size());
      layout.strips[std::size_t(i)].patches.push_back({static_cast<int>(layout.patches.size()), 0});
      layout.strips[std::size_t(m + j)].patches.push_back({static_cast<int>(layout.patches.size()), 1});
      layout.patches.push_back(patch);
    }
  return layout;
}

std::vector<int> quantize(const Quad_layout& layout)
{
  Quadrille::Strip_constraints constraints(layout);
  return Quadrille::Greedy_quantizer()(layout, constraints);
}

} // namespace

TEST(Greedy_quantizer, thin_strips_share_their_area)
{
  // Rounded one by one, all ten columns would vanish.
  const std::vector<int> length = quantize(grid_layout(std::vector<double>(10, 0.3), {5.0}));
  EXPECT_EQ(std::accumulate(length.begin(), length.begin() + 10, 0), 3);
  EXPECT_EQ(length[10], 5);
}

TEST(Greedy_quantizer, keeps_totals_within_a_unit)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> width(0.05, 2.5);
  for (int run = 0; run < 50; ++run) {
    std::vector<double> widths(12), heights(9);
    for (double& w : widths)
      w = width(random);
    for (double& h : heights)
      h = width(random);
    const std::vector<int> length = quantize(grid_layout(widths, heights));
    const double total = std::accumulate(widths.begin(), widths.end(), 0.0);
    EXPECT_LE(std::abs(std::accumulate(length.begin(), length.begin() + 12, 0) - total), 1.0);
    const double total_height = std::accumulate(heights.begin(), heights.end(), 0.0);
    EXPECT_LE(std::abs(std::accumulate(length.begin() + 12, length.end(), 0) - total_height), 1.0);
  }
}

TEST(Greedy_quantizer, integer_lengths_stay)
{
  const std::vector<int> expected = {1, 4, 2, 7, 3};
  EXPECT_EQ(quantize(grid_layout({1, 4, 2}, {7, 3})), expected);
}

TEST(Strip_constraints, corners_and_opposite_sides_stay_apart)
{
  const Quad_layout single = grid_layout({0.1}, {4.0});
  Quadrille::Strip_constraints constraints(single);
  EXPECT_EQ(constraints.fix(0, 0), 1); // would merge two corners

  const Quad_layout three = grid_layout({0.1, 0.1, 0.1}, {4.0});
  Quadrille::Strip_constraints in_order(three);
  EXPECT_EQ(in_order.fix(0, 0), 0);
  EXPECT_EQ(in_order.fix(2, 0), 0);
  EXPECT_EQ(in_order.fix(1, 0), 1); // the last one keeps the corners apart
}

TEST(Strip_constraints, singularities_stay_apart_and_off_the_border)
{
  Quad_layout layout = grid_layout({1.0, 0.2, 1.0}, {1.0, 0.2, 1.0});
  layout.nodes[5].critical = true; // the four inner nodes are 5, 6, 9, 10
  layout.nodes[6].critical = true;
  {
    Quadrille::Strip_constraints constraints(layout);
    EXPECT_EQ(constraints.fix(1, 0), 1); // 5 and 6
    EXPECT_EQ(constraints.fix(4, 0), 0); // 5 and 9 may merge
  }
  {
    Quadrille::Strip_constraints constraints(layout);
    EXPECT_EQ(constraints.fix(0, 0), 1); // 5 would come to the border
    EXPECT_EQ(constraints.fix(5, 0), 0); // 9 and 10 may
  }
}

TEST(Strip_constraints, least_lengths)
{
  const Quad_layout layout = grid_layout({1.0, 0.2}, {1.0});
  Quadrille::Strip_constraints constraints(layout, 4, {0, 3});
  EXPECT_EQ(constraints.fix(0, 0), 0);
  EXPECT_EQ(constraints.fix(1, 0), 3);
}

TEST(Strip_constraints, holes_keep_four_edges)
{
  const Extracted extracted = extract(annulus(4, 1, 2.2, 3.0).build());
  EXPECT_EQ(extracted.quads.number_of_faces(), 12U);
  Quadrille::Quad_extraction_options options;
  options.min_loop_edges = 6;
  EXPECT_EQ(extract(annulus(4, 1, 2.2, 3.0).build(), options).quads.number_of_faces(), 18U);
}

TEST(Quantizer, lengths_that_break_the_topology_are_refused)
{
  struct All_zero {
    std::vector<int> operator()(const Quad_layout& layout, Quadrille::Strip_constraints&) const
    {
      return std::vector<int>(layout.strips.size(), 0);
    }
  };
  try {
    extract(star(3).build(), {}, All_zero());
    FAIL() << "no error";
  } catch (const Quadrille::No_result_error& error) {
    EXPECT_EQ(error.stage(), "quantization");
  }
}
