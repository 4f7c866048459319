// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/odeco_restrictions_3.h>
#include <Quadrille/odeco_tensors_2.h>
#include <Quadrille/odeco_tensors_3.h>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <cmath>
#include <functional>
#include <random>

using namespace Quadrille;

namespace {

struct Odeco_restrictions_3_test : ::testing::Test {
  std::mt19937 engine{4};
  std::normal_distribution<double> normal;

  Eigen::Matrix3d rotation()
  {
    return Eigen::Quaterniond(normal(engine), normal(engine), normal(engine), normal(engine))
        .normalized()
        .toRotationMatrix();
  }
  double value() { return std::exp(normal(engine)); }
  Eigen::Matrix3d turned_about(const Eigen::Vector3d& axis)
  {
    Eigen::Matrix3d frame;
    frame << axis.unitOrthogonal(), axis.cross(axis.unitOrthogonal()), axis;
    return Eigen::AngleAxisd(4 * normal(engine), axis).toRotationMatrix() * frame;
  }

  /// `restriction` is the affine hull of the tensors that `member` makes: the paper's procedure, by random samples.
  void check(const Odeco_restriction& restriction, int dimension, const std::function<Orthogonal_frame_3()>& member)
  {
    ASSERT_EQ(restriction.dimension(), dimension);
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(dimension, dimension);
    EXPECT_LT((restriction.basis.transpose() * restriction.basis - identity).norm(), 1e-14 * (1 + dimension));
    const Spherical_harmonics first = odeco_tensor(member()).harmonics();
    Eigen::Matrix<double, 15, 60> samples;
    for (int i = 0; i < samples.cols(); ++i) {
      const Spherical_harmonics q = odeco_tensor(member()).harmonics();
      EXPECT_LT(std::sqrt(restriction.squared_distance(q)), 1e-13 * (1 + q.norm()));
      EXPECT_LT((restriction.harmonics(restriction.coordinates(q)) - q).norm(), 1e-13 * (1 + q.norm()));
      samples.col(i) = (q - first).normalized();
    }
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(samples, Eigen::ComputeFullU);
    EXPECT_EQ(svd.setThreshold(1e-10).rank(), dimension);
    const Eigen::MatrixXd span = svd.matrixU().leftCols(dimension);
    EXPECT_LT((span * span.transpose() - restriction.basis * restriction.basis.transpose()).norm(), 1e-12);
    // Others are as far from it as the null space of the samples says.
    const Eigen::MatrixXd equations = svd.matrixU().rightCols(15 - dimension).transpose();
    const Spherical_harmonics other =
        odeco_tensor({rotation(), {value(), value(), value()}}).harmonics() + 0.1 * Spherical_harmonics::Ones();
    EXPECT_NEAR(restriction.squared_distance(other), (equations * (other - first)).squaredNorm(),
                1e-12 * (other - first).squaredNorm());
    if (dimension < 15) {
      EXPECT_GT(restriction.squared_distance(other), 1e-4);
    }
  }
};

} // namespace

TEST_F(Odeco_restrictions_3_test, axis_with_a_value)
{
  for (const double size : {1.0, 0.3, -2.0}) {
    const Eigen::Vector3d axis = rotation().col(0);
    check(restriction_to_axis(axis, size), 5, [&] {
      return Orthogonal_frame_3{turned_about(axis), {value(), value(), size}};
    });
  }
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  EXPECT_GT(restriction_to_axis(axis, 1).squared_distance(odeco_tensor({rotation(), {1, 1, 1}}).harmonics()), 1e-4);
  EXPECT_GT(restriction_to_axis(axis, 1).squared_distance(odeco_tensor({turned_about(axis), {1, 1, 2}}).harmonics()),
            1e-4);
}

TEST_F(Odeco_restrictions_3_test, coordinates_are_the_planar_part)
{
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d frame = rotation();
    const Odeco_restriction restriction = restriction_to_axis_of_frame(frame, 1.5);
    EXPECT_EQ(restriction.frame, frame);
    const Circular_harmonics planar = Circular_harmonics::NullaryExpr([&] { return normal(engine); });
    const Symmetric_tensor_3 T =
        Symmetric_tensor_3::from_harmonics(restriction.harmonics(planar_part_scale() * planar));
    EXPECT_LT((restricted_to_plane(T, frame.col(0), frame.col(1)).harmonics() - planar).norm(), 1e-13 * planar.norm());
    EXPECT_NEAR(T(frame.col(2)), 1.5, 1e-13 * planar.norm());
    // In particular those of frames are the frames' planar tensors.
    const double angle = normal(engine), u = value(), v = value();
    Orthogonal_frame_3 f{frame, {u, v, 1.5}};
    f.axes = Eigen::AngleAxisd(angle, frame.col(2)).toRotationMatrix() * frame;
    const Eigen::VectorXd s = restriction.coordinates(odeco_tensor(f).harmonics());
    const Circular_harmonics expected = odeco_harmonics(Orthogonal_frame_2{{std::cos(angle), std::sin(angle)}, u, v});
    EXPECT_LT((s / planar_part_scale() - expected).norm(), 1e-13 * (1 + expected.norm()));
  }
}

TEST_F(Odeco_restrictions_3_test, axis_with_any_value)
{
  const Eigen::Vector3d axis = rotation().col(0);
  const Odeco_restriction restriction = restriction_to_axis(axis);
  check(restriction, 6, [&] { return Orthogonal_frame_3{turned_about(axis), {value(), value(), value()}}; });
  EXPECT_EQ(restriction.offset, Spherical_harmonics::Zero().eval());
}

TEST_F(Odeco_restrictions_3_test, two_axes)
{
  const Eigen::Matrix3d R = rotation();
  check(restriction_to_axes(R.col(2), 1, R.col(0), 0.4), 1, [&] { return Orthogonal_frame_3{R, {0.4, value(), 1}}; });
  check(restriction_to_axes(R.col(2), 1.2, R.col(0)), 2, [&] {
    return Orthogonal_frame_3{R, {value(), value(), 1.2}};
  });
  EXPECT_LT((restriction_to_axes(R.col(2), 1, R.col(0)).frame - R).norm(), 1e-14);
}

TEST_F(Odeco_restrictions_3_test, isotropic_across_the_axis)
{
  const Eigen::Vector3d axis = rotation().col(0);
  const Odeco_restriction restriction = restriction_to_isotropic(axis, 1);
  check(restriction, 3, [&] {
    const double both = value();
    return Orthogonal_frame_3{turned_about(axis), {both, both, 1}};
  });
  EXPECT_GT(restriction.squared_distance(odeco_tensor({turned_about(axis), {1, 2, 1}}).harmonics()), 1e-2);
}

TEST_F(Odeco_restrictions_3_test, crosses)
{
  check(restriction_to_crosses(), 9, [&] { return Orthogonal_frame_3{rotation(), {1, 1, 1}}; });
  const Eigen::Vector3d axis = rotation().col(0);
  check(restriction_to_crosses(axis), 2, [&] { return Orthogonal_frame_3{turned_about(axis), {1, 1, 1}}; });
  check(unrestricted(), 15, [&] { return Orthogonal_frame_3{rotation(), {value(), value(), value()}}; });
}
