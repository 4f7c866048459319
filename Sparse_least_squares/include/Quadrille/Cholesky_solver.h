// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_CHOLESKY_SOLVER_H
#define QUADRILLE_CHOLESKY_SOLVER_H

#include <Quadrille/exceptions.h>

#include <Eigen/SparseCore>

#ifdef QUADRILLE_WITH_CHOLMOD
#include <Quadrille/Sparse_least_squares/internal/Cholmod_solver.h>
#else
#include <Quadrille/Sparse_least_squares/internal/Simplicial_solver.h>
#endif

namespace Quadrille {

/// Direct solver for sparse symmetric positive definite systems; a model of the concept `SparseCholeskySolver`.
///
/// Supernodal CHOLMOD where the build has it, Eigen's simplicial factorisation otherwise (several times slower, but
/// without SuiteSparse's licence). The fill-reducing ordering is computed once per pattern by `analyze`, and shared by
/// copies of an analysed solver: several threads that solve systems of one pattern each take a copy.
/// Different threads may use different objects at the same time. A factorisation runs on the calling thread alone, so
/// results do not depend on the number of cores. The BLAS must allow calls from several threads; OpenBLAS's serial
/// build, where it is made without locks, does not.
class Cholesky_solver {
public:
  using Matrix = Eigen::SparseMatrix<double>;

  /// Orders and analyses the pattern of a symmetric matrix given by its lower triangle, with the diagonal in it. Groups
  /// of consecutive unknowns with the same neighbours, as those of one mesh vertex, are ordered as one.
  /// Complexity for a planar mesh of n vertices: O(n log n).
  void analyze(const Matrix& lower) { m_solver.analyze(lower); }

  /// Numerical factorisation of a matrix with the analysed pattern. Returns `false` if it is not positive definite.
  /// Complexity for a planar mesh of n vertices: O(n^1.5), with fill O(n log n).
  /// \throws Error if there is too little memory.
  bool factorize(const Matrix& lower) { return m_solver.factorize(lower); }

  /// Solves A x = b. \pre the last `factorize` returned `true`.
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const { m_solver.solve(b, x); }

private:
#ifdef QUADRILLE_WITH_CHOLMOD
  internal::Cholmod_solver m_solver;
#else
  internal::Simplicial_solver m_solver;
#endif
};

} // namespace Quadrille

#endif
