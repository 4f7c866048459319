// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_SPHERICAL_HARMONICS_H
#define QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_SPHERICAL_HARMONICS_H

#include <Eigen/Core>

#include <cmath>

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

/// The tensors of the harmonics, by columns: an entry is the coefficient of its monomial over the number of components
/// that share it.
Eigen::Matrix<double, 15, 15> make_entries_of_spherical_harmonics();
/// The inverse.
Eigen::Matrix<double, 15, 15> make_spherical_harmonics_of_entries();

} // namespace internal
} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Symmetric_tensors/internal/spherical_harmonics_impl.h>
#endif

#endif
