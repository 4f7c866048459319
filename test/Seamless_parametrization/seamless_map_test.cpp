// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "map_test_tools.h"

#include <gtest/gtest.h>

namespace {

using namespace Quadrille;
using namespace Quadrille::test;

TEST(Seamless_map, rectangle_with_constant_frames_is_mapped_exactly)
{
  const Planar_mesh mesh = rectangle_mesh(8, 5, 4.0, 2.5);
  const Seamless_map_data map = compute_map(mesh, sample(mesh, [](auto) { return frame(0.0, 0.5); }));
  expect_exactly_seamless(mesh, map);
  EXPECT_TRUE(map.cut.paths.empty());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) { // vertex 0, at the origin, is the origin of the map
      const Eigen::Vector2d expected = 2.0 * mesh.points[std::size_t(mesh.triangles[f][i])];
      EXPECT_LT((map.uv[3 * f + i] - expected).norm(), 1e-11);
    }
  EXPECT_LT(map.integration_error, 1e-20);
}

TEST(Seamless_map, integration_error_of_constant_stretch_is_known)
{
  // Sizes 1 asked on a rectangle whose feature in the middle prevents nothing: u is x. With v gradients of 1 on the
  // lower and 3 on the upper half, v is still integrable: no error. With du = 1 below and 3 above it is not. Elements
  // above are 1/3 x 1, which weighs u by 1/3 there: g = grad u minimises (g - 1)^2 + (g - 3)^2 / 3, so it is 3/2.
  const Planar_mesh mesh = rectangle_mesh(4, 40);
  const auto halves = [](double u, double v) {
    return [=](const Eigen::Vector2d& p) {
      return p.y() < 0.5 ? Gradient_pair({1, 0}, {0, 1}) : Gradient_pair({u, 0}, {0, v});
    };
  };
  EXPECT_LT(compute_map(mesh, sample(mesh, halves(1, 3))).integration_error, 1e-20);
  const Seamless_map_data map = compute_map(mesh, sample(mesh, halves(3, 1)));
  EXPECT_NEAR(map.integration_residual, 0.5 * (0.25 + 2.25), 1e-10);
  EXPECT_NEAR(map.integration_error, 0.5 * (0.25 + 2.25 / 9.0) / 3.0, 1e-10);
}

TEST(Seamless_map, annulus_is_mapped_by_the_logarithm)
{
  double previous_error = 0.0;
  for (const int n : {4, 8, 16}) {
    const Planar_mesh mesh = annulus_mesh(n, 8 * n);
    const Seamless_map_data map = compute_map(mesh, sample(mesh, polar_frame));
    expect_exactly_seamless(mesh, map);
    EXPECT_TRUE(map.flipped_faces.empty());
    EXPECT_TRUE(singularities(mesh, map).empty());
    ASSERT_EQ(map.cut.paths.size(), 1u);
    const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
    const int h = map.cut.paths[0].halfedges[0];
    EXPECT_EQ(map.cut.paths[0].matching, 0);
    const Eigen::Vector2d translation =
        map.uv[std::size_t(Indexed_triangulation::next(triangulation.opposite(h)))] - map.uv[std::size_t(h)];
    // One turn: 2 pi in the coordinate along the circles, exactly nothing in the other one.
    EXPECT_EQ(translation.cwiseAbs().minCoeff(), 0.0);
    const double error = std::abs(translation.cwiseAbs().maxCoeff() - 2.0 * pi);
    EXPECT_LT(error, 1.5 / (n * n));
    if (previous_error > 0.0) {
      EXPECT_NEAR(previous_error / error, 4.0, 0.6); // second order
    }
    previous_error = error;
  }
}

class Conformal_singularity : public testing::TestWithParam<int> {};

TEST_P(Conformal_singularity, map_converges_to_the_power)
{
  const int quadrants = GetParam();
  double previous_error = 0.0;
  for (const int n : {6, 12, 24}) {
    const Planar_mesh mesh = glued_squares_mesh(quadrants, n);
    const Seamless_map_data map =
        compute_map(mesh, sample(mesh, [&](const auto& p) { return power_frame(p, quadrants); }));
    expect_exactly_seamless(mesh, map);
    EXPECT_EQ(singularities(mesh, map), (std::map<int, int>{{quadrants, 1}}));
    EXPECT_EQ(map.topology.vertex_quadrants[0], quadrants);
    EXPECT_TRUE(map.flipped_faces.empty());
    EXPECT_TRUE(map.misturned_vertices.empty());
    const double error = power_map_error(mesh, map, quadrants);
    if (previous_error > 0.0) {
      EXPECT_GT(previous_error / error, 1.85); // first order in the gradients
    }
    previous_error = error;
  }
  EXPECT_LT(previous_error, 0.005);
}

INSTANTIATE_TEST_SUITE_P(valence, Conformal_singularity, testing::Values(3, 5, 6));

TEST(Seamless_map, l_shape_keeps_its_concave_corner)
{
  for (const double angle : {0.0, 0.3}) {
    const Planar_mesh mesh = transformed(l_shape_mesh(0.15), angle, 1.0);
    const Seamless_map_data map =
        compute_map(mesh, perturbed(sample(mesh, [&](auto) { return frame(angle); }), 0.0, 1));
    expect_exactly_seamless(mesh, map);
    EXPECT_LT(map.integration_error, 1e-20);
    EXPECT_TRUE(map.flipped_faces.empty());
    EXPECT_TRUE(map.misturned_vertices.empty());
  }
}

TEST(Seamless_map, plate_with_holes)
{
  const Planar_mesh mesh = plate_with_holes_mesh(0.12);
  const Seamless_map_data map = compute_map(mesh, smooth_cross_field(mesh, 0.2));
  expect_exactly_seamless(mesh, map);
  EXPECT_EQ(singularities(mesh, map), (std::map<int, int>{{5, 12}})); // four around each hole
  EXPECT_TRUE(map.flipped_faces.empty());
  EXPECT_TRUE(map.misturned_vertices.empty());
  EXPECT_LT(map.integration_error, 0.01);
}

/// The map up to turns: lengths of all its edges.
std::vector<double> edge_lengths(const Seamless_map_data& map)
{
  std::vector<double> lengths;
  for (std::size_t h = 0; h < map.uv.size(); ++h)
    lengths.push_back((map.uv[std::size_t(Indexed_triangulation::next(int(h)))] - map.uv[h]).norm());
  return lengths;
}

TEST(Seamless_map, scaling_and_rotation_of_the_domain_change_nothing)
{
  const Planar_mesh mesh = plate_with_holes_mesh(0.2);
  const std::vector<Gradient_pair> frames = smooth_cross_field(mesh, 0.2);
  const Seamless_map_data map = compute_map(mesh, frames);
  for (const auto& [angle, scale] : {std::pair(0.0, 1e8), std::pair(0.0, 1e-8), std::pair(0.3, 1.0)}) {
    const Planar_mesh other = transformed(mesh, angle, scale, {3.0 * scale, -2.0 * scale});
    std::vector<Gradient_pair> other_frames;
    for (const Gradient_pair& pair : frames) {
      Eigen::Matrix2d turn;
      turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
      other_frames.emplace_back(turn * pair.first / scale, turn * pair.second / scale);
    }
    const Seamless_map_data other_map = compute_map(other, other_frames);
    expect_exactly_seamless(other, other_map);
    EXPECT_EQ(map.topology.vertex_quadrants, other_map.topology.vertex_quadrants);
    const std::vector<double> expected = edge_lengths(map);
    const std::vector<double> lengths = edge_lengths(other_map);
    for (std::size_t h = 0; h < lengths.size(); ++h)
      ASSERT_NEAR(lengths[h], expected[h], 1e-9);
    EXPECT_NEAR(other_map.integration_error, map.integration_error, 1e-9);
    EXPECT_NEAR(other_map.integration_residual, map.integration_residual, 1e-9);
  }
}

TEST(Seamless_map, numbering_changes_only_where_the_seams_are)
{
  const Planar_mesh mesh = plate_with_holes_mesh(0.2);
  const Planar_mesh other = relabelled(mesh, 11);
  // A field given by positions only: the frames of the nearest triangle of the first mesh.
  const std::vector<Gradient_pair> frames = smooth_cross_field(mesh, 0.2);
  std::map<std::pair<double, double>, std::size_t> face_at;
  const auto key = [](const Planar_mesh& m, std::size_t f) {
    const Eigen::Vector2d c = m.centroid(f);
    return std::pair(std::round(c.x() * 1e9), std::round(c.y() * 1e9));
  };
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    face_at[key(mesh, f)] = f;
  std::vector<Gradient_pair> other_frames;
  for (std::size_t f = 0; f < other.triangles.size(); ++f)
    other_frames.push_back(frames[face_at.at(key(other, f))]);
  const Seamless_map_data map = compute_map(mesh, frames);
  const Seamless_map_data other_map = compute_map(other, perturbed(other_frames, 0.0, 1));
  expect_exactly_seamless(other, other_map);
  EXPECT_EQ(singularities(mesh, map), singularities(other, other_map));
  EXPECT_NEAR(map.integration_error, other_map.integration_error, 1e-10);
  std::vector<double> lengths = edge_lengths(map);
  std::vector<double> other_lengths = edge_lengths(other_map);
  std::sort(lengths.begin(), lengths.end());
  std::sort(other_lengths.begin(), other_lengths.end());
  for (std::size_t h = 0; h < lengths.size(); ++h)
    ASSERT_NEAR(lengths[h], other_lengths[h], 1e-9);
}

TEST(Seamless_map, perturbed_gradients_stay_exact)
{
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Planar_mesh mesh = relabelled(plate_with_holes_mesh(0.25), seed);
    const Seamless_map_data map = compute_map(mesh, perturbed(smooth_cross_field(mesh, 0.1), 0.15 * seed, seed));
    expect_exactly_seamless(mesh, map);
    EXPECT_EQ(map.seam_residual_max, 0.0);
  }
}

TEST(Seamless_map, oblique_gradients)
{
  // A parallelogram with gradients of its own affine coordinates, which are not orthogonal.
  Planar_mesh mesh = rectangle_mesh(6, 6);
  Eigen::Matrix2d shear;
  shear << 1.0, 0.4, 0.0, 0.7;
  for (Eigen::Vector2d& p : mesh.points)
    p = shear * p;
  const Eigen::Matrix2d inverse = shear.inverse();
  const Gradient_pair pair(inverse.row(0).transpose(), inverse.row(1).transpose());
  const Seamless_map_data map = compute_map(mesh, perturbed(sample(mesh, [&](auto) { return pair; }), 0.0, 9));
  expect_exactly_seamless(mesh, map);
  EXPECT_LT(map.integration_error, 1e-20);
  EXPECT_TRUE(singularities(mesh, map).empty());
}

TEST(Seamless_map, feature_lines_become_isolines)
{
  // Two crossing diagonals in the middle of the square, away from its boundary.
  const std::vector<Eigen::Vector2d> ends = {{0.3, 0.3}, {0.7, 0.7}, {0.3, 0.7}, {0.7, 0.3}, {0.5, 0.5}};
  const Planar_mesh mesh =
      delaunay_mesh({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}, 0.07, ends, {{0, 4}, {4, 1}, {2, 4}, {4, 3}});
  const auto on_feature = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const auto on = [](const Eigen::Vector2d& p, double slope) {
      const Eigen::Vector2d d = p - Eigen::Vector2d(0.5, 0.5);
      return std::abs(d.y() - slope * d.x()) < 1e-12 && d.lpNorm<Eigen::Infinity>() < 0.2 + 1e-12;
    };
    return (on(a, 1.0) && on(b, 1.0)) || (on(a, -1.0) && on(b, -1.0));
  };
  const std::vector<char> constrained = edges_where(mesh, on_feature);
  ASSERT_GT(std::count(constrained.begin(), constrained.end(), 1), 20);
  const auto twist = [](const Eigen::Vector2d& p) {
    const double r = (p - Eigen::Vector2d(0.5, 0.5)).lpNorm<Eigen::Infinity>();
    return frame(pi / 4 * std::clamp((0.45 - r) / 0.2, 0.0, 0.99), 0.05);
  };
  for (const double noise : {0.0, 0.3}) {
    const Seamless_map_data map = compute_map(mesh, perturbed(sample(mesh, twist), noise, 2), constrained);
    expect_exactly_seamless(mesh, map, constrained);
    EXPECT_TRUE(map.flipped_faces.empty());
    for (const auto& sector : map.topology.sectors)
      if (mesh.points[std::size_t(sector.vertex)] == Eigen::Vector2d(0.5, 0.5)) {
        EXPECT_EQ(sector.quadrants, 1); // four of them around the crossing
      }
  }
}

TEST(Seamless_map, one_solver_serves_many_fields)
{
  const Planar_mesh mesh = plate_with_holes_mesh(0.3);
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  const internal::Seamless_map_solver solver(triangulation, internal::planar_geometry(triangulation, mesh.points), {});
  const std::vector<Gradient_pair> frames = smooth_cross_field(mesh, 0.2);
  const std::vector<Gradient_pair> rough = perturbed(frames, 0.6, 3);
  const Seamless_map_data first = solver(frames);
  solver(rough);
  EXPECT_EQ(solver(frames).uv, first.uv);
}

} // namespace
