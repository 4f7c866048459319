// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/odeco_tensors_2.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace Quadrille;

const double pi = std::acos(-1.0);

class Random {
public:
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(m_engine); }
  Circular_harmonics harmonics()
  {
    return Circular_harmonics::NullaryExpr([&](Eigen::Index) { return (*this)(-1, 1); });
  }
  Orthogonal_frame_2 frame()
  {
    const double t = (*this)(-pi, pi);
    return {{std::cos(t), std::sin(t)}, (*this)(0.1, 3), (*this)(0.1, 3)};
  }

private:
  std::mt19937 m_engine{7};
};

Eigen::Vector2d unit(double t) { return {std::cos(t), std::sin(t)}; }

TEST(Symmetric_tensor_2, harmonics_are_the_fourier_coefficients_of_the_polynomial)
{
  Random random;
  for (int i = 0; i < 20; ++i) {
    const Circular_harmonics q = random.harmonics();
    const Symmetric_tensor_2 T = Symmetric_tensor_2::from_harmonics(q);
    EXPECT_LT((T.harmonics() - q).norm(), 1e-14);
    const double t = random(0, 2 * pi);
    const double series = q[0] / std::sqrt(2 * pi) + (std::cos(2 * t) * q[1] + std::sin(2 * t) * q[2] +
                                                      std::cos(4 * t) * q[3] + std::sin(4 * t) * q[4]) /
                                                         std::sqrt(pi);
    EXPECT_NEAR(T(unit(t)), series, 1e-13);
    // The polynomial written out with all sixteen components.
    double sum = 0;
    const Eigen::Vector2d w = unit(t);
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        for (int c = 0; c < 2; ++c)
          for (int d = 0; d < 2; ++d)
            sum += T(a, b, c, d) * w[a] * w[b] * w[c] * w[d];
    EXPECT_NEAR(sum, series, 1e-13);
  }
}

TEST(Symmetric_tensor_2, harmonics_norm_is_the_l2_norm_on_the_circle)
{
  Random random;
  const Circular_harmonics q = random.harmonics();
  const Symmetric_tensor_2 T = Symmetric_tensor_2::from_harmonics(q);
  const int n = 64; // exact for trigonometric polynomials of degree 8
  double integral = 0;
  for (int i = 0; i < n; ++i)
    integral += std::pow(T(unit(2 * pi * i / n)), 2) * 2 * pi / n;
  EXPECT_NEAR(integral, q.squaredNorm(), 1e-13);
}

TEST(Symmetric_tensor_2, powers_contract_to_scalar_products)
{
  const Eigen::Vector2d w(0.3, -1.2), x(2, 0.7);
  const Symmetric_tensor_2 T = Symmetric_tensor_2::power(w);
  EXPECT_NEAR(T(x), std::pow(w.dot(x), 4), 1e-12);
  EXPECT_LT((T.contract_thrice(x) - std::pow(w.dot(x), 3) * w).norm(), 1e-12);
  EXPECT_LT((T.contract_twice(x) - std::pow(w.dot(x), 2) * w * w.transpose()).norm(), 1e-12);
}

TEST(Symmetric_tensor_2, rotation_turns_the_polynomial)
{
  Random random;
  const Symmetric_tensor_2 T = Symmetric_tensor_2::from_harmonics(random.harmonics());
  const double angle = 0.4;
  for (const double t : {0.1, 1.3, 4.0})
    EXPECT_NEAR(T.rotated(angle)(unit(t + angle)), T(unit(t)), 1e-13);
  const Eigen::Vector2d w(1, 2);
  EXPECT_LT((Symmetric_tensor_2::power(w).rotated(angle).entries() -
             Symmetric_tensor_2::power(Eigen::Rotation2Dd(angle) * w).entries())
                .norm(),
            1e-12);
}

// Robeva: T is odeco exactly if (T*T)_abcdef = T_abcs T_defs is symmetric in all six indices; planar-2, eq. (14).
double asymmetry(const Symmetric_tensor_2& T)
{
  const auto product = [&](int i) {
    double sum = 0;
    for (int s = 0; s < 2; ++s)
      sum += T(i & 1, i >> 1 & 1, i >> 2 & 1, s) * T(i >> 3 & 1, i >> 4 & 1, i >> 5 & 1, s);
    return sum;
  };
  double low[7], high[7];
  std::fill(low, low + 7, 1e300);
  std::fill(high, high + 7, -1e300);
  for (int i = 0; i < 64; ++i) {
    int twos = 0;
    for (int b = 0; b < 6; ++b)
      twos += i >> b & 1;
    low[twos] = std::min(low[twos], product(i));
    high[twos] = std::max(high[twos], product(i));
  }
  double largest = 0;
  for (int twos = 0; twos < 7; ++twos)
    largest = std::max(largest, high[twos] - low[twos]);
  return largest;
}

TEST(Odeco_variety, vanishes_on_frames_and_agrees_with_robevas_criterion)
{
  Random random;
  for (int i = 0; i < 50; ++i) {
    const Circular_harmonics q = odeco_harmonics(random.frame());
    EXPECT_LT(odeco_residuals(q).norm(), 1e-12);
    EXPECT_LT(asymmetry(Symmetric_tensor_2::from_harmonics(q)), 1e-12);
    const Circular_harmonics other = random.harmonics();
    const double ratio = odeco_residuals(other).norm() / asymmetry(Symmetric_tensor_2::from_harmonics(other));
    EXPECT_GT(ratio, 1); // both vanish together: their ratio stays within fixed bounds
    EXPECT_LT(ratio, 100);
  }
}

TEST(Odeco_variety, tensor_of_a_frame_is_the_sum_of_its_powers)
{
  Random random;
  const Orthogonal_frame_2 frame = random.frame();
  const Symmetric_tensor_2 T = frame.size_u * Symmetric_tensor_2::power(frame.direction) +
                               frame.size_v * Symmetric_tensor_2::power(frame.normal());
  EXPECT_LT((T.harmonics() - odeco_harmonics(frame)).norm(), 1e-13);
  EXPECT_NEAR(frame_area(odeco_harmonics(frame)), frame.size_u * frame.size_v, 1e-12);
}

TEST(Nearest_odeco_frame, returns_frames_unchanged_at_every_scale)
{
  Random random;
  for (const double scale : {1.0, 1e8, 1e-8})
    for (int i = 0; i < 50; ++i) {
      Orthogonal_frame_2 frame = random.frame();
      frame.size_u *= scale;
      frame.size_v *= scale;
      const Circular_harmonics q = odeco_harmonics(frame);
      EXPECT_LT((odeco_harmonics(nearest_odeco_frame(q)) - q).norm(), 1e-13 * q.norm());
      EXPECT_LT((odeco_harmonics(recover_frame(q)) - q).norm(), 1e-12 * q.norm());
    }
}

TEST(Nearest_odeco_frame, no_frame_is_nearer)
{
  Random random;
  for (int i = 0; i < 200; ++i) {
    const Circular_harmonics q = random.harmonics();
    const double found = (odeco_harmonics(nearest_odeco_frame(q)) - q).norm();
    // Best sizes for each of many directions, by an independent 2x2 least-squares solve.
    double best = 1e300;
    for (int k = 0; k < 400; ++k) {
      Eigen::Matrix<double, 5, 2> basis;
      basis.col(0) = Symmetric_tensor_2::power(unit(pi / 2 * k / 400)).harmonics();
      basis.col(1) = Symmetric_tensor_2::power(unit(pi / 2 * k / 400 + pi / 2)).harmonics();
      const Eigen::Vector2d sizes = (basis.transpose() * basis).ldlt().solve(basis.transpose() * q);
      best = std::min(best, (basis * sizes - q).norm());
    }
    EXPECT_LE(found, best + 1e-12);
    EXPECT_GT(found, best - 1e-3);
  }
}

TEST(Nearest_odeco_frame, turns_with_the_tensor)
{
  Random random;
  for (int i = 0; i < 20; ++i) {
    const Symmetric_tensor_2 T = Symmetric_tensor_2::from_harmonics(random.harmonics());
    const Symmetric_tensor_2 projected =
        Symmetric_tensor_2::from_harmonics(odeco_harmonics(nearest_odeco_frame(T.harmonics())));
    const Circular_harmonics turned = odeco_harmonics(nearest_odeco_frame(T.rotated(0.3).harmonics()));
    EXPECT_LT((projected.rotated(0.3).harmonics() - turned).norm(), 1e-7);
  }
}

TEST(Eigenpairs, satisfy_their_equation_and_contain_the_frame)
{
  Random random;
  for (int i = 0; i < 50; ++i) {
    const Symmetric_tensor_2 T = Symmetric_tensor_2::from_harmonics(random.harmonics());
    const auto pairs = eigenpairs(T);
    EXPECT_GE(pairs.size(), 2u); // a function on the circle has a maximum and a minimum
    for (const auto& [value, w] : pairs)
      EXPECT_LT((T.contract_thrice(w) - value * w).norm(), 1e-9);
    const Orthogonal_frame_2 frame = random.frame();
    double nearest_u = 1, nearest_v = 1;
    for (const auto& [value, w] : eigenpairs(Symmetric_tensor_2::from_harmonics(odeco_harmonics(frame)))) {
      nearest_u = std::min(nearest_u, std::hypot(1 - std::abs(w.dot(frame.direction)), value - frame.size_u));
      nearest_v = std::min(nearest_v, std::hypot(1 - std::abs(w.dot(frame.normal())), value - frame.size_v));
    }
    EXPECT_LT(nearest_u, 1e-9);
    EXPECT_LT(nearest_v, 1e-9);
  }
  EXPECT_TRUE(eigenpairs(Symmetric_tensor_2::from_harmonics(Circular_harmonics::Unit(0))).empty());
}

} // namespace
