// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_DAMPED_MATRIX_H
#define QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_DAMPED_MATRIX_H

#include <Eigen/SparseCore>

#include <algorithm>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// The Gauss-Newton matrix plus `damping` times its diagonal. Unknowns without any residual keep a unit diagonal.
class Damped_matrix {
public:
  using Matrix = Eigen::SparseMatrix<double>;

  /// `groups`: numbers of consecutive unknowns that are damped alike; empty: each by itself.
  explicit Damped_matrix(std::vector<int> groups = {}) : m_groups(std::move(groups)) {}

  void assign(const Matrix& lower)
  {
    if (m_matrix.nonZeros() != lower.nonZeros())
      m_matrix = lower;
    else
      std::copy(lower.valuePtr(), lower.valuePtr() + lower.nonZeros(), m_matrix.valuePtr());
    m_diagonal.resize(lower.cols());
    for (Eigen::Index c = 0; c < lower.cols(); ++c)
      m_diagonal[c] = lower.valuePtr()[lower.outerIndexPtr()[c]];
    const double floor = 1e-12 * std::max(m_diagonal.maxCoeff(), 0.0);
    m_scale = m_diagonal.cwiseMax(floor > 0 ? floor : 1.0);
    Eigen::Index first = 0;
    for (const int size : m_groups) {
      m_scale.segment(first, size).setConstant(m_scale.segment(first, size).mean());
      first += size;
    }
  }

  const Matrix& damped(double damping)
  {
    for (Eigen::Index c = 0; c < m_matrix.cols(); ++c)
      m_matrix.valuePtr()[m_matrix.outerIndexPtr()[c]] = m_diagonal[c] + damping * m_scale[c];
    return m_matrix;
  }

  const Eigen::VectorXd& scale() const { return m_scale; }

private:
  std::vector<int> m_groups;
  Matrix m_matrix;
  Eigen::VectorXd m_diagonal, m_scale;
};

} // namespace internal
} // namespace Quadrille

#endif
