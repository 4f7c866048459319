// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_RESIDUALS_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_RESIDUALS_H

#include <Quadrille/Odeco_frame_field/internal/Residual_rows.h>

namespace Quadrille {
namespace internal {

/// The residuals that the energies of a field are made of, with three-point quadrature. Half the squared norm of the
/// rows is a triangle's energy.
///
/// Every function hands its rows to `rows` (Residual_rows.h). `S` is `double` or `Pack`.
template <int N> struct Field_residuals {
  using Traits = Tensor_coefficients<N>;
  static constexpr int points = 3;
  static constexpr int lie_rows = 2 * points;
  static constexpr int odeco_rows = Traits::odeco_equations * points;
  static constexpr int dirichlet_rows = 2 * N;
  /// Of the corners at the quadrature points, and at the centroid.
  static constexpr double weights[points][3] = {
      {2. / 3, 1. / 6, 1. / 6}, {1. / 6, 2. / 3, 1. / 6}, {1. / 6, 1. / 6, 2. / 3}};
  static constexpr double centroid_weights[3] = {1. / 3, 1. / 3, 1. / 3};

  // The area's square is positive on both sides of its zero, so the sign of q0 has to be watched too. In every lane.
  template <class S> static bool is_positive(const Tuple<S, N>& q, const S& area)
  {
    return all_positive(area) && all_positive(q[0]);
  }

  /// `energy_weight` times the Dirichlet energy; planar-2, eq. (32).
  template <class S, class Rows>
  static void dirichlet(const Triangle_values<S, N>& triangle, double energy_weight, Rows& rows)
  {
    const S factor = std::sqrt(energy_weight) * triangle.root_area;
    for (int a = 0; a < 2; ++a) {
      const Tuple<S, N> value = scaled(factor, triangle.slope(a));
      if constexpr (Rows::with_derivatives) {
        Tuple<Tuple<S, N>, N> by_slope = {};
        const Tuple<Tuple<S, N>, N> none = {};
        for (int i = 0; i < N; ++i)
          by_slope[i][i] = factor;
        rows.add(value, centroid_weights, none, a == 0 ? by_slope : none, a == 1 ? by_slope : none);
      } else {
        rows.add(value);
      }
    }
  }

  /// E_odeco / epsilon^2 as it is in planar-2, eq. (31), divided by the squared area. `false` where an area is not
  /// positive.
  template <class S, class Rows>
  static bool normalized_odeco(const Triangle_values<S, N>& triangle, const S& epsilon, Rows& rows)
  {
    const S factor = std::sqrt(2. / 3) * triangle.root_area / epsilon;
    for (const auto& weight : weights) {
      const Tuple<S, N> q = triangle.mean(weight);
      const S area = Traits::area(q);
      if (!is_positive(q, area))
        return false;
      const S scale = factor / area;
      const auto value = scaled(scale, Traits::odeco(q));
      if constexpr (Rows::with_derivatives) {
        auto by_value = Traits::odeco_derivatives(q);
        const Tuple<S, N> by_area = scaled(1 / area, Traits::area_derivatives(q));
        for (int i = 0; i < Traits::odeco_equations; ++i) {
          by_value[i] = scaled(scale, by_value[i]);
          add_scaled(by_value[i], -value[i], by_area);
        }
        rows.add(value, weight, by_value);
      } else {
        rows.add(value);
      }
    }
    return true;
  }

  /// E_odeco / epsilon^2 as it is in planar-1, eq. (5.29).
  template <class S, class Rows>
  static void plain_odeco(const Triangle_values<S, N>& triangle, double epsilon, Rows& rows)
  {
    const S factor = std::sqrt(2. / 3) / epsilon * triangle.root_area;
    for (const auto& weight : weights) {
      const Tuple<S, N> q = triangle.mean(weight);
      const auto value = scaled(factor, Traits::odeco(q));
      if constexpr (Rows::with_derivatives) {
        auto by_value = Traits::odeco_derivatives(q);
        for (int i = 0; i < Traits::odeco_equations; ++i)
          by_value[i] = scaled(factor, by_value[i]);
        rows.add(value, weight, by_value);
      } else {
        rows.add(value);
      }
    }
  }

  /// `energy_weight` times E_Lie; planar-2, eq. (30), and planar-1, eq. (5.28). `false` where an area is not positive.
  template <class S, class Rows>
  static bool lie(const Triangle_values<S, N>& triangle, double energy_weight, Rows& rows)
  {
    const Tuple<S, N> x_slope = triangle.slope(0), y_slope = triangle.slope(1);
    const auto bracket_by_value = Lie_bracket<S, N>::by_value(x_slope, y_slope);
    const S factor = std::sqrt(2. / 3 * energy_weight) * triangle.root_area;
    for (const auto& weight : weights) {
      const Tuple<S, N> q = triangle.mean(weight);
      const S area = Traits::area(q);
      if (!is_positive(q, area))
        return false;
      const S scale = factor / area;
      Lie_bracket<S, N> bracket(q, x_slope, y_slope);
      const Tuple<S, 2> value = scaled(scale, bracket.value);
      if constexpr (Rows::with_derivatives) {
        auto by_value = bracket_by_value;
        const Tuple<S, N> by_area = scaled(1 / area, Traits::area_derivatives(q));
        for (int i = 0; i < 2; ++i) {
          by_value[i] = scaled(scale, by_value[i]);
          add_scaled(by_value[i], -value[i], by_area);
          bracket.by_x_slope[i] = scaled(scale, bracket.by_x_slope[i]);
          bracket.by_y_slope[i] = scaled(scale, bracket.by_y_slope[i]);
        }
        rows.add(value, weight, by_value, bracket.by_x_slope, bracket.by_y_slope);
      } else {
        rows.add(value);
      }
    }
    return true;
  }
};

} // namespace internal
} // namespace Quadrille

#endif
