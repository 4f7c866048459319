// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SPACE_TENSOR_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SPACE_TENSOR_H

#include <Quadrille/Odeco_frame_field/internal/Tensor_coefficients.h>
#include <Quadrille/Odeco_quadrics_3.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace Quadrille {
namespace internal {

// Fully symmetric tensors of space by their different entries, for formulas over `Pack`. Entry n (n + 1) / 2 + c has c
// indices equal to 3 and n - c equal to 2, whatever the order; see `Symmetric_tensor_3`.
template <class S> using Space_tensor = Tuple<S, 15>; ///< order 4
template <class S> using Cubic_tensor = Tuple<S, 10>; ///< order 3
template <class S> using Space_matrix = Tuple<S, 6>;  ///< order 2: 11, 12, 13, 22, 23, 33
template <class S> using Space_vector = Tuple<S, 3>;

/// How entries of one order follow from those of the next lower one.
struct Tensor_index {
  int by[3]; ///< place of the entry with one more index equal to 1, 2, 3
};
constexpr Tensor_index tensor_index(int entry)
{
  int n = 0;
  while ((n + 1) * (n + 2) / 2 <= entry)
    ++n;
  const int next = entry + n + 1;
  return {{entry, next, next + 1}};
}
template <int count> struct Tensor_indices {
  Tensor_index values[std::size_t(count)] = {};
  constexpr Tensor_indices()
  {
    for (int i = 0; i < count; ++i)
      values[i] = tensor_index(i);
  }
  constexpr int operator()(int entry, int index) const { return values[entry].by[index]; }
};
/// Place of the entry of order n + 1 that has the indices of entry `e` of order n and one more.
constexpr Tensor_indices<10> with_index;

/// How many of the 27 components of a cubic tensor, and of the 81 of a fourth-order one, an entry stands for.
constexpr double cubic_multiplicity[10] = {1, 3, 3, 3, 6, 3, 1, 3, 3, 1};
constexpr double space_multiplicity[15] = {1, 4, 4, 6, 12, 6, 4, 12, 12, 4, 1, 4, 6, 4, 1};
/// Of the matrix entry for two indices.
constexpr int matrix_place[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};

template <class S>
[[gnu::always_inline]] inline Space_vector<S> product(const Space_matrix<S>& m, const Space_vector<S>& v)
{
  return {{m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[1] * v[0] + m[3] * v[1] + m[4] * v[2],
           m[2] * v[0] + m[4] * v[1] + m[5] * v[2]}};
}

/// The second-order part M_ij = T_ijkk; surface, eq. (23).
template <class S> Space_matrix<S> second_order_part(const Space_tensor<S>& t)
{
  return {{t[0] + t[3] + t[5], t[1] + t[6] + t[8], t[2] + t[7] + t[9], t[3] + t[10] + t[12], t[4] + t[11] + t[13],
           t[5] + t[12] + t[14]}};
}
/// Its derivative by the entries of T, times a vector: row i of the result belongs to component i.
template <class S>
[[gnu::noinline]] void add_second_order_derivative(const Space_vector<S>& v, const S& factor,
                                                   Tuple<Space_tensor<S>, 3>& rows)
{
  constexpr int parts[6][3] = {{0, 3, 5}, {1, 6, 8}, {2, 7, 9}, {3, 10, 12}, {4, 11, 13}, {5, 12, 14}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (const int part : parts[matrix_place[i][j]])
        rows[i][part] += factor * v[j];
}

/// The determinant of a symmetric matrix, its inverse, and whether it is positive definite.
template <class S> struct Inverse_matrix {
  Space_matrix<S> inverse;
  S determinant;
  bool is_positive; ///< in every lane

  explicit Inverse_matrix(const Space_matrix<S>& m)
  {
    const S c0 = m[3] * m[5] - m[4] * m[4], c1 = m[2] * m[4] - m[1] * m[5], c2 = m[1] * m[4] - m[2] * m[3];
    determinant = m[0] * c0 + m[1] * c1 + m[2] * c2;
    const S minor = m[0] * m[3] - m[1] * m[1];
    is_positive = all_positive(m[0]) && all_positive(minor) && all_positive(determinant);
    const S scale = 1 / determinant;
    inverse = {{scale * c0, scale * c1, scale * c2, scale * (m[0] * m[5] - m[2] * m[2]),
                scale * (m[1] * m[2] - m[0] * m[4]), scale * minor}};
  }
};

/// T d, one index less.
template <class S> [[gnu::noinline]] Cubic_tensor<S> contract(const Space_tensor<S>& t, const Space_vector<S>& d)
{
  Cubic_tensor<S> result;
  for (int k = 0; k < 10; ++k)
    result[k] = d[0] * t[with_index(k, 0)] + d[1] * t[with_index(k, 1)] + d[2] * t[with_index(k, 2)];
  return result;
}

/// The quadrics of the odeco variety; surface, eq. (20).
constexpr int odeco_quadrics_count = Odeco_quadrics_3::number;

/// Their values, and their derivatives by the entries of T unless `by_tensor` is null.
template <class S>
[[gnu::noinline]] void odeco_residuals(const Space_tensor<S>& t, Tuple<S, odeco_quadrics_count>& value,
                                       Tuple<Space_tensor<S>, odeco_quadrics_count>* by_tensor)
{
  std::array<S, 15> entries;
  std::copy(t.values, t.values + 15, entries.begin());
  const auto values = odeco_quadrics_3().values(entries);
  std::copy(values.begin(), values.end(), value.values);
  if (!by_tensor)
    return;
  const auto jacobian = odeco_quadrics_3().jacobian(entries);
  for (int r = 0; r < odeco_quadrics_count; ++r)
    std::copy(jacobian[std::size_t(r)].begin(), jacobian[std::size_t(r)].end(), (*by_tensor)[r].values);
}

/// The sum of their squares, half its derivatives by the entries of T, and the Gram matrix J^T J of their Jacobian J
/// (its entries i >= j, row by row): what Gauss-Newton steps need, in a third of the time.
template <class S> struct Odeco_sums {
  S squared_norm;
  Space_tensor<S> half_gradient;
  Tuple<S, 120> gram;

  [[gnu::noinline]] Odeco_sums(const Space_tensor<S>& t, bool with_gram)
  {
    std::array<S, 15> entries, gradient;
    std::copy(t.values, t.values + 15, entries.begin());
    squared_norm = odeco_quadrics_3().squared_norm(entries, gradient);
    std::copy(gradient.begin(), gradient.end(), half_gradient.values);
    if (with_gram) {
      const std::array<S, 120> entries_of_gram = odeco_quadrics_3().gram(entries);
      std::copy(entries_of_gram.begin(), entries_of_gram.end(), gram.values);
    }
  }
};

} // namespace internal
} // namespace Quadrille

#endif
