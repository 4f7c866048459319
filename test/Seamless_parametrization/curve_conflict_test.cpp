// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "map_test_tools.h"

#include <Quadrille/Seamless_parametrization/internal/Curve_conflict_resolver.h>

#include <gtest/gtest.h>

namespace {

using namespace Quadrille;
using namespace Quadrille::test;
using internal::Curve_conflict;
using internal::Frame_topology;

using Resolver = internal::Curve_conflict_resolver<Cholesky_solver>;

/// A ring with a hole between its two circles, and polar frames.
struct Ring {
  explicit Ring(const std::vector<Eigen::Vector2d>& hole, double scale = 1.0)
      : mesh(transformed(delaunay_mesh({circle_polygon({0, 0}, 1.0, 40), circle_polygon({0, 0}, 2.0, 40), hole}, 0.2),
                         0.0, scale)),
        triangulation(mesh.points.size(), mesh.triangles),
        geometry(internal::planar_geometry(triangulation, mesh.points)), frames(sample(mesh, polar_frame)),
        topology(internal::Seamless_map_solver(triangulation, geometry, {}).topology(frames))
  {
  }

  int vertex_at(const Eigen::Vector2d& p) const
  {
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
      if (mesh.points[v] == p)
        return int(v);
    return -1;
  }

  int quadrants_at(const Frame_topology& of, const Eigen::Vector2d& p) const
  {
    return of.vertex_quadrants[std::size_t(vertex_at(p))];
  }

  Planar_mesh mesh;
  Indexed_triangulation triangulation;
  internal::Tangent_geometry geometry;
  std::vector<Gradient_pair> frames;
  Frame_topology topology;
};

Eigen::Vector2d polar(double radius, double angle) { return {radius * std::cos(angle), radius * std::sin(angle)}; }

const Eigen::Vector2d inner = polar(1.4, 0.0), outer = polar(1.7, 0.0), tip = polar(1.7, 0.4);

/// Bounded by a radial side, an arc, and one that rises so little from the first one's inner end to the arc's other end
/// that frames are along it: two sides of the same v meet, and leave no length to the first one. (Without the circles,
/// v could grow around the hole.)
std::vector<Eigen::Vector2d> wedge()
{
  std::vector<Eigen::Vector2d> polygon{inner, outer};
  for (int i = 1; i <= 4; ++i)
    polygon.push_back(polar(1.7, 0.1 * i));
  for (int i = 3; i >= 1; --i)
    polygon.push_back(polar(1.4 + 0.06 * i, 0.1 * i));
  return polygon;
}

/// The same with a second radial side.
std::vector<Eigen::Vector2d> ring_sector()
{
  std::vector<Eigen::Vector2d> polygon{inner, outer};
  for (int i = 1; i <= 4; ++i)
    polygon.push_back(polar(1.7, 0.1 * i));
  for (int i = 4; i >= 1; --i)
    polygon.push_back(polar(1.4, 0.1 * i));
  return polygon;
}

TEST(Curve_conflicts, there_is_none_around_a_hole_with_opposite_sides)
{
  Ring ring(ring_sector());
  const Resolver resolve(ring.triangulation, ring.geometry, ring.frames);
  EXPECT_TRUE(resolve.conflict(ring.topology).halfedges.empty());
  const Frame_topology before = ring.topology;
  EXPECT_TRUE(resolve(ring.topology).halfedges.empty());
  EXPECT_EQ(ring.topology.matching, before.matching);
  EXPECT_EQ(ring.topology.vertex_quadrants, before.vertex_quadrants);
  EXPECT_TRUE(ring.topology.repaired_vertices.empty());
}

TEST(Curve_conflicts, sides_of_the_same_v_that_meet_leave_no_length_to_the_third_one)
{
  for (const double scale : {1.0, 1e8, 1e-8}) {
    const Ring ring(wedge(), scale);
    ASSERT_EQ(ring.quadrants_at(ring.topology, scale * outer), 3);
    ASSERT_EQ(ring.quadrants_at(ring.topology, scale * inner), 3);
    ASSERT_EQ(ring.quadrants_at(ring.topology, scale * tip), 4);
    const Curve_conflict conflict = Resolver(ring.triangulation, ring.geometry, ring.frames).conflict(ring.topology);
    // It is about the radial side's edges, and no others: together they have the length 0.
    int n_edges = 0;
    for (int h = 0; h < ring.triangulation.number_of_halfedges(); ++h) {
      const auto is_radial = [&](int v) {
        const Eigen::Vector2d p = ring.mesh.points[std::size_t(v)] / scale;
        return std::abs(p.y()) < 1e-12 && p.x() > 1.39 && p.x() < 1.71;
      };
      if (ring.triangulation.is_boundary(h) && is_radial(ring.triangulation.source(h)) &&
          is_radial(ring.triangulation.target(h))) {
        ++n_edges;
        EXPECT_EQ(std::count(conflict.halfedges.begin(), conflict.halfedges.end(), h), 1);
      }
    }
    EXPECT_GT(n_edges, 1);
    EXPECT_EQ(int(conflict.halfedges.size()), n_edges);
    EXPECT_GT(conflict.extent, 1.0); // that of the edge that misses most
    EXPECT_LE(conflict.extent, n_edges + 1e-6);
  }
}

TEST(Curve_conflicts, residuals_at_the_minimum_are_a_certificate)
{
  const Ring ring(wedge());
  const internal::Cut_graph cut = internal::Cut_graph_builder(ring.triangulation, ring.geometry, ring.topology)();
  const internal::Seamless_space space = internal::Seamless_constraints(ring.triangulation, ring.topology, cut)();
  const std::vector<internal::Aligned_halfedge> edges = internal::aligned_halfedges(ring.topology, cut);
  internal::Curve_length_problem problem(ring.geometry, ring.frames, edges, space);
  Eigen::VectorXd y = Eigen::VectorXd::Constant(problem.number_of_parameters(), 0.3);
  const double energy = problem.linearize(y);
  EXPECT_DOUBLE_EQ(energy, problem.energy(y));
  const Eigen::VectorXd slope = problem.gradient();
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const double step = 1e-6;
    Eigen::VectorXd ahead = y, behind = y;
    ahead[i] += step;
    behind[i] -= step;
    EXPECT_NEAR((problem.energy(ahead) - problem.energy(behind)) / (2.0 * step), slope[i],
                1e-6 * (1.0 + std::abs(slope[i])));
  }
  Levenberg_marquardt_options options;
  options.max_iterations = 60;
  minimize_levenberg_marquardt<internal::Curve_length_problem, Cholesky_solver>(problem, y, options);
  problem.linearize(y);
  EXPECT_LT(problem.gradient().lpNorm<Eigen::Infinity>(), 1e-5); // A^T r = 0 with r >= 0 and r != 0
  EXPECT_GT(problem.residuals(y).maxCoeff(), 1.0 - 1e-6);
}

TEST(Curve_conflicts, a_corner_that_admits_it_gets_another_number_of_quadrants)
{
  Ring ring(wedge());
  const Frame_topology before = ring.topology;
  const Curve_conflict rest = Resolver(ring.triangulation, ring.geometry, ring.frames)(ring.topology);
  EXPECT_TRUE(rest.halfedges.empty());
  for (const Eigen::Vector2d& corner : {inner, outer, tip})
    EXPECT_EQ(ring.quadrants_at(ring.topology, corner), 3);
  EXPECT_EQ(ring.topology.repaired_vertices, std::vector<int>{ring.vertex_at(tip)});
  int n_changed = 0, sum = 0, sum_before = 0;
  for (std::size_t v = 0; v < before.vertex_quadrants.size(); ++v) {
    n_changed += ring.topology.vertex_quadrants[v] != before.vertex_quadrants[v];
    sum += ring.topology.vertex_quadrants[v];
    sum_before += before.vertex_quadrants[v];
  }
  EXPECT_EQ(n_changed, 2); // it and the vertex that has the quadrant now
  EXPECT_EQ(sum, sum_before);
}

TEST(Curve_conflicts, maps_are_valid_once_they_are_resolved)
{
  const Ring ring(wedge());
  Seamless_parametrization_options options;
  const Seamless_map_data map = compute_map(ring.mesh, ring.frames, {}, options);
  expect_exactly_seamless(ring.mesh, map);
  EXPECT_EQ(map.n_invalid(), 0U);
  EXPECT_EQ(ring.quadrants_at(map.topology, tip), 3);
  EXPECT_EQ(singularities(ring.mesh, map), (std::map<int, int>{{5, 1}}));
  options.repair_corners = false;
  const Seamless_map_data as_told = compute_map(ring.mesh, ring.frames, {}, options);
  EXPECT_EQ(ring.quadrants_at(as_told.topology, tip), 4);
  EXPECT_GT(as_told.n_invalid(), 0U);
}

} // namespace
