// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/cross_harmonics.h>

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>
#include <random>

using namespace Quadrille;

namespace {

constexpr double tiny = 1e-13;

struct Cross_harmonics_test : ::testing::Test {
  std::mt19937 engine{1};
  std::normal_distribution<double> normal;

  template <class Vector> Vector random()
  {
    return Vector::NullaryExpr([this] { return normal(engine); });
  }
  Eigen::Matrix3d rotation()
  {
    const Eigen::Vector4d v = random<Eigen::Vector4d>().normalized();
    return Eigen::Quaterniond(v[0], v[1], v[2], v[3]).toRotationMatrix();
  }
  static Symmetric_tensor_3 tensor_of_axes(const Eigen::Matrix3d& R)
  {
    return Symmetric_tensor_3::power(R.col(0)) + Symmetric_tensor_3::power(R.col(1)) +
           Symmetric_tensor_3::power(R.col(2));
  }
};

} // namespace

TEST_F(Cross_harmonics_test, harmonics_are_orthonormal_on_the_sphere)
{
  // Gauss-Legendre nodes in z and equidistant angles: exact for polynomials of degree 8.
  const double node[] = {0, 0.5384693101056831, 0.9061798459386640};
  const double weight[] = {128.0 / 225, 0.4786286704993665, 0.2369268850561891};
  Eigen::Matrix<double, 15, 15> gram = Eigen::Matrix<double, 15, 15>::Zero();
  for (int i = -2; i <= 2; ++i)
    for (int k = 0; k < 9; ++k) {
      const double z = std::copysign(node[std::abs(i)], i), r = std::sqrt(1 - z * z), t = 2 * std::acos(-1.0) * k / 9;
      const auto h = internal::even_harmonics(r * std::cos(t), r * std::sin(t), z);
      gram += weight[std::abs(i)] * 2 * std::acos(-1.0) / 9 * h * h.transpose();
    }
  EXPECT_LT((gram - Eigen::Matrix<double, 15, 15>::Identity()).norm(), 1e-12);
}

TEST_F(Cross_harmonics_test, tensors_and_harmonics_are_the_same_polynomials)
{
  for (int i = 0; i < 20; ++i) {
    const Spherical_harmonics q = random<Spherical_harmonics>();
    const Symmetric_tensor_3 tensor = Symmetric_tensor_3::from_harmonics(q);
    const Eigen::Vector3d v = random<Eigen::Vector3d>();
    const double expected = q.dot(internal::even_harmonics(v.x(), v.y(), v.z()));
    EXPECT_NEAR(tensor(v), expected, tiny * q.norm() * std::pow(v.norm(), 4) * 10);
    EXPECT_LT((tensor.harmonics() - q).norm(), tiny * q.norm());
    double sum = 0; // over all 81 components
    for (int c = 0; c < 81; ++c)
      sum += tensor(c / 27, c / 9 % 3, c / 3 % 3, c % 3) * v[c / 27] * v[c / 9 % 3] * v[c / 3 % 3] * v[c % 3];
    EXPECT_NEAR(sum, expected, tiny * q.norm() * std::pow(v.norm(), 4) * 10);
  }
}

TEST_F(Cross_harmonics_test, powers_contractions_and_norms)
{
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d w = random<Eigen::Vector3d>(), v = random<Eigen::Vector3d>();
    const Symmetric_tensor_3 power = Symmetric_tensor_3::power(w);
    const double scale = std::pow(w.norm(), 4) * std::pow(v.norm(), 4);
    EXPECT_NEAR(power(v), std::pow(w.dot(v), 4), tiny * scale);
    EXPECT_LT((power.contract_thrice(v) - std::pow(w.dot(v), 3) * w).norm(), tiny * scale);
    EXPECT_LT((power.contract_twice(v) - std::pow(w.dot(v), 2) * w * w.transpose()).norm(), tiny * scale);
    EXPECT_LT((power.partial_trace() - w.squaredNorm() * w * w.transpose()).norm(), tiny * scale);
    EXPECT_NEAR(power.squared_norm(), std::pow(w.norm(), 8), tiny * std::pow(w.norm(), 8));
    const Eigen::Matrix3d R = rotation();
    EXPECT_LT((power.rotated(R).entries() - Symmetric_tensor_3::power(R * w).entries()).norm(), tiny * scale);
  }
}

// volume, Theorem 1 and eqs. (7), (9) to (11), (23).
TEST_F(Cross_harmonics_test, tensors_of_crosses_are_projectors_of_rank_3_with_unit_partial_trace)
{
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d R = rotation();
    const Symmetric_tensor_3 tensor = tensor_of_axes(R);
    const Symmetric_tensor_3::Mandel_matrix m = tensor.mandel();
    EXPECT_LT((m * m - m).norm(), tiny);
    EXPECT_NEAR(m.trace(), 3, tiny);
    EXPECT_LT((tensor.partial_trace() - Eigen::Matrix3d::Identity()).norm(), tiny);
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) {
        const Eigen::Matrix3d d = R.col(k) * R.col(l).transpose() + R.col(l) * R.col(k).transpose();
        EXPECT_LT((m * mandel_vector(d) - (k == l ? 1 : 0) * mandel_vector(d)).norm(), tiny);
      }
    EXPECT_LT((Symmetric_tensor_3::from_mandel(m).entries() - tensor.entries()).norm(), tiny);
    const Eigen::Vector3d v = random<Eigen::Vector3d>();
    const Eigen::Matrix<double, 6, 1> vv = mandel_vector(v * v.transpose());
    EXPECT_NEAR(vv.dot(m * vv), tensor(v), tiny * std::pow(v.norm(), 4));
  }
}

TEST_F(Cross_harmonics_test, crosses_are_unit_vectors_and_ordered_as_usual)
{
  Cross_harmonics reference = Cross_harmonics::Zero();
  reference[4] = std::sqrt(7.0 / 12);
  reference[8] = std::sqrt(5.0 / 12);
  EXPECT_LT((cross_harmonics(Eigen::Matrix3d::Identity()) - reference).norm(), tiny);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d R = rotation();
    const Cross_harmonics q = cross_harmonics(R);
    EXPECT_NEAR(q.norm(), 1, tiny);
    EXPECT_LT((cross_tensor(q).entries() - tensor_of_axes(R).entries()).norm(), tiny);
    EXPECT_LT((cross_harmonics(tensor_of_axes(R)) - q).norm(), tiny);
    const Cross_harmonics any = random<Cross_harmonics>();
    EXPECT_LT((cross_harmonics(cross_tensor(any)) - any).norm(), 10 * tiny);
    EXPECT_LT((cross_tensor(any).partial_trace() - Eigen::Matrix3d::Identity()).norm(), 10 * tiny);
  }
}

TEST_F(Cross_harmonics_test, rotations_act_on_crosses_and_polynomials)
{
  std::vector<Eigen::Matrix3d> rotations;
  for (int i = 0; i < 20; ++i)
    rotations.push_back(rotation());
  for (const double angle : {0.0, 1e-9, 1e-4, 0.3}) { // near the poles of Euler's angles
    rotations.push_back(Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 1e-3).normalized()).toRotationMatrix());
    rotations.push_back(Eigen::AngleAxisd(std::acos(-1.0), Eigen::Vector3d::UnitX()) * rotations.back());
    rotations.push_back(Eigen::AngleAxisd(angle + 2, Eigen::Vector3d::UnitZ()) * rotations.back());
  }
  for (const Eigen::Matrix3d& R : rotations) {
    const Harmonic_rotation D(R);
    const Eigen::Matrix3d S = rotation();
    EXPECT_LT((D(cross_harmonics(S)) - cross_harmonics(R * S)).norm(), tiny);
    const Cross_harmonics q = random<Cross_harmonics>();
    const Eigen::Vector3d v = random<Eigen::Vector3d>().normalized();
    EXPECT_NEAR(D(q).dot(zonal_harmonics(v)), q.dot(zonal_harmonics(R.transpose() * v)), tiny * q.norm());
    EXPECT_LT((D.inverse(D(q)) - q).norm(), tiny * q.norm());
    EXPECT_NEAR(product_of_crosses(R.transpose() * S), cross_harmonics(R).dot(cross_harmonics(S)), tiny);
    EXPECT_LT((cross_tensor(D(q)).entries() - cross_tensor(q).rotated(R).entries()).norm(), 10 * tiny * q.norm());
  }
}

TEST_F(Cross_harmonics_test, generators_are_derivatives_of_rotations)
{
  constexpr double step = 1e-4;
  for (int axis = 0; axis < 3; ++axis) {
    const Cross_harmonics q = random<Cross_harmonics>(), p = random<Cross_harmonics>();
    const auto turned = [&](double angle) {
      return Harmonic_rotation(Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)).toRotationMatrix())(q);
    };
    const Cross_harmonics difference = (turned(step) - turned(-step)) / (2 * step);
    EXPECT_LT((rotation_generator(axis, q) - difference).norm(), 64 * step * step * q.norm());
    EXPECT_NEAR(rotation_generator(axis, q).dot(p), -q.dot(rotation_generator(axis, p)),
                10 * tiny * p.norm() * q.norm());
  }
  const Cross_harmonics q = random<Cross_harmonics>();
  const auto L = [](int axis, const Cross_harmonics& p) { return rotation_generator(axis, p); };
  EXPECT_LT((L(0, L(1, q)) - L(1, L(0, q)) - L(2, q)).norm(), 100 * tiny * q.norm());
  EXPECT_LT((L(0, L(0, q)) + L(1, L(1, q)) + L(2, L(2, q)) + 20 * q).norm(), 100 * tiny * q.norm());
}

TEST_F(Cross_harmonics_test, distance_of_near_crosses_is_their_angle)
{
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d R = rotation();
    const double angle = 1e-4;
    const Eigen::Matrix3d S = Eigen::AngleAxisd(angle, random<Eigen::Vector3d>().normalized()).toRotationMatrix() * R;
    EXPECT_NEAR((cross_harmonics(S) - cross_harmonics(R)).norm(), std::sqrt(20.0 / 3) * angle, 100 * angle * angle);
  }
}

TEST_F(Cross_harmonics_test, crosses_aligned_with_a_direction)
{
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d n = random<Eigen::Vector3d>().normalized();
    const Aligned_crosses aligned = crosses_aligned_with(n);
    const double t = normal(engine);
    const Eigen::Matrix3d R = Eigen::AngleAxisd(t, n).toRotationMatrix() * aligned.frame;
    const Eigen::Vector2d s = std::sqrt(5.0 / 12) * Eigen::Vector2d(std::sin(4 * t), std::cos(4 * t));
    EXPECT_LT((aligned.offset + aligned.basis * s - cross_harmonics(R)).norm(), tiny);
  }
}
