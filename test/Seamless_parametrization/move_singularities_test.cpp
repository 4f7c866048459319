// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "map_test_tools.h"

#include <Quadrille/Seamless_parametrization/internal/move_singularities.h>

#include <gtest/gtest.h>

namespace {

using namespace Quadrille;
using namespace Quadrille::test;

/// Directions for which five squares are glued around a vertex of valence 5 at `centre`, and sizes that shrink by a
/// factor e^`rate` per unit of x against those of the squares glued at the origin.
std::vector<Gradient_pair> graded_frames(const Planar_mesh& mesh, const Eigen::Vector2d& centre, double rate)
{
  return sample(mesh, [&](const Eigen::Vector2d& p) {
    const Eigen::Vector2d direction = power_frame(p - centre, 5).first;
    return frame(std::atan2(direction.y(), direction.x()), std::exp(-rate * p.x()) / power_frame(p, 5).first.norm());
  });
}

/// Around inner vertices matchings add up to the quadrants, modulo 4.
bool matchings_fit_quadrants(const Indexed_triangulation& triangulation, const internal::Frame_topology& topology)
{
  for (int v = 0; v < triangulation.number_of_vertices(); ++v) {
    if (triangulation.is_boundary_vertex(v))
      continue;
    int sum = topology.vertex_quadrants[std::size_t(v)];
    const int start = triangulation.outgoing(v);
    for (int h = triangulation.next_around_source(start);; h = triangulation.next_around_source(h)) {
      sum += topology.matching[std::size_t(triangulation.opposite(h))];
      if (h == start)
        break;
    }
    if (sum % 4 != 0)
      return false;
  }
  return true;
}

TEST(Moving_singularities, a_quadrant_goes_where_the_map_has_it)
{
  const Planar_mesh mesh = glued_squares_mesh(5, 6);
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  Seamless_map_data map = compute_map(mesh, graded_frames(mesh, {0, 0}, 0));
  ASSERT_EQ(map.topology.vertex_quadrants[0], 5);
  // As if the map turned by one quadrant around the singularity, and twice around an inner vertex far from it.
  int target = -1;
  for (int v = 1; v < triangulation.number_of_vertices(); ++v)
    if (!triangulation.is_boundary_vertex(v))
      target = v;
  std::vector<int> turned = map.topology.vertex_quadrants;
  turned[0] = 1;
  turned[std::size_t(target)] = 8;
  EXPECT_EQ(internal::Singularity_mover(triangulation, map.topology)({0, target}, turned), 1);
  EXPECT_EQ(map.topology.vertex_quadrants[0], 4);
  EXPECT_EQ(map.topology.vertex_quadrants[std::size_t(target)], 5);
  EXPECT_TRUE(matchings_fit_quadrants(triangulation, map.topology));
}

TEST(Moving_singularities, nothing_to_move_to)
{
  const Planar_mesh mesh = glued_squares_mesh(5, 4);
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  Seamless_map_data map = compute_map(mesh, graded_frames(mesh, {0, 0}, 0));
  std::vector<int> turned = map.topology.vertex_quadrants;
  turned[0] = 1;
  EXPECT_EQ(internal::Singularity_mover(triangulation, map.topology)({0}, turned), 0);
  EXPECT_EQ(map.topology.vertex_quadrants[0], 5);
}

TEST(Moving_singularities, a_misplaced_one_finds_its_place)
{
  // Such sizes want the singularity on the left. Wherever the frames have it, it ends up there, and the map is valid.
  const Planar_mesh mesh = glued_squares_mesh(5, 16);
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  for (const Eigen::Vector2d& centre : {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.2, 0.08),
                                        Eigen::Vector2d(0.1, -0.3), Eigen::Vector2d(-0.4, -0.16)}) {
    SCOPED_TRACE(centre.transpose());
    const auto frames = graded_frames(mesh, centre, 2);
    Seamless_parametrization_options as_it_is;
    as_it_is.move_singularities = false;
    const Seamless_map_data fixed = compute_map(mesh, frames, {}, as_it_is);
    EXPECT_FALSE(fixed.flipped_faces.empty() && fixed.misturned_vertices.empty());
    EXPECT_EQ(fixed.moved_singularities, 0);
    const Seamless_map_data map = compute_map(mesh, frames);
    EXPECT_TRUE(map.flipped_faces.empty());
    EXPECT_TRUE(map.misturned_vertices.empty());
    EXPECT_GT(map.moved_singularities, 0);
    expect_exactly_seamless(mesh, map);
    EXPECT_EQ(singularities(mesh, map), (std::map<int, int>{{5, 1}}));
    for (int v = 0; v < triangulation.number_of_vertices(); ++v)
      if (map.topology.vertex_quadrants[std::size_t(v)] == 5) {
        EXPECT_LT((mesh.points[std::size_t(v)] - Eigen::Vector2d(-0.6, 0.0)).norm(), 0.2); // three edges
      }
  }
}

TEST(Moving_singularities, next_to_a_curve_a_quadrant_goes_to_the_end_where_the_map_turns_further)
{
  const Planar_mesh mesh = glued_squares_mesh(5, 6);
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  for (const bool is_at_source : {true, false}) {
    Seamless_map_data map = compute_map(mesh, graded_frames(mesh, {0, 0}, 0));
    // A triangle with one side on the boundary, whose apex has the singularity.
    int side = -1;
    for (int h = 0; h < triangulation.number_of_halfedges(); ++h)
      if (triangulation.is_boundary(h) &&
          !triangulation.is_boundary_vertex(triangulation.source(Indexed_triangulation::prev(h))))
        side = h;
    ASSERT_GE(side, 0);
    const int apex = triangulation.source(Indexed_triangulation::prev(side));
    std::vector<int> turned = map.topology.vertex_quadrants;
    turned[0] = 1;
    turned[std::size_t(apex)] = 8;
    ASSERT_EQ(internal::Singularity_mover(triangulation, map.topology)({0, apex}, turned), 1);
    const std::vector<int> before = map.topology.vertex_quadrants;
    ASSERT_EQ(before[std::size_t(apex)], 5);
    // The neighbour at one end turns by nearly 180 degrees there.
    const int beyond = triangulation.opposite(is_at_source ? Indexed_triangulation::prev(side)   // source to apex
                                                           : Indexed_triangulation::next(side)); // apex to target
    const int corner = is_at_source ? beyond : Indexed_triangulation::next(beyond); // of the neighbour, on the boundary
    map.uv[std::size_t(corner)] = 0.5 * (map.uv[std::size_t(Indexed_triangulation::next(corner))] +
                                         map.uv[std::size_t(Indexed_triangulation::prev(corner))]);
    EXPECT_EQ(internal::Singularity_mover(triangulation, map.topology).hand_to_curves({side / 3}, map.uv), 1);
    const int end = is_at_source ? triangulation.source(side) : triangulation.target(side);
    EXPECT_EQ(triangulation.source(corner), end);
    for (int v = 0; v < triangulation.number_of_vertices(); ++v)
      EXPECT_EQ(map.topology.vertex_quadrants[std::size_t(v)] - before[std::size_t(v)], v == end    ? 1
                                                                                        : v == apex ? -1
                                                                                                    : 0);
    EXPECT_EQ(map.topology.repaired_vertices, std::vector<int>{end});
    EXPECT_TRUE(matchings_fit_quadrants(triangulation, map.topology));
    for (const auto& sector : map.topology.sectors)
      if (sector.vertex == end) {
        EXPECT_EQ(sector.quadrants, map.topology.vertex_quadrants[std::size_t(end)]);
      }
  }
}

} // namespace
