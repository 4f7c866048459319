// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "tetrahedral_test_meshes.h"

#include <Quadrille/Singular_graph.h>
#include <Quadrille/volumetric_cross_field.h>

#include <gtest/gtest.h>

#include <bitset>
#include <random>

namespace {

using namespace Quadrille;
using Valence = Singular_graph::Valence;

Singular_graph graph_of(const Tetrahedral_mesh& mesh, std::uint64_t seed = 0, double crease_angle = 40)
{
  Crease_options creases;
  creases.crease_angle = crease_angle;
  Cross_field_options options;
  options.seed = seed;
  return singular_graph(mesh, volumetric_cross_field(mesh, align_with_boundary(mesh, creases), options).frames);
}

void expect_lines(const Singular_graph& graph, std::size_t n, Valence valence)
{
  EXPECT_EQ(graph.arcs.size(), n);
  EXPECT_EQ(graph.number_of_arcs(valence), n);
  EXPECT_EQ(graph.boundary_ends, 2 * n);
  EXPECT_EQ(graph.loops, 0u);
  EXPECT_TRUE(graph.nodes.empty());
  EXPECT_TRUE(graph.is_hex_meshable());
}

TEST(Singular_graph, box_has_none) { expect_lines(graph_of(cube_of_tetrahedra(6)), 0, Valence::three); }

TEST(Singular_graph, triangular_prism_has_a_line_of_valence_3)
{
  const Singular_graph graph = graph_of(prism_of_tetrahedra(polygon_of_triangles(regular_polygon(3), 8), 8, 1.5));
  expect_lines(graph, 1, Valence::three);
  for (const Eigen::Vector3d& p : graph.arcs[0].points)
    EXPECT_LT(std::hypot(p.x(), p.y()), 0.2); // in the middle
  for (const double alignment : graph.arcs[0].alignment)
    EXPECT_LT(alignment, -0.9);
  EXPECT_NEAR(graph.arcs[0].length, 1.5, 0.1);
}

TEST(Singular_graph, pentagonal_prism_has_a_line_of_valence_5)
{
  const Singular_graph graph = graph_of(prism_of_tetrahedra(polygon_of_triangles(regular_polygon(5), 8), 8, 1.5));
  expect_lines(graph, 1, Valence::five);
  for (const double alignment : graph.arcs[0].alignment)
    EXPECT_GT(alignment, 0.9);
}

TEST(Singular_graph, cylinder_has_four_lines_of_valence_3)
{
  expect_lines(graph_of(prism_of_tetrahedra(disk_of_triangles(7), 10, 2.0)), 4, Valence::three);
}

TEST(Singular_graph, solid_torus_has_four_loops_of_valence_3)
{
  const Singular_graph graph = graph_of(torus_of_tetrahedra(6, 60, 3));
  EXPECT_EQ(graph.arcs.size(), 4u);
  EXPECT_EQ(graph.loops, 4u);
  EXPECT_EQ(graph.number_of_arcs(Valence::three), 4u);
  EXPECT_EQ(graph.boundary_ends, 0u);
}

TEST(Singular_graph, ball_has_a_cube_of_twelve_arcs_with_eight_to_the_boundary)
{
  for (const std::uint64_t seed : {0, 1, 2}) {
    const Singular_graph graph = graph_of(ball_of_tetrahedra(16), seed);
    EXPECT_EQ(graph.arcs.size(), 20u) << seed;
    EXPECT_EQ(graph.number_of_arcs(Valence::three), 20u) << seed;
    EXPECT_EQ(graph.boundary_ends, 8u) << seed;
    EXPECT_EQ(graph.loops, 0u) << seed;
    EXPECT_EQ(graph.nodes_by_degree(), (std::map<int, std::size_t>{{4, 8}})) << seed;
    EXPECT_TRUE(graph.is_hex_meshable());
    std::size_t long_ones = 0;
    for (const Singular_graph::Arc& arc : graph.arcs)
      long_ones += arc.from != Singular_graph::at_boundary && arc.to != Singular_graph::at_boundary ? 1 : 0;
    EXPECT_EQ(long_ones, 12u) << seed;
  }
}

TEST(Singular_graph, is_made_of_paths_between_its_nodes)
{
  const Singular_graph graph = graph_of(ball_of_tetrahedra(16));
  for (std::size_t a = 0; a < graph.arcs.size(); ++a) {
    const Singular_graph::Arc& arc = graph.arcs[a];
    EXPECT_EQ(arc.points.size(), arc.alignment.size());
    for (const int node : {arc.from, arc.to})
      if (node != Singular_graph::at_boundary) {
        const std::vector<int>& arcs = graph.nodes[std::size_t(node)].arcs;
        EXPECT_NE(std::find(arcs.begin(), arcs.end(), int(a)), arcs.end());
      }
    if (arc.from != Singular_graph::at_boundary) {
      EXPECT_EQ(arc.points.front(), graph.nodes[std::size_t(arc.from)].point);
    }
    double length = 0;
    for (std::size_t i = 1; i < arc.points.size(); ++i)
      length += (arc.points[i] - arc.points[i - 1]).norm();
    EXPECT_NEAR(arc.length, length, 1e-12);
  }
}

/// A field whose frames turn by k quarters about the z axis around it, wherever the mesh is.
std::vector<Eigen::Matrix3d> turning(const Tetrahedral_mesh& mesh, int quarters)
{
  std::vector<Eigen::Matrix3d> frames(mesh.number_of_vertices());
  for (std::size_t v = 0; v < frames.size(); ++v) {
    const Eigen::Vector3d p = mesh.point(v);
    frames[v] = Eigen::AngleAxisd(quarters / 4.0 * std::atan2(p.y() - 0.01, p.x() + 0.02), Eigen::Vector3d::UnitZ());
  }
  return frames;
}

TEST(Singular_graph, tells_valences_of_known_fields)
{
  const Tetrahedral_mesh mesh = prism_of_tetrahedra(disk_of_triangles(5), 5, 1.0);
  expect_lines(singular_graph(mesh, turning(mesh, 1)), 1, Valence::three);
  expect_lines(singular_graph(mesh, turning(mesh, -1)), 1, Valence::five);
  // A half turn is more than the three edges of a face can tell: it becomes two quarters.
  expect_lines(singular_graph(mesh, turning(mesh, 2)), 2, Valence::three);
  expect_lines(singular_graph(mesh, turning(mesh, -2)), 2, Valence::five);
  EXPECT_TRUE(singular_graph(mesh, turning(mesh, 0)).arcs.empty());
}

TEST(Singular_graph, tells_compound_arcs)
{
  // Around the z axis the frames turn by 120 degrees about their own diagonal, which lies along z.
  const Tetrahedral_mesh mesh = prism_of_tetrahedra(disk_of_triangles(5), 5, 1.0);
  const Eigen::Matrix3d start =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d(1, 1, 1), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  std::vector<Eigen::Matrix3d> frames(mesh.number_of_vertices());
  for (std::size_t v = 0; v < frames.size(); ++v) {
    const Eigen::Vector3d p = mesh.point(v);
    frames[v] = Eigen::AngleAxisd(std::atan2(p.y() - 0.01, p.x() + 0.02) / 3, Eigen::Vector3d::UnitZ()) * start;
  }
  const Singular_graph graph = singular_graph(mesh, frames);
  ASSERT_EQ(graph.arcs.size(), 1u);
  EXPECT_EQ(graph.arcs[0].valence, Valence::compound);
  ASSERT_EQ(graph.obstacles.size(), 1u);
  EXPECT_EQ(graph.obstacles[0].arc, 0);
}

TEST(Singular_graph, tells_arcs_that_change_from_3_to_5)
{
  // The frames turn by a quarter about the x axis around a curve that comes along x and goes back: half an ellipse.
  const Tetrahedral_mesh mesh = box_of_tetrahedra({12, 16, 8}, Eigen::Vector3d(1.5, 2, 1));
  std::vector<Eigen::Matrix3d> frames(mesh.number_of_vertices());
  for (std::size_t v = 0; v < frames.size(); ++v) {
    const Eigen::Vector3d p = mesh.point(v);
    // Two opposite half turns of phase, about (y, z) = (0.5, 0.5) and (1.5, 0.5), meet far from x = 0.
    const double first = std::atan2(p.z() - 0.51, p.y() - 0.52), second = std::atan2(p.z() - 0.51, p.y() - 1.49);
    const double reach = 1 / (1 + std::exp(12 * (p.x() - 0.75)));
    double phase = first - second;
    phase = std::remainder(phase, 2 * std::acos(-1.0));
    frames[v] = Eigen::AngleAxisd(0.25 * phase * reach, Eigen::Vector3d::UnitX());
  }
  const Singular_graph graph = singular_graph(mesh, frames);
  ASSERT_EQ(graph.arcs.size(), 1u);
  EXPECT_EQ(graph.arcs[0].valence, Valence::mixed);
  EXPECT_FALSE(graph.is_hex_meshable());
}

TEST(Singular_graph, no_tetrahedron_has_exactly_one_singular_face)
{
  const Tetrahedral_mesh mesh = cube_of_tetrahedra(14);
  std::mt19937 engine(4);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Matrix3d> frames(mesh.number_of_vertices());
  for (Eigen::Matrix3d& frame : frames)
    frame = Eigen::Quaterniond(normal(engine), normal(engine), normal(engine), normal(engine))
                .normalized()
                .toRotationMatrix();
  std::array<std::size_t, 5> counts{};
  for (const unsigned char faces :
       internal::singular_faces(mesh, internal::Edge_matcher(frames, Metric_connection()), 1))
    ++counts[std::bitset<4>(faces).count()];
  EXPECT_EQ(counts[1], 0u);
  for (const int n : {0, 2, 3, 4})
    EXPECT_GT(counts[std::size_t(n)], 0u);
}

TEST(Singular_graph, does_not_depend_on_which_axes_come_first)
{
  const Tetrahedral_mesh mesh = ball_of_tetrahedra(10);
  const std::vector<Eigen::Matrix3d> frames = volumetric_cross_field(mesh, align_with_boundary(mesh)).frames;
  std::vector<Eigen::Matrix3d> renamed = frames;
  std::mt19937 engine(5);
  for (Eigen::Matrix3d& frame : renamed)
    frame = (frame * Octahedral_rotation(int(engine() % 24)).matrix()).eval();
  const Singular_graph a = singular_graph(mesh, frames), b = singular_graph(mesh, renamed);
  ASSERT_EQ(a.arcs.size(), b.arcs.size());
  for (std::size_t i = 0; i < a.arcs.size(); ++i) {
    EXPECT_EQ(a.arcs[i].valence, b.arcs[i].valence);
    EXPECT_EQ(a.arcs[i].tetrahedra, b.arcs[i].tetrahedra);
  }
}

} // namespace
