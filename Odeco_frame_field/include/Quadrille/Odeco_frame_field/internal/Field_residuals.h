// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_RESIDUALS_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_RESIDUALS_H

#include <Quadrille/Odeco_frame_field/internal/Field_elements.h>

#include <cmath>

namespace Quadrille {
namespace internal {

/// The residuals that the energies of a field are made of, on one linear triangle with three-point quadrature, and
/// their derivatives by the coefficients of its corners. Half the squared norm of the rows is the triangle's energy.
///
/// Every function fills rows from `first_row` on: residuals in `r`, derivatives in `J` unless it is null.
template <int N> struct Field_residuals {
  using Traits = Tensor_coefficients<N>;
  using Coefficients = typename Traits::Vector;
  using Element = typename Field_elements<N>::Element;
  using Corners = std::array<Coefficients, 3>;
  static constexpr int points = 3;
  static constexpr int lie_rows = 2 * points;
  static constexpr int odeco_rows = Traits::odeco_equations * points;
  static constexpr int dirichlet_rows = 2 * N;

  static double weight(int point, int corner) { return point == corner ? 2. / 3 : 1. / 6; }
  static Coefficients interpolate(const Corners& q, int point)
  {
    return (q[0] + q[1] + q[2]) / 6 + 0.5 * q[std::size_t(point)];
  }
  // The area's square is positive on both sides of its zero, so the sign of q0 has to be watched too.
  static bool is_positive(const Coefficients& q, double area) { return area > 0 && q[0] > 0; }

  /// `energy_weight` times the Dirichlet energy; planar-2, eq. (32).
  template <int first_row, class Residuals, class Jacobian>
  static void dirichlet(const Element& element, const Corners& q, double energy_weight, Residuals& r, Jacobian* J)
  {
    const double factor = std::sqrt(energy_weight * element.area);
    if (J)
      J->template middleRows<dirichlet_rows>(first_row).setZero();
    for (int a = 0; a < 2; ++a)
      for (int i = 0; i < N; ++i) {
        const int row = first_row + a * N + i;
        r[row] = 0;
        for (int k = 0; k < 3; ++k) {
          const double entry = factor * element.gradient(a, k);
          r[row] += entry * q[std::size_t(k)][i];
          if (J)
            (*J)(row, k * N + i) = entry;
        }
      }
  }

  /// E_odeco / epsilon^2 as it is in planar-2, eq. (31), divided by the squared area. `false` where an area is not
  /// positive.
  template <int first_row, class Residuals, class Jacobian>
  static bool normalized_odeco(const Element& element, const Corners& q, double epsilon, Residuals& r, Jacobian* J)
  {
    constexpr int equations = Traits::odeco_equations;
    const double factor = std::sqrt(2. / 3 * element.area) / epsilon;
    for (int p = 0; p < points; ++p) {
      const Coefficients at = interpolate(q, p);
      Coefficients area_derivatives;
      const double area = Traits::area(at, J ? &area_derivatives : nullptr);
      if (!is_positive(at, area))
        return false;
      double c[equations];
      Eigen::Matrix<double, equations, N> derivatives;
      Traits::odeco(at, c, J ? &derivatives : nullptr);
      const double scale = factor / area;
      const int row = first_row + equations * p;
      for (int i = 0; i < equations; ++i)
        r[row + i] = scale * c[i];
      if (J) {
        for (int i = 0; i < equations; ++i)
          derivatives.row(i) = scale * (derivatives.row(i) - c[i] / area * area_derivatives.transpose());
        for (int k = 0; k < 3; ++k)
          J->template block<equations, N>(row, k * N) = weight(p, k) * derivatives;
      }
    }
    return true;
  }

  /// E_odeco / epsilon^2 as it is in planar-1, eq. (5.29).
  template <int first_row, class Residuals, class Jacobian>
  static void plain_odeco(const Element& element, const Corners& q, double epsilon, Residuals& r, Jacobian* J)
  {
    constexpr int equations = Traits::odeco_equations;
    const double factor = std::sqrt(2. / 3 * element.area) / epsilon;
    for (int p = 0; p < points; ++p) {
      double c[equations];
      Eigen::Matrix<double, equations, N> derivatives;
      Traits::odeco(interpolate(q, p), c, J ? &derivatives : nullptr);
      const int row = first_row + equations * p;
      for (int i = 0; i < equations; ++i)
        r[row + i] = factor * c[i];
      if (J)
        for (int k = 0; k < 3; ++k)
          J->template block<equations, N>(row, k * N) = factor * weight(p, k) * derivatives;
    }
  }

  /// `energy_weight` times E_Lie; planar-2, eq. (30), and planar-1, eq. (5.28). `false` where an area is not positive.
  template <int first_row, class Residuals, class Jacobian>
  static bool lie(const Element& element, const Corners& q, double energy_weight, Residuals& r, Jacobian* J)
  {
    Coefficients d[2];
    for (int a = 0; a < 2; ++a)
      d[a] = element.gradient(a, 0) * q[0] + element.gradient(a, 1) * q[1] + element.gradient(a, 2) * q[2];
    const double factor = std::sqrt(2. / 3 * energy_weight * element.area);
    Lie_bracket<N> bracket;
    for (int p = 0; p < points; ++p) {
      const Coefficients at = interpolate(q, p);
      Coefficients area_derivatives;
      const double area = Traits::area(at, J ? &area_derivatives : nullptr);
      if (!is_positive(at, area))
        return false;
      bracket.evaluate(at, d[0], d[1], J != nullptr);
      const double scale = factor / area;
      const int row = first_row + 2 * p;
      r.template segment<2>(row) = scale * bracket.value;
      if (!J)
        continue;
      const Eigen::Matrix<double, 2, N> by_point =
          scale * (bracket.by_value - bracket.value / area * area_derivatives.transpose());
      for (int k = 0; k < 3; ++k)
        J->template block<2, N>(row, k * N) = weight(p, k) * by_point +
                                              scale * element.gradient(0, k) * bracket.by_derivative[0] +
                                              scale * element.gradient(1, k) * bracket.by_derivative[1];
    }
    return true;
  }
};

} // namespace internal
} // namespace Quadrille

#endif
