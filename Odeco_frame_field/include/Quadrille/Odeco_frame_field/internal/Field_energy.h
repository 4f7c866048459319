// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_ENERGY_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_ENERGY_H

#include <Quadrille/Odeco_field_options.h>
#include <Quadrille/Odeco_frame_field/internal/Field_elements.h>
#include <Quadrille/Odeco_frame_field/internal/Field_residuals.h>
#include <Quadrille/Odeco_frame_field/internal/Triangle_energy.h>

namespace Quadrille {
namespace internal {

enum class Field_energy_kind {
  smoothness,   ///< E_smooth = E_Dir + E_odeco / epsilon^2; planar-2, eqs. (31) to (33)
  integrability ///< E_integ = E_Lie + E_odeco / epsilon^2; planar-2, eqs. (30), (31), (33)
};

/// The rows of a `Field_energy` in their order.
template <int N, Field_energy_kind kind> struct Field_energy_rows {
  static constexpr bool integrable = kind == Field_energy_kind::integrability;
  using Pieces = Field_residuals<N>;
  static constexpr int first_odeco = integrable ? Pieces::lie_rows : Pieces::dirichlet_rows;
  static constexpr int first_size = first_odeco + Pieces::odeco_rows;
  static constexpr int count = first_size + (integrable ? Pieces::points + (N == 5 ? 2 + 9 : 0) : 0);
};

/// The normalised energies of planar-2: linear triangles, three-point quadrature. Half the squared norm of the
/// residuals is the energy.
template <int N, Field_energy_kind kind>
class Field_energy
    : public Triangle_energy<Field_energy<N, kind>, Field_elements<N>, Field_energy_rows<N, kind>::count> {
  using Base = Triangle_energy<Field_energy<N, kind>, Field_elements<N>, Field_energy_rows<N, kind>::count>;
  using Pieces = Field_residuals<N>;
  using Traits = Tensor_coefficients<N>;
  static constexpr bool integrable = kind == Field_energy_kind::integrability;

public:
  static constexpr int first_odeco = Field_energy_rows<N, kind>::first_odeco,
                       first_size = Field_energy_rows<N, kind>::first_size;
  static constexpr double final_decrease = 1e-4;

  /// `relative_epsilon` is in units of the elements' sizes.
  Field_energy(const Field_elements<N>& elements, double relative_epsilon)
      : Base(elements), m_relative_epsilon(relative_epsilon)
  {
  }

  void set_relative_epsilon(double relative_epsilon) { m_relative_epsilon = relative_epsilon; }
  double relative_epsilon() const { return m_relative_epsilon; }
  /// What leads a melted field: adds the schedule's weight times half the mean over the domain of the squared logarithm
  /// of size against the expected one. It decides between fields that are equally integrable, as along flat valleys.
  void attract(const Melt_and_freeze_schedule& schedule) { m_size_attraction = schedule.size_attraction; }
  void stop_attracting() { m_size_attraction = 0; }
  /// The same where the expected size is a target, with the mean over that part of the domain.
  void set_target_attraction(double weight) { m_target_attraction = weight; }

  /// Adds `weight` times half the integral of the squared gradient of that logarithm: sizes then change no faster than
  /// expected. An anisotropic field without it is free to change its sizes across straight curves at once.
  void set_grading_attraction(double weight) { m_grading_attraction = weight; }

  template <class S, class Rows> bool add_rows(const Triangle_values<S, N>& triangle, Rows& rows) const
  {
    if constexpr (integrable) {
      if (!Pieces::lie(triangle, 1, rows))
        return false;
    } else {
      Pieces::dirichlet(triangle, 1, rows);
    }
    if (!Pieces::normalized_odeco(triangle, S(m_relative_epsilon * triangle.size), rows))
      return false;
    if constexpr (integrable) {
      add_size_attraction(triangle, rows);
      if constexpr (N == 5) {
        add_grading_attraction(triangle, rows);
        add_metric_attraction(triangle, rows);
      }
    }
    return true;
  }

private:
  /// \pre Areas are positive at the quadrature points.
  template <class S, class Rows> void add_size_attraction(const Triangle_values<S, N>& triangle, Rows& rows) const
  {
    const auto& elements = this->elements();
    const double target_density = elements.has_targets() ? m_target_attraction / (3 * elements.target_area()) : 0.;
    const double density = m_size_attraction / (3 * elements.total_area());
    if (density == 0 && target_density == 0) {
      rows.template skip<Pieces::points>();
      return;
    }
    for (const auto& weight : Pieces::weights) {
      S expected = 0, target = 0;
      for (int k = 0; k < 3; ++k) {
        expected += weight[k] * triangle.expected_log_value[k];
        target += weight[k] * triangle.target_weight[k];
      }
      const S factor = triangle.root_area * square_root(density + target_density * target);
      const Tuple<S, N> q = triangle.mean(weight);
      const S area = Traits::area(q);
      const Tuple<S, 1> value = {{factor * (0.5 * logarithm(area) - expected)}};
      if constexpr (Rows::with_derivatives)
        rows.add(value, weight, Tuple<Tuple<S, N>, 1>{{scaled(0.5 * factor / area, Traits::area_derivatives(q))}});
      else
        rows.add(value);
    }
  }

  /// At the centroid. \pre Areas are positive at the quadrature points, whose mean the centroid is.
  template <class S, class Rows> void add_grading_attraction(const Triangle_values<S, N>& triangle, Rows& rows) const
  {
    if (m_grading_attraction == 0) {
      rows.template skip<2>();
      return;
    }
    const S factor = std::sqrt(m_grading_attraction) * triangle.root_area;
    const Tuple<S, N> q = triangle.mean(Pieces::centroid_weights);
    const S scale = 0.5 * factor / Traits::area(q);
    const Tuple<S, N> by_area = Traits::area_derivatives(q);
    for (int a = 0; a < 2; ++a) {
      const Tuple<S, N> slope = triangle.slope(a);
      const S log_slope = scale * dot(by_area, slope);
      const Tuple<S, 1> value = {{log_slope - factor * dot(triangle.gradient[a], triangle.expected_log_value)}};
      if constexpr (Rows::with_derivatives) {
        // The area is a quadratic form, so its derivatives are linear in the coefficients.
        Tuple<Tuple<S, N>, 1> by_value = {{scaled(scale, Traits::area_derivatives(slope))}};
        add_scaled(by_value[0], -2 * scale * log_slope / factor, by_area);
        const Tuple<Tuple<S, N>, 1> by_slope = {{scaled(scale, by_area)}}, none = {};
        rows.add(value, Pieces::centroid_weights, by_value, a == 0 ? by_slope : none, a == 1 ? by_slope : none);
      } else {
        rows.add(value);
      }
    }
  }

  /// With the vertices as quadrature points, where it is the square of affine functions.
  template <class S, class Rows> void add_metric_attraction(const Triangle_values<S, N>& triangle, Rows& rows) const
  {
    const auto& elements = this->elements();
    if (elements.targets().metric.empty() || m_target_attraction == 0) {
      rows.template skip<9>();
      return;
    }
    constexpr double corner[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const S factor = std::sqrt(m_target_attraction / (3 * elements.target_area())) * triangle.root_area;
    for (int k = 0; k < 3; ++k) {
      Tuple<S, 3> value;
      Tuple<Tuple<S, N>, 3> by_value = {};
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
          by_value[i][j] = factor * triangle.metric_residual[k][i][j];
        value[i] = dot(by_value[i], triangle.coefficients[k]) + factor * triangle.metric_residual[k][i][3];
      }
      if constexpr (Rows::with_derivatives)
        rows.add(value, corner[k], by_value);
      else
        rows.add(value);
    }
  }

  double m_relative_epsilon;
  double m_size_attraction = 0;
  double m_target_attraction = 0;
  double m_grading_attraction = 0;
};

#ifdef QUADRILLE_SEPARATE_COMPILATION
extern template class Triangle_energy<Field_energy<3, Field_energy_kind::smoothness>, Field_elements<3>,
                                      Field_energy_rows<3, Field_energy_kind::smoothness>::count>;
extern template class Triangle_energy<Field_energy<3, Field_energy_kind::integrability>, Field_elements<3>,
                                      Field_energy_rows<3, Field_energy_kind::integrability>::count>;
extern template class Triangle_energy<Field_energy<5, Field_energy_kind::smoothness>, Field_elements<5>,
                                      Field_energy_rows<5, Field_energy_kind::smoothness>::count>;
extern template class Triangle_energy<Field_energy<5, Field_energy_kind::integrability>, Field_elements<5>,
                                      Field_energy_rows<5, Field_energy_kind::integrability>::count>;
#endif

} // namespace internal
} // namespace Quadrille

#endif
