// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "extraction_helpers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace quad_extraction_test;
using Quadrille::Layout_kind;
using Quadrille::Quad_layout;

namespace {

double length(const Quad_layout& layout, const std::vector<int>& half_arcs)
{
  return std::accumulate(half_arcs.begin(), half_arcs.end(), 0.0,
                         [&](double sum, int h) { return sum + layout.arc_of(h).length; });
}

double map_area(const Mapped_mesh& mesh)
{
  double area = 0;
  for (std::size_t h = 0; h < mesh.corner_uv.size(); h += 3) {
    const Point &a = mesh.corner_uv[h], &b = mesh.corner_uv[h + 1], &c = mesh.corner_uv[h + 2];
    area += ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  }
  return area;
}

void expect_valid(const Traced& traced, const Mapped_mesh& mesh)
{
  const Quad_layout& layout = traced.layout;
  EXPECT_EQ(euler_characteristic(layout), traced.triangulation.euler_characteristic());
  double area = 0;
  for (const Quad_layout::Patch& patch : layout.patches) {
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_FALSE(patch.sides[i].empty());
      for (std::size_t k = 0; k + 1 < patch.sides[i].size(); ++k)
        EXPECT_EQ(layout.target(patch.sides[i][k]), layout.source(patch.sides[i][k + 1]));
      EXPECT_EQ(layout.target(patch.sides[i].back()), layout.source(patch.sides[(i + 1) % 4].front()));
    }
    EXPECT_EQ(length(layout, patch.sides[0]), length(layout, patch.sides[2]));
    EXPECT_EQ(length(layout, patch.sides[1]), length(layout, patch.sides[3]));
    area += length(layout, patch.sides[0]) * length(layout, patch.sides[1]);
  }
  EXPECT_NEAR(area, map_area(mesh), 1e-9 * area);
  // Strips add up to the arcs, exactly.
  std::vector<double> sum(layout.arcs.size(), 0);
  for (const Quad_layout::Strip& strip : layout.strips)
    for (const int a : strip.arcs)
      sum[std::size_t(a)] += strip.length;
  for (std::size_t a = 0; a < sum.size(); ++a)
    EXPECT_EQ(sum[a], layout.arcs[a].length);
}

/// A ring of `turns` layers of `count` cells that wind outwards: after one turn each layer goes on as the next one. The
/// separatrix along the layers winds from the inside to the outside.
Glued_rectangles snail(int count, int turns, double angular_length, double radial_length)
{
  Glued_rectangles result;
  const double pi = std::acos(-1.0);
  for (int s = 0; s <= count * turns + count; ++s) {
    const double radius = 1 + 0.5 * double(s) / double(count * turns);
    result.corners.push_back({radius * std::cos(2 * pi * s / count), radius * std::sin(2 * pi * s / count)});
  }
  for (int s = 0; s < count * turns; ++s)
    result.cells.push_back({s, s + count, s + count + 1, s + 1});
  result.length = [=](int a, int b) { return std::abs(a - b) == 1 ? angular_length / count : radial_length; };
  result.subdivisions = 1;
  return result;
}

} // namespace

TEST(T_mesh, equals_the_base_complex_where_nothing_crosses)
{
  for (const int valence : {3, 5, 6}) {
    const Mapped_mesh mesh = star(valence).build();
    const Traced traced(mesh, Layout_kind::t_mesh);
    expect_valid(traced, mesh);
    EXPECT_EQ(traced.layout.patches.size(), std::size_t(valence));
    EXPECT_EQ(traced.layout.arcs.size(), Traced(mesh).layout.arcs.size());
  }
}

TEST(T_mesh, the_later_one_stops)
{
  // Two concave corners, at opposite corners of a small cell: of the two pairs of separatrices that cross, each has one
  // that is stopped, instead of 7 patches there are 5.
  Glued_rectangles domain = cell_grid(3, 3, [](int i, int j) { return (i != 0 || j != 0) && (i != 2 || j != 2); });
  domain.length = [](int a, int b) { return std::abs(a - b) == 1 && std::min(a, b) % 4 == 1 ? 0.5 : 3.0; };
  for (unsigned seed = 1; seed < 30; ++seed) { // whatever the triangulation
    domain.seed = seed;
    domain.subdivisions = 1 + int(seed % 6);
    domain.jitter = seed % 2 ? 0.3 : 0;
    const Mapped_mesh mesh = domain.build();
    const Traced traced(mesh, Layout_kind::t_mesh);
    expect_valid(traced, mesh);
    EXPECT_EQ(traced.layout.patches.size(), 5U) << seed;
    double longest = 0;
    for (const auto& separatrix : traced.layout.separatrices)
      longest = std::max(longest, length(traced.layout, separatrix));
    EXPECT_EQ(longest, 3.5);
  }
}

TEST(T_mesh, ends_on_both_sides_of_an_isoline_in_one_point)
{
  // Separatrices from concave corners at the left above and below; a third one from a change of curves between them
  // comes first.
  Glued_rectangles domain = cell_grid(2, 4, [](int i, int j) { return i > 0 || (j != 0 && j != 3); });
  domain.length = [](int a, int b) { return std::abs(a - b) == 1 ? 1.0 : 2.0; };
  domain.curve = [](int a, int b, bool border) {
    return !border ? -1 : a % 3 == 0 && b % 3 == 0 && a + b > 12 ? 1 : 0;
  };
  for (const int subdivisions : {1, 2, 5}) {
    domain.subdivisions = subdivisions;
    const Mapped_mesh mesh = domain.build();
    const Traced traced(mesh, Layout_kind::t_mesh);
    expect_valid(traced, mesh);
    EXPECT_EQ(traced.layout.nodes.size(), 13U);
    EXPECT_EQ(traced.layout.patches.size(), 6U);
  }
}

TEST(T_mesh, ends_on_both_sides_of_a_feature_in_one_point)
{
  Glued_rectangles domain = cell_grid(3, 4, [](int i, int j) { return i > 0 || (j != 0 && j != 3); });
  domain.curve = [](int a, int b, bool border) { return border ? 0 : a / 4 == 2 && b / 4 == 2 ? 1 : -1; };
  for (const int subdivisions : {1, 2, 5}) {
    domain.subdivisions = subdivisions;
    const Mapped_mesh mesh = domain.build();
    const Traced traced(mesh, Layout_kind::t_mesh);
    expect_valid(traced, mesh);
    EXPECT_EQ(std::count_if(traced.layout.nodes.begin(), traced.layout.nodes.end(),
                            [](const Quad_layout::Node& node) { return node.constrained && !node.border; }),
              1);
    Quadrille::Quad_extraction_options options;
    options.layout = Layout_kind::t_mesh;
    EXPECT_TRUE(has_convex_quads(extract(mesh, options).quads));
  }
}

TEST(T_mesh, every_side_of_a_closed_feature_gets_a_corner)
{
  Glued_rectangles domain = annulus(4, 2, 9.1, 1.6);
  domain.curve = [](int a, int b, bool border) { return border || (a / 4 == 1 && b / 4 == 1) ? 1 + a / 4 : -1; };
  const Mapped_mesh mesh = domain.build();
  const Traced traced(mesh, Layout_kind::t_mesh);
  expect_valid(traced, mesh);
  EXPECT_EQ(traced.layout.patches.size(), 3U); // the cut from the feature goes both ways
}

TEST(T_mesh, random_domains)
{
  std::size_t t_patches = 0, patches = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const Mapped_mesh mesh = random_domain(seed).build();
    const Traced traced(mesh, Layout_kind::t_mesh);
    expect_valid(traced, mesh);
    t_patches += traced.layout.patches.size();
    patches += Traced(mesh).layout.patches.size();
  }
  EXPECT_LT(t_patches, patches);
}

TEST(T_mesh, long_spirals_are_cut_off)
{
  const Mapped_mesh mesh = snail(12, 60, 30.0, 0.1).build();
  constexpr std::size_t max_steps = 500; // a turn crosses 24 triangles, the whole spiral 1,440
  EXPECT_THROW(Traced(mesh, Layout_kind::base_complex, max_steps), Quadrille::No_result_error);
  const Traced traced(mesh, Layout_kind::t_mesh, max_steps);
  expect_valid(traced, mesh);
  EXPECT_LE(traced.layout.patches.size(), 5U);
  EXPECT_GE(Traced(mesh).layout.patches.size(), 60U);

  Quadrille::Quad_extraction_options options;
  options.layout = Layout_kind::t_mesh;
  options.max_trace_steps = max_steps;
  const Extracted extracted = extract(mesh, options);
  EXPECT_TRUE(has_convex_quads(extracted.quads));
  EXPECT_EQ(euler_characteristic(extracted.quads), 0);
  EXPECT_NEAR(double(extracted.quads.number_of_faces()), 30 * 6, 12);
}
