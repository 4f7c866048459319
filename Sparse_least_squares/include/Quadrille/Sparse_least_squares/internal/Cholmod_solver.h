// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_CHOLMOD_SOLVER_H
#define QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_CHOLMOD_SOLVER_H

#include <Quadrille/Sparse_least_squares/internal/Cholmod_analysis.h>
#include <Quadrille/Sparse_least_squares/internal/Serial_linear_algebra.h>

namespace Quadrille {
namespace internal {

/// `Cholesky_solver` by CHOLMOD's supernodal factorisation. Memory is allocated by the first factorisation and the
/// first solve, and reused by the others. Copies share the analysis and start without a factor.
class Cholmod_solver {
public:
  using Matrix = Eigen::SparseMatrix<double>;

  Cholmod_solver() = default;
  Cholmod_solver(const Cholmod_solver& other) : m_analysis(other.m_analysis) {}
  Cholmod_solver& operator=(const Cholmod_solver&) = delete;

  void analyze(const Matrix& lower)
  {
    const Serial_linear_algebra serial;
    m_analysis = std::make_shared<const Cholmod_analysis>(lower);
    m_factor.reset();
    m_solution.reset();
    m_workspace.reset();
  }

  bool factorize(const Matrix& lower)
  {
    const Serial_linear_algebra serial;
    if (!m_factor) {
      cholmod_factor symbolic = m_analysis->symbolic_factor();
      m_factor.reset(cholmod_copy_factor(&symbolic, &m_common));
      check_memory(m_factor != nullptr);
    }
    m_analysis->permute_values(lower.valuePtr(), m_values);
    cholmod_sparse permuted = m_analysis->permuted_matrix(m_values.data());
    m_common.status = CHOLMOD_OK;
    const bool done = cholmod_factorize(&permuted, m_factor.get(), &m_common) != 0;
    check_memory(done);
    return m_common.status == CHOLMOD_OK && m_factor->minor == m_factor->n;
  }

  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const
  {
    const Serial_linear_algebra serial;
    const std::vector<int>& order = m_analysis->order();
    m_load.resize(b.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      m_load[Eigen::Index(i)] = b[order[i]];
    cholmod_dense load{};
    load.nrow = load.nzmax = load.d = order.size();
    load.ncol = 1;
    load.x = m_load.data();
    load.xtype = CHOLMOD_REAL;
    load.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* solution = m_solution.release();
    cholmod_dense* workspace = m_workspace.release();
    cholmod_dense* permuted = m_permuted.release();
    const bool done = cholmod_solve2(CHOLMOD_A, m_factor.get(), &load, nullptr, &solution, nullptr, &permuted,
                                     &workspace, &m_common) != 0;
    m_solution.reset(solution);
    m_workspace.reset(workspace);
    m_permuted.reset(permuted);
    check_memory(done);
    x.resize(b.size());
    const double* values = static_cast<const double*>(solution->x);
    for (std::size_t i = 0; i < order.size(); ++i)
      x[order[i]] = values[i];
  }

private:
  void check_memory(bool done) const
  {
    if (!done)
      throw Error("too little memory for a sparse Cholesky factorisation with " +
                  std::to_string(m_analysis->order().size()) + " unknowns");
  }

  using Dense = std::unique_ptr<cholmod_dense, Free_cholmod_object>;
  std::shared_ptr<const Cholmod_analysis> m_analysis;
  mutable Cholmod_common m_common;
  Cholmod_factor m_factor;
  std::vector<double> m_values;                      ///< of the permuted matrix
  mutable Eigen::VectorXd m_load;                    ///< scratch of solve
  mutable Dense m_solution, m_workspace, m_permuted; ///< scratch of solve
};

} // namespace internal
} // namespace Quadrille

#endif
