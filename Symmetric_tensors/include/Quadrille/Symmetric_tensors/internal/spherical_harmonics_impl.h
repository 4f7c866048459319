// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_SPHERICAL_HARMONICS_IMPL_H
#define QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_SPHERICAL_HARMONICS_IMPL_H

#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/Symmetric_tensors/internal/spherical_harmonics.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <array>
#include <cmath>
#include <cstddef>

namespace Quadrille {
namespace internal {

/// A homogeneous polynomial in x, y, z of a degree up to 4; what is not filled in is zero.
class Homogeneous_polynomial {
public:
  Homogeneous_polynomial(double constant = 0) { m_coefficients[0] = constant; }

  static Homogeneous_polynomial coordinate(int i)
  {
    Homogeneous_polynomial p;
    p.m_degree = 1;
    p.m_coefficients[std::size_t(i)] = 1;
    return p;
  }

  /// Of x^(degree - n) y^(n - c) z^c.
  double coefficient(int n, int c) const { return m_coefficients[number(n, c)]; }

  friend Homogeneous_polynomial operator*(const Homogeneous_polynomial& p, const Homogeneous_polynomial& q)
  {
    Homogeneous_polynomial product;
    product.m_degree = p.m_degree + q.m_degree;
    for (int n = 0; n <= p.m_degree; ++n)
      for (int c = 0; c <= n; ++c)
        for (int k = 0; k <= q.m_degree; ++k)
          for (int d = 0; d <= k; ++d)
            product.m_coefficients[number(n + k, c + d)] += p.coefficient(n, c) * q.coefficient(k, d);
    return product;
  }
  /// \pre equal degrees
  friend Homogeneous_polynomial operator+(Homogeneous_polynomial p, const Homogeneous_polynomial& q)
  {
    for (std::size_t i = 0; i < p.m_coefficients.size(); ++i)
      p.m_coefficients[i] += q.m_coefficients[i];
    return p;
  }
  friend Homogeneous_polynomial operator-(const Homogeneous_polynomial& p, const Homogeneous_polynomial& q)
  {
    return p + Homogeneous_polynomial(-1) * q;
  }

private:
  static std::size_t number(int n, int c) { return std::size_t(n * (n + 1) / 2 + c); }

  int m_degree = 0;
  std::array<double, 15> m_coefficients = {};
};

QUADRILLE_INLINE Eigen::Matrix<double, 15, 15> make_entries_of_spherical_harmonics()
{
  using Polynomial = Homogeneous_polynomial;
  const Eigen::Matrix<Polynomial, 15, 1> h =
      even_harmonics(Polynomial::coordinate(0), Polynomial::coordinate(1), Polynomial::coordinate(2));
  constexpr double factorial[] = {1, 1, 2, 6, 24};
  Eigen::Matrix<double, 15, 15> m;
  for (int column = 0; column < 15; ++column)
    for (int n = 0; n <= 4; ++n)
      for (int c = 0; c <= n; ++c) {
        const double n_components = factorial[4] / (factorial[4 - n] * factorial[n - c] * factorial[c]);
        m(n * (n + 1) / 2 + c, column) = h[column].coefficient(n, c) / n_components;
      }
  return m;
}

QUADRILLE_INLINE Eigen::Matrix<double, 15, 15> make_spherical_harmonics_of_entries()
{
  return make_entries_of_spherical_harmonics().partialPivLu().inverse();
}

} // namespace internal
} // namespace Quadrille

#endif
