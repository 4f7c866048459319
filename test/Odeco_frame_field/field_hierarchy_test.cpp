// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "field_test_meshes.h"

#include <Quadrille/Odeco_frame_field/internal/Planar_level.h>
#include <Quadrille/Odeco_frame_field/internal/solve_planar_field.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace {

using namespace Quadrille;
using namespace Quadrille::internal;
using namespace Quadrille_test;

/// Constrains the edges for which `is_curve` holds, frames having there the size 1 + x + 2 y.
Constrained_mesh constrained(const Triangles& triangles,
                             const std::function<bool(const Indexed_triangulation&, int)>& is_curve)
{
  Constrained_mesh result{triangles.indexed(), triangles.points, {}};
  for (int h = 0; h < result.mesh.number_of_halfedges(); ++h) {
    if (result.mesh.opposite(h) > h || !is_curve(result.mesh, h))
      continue;
    std::array<Frame_size, 2> size;
    for (std::size_t i = 0; i < 2; ++i) {
      const Eigen::Vector2d& p = triangles.points[std::size_t(i == 0 ? result.mesh.source(h) : result.mesh.target(h))];
      size[i] = {1 + p.x() + 2 * p.y(), 1 + p.x() + 2 * p.y()};
    }
    result.edges.push_back({h, true, size});
  }
  return result;
}

Constrained_mesh coarsened(const Constrained_mesh& mesh, std::size_t n, std::vector<int>& fine,
                           std::vector<int>& coarse)
{
  const std::vector<double> sizes(mesh.points.size(), 1);
  Mesh_coarsener<Eigen::Vector2d> coarsener(mesh, sizes);
  coarsener.coarsen(n);
  return coarsener.result(fine, coarse);
}

double area(const Constrained_mesh& mesh, double* smallest_quality)
{
  double sum = 0;
  *smallest_quality = 1;
  for (int f = 0; f < mesh.mesh.number_of_faces(); ++f) {
    const auto& t = mesh.mesh.triangle(f);
    const Eigen::Vector2d a = mesh.points[std::size_t(t[1])] - mesh.points[std::size_t(t[0])];
    const Eigen::Vector2d b = mesh.points[std::size_t(t[2])] - mesh.points[std::size_t(t[0])];
    const double twice = a.x() * b.y() - a.y() * b.x();
    sum += twice / 2;
    *smallest_quality = std::min(*smallest_quality, 2 * std::sqrt(3.) * twice /
                                                        (a.squaredNorm() + b.squaredNorm() + (b - a).squaredNorm()));
  }
  return sum;
}

TEST(Mesh_coarsener, keeps_a_square_with_a_feature_line_what_it_is)
{
  // The boundary, and the line y = 1/2 from x = 1/4 to the right side, which it meets in a T.
  const Triangles square_triangles = square(32, 1);
  const auto is_feature = [&](const Indexed_triangulation& mesh, int h, const std::vector<Eigen::Vector2d>& points) {
    const Eigen::Vector2d &a = points[std::size_t(mesh.source(h))], &b = points[std::size_t(mesh.target(h))];
    return a.y() == 0.5 && b.y() == 0.5 && std::min(a.x(), b.x()) >= 0.25;
  };
  const Constrained_mesh mesh = constrained(square_triangles, [&](const Indexed_triangulation& m, int h) {
    return m.is_boundary(h) || is_feature(m, h, square_triangles.points);
  });
  std::vector<int> fine, coarse;
  const Constrained_mesh result = coarsened(mesh, 200, fine, coarse);
  EXPECT_LE(result.mesh.number_of_faces(), 200);
  EXPECT_GT(result.mesh.number_of_faces(), 150);
  EXPECT_EQ(result.mesh.euler_characteristic(), 1);
  double smallest_quality = 0;
  EXPECT_NEAR(area(result, &smallest_quality), 1, 1e-12);
  EXPECT_GT(smallest_quality, 0.39);

  double boundary_length = 0, feature_length = 0;
  int n_boundary = 0;
  for (const Constrained_halfedge& edge : result.edges) {
    const Eigen::Vector2d ends[2] = {result.points[std::size_t(result.mesh.source(edge.halfedge))],
                                     result.points[std::size_t(result.mesh.target(edge.halfedge))]};
    const double length = (ends[1] - ends[0]).norm();
    if (result.mesh.is_boundary(edge.halfedge)) {
      boundary_length += length;
      ++n_boundary;
    } else {
      EXPECT_TRUE(is_feature(result.mesh, edge.halfedge, result.points));
      feature_length += length;
    }
    EXPECT_TRUE(edge.aligned);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(edge.size[i].normal, 1 + ends[i].x() + 2 * ends[i].y());
      EXPECT_EQ(edge.size[i].tangential, edge.size[i].normal);
    }
  }
  EXPECT_NEAR(boundary_length, 4, 1e-12);
  EXPECT_NEAR(feature_length, 0.75, 1e-12);
  EXPECT_EQ(n_boundary, result.mesh.number_of_boundary_edges());
  EXPECT_LT(n_boundary, 64);

  ASSERT_EQ(coarse.size(), square_triangles.points.size());
  for (std::size_t v = 0; v < fine.size(); ++v) {
    EXPECT_EQ(result.points[v], square_triangles.points[std::size_t(fine[v])]);
    EXPECT_EQ(coarse[std::size_t(fine[v])], int(v));
  }
}

TEST(Mesh_coarsener, keeps_vertices_where_a_constraint_changes)
{
  // Sizes on the left half of the bottom only; every other boundary edge is free.
  const Triangles triangles = square(16, 1);
  Constrained_mesh mesh = constrained(triangles, [&](const Indexed_triangulation& m, int h) {
    const Eigen::Vector2d &a = triangles.points[std::size_t(m.source(h))],
                          &b = triangles.points[std::size_t(m.target(h))];
    return a.y() == 0 && b.y() == 0 && std::max(a.x(), b.x()) <= 0.5;
  });
  std::vector<int> fine, coarse;
  const Constrained_mesh result = coarsened(mesh, 40, fine, coarse);
  double length = 0;
  for (const Constrained_halfedge& edge : result.edges)
    length += (result.points[std::size_t(result.mesh.target(edge.halfedge))] -
               result.points[std::size_t(result.mesh.source(edge.halfedge))])
                  .norm();
  EXPECT_NEAR(length, 0.5, 1e-12);
  EXPECT_LT(result.edges.size(), 8u);
}

TEST(Mesh_coarsener, keeps_a_disk_round)
{
  const Triangles triangles = disk(24);
  const Constrained_mesh mesh =
      constrained(triangles, [](const Indexed_triangulation& m, int h) { return m.is_boundary(h); });
  std::vector<int> fine, coarse;
  const Constrained_mesh result = coarsened(mesh, 10, fine, coarse); // more than can be reached
  double smallest_quality = 0;
  EXPECT_GT(area(result, &smallest_quality), 0.9 * std::acos(-1.0));
  EXPECT_GT(smallest_quality, 0.2);
  // An edge never replaces two that turn by more than 25 degrees, so no vertex can turn by more than twice that.
  EXPECT_GE(result.mesh.number_of_boundary_edges(), 360 / 50);
  EXPECT_LT(result.mesh.number_of_boundary_edges(), 24 * 6 / 2);
}

TEST(Field_prolongation, reproduces_linear_fields)
{
  const Triangles triangles = square(24, 1);
  const Constrained_mesh mesh =
      constrained(triangles, [](const Indexed_triangulation& m, int h) { return m.is_boundary(h); });
  std::vector<int> fine_vertex, coarse_vertex;
  const Constrained_mesh coarse = coarsened(mesh, 100, fine_vertex, coarse_vertex);
  const auto elements_of = [](const Constrained_mesh& m) {
    return Field_elements<5>(m.mesh, m.points, local_triangle_sizes(m.mesh, m.points),
                             std::vector<Vertex_restriction<5>>(m.points.size()),
                             std::vector<double>(m.points.size(), 0));
  };
  const Field_elements<5> coarse_elements = elements_of(coarse), fine_elements = elements_of(mesh);
  const auto linear = [](const Eigen::Vector2d& p) {
    Circular_harmonics q;
    q << 3 + p.x(), p.y(), -p.x(), 0.5 * p.x() - p.y(), 0.1;
    return q;
  };
  Eigen::VectorXd x(Eigen::Index(coarse_elements.number_of_unknowns()));
  for (std::size_t v = 0; v < coarse.points.size(); ++v)
    coarse_elements.assign_coefficients(v, linear(coarse.points[v]), x);
  const Field_prolongation prolongation(coarse.mesh, coarse.points, mesh.points, coarse_vertex);
  const Eigen::VectorXd y = prolongation(coarse_elements, x, fine_elements);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    EXPECT_LT((fine_elements.coefficients(v, y) - linear(mesh.points[v])).norm(), 1e-12);
}

TEST(Field_hierarchy, melts_fine_fields_on_coarse_triangles)
{
  // A square with sizes from 1 to 2, which one pair of singularities makes more integrable.
  const Triangles triangles = square(60, 1);
  const Constrained_mesh mesh{triangles.indexed(), triangles.points, {}};
  std::vector<Constrained_halfedge> edges;
  for (int h = 0; h < mesh.mesh.number_of_halfedges(); ++h)
    if (mesh.mesh.is_boundary(h)) {
      const double a = 0.05 * (1 + triangles.points[std::size_t(mesh.mesh.source(h))].y());
      const double b = 0.05 * (1 + triangles.points[std::size_t(mesh.mesh.target(h))].y());
      edges.push_back({h, true, {Frame_size{a, a}, Frame_size{b, b}}});
    }
  Odeco_field_options options;
  options.starts = 2;
  options.schedule.coarse_triangles = 1500;
  std::vector<Gradients> gradients(3);
  std::vector<double> lie;
  for (const int threads : {1, 2, 0}) {
    options.threads = threads;
    lie.push_back(solve_planar_field(mesh.mesh, mesh.points, edges, options, {}, gradients[lie.size()]).energy_lie);
  }
  EXPECT_EQ(gradients[0], gradients[1]);
  EXPECT_EQ(gradients[0], gradients[2]);

  const Field_evaluator melted_only = [](std::size_t start, const auto&) { return start < 2 ? 1e9 : 0; };
  Gradients melted;
  const Odeco_field_result coarse_to_fine =
      solve_planar_field(mesh.mesh, mesh.points, edges, options, melted_only, melted);
  options.schedule.coarse_triangles = 100000; // without levels
  const Odeco_field_result at_once = solve_planar_field(mesh.mesh, mesh.points, edges, options, melted_only, melted);
  for (std::size_t i = 2; i < 4; ++i) {
    EXPECT_TRUE(coarse_to_fine.starts[i].valid);
    EXPECT_LT(coarse_to_fine.starts[i].energy, 1.05 * at_once.starts[i].energy);
  }
}

} // namespace
