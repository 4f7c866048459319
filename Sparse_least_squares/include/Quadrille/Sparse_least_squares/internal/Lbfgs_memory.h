// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_LBFGS_MEMORY_H
#define QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_LBFGS_MEMORY_H

#include <Eigen/Core>

#include <cstddef>
#include <deque>
#include <vector>

namespace Quadrille {
namespace internal {

/// The two-loop recursion of L-BFGS around a given inverse of the initial Hessian.
class Lbfgs_memory {
public:
  explicit Lbfgs_memory(int capacity) : m_capacity(std::size_t(capacity)) {}

  void clear() { m_pairs.clear(); }

  /// Ignores pairs without positive curvature: they would make the direction an ascent.
  void add(const Eigen::VectorXd& s, const Eigen::VectorXd& y)
  {
    const double curvature = s.dot(y);
    if (!(curvature > 1e-10 * s.norm() * y.norm()))
      return;
    if (m_pairs.size() == m_capacity)
      m_pairs.pop_front();
    m_pairs.push_back({s, y, 1 / curvature});
  }

  template <class Solver>
  void apply(const Solver& solver, const Eigen::VectorXd& gradient, Eigen::VectorXd& direction) const
  {
    Eigen::VectorXd g = gradient;
    std::vector<double> alpha(m_pairs.size());
    for (std::size_t i = m_pairs.size(); i-- > 0;) {
      alpha[i] = m_pairs[i].rho * m_pairs[i].s.dot(g);
      g -= alpha[i] * m_pairs[i].y;
    }
    solver.solve(g, direction);
    for (std::size_t i = 0; i < m_pairs.size(); ++i) {
      const double beta = m_pairs[i].rho * m_pairs[i].y.dot(direction);
      direction += (alpha[i] - beta) * m_pairs[i].s;
    }
  }

private:
  struct Pair {
    Eigen::VectorXd s, y;
    double rho;
  };
  std::size_t m_capacity;
  std::deque<Pair> m_pairs;
};

} // namespace internal
} // namespace Quadrille

#endif
