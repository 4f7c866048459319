// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_KAPPA_ENERGY_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_KAPPA_ENERGY_H

#include <Quadrille/Odeco_frame_field/internal/Field_residuals.h>

#include <algorithm>

namespace Quadrille {
namespace internal {

/// The energy of planar-1 as a `LeastSquaresTerm`, eq. (5.31):
/// E_kappa = (1 - kappa) E_Lie + kappa E_Dir + E_odeco / epsilon^2, with the odeco penalty of eq. (5.29), which is not
/// divided by areas: how the three terms compare depends on the unit of sizes.
///
/// With kappa = 1 every tensor is in its domain, also the zero that the paper starts from.
template <int N> class Kappa_energy {
  using Pieces = Field_residuals<N>;
  static constexpr int first_dirichlet_row = Pieces::lie_rows;
  static constexpr int first_odeco_row = first_dirichlet_row + Pieces::dirichlet_rows;

public:
  static constexpr int max_unknowns = 3 * N;
  static constexpr int max_residuals = first_odeco_row + Pieces::odeco_rows;
  using Unknowns = Eigen::Matrix<double, max_unknowns, 1>;
  using Residuals = Eigen::Matrix<double, max_residuals, 1>;
  using Jacobian = Eigen::Matrix<double, max_residuals, max_unknowns>;

  /// As in the paper, epsilon is the same everywhere: `relative_epsilon` times the size of the largest triangle.
  Kappa_energy(const Field_elements<N>& elements, double relative_epsilon, double kappa)
      : m_elements(&elements), m_kappa(kappa)
  {
    for (std::size_t e = 0; e < elements.number_of_elements(); ++e)
      m_epsilon = std::max(m_epsilon, relative_epsilon * elements.element(e).size);
  }

  void set_kappa(double kappa) { m_kappa = kappa; }

  std::size_t number_of_elements() const { return m_elements->number_of_elements(); }
  int element_unknowns(std::size_t e, std::array<int, std::size_t(max_unknowns)>& index) const
  {
    return m_elements->element_unknowns(e, index);
  }

  bool evaluate(std::size_t e, const Unknowns& x, Residuals& r, Jacobian* J) const
  {
    const auto& element = m_elements->element(e);
    const auto q = m_elements->corner_coefficients(e, x);
    Jacobian derivatives;
    Jacobian* by_coefficients = J ? &derivatives : nullptr;
    if (m_kappa < 1) {
      if (!Pieces::template lie<0>(element, q, 1 - m_kappa, r, by_coefficients))
        return false;
    } else {
      r.template head<Pieces::lie_rows>().setZero();
      derivatives.template topRows<Pieces::lie_rows>().setZero();
    }
    Pieces::template dirichlet<first_dirichlet_row>(element, q, m_kappa, r, by_coefficients);
    Pieces::template plain_odeco<first_odeco_row>(element, q, m_epsilon, r, by_coefficients);
    if (J)
      m_elements->restrict_jacobian(e, derivatives, *J);
    return true;
  }

private:
  const Field_elements<N>* m_elements;
  double m_epsilon = 0;
  double m_kappa;
};

} // namespace internal
} // namespace Quadrille

#endif
