// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_SIMPLICIAL_SOLVER_H
#define QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_SIMPLICIAL_SOLVER_H

#include <Eigen/SparseCholesky>

namespace Quadrille {
namespace internal {

/// `Cholesky_solver` by Eigen alone. Copies analyse again when they first factorise: Eigen's objects cannot be copied.
class Simplicial_solver {
public:
  using Matrix = Eigen::SparseMatrix<double>;

  Simplicial_solver() = default;
  Simplicial_solver(const Simplicial_solver&) {}
  Simplicial_solver& operator=(const Simplicial_solver&) = delete;

  void analyze(const Matrix& lower)
  {
    m_solver.analyzePattern(lower);
    m_is_analyzed = true;
  }

  bool factorize(const Matrix& lower)
  {
    if (!m_is_analyzed)
      analyze(lower);
    m_solver.factorize(lower);
    return m_solver.info() == Eigen::Success;
  }

  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const { x = m_solver.solve(b); }

private:
  Eigen::SimplicialLLT<Matrix, Eigen::Lower> m_solver;
  bool m_is_analyzed = false;
};

} // namespace internal
} // namespace Quadrille

#endif
