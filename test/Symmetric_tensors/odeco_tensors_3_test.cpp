// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Odeco_quadrics_3.h>
#include <Quadrille/odeco_tensors_2.h>
#include <Quadrille/odeco_tensors_3.h>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <random>

using namespace Quadrille;

namespace {

struct Odeco_tensors_3_test : ::testing::Test {
  std::mt19937 engine{3};
  std::normal_distribution<double> normal;

  Eigen::Matrix3d rotation()
  {
    return Eigen::Quaterniond(normal(engine), normal(engine), normal(engine), normal(engine))
        .normalized()
        .toRotationMatrix();
  }
  Orthogonal_frame_3 frame()
  {
    const auto value = [&] { return std::exp(normal(engine)); };
    return {rotation(), {value(), value(), value()}};
  }
  Symmetric_tensor_3 any()
  {
    return Symmetric_tensor_3::from_harmonics(Spherical_harmonics::NullaryExpr([&] { return normal(engine); }));
  }
  /// The mean of some odeco tensors of axes turned from common ones by about 0.3.
  Symmetric_tensor_3 mean(int n)
  {
    const Orthogonal_frame_3 common = frame();
    Symmetric_tensor_3 sum;
    for (int i = 0; i < n; ++i) {
      const Eigen::Quaterniond turn(1, 0.15 * normal(engine), 0.15 * normal(engine), 0.15 * normal(engine));
      sum =
          sum + (1.0 / n) * odeco_tensor({turn.normalized() * common.axes, common.values.cwiseProduct(frame().values)});
    }
    return sum;
  }
  static double distance(const Symmetric_tensor_3& T, const Orthogonal_frame_3& frame, Tensor_norm norm)
  {
    const Symmetric_tensor_3 difference = T + (-1.0) * odeco_tensor(frame);
    return norm == Tensor_norm::harmonics ? difference.harmonics().norm() : std::sqrt(difference.squared_norm());
  }
};

/// |G - sym(G)|^2 for G_ijkpqr = T_ijks T_pqrs, from all 729 components.
double squared_asymmetry(const Symmetric_tensor_3& T)
{
  double sum[7][7] = {}, squares = 0;
  int number[7][7] = {}; // by how many indices are 2 and 3
  const auto for_each = [&](const auto& visit) {
    for (int c = 0; c < 729; ++c) {
      const int i[6] = {c % 3, c / 3 % 3, c / 9 % 3, c / 27 % 3, c / 81 % 3, c / 243};
      double g = 0;
      for (int s = 0; s < 3; ++s)
        g += T(i[0], i[1], i[2], s) * T(i[3], i[4], i[5], s);
      visit(std::count(i, i + 6, 1), std::count(i, i + 6, 2), g);
    }
  };
  for_each([&](auto n2, auto n3, double g) {
    sum[n2][n3] += g;
    ++number[n2][n3];
  });
  for_each([&](auto n2, auto n3, double g) { squares += std::pow(g - sum[n2][n3] / number[n2][n3], 2); });
  return squares;
}

} // namespace

TEST_F(Odeco_tensors_3_test, residuals_vanish_on_the_variety_only)
{
  for (int i = 0; i < 50; ++i) {
    const Symmetric_tensor_3 T = odeco_tensor(frame());
    EXPECT_LT(odeco_residuals(T).norm(), 1e-14 * T.squared_norm());
    const Symmetric_tensor_3 other = any();
    const Odeco_residuals_3 residuals = odeco_residuals(other);
    EXPECT_GT(residuals.norm(), 1e-3 * other.squared_norm());
    EXPECT_NEAR(residuals.squaredNorm(), squared_asymmetry(other), 1e-12 * std::pow(other.squared_norm(), 2));
    EXPECT_NEAR(odeco_residuals(other.rotated(rotation())).norm(), residuals.norm(), 1e-12 * other.squared_norm());
  }
}

TEST_F(Odeco_tensors_3_test, residuals_are_27_independent_quadrics)
{
  Eigen::Matrix<double, 27, 200> samples; // the quadratic forms have 120 coefficients
  for (int i = 0; i < samples.cols(); ++i)
    samples.col(i) = odeco_residuals(any());
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(samples);
  EXPECT_GT(svd.singularValues()[26], 1e-2 * svd.singularValues()[0]);
}

TEST_F(Odeco_tensors_3_test, derivatives_of_residuals)
{
  for (int i = 0; i < 10; ++i) {
    const Symmetric_tensor_3 T = any(), step = any();
    // Quadratic forms: central differences have no error.
    const Odeco_residuals_3 difference = 0.5 * (odeco_residuals(T + step) - odeco_residuals(T + (-1.0) * step));
    EXPECT_LT((odeco_residual_derivatives(T) * step.entries() - difference).norm(), 1e-12 * difference.norm());
  }
}

// A tensor n^4 plus a tensor of the plane across n is odeco exactly if that of the plane is.
TEST_F(Odeco_tensors_3_test, sums_of_quadrics_are_those_of_their_rows)
{
  const Odeco_quadrics_3& quadrics = odeco_quadrics_3();
  for (int i = 0; i < 10; ++i) {
    const Symmetric_tensor_3::Entries entries = any().entries();
    std::array<double, 15> t, half_gradient;
    std::copy(entries.data(), entries.data() + 15, t.begin());
    Eigen::Matrix<double, 27, 1> values;
    Eigen::Matrix<double, 27, 15> jacobian;
    for (int r = 0; r < 27; ++r) {
      values[r] = quadrics.values(t)[std::size_t(r)];
      for (int e = 0; e < 15; ++e)
        jacobian(r, e) = quadrics.jacobian(t)[std::size_t(r)][std::size_t(e)];
    }
    EXPECT_NEAR(quadrics.squared_norm(t, half_gradient), values.squaredNorm(), 1e-13 * values.squaredNorm());
    const Eigen::Matrix<double, 15, 1> gradient = jacobian.transpose() * values;
    const Eigen::Matrix<double, 15, 15> gram = jacobian.transpose() * jacobian;
    std::size_t n = 0;
    for (int e = 0; e < 15; ++e) {
      EXPECT_NEAR(half_gradient[std::size_t(e)], gradient[e], 1e-13 * gradient.norm());
      for (int f = 0; f <= e; ++f)
        EXPECT_NEAR(quadrics.gram(t)[n++], gram(e, f), 1e-13 * gram.norm());
    }
  }
}

TEST_F(Odeco_tensors_3_test, residuals_agree_with_those_of_the_plane)
{
  double lowest = 1e300, highest = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Matrix3d R = rotation();
    const Circular_harmonics q = Circular_harmonics::NullaryExpr([&] { return normal(engine); });
    // Every quartic form of the plane is a sum of five fourth powers.
    Eigen::Matrix<double, 5, 5> powers;
    Symmetric_tensor_3 T = 0.7 * Symmetric_tensor_3::power(R.col(2));
    for (int k = 0; k < 5; ++k)
      powers.col(k) = Symmetric_tensor_2::power({std::cos(0.6 * k), std::sin(0.6 * k)}).harmonics();
    const Circular_harmonics factors = powers.partialPivLu().solve(q);
    for (int k = 0; k < 5; ++k)
      T = T + factors[k] * Symmetric_tensor_3::power(std::cos(0.6 * k) * R.col(0) + std::sin(0.6 * k) * R.col(1));
    EXPECT_LT((restricted_to_plane(T, R.col(0), R.col(1)).harmonics() - q).norm(), 1e-12 * q.norm());
    const double ratio = odeco_residuals(T).norm() / odeco_residuals(q).norm();
    lowest = std::min(lowest, ratio);
    highest = std::max(highest, ratio);
  }
  EXPECT_GT(lowest, 0.02); // they vanish together: fixed multiples of the invariant and of the turning part
  EXPECT_LT(highest, 10 * lowest);
}

TEST_F(Odeco_tensors_3_test, powers_act_on_the_values)
{
  for (int i = 0; i < 20; ++i) {
    const Orthogonal_frame_3 f = frame();
    const Symmetric_tensor_3 T = odeco_tensor(f);
    for (const int exponent : {-2, -1, 0, 1, 2, 3}) {
      const Eigen::Vector3d values = f.values.array().pow(exponent);
      const Symmetric_tensor_3 expected = odeco_tensor({f.axes, values});
      EXPECT_LT((with_power(T, exponent).entries() - expected.entries()).norm(), 1e-12 * values.norm());
    }
    EXPECT_LT((with_power(T, 0).partial_trace() - Eigen::Matrix3d::Identity()).norm(), 1e-12); // a cross
  }
  // Not odeco: the mean over the four indices of the contraction.
  const Symmetric_tensor_3 T = any();
  const Eigen::Vector3d v = rotation().col(0);
  EXPECT_NEAR(with_power(T, 2)(v), (T.partial_trace() * v).dot(T.contract_thrice(v)), 1e-13 * T.squared_norm());
  EXPECT_LT((with_power(T, 1).entries() - T.entries()).norm(), 1e-13 * T.entries().norm());
}

TEST_F(Odeco_tensors_3_test, restrictions_to_planes_are_the_same_polynomial)
{
  for (int i = 0; i < 20; ++i) {
    const Symmetric_tensor_3 T = any();
    const Eigen::Matrix3d R = rotation();
    const Eigen::Vector2d x(normal(engine), normal(engine));
    EXPECT_NEAR(restricted_to_plane(T, R.col(0), R.col(1))(x), T(R.leftCols<2>() * x),
                1e-12 * std::pow(x.squaredNorm(), 2) * T.entries().norm());
  }
}

TEST_F(Odeco_tensors_3_test, odeco_tensors_are_their_own_nearest_at_every_scale)
{
  for (const Tensor_norm norm : {Tensor_norm::harmonics, Tensor_norm::components})
    for (const double scale : {1.0, 1e8, 1e-8})
      for (int i = 0; i < 60; ++i) {
        Orthogonal_frame_3 f = frame();
        if (i % 6 == 1)
          f.values = {1, 1, 1};
        else if (i % 6 == 2)
          f.values = {1, 1e-6, 3e-6};
        else if (i % 6 == 3)
          f.values = {2, 0, 0};
        else if (i % 6 == 4)
          f.values = {1, -1, 0.5};
        f.values *= scale;
        const Symmetric_tensor_3 T = odeco_tensor(f);
        const Orthogonal_frame_3 nearest = nearest_odeco_frame(T, norm);
        EXPECT_LT((odeco_tensor(nearest).entries() - T.entries()).norm(), 1e-14 * T.entries().norm());
        EXPECT_LT((nearest.axes * nearest.axes.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-13);
        EXPECT_NEAR(nearest.axes.determinant(), 1, 1e-13);
      }
}

TEST_F(Odeco_tensors_3_test, no_frame_is_nearer)
{
  for (const Tensor_norm norm : {Tensor_norm::harmonics, Tensor_norm::components})
    for (int i = 0; i < 500; ++i) {
      const Symmetric_tensor_3 T = mean(i % 2 == 0 ? 3 : 6);
      const Orthogonal_frame_3 nearest = nearest_odeco_frame(T, norm);
      const double found = distance(T, nearest, norm), size = std::sqrt(T.squared_norm());
      for (int k = 0; k < 10; ++k)
        EXPECT_GE(distance(T, nearest_odeco_frame(T, rotation(), norm), norm), found - 1e-9 * size);
      // Neither axes nor values can be better by a little: the distance is stationary.
      for (int k = 0; k < 3; ++k) {
        const auto changed = [&](double step) {
          Orthogonal_frame_3 f = nearest;
          f.axes = Eigen::AngleAxisd(step, Eigen::Vector3d::Unit(k)).toRotationMatrix() * f.axes;
          f.values[k] += step * size;
          return f;
        };
        for (const double step : {1e-4, -1e-4})
          EXPECT_GT(distance(T, changed(step), norm), found - 1e-13 * size);
      }
    }
}

TEST_F(Odeco_tensors_3_test, norms_differ_and_so_do_their_nearest_frames)
{
  double largest = 0;
  for (int i = 0; i < 50; ++i) {
    const Symmetric_tensor_3 T = mean(3);
    const Orthogonal_frame_3 on_sphere = nearest_odeco_frame(T),
                             by_components = nearest_odeco_frame(T, Tensor_norm::components);
    EXPECT_LE(distance(T, on_sphere, Tensor_norm::harmonics),
              distance(T, by_components, Tensor_norm::harmonics) + 1e-12);
    EXPECT_LE(distance(T, by_components, Tensor_norm::components),
              distance(T, on_sphere, Tensor_norm::components) + 1e-12);
    largest = std::max(largest, distance(odeco_tensor(on_sphere), by_components, Tensor_norm::harmonics));
  }
  EXPECT_GT(largest, 1e-3);
}

TEST_F(Odeco_tensors_3_test, nearest_turns_with_space)
{
  for (int i = 0; i < 100; ++i) {
    const Symmetric_tensor_3 T = mean(4);
    const Eigen::Matrix3d R = rotation();
    const Symmetric_tensor_3 turned = odeco_tensor(nearest_odeco_frame(T)).rotated(R);
    EXPECT_LT((odeco_tensor(nearest_odeco_frame(T.rotated(R))).entries() - turned.entries()).norm(),
              1e-7 * T.entries().norm());
  }
}

TEST_F(Odeco_tensors_3_test, tensors_without_axes_have_some)
{
  const Orthogonal_frame_3 zero = nearest_odeco_frame(Symmetric_tensor_3());
  EXPECT_EQ(zero.values, Eigen::Vector3d::Zero().eval());
  EXPECT_NEAR(zero.axes.determinant(), 1, 1e-13);
  const Symmetric_tensor_3 isotropic = Symmetric_tensor_3::from_harmonics(Spherical_harmonics::Unit(0));
  const Orthogonal_frame_3 frame = nearest_odeco_frame(isotropic); // every frame is as near
  EXPECT_NEAR(frame.axes.determinant(), 1, 1e-13);
  EXPECT_LT((frame.values - frame.values.mean() * Eigen::Vector3d::Ones()).norm(), 1e-13);
}

TEST_F(Odeco_tensors_3_test, eigenpairs_of_frames_are_known)
{
  for (int i = 0; i < 60; ++i) {
    Orthogonal_frame_3 f = frame();
    if (i % 3 == 1)
      f.values.setOnes();
    if (i % 3 == 2)
      f.axes.setIdentity();
    const double scale = std::pow(10.0, i % 5 * 4 - 8);
    const auto pairs = eigenpairs(odeco_tensor({f.axes, scale * f.values}));
    ASSERT_EQ(pairs.size(), 13u);
    for (int signs = 0; signs < 27; ++signs) {
      const Eigen::Array3d sign(signs % 3 - 1, signs / 3 % 3 - 1, signs / 9 - 1);
      const Eigen::Vector3d sum = f.axes * (sign * f.values.array().rsqrt()).matrix();
      if (sign.isZero())
        continue;
      const double value = scale / sum.squaredNorm(); // T S^3 = S for the sum S
      EXPECT_EQ(std::count_if(pairs.begin(), pairs.end(),
                              [&](const auto& pair) {
                                return std::abs(pair.second.dot(sum.normalized())) > 1 - 1e-12 &&
                                       std::abs(pair.first - value) < 1e-10 * value;
                              }),
                1);
    }
  }
}

TEST_F(Odeco_tensors_3_test, eigenpairs_of_others_are_all_there_are)
{
  for (int i = 0; i < 200; ++i) {
    const Symmetric_tensor_3 T = any();
    const auto pairs = eigenpairs(T);
    EXPECT_LE(pairs.size(), 13u);
    int indices = 0; // of the gradient of the polynomial, on the projective plane, whose Euler characteristic is 1
    for (const auto& [value, w] : pairs) {
      EXPECT_LT((T.contract_thrice(w) - value * w).norm(), 1e-12 * T.entries().norm());
      Eigen::Matrix<double, 3, 2> plane;
      plane << w.unitOrthogonal(), w.cross(w.unitOrthogonal());
      indices +=
          (plane.transpose() * (3 * T.contract_twice(w) - value * Eigen::Matrix3d::Identity()) * plane).determinant() >
                  0
              ? 1
              : -1;
    }
    EXPECT_EQ(indices, 1);
  }
  EXPECT_TRUE(eigenpairs(Symmetric_tensor_3::from_harmonics(Spherical_harmonics::Unit(0))).empty());
  EXPECT_TRUE(eigenpairs(Symmetric_tensor_3::power({1, 2, 3})).empty()); // everything across the axis
  EXPECT_TRUE(eigenpairs(Symmetric_tensor_3()).empty());
}
