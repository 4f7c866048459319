// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_METRIC_RESIDUAL_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_METRIC_RESIDUAL_H

#include <Quadrille/odeco_tensors_2.h>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace Quadrille {
namespace internal {

/// How far a frame is from a metric M, affine in (q0, q1, q2, 1): the entries xx, yy and sqrt(2) xy of K S K - I, where
/// K = M^(1/4) and S has the frame's sizes as eigenvalues and its directions as eigenvectors. It vanishes for the
/// frames whose edges have length 1 in M; the degree 4 coefficients do not matter.
using Metric_residual = Eigen::Matrix<double, 3, 4>;

/// The coefficients (q0, q1, q2) of the frames with the matrix S: of degree 0 and 2, so linear in it.
inline Eigen::Vector3d low_harmonics(const Eigen::Matrix2d& s)
{
  // S is a sum of squares of vectors along x, y and the diagonal.
  const auto along = [](double x, double y) -> Eigen::Vector3d {
    Orthogonal_frame_2 frame;
    frame.direction = {x, y};
    frame.size_u = 1;
    frame.size_v = 0;
    return odeco_harmonics(frame).head<3>();
  };
  const double half = std::sqrt(0.5);
  return (s(0, 0) - s(0, 1)) * along(1, 0) + (s(1, 1) - s(0, 1)) * along(0, 1) + 2 * s(0, 1) * along(half, half);
}

/// \pre `metric` is symmetric positive definite.
inline Eigen::Matrix2d metric_power(const Eigen::Matrix2d& metric, double exponent)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(metric);
  return eigen.eigenvectors() * eigen.eigenvalues().array().pow(exponent).matrix().asDiagonal() *
         eigen.eigenvectors().transpose();
}

inline Metric_residual metric_residual(const Eigen::Matrix2d& metric)
{
  Eigen::Matrix3d harmonics_of_s; // of S = diag(1, 0), diag(0, 1) and the exchange of x and y
  harmonics_of_s << low_harmonics((Eigen::Matrix2d() << 1, 0, 0, 0).finished()),
      low_harmonics((Eigen::Matrix2d() << 0, 0, 0, 1).finished()),
      low_harmonics((Eigen::Matrix2d() << 0, 1, 1, 0).finished());
  const Eigen::Matrix3d s_of_harmonics = harmonics_of_s.inverse();
  const Eigen::Matrix2d k = metric_power(metric, 0.25);
  Metric_residual residual;
  for (int j = 0; j < 3; ++j) {
    Eigen::Matrix2d s;
    s << s_of_harmonics(0, j), s_of_harmonics(2, j), s_of_harmonics(2, j), s_of_harmonics(1, j);
    const Eigen::Matrix2d image = k * s * k;
    residual.col(j) << image(0, 0), image(1, 1), std::sqrt(2.0) * image(0, 1);
  }
  residual.col(3) << -1, -1, 0;
  return residual;
}

} // namespace internal
} // namespace Quadrille

#endif
