// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_METRIC_CONNECTION_H
#define QUADRILLE_METRIC_CONNECTION_H

#include <Quadrille/Metric_field.h>
#include <Quadrille/Volumetric_cross_field/internal/Tetrahedron_adjacency.h>
#include <Quadrille/Volumetric_cross_field/internal/connection_form.h>
#include <Quadrille/parallel_for.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace Quadrille {

/// The connection form of the coframe A: the matrix W for which a frame that is carried along a velocity x' in parallel
/// turns by R' = -[W x']x R. Row i of `C` is the curl of row i of `A`. From Cartan's first structure equation in closed
/// form: W = (A C^T - 1/2 tr(A C^T) I) A / det A; metric, the 9 x 9 system of Section 1. \pre `A` is regular.
inline Eigen::Matrix3d connection_form(const Eigen::Matrix3d& A, const Eigen::Matrix3d& C)
{
  const Eigen::Matrix3d product = A * C.transpose();
  return (product - 0.5 * product.trace() * Eigen::Matrix3d::Identity()) * A / A.determinant();
}

/// Roots of a metric that are linear within a tetrahedron, as in Section 1.1 of metric.
class Linear_root {
public:
  /// `points` and `roots` at the four corners. \pre the tetrahedron is not degenerate.
  Linear_root(const Eigen::Matrix<double, 3, 4>& points, const std::array<Eigen::Matrix3d, 4>& roots);

  /// The curls of the rows of A, the same everywhere in the tetrahedron.
  const Eigen::Matrix3d& curl() const { return m_curl; }
  const Eigen::Matrix3d& root(std::size_t corner) const { return m_roots[corner]; }

  /// Carries frames from corner `a` to corner `b` along the edge: R(b) = transport R(a) for parallel frames.
  ///
  /// By the trapezoidal rule, on halves of halves of the edge until the two halves of a piece give the same as the
  /// piece but for `tolerance` (Frobenius norm) times its share of the edge: the error of the whole is then about
  /// `tolerance`. Section 1.2 of metric, with lengths in units of the edge. `samples`, if given, counts evaluations.
  Eigen::Matrix3d transport(std::size_t a, std::size_t b, double tolerance, int* samples = nullptr) const;

private:
  Eigen::Matrix<double, 3, 4> m_points;
  std::array<Eigen::Matrix3d, 4> m_roots;
  Eigen::Matrix3d m_curl;
};

/// The parallel transport along the edges of a mesh under a metric.
///
/// The root is continuous but its curl jumps between tetrahedra, so an edge's rotation vector is the mean over those at
/// the edge, weighted by volume. Time is linear in the size.
class Metric_connection {
public:
  /// The identity everywhere, as without a metric.
  Metric_connection() = default;

  /// \pre `metric` has a matrix per vertex of `mesh`, which passes `check_tetrahedral_mesh()`.
  template <class TetrahedralMesh>
  Metric_connection(const TetrahedralMesh& mesh, const Metric_field& metric, double tolerance = 1e-4, int threads = 0);

  bool is_identity() const { return m_first.empty(); }

  /// Carries frames from vertex u to vertex v. \pre an edge joins them.
  Eigen::Matrix3d operator()(int u, int v) const
  {
    if (is_identity())
      return Eigen::Matrix3d::Identity();
    const int low = std::min(u, v), high = std::max(u, v);
    const auto begin = m_high.begin() + std::ptrdiff_t(m_first[std::size_t(low)]);
    const auto end = m_high.begin() + std::ptrdiff_t(m_first[std::size_t(low) + 1]);
    const Eigen::Vector3d w = m_turn[std::size_t(std::lower_bound(begin, end, high) - m_high.begin())];
    return internal::rotation_of(u < v ? w : Eigen::Vector3d(-w));
  }

private:
  std::vector<std::size_t> m_first; ///< per vertex, its edges to vertices with larger numbers, which are sorted
  std::vector<int> m_high;
  std::vector<Eigen::Vector3d> m_turn; ///< rotation vector from the lower to the higher
};

} // namespace Quadrille

#include <Quadrille/Volumetric_cross_field/internal/Metric_connection_impl.h>

#endif
