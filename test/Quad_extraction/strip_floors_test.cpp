// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "grid_layout.h"

#include <Quadrille/Greedy_quantizer.h>
#include <Quadrille/Quad_extraction/internal/Strip_floors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

using namespace quad_extraction_test;
using Quadrille::Greedy_quantizer;
using Quadrille::Length_constraints;
using Quadrille::Quad_layout;
using Quadrille::internal::extraction::Strip_floors;

namespace {

using Times = std::vector<std::vector<std::pair<int, int>>>; // by strip: conditions, and how often it counts there

std::vector<int> met(const std::vector<int>& width, const Times& times, std::size_t n_conditions)
{
  std::vector<int> sums(n_conditions, 0);
  for (std::size_t s = 0; s < width.size(); ++s)
    for (const auto& [condition, n] : times[s])
      sums[std::size_t(condition)] += n * width[s];
  return sums;
}

} // namespace

TEST(Strip_floors, the_cheapest_per_condition)
{
  // One strip that meets both conditions is cheaper than two, but dearer than each of them.
  const Times times{{{0, 1}}, {{1, 1}}, {{0, 1}, {1, 1}}};
  for (const double shared : {1.5, 2.5}) {
    const std::vector<double> prices{1, 1, shared};
    const std::vector<int> floors =
        Strip_floors({1, 1}, times).run({0, 0, 0}, [&prices](int s, int) { return prices[std::size_t(s)]; });
    EXPECT_EQ(floors, shared < 2 ? std::vector<int>({0, 0, 1}) : std::vector<int>({1, 1, 0}));
  }
}

TEST(Strip_floors, meets_conditions_with_nothing_to_spare)
{
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const std::size_t n_strips = 1 + random() % 12;
    const std::size_t n_conditions = 1 + random() % 8;
    Times times(n_strips);
    std::vector<int> bounds, wanted;
    for (std::size_t c = 0; c < n_conditions; ++c) {
      bounds.push_back(1 + int(random() % 4));
      times[random() % n_strips].emplace_back(int(c), 1 + int(random() % 2));
      const std::size_t other = random() % n_strips;
      if (times[other].empty() || times[other].back().first != int(c))
        times[other].emplace_back(int(c), 1);
    }
    std::vector<double> prices;
    for (std::size_t s = 0; s < n_strips; ++s) {
      wanted.push_back(int(random() % 3));
      prices.push_back(double(random() % 100));
    }
    std::vector<int> floors =
        Strip_floors(bounds, times).run(wanted, [&prices](int s, int width) { return prices[std::size_t(s)] + width; });
    const auto is_met = [&] {
      const std::vector<int> sums = met(floors, times, n_conditions);
      for (std::size_t c = 0; c < n_conditions; ++c)
        if (sums[c] < bounds[c])
          return false;
      return true;
    };
    EXPECT_TRUE(is_met());
    for (int& floor : floors) {
      ASSERT_GE(floor, 0);
      if (floor == 0)
        continue;
      --floor;
      EXPECT_FALSE(is_met());
      ++floor;
    }
  }
}

TEST(Greedy, the_cheapest_strip_meets_a_condition)
{
  // A narrow column of height 2 or a low row of width 20 has to stay. To let the column vanish is cheapest at first.
  const Quad_layout layout = grid_layout({10, 0.1, 10}, {0.2, 1.8});
  const int column = 1, row = 9;
  Length_constraints constraints(layout);
  constraints.require({{column, row}});
  const std::vector<int> lengths = Greedy_quantizer()(layout, constraints).lengths;
  EXPECT_EQ(lengths, grid_lengths({10, 1, 10}, {0, 2}));
}
