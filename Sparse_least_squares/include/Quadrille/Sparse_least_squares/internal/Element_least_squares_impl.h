// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_ELEMENT_LEAST_SQUARES_IMPL_H
#define QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_ELEMENT_LEAST_SQUARES_IMPL_H

#include <Quadrille/Element_least_squares.h>
#include <Quadrille/parallel_for.h>

#include <algorithm>
#include <limits>

namespace Quadrille {

template <class Term>
Element_least_squares<Term>::Element_least_squares(const Term& term, std::size_t n_unknowns, int threads)
    : m_term(term), m_n(n_unknowns), m_threads(threads), m_gradient(Vector::Zero(Eigen::Index(n_unknowns)))
{
  const std::size_t n_elements = term.number_of_elements();
  m_indices.resize(n_elements);
  m_counts.resize(n_elements);
  m_first.resize(n_elements + 1, 0);
  for (std::size_t e = 0; e < n_elements; ++e) {
    m_counts[e] = term.element_unknowns(e, m_indices[e]);
    const auto count = std::size_t(m_counts[e]);
    m_first[e + 1] = m_first[e] + count * (count + 1) / 2;
  }
  build_pattern();
}

template <class Term> void Element_least_squares<Term>::build_pattern()
{
  std::vector<std::vector<int>> rows_of_column(m_n);
  for (std::size_t e = 0; e < m_indices.size(); ++e)
    for (int i = 0; i < m_counts[e]; ++i)
      for (int j = 0; j <= i; ++j) {
        const auto [low, high] = std::minmax(m_indices[e][std::size_t(i)], m_indices[e][std::size_t(j)]);
        rows_of_column[std::size_t(low)].push_back(high);
      }
  std::vector<int> column_start(m_n + 1, 0);
  std::vector<int> rows;
  for (std::size_t c = 0; c < m_n; ++c) {
    std::vector<int>& column = rows_of_column[c];
    column.push_back(int(c)); // so that the damping always finds a diagonal
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
    rows.insert(rows.end(), column.begin(), column.end());
    column_start[c + 1] = int(rows.size());
    std::vector<int>().swap(column);
  }
  m_matrix.resize(Eigen::Index(m_n), Eigen::Index(m_n));
  m_matrix.resizeNonZeros(Eigen::Index(rows.size()));
  std::copy(column_start.begin(), column_start.end(), m_matrix.outerIndexPtr());
  std::copy(rows.begin(), rows.end(), m_matrix.innerIndexPtr());
  std::fill(m_matrix.valuePtr(), m_matrix.valuePtr() + rows.size(), 0.0);

  m_places.resize(m_first.back());
  parallel_for(m_indices.size(), m_threads, [&](std::size_t e) {
    std::size_t place = m_first[e];
    for (int i = 0; i < m_counts[e]; ++i)
      for (int j = 0; j <= i; ++j) {
        const auto [low, high] = std::minmax(m_indices[e][std::size_t(i)], m_indices[e][std::size_t(j)]);
        const auto begin = rows.begin() + column_start[std::size_t(low)];
        const auto end = rows.begin() + column_start[std::size_t(low) + 1];
        m_places[place++] = int(std::lower_bound(begin, end, high) - rows.begin());
      }
  });
}

template <class Term>
void Element_least_squares<Term>::evaluate(std::size_t e, const Vector& x, Detail detail, Contribution& result) const
{
  Unknowns local = Unknowns::Zero();
  for (int i = 0; i < m_counts[e]; ++i)
    local[i] = x[m_indices[e][std::size_t(i)]];
  Residuals r;
  if (detail == Detail::energy) {
    const bool inside = m_term.evaluate(e, local, r, nullptr);
    result.energy = inside ? 0.5 * r.squaredNorm() : std::numeric_limits<double>::infinity();
    return;
  }
  Jacobian J;
  if (!m_term.evaluate(e, local, r, &J)) {
    result.energy = std::numeric_limits<double>::infinity();
    return;
  }
  result.energy = 0.5 * r.squaredNorm();
  // Column by column: Eigen's general products are slower at these sizes, and half of the matrix is enough.
  for (int i = 0; i < m_counts[e]; ++i)
    result.gradient[i] = J.col(i).dot(r);
  if (detail == Detail::matrix)
    for (int j = 0; j < m_counts[e]; ++j)
      for (int i = j; i < m_counts[e]; ++i)
        result.matrix(i, j) = J.col(i).dot(J.col(j));
}

template <class Term>
template <class Add>
double Element_least_squares<Term>::accumulate(const Vector& x, Detail detail, const Add& add) const
{
  constexpr std::size_t block = 2048;
  const std::size_t n = m_indices.size();
  m_buffer.resize(std::min(block, n));
  double energy = 0;
  for (std::size_t begin = 0; begin < n; begin += block) {
    const std::size_t size = std::min(block, n - begin);
    parallel_for(
        size, m_threads, [&](std::size_t i) { evaluate(begin + i, x, detail, m_buffer[i]); }, 128);
    for (std::size_t i = 0; i < size; ++i) {
      energy += m_buffer[i].energy;
      if (!(energy < std::numeric_limits<double>::infinity()))
        return std::numeric_limits<double>::infinity();
      add(begin + i, m_buffer[i]);
    }
  }
  return energy;
}

template <class Term> double Element_least_squares<Term>::energy(const Vector& x) const
{
  return accumulate(x, Detail::energy, [](std::size_t, const Contribution&) {});
}

template <class Term> double Element_least_squares<Term>::energy_and_gradient(const Vector& x, Vector& gradient) const
{
  gradient.setZero(Eigen::Index(m_n));
  return accumulate(x, Detail::gradient, [&](std::size_t e, const Contribution& c) {
    for (int i = 0; i < m_counts[e]; ++i)
      gradient[m_indices[e][std::size_t(i)]] += c.gradient[i];
  });
}

template <class Term> double Element_least_squares<Term>::linearize(const Vector& x)
{
  m_gradient.setZero();
  double* values = m_matrix.valuePtr();
  std::fill(values, values + m_matrix.nonZeros(), 0.0);
  return accumulate(x, Detail::matrix, [&](std::size_t e, const Contribution& c) {
    const int* place = m_places.data() + m_first[e];
    for (int i = 0; i < m_counts[e]; ++i) {
      m_gradient[m_indices[e][std::size_t(i)]] += c.gradient[i];
      for (int j = 0; j <= i; ++j)
        values[*place++] += c.matrix(i, j);
    }
  });
}

} // namespace Quadrille

#endif
