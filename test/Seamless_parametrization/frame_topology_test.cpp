// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "map_test_tools.h"

#include <Quadrille/Seamless_parametrization/internal/Frame_topology.h>
#include <Quadrille/Seamless_parametrization/internal/repair_quadrants.h>

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace Quadrille;
using namespace Quadrille::test;
using internal::Frame_topology;

Frame_topology frame_topology(const Planar_mesh& mesh, const std::vector<Gradient_pair>& frames,
                              std::vector<char> constrained = {})
{
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  const internal::Tangent_geometry geometry = internal::planar_geometry(triangulation, mesh.points);
  constrained.resize(std::size_t(triangulation.number_of_halfedges()), 0);
  for (int h = 0; h < triangulation.number_of_halfedges(); ++h)
    if (triangulation.is_boundary(h))
      constrained[std::size_t(h)] = 1;
  return internal::Frame_topology_builder(triangulation, geometry, constrained, frames)();
}

TEST(Frame_topology, matchings_turn_frames_into_their_neighbours)
{
  const Planar_mesh mesh = rectangle_mesh(6, 5);
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  const std::vector<Gradient_pair> frames = perturbed(sample(mesh, [](auto) { return frame(0.2); }), 0.3, 7);
  const Frame_topology topology = frame_topology(mesh, frames);
  for (int h = 0; h < triangulation.number_of_halfedges(); ++h) {
    const int k = topology.matching[std::size_t(h)];
    if (triangulation.is_boundary(h)) {
      EXPECT_EQ(k, 0);
      continue;
    }
    const int opposite = triangulation.opposite(h);
    EXPECT_EQ((k + topology.matching[std::size_t(opposite)]) % 4, 0);
    // Directions differ by at most 0.6 after the right turn, so they are nearer than by any other.
    const Gradient_pair turned = internal::rotate_quarters(frames[std::size_t(h / 3)], k);
    EXPECT_GT(turned.first.normalized().dot(frames[std::size_t(opposite / 3)].first.normalized()), std::cos(0.61));
  }
}

TEST(Frame_topology, ties_are_antisymmetric_and_keep_the_index_sum)
{
  const Planar_mesh mesh = rectangle_mesh(5, 5);
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  std::vector<Gradient_pair> frames;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    frames.push_back(frame(f % 2 == 0 ? 0.0 : 0.25 * pi));
  const Frame_topology topology = frame_topology(mesh, frames);
  int sum = 0;
  for (int v = 0; v < triangulation.number_of_vertices(); ++v)
    sum += topology.quarter_index(triangulation, v);
  EXPECT_EQ(sum, 4);
  for (int h = 0; h < triangulation.number_of_halfedges(); ++h)
    if (!triangulation.is_boundary(h)) {
      EXPECT_EQ((topology.matching[std::size_t(h)] + topology.matching[std::size_t(triangulation.opposite(h))]) % 4, 0);
    }
}

TEST(Frame_topology, index_of_conformal_powers)
{
  for (const int quadrants : {3, 5, 6}) {
    const Planar_mesh mesh = glued_squares_mesh(quadrants, 6);
    const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
    const Frame_topology topology =
        frame_topology(mesh, sample(mesh, [&](const auto& p) { return power_frame(p, quadrants); }));
    EXPECT_EQ(topology.quarter_index(triangulation, 0), 4 - quadrants);
    for (int v = 1; v < triangulation.number_of_vertices(); ++v) {
      const int index = topology.quarter_index(triangulation, v);
      if (index == 0)
        continue;
      EXPECT_TRUE(triangulation.is_boundary_vertex(v));
      EXPECT_EQ(index, 1); // the corners of the squares
    }
  }
}

TEST(Frame_topology, indices_do_not_depend_on_lengths_or_quarter_turns)
{
  const Planar_mesh mesh = plate_with_holes_mesh(0.2);
  const std::vector<Gradient_pair> frames = smooth_cross_field(mesh);
  std::vector<Gradient_pair> stretched = perturbed(frames, 0.0, 3);
  for (std::size_t f = 0; f < stretched.size(); ++f)
    stretched[f] = {stretched[f].first * 1e9, stretched[f].second * (1e-9 + double(f))};
  EXPECT_EQ(frame_topology(mesh, frames).vertex_quadrants, frame_topology(mesh, stretched).vertex_quadrants);
}

TEST(Frame_topology, index_sum_is_the_euler_characteristic)
{
  for (unsigned seed = 0; seed < 4; ++seed) { // noise has many singularities
    const Planar_mesh mesh = plate_with_holes_mesh(0.25);
    const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
    const Frame_topology topology = frame_topology(mesh, perturbed(smooth_cross_field(mesh), 1.5, seed));
    int sum = 0;
    int sectors = 0;
    for (int v = 0; v < triangulation.number_of_vertices(); ++v)
      sum += topology.quarter_index(triangulation, v);
    for (const Frame_topology::Sector& sector : topology.sectors)
      sectors += sector.quadrants;
    EXPECT_EQ(sum, 4 * triangulation.euler_characteristic());
    EXPECT_EQ(sectors, 2 * triangulation.number_of_faces()); // the angles of the triangles, in quarters
  }
}

TEST(Frame_topology, closed_surfaces)
{
  const Surface_mesh_arrays cube = cube_surface(5, false);
  const Indexed_triangulation triangulation(cube.points.size(), cube.triangles);
  const internal::Tangent_geometry geometry = cube.geometry(triangulation);
  const std::vector<char> none(std::size_t(triangulation.number_of_halfedges()), 0);
  const Frame_topology topology =
      internal::Frame_topology_builder(triangulation, geometry, none, perturbed(cube_frames(cube), 0.2, 1))();
  int corners = 0;
  for (int v = 0; v < triangulation.number_of_vertices(); ++v) {
    const bool corner = std::abs(cube.points[std::size_t(v)].squaredNorm() - 0.75) < 1e-9;
    EXPECT_EQ(topology.quarter_index(triangulation, v), corner ? 1 : 0);
    corners += corner;
  }
  EXPECT_EQ(corners, 8);
}

TEST(Frame_topology, quadrants_of_the_corners_of_an_l)
{
  const Planar_mesh mesh = l_shape_mesh(0.3);
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  const Frame_topology topology = frame_topology(mesh, sample(mesh, [](auto) { return frame(0.0); }));
  for (int v = 0; v < triangulation.number_of_vertices(); ++v) {
    const Eigen::Vector2d& p = mesh.points[std::size_t(v)];
    const bool concave = p == Eigen::Vector2d(1, 1);
    const bool corner = p == Eigen::Vector2d(0, 0) || p == Eigen::Vector2d(2, 0) || p == Eigen::Vector2d(2, 1) ||
                        p == Eigen::Vector2d(1, 2) || p == Eigen::Vector2d(0, 2);
    const int regular = triangulation.is_boundary_vertex(v) ? 2 : 4;
    EXPECT_EQ(topology.vertex_quadrants[std::size_t(v)], concave ? 3 : corner ? 1 : regular);
  }
}

TEST(Frame_topology, sectors_between_feature_edges)
{
  const Planar_mesh mesh = rectangle_mesh(4, 4);
  const auto on_cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return (a.x() == 0.5 && b.x() == 0.5) || (a.y() == 0.5 && b.y() == 0.5 && std::max(a.x(), b.x()) <= 0.5);
  };
  const Frame_topology topology =
      frame_topology(mesh, sample(mesh, [](auto) { return frame(0.1); }), edges_where(mesh, on_cross));
  std::vector<int> quadrants; // of the vertex where three feature lines meet
  for (const Frame_topology::Sector& sector : topology.sectors)
    if (mesh.points[std::size_t(sector.vertex)] == Eigen::Vector2d(0.5, 0.5))
      quadrants.push_back(sector.quadrants);
  std::sort(quadrants.begin(), quadrants.end());
  EXPECT_EQ(quadrants, (std::vector<int>{1, 1, 2}));
}

TEST(Frame_topology, rejects_frames_that_are_none)
{
  const Planar_mesh mesh = rectangle_mesh(2, 2);
  std::vector<Gradient_pair> frames(mesh.triangles.size(), frame(0.0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Gradient_pair& bad : {Gradient_pair({1, 0}, {0, -1}), Gradient_pair({1, 0}, {2, 0}),
                                   Gradient_pair({0, 0}, {0, 1}), Gradient_pair({nan, 0}, {0, 1})}) {
    frames[3] = bad;
    try {
      frame_topology(mesh, frames);
      FAIL() << "accepted";
    } catch (const Invalid_input_error& error) {
      EXPECT_NE(std::string(error.what()).find("face 3"), std::string::npos) << error.what();
    }
  }
}

TEST(Quadrant_repair, sharp_corner_receives_a_quadrant_from_the_interior)
{
  // Both sides of the 11 degree corner at the origin are nearest to the same direction of the frame.
  const Planar_mesh mesh = delaunay_mesh({{{0, 0}, {4, 0}, {4, 0.8}}}, 0.15);
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  const auto frames = sample(mesh, [](auto) { return frame(0.1); });
  Frame_topology topology = frame_topology(mesh, frames);
  std::size_t tip = 0;
  while (mesh.points[tip] != Eigen::Vector2d(0, 0))
    ++tip;
  EXPECT_EQ(topology.vertex_quadrants[tip], 0);
  EXPECT_TRUE(internal::Quadrant_repair(triangulation, topology)().empty());
  EXPECT_EQ(topology.vertex_quadrants[tip], 1);
  EXPECT_EQ(topology.repaired_vertices, std::vector<int>{int(tip)});
  int sum = 0;
  for (int v = 0; v < triangulation.number_of_vertices(); ++v) {
    sum += topology.quarter_index(triangulation, v);
    EXPECT_GE(topology.vertex_quadrants[std::size_t(v)], 1);
  }
  EXPECT_EQ(sum, 4);

  const Seamless_map_data map = compute_map(mesh, frames);
  expect_exactly_seamless(mesh, map);
  EXPECT_EQ(singularities(mesh, map), (std::map<int, int>{{3, 1}}));
  EXPECT_TRUE(map.flipped_faces.empty());

  Seamless_parametrization_options options;
  options.repair_corners = false;
  try {
    compute_map(mesh, frames, {}, options);
    FAIL() << "a corner without a quadrant was accepted";
  } catch (const No_result_error& error) {
    EXPECT_EQ(error.stage(), "map");
    EXPECT_NE(std::string(error.what()).find("vertex " + std::to_string(tip)), std::string::npos) << error.what();
  }
}

TEST(Quadrant_repair, takes_from_the_boundary_when_there_is_no_interior)
{
  Planar_mesh mesh; // one strip of triangles, sharp at the left
  mesh.points = {{0, 0}, {2, 0}, {4, 0}, {4, 0.8}, {2, 0.4}};
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}};
  const Seamless_map_data map = compute_map(mesh, sample(mesh, [](auto) { return frame(0.1); }));
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  expect_exactly_seamless(mesh, map);
  for (const Frame_topology::Sector& sector : map.topology.sectors)
    EXPECT_GE(sector.quadrants, 1);
}

TEST(Quadrant_repair, straight_sides_do_not_become_corners)
{
  // The frames of a few triangles at the middle of the lower side are turned: their edges there align across the side.
  const Planar_mesh mesh = rectangle_mesh(12, 12);
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  const auto frames = sample(mesh, [](const Eigen::Vector2d& p) {
    const double r = (p - Eigen::Vector2d(0.5, 0.0)).norm();
    return frame(r < 0.15 ? 0.3 * pi : r < 0.25 ? 0.15 * pi : 0.0);
  });
  Frame_topology topology = frame_topology(mesh, frames);
  std::vector<int> before;
  for (int v = 0; v < triangulation.number_of_vertices(); ++v)
    if (triangulation.is_boundary_vertex(v) && topology.vertex_quadrants[std::size_t(v)] == 3)
      before.push_back(v);
  ASSERT_FALSE(before.empty());
  EXPECT_TRUE(internal::Quadrant_repair(triangulation, topology)().empty());
  int sum = 0;
  for (const Frame_topology::Sector& sector : topology.sectors) {
    sum += sector.quadrants;
    const Eigen::Vector2d& p = mesh.points[std::size_t(sector.vertex)];
    if (sector.constrained) {
      const bool corner = (p.x() == 0.0 || p.x() == 1.0) && (p.y() == 0.0 || p.y() == 1.0);
      EXPECT_EQ(sector.quadrants, corner ? 1 : 2);
    }
  }
  EXPECT_EQ(sum, 2 * triangulation.number_of_faces());
  const Seamless_map_data map = compute_map(mesh, frames);
  expect_exactly_seamless(mesh, map);
  EXPECT_TRUE(map.flipped_faces.empty());
  EXPECT_FALSE(map.topology.repaired_vertices.empty());
}

} // namespace
