// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_CHECK_JACOBIAN_H
#define QUADRILLE_CHECK_JACOBIAN_H

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace Quadrille {

/// Compares the Jacobian that a `LeastSquaresTerm` returns with fourth-order central differences of its residuals.
///
/// For element `e` at the local unknowns `x`: the largest difference of an entry, relative to the largest entry of its
/// column. Correct Jacobians of smooth residuals give about 1e-9, wrong ones about 1. Infinity if `x`, or a point at
/// `step` times max(1, |x_i|) from it, is outside the term's domain.
template <class Term>
double jacobian_error(const Term& term, std::size_t e, const typename Term::Unknowns& x, double step = 1e-3)
{
  std::array<int, std::size_t(Term::max_unknowns)> index;
  const int count = term.element_unknowns(e, index);
  typename Term::Residuals r, ahead[4];
  typename Term::Jacobian J;
  double error = 0;
  if (!term.evaluate(e, x, r, &J))
    return std::numeric_limits<double>::infinity();
  for (int j = 0; j < count; ++j) {
    const double h = step * std::max(1.0, std::abs(x[j]));
    const double places[4] = {-2, -1, 1, 2};
    for (int k = 0; k < 4; ++k) {
      typename Term::Unknowns shifted = x;
      shifted[j] += places[k] * h;
      if (!term.evaluate(e, shifted, ahead[k], nullptr))
        return std::numeric_limits<double>::infinity();
    }
    const typename Term::Residuals difference = (ahead[0] - 8 * ahead[1] + 8 * ahead[2] - ahead[3]) / (12 * h);
    const double scale = std::max(difference.cwiseAbs().maxCoeff(), J.col(j).cwiseAbs().maxCoeff());
    if (scale > 0)
      error = std::max(error, (difference - J.col(j)).cwiseAbs().maxCoeff() / scale);
  }
  return error;
}

} // namespace Quadrille

#endif
