// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_TENSOR_COEFFICIENTS_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_TENSOR_COEFFICIENTS_H

#include <Quadrille/Support/internal/Pack.h>
#include <Quadrille/Support/internal/Tuple.h>
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

  /// The equations c_i of the odeco variety. Here and below `S` is `double` or `Pack`.
  template <class S> static Tuple<S, odeco_equations> odeco(const Tuple<S, N>& q)
  {
    if constexpr (N == 3)
      return {{q[0] * q[0] - 18 * (q[1] * q[1] + q[2] * q[2])}};
    else
      return {{q[0] * q[0] - 18 * (q[3] * q[3] + q[4] * q[4]), root2 * q[0] * q[1] - 6 * (q[1] * q[3] + q[2] * q[4]),
               root2 * q[0] * q[2] - 6 * (q[1] * q[4] - q[2] * q[3])}};
  }

  template <class S> static Tuple<Tuple<S, N>, odeco_equations> odeco_derivatives(const Tuple<S, N>& q)
  {
    if constexpr (N == 3)
      return {{{{2 * q[0], -36 * q[1], -36 * q[2]}}}};
    else
      return {{{{2 * q[0], 0, 0, -36 * q[3], -36 * q[4]}},
               {{root2 * q[1], root2 * q[0] - 6 * q[3], -6 * q[4], -6 * q[1], -6 * q[2]}},
               {{root2 * q[2], -6 * q[4], root2 * q[0] + 6 * q[3], 6 * q[2], -6 * q[1]}}}};
  }

  /// The area of the frame (planar-2, eq. 21); `Q` is any vector of N coefficients.
  template <class Q> static auto area(const Q& q)
  {
    if constexpr (N == 3)
      return 8. / (9 * pi) * (q[0] * q[0]);
    else
      return 1 / pi * (8. / 9 * (q[0] * q[0]) - q[1] * q[1] - q[2] * q[2]);
  }

  template <class S> static Tuple<S, N> area_derivatives(const Tuple<S, N>& q)
  {
    if constexpr (N == 3)
      return {{16. / (9 * pi) * q[0], 0, 0}};
    else
      return {{16. / (9 * pi) * q[0], -2 / pi * q[1], -2 / pi * q[2], 0, 0}};
  }

private:
  static constexpr double root2 = 1.41421356237309504880;
};

/// The Lie bracket [u, v] of the frame vectors in terms of the coefficients q and their slopes x, y along the axes, and
/// its derivatives; planar-2, eq. (29).
///
/// From the closed form of eq. (28): with entries t_0 ... t_4 of the tensor, [u, v]_i = sum over a in {0, 1},
/// m in {0, ..., 3} of (-1)^(m + 1) binomial(3, m) t_{a + 3 - m} d_a t_{i + m}, written out for harmonics. (The paper's
/// sign is the opposite, since there v is u turned by -90 degrees.) It is bilinear in q and the slopes.
template <class S, int N> struct Lie_bracket {
  using Derivatives = Tuple<Tuple<S, N>, 2>;

  Tuple<S, 2> value;
  Derivatives by_x_slope, by_y_slope;

  Lie_bracket(const Tuple<S, N>& q, const Tuple<S, N>& x, const Tuple<S, N>& y)
  {
    if constexpr (N == 3) {
      by_x_slope = {{{{0, -k4 * q[2], k4 * q[1]}}, //
                     {{k0 * q[0], -k4 * q[1], -k4 * q[2]}}}};
      by_y_slope = {{{{-k0 * q[0], k4 * q[1], k4 * q[2]}}, //
                     {{0, -k4 * q[2], k4 * q[1]}}}};
    } else {
      by_x_slope = {{{{-k02 * q[2], k2 * (q[4] - 0.5 * q[2]), k02 * q[0] + k2 * (0.5 * q[1] - q[3]),
                       k2 * q[2] - k4 * q[4], k4 * q[3] - k2 * q[1]}},
                     {{k0 * q[0] + k02 * q[1], -k02 * q[0] - k2 * (q[1] + q[3]), -k2 * (q[2] + q[4]),
                       k2 * q[1] - k4 * q[3], k2 * q[2] - k4 * q[4]}}}};
      by_y_slope = {{{{k02 * q[1] - k0 * q[0], k2 * (q[1] - q[3]) - k02 * q[0], k2 * (q[2] - q[4]),
                       k2 * q[1] + k4 * q[3], k2 * q[2] + k4 * q[4]}},
                     {{k02 * q[2], -k2 * (0.5 * q[2] + q[4]), k2 * (0.5 * q[1] + q[3]) - k02 * q[0],
                       -k2 * q[2] - k4 * q[4], k2 * q[1] + k4 * q[3]}}}};
    }
    for (int i = 0; i < 2; ++i)
      value[i] = dot(by_x_slope[i], x) + dot(by_y_slope[i], y);
  }

  /// By q.
  static Derivatives by_value(const Tuple<S, N>& x, const Tuple<S, N>& y)
  {
    if constexpr (N == 3)
      return {{{{-k0 * y[0], k4 * (x[2] + y[1]), k4 * (y[2] - x[1])}},
               {{k0 * x[0], k4 * (y[2] - x[1]), -k4 * (x[2] + y[1])}}}};
    else
      return {{{{k02 * (x[2] - y[1]) - k0 * y[0], k2 * (0.5 * x[2] + y[1] - x[4] + y[3]) + k02 * y[0],
                 k2 * (x[3] - 0.5 * x[1] + y[2] + y[4]) - k02 * x[0], k4 * (x[4] + y[3]) - k2 * (x[2] + y[1]),
                 k4 * (y[4] - x[3]) + k2 * (x[1] - y[2])}},
               {{k0 * x[0] - k02 * (x[1] + y[2]), k2 * (x[3] - x[1] + 0.5 * y[2] + y[4]) + k02 * x[0],
                 k2 * (x[4] - x[2] - 0.5 * y[1] - y[3]) + k02 * y[0], k4 * (y[4] - x[3]) + k2 * (y[2] - x[1]),
                 -k4 * (x[4] + y[3]) - k2 * (x[2] + y[1])}}}};
  }

private:
  // What pairs of degrees 0 and 0, 0 and 2, 2 and 2 or 4, 4 and 4 are multiplied by.
  static constexpr double k0 = 2 / (3 * pi), k02 = 0.70710678118654752440 / pi, k2 = 1 / pi, k4 = -4 / pi;
};

} // namespace internal
} // namespace Quadrille

#endif
