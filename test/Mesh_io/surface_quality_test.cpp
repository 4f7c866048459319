// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Validity, quality and sizes of quad meshes of surfaces in space.

#include "quad_test_meshes.h"

#include <Quadrille/Mesh_quality.h>
#include <Quadrille/Surface_domain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

using namespace Quadrille;

namespace {

constexpr double degrees = 180 / 3.14159265358979323846;

/// Two cubes next to each other along all axes in `axes`; equal points are one.
Labelled_mesh two_cubes(std::array<int, 3> axes)
{
  Labelled_mesh mesh = cube_of_quads(1);
  const Labelled_mesh other = scaled(cube_of_quads(1), 1, {2.0 * axes[0], 2.0 * axes[1], 2.0 * axes[2]});
  std::vector<int> index;
  for (const std::array<double, 3>& p : other.points) {
    const auto same = std::find(mesh.points.begin(), mesh.points.begin() + 8, p);
    index.push_back(int(same - mesh.points.begin()));
    if (index.back() == 8) {
      index.back() = int(mesh.points.size());
      mesh.points.push_back(p);
    }
  }
  for (std::vector<int> quad : other.polygons) {
    for (int& v : quad)
      v = index[std::size_t(v)];
    mesh.polygons.push_back(quad);
  }
  return mesh;
}

TEST(Surface_validity, cubes_and_spheres_are_valid)
{
  for (const double scale : {1.0, 1e8, 1e-8})
    for (const Labelled_mesh& mesh : {cube_of_quads(3), sphere_of_quads(3), turned_over(cube_of_quads(3))}) {
      const Labelled_mesh large = scaled(mesh, scale);
      Mesh_validity validity = check_quad_mesh(large);
      EXPECT_TRUE(validity.is_valid()) << validity.problems[0];
      EXPECT_EQ(validity.euler_characteristic, 2);
      EXPECT_EQ(validity.boundary_loops, 0);
      EXPECT_EQ(validity.components, 1);
      EXPECT_FALSE(validity.clockwise);
      EXPECT_EQ(measure_quality(large).irregular, (std::map<int, int>{{3, 8}}));
      Labelled_mesh open = large;
      open.polygons.pop_back();
      validity = check_quad_mesh(open);
      EXPECT_TRUE(validity.is_valid()) << validity.problems[0];
      EXPECT_EQ(validity.euler_characteristic, 1);
      EXPECT_EQ(validity.boundary_loops, 1);
    }
}

TEST(Surface_validity, closed_surfaces_that_touch_in_a_vertex_or_an_edge_are_refused)
{
  const Mesh_validity vertex = check_quad_mesh(two_cubes({1, 1, 1}));
  EXPECT_EQ(vertex.non_manifold_vertices, 1u);
  EXPECT_EQ(vertex.non_manifold_edges, 0u);
  ASSERT_EQ(vertex.problems.size(), 1u);
  EXPECT_NE(vertex.problems[0].find("touch only in vertex"), std::string::npos) << vertex.problems[0];
  EXPECT_NE(vertex.problems[0].find("(1, 1, 1)"), std::string::npos) << vertex.problems[0];

  const Mesh_validity edge = check_quad_mesh(two_cubes({1, 0, 1}));
  EXPECT_EQ(edge.non_manifold_edges, 1u);
  EXPECT_EQ(edge.non_manifold_vertices, 0u);
  ASSERT_EQ(edge.problems.size(), 1u);
  EXPECT_NE(edge.problems[0].find("is in 4 polygons"), std::string::npos) << edge.problems[0];
  EXPECT_NE(edge.problems[0].find("(1, 1, 1)"), std::string::npos) << edge.problems[0];
}

TEST(Surface_validity, orientation_has_to_be_consistent)
{
  Labelled_mesh mesh = cube_of_quads(2);
  std::reverse(mesh.polygons[5].begin(), mesh.polygons[5].end());
  Mesh_validity validity = check_quad_mesh(mesh);
  EXPECT_EQ(validity.non_manifold_edges, 4u);
  EXPECT_EQ(validity.non_manifold_vertices, 0u);
  EXPECT_EQ(validity.euler_characteristic, 2);
  ASSERT_EQ(validity.problems.size(), 1u);
  EXPECT_NE(validity.problems[0].find("not oriented consistently"), std::string::npos) << validity.problems[0];

  // A band of n quads that comes back turned by 180 degrees: no orientation of a Moebius strip is consistent.
  const int n = 12;
  Labelled_mesh strip;
  for (int i = 0; i < n; ++i)
    for (const double side : {-0.3, 0.3}) {
      const double angle = 2 * 180 / degrees * i / n, r = 1 + side * std::cos(angle / 2);
      strip.points.push_back({r * std::cos(angle), r * std::sin(angle), side * std::sin(angle / 2)});
    }
  for (int i = 0; i < n; ++i) {
    const int a = 2 * i, b = i + 1 < n ? a + 2 : 1, c = i + 1 < n ? a + 3 : 0;
    strip.polygons.push_back({a, b, c, a + 1});
  }
  validity = check_quad_mesh(strip);
  EXPECT_EQ(validity.non_manifold_edges, 1u);
  EXPECT_EQ(validity.euler_characteristic, 0);
  EXPECT_EQ(validity.boundary_loops, 1);
}

TEST(Surface_validity, names_what_is_wrong)
{
  // In the plane z = x, two sides that cross: two of the corners are inverted.
  const Mesh_validity bow_tie = check_quad_mesh(quads({{0, 0, 0}, {3, 0, 3}, {1, 1, 1}, {2, 1, 2}}, {{0, 1, 2, 3}}));
  EXPECT_EQ(bow_tie.inverted_corners, 2u);
  ASSERT_EQ(bow_tie.problems.size(), 1u);
  EXPECT_EQ(bow_tie.problems[0], "polygon 0 has an inverted or flat corner at vertex 2 at (1, 1, 1)");

  Labelled_mesh mesh = cube_of_quads(2);
  mesh.polygons[3].pop_back();
  EXPECT_EQ(check_quad_mesh(mesh).non_quads, 1u);
  mesh = cube_of_quads(2);
  mesh.polygons[3][1] = mesh.polygons[3][0];
  EXPECT_EQ(check_quad_mesh(mesh).degenerate_quads, 1u);
  mesh = cube_of_quads(2);
  mesh.polygons.push_back(mesh.polygons[3]);
  EXPECT_EQ(check_quad_mesh(mesh).non_manifold_edges, 4u);
  mesh = cube_of_quads(2);
  mesh.points[3][2] = std::nan("");
  EXPECT_FALSE(check_quad_mesh(mesh).is_valid());
  // A corner that is not connected to its neighbours.
  mesh = cube_of_quads(2);
  mesh.points.push_back(mesh.points[std::size_t(mesh.polygons[3][2])]);
  mesh.polygons[3][2] = int(mesh.points.size()) - 1;
  EXPECT_EQ(check_quad_mesh(mesh).duplicate_vertices, 1u);
  EXPECT_EQ(check_quad_mesh(mesh).boundary_loops, 1);
}

TEST(Surface_validity, closed_parts_may_touch_and_borders_may_not)
{
  Labelled_mesh mesh = cube_of_quads(2);
  const Labelled_mesh first = mesh;
  for (const std::array<double, 3>& p : first.points)
    mesh.points.push_back({p[0] + 2, p[1], p[2]});
  for (std::vector<int> quad : first.polygons) {
    for (int& v : quad)
      v += int(first.points.size());
    mesh.polygons.push_back(quad);
  }
  EXPECT_TRUE(check_quad_mesh(mesh).is_valid());
  EXPECT_EQ(check_quad_mesh(mesh).components, 2);

  const Labelled_mesh folded =
      quads({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}, {1, 0, 0}, {1, 1, 0}},
            {{0, 1, 2, 3}, {6, 4, 5, 7}});
  EXPECT_EQ(check_quad_mesh(folded).duplicate_vertices, 2u);
}

TEST(Surface_validity, flat_corners_are_decided_exactly)
{
  for (const double scale : {1.0, 1e8, 1e-8}) {
    const double x = 0.1 * scale;
    const auto with_height = [&](double y) {
      return check_quad_mesh(quads({{0, 0, 0}, {x, y, x}, {2 * x, 2 * x, 2 * x}, {0, 10 * x, 0}}, {{0, 1, 2, 3}}));
    };
    EXPECT_EQ(with_height(x).inverted_corners, 1u);
    EXPECT_EQ(with_height(std::nextafter(x, 2 * x)).inverted_corners, 1u);
    EXPECT_EQ(with_height(std::nextafter(x, 0)).inverted_corners, 0u);
  }
}

TEST(Surface_quality, of_a_saddle)
{
  for (const double scale : {1.0, 1e8, 1e-8})
    for (const double h : {0.1, 0.5, 2.0}) {
      // All edges have the length sqrt(1 + h^2), all corners the scalar product h^2.
      const Labelled_mesh saddle =
          scaled(quads({{0, 0, 0}, {1, 0, h}, {1, 1, 0}, {0, 1, h}}, {{0, 1, 2, 3}}), scale, {scale, 0, 0});
      EXPECT_TRUE(check_quad_mesh(saddle).is_valid());
      const Mesh_quality quality = measure_quality(saddle);
      EXPECT_NEAR(quality.scaled_jacobian_min, 1 / (1 + h * h), 1e-12);
      EXPECT_NEAR(quality.scaled_jacobian_mean, 1 / (1 + h * h), 1e-12);
      EXPECT_NEAR(quality.skew_max, std::asin(h * h / (1 + h * h)) * degrees, 1e-9);
    }
}

TEST(Surface_quality, does_not_depend_on_the_plane_of_a_quad)
{
  // The same parallelogram and the same concave quad in the planes z = 0 and x = 1, and the latter from behind.
  const double s = std::sqrt(3.0) / 2;
  for (const std::vector<std::array<double, 2>>& shape :
       {std::vector<std::array<double, 2>>{{0, 0}, {1, 0}, {1.5, s}, {0.5, s}},
        {{0, 0}, {1, 0}, {0.25, 0.25}, {0, 1}}}) {
    Labelled_mesh flat = quads({}, {{0, 1, 2, 3}}), upright = flat;
    for (const std::array<double, 2>& p : shape) {
      flat.points.push_back({p[0], p[1], 0});
      upright.points.push_back({1, p[0], p[1]});
    }
    const Mesh_quality expected = measure_quality(flat);
    for (const Labelled_mesh& mesh : {upright, turned_over(upright)}) {
      const Mesh_quality quality = measure_quality(mesh);
      EXPECT_NEAR(quality.scaled_jacobian_min, expected.scaled_jacobian_min, 1e-12);
      EXPECT_NEAR(quality.skew_max, expected.skew_max, 1e-9);
    }
  }
}

/// A cube with sides of length 4 in 2 x 2 squares each.
Surface_domain box(double scale) { return make_surface_domain(scaled(cube_of_quads(2), 2 * scale), "box"); }

/// The same in n x n quads per side, with the edges of the cube as lines.
Labelled_mesh quads_of_box(int n, double scale)
{
  Labelled_mesh mesh = cube_of_quads(n);
  for (const std::vector<int>& quad : mesh.polygons)
    for (std::size_t i = 0; i < 4; ++i) {
      const int a = quad[i], b = quad[(i + 1) % 4];
      int n_common = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = mesh.points[std::size_t(a)][k];
        n_common += std::abs(x) == 1 && x == mesh.points[std::size_t(b)][k];
      }
      if (n_common == 2 && a < b)
        mesh.lines.push_back({a, b});
    }
  mesh.line_curve.assign(mesh.lines.size(), -1);
  return scaled(mesh, 2 * scale);
}

TEST(Surface_size_error, is_measured_on_the_edges_of_a_box)
{
  for (const double scale : {1.0, 1e8, 1e-8}) {
    const Surface_domain domain = box(scale);
    ASSERT_EQ(domain.curves.size(), 12u);
    const Labelled_mesh mesh = quads_of_box(4, scale);
    ASSERT_EQ(mesh.lines.size(), 48u);
    const auto error_with = [&](const std::string& size) {
      Size_specification specification;
      specification.add(size);
      return measure_size_error(mesh, domain, specification.apply(domain));
    };
    const auto number = [&](double x) {
      std::ostringstream text;
      text.precision(17);
      text << x * scale;
      return text.str();
    };
    const Size_error exact = error_with(number(1));
    EXPECT_EQ(exact.length.n, 48u);
    EXPECT_NEAR(exact.length.max, 0, 1e-12);
    EXPECT_EQ(exact.aspect.n, 96u); // two quads at every edge
    EXPECT_NEAR(exact.aspect.max, 0, 1e-12);
    EXPECT_NEAR(error_with(number(2)).length.mean, std::log(2.0), 1e-12);
    const Size_error flat = error_with(number(0.5) + "x" + number(1));
    EXPECT_NEAR(flat.length.max, 0, 1e-12);
    EXPECT_NEAR(flat.aspect.mean, std::log(2.0), 1e-12);

    // From 1 to 2 along one edge; nothing is prescribed on the others.
    const Size_error graded = error_with(std::to_string(domain.curves[0].tag) + "=" + number(1) + ":" + number(2));
    double sum = 0;
    for (int i = 0; i < 4; ++i)
      sum += std::log(1 + (i + 0.5) / 4);
    EXPECT_EQ(graded.length.n, 4u);
    EXPECT_NEAR(graded.length.mean, sum / 4, 1e-12);
    EXPECT_NEAR(graded.length.max, std::log(1 + 3.5 / 4), 1e-12);
  }
}

TEST(Surface_size_error, takes_the_border_where_there_are_no_lines)
{
  Labelled_mesh mesh = scaled(cube_of_quads(4), 2);
  const Surface_domain domain = box(1);
  Size_specification specification;
  specification.add("1");
  EXPECT_EQ(measure_size_error(mesh, domain, specification.apply(domain)).length.n, 0u);
  mesh.polygons.resize(5 * 16); // five sides
  const Size_error error = measure_size_error(mesh, domain, specification.apply(domain));
  EXPECT_EQ(error.length.n, 16u);
  EXPECT_NEAR(error.length.max, 0, 1e-12);
}

} // namespace
