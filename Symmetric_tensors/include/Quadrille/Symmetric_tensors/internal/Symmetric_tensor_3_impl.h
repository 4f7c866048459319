// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_SYMMETRIC_TENSOR_3_IMPL_H
#define QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_SYMMETRIC_TENSOR_3_IMPL_H

#include <Quadrille/Symmetric_tensors/internal/spherical_harmonics.h>

#include <array>
#include <cmath>

namespace Quadrille {
namespace internal {

/// The number of the entry with `n2` indices equal to 2 and `n3` equal to 3, for tensors of every order.
constexpr int entry_number(int n2, int n3) { return (n2 + n3) * (n2 + n3 + 1) / 2 + n3; }

constexpr int entry_of_indices(int i, int j, int k, int l)
{
  return entry_number((i == 1) + (j == 1) + (k == 1) + (l == 1), (i == 2) + (j == 2) + (k == 2) + (l == 2));
}

/// Pairs of indices in Mandel's order.
constexpr int mandel_pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};

} // namespace internal

inline Symmetric_tensor_3 Symmetric_tensor_3::power(const Vector& w)
{
  Entries entries;
  for (int n = 0; n <= 4; ++n)
    for (int c = 0; c <= n; ++c) {
      double product = 1;
      for (int k = 0; k < 4; ++k)
        product *= w[k < 4 - n ? 0 : k < 4 - c ? 1 : 2];
      entries[internal::entry_number(n - c, c)] = product;
    }
  return Symmetric_tensor_3(entries);
}

inline double Symmetric_tensor_3::operator()(int i, int j, int k, int l) const
{
  return m_t[internal::entry_of_indices(i, j, k, l)];
}

inline Symmetric_tensor_3::Mandel_matrix Symmetric_tensor_3::mandel() const
{
  Mandel_matrix m;
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 6; ++c) {
      const auto [i, j] = internal::mandel_pairs[r];
      const auto [k, l] = internal::mandel_pairs[c];
      m(r, c) = (*this)(i, j, k, l) * ((r < 3) == (c < 3) ? (r < 3 ? 1 : 2) : std::sqrt(2.0));
    }
  return m;
}

inline Symmetric_tensor_3 Symmetric_tensor_3::from_mandel(const Mandel_matrix& m)
{
  Entries sum = Entries::Zero(), number = Entries::Zero();
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 6; ++c) {
      const auto [i, j] = internal::mandel_pairs[r];
      const auto [k, l] = internal::mandel_pairs[c];
      const double times = (r < 3 ? 1 : 2) * (c < 3 ? 1 : 2); // components of the tensor in this entry
      const int entry = internal::entry_of_indices(i, j, k, l);
      sum[entry] += std::sqrt(times) * m(r, c); // times component; Mandel's entry has the root as a factor
      number[entry] += times;
    }
  return Symmetric_tensor_3(sum.cwiseQuotient(number));
}

inline Symmetric_tensor_3::Matrix Symmetric_tensor_3::partial_trace() const
{
  Matrix trace = Matrix::Zero();
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l)
      for (int i = 0; i < 3; ++i)
        trace(k, l) += (*this)(i, i, k, l);
  return trace;
}

inline double Symmetric_tensor_3::squared_norm() const { return mandel().squaredNorm(); }

inline Symmetric_tensor_3::Matrix Symmetric_tensor_3::contract_twice(const Vector& w) const
{
  // One order after the other: entries of order n - 1 from those of order n.
  std::array<double, 15> t;
  Eigen::Map<Entries>(t.data()) = m_t;
  for (int order = 4; order > 2; --order)
    for (int n = 0; n < order; ++n)
      for (int c = 0; c <= n; ++c)
        t[std::size_t(internal::entry_number(n - c, c))] = w[0] * t[std::size_t(internal::entry_number(n - c, c))] +
                                                           w[1] * t[std::size_t(internal::entry_number(n - c + 1, c))] +
                                                           w[2] * t[std::size_t(internal::entry_number(n - c, c + 1))];
  return (Matrix() << t[0], t[1], t[2], t[1], t[3], t[4], t[2], t[4], t[5]).finished();
}

inline Symmetric_tensor_3 Symmetric_tensor_3::rotated(const Matrix& R) const
{
  // Mandel's form of A -> R A R^T is orthogonal.
  Mandel_matrix K;
  for (int c = 0; c < 6; ++c)
    K.col(c) = mandel_vector(R * matrix_of_mandel_vector(Mandel_matrix::Identity().col(c)) * R.transpose());
  return from_mandel(K * mandel() * K.transpose());
}

inline Eigen::Matrix<double, 6, 1> mandel_vector(const Eigen::Matrix3d& a)
{
  Eigen::Matrix<double, 6, 1> v;
  for (int r = 0; r < 6; ++r)
    v[r] = a(internal::mandel_pairs[r][0], internal::mandel_pairs[r][1]) * (r < 3 ? 1 : std::sqrt(2.0));
  return v;
}

inline Eigen::Matrix3d matrix_of_mandel_vector(const Eigen::Matrix<double, 6, 1>& v)
{
  Eigen::Matrix3d a;
  for (int r = 0; r < 6; ++r) {
    const auto [i, j] = internal::mandel_pairs[r];
    a(i, j) = a(j, i) = v[r] / (r < 3 ? 1 : std::sqrt(2.0));
  }
  return a;
}

inline const Eigen::Matrix<double, 15, 15>& Symmetric_tensor_3::entries_of_harmonics()
{
  static const Eigen::Matrix<double, 15, 15> matrix = internal::make_entries_of_spherical_harmonics();
  return matrix;
}

inline const Eigen::Matrix<double, 15, 15>& Symmetric_tensor_3::harmonics_of_entries()
{
  static const Eigen::Matrix<double, 15, 15> matrix = internal::make_spherical_harmonics_of_entries();
  return matrix;
}

} // namespace Quadrille

#endif
