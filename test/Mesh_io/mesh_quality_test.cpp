// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "quad_test_meshes.h"

#include <Quadrille/Mesh_quality.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace Quadrille;

namespace {

/// n quads around one vertex.
Labelled_mesh star(int n, double scale = 1)
{
  std::vector<std::array<double, 3>> points{{0, 0, 0}};
  std::vector<std::vector<int>> polygons;
  for (int i = 0; i < 2 * n; ++i) {
    const double angle = 3.14159265358979323846 * i / n, r = i % 2 == 0 ? scale : 1.4 * scale;
    points.push_back({r * std::cos(angle), r * std::sin(angle), 0});
  }
  for (int i = 0; i < n; ++i)
    polygons.push_back({0, 2 * i + 1, 2 * i + 2, (2 * i + 2) % (2 * n) + 1});
  return quads(points, polygons);
}

TEST(Mesh_quality, of_a_square_and_a_parallelogram)
{
  const Mesh_quality square = measure_quality(quads({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}));
  EXPECT_DOUBLE_EQ(square.scaled_jacobian_min, 1);
  EXPECT_NEAR(square.skew_max, 0, 1e-12);
  EXPECT_EQ(square.irregular_boundary, (std::map<int, int>{{1, 4}}));
  const double s = std::sqrt(3.0) / 2;
  const Mesh_quality sheared = measure_quality(quads({{0, 0, 0}, {1, 0, 0}, {1.5, s, 0}, {0.5, s, 0}}, {{0, 1, 2, 3}}));
  EXPECT_NEAR(sheared.scaled_jacobian_min, s, 1e-12);
  EXPECT_NEAR(sheared.skew_mean, 30, 1e-9);
  // Seen from the other side nothing changes.
  const Mesh_quality back = measure_quality(quads({{0, 0, 0}, {1, 0, 0}, {1.5, s, 0}, {0.5, s, 0}}, {{3, 2, 1, 0}}));
  EXPECT_NEAR(back.scaled_jacobian_min, s, 1e-12);
  EXPECT_NEAR(back.skew_max, 30, 1e-9);
}

TEST(Mesh_quality, of_a_concave_quad_is_negative)
{
  const Mesh_quality quality =
      measure_quality(quads({{0, 0, 0}, {1, 0, 0}, {0.25, 0.25, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}));
  EXPECT_LT(quality.scaled_jacobian_min, 0);
  EXPECT_GT(quality.skew_max, 90);
}

TEST(Mesh_distortion, of_two_rectangles)
{
  for (const double scale : {1.0, 1e8, 1e-8}) {
    // 1 x 2 and 2 x 3: areas are 1/2 and 3/2 of their mean, aspects 2 and 3/2.
    Labelled_mesh mesh = quads({{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {4, 0, 0}, {4, 0, 2}, {7, 0, 2}, {7, 0, 0}},
                               {{0, 1, 2, 3}, {4, 5, 6, 7}});
    for (std::array<double, 3>& p : mesh.points)
      for (double& x : p)
        x *= scale;
    const Mesh_distortion distortion = measure_distortion(mesh);
    EXPECT_NEAR(distortion.area.mean, 0.5 * (std::log(2.0) + std::log(1.5)), 1e-12);
    EXPECT_NEAR(distortion.area.squared_mean, 0.5 * (std::pow(std::log(2.0), 2) + std::pow(std::log(1.5), 2)), 1e-12);
    EXPECT_NEAR(distortion.aspect.mean, 0.5 * (std::log(2.0) + std::log(1.5)), 1e-12);
    EXPECT_NEAR(distortion.aspect.max, std::log(2.0), 1e-12);
    EXPECT_NEAR(distortion.edge_length_percentile_1, scale, 1e-12 * scale);
    EXPECT_NEAR(distortion.edge_length_median, 2.0 * scale, 1e-12 * scale);
    EXPECT_NEAR(distortion.edge_length_percentile_99, 3.0 * scale, 1e-12 * scale);
  }
}

TEST(Mesh_distortion, counts_shared_edges_once_and_skips_what_has_no_area)
{
  const double nan = std::nan("");
  const Mesh_distortion distortion =
      measure_distortion(quads({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}, {nan, 0, 0}},
                               {{0, 1, 2, 3}, {1, 4, 5, 2}, {0, 1, 0, 1}, {0, 1, 2, 6}}));
  EXPECT_EQ(distortion.aspect.n, 2U);
  EXPECT_EQ(distortion.area.max, 0.0);
  EXPECT_EQ(distortion.edge_length_percentile_99, 1.0);
  EXPECT_EQ(measure_distortion(quads({}, {})).edge_length_median, 0.0);
}

TEST(Mesh_quality, irregular_vertices)
{
  for (const double scale : {1.0, 1e8, 1e-8}) {
    EXPECT_EQ(measure_quality(star(3, scale)).irregular, (std::map<int, int>{{3, 1}}));
    EXPECT_TRUE(measure_quality(star(4, scale)).irregular.empty());
    EXPECT_EQ(measure_quality(star(5, scale)).irregular, (std::map<int, int>{{5, 1}}));
    EXPECT_TRUE(check_quad_mesh(star(5, scale)).is_valid());
    EXPECT_EQ(check_quad_mesh(star(5, scale)).euler_characteristic, 1);
  }
}

TEST(Mesh_validity, names_what_is_wrong)
{
  const std::vector<std::array<double, 3>> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0},  {0, 1, 0},
                                                  {2, 0, 0}, {2, 1, 0}, {1, 0.5, 0}};
  EXPECT_TRUE(check_quad_mesh(quads(points, {{0, 1, 2, 3}, {1, 4, 5, 2}})).is_valid());
  EXPECT_TRUE(check_quad_mesh(quads(points, {{3, 2, 1, 0}, {2, 5, 4, 1}})).clockwise);
  EXPECT_FALSE(check_quad_mesh(quads(points, {})).is_valid());
  EXPECT_EQ(check_quad_mesh(quads(points, {{0, 1, 2, 3}, {1, 4, 2}})).non_quads, 1u);
  EXPECT_EQ(check_quad_mesh(quads(points, {{0, 1, 2, 2}})).degenerate_quads, 1u);
  EXPECT_EQ(check_quad_mesh(quads(points, {{0, 1, 2, 3}, {1, 2, 5, 4}})).inverted_corners, 4u);
  EXPECT_EQ(check_quad_mesh(quads(points, {{0, 1, 2, 3}, {1, 4, 5, 2}, {1, 4, 5, 2}})).non_manifold_edges, 4u);
  EXPECT_EQ(check_quad_mesh(quads(points, {{0, 1, 6, 3}, {6, 1, 4, 5}})).overlapping_borders, 0u);
  // A hanging vertex: the right-hand quads see vertex 6 on the edge, the left-hand one does not.
  std::vector<std::array<double, 3>> hanging = points;
  hanging.push_back({2, 0.5, 0});
  EXPECT_EQ(check_quad_mesh(quads(hanging, {{0, 1, 2, 3}, {1, 4, 7, 6}, {6, 7, 5, 2}})).overlapping_borders, 1u);
  std::vector<std::array<double, 3>> twins = points;
  twins.push_back({1, 0, 0});
  twins.push_back({1, 1, 0});
  EXPECT_EQ(check_quad_mesh(quads(twins, {{0, 1, 2, 3}, {7, 4, 5, 8}})).duplicate_vertices, 2u);
  std::vector<std::array<double, 3>> bad = points;
  bad[2][0] = std::nan("");
  EXPECT_FALSE(check_quad_mesh(quads(bad, {{0, 1, 2, 3}})).is_valid());
}

TEST(Size_error, is_the_logarithm_of_the_ratio)
{
  Labelled_mesh triangles;
  triangles.points = {{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0, 1, 0}};
  triangles.polygons = {{0, 1, 2}, {0, 2, 3}};
  triangles.lines = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  triangles.line_curve = {0, 1, 2, 3};
  triangles.curves = {{1, {}}, {2, {}}, {3, {}}, {4, {}}};
  const Planar_domain domain = make_planar_domain(triangles, "box");
  Size_specification specification;
  specification.add("1=1");
  specification.add("3=2");
  const Domain_sizes sizes = specification.apply(domain);
  // Two quads of length 2: exact on top, twice too long at the bottom, nothing prescribed left and right.
  const Labelled_mesh mesh =
      quads({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {0, 1, 0}, {2, 1, 0}, {4, 1, 0}}, {{0, 1, 4, 3}, {1, 2, 5, 4}});
  const Size_error error = measure_size_error(mesh, domain, sizes);
  EXPECT_EQ(error.length.n, 4u);
  EXPECT_NEAR(error.length.max, std::log(2.0), 1e-12);
  EXPECT_NEAR(error.length.mean, 0.5 * std::log(2.0), 1e-12);
  // The quads are half as high as long, where both curves ask for squares.
  EXPECT_EQ(error.aspect.n, 4u);
  EXPECT_NEAR(error.aspect.mean, std::log(2.0), 1e-12);
  Size_specification flat;
  flat.add("1=0.5x1");
  flat.add("3=freex1");
  const Size_error none = measure_size_error(mesh, domain, flat.apply(domain));
  EXPECT_EQ(none.aspect.n, 2u);
  EXPECT_NEAR(none.aspect.max, 0, 1e-12);
}

} // namespace
