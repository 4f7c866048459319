// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_RESTRICTED_UNKNOWNS_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_RESTRICTED_UNKNOWNS_H

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// A node's coefficients as an affine function of its unknowns, q = offset + basis.leftCols(dimension) s: how Dirichlet
/// and alignment conditions are eliminated.
template <int N> struct Vertex_restriction {
  Eigen::Matrix<double, N, 1> offset = Eigen::Matrix<double, N, 1>::Zero();
  Eigen::Matrix<double, N, N> basis = Eigen::Matrix<double, N, N>::Identity();
  int dimension = N;
  bool is_free = true; ///< offset zero and basis the identity
};

/// The unknowns of a field whose nodes (in the plane the vertices) have N coefficients each, but maybe fewer unknowns;
/// nodes may share some of them.
template <int N> class Restricted_unknowns {
public:
  using Coefficients = Eigen::Matrix<double, N, 1>;
  static constexpr int max_unknowns = 3 * N;
  using Unknowns = Eigen::Matrix<double, max_unknowns, 1>; ///< of a triangle's corners, one after the other
  using Index = std::array<int, std::size_t(N)>;
  using Corners = std::array<int, 3>; ///< nodes

  /// Every node has its own unknowns.
  explicit Restricted_unknowns(std::vector<Vertex_restriction<N>> restrictions)
      : m_restrictions(std::move(restrictions)), m_index(m_restrictions.size())
  {
    for (std::size_t v = 0; v < m_restrictions.size(); ++v)
      for (int i = 0; i < m_restrictions[v].dimension; ++i)
        m_index[v][std::size_t(i)] = m_count++;
  }
  /// `index[v][i]`: which unknown s_i of node v is.
  Restricted_unknowns(std::vector<Vertex_restriction<N>> restrictions, std::vector<Index> index, int count)
      : m_restrictions(std::move(restrictions)), m_index(std::move(index)), m_count(count)
  {
  }

  std::size_t number_of_nodes() const { return m_restrictions.size(); }
  std::size_t number_of_unknowns() const { return std::size_t(m_count); }
  const Vertex_restriction<N>& restriction(std::size_t v) const { return m_restrictions[v]; }
  const Index& index(std::size_t v) const { return m_index[v]; }

  /// None of the three nodes is restricted.
  bool are_free(const Corners& nodes) const
  {
    return std::all_of(nodes.begin(), nodes.end(), [&](int v) { return m_restrictions[std::size_t(v)].is_free; });
  }

  /// \pre nodes of one triangle share no unknowns
  int element_unknowns(const Corners& nodes, std::array<int, std::size_t(max_unknowns)>& index) const
  {
    int count = 0;
    for (const int v : nodes)
      for (int i = 0; i < m_restrictions[std::size_t(v)].dimension; ++i)
        index[std::size_t(count++)] = m_index[std::size_t(v)][std::size_t(i)];
    return count;
  }

  /// Of the three corners, from their unknowns.
  Unknowns corner_coefficients(const Corners& nodes, const Unknowns& x) const
  {
    Unknowns q;
    int place = 0;
    for (int k = 0; k < 3; ++k) {
      const Vertex_restriction<N>& r = m_restrictions[std::size_t(nodes[std::size_t(k)])];
      q.template segment<N>(k * N) = r.offset + r.basis.leftCols(r.dimension) * x.segment(place, r.dimension);
      place += r.dimension;
    }
    return q;
  }

  /// Derivatives by the unknowns from those by the coefficients of the corners (columns k N ... k N + N - 1).
  template <class Matrix>
  void restrict_columns(const Corners& nodes, const Matrix& by_coefficients, Matrix& by_unknowns) const
  {
    int place = 0;
    for (int k = 0; k < 3; ++k) {
      const Vertex_restriction<N>& r = m_restrictions[std::size_t(nodes[std::size_t(k)])];
      if (r.is_free)
        by_unknowns.template middleCols<N>(place) = by_coefficients.template middleCols<N>(k * N);
      else if (r.dimension > 0)
        by_unknowns.middleCols(place, r.dimension).noalias() =
            by_coefficients.template middleCols<N>(k * N) * r.basis.leftCols(r.dimension);
      place += r.dimension;
    }
    by_unknowns.rightCols(max_unknowns - place).setZero();
  }

  Coefficients coefficients(std::size_t v, const Eigen::VectorXd& x) const
  {
    const Vertex_restriction<N>& r = m_restrictions[v];
    Coefficients q = r.offset;
    for (int i = 0; i < r.dimension; ++i)
      q += r.basis.col(i) * x[m_index[v][std::size_t(i)]];
    return q;
  }

  /// The unknowns whose coefficients are nearest to the given ones; of shared unknowns the last assignment counts.
  void assign_coefficients(std::size_t v, const Coefficients& q, Eigen::VectorXd& x) const
  {
    const Vertex_restriction<N>& r = m_restrictions[v];
    if (r.dimension == 0)
      return;
    const auto basis = r.basis.leftCols(r.dimension);
    const Eigen::VectorXd s = (basis.transpose() * basis).ldlt().solve(basis.transpose() * (q - r.offset));
    for (int i = 0; i < r.dimension; ++i)
      x[m_index[v][std::size_t(i)]] = s[i];
  }

private:
  std::vector<Vertex_restriction<N>> m_restrictions;
  std::vector<Index> m_index;
  int m_count = 0;
};

} // namespace internal
} // namespace Quadrille

#endif
