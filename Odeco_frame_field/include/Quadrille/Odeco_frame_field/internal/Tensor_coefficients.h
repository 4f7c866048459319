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
        *derivatives << 2 * q[0], 0, 0, -36 * q[3], -36 * q[4], //
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

} // namespace internal
} // namespace Quadrille

#endif
