// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Distances between quad meshes and surfaces.

#include "quad_test_meshes.h"

#include <Quadrille/Surface_domain.h>
#include <Quadrille/compare_surfaces.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

using namespace Quadrille;

namespace {

TEST(Surface_comparison, of_a_quad_and_two_triangles)
{
  for (const double scale : {1.0, 1e8, 1e-8}) {
    // Four points of z = xy; the triangles are on both sides of the longer diagonal, the quad is split at the shorter.
    const Labelled_mesh mesh =
        scaled(quads({{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}}, {{0, 1, 2, 3}}), scale, {scale, -2 * scale, scale});
    Labelled_mesh triangles = mesh;
    triangles.polygons = {{0, 1, 2}, {0, 2, 3}};
    triangles.polygon_region = {-1, -1};
    Surface_domain_options options;
    options.split_chords = false;
    const Surface_domain domain = make_surface_domain(triangles, "triangles", options);
    const Surface_comparison comparison = compare_with_surface(mesh, domain);
    // The centre is 1/4 below the diagonal, and the triangles are in the planes z = x and z = y.
    EXPECT_NEAR(comparison.to_surface_max / scale, 0.25 / std::sqrt(2.0), 1e-12);
    // The centres of the triangles, such as (2/3, 1/3, 1/3), are above the plane z = x + y - 1.
    EXPECT_NEAR(comparison.from_surface_max / scale, 1 / (3 * std::sqrt(3.0)), 1e-12);
    EXPECT_EQ(comparison.hausdorff, comparison.from_surface_max);
    EXPECT_NEAR(comparison.hausdorff_relative, 1.0 / 9, 1e-12);
    EXPECT_NEAR(comparison.area_relative, (1 + std::sqrt(3.0)) / 2 / std::sqrt(2.0) - 1, 1e-12);
    // The longer diagonal is a crease of 60 degrees; its middle is 1/2 away from the sides.
    EXPECT_NEAR(comparison.feature_distance_max / scale, 0.5, 1e-12);
    EXPECT_EQ(comparison.flipped_quads, 0u);
  }
}

TEST(Surface_comparison, of_cubes_of_different_size)
{
  for (const double scale : {1.0, 1e8, 1e-8}) {
    const Surface_domain domain = make_surface_domain(scaled(cube_of_quads(3), scale), "cube");
    ASSERT_EQ(domain.curves.size(), 12u);
    const Labelled_mesh mesh = scaled(cube_of_quads(4), 1.01 * scale);
    Surface_comparison comparison = compare_with_surface(mesh, domain);
    EXPECT_NEAR(comparison.to_surface_max / scale, 0.01 * std::sqrt(3.0), 1e-9); // at the corners
    EXPECT_NEAR(comparison.from_surface_max / scale, 0.01, 1e-9);
    EXPECT_NEAR(comparison.hausdorff / scale, 0.01 * std::sqrt(3.0), 1e-9);
    EXPECT_NEAR(comparison.hausdorff_relative, 0.005, 1e-9);
    EXPECT_NEAR(comparison.feature_distance_max / scale, 0.01 * std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(comparison.feature_distance_max_relative, 0.005 * std::sqrt(2.0 / 3), 1e-9);
    EXPECT_NEAR(comparison.area_relative, 0.0201, 1e-9);
    EXPECT_EQ(comparison.flipped_quads, 0u);

    comparison = compare_with_surface(turned_over(mesh), domain);
    EXPECT_EQ(comparison.flipped_quads, 96u);
    EXPECT_NEAR(comparison.feature_distance_max / scale, 0.01 * std::sqrt(2.0), 1e-9);

    // A hole is seen from the surface only: the centres of its triangles are a third of its width away from its sides.
    Labelled_mesh open = scaled(cube_of_quads(3), scale);
    open.polygons.erase(open.polygons.begin() + 4); // in the middle of a side
    comparison = compare_with_surface(open, domain);
    EXPECT_NEAR(comparison.to_surface_max / scale, 0, 1e-9);
    EXPECT_NEAR(comparison.from_surface_max / scale, 2.0 / 9, 1e-9);
    EXPECT_NEAR(comparison.area_relative, -1.0 / 54, 1e-9);
  }
}

TEST(Surface_comparison, thin_walls_are_told_apart_by_their_labels)
{
  // Two plates back to back, the mesh bent outwards by more than their distance: nearer to the other plate.
  const double gap = 0.01, bend = 0.1;
  Labelled_mesh plates = quads({{0, 0, 0},
                                {1, 0, 0},
                                {1, 1, 0},
                                {0, 1, 0}, //
                                {0, 0, gap},
                                {0, 1, gap},
                                {1, 1, gap},
                                {1, 0, gap}},
                               {{0, 1, 2, 3}, {4, 5, 6, 7}});
  plates.regions = {{7, {}}, {8, {}}};
  plates.polygon_region = {0, 1};
  const Surface_domain domain = make_surface_domain(plates, "plates");
  Labelled_mesh mesh = plates;
  for (std::size_t v = 0; v < 8; ++v)
    mesh.points[v][2] += v < 4 ? bend : -bend;
  EXPECT_EQ(compare_with_surface(mesh, domain).flipped_quads, 0u);
  EXPECT_EQ(compare_with_surface(turned_over(mesh), domain).flipped_quads, 2u);
  mesh.polygon_region = {-1, -1};
  EXPECT_EQ(compare_with_surface(mesh, domain).flipped_quads, 2u);
}

TEST(Surface_comparison, of_a_sphere_and_a_larger_one)
{
  for (const double scale : {1.0, 1e8, 1e-8}) {
    const std::array<double, 3> centre = {3 * scale, 4 * scale, -5 * scale};
    const Surface_domain domain = make_surface_domain(scaled(sphere_of_quads(16), scale, centre), "sphere");
    ASSERT_TRUE(domain.curves.empty());
    const Surface_comparison comparison =
        compare_with_surface(scaled(sphere_of_quads(16), 1.01 * scale, centre), domain);
    EXPECT_NEAR(comparison.to_surface_max / scale, 0.01, 5e-4);
    EXPECT_NEAR(comparison.from_surface_max / scale, 0.01, 5e-4);
    EXPECT_NEAR(comparison.area_relative, 0.0201, 1e-4);
    EXPECT_EQ(comparison.feature_distance_max, 0); // there are no curves
    EXPECT_EQ(comparison.flipped_quads, 0u);
  }
}

TEST(Surface_comparison, features_are_compared_with_lines_or_sharp_edges)
{
  const Surface_domain domain = make_surface_domain(cube_of_quads(4), "cube");
  Labelled_mesh mesh = cube_of_quads(4);
  EXPECT_NEAR(compare_with_surface(mesh, domain).feature_distance_max, 0, 1e-12);
  // Lines on one edge of the cube only: the opposite one is far away.
  for (const std::vector<int>& quad : mesh.polygons)
    for (std::size_t i = 0; i < 4; ++i) {
      const auto is_there = [&](int v) {
        return mesh.points[std::size_t(v)][0] == 1 && mesh.points[std::size_t(v)][2] == -1;
      };
      if (is_there(quad[i]) && is_there(quad[(i + 1) % 4]))
        mesh.lines.push_back({quad[i], quad[(i + 1) % 4]});
    }
  EXPECT_NEAR(compare_with_surface(mesh, domain).feature_distance_max, 2 * std::sqrt(2.0), 1e-12);
  // A smooth mesh follows no curves, also if it is not oriented consistently.
  mesh = sphere_of_quads(8);
  std::reverse(mesh.polygons[7].begin(), mesh.polygons[7].end());
  EXPECT_EQ(compare_with_surface(mesh, domain).feature_distance_max, std::numeric_limits<double>::infinity());
}

TEST(Surface_comparison, refuses_what_cannot_be_compared)
{
  const Surface_domain domain = make_surface_domain(cube_of_quads(2), "cube");
  EXPECT_THROW(compare_with_surface(Labelled_mesh(), domain), Invalid_argument_error);
  Labelled_mesh mesh = cube_of_quads(2);
  mesh.points[3][1] = std::nan("");
  EXPECT_THROW(compare_with_surface(mesh, domain), Invalid_argument_error);
}

} // namespace
