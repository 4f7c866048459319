// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_CIRCULAR_HARMONICS_H
#define QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_CIRCULAR_HARMONICS_H

#include <Quadrille/Symmetric_tensor_2.h>

namespace Quadrille {
namespace internal {

constexpr double pi = 3.14159265358979323846;

inline Eigen::Matrix<double, 5, 5> make_entries_of_harmonics()
{
  // p(t) = a0 + a2 cos 2t + b2 sin 2t + a4 cos 4t + b4 sin 4t has the entries below; the columns are then scaled by
  // the norms of the basis functions.
  Eigen::Matrix<double, 5, 5> m;
  m << 1, 1, 0, 1, 0,      // T1111 = a0 + a2 + a4
      0, 0, 0.5, 0, 1,     // T1112 = b2 / 2 + b4
      1. / 3, 0, 0, -1, 0, // T1122 = a0 / 3 - a4
      0, 0, 0.5, 0, -1,    // T1222 = b2 / 2 - b4
      1, -1, 0, 1, 0;      // T2222 = a0 - a2 + a4
  m.col(0) /= std::sqrt(2 * pi);
  m.rightCols<4>() /= std::sqrt(pi);
  return m;
}

inline Eigen::Matrix<double, 5, 5> make_harmonics_of_entries()
{
  Eigen::Matrix<double, 5, 5> m;
  m << 3. / 8, 0, 3. / 4, 0, 3. / 8, // a0
      0.5, 0, 0, 0, -0.5,            // a2
      0, 1, 0, 1, 0,                 // b2
      1. / 8, 0, -3. / 4, 0, 1. / 8, // a4
      0, 0.5, 0, -0.5, 0;            // b4
  m.row(0) *= std::sqrt(2 * pi);
  m.bottomRows<4>() *= std::sqrt(pi);
  return m;
}

} // namespace internal

inline const Eigen::Matrix<double, 5, 5>& Symmetric_tensor_2::entries_of_harmonics()
{
  static const Eigen::Matrix<double, 5, 5> matrix = internal::make_entries_of_harmonics();
  return matrix;
}

inline const Eigen::Matrix<double, 5, 5>& Symmetric_tensor_2::harmonics_of_entries()
{
  static const Eigen::Matrix<double, 5, 5> matrix = internal::make_harmonics_of_entries();
  return matrix;
}

} // namespace Quadrille

#endif
