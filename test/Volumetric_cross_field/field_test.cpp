// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "tetrahedral_test_meshes.h"

#include <Quadrille/Volumetric_cross_field/internal/Cross_diffusion.h>
#include <Quadrille/Volumetric_cross_field/internal/coarsen_field_graph.h>
#include <Quadrille/Volumetric_cross_field/internal/make_field_graph.h>
#include <Quadrille/average_crosses.h>
#include <Quadrille/cross_field_indicators.h>
#include <Quadrille/volumetric_cross_field.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <random>

namespace {

using namespace Quadrille;

Cross_field_options converged(int threads = 0)
{
  Cross_field_options options;
  options.threads = threads;
  options.energy_tolerance = 1e-12;
  options.max_newton_steps = 200;
  return options;
}

Tetrahedral_mesh prism(int corners)
{
  return prism_of_tetrahedra(polygon_of_triangles(regular_polygon(corners), 6), 6, 1.5);
}

Vertex_alignments aligned(const Tetrahedral_mesh& mesh) { return align_with_boundary(mesh, {}, mesh.feature_edges); }

internal::Mesh_field_graph graph_of(const Tetrahedral_mesh& mesh, const Vertex_alignments& alignments)
{
  return internal::Mesh_field_graph(mesh, alignments, nullptr, Metric_connection(), 1);
}

/// The energy by its definition, element by element.
double energy_by_elements(const Tetrahedral_mesh& mesh, const std::vector<Eigen::Matrix3d>& frames)
{
  double energy = 0;
  for (std::size_t t = 0; t < mesh.number_of_tetrahedra(); ++t) {
    const auto gradients = internal::gradients_of_corners(internal::points_of(mesh, t));
    Eigen::Matrix<double, 9, 3> gradient = Eigen::Matrix<double, 9, 3>::Zero();
    for (std::size_t i = 0; i < 4; ++i)
      gradient +=
          cross_harmonics(frames[std::size_t(mesh.tetrahedra[t][i])]) * gradients.col(Eigen::Index(i)).transpose();
    energy += 0.5 * volume(mesh, mesh.tetrahedra[t]) * gradient.squaredNorm();
  }
  return energy;
}

double largest_distance(const std::vector<Eigen::Matrix3d>& a, const std::vector<Eigen::Matrix3d>& b)
{
  double largest = 0;
  for (std::size_t v = 0; v < a.size(); ++v)
    largest = std::max(largest, (cross_harmonics(a[v]) - cross_harmonics(b[v])).norm());
  return largest;
}

TEST(Volumetric_field, energy_is_the_dirichlet_energy_of_linear_elements)
{
  const Tetrahedral_mesh mesh = jittered(prism(5), 0.02, 1);
  const Volumetric_cross_field field = volumetric_cross_field(mesh, aligned(mesh));
  EXPECT_NEAR(field.energy, energy_by_elements(mesh, field.frames), 1e-5 * field.energy);
}

TEST(Volumetric_field, boxes_have_the_constant_field)
{
  const Tetrahedral_mesh mesh = jittered(cube_of_tetrahedra(6), 0.02, 3);
  const Volumetric_cross_field field = volumetric_cross_field(mesh, aligned(mesh));
  const Cross_harmonics axes = cross_harmonics(Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  for (const Eigen::Matrix3d& frame : field.frames)
    EXPECT_LT((cross_harmonics(frame) - axes).norm(), 1e-4);
  EXPECT_TRUE(field.has_settled);
  for (const double eta : crosses_of_tetrahedra(mesh, field.frames).eta)
    EXPECT_LT(eta, 1e-4);
}

TEST(Volumetric_field, frames_are_rotations_that_keep_their_alignments)
{
  const Tetrahedral_mesh mesh = ball_of_tetrahedra(10);
  const Vertex_alignments alignments = aligned(mesh);
  const Volumetric_cross_field field = volumetric_cross_field(mesh, alignments);
  std::size_t n_aligned = 0;
  for (std::size_t v = 0; v < mesh.number_of_vertices(); ++v) {
    const Eigen::Matrix3d& R = field.frames[v];
    EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_GT(R.determinant(), 0);
    if (alignments.alignment_of[v] == Vertex_alignments::is_free)
      continue;
    ++n_aligned;
    // On a sphere the normal is the radius, up to the size of the triangles.
    const Eigen::Vector3d axis = alignments.alignments[std::size_t(alignments.alignment_of[v])].crosses.frame.col(2);
    EXPECT_NEAR((R.transpose() * axis).cwiseAbs().maxCoeff(), 1, 1e-12);
    EXPECT_GT(axis.dot(mesh.point(v).normalized()), 0.98);
  }
  EXPECT_GT(n_aligned, 100u);
}

TEST(Volumetric_field, is_a_local_minimum)
{
  const Tetrahedral_mesh mesh = prism(3);
  const Vertex_alignments alignments = aligned(mesh);
  const Volumetric_cross_field field = volumetric_cross_field(mesh, alignments, converged());
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  const double energy = energy_by_elements(mesh, field.frames);
  for (int i = 0; i < 40; ++i) {
    std::vector<Eigen::Matrix3d> frames = field.frames;
    for (std::size_t v = 0; v < frames.size(); ++v)
      if (alignments.alignment_of[v] == Vertex_alignments::is_free && (i % 2 == 0 || v % 37 == std::size_t(i) % 37)) {
        const Eigen::Vector3d w(normal(engine), normal(engine), normal(engine));
        frames[v] = Eigen::AngleAxisd(0.02 * w.norm(), w.normalized()) * frames[v];
      }
    EXPECT_GT(energy_by_elements(mesh, frames), energy);
  }
}

TEST(Volumetric_field, turns_scales_and_relabels_with_the_mesh)
{
  const Tetrahedral_mesh mesh = prism(3);
  const Volumetric_cross_field field = volumetric_cross_field(mesh, aligned(mesh), converged());
  const Eigen::Matrix3d R = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -3).normalized()).toRotationMatrix();
  std::vector<Eigen::Matrix3d> turned = field.frames;
  for (Eigen::Matrix3d& frame : turned)
    frame = R * frame;
  for (const double scale : {1.0, 1e8, 1e-8}) {
    const Tetrahedral_mesh moved =
        mapped(mesh, [&](const Eigen::Vector3d& p) { return Eigen::Vector3d(scale * (R * p)); });
    const Volumetric_cross_field of_moved = volumetric_cross_field(moved, aligned(moved), converged());
    EXPECT_NEAR(of_moved.energy, scale * field.energy, 1e-6 * scale * field.energy);
    EXPECT_LT(largest_distance(of_moved.frames, turned), 1e-5) << scale;
  }
  std::vector<int> new_number;
  const Tetrahedral_mesh other = relabelled(mesh, 5, new_number);
  const Volumetric_cross_field of_other = volumetric_cross_field(other, aligned(other), converged());
  std::vector<Eigen::Matrix3d> back(field.frames.size());
  for (std::size_t v = 0; v < back.size(); ++v)
    back[v] = of_other.frames[std::size_t(new_number[v])];
  EXPECT_LT(largest_distance(back, field.frames), 1e-5);
}

TEST(Volumetric_field, is_the_same_for_every_number_of_threads)
{
  const Tetrahedral_mesh mesh = ball_of_tetrahedra(22); // with a coarser level
  const Vertex_alignments alignments = aligned(mesh);
  Cross_field_options options;
  options.threads = 1;
  const Volumetric_cross_field one = volumetric_cross_field(mesh, alignments, options);
  EXPECT_EQ(one.levels, 2u);
  for (const int threads : {2, 5}) {
    options.threads = threads;
    const Volumetric_cross_field more = volumetric_cross_field(mesh, alignments, options);
    EXPECT_EQ(more.energy, one.energy);
    EXPECT_TRUE(std::equal(one.frames.begin(), one.frames.end(), more.frames.begin()));
  }
}

TEST(Volumetric_field, components_do_not_feel_each_other)
{
  const Tetrahedral_mesh first = prism(3), second = prism(5);
  const Tetrahedral_mesh far =
      mapped(second, [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x() + 10, p.y(), p.z()); });
  const Tetrahedral_mesh mesh = both(first, far);
  const double together = volumetric_cross_field(mesh, aligned(mesh), converged()).energy;
  const double apart = volumetric_cross_field(first, aligned(first), converged()).energy +
                       volumetric_cross_field(second, aligned(second), converged()).energy;
  EXPECT_NEAR(together, apart, 1e-6 * apart);
}

TEST(Volumetric_field, reports_progress_and_can_be_cancelled)
{
  const Tetrahedral_mesh mesh = ball_of_tetrahedra(6);
  EXPECT_THROW(volumetric_cross_field(mesh, aligned(mesh), {},
                                      Progress_observer([](const std::string&, double) { return false; })),
               Cancelled_error);
}

TEST(Volumetric_field, the_paper_s_averaging_ends_higher)
{
  const Tetrahedral_mesh mesh = ball_of_tetrahedra(10);
  const Vertex_alignments alignments = aligned(mesh);
  const double ours = volumetric_cross_field(mesh, alignments).energy;
  Averaging_options options;
  options.max_sweeps = 100;
  const Averaged_crosses averaged = average_crosses(mesh, alignments, options);
  EXPECT_NEAR(averaged.energy, energy_by_elements(mesh, averaged.frames), 1e-5 * averaged.energy);
  EXPECT_LT(ours, averaged.energy);
  for (std::size_t v = 0; v < mesh.number_of_vertices(); ++v)
    if (const int i = alignments.alignment_of[v]; i != Vertex_alignments::is_free) {
      const Eigen::Vector3d axis = alignments.alignments[std::size_t(i)].crosses.frame.col(2);
      EXPECT_NEAR((averaged.frames[v].transpose() * axis).cwiseAbs().maxCoeff(), 1, 1e-12);
    }
}

TEST(Cross_diffusion, solves_its_equations)
{
  const Tetrahedral_mesh mesh = jittered(cube_of_tetrahedra(4), 0.03, 2);
  Vertex_alignments alignments;
  alignments.alignment_of.assign(mesh.number_of_vertices(), Vertex_alignments::is_free);
  const internal::Mesh_field_graph numbered = graph_of(mesh, alignments);
  const internal::Field_graph& graph = numbered.graph();
  const Eigen::Index n = Eigen::Index(graph.number_of_vertices());
  std::mt19937 engine(1);
  std::normal_distribution<float> normal;
  internal::Cross_diffusion::Field p(graph.number_of_vertices()), x;
  for (auto& q : p)
    q = internal::Cross_diffusion::Harmonics::NullaryExpr([&] { return normal(engine); });
  const double time = 5;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n), right(n, 9);
  for (Eigen::Index v = 0; v < n; ++v) {
    const std::size_t i = std::size_t(v);
    matrix(v, v) += graph.mass[i] + time * graph.degree[i];
    for (std::size_t e = graph.first[i]; e < graph.first[i + 1]; ++e)
      matrix(v, graph.edges[e].neighbour) -= time * double(graph.edges[e].weight);
    right.row(v) = graph.mass[i] * p[i].cast<double>().transpose();
  }
  EXPECT_LT((matrix - matrix.transpose()).norm(), 1e-12);
  const Eigen::MatrixXd solution = matrix.ldlt().solve(right);
  double distance[2] = {0, 0}, start = 0;
  for (int i = 0; i < 2; ++i) {
    x = p;
    internal::Cross_diffusion(graph, 1).solve(time, p, x, i == 0 ? 0.1 : 1e-4);
    for (Eigen::Index v = 0; v < n; ++v)
      distance[i] += (x[std::size_t(v)].cast<double>() - solution.row(v).transpose()).squaredNorm();
  }
  for (Eigen::Index v = 0; v < n; ++v)
    start += (p[std::size_t(v)].cast<double>() - solution.row(v).transpose()).squaredNorm();
  EXPECT_LT(std::sqrt(distance[0] / start), 0.1);
  EXPECT_LT(std::sqrt(distance[1] / start), 1e-3);
}

TEST(Field_graph_coarsener, makes_a_smaller_problem_of_the_same_form)
{
  const Tetrahedral_mesh mesh = prism_of_tetrahedra(polygon_of_triangles(regular_polygon(4), 14), 14, 1.5);
  const Vertex_alignments alignments = aligned(mesh);
  const internal::Mesh_field_graph numbered = graph_of(mesh, alignments);
  const internal::Field_graph& fine = numbered.graph();
  const internal::Coarse_field_graph coarse = internal::Field_graph_coarsener(fine).coarsen();
  const std::size_t n = coarse.graph.number_of_vertices();
  EXPECT_LT(4 * n, fine.number_of_vertices());
  std::vector<double> mass(n, 0);
  for (std::size_t v = 0; v < fine.number_of_vertices(); ++v) {
    const std::size_t a = std::size_t(coarse.aggregate_of[v]);
    ASSERT_LT(a, n);
    mass[a] += fine.mass[v];
    const Cross_alignment *of_fine = fine.alignment(v), *of_coarse = coarse.graph.alignment(a);
    ASSERT_EQ(of_fine == nullptr, of_coarse == nullptr);
    if (of_fine) {
      EXPECT_EQ(of_fine->is_fixed, of_coarse->is_fixed);
    }
  }
  // Energies of fields that are constant on aggregates agree.
  std::mt19937 engine(2);
  std::normal_distribution<double> normal;
  std::vector<Cross_harmonics> q(n), on_fine(fine.number_of_vertices());
  for (Cross_harmonics& value : q)
    value = cross_harmonics(Eigen::Quaterniond(normal(engine), normal(engine), normal(engine), normal(engine))
                                .normalized()
                                .toRotationMatrix());
  for (std::size_t v = 0; v < on_fine.size(); ++v)
    on_fine[v] = q[std::size_t(coarse.aggregate_of[v])];
  const double energy = internal::Cross_energy_newton(coarse.graph, 1).energy(q);
  EXPECT_NEAR(energy, internal::Cross_energy_newton(fine, 1).energy(on_fine), 1e-5 * energy);
  for (std::size_t a = 0; a < n; ++a)
    EXPECT_NEAR(mass[a] / mass[0], coarse.graph.mass[a] / coarse.graph.mass[0], 1e-9 * mass[a] / mass[0]);
}

} // namespace
