// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_ODECO_FRAME_SEARCH_H
#define QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_ODECO_FRAME_SEARCH_H

#include <Quadrille/Symmetric_tensor_3.h>
#include <Quadrille/odeco_tensors_2.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

namespace Quadrille {
namespace internal {

/// Maximises sum b_i^2 - mu (sum b_i)^2 with b_i = S(r_i^4) over the axes r_i of a frame.
///
/// The components S(r_i, r_i, r_p, r_q) are kept, which are all that there are up to the order of the indices.
class Odeco_frame_search {
public:
  Odeco_frame_search(const Symmetric_tensor_3& S, double mu, const Eigen::Matrix3d& start)
      : m_tensor(S), m_mu(mu), m_scale(S.entries().cwiseAbs().maxCoeff()), m_axes(start)
  {
    for (int i = 0; i < 3; ++i)
      place(i);
  }

  void run()
  {
    if (m_scale == 0)
      return;
    constexpr int max_steps = 200;
    double turn = 1;
    for (int i = 0; i < max_steps && turn > 1e-9;
         ++i) // of a step that converges quadratically: the next is below 1e-16
      if (!newton_step(turn))
        turn = sweep();
  }

  const Eigen::Matrix3d& axes() const { return m_axes; }
  /// b
  Eigen::Vector3d powers() const { return {m_local[0](0, 0), m_local[1](1, 1), m_local[2](2, 2)}; }
  double objective() const { return powers().squaredNorm() - m_mu * powers().sum() * powers().sum(); }

private:
  /// The components with index i twice at least.
  void place(int i) { m_local[std::size_t(i)] = m_axes.transpose() * m_tensor.contract_twice(m_axes.col(i)) * m_axes; }

  /// Turns every two axes in their plane to where the maximum is; returns the largest angle.
  ///
  /// With the polynomial a0 + Re(conj(z2) e^(2it)) + Re(conj(z4) e^(4it)) on the plane, b_i + b_j = 2 a0 + 2 Re(...)
  /// and b_i - b_j = 2 Re(...) after a turn by t: with w = e^(-4it) the objective is Re(a w) + Re(b w^2) plus a
  /// constant.
  double sweep()
  {
    using std::complex;
    double largest = 0;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      place(i);
      place(j);
      const auto& at_i = m_local[std::size_t(i)];
      const auto& at_j = m_local[std::size_t(j)];
      const double t0 = at_i(i, i), t1 = at_i(i, j), t2 = at_i(j, j), t3 = at_j(i, j), t4 = at_j(j, j);
      const double a0 = 0.375 * (t0 + t4) + 0.75 * t2;
      const complex<double> z2 = cleaned(0.5 * (t0 - t4), t1 + t3),
                            z4 = cleaned(0.125 * (t0 + t4) - 0.75 * t2, 0.5 * (t1 - t3));
      const double third = m_local[std::size_t(k)](k, k);
      const complex<double> a = (4 * (1 - 2 * m_mu) * a0 - 4 * m_mu * third) * z4 + z2 * z2;
      const complex<double> b = (1 - 2 * m_mu) * z4 * z4;
      if (a == 0.0 && b == 0.0)
        continue;
      const double x = maximize_two_cosines(std::abs(a), std::arg(a), std::abs(b), 0.5 * std::arg(b));
      const double angle = 0.25 * std::remainder(x, 2 * pi);
      largest = std::max(largest, std::abs(angle));
      const Eigen::Vector3d r = m_axes.col(i);
      m_axes.col(i) = std::cos(angle) * r + std::sin(angle) * m_axes.col(j);
      m_axes.col(j) = std::cos(angle) * m_axes.col(j) - std::sin(angle) * r;
    }
    for (int i = 0; i < 3; ++i)
      place(i);
    return largest;
  }

  /// Without what is rounding only: where the tensor does not tell, frames do not turn.
  std::complex<double> cleaned(double x, double y) const
  {
    return std::hypot(x, y) < 1e-14 * m_scale ? 0.0 : std::complex<double>(x, y);
  }

  /// Turns the frame by a vector w, in coordinates of its axes, and returns true if the objective is concave and w
  /// short.
  ///
  /// Up to second order b_i changes by g_i . w + 1/2 w^T H_i w.
  bool newton_step(double& turn)
  {
    const double sum = powers().sum();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero(), gradient_of_sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const Eigen::Matrix3d& s = m_local[std::size_t(i)];
      const double factor = s(i, i) - m_mu * sum;
      Eigen::Vector3d g;
      g[i] = 0;
      g[j] = -4 * s(i, k);
      g[k] = 4 * s(i, j);
      gradient += factor * g;
      gradient_of_sum += g;
      hessian += g * g.transpose();
      hessian(i, j) += 2 * factor * s(i, j);
      hessian(i, k) += 2 * factor * s(i, k);
      hessian(j, i) += 2 * factor * s(i, j);
      hessian(k, i) += 2 * factor * s(i, k);
      hessian(j, j) += factor * (12 * s(k, k) - 4 * s(i, i));
      hessian(k, k) += factor * (12 * s(j, j) - 4 * s(i, i));
      hessian(j, k) -= 12 * factor * s(j, k);
      hessian(k, j) -= 12 * factor * s(j, k);
    }
    hessian -= m_mu * gradient_of_sum * gradient_of_sum.transpose();
    const Eigen::LLT<Eigen::Matrix3d> cholesky(-hessian);
    // Where the objective is all but flat, only sweeps know the direction.
    constexpr double least_root = 1e-4;
    if (cholesky.info() != Eigen::Success || cholesky.matrixLLT().diagonal().minCoeff() < least_root * m_scale)
      return false;
    const Eigen::Vector3d w = cholesky.solve(gradient);
    if (!(w.norm() < 0.3))
      return false;
    const double before = objective();
    const Eigen::Matrix3d axes = m_axes;
    m_axes = m_axes * Eigen::Quaterniond(1, 0.5 * w[0], 0.5 * w[1], 0.5 * w[2]).normalized().toRotationMatrix();
    for (int i = 0; i < 3; ++i)
      place(i);
    turn = w.norm();
    if (objective() > before - 1e-12 * m_scale * m_scale)
      return true;
    m_axes = axes;
    return false;
  }

  const Symmetric_tensor_3& m_tensor;
  double m_mu;
  double m_scale;
  Eigen::Matrix3d m_axes;
  std::array<Eigen::Matrix3d, 3> m_local; ///< by i: S(r_i, r_i, r_p, r_q)
};

} // namespace internal
} // namespace Quadrille

#endif
