// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_ELEMENT_PATTERN_H
#define QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_ELEMENT_PATTERN_H

#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// The unknowns of the elements of a least-squares problem, at most K each, the sparsity pattern of its Gauss-Newton
/// matrix (lower triangle with the whole diagonal), and where in the matrix values an element's entries belong.
template <int K> class Element_pattern {
public:
  using Indices = std::array<int, std::size_t(K)>;
  using Matrix = Eigen::SparseMatrix<double>;

  template <class Term>
  Element_pattern(const Term& term, std::size_t n_unknowns)
      : m_indices(term.number_of_elements()), m_counts(m_indices.size()), m_first(m_indices.size() + 1, 0),
        m_outer(n_unknowns + 1, 0)
  {
    for (std::size_t e = 0; e < m_indices.size(); ++e) {
      m_counts[e] = term.element_unknowns(e, m_indices[e]);
      m_first[e + 1] = m_first[e] + local_place(m_counts[e], 0);
    }
    build();
  }

  std::size_t number_of_unknowns() const { return m_outer.size() - 1; }
  std::size_t number_of_elements() const { return m_indices.size(); }
  int count(std::size_t e) const { return m_counts[e]; }
  const Indices& indices(std::size_t e) const { return m_indices[e]; }
  /// Of the entries (i, j), j <= i, of element `e`, row by row: their places in the matrix values.
  const int* places(std::size_t e) const { return m_places.data() + m_first[e]; }

  /// A matrix of this pattern with all values zero.
  Matrix matrix() const
  {
    const auto n = Eigen::Index(number_of_unknowns());
    Matrix result(n, n);
    result.resizeNonZeros(Eigen::Index(m_inner.size()));
    std::copy(m_outer.begin(), m_outer.end(), result.outerIndexPtr());
    std::copy(m_inner.begin(), m_inner.end(), result.innerIndexPtr());
    std::fill(result.valuePtr(), result.valuePtr() + m_inner.size(), 0.0);
    return result;
  }

private:
  static std::size_t local_place(int i, int j) { return std::size_t(i) * std::size_t(i + 1) / 2 + std::size_t(j); }

  void build()
  {
    // The elements of every unknown.
    const std::size_t n = number_of_unknowns();
    std::vector<std::size_t> first_incident(n + 1, 0);
    for (std::size_t e = 0; e < m_indices.size(); ++e)
      for (int i = 0; i < m_counts[e]; ++i)
        ++first_incident[std::size_t(m_indices[e][std::size_t(i)]) + 1];
    for (std::size_t c = 0; c < n; ++c)
      first_incident[c + 1] += first_incident[c];
    std::vector<std::pair<int, int>> incident(first_incident[n]); // element, number of the unknown in it
    std::vector<std::size_t> next(first_incident.begin(), first_incident.end() - 1);
    for (std::size_t e = 0; e < m_indices.size(); ++e)
      for (int i = 0; i < m_counts[e]; ++i)
        incident[next[std::size_t(m_indices[e][std::size_t(i)])]++] = {int(e), i};

    m_places.resize(m_first.back());
    std::vector<int> rows, place_of_row(n, -1);
    for (std::size_t c = 0; c < n; ++c) {
      const auto for_rows = [&](const auto& action) {
        for (std::size_t k = first_incident[c]; k < first_incident[c + 1]; ++k) {
          const auto [e, j] = incident[k];
          for (int i = 0; i < m_counts[std::size_t(e)]; ++i)
            if (const int row = m_indices[std::size_t(e)][std::size_t(i)]; row >= int(c))
              action(std::size_t(row), std::size_t(e), i, j);
        }
      };
      rows.assign(1, int(c)); // so that the damping always finds a diagonal
      place_of_row[c] = 0;
      for_rows([&](std::size_t row, std::size_t, int, int) {
        if (std::exchange(place_of_row[row], 0) < 0)
          rows.push_back(int(row));
      });
      std::sort(rows.begin(), rows.end());
      for (const int row : rows) {
        place_of_row[std::size_t(row)] = int(m_inner.size());
        m_inner.push_back(row);
      }
      for_rows([&](std::size_t row, std::size_t e, int i, int j) {
        m_places[m_first[e] + local_place(std::max(i, j), std::min(i, j))] = place_of_row[row];
      });
      for (const int row : rows)
        place_of_row[std::size_t(row)] = -1;
      m_outer[c + 1] = int(m_inner.size());
    }
    m_inner.shrink_to_fit();
  }

  std::vector<Indices> m_indices;    // of every element
  std::vector<int> m_counts;         // how many of them are used
  std::vector<std::size_t> m_first;  // of every element, its first entry in m_places
  std::vector<int> m_places;         // positions in the matrix values
  std::vector<int> m_outer, m_inner; // the pattern, by columns
};

} // namespace internal
} // namespace Quadrille

#endif
