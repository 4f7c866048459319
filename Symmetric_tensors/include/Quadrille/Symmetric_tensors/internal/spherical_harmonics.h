// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_SPHERICAL_HARMONICS_H
#define QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_SPHERICAL_HARMONICS_H

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>

namespace Quadrille {
namespace internal {

/// The nine real spherical harmonics of degree 4 as homogeneous polynomials, by order m = -4, ..., 4. `S` is a scalar
/// or a pack of them.
template <class S> Eigen::Matrix<S, 9, 1> harmonics_of_degree_4(const S& x, const S& y, const S& z)
{
  const double pi = std::acos(-1.0);
  const double c4 = 3.0 / 4 * std::sqrt(35 / pi), c3 = 3.0 / 4 * std::sqrt(35 / (2 * pi)),
               c2 = 3.0 / 4 * std::sqrt(5 / pi), c1 = 3.0 / 4 * std::sqrt(5 / (2 * pi)), c0 = 3.0 / 16 / std::sqrt(pi);
  const S xx = x * x, yy = y * y, zz = z * z, rr = xx + yy + zz;
  const S difference = xx - yy, xy = x * y;
  const S a2 = S(7) * zz - rr, a1 = z * (S(7) * zz - S(3) * rr);
  Eigen::Matrix<S, 9, 1> h;
  h[0] = S(c4) * xy * difference;
  h[1] = S(c3) * y * z * (S(3) * xx - yy);
  h[2] = S(c2) * xy * a2;
  h[3] = S(c1) * y * a1;
  h[4] = S(c0) * (S(35) * zz * zz - S(30) * zz * rr + S(3) * rr * rr);
  h[5] = S(c1) * x * a1;
  h[6] = S(c2 / 2) * difference * a2;
  h[7] = S(c3) * x * z * (xx - S(3) * yy);
  h[8] = S(c4 / 4) * (xx * xx - S(6) * xx * yy + yy * yy);
  return h;
}

/// All harmonics of degree 0, 2 and 4, times the power of the radius that makes them homogeneous of degree 4.
template <class S> Eigen::Matrix<S, 15, 1> even_harmonics(const S& x, const S& y, const S& z)
{
  const double pi = std::acos(-1.0);
  const double c2 = std::sqrt(15 / pi) / 2, c0 = std::sqrt(5 / pi) / 4;
  const S xx = x * x, yy = y * y, zz = z * z, rr = xx + yy + zz;
  Eigen::Matrix<S, 15, 1> h;
  h[0] = S(1 / (2 * std::sqrt(pi))) * rr * rr;
  h[1] = S(c2) * x * y * rr;
  h[2] = S(c2) * y * z * rr;
  h[3] = S(c0) * (S(3) * zz - rr) * rr;
  h[4] = S(c2) * x * z * rr;
  h[5] = S(c2 / 2) * (xx - yy) * rr;
  h.template tail<9>() = harmonics_of_degree_4(x, y, z);
  return h;
}

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

/// The tensors of the harmonics, by columns: an entry is the coefficient of its monomial over the number of components
/// that share it.
inline Eigen::Matrix<double, 15, 15> make_entries_of_spherical_harmonics()
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

} // namespace internal
} // namespace Quadrille

#endif
