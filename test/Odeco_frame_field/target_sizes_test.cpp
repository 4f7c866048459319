// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "field_test_meshes.h"

#include <Quadrille/Odeco_frame_field/internal/Metric_residual.h>
#include <Quadrille/odeco_frame_field.h>
#include <Quadrille/sample_target_sizes.h>

#include <CGAL/boost/graph/properties.h>
#include <boost/property_map/vector_property_map.hpp>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <array>

namespace {

using namespace Quadrille;
using namespace Quadrille_test;

/// Per face the geometric mean of the frame's sizes; frames are aligned with the border, where `border` is the size.
std::vector<double> face_sizes(const Mesh& mesh, double border, const Odeco_field_options& options)
{
  std::vector<Edge_frame_constraint> constraints(mesh.number_of_edges());
  for (const Mesh::Edge_index e : mesh.edges())
    if (mesh.is_border(e))
      constraints[e] = {true, true, border, border};
  std::vector<Gradient_pair> gradients(mesh.number_of_faces());
  odeco_frame_field(mesh, mesh.points(),
                    boost::make_iterator_property_map(constraints.begin(), boost::identity_property_map()),
                    boost::make_iterator_property_map(gradients.begin(), boost::identity_property_map()), options);
  std::vector<double> sizes;
  for (const auto& [du, dv] : gradients)
    sizes.push_back(1 / std::sqrt(du.norm() * dv.norm()));
  return sizes;
}

Odeco_field_options relaxed_only()
{
  Odeco_field_options options;
  options.starts = 0;
  options.threads = 1;
  return options;
}

TEST(Target_sizes, alone_decide_the_size)
{
  const Mesh mesh = square(8, 3).surface_mesh();
  for (const bool isotropic : {true, false})
    for (const double scale : {1.0, 1e-8, 1e8}) {
      Odeco_field_options options = relaxed_only();
      options.isotropic = isotropic;
      options.target_size = sample_target_sizes(mesh, mesh.points(), [&](const auto&) { return 0.2 * scale; });
      for (const double size : face_sizes(mesh, 0, options))
        EXPECT_NEAR(size / scale, 0.2, 1e-6);
    }
}

TEST(Target_sizes, are_met_the_better_the_larger_their_weight)
{
  // Size 0.1 on the border, 0.2 wanted in the middle: no isotropic field without singularities has both.
  const Mesh mesh = square(20, 1).surface_mesh();
  const auto is_inside = [](const auto& p) { return std::hypot(p.x() - 0.5, p.y() - 0.5) < 0.2; };
  Odeco_field_options options = relaxed_only();
  double last = face_sizes(mesh, 0.1, options)[mesh.number_of_faces() / 2];
  EXPECT_NEAR(last, 0.1, 1e-6);
  options.target_size = sample_target_sizes(mesh, mesh.points(), [&](const auto& p) { return is_inside(p) ? 0.2 : 0; });
  for (const double weight : {1., 10., 100., 10000.}) {
    options.target_size_weight = weight;
    const std::vector<double> sizes = face_sizes(mesh, 0.1, options);
    double mean = 0;
    int n = 0;
    for (const Mesh::Face_index f : mesh.faces()) {
      bool inside = true;
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        inside = inside && is_inside(mesh.point(v));
      if (inside) {
        mean += sizes[f];
        ++n;
      }
    }
    mean /= n;
    EXPECT_GT(mean, last);
    last = mean;
  }
  EXPECT_NEAR(last, 0.2, 0.02);
}

TEST(Target_sizes, can_be_imposed)
{
  const Mesh mesh = square(10, 1).surface_mesh();
  for (const bool isotropic : {true, false}) {
    Odeco_field_options options = relaxed_only();
    options.isotropic = isotropic;
    options.impose_target_size = true;
    options.target_size = sample_target_sizes(mesh, mesh.points(), [](const auto& p) { return 0.1 + 0.02 * p.x(); });
    const std::vector<double> sizes = face_sizes(mesh, 0, options);
    for (const Mesh::Face_index f : mesh.faces()) {
      double x = 0;
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        x += mesh.point(v).x() / 3;
      EXPECT_NEAR(sizes[f], 0.1 + 0.02 * x, 1e-6);
    }
  }
}

/// S with eigenvalues `l` at the angle `t` and `m` across.
Eigen::Matrix2d size_matrix(double l, double m, double t)
{
  const Eigen::Rotation2Dd turn(t);
  return turn * Eigen::Vector2d(l, m).asDiagonal() * turn.inverse();
}

Eigen::Matrix2d size_matrix_of(const Gradient_pair& gradients)
{
  const auto& [du, dv] = gradients;
  return du * du.transpose() / std::pow(du.norm(), 3) + dv * dv.transpose() / std::pow(dv.norm(), 3);
}

std::vector<Gradient_pair> gradients_with(const Mesh& mesh, double border, bool aligned,
                                          const Odeco_field_options& options)
{
  std::vector<Edge_frame_constraint> constraints(mesh.number_of_edges());
  for (const Mesh::Edge_index e : mesh.edges())
    if (mesh.is_border(e))
      constraints[e] = {true, aligned, border, border};
  std::vector<Gradient_pair> gradients(mesh.number_of_faces());
  odeco_frame_field(mesh, mesh.points(),
                    boost::make_iterator_property_map(constraints.begin(), boost::identity_property_map()),
                    boost::make_iterator_property_map(gradients.begin(), boost::identity_property_map()), options);
  return gradients;
}

TEST(Target_metrics, alone_decide_sizes_and_directions)
{
  // Frames of 0.3 x 0.1, turned, on a square that is not turned and has no constraint but unaligned free edges.
  const Mesh mesh = square(8, 3).surface_mesh();
  for (const bool impose : {false, true})
    for (const double scale : {1.0, 1e8, 1e-8}) {
      const Eigen::Matrix2d wanted = size_matrix(0.3, 0.1, 0.4);
      Odeco_field_options options = relaxed_only();
      options.isotropic = false;
      options.impose_target_size = impose;
      const Eigen::Matrix2d metric = (wanted * wanted).inverse() / (scale * scale);
      options.target_metric = sample_target_metrics(
          mesh, mesh.points(), [&](const auto&) -> Eigen::Matrix2d { return 0.5 * (metric + metric.transpose()); });
      for (const Gradient_pair& pair : gradients_with(mesh, 0, false, options))
        EXPECT_LT((size_matrix_of(pair) / scale - wanted).norm(), 1e-5);
    }
}

TEST(Target_metrics, their_residual_vanishes_for_their_frames_alone)
{
  const Eigen::Matrix2d wanted = size_matrix(0.3, 0.1, 0.4);
  const internal::Metric_residual residual = internal::metric_residual((wanted * wanted).inverse());
  const auto value = [&](double l, double m, double t) -> Eigen::Vector3d {
    Orthogonal_frame_2 frame;
    frame.direction = {std::cos(t), std::sin(t)};
    frame.size_u = l;
    frame.size_v = m;
    Eigen::Vector4d q;
    q << odeco_harmonics(frame).head<3>(), 1;
    return residual * q;
  };
  EXPECT_LT(value(0.3, 0.1, 0.4).norm(), 1e-14);
  EXPECT_LT(value(0.1, 0.3, 0.4 + CGAL_PI / 2).norm(), 1e-14);
  // The relative error of either size.
  EXPECT_NEAR(value(0.33, 0.1, 0.4).norm(), 0.1, 1e-12);
  EXPECT_NEAR(value(0.3, 0.12, 0.4).norm(), 0.2, 1e-12);
  EXPECT_GT(value(0.3, 0.1, 0.5).norm(), 0.05);
}

TEST(Target_metrics, ask_isotropic_frames_for_their_area)
{
  const Mesh mesh = square(8, 3).surface_mesh();
  Odeco_field_options options = relaxed_only();
  options.target_metric.assign(mesh.number_of_vertices(), Eigen::Vector2d(100, 4).asDiagonal()); // sizes 0.1 and 0.5
  for (const double size : face_sizes(mesh, 0, options))
    EXPECT_NEAR(size, std::sqrt(0.05), 1e-6);
}

TEST(Target_metrics, unusable_ones_are_rejected)
{
  const Mesh mesh = square(2, 1).surface_mesh();
  Odeco_field_options options = relaxed_only();
  options.target_metric.assign(3, Eigen::Matrix2d::Identity());
  EXPECT_THROW(face_sizes(mesh, 0.1, options), Invalid_argument_error);
  for (const auto& [xx, xy, yx, yy] : {std::array{-1., 0., 0., -1.}, {1., 2., 2., 1.}, {1., 0.5, 0.4, 1.}}) {
    options.target_metric.assign(mesh.number_of_vertices(), (Eigen::Matrix2d() << xx, xy, yx, yy).finished());
    EXPECT_THROW(face_sizes(mesh, 0.1, options), Invalid_argument_error);
  }
}

TEST(Target_sizes, unusable_ones_are_rejected)
{
  const Mesh mesh = square(2, 1).surface_mesh();
  Odeco_field_options options = relaxed_only();
  options.target_size.assign(3, 1.0);
  EXPECT_THROW(face_sizes(mesh, 0.1, options), Invalid_argument_error);
  options.target_size.assign(mesh.number_of_vertices(), -1.0);
  EXPECT_THROW(face_sizes(mesh, 0.1, options), Invalid_argument_error);
  options.target_size.assign(mesh.number_of_vertices(), 1.0);
  options.target_size_weight = -1;
  EXPECT_THROW(face_sizes(mesh, 0.1, options), Invalid_argument_error);
}

} // namespace
