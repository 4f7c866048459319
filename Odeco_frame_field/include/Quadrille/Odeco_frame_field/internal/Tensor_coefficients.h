// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_TENSOR_COEFFICIENTS_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_TENSOR_COEFFICIENTS_H

#include <Quadrille/odeco_tensors_2.h>

#include <Eigen/Core>

namespace Quadrille {
namespace internal {

/// The N coefficients per vertex that a field optimises: 3 for isotropic frames (q0, q3, q4; the degree 2 coefficients
/// are zero), 5 for all frames.
template <int N> struct Tensor_coefficients {
  static_assert(N == 3 || N == 5, "isotropic fields have 3 coefficients per vertex, anisotropic ones 5");
  static constexpr int odeco_equations = N == 3 ? 1 : 3;
  static constexpr int band4 = N - 2; ///< place of (q3, q4)
  using Vector = Eigen::Matrix<double, N, 1>;
  using Entries_matrix = Eigen::Matrix<double, 5, N>;

  static Circular_harmonics harmonics(const Vector& q)
  {
    if constexpr (N == 5) {
      return q;
    } else {
      Circular_harmonics all = Circular_harmonics::Zero();
      all[0] = q[0];
      all.template tail<2>() = q.template tail<2>();
      return all;
    }
  }

  static Vector from_harmonics(const Circular_harmonics& q)
  {
    if constexpr (N == 5)
      return q;
    else
      return Vector(q[0], q[3], q[4]);
  }

  /// Tensor entries = this matrix times the coefficients.
  static const Entries_matrix& entries_matrix()
  {
    static const Entries_matrix matrix = [] {
      Entries_matrix m;
      for (int i = 0; i < N; ++i)
        m.col(i) = Symmetric_tensor_2::entries_of_harmonics() * harmonics(Vector::Unit(i));
      return m;
    }();
    return matrix;
  }

  /// The equations c_i of the odeco variety, and their derivatives by the coefficients.
  static void odeco(const Vector& q, double* c, Eigen::Matrix<double, odeco_equations, N>* derivatives)
  {
    if constexpr (N == 3) {
      c[0] = q[0] * q[0] - 18 * (q[1] * q[1] + q[2] * q[2]);
      if (derivatives)
        *derivatives << 2 * q[0], -36 * q[1], -36 * q[2];
    } else {
      const Eigen::Vector3d values = odeco_residuals(q);
      for (int i = 0; i < 3; ++i)
        c[i] = values[i];
      const double root2 = std::sqrt(2.0);
      if (derivatives)
        *derivatives << 2 * q[0], 0, 0, -36 * q[3], -36 * q[4],                     //
            root2 * q[1], root2 * q[0] - 6 * q[3], -6 * q[4], -6 * q[1], -6 * q[2], //
            root2 * q[2], -6 * q[4], root2 * q[0] + 6 * q[3], 6 * q[2], -6 * q[1];
    }
  }

  /// The area of the frame (planar-2, eq. 21) and its derivatives.
  static double area(const Vector& q, Vector* derivatives)
  {
    if constexpr (N == 3) {
      if (derivatives)
        *derivatives << 16. / (9 * pi) * q[0], 0, 0;
      return 8. / (9 * pi) * q[0] * q[0];
    } else {
      if (derivatives)
        *derivatives << 16. / (9 * pi) * q[0], -2 / pi * q[1], -2 / pi * q[2], 0, 0;
      return frame_area(q);
    }
  }
};

/// The Lie bracket [u, v] of the frame vectors in terms of the coefficients, and its derivatives; planar-2, eq. (29).
///
/// From the closed form of eq. (28): with entries t_0 ... t_4 of the tensor, [u, v]_i = sum over a in {0, 1},
/// m in {0, ..., 3} of (-1)^(m + 1) binomial(3, m) t_{a + 3 - m} d_a t_{i + m}. (The paper's sign is the opposite,
/// since there v is u turned by -90 degrees.) It is bilinear in the coefficients and their derivatives.
template <int N> struct Lie_bracket {
  using Coefficients = typename Tensor_coefficients<N>::Vector;
  using Derivatives = Eigen::Matrix<double, 2, N>;

  Eigen::Vector2d value;
  Derivatives by_value;         ///< by the coefficients
  Derivatives by_derivative[2]; ///< by their derivatives along x and y

  void evaluate(const Coefficients& q, const Coefficients& x, const Coefficients& y, bool with_derivatives)
  {
    if constexpr (N == 3)
      evaluate_isotropic(q, x, y, with_derivatives);
    else
      evaluate_general(q, x, y, with_derivatives);
  }

private:
  // The same sum written out for tensors without degree 2 part.
  void evaluate_isotropic(const Coefficients& q, const Coefficients& x, const Coefficients& y, bool with_derivatives)
  {
    constexpr double k0 = -2 / (3 * pi), k4 = -4 / pi;
    value << k4 * (q[1] * x[2] - q[2] * x[1] + q[1] * y[1] + q[2] * y[2]) + k0 * q[0] * y[0],
        k4 * (q[1] * y[2] - q[2] * y[1] - q[1] * x[1] - q[2] * x[2]) - k0 * q[0] * x[0];
    if (!with_derivatives)
      return;
    by_value << k0 * y[0], k4 * (x[2] + y[1]), k4 * (y[2] - x[1]), //
        -k0 * x[0], k4 * (y[2] - x[1]), -k4 * (y[1] + x[2]);
    by_derivative[0] << 0, -k4 * q[2], k4 * q[1], //
        -k0 * q[0], -k4 * q[1], -k4 * q[2];
    by_derivative[1] << k0 * q[0], k4 * q[1], k4 * q[2], //
        0, -k4 * q[2], k4 * q[1];
  }

  void evaluate_general(const Coefficients& q, const Coefficients& x, const Coefficients& y, bool with_derivatives)
  {
    using Entries = Eigen::Matrix<double, 5, 1>;
    constexpr double c[4] = {-1, 3, -3, 1};
    const auto& matrix = Tensor_coefficients<N>::entries_matrix();
    const Entries t = matrix * q;
    const Entries d[2] = {matrix * x, matrix * y};
    Eigen::Matrix<double, 2, 5> by_t = Eigen::Matrix<double, 2, 5>::Zero();
    value.setZero();
    for (int i = 0; i < 2; ++i)
      for (int a = 0; a < 2; ++a)
        for (int m = 0; m < 4; ++m) {
          value[i] += c[m] * t[a + 3 - m] * d[a][i + m];
          by_t(i, a + 3 - m) += c[m] * d[a][i + m];
        }
    if (!with_derivatives)
      return;
    by_value.noalias() = by_t * matrix;
    for (int a = 0; a < 2; ++a) {
      Eigen::Matrix<double, 2, 5> by_d = Eigen::Matrix<double, 2, 5>::Zero();
      for (int i = 0; i < 2; ++i)
        for (int m = 0; m < 4; ++m)
          by_d(i, i + m) = c[m] * t[a + 3 - m];
      by_derivative[a].noalias() = by_d * matrix;
    }
  }
};

} // namespace internal
} // namespace Quadrille

#endif
