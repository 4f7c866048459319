// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "map_test_tools.h"

#include <Quadrille/Seamless_parametrization/internal/Cut_graph.h>
#include <Quadrille/Seamless_parametrization/internal/Seamless_constraints.h>

#include <gtest/gtest.h>

namespace {

using namespace Quadrille;
using namespace Quadrille::test;
using internal::Cut_graph;
using internal::Frame_topology;
using internal::Tangent_geometry;

/// Asserts that the cut surface is a disk per component with all singular vertices on its rim, and combed frames.
void expect_disks(const Indexed_triangulation& mesh, const Tangent_geometry& geometry,
                  const std::vector<Gradient_pair>& frames, int n_components)
{
  std::vector<char> constrained;
  for (int h = 0; h < mesh.number_of_halfedges(); ++h)
    constrained.push_back(mesh.is_boundary(h));
  Frame_topology topology = internal::Frame_topology_builder(mesh, geometry, constrained, frames)();
  internal::Quadrant_repair(mesh, topology)();
  const Cut_graph cut = internal::Cut_graph_builder(mesh, geometry, topology)();
  EXPECT_EQ(cut.number_of_components, n_components);

  int cut_sides = 0;
  for (int h = 0; h < mesh.number_of_halfedges(); ++h) {
    if (mesh.is_boundary(h)) {
      EXPECT_FALSE(cut.is_cut[std::size_t(h)]);
      continue;
    }
    EXPECT_EQ(cut.is_cut[std::size_t(h)], cut.is_cut[std::size_t(mesh.opposite(h))]);
    cut_sides += cut.is_cut[std::size_t(h)];
    if (!cut.is_cut[std::size_t(h)]) {
      EXPECT_EQ(cut.combed_matching(topology.matching, mesh, h), 0);
    }
  }
  std::vector<char> on_cut(std::size_t(mesh.number_of_vertices()), 0);
  for (int h = 0; h < mesh.number_of_halfedges(); ++h)
    if (cut.is_cut[std::size_t(h)])
      on_cut[std::size_t(mesh.source(h))] = 1;
  for (int v = 0; v < mesh.number_of_vertices(); ++v)
    if (!mesh.is_boundary_vertex(v) && topology.quarter_index(mesh, v) != 0) {
      EXPECT_TRUE(on_cut[std::size_t(v)]) << "singular vertex " << v;
    }

  std::size_t path_edges = 0;
  for (const Cut_graph::Path& path : cut.paths) {
    path_edges += path.halfedges.size();
    for (std::size_t i = 0; i < path.halfedges.size(); ++i) {
      EXPECT_EQ(cut.combed_matching(topology.matching, mesh, path.halfedges[i]), path.matching);
      if (i > 0) {
        EXPECT_EQ(mesh.source(path.halfedges[i]), mesh.target(path.halfedges[i - 1]));
      }
    }
  }
  EXPECT_EQ(2 * path_edges, std::size_t(cut_sides));

  // Euler characteristic after cutting: one per disk.
  const internal::Seamless_space space = internal::Seamless_constraints(mesh, topology, cut)();
  const int edges = (mesh.number_of_halfedges() + mesh.number_of_boundary_edges() + cut_sides) / 2;
  EXPECT_EQ(space.number_of_copies - edges + mesh.number_of_faces(), n_components);
}

void expect_disks(const Planar_mesh& mesh, const std::vector<Gradient_pair>& frames, int n_components = 1)
{
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  expect_disks(triangulation, internal::planar_geometry(triangulation, mesh.points), frames, n_components);
}

TEST(Cut_graph, domains_without_singularities)
{
  const Planar_mesh square = rectangle_mesh(5, 5);
  expect_disks(square, sample(square, [](auto) { return frame(0.0); }));
  const Planar_mesh annulus = annulus_mesh(3, 24);
  expect_disks(annulus, sample(annulus, polar_frame));
}

TEST(Cut_graph, domains_with_holes_and_singularities)
{
  const Planar_mesh plate = plate_with_holes_mesh(0.2);
  expect_disks(plate, smooth_cross_field(plate));
  for (unsigned seed = 0; seed < 3; ++seed)
    expect_disks(plate, perturbed(smooth_cross_field(plate), 1.2, seed));
}

TEST(Cut_graph, several_components)
{
  Planar_mesh mesh = annulus_mesh(3, 24);
  const Planar_mesh other = transformed(rectangle_mesh(4, 4), 0.2, 1.0, {5.0, 0.0});
  const int offset = int(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const auto& [a, b, c] : other.triangles)
    mesh.triangles.push_back({a + offset, b + offset, c + offset});
  mesh = relabelled(mesh, 5);
  const std::vector<Gradient_pair> frames = perturbed(smooth_cross_field(mesh), 0.8, 2);
  expect_disks(mesh, frames, 2);
  expect_exactly_seamless(mesh, compute_map(mesh, frames));
}

TEST(Cut_graph, closed_surfaces)
{
  for (const bool spherical : {false, true}) {
    const Surface_mesh_arrays cube = cube_surface(6, spherical);
    const Indexed_triangulation triangulation(cube.points.size(), cube.triangles);
    const Tangent_geometry geometry = cube.geometry(triangulation);
    const std::vector<Gradient_pair> frames = cube_frames(cube);
    expect_disks(triangulation, geometry, frames, 1);
    expect_disks(triangulation, geometry, perturbed(frames, 0.7, 4), 1);
    const Seamless_map_data map = internal::Seamless_map_solver(triangulation, geometry, {})(frames);
    expect_exactly_seamless(triangulation, map);
    EXPECT_TRUE(map.flipped_faces.empty());
    if (!spherical) {
      EXPECT_LT(map.integration_error, 1e-20); // developable: each side maps to a unit square
    }
  }
}

TEST(Cut_graph, handles)
{
  // A flat torus: a rectangle of unit cells with opposite sides glued.
  constexpr int nx = 9;
  constexpr int ny = 7;
  const auto vertex = [](int i, int j) { return i % nx + nx * (j % ny); };
  std::vector<std::array<int, 3>> triangles;
  Tangent_geometry geometry;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      geometry.edge_vector.insert(geometry.edge_vector.end(), {{1, 0}, {0, 1}, {-1, -1}, {1, 1}, {-1, 0}, {0, -1}});
    }
  const Indexed_triangulation torus(nx * ny, triangles);
  ASSERT_EQ(torus.euler_characteristic(), 0);
  const std::vector<Gradient_pair> frames(triangles.size(), frame(0.3));
  expect_disks(torus, geometry, frames, 1);
  expect_disks(torus, geometry, perturbed(frames, 1.0, 1), 1);
  const internal::Seamless_map_solver solver(torus, geometry, {});
  const Seamless_map_data map = solver(frames);
  expect_exactly_seamless(torus, map);
  EXPECT_TRUE(map.flipped_faces.empty());
  EXPECT_LT(map.integration_error, 1e-20); // constant frames of any direction integrate
  expect_exactly_seamless(torus, solver(perturbed(frames, 0.9, 6)));
}

} // namespace
