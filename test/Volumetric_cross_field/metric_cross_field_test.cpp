// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pulled_back_metrics.h"
#include "tetrahedral_test_meshes.h"

#include <Quadrille/Singular_graph.h>
#include <Quadrille/volumetric_cross_field.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

using namespace Quadrille;

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// How far crosses are from those of known frames, on average.
template <class Frame_at>
double mean_error(const Tetrahedral_mesh& mesh, const std::vector<Matrix3d>& frames, const Frame_at& frame_at)
{
  double sum = 0;
  for (std::size_t v = 0; v < frames.size(); ++v)
    sum += (cross_harmonics(frames[v]) - cross_harmonics(frame_at(mesh.point(v)))).norm();
  return sum / double(frames.size());
}

/// The vertex nearest to the middle of a mesh.
std::size_t middle(const Tetrahedral_mesh& mesh)
{
  Vector3d mean = Vector3d::Zero();
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    mean += mesh.point(v) / double(mesh.points.size());
  std::size_t nearest = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if ((mesh.point(v) - mean).norm() < (mesh.point(nearest) - mean).norm())
      nearest = v;
  return nearest;
}

/// No alignments but of the vertex in the middle.
template <class Frame_at> Vertex_alignments one_frame(const Tetrahedral_mesh& mesh, const Frame_at& frame_at)
{
  const std::size_t v = middle(mesh);
  Vertex_alignments alignments;
  alignments.alignment_of.assign(mesh.points.size(), Vertex_alignments::is_free);
  alignments.alignment_of[v] = 0;
  alignments.alignments.push_back(Cross_alignment::with_frame(frame_at(mesh.point(v))));
  return alignments;
}

/// The frames that are parallel in a metric pulled back by a map are those that the map takes to the coordinate axes:
/// A^-1 R = J^-1, R the transposed polar rotation.
template <class Jacobian_at> Matrix3d parallel_frame(const Jacobian_at& jacobian_at, const Vector3d& p)
{
  return polar_rotation(jacobian_at(p)).transpose();
}

/// The Jacobian of a map of the unit cube onto itself that takes each side to itself: to x it adds
/// sin(pi x) cos(pi y) (1 + z) / 10, and so on in turns.
Matrix3d jacobian_of_box(const Vector3d& p)
{
  const double pi = std::acos(-1.0);
  const Vector3d s = (pi * p.array()).sin(), c = (pi * p.array()).cos();
  constexpr double a = 0.1;
  Matrix3d J;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    J(i, i) = 1 + a * pi * c[i] * c[j] * (1 + p[k]);
    J(i, j) = -a * pi * s[i] * s[j] * (1 + p[k]);
    J(i, k) = a * s[i] * c[j];
  }
  return J;
}

} // namespace

TEST(Metric_cross_field, one_frame_determines_the_field_of_a_flat_metric)
{
  const auto frame_at = [](const Vector3d& p) { return parallel_frame(twisting_jacobian, p); };
  std::vector<double> errors;
  for (const int n : {3, 6, 12}) {
    const Tetrahedral_mesh mesh =
        jittered(mapped(cube_of_tetrahedra(n, 2), [](const Vector3d& p) -> Vector3d { return p - Vector3d::Ones(); }),
                 0.2 / n, 1);
    const Metric_field metric = Metric_field::pulled_back(mesh, twisting_jacobian);
    const Metric_connection connection(mesh, metric);
    const Volumetric_cross_field field = volumetric_cross_field(mesh, one_frame(mesh, frame_at), metric, connection);
    EXPECT_TRUE(field.has_settled);
    EXPECT_TRUE(singular_graph(mesh, field.frames, metric, connection).arcs.empty());
    errors.push_back(mean_error(mesh, field.frames, frame_at));
  }
  EXPECT_LT(errors.back(), 0.01);
  EXPECT_GT(order_of(errors), 1.8);
}

TEST(Metric_cross_field, sides_of_a_box_determine_the_field_of_a_map_onto_it)
{
  const auto frame_at = [](const Vector3d& p) { return parallel_frame(jacobian_of_box, p); };
  std::vector<double> errors;
  for (const int n : {3, 6, 12}) {
    const Tetrahedral_mesh mesh = jittered(cube_of_tetrahedra(n), 0.1 / n, 1);
    const Metric_field metric = Metric_field::pulled_back(mesh, jacobian_of_box);
    const Metric_connection connection(mesh, metric);
    const Vertex_alignments alignments = align_with_boundary(mesh, {}, {}, &metric);
    // What the boundary asks for is true without an error.
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
      if (alignments.alignment_of[v] >= 0) {
        const Cross_alignment& alignment = alignments.alignments[std::size_t(alignments.alignment_of[v])];
        const Cross_harmonics cross = cross_harmonics(frame_at(mesh.point(v)));
        EXPECT_LT((cross_harmonics(alignment.nearest(cross)) - cross).norm(), 1e-6);
      }
    const Volumetric_cross_field field = volumetric_cross_field(mesh, alignments, metric, connection);
    EXPECT_TRUE(field.has_settled);
    EXPECT_TRUE(singular_graph(mesh, field.frames, metric, connection).arcs.empty());
    errors.push_back(mean_error(mesh, field.frames, frame_at));
  }
  EXPECT_LT(errors.back(), 0.01);
  EXPECT_GT(order_of(errors), 1.8);
}

TEST(Metric_cross_field, sizes_of_an_inversion_give_the_inverted_field)
{
  // The inversion x / |x|^2 stretches by 1 / |x|^2 in all directions: the metric of the sizes |x|^2 is flat.
  const auto frame_at = [](const Vector3d& p) -> Matrix3d {
    const Vector3d n = p.normalized();
    return 2 * n * n.transpose() - Matrix3d::Identity(); // its polar factor, a reflection, with all axes reversed
  };
  std::vector<double> errors;
  for (const int n : {2, 4, 8}) {
    const Tetrahedral_mesh mesh = jittered(
        mapped(cube_of_tetrahedra(n), [](const Vector3d& p) -> Vector3d { return p + Vector3d(0.9, -0.4, 1.2); }),
        0.1 / n, 1);
    std::vector<double> sizes;
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
      sizes.push_back(mesh.point(v).squaredNorm());
    const Metric_field metric = Metric_field::of_sizes(sizes);
    const Metric_connection connection(mesh, metric);
    const Volumetric_cross_field field = volumetric_cross_field(mesh, one_frame(mesh, frame_at), metric, connection);
    EXPECT_TRUE(singular_graph(mesh, field.frames, metric, connection).arcs.empty());
    errors.push_back(mean_error(mesh, field.frames, frame_at));
  }
  EXPECT_LT(errors.back(), 0.02);
  EXPECT_GT(order_of(errors), 1.8);
}

TEST(Metric_cross_field, fields_of_a_mesh_and_of_its_linear_image_are_the_same)
{
  const Tetrahedral_mesh mesh =
      jittered(prism_of_tetrahedra(polygon_of_triangles(regular_polygon(3), 5), 5, 1), 0.02, 1);
  const Matrix3d J = 1e3 * Eigen::AngleAxisd(1, Vector3d(1, 1, 2).normalized()).toRotationMatrix() *
                     Vector3d(1.1, 0.95, 1.3).asDiagonal() *
                     Eigen::AngleAxisd(0.3, Vector3d::UnitZ()).toRotationMatrix();
  const Tetrahedral_mesh image = mapped(mesh, [&](const Vector3d& p) -> Vector3d { return J * p; });
  const Metric_field metric = Metric_field::pulled_back(mesh, [&](const Vector3d&) { return J; });
  const Metric_connection connection(mesh, metric);
  const Volumetric_cross_field field =
      volumetric_cross_field(mesh, align_with_boundary(mesh, {}, {}, &metric), metric, connection);
  const Volumetric_cross_field of_image = volumetric_cross_field(image, align_with_boundary(image));
  EXPECT_NEAR(field.energy, of_image.energy, 1e-4 * of_image.energy);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    EXPECT_LT((cross_harmonics(polar_rotation(J) * field.frames[v]) - cross_harmonics(of_image.frames[v])).norm(),
              1e-2);
  const Singular_graph graph = singular_graph(mesh, field.frames, metric, connection),
                       graph_of_image = singular_graph(image, of_image.frames);
  ASSERT_EQ(graph.arcs.size(), graph_of_image.arcs.size());
  for (std::size_t i = 0; i < graph.arcs.size(); ++i) {
    EXPECT_EQ(graph.arcs[i].valence, graph_of_image.arcs[i].valence);
    EXPECT_EQ(graph.arcs[i].tetrahedra, graph_of_image.arcs[i].tetrahedra);
  }
  EXPECT_EQ(graph.arcs.size(), 1u);
}

TEST(Metric_cross_field, fields_do_not_depend_on_numbers_and_threads)
{
  const Tetrahedral_mesh mesh =
      jittered(prism_of_tetrahedra(polygon_of_triangles(regular_polygon(5), 4), 4, 1), 0.02, 1);
  std::vector<int> new_number;
  const Tetrahedral_mesh other = relabelled(mesh, 1, new_number);
  const auto field_on = [](const Tetrahedral_mesh& m, int threads) {
    const Metric_field metric = Metric_field::pulled_back(m, twisting_jacobian);
    const Metric_connection connection(m, metric, 1e-4, threads);
    Cross_field_options options;
    options.threads = threads;
    return volumetric_cross_field(m, align_with_boundary(m, {}, {}, &metric), metric, connection, options);
  };
  const Volumetric_cross_field field = field_on(mesh, 1), of_other = field_on(other, 1);
  EXPECT_EQ(field.frames, field_on(mesh, 3).frames);
  EXPECT_NEAR(field.energy, of_other.energy, 1e-4 * field.energy);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    EXPECT_LT((cross_harmonics(field.frames[v]) - cross_harmonics(of_other.frames[std::size_t(new_number[v])])).norm(),
              1e-2);
}

TEST(Metric_cross_field, sizes_leave_angles_and_so_alignments)
{
  const Tetrahedral_mesh mesh = prism_of_tetrahedra(disk_of_triangles(3), 3, 1);
  std::vector<double> sizes;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    sizes.push_back(std::exp(mesh.points[v][0] * mesh.points[v][2]));
  const Metric_field metric = Metric_field::of_sizes(sizes);
  const Vertex_alignments with = align_with_boundary(mesh, {}, {}, &metric), without = align_with_boundary(mesh);
  EXPECT_EQ(with.alignment_of, without.alignment_of);
  ASSERT_EQ(with.alignments.size(), without.alignments.size());
  for (std::size_t i = 0; i < with.alignments.size(); ++i) {
    const Cross_harmonics offset = with.alignments[i].crosses.offset;
    EXPECT_EQ(with.alignments[i].is_fixed, without.alignments[i].is_fixed);
    EXPECT_LT((offset - without.alignments[i].crosses.offset).norm(), 1e-12);
  }
}
