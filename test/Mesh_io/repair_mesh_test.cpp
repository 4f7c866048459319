// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "quad_test_meshes.h"

#include <Quadrille/Surface_domain.h>
#include <Quadrille/repair_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

using namespace Quadrille;

namespace {

/// The sphere in triangles, as a mesh that has nothing to repair.
Labelled_mesh sphere(int n = 4)
{
  Labelled_mesh mesh = sphere_of_quads(n);
  Mesh_repair_report report;
  return repair_mesh(mesh, report); // divides the quads
}

/// Where the points below z = 0 begin: every triangle that reaches below has points of its own, `gap` lower.
Labelled_mesh split_along_equator(Labelled_mesh mesh, double gap)
{
  std::vector<int> copy(mesh.points.size(), -1);
  for (std::vector<int>& polygon : mesh.polygons)
    if (std::any_of(polygon.begin(), polygon.end(), [&](int v) { return mesh.points[std::size_t(v)][2] < -1e-9; }))
      for (int& v : polygon) {
        if (copy[std::size_t(v)] < 0) {
          copy[std::size_t(v)] = int(mesh.points.size());
          std::array<double, 3> p = mesh.points[std::size_t(v)];
          p[2] -= gap;
          mesh.points.push_back(p);
        }
        v = copy[std::size_t(v)];
      }
  return mesh;
}

std::string message_of(const std::function<void()>& action)
{
  try {
    action();
  } catch (const Invalid_input_error& error) {
    return error.what();
  }
  return "";
}

int euler_characteristic(const Surface_domain& domain)
{
  return int(domain.mesh.number_of_vertices()) - int(domain.mesh.number_of_edges()) +
         int(domain.mesh.number_of_faces());
}

TEST(Repair_mesh, leaves_what_is_whole_as_it_is)
{
  const Labelled_mesh mesh = sphere();
  Mesh_repair_report report;
  const Labelled_mesh repaired = repair_mesh(mesh, report);
  EXPECT_TRUE(report.is_unchanged());
  EXPECT_EQ(repaired.polygons, mesh.polygons);
  EXPECT_EQ(repaired.points, mesh.points);
  // Also parts that touch each other in closed surfaces, and open surfaces.
  Labelled_mesh open = mesh;
  open.polygons.resize(20);
  open.polygon_region.resize(20);
  EXPECT_EQ(repair_mesh(open, report).polygons, open.polygons);
  EXPECT_TRUE(report.is_unchanged());
}

TEST(Repair_mesh, cracks_are_told_and_closed)
{
  for (const double scale : {1.0, 1e8, 1e-8})
    for (const double gap : {0.0, 1e-7}) {
      Labelled_mesh mesh = split_along_equator(sphere(), gap);
      for (std::array<double, 3>& p : mesh.points)
        for (double& x : p)
          x *= scale;
      const std::string message = message_of([&] { make_surface_domain(mesh, "ball"); });
      EXPECT_NE(message.find("ball: the surface has a crack: at the edge from ("), std::string::npos) << message;
      EXPECT_NE(message.find("--repair"), std::string::npos) << message;
      Surface_domain_options options;
      options.repair = true;
      const Surface_domain domain = make_surface_domain(mesh, "ball", options);
      EXPECT_EQ(euler_characteristic(domain), 2);
      EXPECT_EQ(domain.mesh.number_of_faces(), mesh.polygons.size());
      EXPECT_EQ(domain.notes.front(), "repaired: 16 points merged, 0 degenerate or repeated triangles dropped, "
                                      "0 triangles turned around");
    }
}

TEST(Repair_mesh, gaps_that_are_wider_stay)
{
  const Labelled_mesh mesh = split_along_equator(sphere(), 1e-3);
  Mesh_repair_report report;
  EXPECT_EQ(repair_mesh(mesh, report).polygons, mesh.polygons);
  EXPECT_EQ(euler_characteristic(make_surface_domain(mesh, "two halves")), 2); // of two disks
}

TEST(Repair_mesh, three_borders_at_one_place_stay)
{
  // Three leaves of a book whose backs have points of their own.
  Labelled_mesh mesh;
  for (const auto& [x, y] : {std::pair(1.0, 0.0), std::pair(-0.5, 0.8), std::pair(-0.5, -0.8)}) {
    const int n = int(mesh.points.size());
    mesh.points.insert(mesh.points.end(), {{0, 0, 0}, {0, 0, 1}, {x, y, 0}});
    mesh.polygons.push_back({n, n + 1, n + 2});
    mesh.polygon_region.push_back(-1);
  }
  Mesh_repair_report report;
  EXPECT_EQ(repair_mesh(mesh, report).polygons, mesh.polygons);
  EXPECT_NE(message_of([&] { make_surface_domain(mesh, "book"); }).find("crack"), std::string::npos);
}

TEST(Repair_mesh, flat_triangles_give_their_middle_point_to_their_neighbour)
{
  // The upper triangle is 0 2 1, the lower ones 0 4 3 and 4 2 3; between them 0 4 2 has no height.
  Labelled_mesh mesh =
      quads({{0, 0, 0}, {1, 2, 0}, {2, 0, 0}, {1, -1, 1}, {1, 0, 0}}, {{0, 2, 1}, {0, 3, 4}, {4, 3, 2}, {0, 4, 2}});
  mesh.polygon_region = {7, 8, 9, 10};
  mesh.lines = {{0, 2}};
  mesh.line_curve = {5};
  EXPECT_NE(message_of([&] { make_surface_domain(mesh, "cap"); }).find("degenerate"), std::string::npos);
  Mesh_repair_report report;
  const Labelled_mesh repaired = repair_mesh(mesh, report);
  EXPECT_EQ(report.dropped_triangles, 1U);
  EXPECT_EQ(report.merged_points, 0U);
  EXPECT_EQ(report.turned_triangles, 0U);
  EXPECT_EQ(repaired.polygons, (std::vector<std::vector<int>>{{0, 3, 4}, {4, 3, 2}, {0, 4, 1}, {4, 2, 1}}));
  EXPECT_EQ(repaired.polygon_region, (std::vector<int>{8, 9, 7, 7}));
  EXPECT_EQ(repaired.lines, (std::vector<std::array<int, 2>>{{0, 4}, {4, 2}}));
  EXPECT_EQ(repaired.line_curve, (std::vector<int>{5, 5}));
}

TEST(Repair_mesh, ends_where_flat_triangles_lie_on_each_other)
{
  // Grids of triangles whose corners are at few places, so that most are flat, in layers and cycles.
  std::mt19937 generator(1);
  for (int k = 0; k < 300; ++k) {
    const int n = 3 + k % 5;
    Labelled_mesh mesh;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        mesh.points.push_back({double(generator() % 8), double(generator() % 3 / 2), 0.0});
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int a = i * (n + 1) + j;
        mesh.polygons.push_back({a, a + 1, a + n + 2});
        mesh.polygons.push_back({a, a + n + 2, a + n + 1});
      }
    mesh.polygon_region.assign(mesh.polygons.size(), -1);
    Mesh_repair_report report;
    const Labelled_mesh repaired = repair_mesh(mesh, report);
    EXPECT_LE(repaired.polygons.size(), mesh.polygons.size());
    EXPECT_GT(report.dropped_triangles, 0U);
    EXPECT_LE(report.dropped_triangles, 10 * mesh.polygons.size());
    EXPECT_EQ(repaired.polygon_region.size(), repaired.polygons.size());
  }
}

TEST(Repair_mesh, points_at_one_place_in_a_triangle_become_one)
{
  Labelled_mesh mesh =
      quads({{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {1, 1, 1}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  Mesh_repair_report report;
  const Labelled_mesh repaired = repair_mesh(mesh, report);
  EXPECT_EQ(repaired.polygons, (std::vector<std::vector<int>>{{0, 1, 2}, {0, 2, 4}}));
  EXPECT_EQ(report.merged_points, 1U);
  EXPECT_EQ(report.dropped_triangles, 1U);
}

TEST(Repair_mesh, repeated_triangles_are_kept_once)
{
  Labelled_mesh mesh = sphere();
  const std::size_t n = mesh.polygons.size();
  mesh.polygons.push_back({mesh.polygons[3][1], mesh.polygons[3][0], mesh.polygons[3][2]});
  mesh.polygon_region.push_back(-1);
  Mesh_repair_report report;
  EXPECT_EQ(repair_mesh(mesh, report).polygons.size(), n);
  EXPECT_EQ(report.dropped_triangles, 1U);
}

TEST(Repair_mesh, orients_closed_components_outwards)
{
  const Labelled_mesh mesh = sphere();
  for (const bool most : {false, true}) {
    Labelled_mesh mixed = mesh;
    std::size_t n_turned = 0;
    for (std::size_t f = 0; f < mixed.polygons.size(); ++f)
      if ((f % 5 == 0) != most) {
        std::swap(mixed.polygons[f][1], mixed.polygons[f][2]);
        ++n_turned;
      }
    Mesh_repair_report report;
    const Labelled_mesh repaired = repair_mesh(mixed, report);
    EXPECT_EQ(repaired.polygons, mesh.polygons);
    EXPECT_EQ(report.turned_triangles, n_turned);
  }
}

TEST(Repair_mesh, bad_numbers_are_left_to_the_checks)
{
  Labelled_mesh mesh = sphere();
  mesh.polygons[5][1] = 100000;
  Mesh_repair_report report;
  EXPECT_EQ(repair_mesh(mesh, report).polygons, mesh.polygons);
  mesh = sphere();
  mesh.points[5][1] = std::nan("");
  EXPECT_EQ(repair_mesh(mesh, report).polygons, mesh.polygons);
  EXPECT_TRUE(report.is_unchanged());
  EXPECT_TRUE(repair_mesh(Labelled_mesh(), report).polygons.empty());
}

} // namespace
