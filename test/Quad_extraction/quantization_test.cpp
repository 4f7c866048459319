// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "extraction_helpers.h"
#include "grid_layout.h"

#include <Quadrille/Greedy_quantizer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

using namespace quad_extraction_test;
using Quadrille::Length_constraints;

namespace {

/// Columns, then rows.
std::vector<int> quantize(const std::vector<double>& widths, const std::vector<double>& heights)
{
  const Quad_layout layout = grid_layout(widths, heights);
  Length_constraints constraints(layout);
  const std::vector<int> lengths = Quadrille::Greedy_quantizer()(layout, constraints).lengths;
  std::vector<int> result(lengths.begin(), lengths.begin() + std::ptrdiff_t(widths.size()));
  const auto rows = lengths.begin() + std::ptrdiff_t(widths.size() * (heights.size() + 1));
  result.insert(result.end(), rows, rows + std::ptrdiff_t(heights.size()));
  return result;
}

bool is_admissible(const Quad_layout& layout, const std::vector<int>& columns, const std::vector<int>& rows)
{
  return Length_constraints(layout).learn(grid_lengths(columns, rows));
}

} // namespace

TEST(Greedy_quantizer, thin_strips_share_their_area)
{
  // Rounded one by one, all ten columns would vanish.
  const std::vector<int> length = quantize(std::vector<double>(10, 0.3), {5.0});
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
    const std::vector<int> length = quantize(widths, heights);
    const double total = std::accumulate(widths.begin(), widths.end(), 0.0);
    EXPECT_LE(std::abs(std::accumulate(length.begin(), length.begin() + 12, 0) - total), 1.0);
    const double total_height = std::accumulate(heights.begin(), heights.end(), 0.0);
    EXPECT_LE(std::abs(std::accumulate(length.begin() + 12, length.end(), 0) - total_height), 1.0);
  }
}

TEST(Greedy_quantizer, integer_lengths_stay)
{
  const std::vector<int> expected = {1, 4, 2, 7, 3};
  EXPECT_EQ(quantize({1, 4, 2}, {7, 3}), expected);
}

TEST(Length_constraints, corners_and_opposite_sides_stay_apart)
{
  EXPECT_FALSE(is_admissible(grid_layout({0.1}, {4.0}), {0}, {4})); // would merge two corners
  EXPECT_TRUE(is_admissible(grid_layout({0.1}, {4.0}), {1}, {4}));
  const Quad_layout three = grid_layout({0.1, 0.1, 0.1}, {4.0});
  EXPECT_TRUE(is_admissible(three, {0, 1, 0}, {4}));
  EXPECT_FALSE(is_admissible(three, {0, 0, 0}, {4}));
}

TEST(Length_constraints, singularities_stay_apart_and_off_the_border)
{
  Quad_layout layout = grid_layout({1.0, 0.2, 1.0}, {1.0, 0.2, 1.0});
  layout.nodes[5].critical = true; // the four inner nodes are 5, 6, 9, 10
  layout.nodes[6].critical = true;
  EXPECT_FALSE(is_admissible(layout, {1, 0, 1}, {1, 1, 1})); // 5 and 6
  EXPECT_TRUE(is_admissible(layout, {1, 1, 1}, {1, 0, 1}));  // 5 and 9 may merge
  EXPECT_FALSE(is_admissible(layout, {0, 1, 1}, {1, 1, 1})); // 5 would come to the border
  EXPECT_TRUE(is_admissible(layout, {1, 1, 1}, {1, 1, 0}));  // 9 and 10 may
}

TEST(Length_constraints, learns_what_it_rejects)
{
  // Two singularities at opposite corners of a cell may lose either of its sides, but not both.
  Quad_layout layout = grid_layout({1.0, 0.2, 1.0}, {1.0, 0.2, 1.0});
  layout.nodes[5].critical = true;
  layout.nodes[10].critical = true;
  Length_constraints constraints(layout);
  EXPECT_TRUE(constraints.learn(grid_lengths({1, 0, 1}, {1, 1, 1})));
  EXPECT_TRUE(constraints.learn(grid_lengths({1, 1, 1}, {1, 0, 1})));
  EXPECT_FALSE(constraints.learn(grid_lengths({1, 0, 1}, {1, 0, 1})));
  // The same two beyond each other, three columns apart: found by following the merged nodes.
  Quad_layout wide = grid_layout({1.0, 0.2, 0.2, 0.2, 1.0}, {1.0, 1.0});
  wide.nodes[7].critical = true;
  wide.nodes[10].critical = true;
  Length_constraints learning(wide);
  const std::size_t known = learning.sums().size();
  EXPECT_FALSE(learning.learn(grid_lengths({1, 0, 0, 0, 1}, {1, 1})));
  ASSERT_EQ(learning.sums().size(), known + 1);
  EXPECT_EQ(learning.sums().back().arcs.size(), 3U);
  EXPECT_TRUE(learning.learn(grid_lengths({1, 0, 1, 0, 1}, {1, 1})));
}

TEST(Length_constraints, inconsistent_lengths_are_refused)
{
  const Quad_layout layout = grid_layout({1.0, 2.0}, {1.0});
  std::vector<int> lengths = grid_lengths({1, 2}, {1});
  EXPECT_TRUE(Length_constraints(layout).learn(lengths));
  ++lengths[0];
  EXPECT_FALSE(Length_constraints(layout).learn(lengths));
  lengths[0] = lengths[2] = -1;
  EXPECT_FALSE(Length_constraints(layout).learn(lengths));
}

TEST(Length_constraints, least_lengths)
{
  const Quad_layout layout = grid_layout({1.0, 0.2}, {1.0});
  Length_constraints constraints(layout);
  constraints.require({{1}, 3});
  EXPECT_EQ(Quadrille::Greedy_quantizer()(layout, constraints).lengths, grid_lengths({1, 3}, {1}));
}

TEST(Length_constraints, holes_keep_four_edges)
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
    Quadrille::Quantization operator()(const Quad_layout& layout, Length_constraints&) const
    {
      Quadrille::Quantization result;
      result.lengths.assign(layout.arcs.size(), 0);
      return result;
    }
  };
  try {
    extract(star(3).build(), {}, All_zero());
    FAIL() << "no error";
  } catch (const Quadrille::No_result_error& error) {
    EXPECT_EQ(error.stage(), "quantization");
  }
}
