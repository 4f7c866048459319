// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "field_test_meshes.h"

#include <Quadrille/odeco_frame_field.h>

#include <CGAL/boost/graph/properties.h>
#include <boost/property_map/vector_property_map.hpp>
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>

namespace {

using namespace Quadrille;
using namespace Quadrille_test;

struct Field {
  Odeco_field_result result;
  std::vector<Gradient_pair> gradients;
};

/// Frames aligned with the boundary, of the given size there.
Field boundary_field(const Mesh& mesh, const std::function<double(const Kernel::Point_2&)>& size,
                     const Odeco_field_options& options, const Field_evaluator& evaluator = {})
{
  std::vector<Edge_frame_constraint> constraints(mesh.number_of_edges());
  for (const Mesh::Edge_index e : mesh.edges())
    if (mesh.is_border(e)) {
      const Mesh::Halfedge_index h = mesh.halfedge(e);
      constraints[e] = {true, true, size(mesh.point(mesh.source(h))), size(mesh.point(mesh.target(h)))};
    }
  Field field;
  field.gradients.resize(mesh.number_of_faces());
  field.result = odeco_frame_field(
      mesh, mesh.points(), boost::make_iterator_property_map(constraints.begin(), boost::identity_property_map()),
      boost::make_iterator_property_map(field.gradients.begin(), boost::identity_property_map()), options, evaluator);
  return field;
}

Odeco_field_options quick(int starts)
{
  Odeco_field_options options;
  options.starts = starts;
  options.threads = 1;
  return options;
}

TEST(Odeco_frame_field, finds_the_constant_field_of_a_rectangle)
{
  const Mesh mesh = square(8, 3).surface_mesh();
  const Field field = boundary_field(
      mesh, [](const auto&) { return 0.5; }, quick(1));
  EXPECT_LT(field.result.energy, 1e-12);
  for (const auto& [du, dv] : field.gradients) {
    EXPECT_NEAR(du.norm(), 2, 1e-6);
    EXPECT_NEAR(dv.norm(), 2, 1e-6);
    EXPECT_NEAR(std::abs(du.x() * du.y()), 0, 1e-6);
  }
}

TEST(Odeco_frame_field, has_the_prescribed_sizes_at_the_boundary_vertices)
{
  // Coarse edges and steep sizes: an edge whose two ends were mixed up would show.
  const Mesh mesh = square(4, 1).surface_mesh();
  const auto size = [](const Kernel::Point_2& p) { return 1 + 2 * p.x() + 5 * p.y(); };
  const Field field = boundary_field(mesh, size, quick(0));
  for (const Mesh::Vertex_index v : mesh.vertices())
    if (mesh.is_border(v)) {
      const Orthogonal_frame_2 frame = nearest_odeco_frame(field.result.harmonics[v]);
      EXPECT_NEAR(frame.size_u, size(mesh.point(v)), 1e-8);
      EXPECT_NEAR(frame.size_v, size(mesh.point(v)), 1e-8);
    }
}

TEST(Odeco_frame_field, finds_the_conformal_field_of_an_annulus_sector)
{
  // Sizes proportional to the radius are integrable (the map is log z): what is left of the energy is discretisation.
  double last_energy = 1e300;
  for (const int n : {10, 20, 40}) {
    const Mesh mesh = grid(n, n, [](double s, double t) {
                        const double r = 1 + s, angle = 1.5 * (1 - t);
                        return Eigen::Vector2d(r * std::sin(angle), r * std::cos(angle));
                      }).surface_mesh();
    const Field field = boundary_field(
        mesh, [](const auto& p) { return 0.1 * std::hypot(p.x(), p.y()); }, quick(0));
    EXPECT_LT(field.result.energy, last_energy / 3);
    last_energy = field.result.energy;
    for (const Mesh::Face_index f : mesh.faces()) {
      Eigen::Vector2d center = Eigen::Vector2d::Zero();
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        center += Eigen::Vector2d(mesh.point(v).x(), mesh.point(v).y()) / 3;
      const Gradient_pair& pair = field.gradients[f];
      EXPECT_NEAR(pair.first.norm() * 0.1 * center.norm(), 1, 0.4 / n);
      const double along = std::abs(pair.first.normalized().dot(center.normalized()));
      EXPECT_LT(std::min(along, 1 - along), 0.4 / n);
    }
  }
}

/// The Dirichlet energy of the harmonic extension of log(size), by an independent assembly.
double log_size_energy(const Triangles& triangles, double side)
{
  const auto n = Eigen::Index(triangles.points.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& f : triangles.faces)
    for (int i = 0; i < 3; ++i) {
      const int a = f[std::size_t(i)], b = f[std::size_t((i + 1) % 3)], c = f[std::size_t((i + 2) % 3)];
      const Eigen::Vector2d p = triangles.points[std::size_t(a)] - triangles.points[std::size_t(c)];
      const Eigen::Vector2d q = triangles.points[std::size_t(b)] - triangles.points[std::size_t(c)];
      const double w = 0.5 * p.dot(q) / (p.x() * q.y() - p.y() * q.x()); // half the cotangent
      entries.insert(entries.end(), {{a, a, w}, {b, b, w}, {a, b, -w}, {b, a, -w}});
    }
  Eigen::SparseMatrix<double> stiffness(n, n);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd s(n);
  Eigen::SparseMatrix<double> penalty(n, n);
  for (Eigen::Index v = 0; v < n; ++v) {
    const Eigen::Vector2d& p = triangles.points[std::size_t(v)];
    s[v] = std::log(1 + p.y() / side);
    const bool border = p.x() == 0 || p.y() == 0 || p.x() == side || p.y() == side;
    penalty.insert(v, v) = border ? 1e10 : 0;
  }
  const Eigen::SparseMatrix<double> system = stiffness + penalty;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(system);
  s = solver.solve(penalty * s).eval();
  return s.dot(stiffness * s);
}

TEST(Odeco_frame_field, without_singularities_the_lie_energy_is_that_of_the_harmonic_log_size)
{
  // For isotropic frames |Lie|^2 / a^2 = |grad t - J grad log s|^2; with t = 0 on the whole boundary the mixed term
  // integrates to zero, so the minimum has t = 0 and a harmonic log s.
  const Triangles triangles = square(30, 20);
  const Field field = boundary_field(
      triangles.surface_mesh(), [](const auto& p) { return 1 + p.y() / 20; }, quick(0));
  const double expected = log_size_energy(triangles, 20);
  EXPECT_EQ(field.result.starts[1].kind, Field_start::Kind::relaxed);
  EXPECT_NEAR(field.result.energy, expected, 0.02 * expected);
}

TEST(Odeco_frame_field, stops_at_the_smooth_field_on_request)
{
  const Mesh mesh = square(12, 1).surface_mesh();
  const auto size = [](const Kernel::Point_2& p) { return 1 + p.y(); };
  Odeco_field_options options = quick(2);
  const Field integrable = boundary_field(mesh, size, options);
  options.integrable = false;
  const Field smooth = boundary_field(mesh, size, options);
  ASSERT_EQ(smooth.result.starts.size(), 1u);
  EXPECT_EQ(smooth.result.chosen, 0);
  EXPECT_EQ(smooth.result.starts[0].kind, Field_start::Kind::smooth);
  EXPECT_EQ(smooth.result.energy, integrable.result.starts[0].energy);
  EXPECT_GT(smooth.result.energy, 1.001 * integrable.result.energy);
}

TEST(Odeco_frame_field, melting_creates_singularities_whose_energy_the_smooth_start_never_sees)
{
  // With an evaluator that wants sizes to change quickly in the middle, a melted start wins over the relaxed one; it
  // must have a vertex where the frames turn by a quarter.
  const Mesh mesh = square(24, 20).surface_mesh();
  Odeco_field_options options = quick(2);
  const Field field = boundary_field(
      mesh, [](const auto& p) { return 1 + p.y() / 20; }, options,
      [&](std::size_t, const std::vector<Gradient_pair>& pairs) {
        int turned = 0;
        for (const Mesh::Vertex_index v : mesh.vertices()) {
          if (mesh.is_border(v))
            continue;
          double turn = 0;
          for (const Mesh::Halfedge_index h : mesh.halfedges_around_target(mesh.halfedge(v))) {
            const Eigen::Vector2d a = pairs[mesh.face(h)].first, b = pairs[mesh.face(mesh.opposite(h))].first;
            turn += std::remainder(std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x()), std::acos(0.0));
          }
          turned += std::abs(turn) > 0.1 ? 1 : 0;
        }
        return -double(turned);
      });
  EXPECT_EQ(field.result.starts[std::size_t(field.result.chosen)].kind, Field_start::Kind::melted);
  EXPECT_LT(field.result.starts[std::size_t(field.result.chosen)].cost, -1.5); // two vertices, and the size deviation
  EXPECT_NEAR(field.result.energy, field.result.energy_lie + field.result.energy_odeco, 1e-9 * field.result.energy);
}

TEST(Odeco_frame_field, is_the_same_for_every_number_of_threads_and_seeded)
{
  const Mesh mesh = square(12, 1).surface_mesh();
  const auto size = [](const Kernel::Point_2& p) { return 1 + p.y(); };
  Odeco_field_options options = quick(3);
  const Field one = boundary_field(mesh, size, options);
  for (const int threads : {2, 4}) {
    options.threads = threads;
    const Field other = boundary_field(mesh, size, options);
    EXPECT_EQ(one.gradients, other.gradients);
    EXPECT_EQ(one.result.chosen, other.result.chosen);
  }
  options.seed = 77;
  const Field reseeded = boundary_field(mesh, size, options);
  EXPECT_NE(one.result.starts[2].energy, reseeded.result.starts[2].energy);
}

TEST(Odeco_frame_field, moves_turns_and_scales_with_the_domain)
{
  const Triangles triangles = square(12, 1);
  const auto size = [](const Eigen::Vector2d& p) { return 1 + p.y(); };
  // The energy chooses the relaxed field, so ask for a melted one, which amplifies every difference.
  const Field_evaluator melted = [](std::size_t start, const std::vector<Gradient_pair>&) { return -double(start); };
  const Field plain = boundary_field(
      triangles.surface_mesh(),
      [&](const auto& p) {
        return size({p.x(), p.y()});
      },
      quick(1), melted);
  for (const double scale : {1e8, 1e-8}) {
    const Eigen::Rotation2Dd turn(0.3);
    Triangles moved = triangles;
    for (Eigen::Vector2d& p : moved.points)
      p = scale * (turn * p + Eigen::Vector2d(3, -2));
    const Field field = boundary_field(
        moved.surface_mesh(),
        [&](const auto& p) {
          return scale * size(turn.inverse() * (Eigen::Vector2d(p.x(), p.y()) / scale - Eigen::Vector2d(3, -2)));
        },
        quick(1), melted);
    ASSERT_EQ(field.result.chosen, 2);
    for (std::size_t f = 0; f < plain.gradients.size(); ++f)
      EXPECT_LT((scale * field.gradients[f].first - turn * plain.gradients[f].first).norm(),
                1e-6 * plain.gradients[f].first.norm());
  }
}

TEST(Odeco_frame_field, corners_far_from_right_angles_are_left_free)
{
  // A rhombus with angles of 45 and 135 degrees has four corners whose edges share no frame.
  const Mesh mesh = grid(10, 10, [](double s, double t) {
                      return Eigen::Vector2d(s + t * std::sqrt(0.5), t * std::sqrt(0.5));
                    }).surface_mesh();
  EXPECT_EQ(boundary_field(
                mesh, [](const auto&) { return 0.1; }, quick(0))
                .result.free_corners,
            4);
  EXPECT_EQ(boundary_field(
                square(10, 1).surface_mesh(), [](const auto&) { return 0.1; }, quick(0))
                .result.free_corners,
            0);
}

TEST(Odeco_frame_field, an_initial_field_replaces_the_starts)
{
  // Turned, so that the initial field has to be brought to the canonical position.
  Triangles triangles = square(20, 20);
  for (Eigen::Vector2d& p : triangles.points)
    p = Eigen::Rotation2Dd(0.4) * p;
  const Mesh mesh = triangles.surface_mesh();
  const auto size = [](const Kernel::Point_2& p) { return 1 + 0.05 * (std::cos(0.4) * p.y() - std::sin(0.4) * p.x()); };
  Odeco_field_options options = quick(2);
  const Field melted = boundary_field(mesh, size, options);
  options.initial_field = melted.result.harmonics;
  const Field again = boundary_field(mesh, size, options);
  ASSERT_EQ(again.result.starts.size(), 1u);
  EXPECT_EQ(again.result.starts[0].kind, Field_start::Kind::initial);
  EXPECT_LE(again.result.energy, melted.result.energy * (1 + 1e-9));
  EXPECT_GT(again.result.energy, melted.result.energy * (1 - 1e-3)); // it was nearly a minimum
  EXPECT_LE(again.result.iterations, 3);
  for (const auto v : mesh.vertices())
    EXPECT_LT((again.result.harmonics[v] - melted.result.harmonics[v]).norm(),
              0.02 * melted.result.harmonics[v].norm());
  options.initial_field.pop_back();
  EXPECT_THROW(boundary_field(mesh, size, options), Invalid_argument_error);
}

TEST(Odeco_frame_field, lbfgs_references_reach_the_same_minimum)
{
#ifdef QUADRILLE_WITH_ALGLIB
  const Mesh mesh = square(12, 1).surface_mesh();
  const auto size = [](const Kernel::Point_2& p) { return 1 + p.y(); };
  Odeco_field_options options = quick(0);
  const double expected = boundary_field(mesh, size, options).result.energy;
  options.solver = Field_solver_kind::lbfgs;
  EXPECT_NEAR(boundary_field(mesh, size, options).result.energy, expected, 1e-3 * expected);
  // This one weighs the odeco penalty differently where sizes are not 1, so that only E_Lie should agree.
  options.solver = Field_solver_kind::lbfgs_kappa;
  options.starts = 3; // melting belongs to the other solver
  const Odeco_field_result kappa = boundary_field(mesh, size, options).result;
  EXPECT_EQ(kappa.starts.size(), 2u);
  EXPECT_NEAR(kappa.energy_lie, expected, 1e-2 * expected);
  EXPECT_LT(kappa.energy_lie, 0.99 * kappa.starts[0].energy_lie);
#else
  GTEST_SKIP() << "built without ALGLIB";
#endif
}

TEST(Odeco_frame_field, rejects_what_it_cannot_use)
{
  const Mesh mesh = square(2, 1).surface_mesh();
  EXPECT_THROW(boundary_field(
                   mesh, [](const auto&) { return -1; }, quick(0)),
               Invalid_argument_error);
  EXPECT_THROW(boundary_field(
                   mesh, [](const auto&) { return std::nan(""); }, quick(0)),
               Invalid_argument_error);
  EXPECT_THROW(boundary_field(
                   mesh, [](const auto&) { return 1; }, quick(-1)),
               Invalid_argument_error);
  Triangles clockwise = square(2, 1);
  for (Eigen::Vector2d& p : clockwise.points)
    p.x() = -p.x();
  EXPECT_THROW(boundary_field(
                   clockwise.surface_mesh(), [](const auto&) { return 1; }, quick(0)),
               Invalid_input_error);
  std::vector<Edge_frame_constraint> none(mesh.number_of_edges());
  std::vector<Gradient_pair> gradients(mesh.number_of_faces());
  EXPECT_THROW(odeco_frame_field(mesh, mesh.points(),
                                 boost::make_iterator_property_map(none.begin(), boost::identity_property_map()),
                                 boost::make_iterator_property_map(gradients.begin(), boost::identity_property_map())),
               Invalid_input_error);
  std::vector<Edge_frame_constraint> weak(mesh.number_of_edges(), {true, true, 1, 1, true});
  EXPECT_THROW(odeco_frame_field(mesh, mesh.points(),
                                 boost::make_iterator_property_map(weak.begin(), boost::identity_property_map()),
                                 boost::make_iterator_property_map(gradients.begin(), boost::identity_property_map())),
               Invalid_argument_error);
}

} // namespace
