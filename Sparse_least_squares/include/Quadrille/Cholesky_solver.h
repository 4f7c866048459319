// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_CHOLESKY_SOLVER_H
#define QUADRILLE_CHOLESKY_SOLVER_H

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#ifdef QUADRILLE_WITH_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

#include <Quadrille/Sparse_least_squares/internal/Serial_linear_algebra.h>

namespace Quadrille {

/// Direct solver for sparse symmetric positive definite systems; a model of the concept `SparseCholeskySolver`.
///
/// Supernodal CHOLMOD where the build has it, Eigen's simplicial factorisation otherwise (several times slower, but
/// without SuiteSparse's licence). The fill-reducing ordering is computed once per pattern by `analyze`.
/// Objects share nothing: different threads may use different objects at the same time. A factorisation runs on the
/// calling thread alone, so results do not depend on the number of cores. The BLAS must allow calls from several
/// threads; OpenBLAS's serial build, where it is made without locks, does not.
class Cholesky_solver {
public:
  using Matrix = Eigen::SparseMatrix<double>;

  Cholesky_solver() { silence(); }

  /// Orders and analyses the pattern of a symmetric matrix given by its lower triangle.
  void analyze(const Matrix& lower) { m_solver.analyzePattern(lower); }

  /// Numerical factorisation of a matrix with the analysed pattern. Returns `false` if it is not positive definite.
  /// Complexity for a planar mesh of n vertices: O(n^1.5), with fill O(n log n).
  bool factorize(const Matrix& lower)
  {
    const internal::Serial_linear_algebra serial;
    m_solver.factorize(lower);
    return m_solver.info() == Eigen::Success;
  }

  /// Solves A x = b. \pre the last `factorize` returned `true`.
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const
  {
    const internal::Serial_linear_algebra serial;
    x = m_solver.solve(b);
  }

private:
#ifdef QUADRILLE_WITH_CHOLMOD
  // CHOLMOD would write a warning to standard output for every indefinite matrix, which here is a normal answer.
  void silence() { m_solver.cholmod().print = 0; }
  Eigen::CholmodSupernodalLLT<Matrix, Eigen::Lower> m_solver;
#else
  void silence() {}
  Eigen::SimplicialLLT<Matrix, Eigen::Lower> m_solver;
#endif
};

} // namespace Quadrille

#endif
