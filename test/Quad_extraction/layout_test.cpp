// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "extraction_helpers.h"
#include "planar_test_meshes.h"

#include <Quadrille/Quad_extraction/internal/Layout_builder.h>
#include <Quadrille/Quad_extraction/internal/Layout_geometry.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace quad_extraction_test;
using Quadrille::Quad_layout;

namespace {

struct Counts {
  std::size_t nodes, arcs, patches, strips;
};

void expect_counts(const Glued_rectangles& domain, const Counts& expected)
{
  for (const double jitter : {0.0, 0.25})
    for (const int subdivisions : {1, 3, 8}) {
      Glued_rectangles varied = domain;
      varied.jitter = jitter;
      varied.subdivisions = subdivisions;
      const Traced traced(varied.build());
      const Quad_layout& layout = traced.layout;
      EXPECT_EQ(layout.nodes.size(), expected.nodes);
      EXPECT_EQ(layout.arcs.size(), expected.arcs);
      EXPECT_EQ(layout.patches.size(), expected.patches);
      EXPECT_EQ(layout.strips.size(), expected.strips);
      EXPECT_EQ(euler_characteristic(layout), traced.triangulation.euler_characteristic());
      for (const Quad_layout::Patch& patch : layout.patches)
        for (std::size_t i = 0; i < 4; ++i) {
          ASSERT_EQ(patch.sides[i].size(), 1U);
          EXPECT_EQ(layout.target(patch.sides[i][0]), layout.source(patch.sides[(i + 1) % 4][0]));
          EXPECT_EQ(layout.arc_of(patch.sides[i][0]).length, layout.arc_of(patch.sides[(i + 2) % 4][0]).length);
        }
    }
}

int count_quadrants(const Quad_layout& layout, int quadrants, bool border)
{
  return static_cast<int>(std::count_if(layout.nodes.begin(), layout.nodes.end(), [=](const Quad_layout::Node& node) {
    return node.quadrants == quadrants && node.border == border;
  }));
}

} // namespace

TEST(Layout, square_is_one_patch)
{
  expect_counts(cell_grid(1, 1), {4, 4, 1, 2});
  expect_counts(cell_grid(3, 2), {4, 4, 1, 2});
}

TEST(Layout, singularities_of_valence_3_and_5)
{
  expect_counts(star(3), {7, 9, 3, 3});
  expect_counts(star(5), {11, 15, 5, 5});
  expect_counts(star(6), {13, 18, 6, 6});
  const Traced traced(star(5).build());
  EXPECT_EQ(count_quadrants(traced.layout, 5, false), 1);
  EXPECT_EQ(count_quadrants(traced.layout, 1, true), 5);
}

TEST(Layout, concave_corners)
{
  expect_counts(cell_grid(2, 2, [](int i, int j) { return i == 0 || j == 0; }), {8, 10, 3, 4});
  expect_counts(cell_grid(3, 3, [](int i, int j) { return i != 1 || j != 1; }), {16, 24, 8, 8});
}

TEST(Layout, annulus_gets_a_cut)
{
  expect_counts(annulus(5, 1, 12.3, 2.7), {2, 3, 1, 2});
  const Traced traced(annulus(4, 1, 6.283185, 2.7).build());
  ASSERT_EQ(traced.layout.strips.size(), 2U);
  EXPECT_NEAR(traced.layout.strips[0].length + traced.layout.strips[1].length, 6.283185 + 2.7, 1e-7);
}

TEST(Layout, closed_feature_without_corners)
{
  Glued_rectangles domain = annulus(4, 2, 9.1, 1.6);
  domain.curve = [](int a, int b, bool border) { return border || (a / 4 == 1 && b / 4 == 1) ? 1 + a / 4 : -1; };
  expect_counts(domain, {3, 5, 2, 3});
}

TEST(Layout, feature_across_the_domain_separates_regions)
{
  Glued_rectangles domain = cell_grid(2, 1);
  domain.curve = [](int a, int b, bool border) { return border ? 0 : a % 3 == 1 && b % 3 == 1 ? 7 : -1; };
  domain.region = [](int cell) { return 10 + cell; };
  expect_counts(domain, {6, 7, 2, 3});
  const Traced traced(domain.build());
  EXPECT_NE(traced.layout.patches[0].region, traced.layout.patches[1].region);
  EXPECT_EQ(std::count_if(traced.layout.arcs.begin(), traced.layout.arcs.end(),
                          [](const Quad_layout::Arc& arc) { return arc.curve == 7; }),
            1);
}

TEST(Layout, features_end_meet_and_turn)
{
  Glued_rectangles dead_end = cell_grid(2, 2);
  dead_end.curve = [](int a, int b, bool border) { return border ? 0 : std::max(a, b) == 4 && a + b == 5 ? 1 : -1; };
  expect_counts(dead_end, {9, 12, 4, 4});

  Glued_rectangles junction = cell_grid(2, 2);
  junction.curve = [](int a, int b, bool border) {
    return border ? 0 : a + b == 5 || a + b == 11 || a + b == 7 ? 1 : -1;
  };
  expect_counts(junction, {9, 12, 4, 4});

  Glued_rectangles box = cell_grid(3, 3);
  box.curve = [](int a, int b, bool border) {
    const auto inner = [](int c) { return c == 5 || c == 6 || c == 9 || c == 10; };
    return border ? 0 : inner(a) && inner(b) ? 1 : -1;
  };
  expect_counts(box, {16, 24, 9, 6});
}

TEST(Layout, change_of_curve_is_a_node)
{
  Glued_rectangles domain = cell_grid(2, 1);
  domain.curve = [](int a, int b, bool border) { return border ? (a + b == 1 ? 3 : 4) : -1; };
  expect_counts(domain, {6, 7, 2, 3});
}

TEST(Layout, separatrices_that_just_miss_cross)
{
  // Two concave corners on opposite sides whose separatrices run side by side.
  Glued_rectangles domain = cell_grid(3, 3, [](int i, int j) { return (i != 0 || j != 0) && (i != 2 || j != 2); });
  domain.length = [](int a, int b) { return std::abs(a - b) == 1 && (std::min(a, b) % 4) == 1 ? 0.1234 : 3.0; };
  expect_counts(domain, {14, 20, 7, 6});
}

TEST(Layout, symmetric_domain_has_symmetric_layout)
{
  Glued_rectangles domain = cell_grid(3, 3, [](int i, int j) { return i != 1 || j != 1; });
  domain.length = [](int, int) { return 2.2; };
  domain.jitter = 0;
  const Mapped_mesh mesh = domain.build();
  const Traced traced(mesh);
  std::vector<Eigen::Vector2d> points;
  for (const Point& p : mesh.points)
    points.emplace_back(p[0] - 1.5, p[1] - 1.5);
  const Quadrille::internal::extraction::Layout_geometry<2> geometry(traced.map, points, traced.layout);
  for (const Quad_layout::Node& node : traced.layout.nodes) {
    const Eigen::Vector2d p = geometry.point(node.point);
    const Eigen::Vector2d turned(-p.y(), p.x());
    EXPECT_TRUE(
        std::any_of(traced.layout.nodes.begin(), traced.layout.nodes.end(), [&](const Quad_layout::Node& other) {
          return (geometry.point(other.point) - turned).norm() < 1e-12;
        }));
  }
}

TEST(Layout, crossings_do_not_depend_on_the_triangulation)
{
  Glued_rectangles domain = cell_grid(3, 3, [](int i, int j) { return (i != 0 || j != 0) && (i != 2 || j != 2); });
  for (unsigned seed = 1; seed < 40; ++seed) {
    domain.seed = seed;
    domain.subdivisions = 2 + int(seed % 5);
    domain.jitter = 0.3;
    EXPECT_EQ(Traced(domain.build()).layout.patches.size(), 7U) << "seed " << seed;
  }
}

// Rectangles with rectangular holes at random places and the identity as map: separatrices cross triangles anywhere.
TEST(Layout, random_rectangular_holes)
{
  std::mt19937 random(11);
  const auto uniform = [&random](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  for (int run = 0; run < 25; ++run) {
    std::vector<std::vector<Eigen::Vector2d>> polygons;
    const auto add_rectangle = [&polygons](double x0, double y0, double x1, double y1) {
      polygons.push_back({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
    };
    add_rectangle(0, 0, 9, 6);
    int holes = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 2; ++j)
        if (random() % 4) {
          const double x = 3 * i + uniform(0.2, 1.2), y = 3 * j + uniform(0.2, 1.2);
          add_rectangle(x, y, x + uniform(0.3, 1.5), y + uniform(0.3, 1.5));
          ++holes;
        }
    const Quadrille::test::Planar_mesh mesh = Quadrille::test::delaunay_mesh(polygons, uniform(0.3, 1.5));
    Mapped_mesh mapped;
    for (const Eigen::Vector2d& p : mesh.points)
      mapped.points.push_back({p.x(), p.y()});
    mapped.triangles = mesh.triangles;
    mapped.region.assign(mesh.triangles.size(), 0);
    const Quadrille::internal::Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
    for (int h = 0; h < triangulation.number_of_halfedges(); ++h) {
      const Point& p = mapped.points[std::size_t(triangulation.source(h))];
      mapped.corner_uv.push_back({snapped(p[0]), snapped(p[1])});
      mapped.curve.push_back(triangulation.is_boundary(h) ? 0 : -1);
    }
    const Traced traced(mapped);
    EXPECT_EQ(euler_characteristic(traced.layout), 1 - holes);
    EXPECT_EQ(count_quadrants(traced.layout, 1, true), 4);
    EXPECT_EQ(count_quadrants(traced.layout, 3, true), 4 * holes);
    // All patches together cover the domain.
    double area = 54, covered = 0;
    for (std::size_t i = 1; i < polygons.size(); ++i)
      area -= (polygons[i][1].x() - polygons[i][0].x()) * (polygons[i][2].y() - polygons[i][1].y());
    for (const Quad_layout::Patch& patch : traced.layout.patches)
      covered += traced.layout.arc_of(patch.sides[0][0]).length * traced.layout.arc_of(patch.sides[1][0]).length;
    EXPECT_NEAR(covered, area, 1e-6);
  }
}

TEST(Layout, long_separatrix_is_an_error)
{
  Glued_rectangles domain = star(5);
  domain.subdivisions = 6;
  try {
    Traced traced(domain.build(), Quadrille::Layout_kind::base_complex, 3);
    FAIL() << "no error";
  } catch (const Quadrille::No_result_error& error) {
    EXPECT_EQ(error.stage(), "layout");
    EXPECT_NE(std::string(error.what()).find("vertex 0"), std::string::npos);
  }
}

TEST(Seamless_map, rejects_what_is_not_seamless)
{
  const Mapped_mesh good = star(3).build();
  Mapped_mesh torn = good;
  for (std::size_t h = 0; h < torn.corner_uv.size(); ++h)
    if (torn.curve[h] < 0)
      torn.corner_uv[h][0] += std::ldexp(1.0, -30);
  EXPECT_THROW(Traced traced(torn), Quadrille::Invalid_input_error);

  Mapped_mesh fine = good;
  for (Point& uv : fine.corner_uv)
    uv = {uv[0] / 3, uv[1] / 3};
  EXPECT_THROW(Traced traced(fine), Quadrille::Invalid_input_error);

  Mapped_mesh infinite = good;
  infinite.corner_uv[5][1] = std::nan("");
  EXPECT_THROW(Traced traced(infinite), Quadrille::Invalid_input_error);
}

TEST(Seamless_map, rejects_flipped_triangles_by_name)
{
  Glued_rectangles domain = cell_grid(1, 1);
  domain.jitter = 0;
  Mapped_mesh mesh = domain.build();
  std::vector<std::size_t> of_vertex;
  for (std::size_t h = 0; h < mesh.corner_uv.size(); ++h) {
    const Point& p = mesh.points[std::size_t(mesh.triangles[h / 3][h % 3])];
    if (std::abs(p[0] - 0.5) < 1e-9 && std::abs(p[1] - 0.5) < 1e-9)
      of_vertex.push_back(h);
  }
  ASSERT_FALSE(of_vertex.empty());
  for (const std::size_t h : of_vertex)
    mesh.corner_uv[h] = {3.5, 3.5};
  try {
    Traced traced(mesh);
    FAIL() << "no error";
  } catch (const Quadrille::No_result_error& error) {
    EXPECT_EQ(error.stage(), "map");
    EXPECT_NE(std::string(error.what()).find("triangle"), std::string::npos);
  }
}

TEST(Seamless_map, rejects_unaligned_and_unnamed_curves)
{
  Mapped_mesh unnamed = cell_grid(1, 1).build();
  std::fill(unnamed.curve.begin(), unnamed.curve.end(), -1);
  EXPECT_THROW(Traced traced(unnamed), Quadrille::Invalid_input_error);

  Mapped_mesh diagonal = cell_grid(1, 1).build();
  const Quadrille::internal::Indexed_triangulation triangulation(diagonal.points.size(), diagonal.triangles);
  for (int h = 0; h < triangulation.number_of_halfedges(); ++h)
    if (!triangulation.is_boundary(h))
      diagonal.curve[std::size_t(h)] = 5;
  EXPECT_THROW(Traced traced(diagonal), Quadrille::Invalid_input_error);

  Mapped_mesh regions = cell_grid(2, 1).build();
  for (std::size_t f = 0; f < regions.region.size(); ++f)
    regions.region[f] = f < regions.region.size() / 2 ? 1 : 2;
  EXPECT_THROW(Traced traced(regions), Quadrille::Invalid_input_error);
}
