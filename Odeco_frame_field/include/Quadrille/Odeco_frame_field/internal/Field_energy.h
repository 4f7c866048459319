// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_ENERGY_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_ENERGY_H

#include <Quadrille/Odeco_frame_field/internal/Field_residuals.h>

#include <cmath>

namespace Quadrille {
namespace internal {

enum class Field_energy_kind {
  smoothness,   ///< E_smooth = E_Dir + E_odeco / epsilon^2; planar-2, eqs. (31) to (33)
  integrability ///< E_integ = E_Lie + E_odeco / epsilon^2; planar-2, eqs. (30), (31), (33)
};

/// The normalised energies of planar-2 as a `LeastSquaresTerm`: linear triangles, three-point quadrature.
///
/// Half the squared norm of the residuals is the energy.
template <int N, Field_energy_kind kind> class Field_energy {
  using Pieces = Field_residuals<N>;
  static constexpr bool integrable = kind == Field_energy_kind::integrability;
  static constexpr int points = Pieces::points;

public:
  static constexpr int max_unknowns = 3 * N;
  static constexpr int first_odeco_row = integrable ? Pieces::lie_rows : Pieces::dirichlet_rows;
  static constexpr int first_size_row = first_odeco_row + Pieces::odeco_rows;
  static constexpr int first_grading_row = first_size_row + (integrable ? points : 0);
  static constexpr int max_residuals = first_grading_row + (integrable && N == 5 ? 2 : 0);
  using Coefficients = typename Pieces::Coefficients;
  using Unknowns = Eigen::Matrix<double, max_unknowns, 1>;
  using Residuals = Eigen::Matrix<double, max_residuals, 1>;
  using Jacobian = Eigen::Matrix<double, max_residuals, max_unknowns>;

  /// `relative_epsilon` is in units of the elements' sizes.
  Field_energy(const Field_elements<N>& elements, double relative_epsilon)
      : m_elements(&elements), m_relative_epsilon(relative_epsilon)
  {
  }

  void set_relative_epsilon(double relative_epsilon) { m_relative_epsilon = relative_epsilon; }
  double relative_epsilon() const { return m_relative_epsilon; }
  /// Adds `weight` times half the mean over the domain of the squared logarithm of size against the expected one. It
  /// decides between fields that are equally integrable, as along the flat valleys of a melted field.
  void set_size_attraction(double weight) { m_size_attraction = weight; }
  /// The same where the expected size is a target, with the mean over that part of the domain.
  void set_target_attraction(double weight) { m_target_attraction = weight; }

  /// Adds `weight` times half the integral of the squared gradient of that logarithm: sizes then change no faster than
  /// expected. An anisotropic field without it is free to change its sizes across straight curves at once.
  void set_grading_attraction(double weight) { m_grading_attraction = weight; }

  std::size_t number_of_elements() const { return m_elements->number_of_elements(); }
  int element_unknowns(std::size_t e, std::array<int, std::size_t(max_unknowns)>& index) const
  {
    return m_elements->element_unknowns(e, index);
  }

  bool evaluate(std::size_t e, const Unknowns& x, Residuals& r, Jacobian* J) const
  {
    const auto& element = m_elements->element(e);
    const std::array<Coefficients, 3> q = m_elements->corner_coefficients(e, x);
    Jacobian derivatives;
    Jacobian* by_coefficients = J ? &derivatives : nullptr;
    bool inside = true;
    if constexpr (integrable)
      inside = Pieces::template lie<0>(element, q, 1, r, by_coefficients);
    else
      Pieces::template dirichlet<0>(element, q, 1, r, by_coefficients);
    const double epsilon = m_relative_epsilon * element.size;
    inside = inside && Pieces::template normalized_odeco<first_odeco_row>(element, q, epsilon, r, by_coefficients);
    if constexpr (integrable)
      if (inside) {
        add_size_attraction(element, q, r, by_coefficients);
        if constexpr (N == 5)
          add_grading_attraction(element, q, r, by_coefficients);
      }
    if (inside && J)
      m_elements->restrict_jacobian(e, derivatives, *J);
    return inside;
  }

private:
  /// \pre `q` has a positive area at the quadrature points.
  void add_size_attraction(const typename Pieces::Element& element, const typename Pieces::Corners& q, Residuals& r,
                           Jacobian* J) const
  {
    if (m_size_attraction == 0 && (m_target_attraction == 0 || !m_elements->has_targets())) {
      r.template segment<points>(first_size_row).setZero();
      if (J)
        J->template middleRows<points>(first_size_row).setZero();
      return;
    }
    double expected[3], target_weight[3];
    for (std::size_t k = 0; k < 3; ++k) {
      expected[k] = m_elements->expected_log_size(std::size_t(element.vertex[k]));
      target_weight[k] = m_elements->target_weight(std::size_t(element.vertex[k]));
    }
    for (int p = 0; p < points; ++p) {
      const double target = (target_weight[0] + target_weight[1] + target_weight[2]) / 6 + 0.5 * target_weight[p];
      double density = m_size_attraction / m_elements->total_area();
      if (target > 0)
        density += m_target_attraction * target / m_elements->target_area();
      const double factor = std::sqrt(density * element.area / 3);
      Coefficients area_derivatives;
      const double area = Tensor_coefficients<N>::area(Pieces::interpolate(q, p), &area_derivatives);
      const double log_size = (expected[0] + expected[1] + expected[2]) / 6 + 0.5 * expected[p];
      r[first_size_row + p] = factor * (0.5 * std::log(area) - log_size);
      if (J)
        for (int k = 0; k < 3; ++k)
          J->template block<1, N>(first_size_row + p, k * N) =
              (0.5 * factor * Pieces::weight(p, k) / area) * area_derivatives.transpose();
    }
  }

  /// At the centroid. \pre `q` has a positive area at the quadrature points, whose mean the centroid is.
  void add_grading_attraction(const typename Pieces::Element& element, const typename Pieces::Corners& q, Residuals& r,
                              Jacobian* J) const
  {
    if (m_grading_attraction == 0) {
      r.template tail<2>().setZero();
      if (J)
        J->template bottomRows<2>().setZero();
      return;
    }
    const double factor = std::sqrt(m_grading_attraction * element.area);
    Coefficients area_derivatives;
    const double area = Tensor_coefficients<N>::area((q[0] + q[1] + q[2]) / 3, &area_derivatives);
    for (int a = 0; a < 2; ++a) {
      Coefficients slope = Coefficients::Zero();
      double expected = 0;
      for (int k = 0; k < 3; ++k) {
        slope += element.gradient(a, k) * q[std::size_t(k)];
        expected += element.gradient(a, k) * m_elements->expected_log_size(std::size_t(element.vertex[std::size_t(k)]));
      }
      // The area is a quadratic form, so its derivatives are linear in the coefficients.
      Coefficients slope_derivatives;
      Tensor_coefficients<N>::area(slope, &slope_derivatives);
      const double log_slope = 0.5 * area_derivatives.dot(slope) / area;
      const int row = first_grading_row + a;
      r[row] = factor * (log_slope - expected);
      if (J)
        for (int k = 0; k < 3; ++k)
          J->template block<1, N>(row, k * N) = factor *
                                                ((0.5 * slope_derivatives - log_slope * area_derivatives) / 3 +
                                                 0.5 * element.gradient(a, k) * area_derivatives)
                                                    .transpose() /
                                                area;
    }
  }

  const Field_elements<N>* m_elements;
  double m_relative_epsilon;
  double m_size_attraction = 0;
  double m_target_attraction = 0;
  double m_grading_attraction = 0;
};

} // namespace internal
} // namespace Quadrille

#endif
