// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "extraction_helpers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

using namespace quad_extraction_test;

namespace {

void expect_valid(const Extracted& extracted, int euler)
{
  const Mesh& quads = extracted.quads;
  EXPECT_TRUE(CGAL::is_valid_polygon_mesh(quads));
  EXPECT_TRUE(has_convex_quads(quads));
  EXPECT_EQ(euler_characteristic(quads), euler);
  std::size_t border = 0;
  for (const auto e : quads.edges())
    border += quads.is_border(e) ? 1 : 0;
  std::size_t border_on_curves = 0;
  for (const auto& edge : extracted.result.curve_edges) {
    const auto h = quads.halfedge(Mesh::Vertex_index(unsigned(edge.source)), Mesh::Vertex_index(unsigned(edge.target)));
    ASSERT_NE(h, Mesh::null_halfedge());
    EXPECT_EQ(quads.is_border(quads.edge(h)), edge.border);
    EXPECT_FALSE(quads.is_border(h)); // the domain is on the left
    border_on_curves += edge.border ? 1 : 0;
  }
  EXPECT_EQ(border_on_curves, border);
  std::map<int, int> irregular;
  for (const auto v : quads.vertices())
    if (!quads.is_border(v) && quads.degree(v) != 4)
      ++irregular[int(quads.degree(v))];
  EXPECT_EQ(irregular, extracted.result.irregular_vertices);
}

/// A valence-5 star, each spoke with its own length.
Glued_rectangles uneven_star()
{
  Glued_rectangles result = star(5);
  result.length = [](int a, int b) {
    const auto spoke = [](int s) { return 2.3 + 0.71 * (s / 2); };
    if (std::min(a, b) == 0)
      return spoke(std::max(a, b));
    const int odd = a % 2 ? a : b;
    const int even = a % 2 ? b : a;
    const int first = even - 1;
    return spoke(odd == first ? 1 + even % 10 : first); // the rim edge is opposite to the cell's other spoke
  };
  return result;
}

} // namespace

TEST(Extract_quads, rectangle)
{
  Glued_rectangles domain = cell_grid(1, 1);
  domain.length = [](int a, int b) { return std::abs(a - b) == 1 ? 6.8 : 3.3; };
  domain.curve = [](int a, int b, bool) { return a + b; };
  const Extracted extracted = extract(domain.build());
  expect_valid(extracted, 1);
  EXPECT_EQ(extracted.quads.number_of_faces(), 21U);
  EXPECT_NEAR(extracted.result.area_change_relative, 21 / (6.8 * 3.3) - 1, 1e-6);
  EXPECT_TRUE(extracted.result.irregular_vertices.empty());
  std::map<int, int> edges_on;
  for (const auto& edge : extracted.result.curve_edges)
    ++edges_on[edge.curve];
  EXPECT_EQ(edges_on, (std::map<int, int>{{1, 7}, {2, 3}, {4, 3}, {5, 7}}));
  for (const auto v : extracted.quads.vertices()) {
    // The map is linear: the quads are the uniform grid.
    const Point_2& p = extracted.quads.point(v);
    EXPECT_NEAR(7 * p.x(), std::round(7 * p.x()), 1e-6);
    EXPECT_NEAR(3 * p.y(), std::round(3 * p.y()), 1e-6);
  }
}

TEST(Extract_quads, vertices_know_where_they_come_from)
{
  const Mapped_mesh mesh = cell_grid(1, 1).build();
  const Extracted extracted = extract(mesh);
  int corners = 0;
  for (const auto v : extracted.quads.vertices()) {
    const auto& origin = extracted.result.vertices[v.idx()];
    if (origin.input_vertex >= 0) {
      ++corners;
      const Point& p = mesh.points[std::size_t(origin.input_vertex)];
      EXPECT_EQ(extracted.quads.point(v), Point_2(p[0], p[1]));
    } else {
      EXPECT_EQ(origin.curve >= 0, extracted.quads.is_border(v));
    }
  }
  EXPECT_EQ(corners, 4);
}

TEST(Extract_quads, singularities)
{
  const Extracted three = extract(star(3).build());
  expect_valid(three, 1);
  EXPECT_EQ(three.result.irregular_vertices, (std::map<int, int>{{3, 1}}));
  EXPECT_EQ(three.quads.number_of_faces(), 40U); // lengths 3, 4, 4 of 3.7: the area is preserved best
  const Extracted five = extract(uneven_star().build());
  expect_valid(five, 1);
  EXPECT_EQ(five.result.irregular_vertices, (std::map<int, int>{{5, 1}}));
}

TEST(Extract_quads, concave_corners_and_holes)
{
  const Extracted l_shape = extract(cell_grid(2, 2, [](int i, int j) { return i == 0 || j == 0; }).build());
  expect_valid(l_shape, 1);
  const Extracted ring = extract(cell_grid(3, 3, [](int i, int j) { return i != 1 || j != 1; }).build());
  expect_valid(ring, 0);
  const Extracted round = extract(annulus(12, 1, 21.3, 3.1).build());
  expect_valid(round, 0);
  EXPECT_EQ(round.quads.number_of_faces(), 63U);
}

TEST(Extract_quads, thin_strip_between_two_corners_collapses)
{
  Glued_rectangles domain = cell_grid(3, 3, [](int i, int j) { return (i != 0 || j != 0) && (i != 2 || j != 2); });
  domain.length = [](int a, int b) { return std::abs(a - b) == 1 && std::min(a, b) % 4 == 1 ? 0.2 : 3.0; };
  Quadrille::Quad_extraction_options options;
  options.layout = Quadrille::Layout_kind::base_complex;
  const Extracted extracted = extract(domain.build(), options);
  expect_valid(extracted, 1);
  EXPECT_EQ(extracted.result.collapsed_arcs, 4);
  EXPECT_EQ(extracted.quads.number_of_faces(), 36U);
}

TEST(Extract_quads, features_and_regions)
{
  Glued_rectangles domain = cell_grid(2, 2);
  domain.curve = [](int a, int b, bool border) {
    return border ? 0 : a + b == 5 || a + b == 11 ? 1 : a + b == 7 ? 2 : -1;
  };
  domain.region = [](int cell) { return cell == 0 ? 100 : cell == 2 ? 102 : 101; };
  const Extracted extracted = extract(domain.build());
  expect_valid(extracted, 1);
  std::map<int, int> quads_in, edges_on;
  for (const int region : extracted.result.quad_regions)
    ++quads_in[region];
  for (const auto& edge : extracted.result.curve_edges)
    ++edges_on[edge.curve];
  EXPECT_EQ(quads_in, (std::map<int, int>{{100, 16}, {101, 32}, {102, 16}}));
  EXPECT_EQ(edges_on, (std::map<int, int>{{0, 32}, {1, 8}, {2, 4}}));
  // The features are straight and stay where they are.
  for (const auto& edge : extracted.result.curve_edges) {
    const Point_2& p = extracted.quads.point(Mesh::Vertex_index(unsigned(edge.source)));
    if (edge.curve == 1) {
      EXPECT_NEAR(p.x(), 1, 1e-12);
    } else if (edge.curve == 2) {
      EXPECT_NEAR(p.y(), 1, 1e-12);
    }
  }
  for (std::size_t q = 0; q < extracted.result.quad_regions.size(); ++q) {
    const auto f = Mesh::Face_index(unsigned(q));
    double x = 0, y = 0;
    for (const auto v : extracted.quads.vertices_around_face(extracted.quads.halfedge(f))) {
      x += extracted.quads.point(v).x() / 4;
      y += extracted.quads.point(v).y() / 4;
    }
    EXPECT_EQ(extracted.result.quad_regions[q], x > 1 ? 101 : y > 1 ? 102 : 100);
  }
}

TEST(Extract_quads, kinks_of_a_curve_are_kept)
{
  // Between two cells of the star the border turns by 27 degrees in the plane, but not in the map.
  const Mapped_mesh mesh = star(3).build();
  const auto corners = [&mesh](double kink_degrees) {
    Quadrille::Quad_extraction_options options;
    options.kink_degrees = kink_degrees;
    const Extracted extracted = extract(mesh, options);
    expect_valid(extracted, 1);
    return std::count_if(extracted.result.vertices.begin(), extracted.result.vertices.end(),
                         [](const auto& origin) { return origin.input_vertex >= 0; });
  };
  EXPECT_EQ(corners(30), 3);
  EXPECT_EQ(corners(20), 6);
}

TEST(Extract_quads, scale_and_rotation)
{
  const Extracted reference = extract(uneven_star().build());
  for (const double scale : {1e8, 1e-8}) {
    Mapped_mesh mesh = uneven_star().build();
    mesh.scale_and_rotate(scale, 0.3);
    const Extracted moved = extract(mesh);
    expect_valid(moved, 1);
    ASSERT_EQ(moved.quads.number_of_vertices(), reference.quads.number_of_vertices());
    for (const auto v : reference.quads.vertices()) {
      const Point_2& p = reference.quads.point(v);
      const double c = scale * std::cos(0.3), s = scale * std::sin(0.3);
      EXPECT_NEAR(moved.quads.point(v).x(), c * p.x() - s * p.y(), 1e-4 * scale);
      EXPECT_NEAR(moved.quads.point(v).y(), s * p.x() + c * p.y(), 1e-4 * scale);
    }
  }
}

TEST(Extract_quads, does_not_depend_on_threads)
{
  Glued_rectangles domain = uneven_star();
  domain.length = [](int, int) { return 17.4; };
  Quadrille::Quad_extraction_options options;
  const Extracted one = extract(domain.build(), options);
  for (const int threads : {2, 4, 0}) {
    options.threads = threads;
    const Extracted several = extract(domain.build(), options);
    ASSERT_EQ(one.quads.number_of_vertices(), several.quads.number_of_vertices());
    for (const auto v : one.quads.vertices())
      EXPECT_EQ(one.quads.point(v), several.quads.point(v));
  }
}

TEST(Extract_quads, projector_takes_vertices_to_the_true_curve)
{
  const double pi = std::acos(-1.0);
  Glued_rectangles domain = annulus(16, 1, 2 * pi * 6, 4.0);
  domain.subdivisions = 2;
  const auto to_circle = [](int curve, const Point_2& p) {
    const double factor = curve / std::hypot(p.x(), p.y());
    return Point_2(factor * p.x(), factor * p.y());
  };
  const Extracted extracted = extract(domain.build(), {}, Quadrille::Greedy_quantizer(), to_circle);
  expect_valid(extracted, 0);
  EXPECT_EQ(extracted.result.smoothing.unprojected_vertices, 0);
  for (const auto v : extracted.quads.vertices()) {
    const int curve = extracted.result.vertices[v.idx()].curve;
    if (curve >= 0) {
      EXPECT_NEAR(std::hypot(extracted.quads.point(v).x(), extracted.quads.point(v).y()), curve, 1e-12);
    }
  }
  const auto collapse = [](int, const Point_2&) { return Point_2(0, 0); };
  const Extracted guarded = extract(domain.build(), {}, Quadrille::Greedy_quantizer(), collapse);
  expect_valid(guarded, 0);
  EXPECT_GT(guarded.result.smoothing.unprojected_vertices, 0);
}

TEST(Extract_quads, reports_corners_that_the_map_makes_too_narrow)
{
  // Three quarters of a diamond around vertex 0; the map, a square, has one right angle there.
  Mapped_mesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  const std::vector<Point> uv = {{0, 0}, {4, 0}, {4, 2}, {4, 4}, {0, 4}};
  mesh.curve = {0, 0, -1, -1, 0, -1, -1, 0, 0};
  mesh.region = {0, 0, 0};
  for (const auto& triangle : mesh.triangles)
    for (const int v : triangle)
      mesh.corner_uv.push_back(uv[std::size_t(v)]);
  try {
    extract(mesh);
    FAIL() << "no error";
  } catch (const Quadrille::No_result_error& error) {
    EXPECT_EQ(error.stage(), "map");
    EXPECT_NE(std::string(error.what()).find("270 degrees, at vertex 0"), std::string::npos);
  }
}

TEST(Extract_quads, refuses_too_many_quads)
{
  Glued_rectangles domain = cell_grid(1, 1);
  domain.length = [](int, int) { return 500.0; };
  Quadrille::Quad_extraction_options options;
  options.max_quads = 1000;
  EXPECT_THROW(extract(domain.build(), options), Quadrille::No_result_error);
}

TEST(Extract_quads, as_many_as_wanted)
{
  const auto expect_number = [](const Mapped_mesh& mesh, std::size_t wanted) {
    SCOPED_TRACE(wanted);
    const Quadrille::internal::Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
    Quadrille::Quad_extraction_options options;
    options.quads = wanted;
    const Extracted extracted = extract(mesh, options);
    expect_valid(extracted, triangulation.euler_characteristic());
    EXPECT_NEAR(double(extracted.quads.number_of_faces()), double(wanted), 0.05 * double(wanted));
    EXPECT_LT(std::abs(extracted.result.area_change_relative), 0.1);
    return extracted.result.scale;
  };
  Glued_rectangles rectangle = cell_grid(1, 1);
  rectangle.length = [](int a, int b) { return std::abs(a - b) == 1 ? 6.8 : 3.3; };
  EXPECT_NEAR(expect_number(rectangle.build(), 2000), std::sqrt(2000 / (6.8 * 3.3)), 0.2);
  EXPECT_NEAR(expect_number(rectangle.build(), 21), 1, 0.05);
  for (const std::size_t wanted : {300, 3000, 30000})
    expect_number(uneven_star().build(), wanted);
  for (unsigned seed = 0; seed < 10; ++seed)
    expect_number(random_domain(seed).build(), 3000);
}

TEST(Extract_quads, can_be_cancelled)
{
  const Quadrille::Progress_observer observer([](const std::string& stage, double) { return stage != "mesh"; });
  Quadrille::Quad_extraction_options options;
  options.observer = &observer;
  EXPECT_THROW(extract(star(3).build(), options), Quadrille::Cancelled_error);
}

// Random domains: triangulations whose triangles are cut into three cells, with strips of lengths from 0.05 to 5 and
// random features. Singularities everywhere, and many strips too thin to keep.
TEST(Extract_quads, random_domains)
{
  using Quadrille::Layout_kind;
  for (const Layout_kind layout : {Layout_kind::base_complex, Layout_kind::t_mesh}) {
    int collapsed = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
      const Glued_rectangles domain = random_domain(seed);
      const Mapped_mesh mesh = domain.build();
      const Quadrille::internal::Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
      SCOPED_TRACE(seed);
      Quadrille::Quad_extraction_options options;
      options.layout = layout;
      const Extracted extracted = extract(mesh, options);
      expect_valid(extracted, triangulation.euler_characteristic());
      collapsed += extracted.result.collapsed_arcs;
    }
    EXPECT_GT(collapsed, 50);
  }
}
