// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "surface_test_meshes.h"

#include <Quadrille/Odeco_frame_field/internal/Surface_field_solver.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace {

using namespace Quadrille;
using namespace Quadrille::internal;
using namespace Quadrille_test;

/// Features are the creases, with sizes that change along them.
Constrained_surface with_creases(const Space_triangles& triangles)
{
  Constrained_surface result{triangles.indexed(), triangles.points, {}};
  for (int h = 0; h < result.mesh.number_of_halfedges(); ++h) {
    if (result.mesh.opposite(h) > h || !is_crease(triangles, result.mesh, h))
      continue;
    std::array<Frame_size, 2> size;
    for (std::size_t i = 0; i < 2; ++i) {
      const int v = i == 0 ? result.mesh.source(h) : result.mesh.target(h);
      const Eigen::Vector3d& p = triangles.points[std::size_t(v)];
      size[i] = {1 + p.x() + 2 * p.y() + 4 * p.z(), 3 + p.x()};
    }
    result.edges.push_back({h, true, size});
  }
  return result;
}

struct Coarse_copy {
  std::vector<int> fine_vertex, coarse_vertex;
  Constrained_surface mesh;
  Space_triangles triangles;

  Coarse_copy(const Constrained_surface& finer, std::size_t n_faces)
      : mesh(coarsen_with_local_sizes(finer, n_faces, fine_vertex, coarse_vertex))
  {
    triangles.points = mesh.points;
    for (int f = 0; f < mesh.mesh.number_of_faces(); ++f)
      triangles.faces.push_back(mesh.mesh.triangle(f));
    EXPECT_LE(triangles.faces.size(), n_faces);
    for (std::size_t v = 0; v < fine_vertex.size(); ++v) {
      EXPECT_EQ(mesh.points[v], finer.points[std::size_t(fine_vertex[v])]);
      EXPECT_EQ(coarse_vertex[std::size_t(fine_vertex[v])], int(v));
    }
  }
};

TEST(Mesh_coarsener, keeps_a_sphere_closed_and_round)
{
  const Coarse_copy coarse(with_creases(icosphere(12)), 500);
  EXPECT_EQ(coarse.mesh.mesh.number_of_boundary_edges(), 0);
  EXPECT_EQ(coarse.mesh.mesh.euler_characteristic(), 2);
  EXPECT_NEAR(coarse.triangles.area() / (2 * two_pi), 1, 0.03);
  for (std::size_t f = 0; f < coarse.triangles.faces.size(); ++f) {
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    for (const int v : coarse.triangles.faces[f])
      centroid += coarse.triangles.points[std::size_t(v)] / 3;
    EXPECT_GT(coarse.triangles.doubled_normal(f).normalized().dot(centroid), 0.9);
  }
}

TEST(Mesh_coarsener, keeps_the_creases_of_a_cube)
{
  const Constrained_surface fine = with_creases(cube(12));
  for (const std::size_t n_faces : {600u, 100u}) {
    const Coarse_copy coarse(fine, n_faces);
    EXPECT_EQ(coarse.mesh.mesh.number_of_boundary_edges(), 0);
    EXPECT_EQ(coarse.mesh.mesh.euler_characteristic(), 2);
    EXPECT_NEAR(coarse.triangles.area(), 6, 1e-12);
    double length = 0;
    for (const Constrained_halfedge& edge : coarse.mesh.edges) {
      EXPECT_TRUE(edge.aligned);
      EXPECT_TRUE(is_crease(coarse.triangles, coarse.mesh.mesh, edge.halfedge));
      const int ends[2] = {coarse.mesh.mesh.source(edge.halfedge), coarse.mesh.mesh.target(edge.halfedge)};
      length += (coarse.mesh.points[std::size_t(ends[0])] - coarse.mesh.points[std::size_t(ends[1])]).norm();
      for (std::size_t i = 0; i < 2; ++i) {
        const Eigen::Vector3d& p = coarse.mesh.points[std::size_t(ends[i])];
        EXPECT_NEAR(edge.size[i].normal, 1 + p.x() + 2 * p.y() + 4 * p.z(), 1e-12);
        EXPECT_NEAR(edge.size[i].tangential, 3 + p.x(), 1e-12);
      }
    }
    EXPECT_NEAR(length, 12, 1e-12);
    for (std::size_t v = 0; v < fine.points.size(); ++v) // a vertex stays on the sides of the cube that it is on
      for (int i = 0; i < 3; ++i)
        if (const double x = fine.points[v][i]; x == 0 || x == 1) {
          EXPECT_EQ(coarse.mesh.points[std::size_t(coarse.coarse_vertex[v])][i], x);
        }
  }
}

/// The gradients of a map in space, orthogonal to each other, at a point with a normal.
using Space_field =
    std::function<std::pair<Eigen::Vector3d, Eigen::Vector3d>(const Eigen::Vector3d& p, const Eigen::Vector3d& normal)>;

/// The coefficients that a node of a surface with the given points has in such a field.
template <int N>
typename Surface_elements<N>::Coefficients coefficients_of(const Space_field& field,
                                                           const Surface_elements<N>& elements, std::size_t v,
                                                           const std::vector<Eigen::Vector3d>& points)
{
  const Eigen::Matrix3d& axes = elements.nodes().axes[v];
  const auto [gradient_u, gradient_v] = field(points[std::size_t(elements.nodes().vertex[v])], axes.col(2));
  Orthogonal_frame_2 frame;
  frame.direction = (axes.leftCols<2>().transpose() * gradient_u).normalized();
  frame.size_u = gradient_u.norm();
  frame.size_v = gradient_v.norm();
  return Tensor_coefficients<N>::from_harmonics(odeco_harmonics(frame));
}

/// Interpolates the field from a coarser copy of the surface. Returns the root mean square of its errors.
template <int N> double prolongation_error(Constrained_surface surface, std::size_t n_faces, const Space_field& field)
{
  for (Constrained_halfedge& edge : surface.edges)
    edge.size = {}; // only directions
  const Surface_problem problem(std::move(surface), {});
  const Surface_elements<N> fine =
      make_surface_elements<N>(problem, restrict_surface<N>(problem.constraints), Normal_value::mean);
  const Surface_level<N> level(problem, fine, n_faces);
  const Surface_elements<N>& coarse = level.elements;
  EXPECT_LE(coarse.number_of_elements(), n_faces);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(Eigen::Index(coarse.number_of_unknowns()));
  for (std::size_t v = 0; v < coarse.number_of_nodes(); ++v)
    coarse.assign_coefficients(v, coefficients_of(field, coarse, v, level.mesh.surface.points), x);
  const Eigen::VectorXd y = level.to_finer(coarse, x, fine);
  double sum = 0;
  for (std::size_t v = 0; v < fine.number_of_nodes(); ++v)
    sum += (fine.coefficients(v, y) - coefficients_of(field, fine, v, problem.surface.points)).squaredNorm();
  return std::sqrt(sum / double(fine.number_of_nodes()));
}

TEST(Surface_prolongation, reproduces_a_constant_field_in_a_plane)
{
  const Space_triangles lifted = moved(space_grid(12, 10, [](double s, double t) { return Eigen::Vector3d(s, t, 0); }),
                                       some_rotation, 3, {1, -2, 5});
  const double angle = 0.4;
  const Eigen::Vector3d u = 2 * (some_rotation * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0)),
                        v = 3 * (some_rotation * Eigen::Vector3d(-std::sin(angle), std::cos(angle), 0));
  const auto field = [&](const Eigen::Vector3d&, const Eigen::Vector3d&) { return std::pair(u, v); };
  EXPECT_LT(prolongation_error<5>({lifted.indexed(), lifted.points, {}}, 60, field), 1e-12);
}

TEST(Surface_prolongation, keeps_to_the_side_of_a_crease)
{
  // Every direction of the axes has a length of its own, so that each pair of sides has another frame.
  const double length[3] = {2, 3, 5};
  const auto field = [&](const Eigen::Vector3d&, const Eigen::Vector3d& normal) {
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const Eigen::Index i = (axis + 1) % 3, j = (axis + 2) % 3;
    return std::pair(Eigen::Vector3d(length[i] * Eigen::Vector3d::Unit(i)),
                     Eigen::Vector3d(length[j] * Eigen::Vector3d::Unit(j)));
  };
  EXPECT_LT(prolongation_error<5>(with_creases(cube(10)), 300, field), 1e-12);
}

TEST(Surface_prolongation, turns_tensors_along_with_the_normals)
{
  // Unit frames along the parallels of a band of a sphere: the error falls faster than the edges.
  const auto error = [](int n) {
    const Space_triangles band =
        space_grid(12 * n, 4 * n,
                   [](double s, double t) {
                     const double b = 0.8 * (2 * t - 1), l = two_pi * s;
                     return Eigen::Vector3d(std::cos(b) * std::cos(l), std::cos(b) * std::sin(l), std::sin(b));
                   },
                   {true, false});
    return prolongation_error<3>({band.indexed(), band.points, {}}, band.faces.size() / 4,
                                 [](const Eigen::Vector3d& p, const Eigen::Vector3d&) {
                                   const Eigen::Vector3d u = Eigen::Vector3d::UnitZ().cross(p).normalized();
                                   return std::pair(u, Eigen::Vector3d(p.cross(u)));
                                 });
  };
  const double errors[3] = {error(2), error(4), error(8)};
  EXPECT_LT(errors[1], errors[0] / 2.5);
  EXPECT_LT(errors[2], errors[1] / 2.5);
}

} // namespace
