// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "map_test_tools.h"

#include <Quadrille/Seamless_parametrization/internal/untangle_map.h>

#include <gtest/gtest.h>

namespace {

using namespace Quadrille;
using namespace Quadrille::test;

TEST(Untangling, gradient_agrees_with_finite_differences)
{
  const Planar_mesh mesh = glued_squares_mesh(3, 3);
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  const internal::Tangent_geometry geometry = internal::planar_geometry(triangulation, mesh.points);
  const auto frames = sample(mesh, [](const auto& p) { return power_frame(p, 3); });
  const Seamless_map_data map = compute_map(mesh, frames);
  const internal::Seamless_space space = internal::Seamless_constraints(triangulation, map.topology, map.cut)();
  internal::Reduced_elements elements(space);
  const std::vector<double> weights(mesh.triangles.size(), 0.1);
  const std::vector<internal::Aligned_halfedge> aligned = internal::aligned_halfedges(map.topology, map.cut);
  ASSERT_FALSE(aligned.empty());
  internal::Untangling_problem problem(geometry, frames, aligned, weights, internal::whole_map(space).faces, elements,
                                       1);
  std::mt19937 generator(1);
  Eigen::VectorXd y(elements.number_of_parameters());
  for (double& value : y) // random coordinates: about half of the triangles are flipped
    value = double(generator()) / 4294967295.0;
  for (const double epsilon : {1.0, 0.1}) {
    problem.set_epsilon(epsilon);
    problem.linearize(y);
    const Eigen::VectorXd gradient = problem.gradient();
    EXPECT_LT(problem.smallest_determinant(y), 0.0);
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      const double step = 1e-6;
      Eigen::VectorXd ahead = y;
      Eigen::VectorXd behind = y;
      ahead[i] += step;
      behind[i] -= step;
      const double difference = (problem.energy(ahead) - problem.energy(behind)) / (2.0 * step);
      EXPECT_NEAR(difference, gradient[i], 1e-5 * (1.0 + std::abs(gradient[i])));
    }
  }
}

TEST(Untangling, regularisation_is_positive_and_tends_to_the_positive_part)
{
  using Problem = internal::Untangling_problem;
  EXPECT_GT(Problem::chi(1e-9, -1e9), 0.0);
  EXPECT_NEAR(Problem::chi(1e-9, 2.0), 2.0, 1e-12);
  EXPECT_NEAR(Problem::chi(1e-9, -2.0), 0.0, 1e-12);
  EXPECT_NEAR(Problem::chi(1.0, 0.0), 0.5, 1e-15);
}

TEST(Untangling, noisy_fields_are_unfolded_exactly)
{
  int folded = 0;
  int reversed = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Planar_mesh mesh = plate_with_holes_mesh(0.2);
    const std::vector<Gradient_pair> frames = perturbed(smooth_cross_field(mesh, 0.1), 0.7, seed);
    Seamless_parametrization_options options;
    options.untangle = false;
    const Seamless_map_data raw = compute_map(mesh, frames, {}, options);
    expect_exactly_seamless(mesh, raw);
    EXPECT_EQ(raw.untangling_rounds, 0);
    EXPECT_EQ(raw.flipped_before_untangling, int(raw.flipped_faces.size()));
    folded += !raw.flipped_faces.empty();
    reversed += raw.reversed_edges;
    options.untangle = true;
    const Seamless_map_data map = compute_map(mesh, frames, {}, options);
    expect_exactly_seamless(mesh, map);
    EXPECT_TRUE(map.flipped_faces.empty());
    EXPECT_EQ(map.reversed_edges, 0);
    EXPECT_TRUE(map.misturned_vertices.empty());
    EXPECT_EQ(map.flipped_before_untangling, raw.flipped_before_untangling);
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
      EXPECT_EQ(internal::exact_orientation(map.uv[3 * f], map.uv[3 * f + 1], map.uv[3 * f + 2]), 1);
    EXPECT_LT(map.integration_error, 1.5 * raw.integration_error + 0.05); // still the map of this field
    options.threads = 2;
    EXPECT_EQ(compute_map(mesh, frames, {}, options).uv, map.uv);
  }
  EXPECT_GT(folded, 1); // otherwise this tests nothing
  EXPECT_GT(reversed, 0) << folded;
}

TEST(Untangling, faces_that_the_constraints_flatten_are_told)
{
  // Below the rectangle hangs a triangle whose two lower sides belong to the same straight side as its upper corners.
  Planar_mesh mesh = rectangle_mesh(4, 4);
  mesh.points.emplace_back(0.375, -0.01);
  const int ear = int(mesh.triangles.size());
  mesh.triangles.push_back({1, int(mesh.points.size()) - 1, 2});
  const Seamless_map_data map = compute_map(mesh, sample(mesh, [](auto) { return frame(0.0); }));
  expect_exactly_seamless(mesh, map);
  EXPECT_EQ(map.flipped_faces, std::vector<int>{ear});
  EXPECT_EQ(map.flat_faces, std::vector<int>{ear});
  EXPECT_EQ(map.untangling_rounds, 0); // in vain, so not tried
}

} // namespace
