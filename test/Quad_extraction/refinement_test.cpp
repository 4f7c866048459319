// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Quad_extraction/internal/refine_patches.h>
#include <Quadrille/exceptions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

using namespace Quadrille::internal::extraction;

namespace {

/// `n` quads, one per 20 degrees, between circles of radii 1 and 2; each three are a patch. More than 18 overlap,
/// though each of them is convex.
Indexed_quads spiral(int n)
{
  Indexed_quads quads;
  const double step = std::acos(-1.0) / 9;
  for (int i = 0; i <= n; ++i)
    for (const double radius : {1.0, 2.0})
      quads.points.emplace_back(radius * std::cos(i * step), radius * std::sin(i * step));
  quads.vertices.resize(quads.points.size());
  for (int i = 0; i < n; ++i) {
    quads.quads.push_back({2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2});
    quads.patch.push_back(i / 3);
    quads.curve_edges.push_back({2 * i + 1, 2 * i + 3, 0, true});
    quads.curve_edges.push_back({2 * i + 2, 2 * i, 1, true});
  }
  quads.curve_edges.push_back({0, 1, 2, true});
  quads.curve_edges.push_back({2 * n + 1, 2 * n, 3, true});
  return quads;
}

} // namespace

TEST(Refine_patches, nothing_where_the_border_is_simple)
{
  const Indexed_quads quads = spiral(17);
  EXPECT_TRUE(Quad_checks(quads).conflicting_border_edges().empty());
  EXPECT_TRUE(too_coarse_patches(quads).empty());
  EXPECT_NO_THROW(Quad_checks(quads).check_geometry());
}

TEST(Refine_patches, finds_the_patches_whose_border_edges_meet)
{
  Indexed_quads quads = spiral(21); // the last three lie on the first three
  for (auto& point : quads.points)  // not quite, to have crossings rather than edges that coincide
    point *= 1 + 0.001 * double(&point - quads.points.data());
  for (const auto& quad : quads.quads)
    ASSERT_TRUE(is_convex(quads.points, quad));
  // The ends, which are parts of sides 1 of the first and the last patch, cross the arcs, and the other way round.
  const std::set<std::pair<int, int>> places = too_coarse_patches(quads);
  EXPECT_FALSE(places.empty());
  for (const auto& place : places)
    EXPECT_TRUE(place.first == 0 || place.first >= 5) << place.first;
  try {
    Quad_checks(quads).check_geometry();
    ADD_FAILURE() << "overlapping quads are taken for good ones";
  } catch (const Quadrille::No_result_error& error) {
    EXPECT_EQ(error.stage(), "mesh");
    EXPECT_NE(std::string(error.what()).find("curve"), std::string::npos);
  }
}

TEST(Refine_patches, inverted_quads_need_more_in_both_directions)
{
  Indexed_quads quads = spiral(12);
  std::swap(quads.points[14], quads.points[15]); // between quads 6 and 7, both in patch 2
  EXPECT_EQ(too_coarse_patches(quads).count({2, 0}), 1u);
  EXPECT_EQ(too_coarse_patches(quads).count({2, 1}), 1u);
}
