// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Quad_extraction/internal/refine_patches.h>
#include <Quadrille/exceptions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

using namespace Quadrille::internal::extraction;

namespace {

/// `n` quads, one per 20 degrees, between circles of radii 1 and 2; each three are a patch. More than 18 overlap,
/// though each of them is convex.
Indexed_quads<2> spiral(int n)
{
  Indexed_quads<2> quads;
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

std::vector<char> inverted(const Indexed_quads<2>& quads) { return inverted_quads(quads, Quad_ground<2>()); }

} // namespace

TEST(Refine_patches, nothing_where_the_border_is_simple)
{
  const Indexed_quads<2> quads = spiral(17);
  EXPECT_TRUE(Quad_checks<2>(quads).conflicting_border_edges().empty());
  EXPECT_TRUE(too_coarse_edges(quads, inverted(quads)).empty());
  EXPECT_NO_THROW(Quad_checks<2>(quads).check_geometry(inverted(quads)));
}

TEST(Refine_patches, finds_the_border_edges_that_meet)
{
  Indexed_quads<2> quads = spiral(21); // the last three lie on the first three
  for (auto& point : quads.points)     // not quite, to have crossings rather than edges that coincide
    point *= 1 + 0.001 * double(&point - quads.points.data());
  for (const auto& quad : quads.quads)
    ASSERT_TRUE(is_convex(quads.points, quad));
  // The ends cross the arcs, and the other way round.
  const std::set<std::pair<int, int>> edges = too_coarse_edges(quads, inverted(quads));
  EXPECT_FALSE(edges.empty());
  for (const auto& edge : edges)
    EXPECT_TRUE(edge.first < 3 || edge.first >= 15) << edge.first;
  try {
    Quad_checks<2>(quads).check_geometry(inverted(quads));
    ADD_FAILURE() << "overlapping quads are taken for good ones";
  } catch (const Quadrille::No_result_error& error) {
    EXPECT_EQ(error.stage(), "mesh");
    EXPECT_NE(std::string(error.what()).find("curve"), std::string::npos);
  }
}

TEST(Refine_patches, all_edges_of_inverted_quads_are_too_long)
{
  Indexed_quads<2> quads = spiral(12);
  std::swap(quads.points[14], quads.points[15]); // between quads 6 and 7
  const std::set<std::pair<int, int>> edges = too_coarse_edges(quads, inverted(quads));
  EXPECT_EQ(edges.size(), 8u);
  for (int i = 0; i < 4; ++i)
    EXPECT_EQ(edges.count({6, i}) + edges.count({7, i}), 2u);
}

// A patch of 4 x 2 quads whose first side consists of arcs of 3 and 1 quads. Of the quad in the corner between sides 0
// and 1, two edges are parts of arcs, which have to grow themselves, and two are inside.
TEST(Refine_patches, asks_for_more_on_the_arcs_that_edges_are_parts_of)
{
  Quadrille::Quad_layout layout;
  layout.nodes.resize(5);
  for (const auto& [source, target] : {std::pair(0, 1), {1, 2}, {2, 3}, {3, 4}, {4, 0}}) {
    layout.arcs.emplace_back();
    layout.arcs.back().source = source;
    layout.arcs.back().target = target;
  }
  layout.patches.emplace_back();
  layout.patches.front().sides = {{{0, 2}, {4}, {6}, {8}}};
  layout.left_patch = {0, -1, 0, -1, 0, -1, 0, -1, 0, -1};
  const std::vector<int> lengths = {3, 1, 2, 4, 2};
  Indexed_quads<2> quads;
  for (int j = 0; j <= 2; ++j)
    for (int i = 0; i <= 4; ++i)
      quads.points.emplace_back(i, j);
  quads.vertices.resize(quads.points.size());
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 4; ++i) {
      quads.quads.push_back({5 * j + i, 5 * j + i + 1, 5 * j + i + 6, 5 * j + i + 5});
      quads.patch.push_back(0);
    }
  const auto asked_for = [&] {
    Quadrille::Length_constraints constraints(layout);
    const std::size_t n = constraints.sums().size();
    refine_patches(quads, inverted(quads), layout, lengths, constraints);
    std::map<std::vector<int>, int> least;
    for (std::size_t i = n; i < constraints.sums().size(); ++i)
      least[constraints.sums()[i].arcs] = constraints.sums()[i].least;
    return least;
  };
  EXPECT_TRUE(asked_for().empty());
  quads.points[4] = {2.9, 0.9}; // of the corner quad only
  const std::map<std::vector<int>, int> expected = {{{1}, 2}, {{2}, 3}, {{0, 1}, 6}};
  EXPECT_EQ(asked_for(), expected);
}
