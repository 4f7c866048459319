// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_KAPPA_ENERGY_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_KAPPA_ENERGY_H

#include <Quadrille/Odeco_frame_field/internal/Field_elements.h>
#include <Quadrille/Odeco_frame_field/internal/Field_residuals.h>
#include <Quadrille/Odeco_frame_field/internal/Triangle_energy.h>

#include <algorithm>

namespace Quadrille {
namespace internal {

/// The rows of a triangle in planar-1's energy.
template <int N>
constexpr int kappa_energy_rows =
    Field_residuals<N>::lie_rows + Field_residuals<N>::dirichlet_rows + Field_residuals<N>::odeco_rows;

/// The energy of planar-1, eq. (5.31):
/// E_kappa = (1 - kappa) E_Lie + kappa E_Dir + E_odeco / epsilon^2, with the odeco penalty of eq. (5.29), which is not
/// divided by areas: how the three terms compare depends on the unit of sizes.
///
/// With kappa = 1 every tensor is in its domain, also the zero that the paper starts from.
template <int N> class Kappa_energy : public Triangle_energy<Kappa_energy<N>, Field_elements<N>, kappa_energy_rows<N>> {
  using Pieces = Field_residuals<N>;

public:
  /// As in the paper, epsilon is the same everywhere: `relative_epsilon` times the size of the largest triangle.
  Kappa_energy(const Field_elements<N>& elements, double relative_epsilon, double kappa)
      : Triangle_energy<Kappa_energy<N>, Field_elements<N>, kappa_energy_rows<N>>(elements), m_kappa(kappa)
  {
    for (std::size_t e = 0; e < elements.number_of_elements(); ++e)
      m_epsilon = std::max(m_epsilon, relative_epsilon * elements.element(e).size);
  }

  void set_kappa(double kappa) { m_kappa = kappa; }

  template <class S, class Rows> bool add_rows(const Triangle_values<S, N>& triangle, Rows& rows) const
  {
    if (m_kappa == 1)
      rows.template skip<Pieces::lie_rows>();
    else if (!Pieces::lie(triangle, 1 - m_kappa, rows))
      return false;
    Pieces::dirichlet(triangle, m_kappa, rows);
    Pieces::plain_odeco(triangle, m_epsilon, rows);
    return true;
  }

private:
  double m_epsilon = 0;
  double m_kappa;
};

} // namespace internal
} // namespace Quadrille

#endif
