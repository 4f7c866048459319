// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/nearest_cross.h>
#include <Quadrille/octahedral_group.h>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

using namespace Quadrille;

namespace {

struct Nearest_cross_test : ::testing::Test {
  std::mt19937 engine{2};
  std::normal_distribution<double> normal;

  Eigen::Matrix3d rotation()
  {
    return Eigen::Quaterniond(normal(engine), normal(engine), normal(engine), normal(engine))
        .normalized()
        .toRotationMatrix();
  }
  Eigen::Matrix3d turned(const Eigen::Matrix3d& R, double angle)
  {
    const Eigen::Vector3d axis(normal(engine), normal(engine), normal(engine));
    return Eigen::AngleAxisd(angle * normal(engine), axis.normalized()).toRotationMatrix() * R;
  }
  Cross_harmonics mean(int n, bool near)
  {
    const Eigen::Matrix3d R = rotation();
    Cross_harmonics sum = Cross_harmonics::Zero();
    for (int i = 0; i < n; ++i)
      sum += cross_harmonics(near ? turned(R, 0.6) : rotation()) / n;
    return sum;
  }
};

} // namespace

TEST_F(Nearest_cross_test, crosses_are_their_own)
{
  for (int i = 0; i < 200; ++i) {
    const Eigen::Matrix3d R = rotation();
    const Nearest_cross cross = nearest_cross((1 + i) * cross_harmonics(R));
    EXPECT_NEAR(cross.alignment, 1 + i, 1e-12 * (1 + i));
    EXPECT_LT((cross_harmonics(cross.frame) - cross_harmonics(R)).norm(), 1e-13);
    EXPECT_LT((cross.frame * matching_of_frames(cross.frame, R).matrix() - R).norm(), 1e-7); // the same up to the group
    EXPECT_NEAR(cross.frame.determinant(), 1, 1e-13);
  }
}

// The alignment is stationary, and no other start leads higher.
TEST_F(Nearest_cross_test, averages_have_their_global_maximum)
{
  for (int i = 0; i < 3000; ++i) {
    const Cross_harmonics q = i % 2 == 0 ? mean(6, true) : mean(3, false);
    const Nearest_cross cross = nearest_cross(q);
    const Cross_harmonics v = cross_harmonics(cross.frame);
    EXPECT_NEAR(q.dot(v), cross.alignment, 1e-13);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(q.dot(rotation_generator(axis, v)), 0, 1e-12);
    for (int start = 0; start < 20; ++start)
      EXPECT_LE(nearest_cross(q, rotation()).alignment, cross.alignment + 1e-12);
  }
}

TEST_F(Nearest_cross_test, many_are_as_one_by_one_and_turn_with_space)
{
  std::vector<Cross_harmonics> q, turned_q;
  const Eigen::Matrix3d R = rotation();
  for (int i = 0; i < 1001; ++i) { // odd: the last one is alone
    q.push_back(mean(6, true));
    turned_q.push_back(Harmonic_rotation(R)(q.back()));
  }
  const std::vector<Nearest_cross> all = nearest_crosses(q, 1), parallel = nearest_crosses(q, 2),
                                   turned = nearest_crosses(turned_q);
  for (std::size_t i = 0; i < q.size(); ++i) {
    EXPECT_EQ(all[i].frame, parallel[i].frame);
    EXPECT_NEAR(nearest_cross(q[i]).alignment, all[i].alignment, 1e-14);
    EXPECT_NEAR(turned[i].alignment, all[i].alignment, 1e-12);
  }
  EXPECT_TRUE(nearest_crosses({}).empty());
}

TEST_F(Nearest_cross_test, zero_has_any)
{
  const Nearest_cross cross = nearest_cross(Cross_harmonics::Zero());
  EXPECT_EQ(cross.alignment, 0);
  EXPECT_NEAR(cross.frame.determinant(), 1, 1e-13);
}

TEST_F(Nearest_cross_test, warm_starts_stay_near)
{
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3d R = rotation();
    const Cross_harmonics q = cross_harmonics(turned(R, 0.02)) + 0.5 * cross_harmonics(turned(R, 0.02));
    const Nearest_cross cross = nearest_cross(q, R);
    EXPECT_LE(cross.iterations, 5);
    EXPECT_NEAR(cross.alignment, nearest_cross(q).alignment, 1e-13);
    EXPECT_GT((R.transpose() * cross.frame).trace(), 2.9); // not another frame of the same cross
  }
}

// volume, Section 3.2.
TEST_F(Nearest_cross_test, eigentensors_give_back_crosses)
{
  for (int i = 0; i < 200; ++i) {
    const Eigen::Matrix3d R = rotation();
    const Cross_harmonics q = cross_harmonics(R);
    EXPECT_LT((cross_harmonics(cross_of_eigentensors(cross_tensor(q))) - q).norm(), 1e-9);
  }
}

// Equal weights, as the paper prints them, fail where the eigentensors are the squares of the axes: their sum is the
// identity, which every direction diagonalises.
TEST_F(Nearest_cross_test, plain_sum_of_eigentensors_degenerates)
{
  const Eigen::Matrix3d R = rotation();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  const Symmetric_tensor_3::Mandel_matrix m = cross_tensor(cross_harmonics(R)).mandel();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Matrix<double, 6, 1> d = mandel_vector(R.col(k) * R.col(k).transpose());
    EXPECT_LT((m * d - d).norm(), 1e-13); // an orthonormal basis of the eigenspace
    sum += matrix_of_mandel_vector(d);
  }
  EXPECT_LT((sum - Eigen::Matrix3d::Identity()).norm(), 1e-13);
  // Of nearly the same tensor they are the only eigentensors. An eigensolver returns them for the coordinate axes, too.
  const Symmetric_tensor_3 unequal = Symmetric_tensor_3::power(R.col(0)) + 0.999 * Symmetric_tensor_3::power(R.col(1)) +
                                     0.998 * Symmetric_tensor_3::power(R.col(2));
  EXPECT_LT((cross_harmonics(cross_of_eigentensors(unequal)) - cross_harmonics(R)).norm(), 1e-9);
  const Cross_harmonics axes = cross_harmonics(Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  EXPECT_LT((cross_harmonics(cross_of_eigentensors(cross_tensor(axes))) - axes).norm(), 1e-12);
}

TEST_F(Nearest_cross_test, eigentensors_are_not_the_nearest_cross)
{
  double largest_gap = 0;
  for (int i = 0; i < 200; ++i) {
    const Cross_harmonics q = mean(6, true);
    const double alignment = q.dot(cross_harmonics(cross_of_eigentensors(cross_tensor(q))));
    EXPECT_LE(alignment, nearest_cross(q).alignment + 1e-12);
    largest_gap = std::max(largest_gap, nearest_cross(q).alignment - alignment);
  }
  EXPECT_GT(largest_gap, 0.01);
}

TEST(Octahedral_group, is_one)
{
  using Kind = Octahedral_rotation::Kind;
  std::map<Kind, int> kinds;
  for (int a = 0; a < Octahedral_rotation::number_of_elements; ++a) {
    const Octahedral_rotation g(a);
    ++kinds[g.kind()];
    EXPECT_EQ(g.matrix().determinant(), 1);
    EXPECT_EQ((g * g.inverse()).number(), 0);
    EXPECT_EQ(Octahedral_rotation::nearest(g.matrix()), g);
    EXPECT_LT((cross_harmonics(g.matrix()) - cross_harmonics(Eigen::Matrix3d::Identity())).norm(), 1e-13);
    for (int b = 0; b < Octahedral_rotation::number_of_elements; ++b)
      EXPECT_EQ((g * Octahedral_rotation(b)).matrix(), g.matrix() * Octahedral_rotation(b).matrix());
    const double angle = std::acos(std::clamp((g.matrix().trace() - 1) / 2, -1.0, 1.0));
    const Eigen::Vector3d axis = g.axis().cast<double>();
    if (a != 0) {
      EXPECT_LT((Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix() - g.matrix()).norm(), 1e-12) << a;
    }
  }
  EXPECT_EQ(Octahedral_rotation(), Octahedral_rotation(0));
  EXPECT_EQ(kinds, (std::map<Kind, int>{{Kind::identity, 1},
                                        {Kind::quarter_turn, 6},
                                        {Kind::half_turn, 3},
                                        {Kind::third_turn, 8},
                                        {Kind::diagonal_half_turn, 6}}));
}

TEST(Octahedral_group, every_rotation_is_near_an_element)
{
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Matrix3d P = Eigen::Quaterniond(normal(engine), normal(engine), normal(engine), normal(engine))
                                  .normalized()
                                  .toRotationMatrix();
    const Eigen::Matrix3d rest = P.transpose() * Octahedral_rotation::nearest(P).matrix();
    worst = std::max(worst, std::acos((rest.trace() - 1) / 2));
  }
  EXPECT_LT(worst, 62.8 * std::acos(-1.0) / 180);
  EXPECT_GT(worst, 58 * std::acos(-1.0) / 180);
}
