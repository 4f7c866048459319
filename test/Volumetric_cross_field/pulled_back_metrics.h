// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_VOLUMETRIC_CROSS_FIELD_PULLED_BACK_METRICS_H
#define QUADRILLE_TEST_VOLUMETRIC_CROSS_FIELD_PULLED_BACK_METRICS_H

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <vector>

/// The Jacobian of a map of space that shears, stretches and twists: its singular values range from 0.5 to 1.7 in the
/// cube from -1 to 1.
inline Eigen::Matrix3d twisting_jacobian(const Eigen::Vector3d& p)
{
  const double x = p[0], y = p[1], z = p[2], c = std::cos(x + 0.5 * y);
  const Eigen::Vector3d u(x + 0.35 * std::sin(x + 0.5 * y), y * (1 + 0.25 * std::sin(z)), z + 0.2 * x * y);
  Eigen::Matrix3d J;
  J << 1 + 0.35 * c, 0.175 * c, 0, 0, 1 + 0.25 * std::sin(z), 0.25 * y * std::cos(z), 0.2 * y, 0.2 * x, 1;
  J.col(2) += 0.5 * Eigen::Vector3d::UnitZ().cross(u); // u is then turned by z / 2 about the z axis
  return Eigen::AngleAxisd(0.5 * z, Eigen::Vector3d::UnitZ()) * J;
}

/// The symmetric factor A of J = R A.
inline Eigen::Matrix3d root_of(const Eigen::Matrix3d& J)
{
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(J.transpose() * J).operatorSqrt();
}

/// The rotation R of J = R A.
inline Eigen::Matrix3d polar_rotation(const Eigen::Matrix3d& J) { return J * root_of(J).inverse(); }

/// The exponent p of errors that fall like h^p, by least squares, where each h is half of the one before.
inline double order_of(const std::vector<double>& errors)
{
  const double n = double(errors.size());
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double x = double(i) - (n - 1) / 2;
    sum -= x * std::log2(errors[i]);
    weights += x * x;
  }
  return sum / weights;
}

#endif
