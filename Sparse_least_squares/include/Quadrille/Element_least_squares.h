// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ELEMENT_LEAST_SQUARES_H
#define QUADRILLE_ELEMENT_LEAST_SQUARES_H

#include <Quadrille/Sparse_least_squares/internal/Element_pattern.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace Quadrille {

namespace internal {

template <class Term, class = void> struct Batch_size : std::integral_constant<int, 0> {
};
template <class Term>
struct Batch_size<Term, std::void_t<decltype(Term::batch_size)>> : std::integral_constant<int, Term::batch_size> {
};

} // namespace internal

/// What one element adds to the energy and, as far as asked for, to its gradient and Gauss-Newton matrix.
template <int max_unknowns> struct Element_contribution {
  using Vector = Eigen::Matrix<double, max_unknowns, 1>;
  using Matrix = Eigen::Matrix<double, max_unknowns, max_unknowns>;
  double energy;
  Vector gradient;
  Matrix matrix; ///< of J^T J the lower triangle
};

/// How much of it is asked for; each contains what is before it.
enum class Detail { energy, gradient, matrix };

/// A sum of squares over small elements, E(x) = 1/2 sum_e |r_e(x_e)|^2, with its gradient and Gauss-Newton matrix.
///
/// `Term` is a model of the concept `LeastSquaresTerm` (doc/Sparse_least_squares/Concepts). The sparsity pattern and
/// the place of every element entry in it are computed once; linearisations then write straight into the matrix values.
/// Problems whose elements have the same unknowns can share them.
/// Elements are evaluated in parallel and added in their own order, so results do not depend on the number of threads.
/// One object serves one caller at a time (it holds scratch space, also in its const functions).
/// Complexity: construction and every evaluation linear in the number of elements.
template <class Term> class Element_least_squares {
public:
  using Matrix = Eigen::SparseMatrix<double>;
  using Vector = Eigen::VectorXd;

  /// \pre `term` outlives this object, and its elements keep their unknowns. `threads` = 0 uses all cores.
  Element_least_squares(const Term& term, std::size_t n_unknowns, int threads = 1);

  /// Shares the pattern of `other`, whose elements have the same unknowns.
  template <class Other_term>
  Element_least_squares(const Term& term, const Element_least_squares<Other_term>& other, int threads = 1);

  std::size_t number_of_unknowns() const { return m_pattern->number_of_unknowns(); }
  int threads() const { return m_threads; }
  const Term& term() const { return m_term; }

  /// The energy at `x`, infinity where an element is outside its domain.
  double energy(const Vector& x) const;

  /// The energy at `x`, and its gradient in `gradient` (undefined if the energy is infinite).
  double energy_and_gradient(const Vector& x, Vector& gradient) const;

  /// The energy at `x`; stores its gradient and the Gauss-Newton matrix J^T J (undefined if the energy is infinite).
  double linearize(const Vector& x);

  /// The gradient of the last linearisation.
  const Vector& gradient() const { return m_gradient; }
  /// The lower triangle of J^T J of the last linearisation; the pattern, with zeros, before the first one.
  const Matrix& gauss_newton_matrix() const { return m_matrix; }

private:
  template <class> friend class Element_least_squares;

  static constexpr int K = Term::max_unknowns;
  static constexpr int R = Term::max_residuals;
  using Pattern = internal::Element_pattern<K>;
  using Unknowns = Eigen::Matrix<double, K, 1>;
  using Residuals = Eigen::Matrix<double, R, 1>;
  using Jacobian = Eigen::Matrix<double, R, K>;
  using Contribution = Element_contribution<K>;
  static constexpr bool in_batches = internal::Batch_size<Term>::value > 0;
  static constexpr std::size_t batch = in_batches ? std::size_t(internal::Batch_size<Term>::value) : 1;

  Unknowns local_unknowns(std::size_t e, const Vector& x) const;
  // Of the elements from `first` on, `count` of them. Outside the domain an energy is infinite.
  void evaluate(std::size_t first, std::size_t count, const Vector& x, Detail detail, Contribution* results) const;
  template <class Add> double accumulate(const Vector& x, Detail detail, const Add& add) const;

  const Term& m_term;
  std::shared_ptr<const Pattern> m_pattern;
  int m_threads;
  mutable std::vector<Contribution, Eigen::aligned_allocator<Contribution>> m_buffer;
  Matrix m_matrix;
  Vector m_gradient;
};

} // namespace Quadrille

#include <Quadrille/Sparse_least_squares/internal/Element_least_squares_impl.h>

#endif
