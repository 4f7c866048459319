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
    : m_term(term), m_pattern(std::make_shared<Pattern>(term, n_unknowns)), m_threads(threads),
      m_matrix(m_pattern->matrix()), m_gradient(Vector::Zero(Eigen::Index(n_unknowns)))
{
}

template <class Term>
template <class Other_term>
Element_least_squares<Term>::Element_least_squares(const Term& term, const Element_least_squares<Other_term>& other,
                                                   int threads)
    : m_term(term), m_pattern(other.m_pattern), m_threads(threads), m_matrix(m_pattern->matrix()),
      m_gradient(Vector::Zero(other.m_gradient.size()))
{
}

template <class Term>
typename Element_least_squares<Term>::Unknowns Element_least_squares<Term>::local_unknowns(std::size_t e,
                                                                                           const Vector& x) const
{
  const auto& indices = m_pattern->indices(e);
  Unknowns local = Unknowns::Zero();
  for (int i = 0; i < m_pattern->count(e); ++i)
    local[i] = x[indices[std::size_t(i)]];
  return local;
}

template <class Term>
void Element_least_squares<Term>::evaluate(std::size_t first, std::size_t n, const Vector& x, Detail detail,
                                           Contribution* results) const
{
  constexpr double outside = std::numeric_limits<double>::infinity();
  if constexpr (in_batches) {
    Unknowns local[batch];
    for (std::size_t i = 0; i < n; ++i)
      local[i] = local_unknowns(first + i, x);
    if (!m_term.evaluate_batch(first, int(n), local, detail, results))
      results[0].energy = outside;
  } else {
    const int count = std::min(m_pattern->count(first), Term::max_unknowns); // compilers do not know
    const Unknowns local = local_unknowns(first, x);
    Residuals r;
    Jacobian J;
    const bool inside = m_term.evaluate(first, local, r, detail == Detail::energy ? nullptr : &J);
    results->energy = inside ? 0.5 * r.squaredNorm() : outside;
    if (!inside || detail == Detail::energy)
      return;
    // Column by column: Eigen's general products are slower at these sizes, and half of the matrix is enough.
    for (int i = 0; i < count; ++i)
      results->gradient[i] = J.col(i).dot(r);
    if (detail == Detail::matrix)
      for (int j = 0; j < count; ++j)
        for (int i = j; i < count; ++i)
          results->matrix(i, j) = J.col(i).dot(J.col(j));
  }
}

template <class Term>
template <class Add>
double Element_least_squares<Term>::accumulate(const Vector& x, Detail detail, const Add& add) const
{
  // One thread works within its cache; several need blocks that are worth waking them for. Whole batches.
  const std::size_t block = (m_threads == 1 ? 64 : 2048) / batch * batch;
  const std::size_t n = m_pattern->number_of_elements();
  m_buffer.resize(std::min(block, n));
  double energy = 0;
  for (std::size_t begin = 0; begin < n; begin += block) {
    const std::size_t size = std::min(block, n - begin);
    parallel_for((size + batch - 1) / batch, m_threads,
                 [&](std::size_t i) {
                   const std::size_t first = i * batch;
                   evaluate(begin + first, std::min(batch, size - first), x, detail, &m_buffer[first]);
                 },
                 128 / batch);
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
  gradient.setZero(Eigen::Index(number_of_unknowns()));
  return accumulate(x, Detail::gradient, [&](std::size_t e, const Contribution& c) {
    const auto& indices = m_pattern->indices(e);
    for (int i = 0; i < m_pattern->count(e); ++i)
      gradient[indices[std::size_t(i)]] += c.gradient[i];
  });
}

template <class Term> double Element_least_squares<Term>::linearize(const Vector& x)
{
  m_gradient.setZero();
  double* values = m_matrix.valuePtr();
  std::fill(values, values + m_matrix.nonZeros(), 0.0);
  return accumulate(x, Detail::matrix, [&](std::size_t e, const Contribution& c) {
    const int* place = m_pattern->places(e);
    const auto& indices = m_pattern->indices(e);
    for (int i = 0; i < m_pattern->count(e); ++i) {
      m_gradient[indices[std::size_t(i)]] += c.gradient[i];
      for (int j = 0; j <= i; ++j)
        values[*place++] += c.matrix(i, j);
    }
  });
}

} // namespace Quadrille

#endif
