// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_CURVE_CONFLICT_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_CURVE_CONFLICT_H

#include <Quadrille/Seamless_parametrization/internal/Seamless_constraints.h>
#include <Quadrille/Seamless_parametrization/internal/Tangent_geometry.h>
#include <Quadrille/Seamless_parametrization/internal/exact_map.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>
#include <Quadrille/minimize_least_squares.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cmath>
#include <cstddef>
#include <vector>

namespace Quadrille {
namespace internal {

/// Half the sum of max(0, 1 - rho)^2 over all constrained edges, with the length rho of an edge in (u, v) relative to
/// the wanted one, negative if it runs backwards; a function of the free parameters for `minimize_levenberg_marquardt`.
///
/// The constraints are homogeneous: lengths that are all positive exist if and only if lengths of at least 1 do, and
/// the minimum is 0. Otherwise the residuals r = max(0, 1 - rho) at the minimum prove that there are none, since r >= 0
/// and A^T r = 0 for rho = A y (Farkas); the largest of them is at least 1.
class Curve_length_problem {
public:
  Curve_length_problem(const Tangent_geometry& geometry, const std::vector<Gradient_pair>& gradients,
                       const std::vector<Aligned_halfedge>& edges, const Seamless_space& space)
  {
    std::vector<int> column(std::size_t(space.number_of_parameters), -1);
    std::vector<Eigen::Triplet<double>> entries;
    int n_columns = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const int h = edges[i].halfedge;
      const double length = mapped_length(geometry, h, gradients[std::size_t(h / 3)]);
      for (const bool at_target : {false, true}) {
        const int corner = at_target ? Indexed_triangulation::next(h) : h;
        const int row = 2 * space.copy_of_corner[std::size_t(corner)] + edges[i].coordinate;
        const double scale = (at_target ? 1 : -1) * edges[i].sign / (length * double(space.denominator));
        for (const Seamless_space::Entry* e = space.begin(row); e != space.end(row); ++e) {
          int& place = column[std::size_t(e->parameter)];
          if (place < 0)
            place = n_columns++;
          entries.emplace_back(int(i), place, scale * double(e->coefficient));
        }
      }
    }
    m_lengths.resize(Eigen::Index(edges.size()), n_columns);
    m_lengths.setFromTriplets(entries.begin(), entries.end());
  }

  Eigen::Index number_of_parameters() const { return m_lengths.cols(); }

  Eigen::VectorXd residuals(const Eigen::VectorXd& y) const
  {
    return Eigen::VectorXd::Ones(m_lengths.rows()) - m_lengths * y;
  }

  double energy(const Eigen::VectorXd& y) const
  {
    const Eigen::VectorXd r = residuals(y);
    return 0.5 * weights(r).dot(r.cwiseAbs2());
  }

  double linearize(const Eigen::VectorXd& y)
  {
    const Eigen::VectorXd r = residuals(y), w = weights(r);
    m_gradient = -(m_lengths.transpose() * w.cwiseProduct(r));
    const Eigen::SparseMatrix<double> weighted = w.asDiagonal() * m_lengths;
    m_matrix = Eigen::SparseMatrix<double>(m_lengths.transpose() * weighted).triangularView<Eigen::Lower>();
    return 0.5 * w.dot(r.cwiseAbs2());
  }

  const Eigen::VectorXd& gradient() const { return m_gradient; }
  const Eigen::SparseMatrix<double>& gauss_newton_matrix() const { return m_matrix; }

private:
  /// Edges that are long enough hardly count: just so much that there is one minimum.
  static Eigen::VectorXd weights(const Eigen::VectorXd& residuals)
  {
    constexpr double satisfied = 1e-8;
    return (residuals.array() > 0.0).select(Eigen::VectorXd::Ones(residuals.size()), satisfied);
  }

  Eigen::SparseMatrix<double> m_lengths;
  Eigen::SparseMatrix<double> m_matrix;
  Eigen::VectorXd m_gradient;
};

/// Constrained edges that cannot all have positive lengths.
struct Curve_conflict {
  double extent = 0.0;        ///< how many there are, weighted by how much they contribute
  std::vector<int> halfedges; ///< none: there is no conflict
};

/// Finds one if there is any. Such conflicts come from the topology alone: opposite sides of patches are equally long,
/// so that the sum of others may leave nothing for a short curve.
/// Complexity: that of sparse Cholesky factorisations for the constrained edges alone.
template <class Solver>
Curve_conflict find_curve_conflict(const Tangent_geometry& geometry, const std::vector<Gradient_pair>& gradients,
                                   const std::vector<Aligned_halfedge>& edges, const Seamless_space& space)
{
  Curve_conflict conflict;
  Curve_length_problem problem(geometry, gradients, edges, space);
  if (problem.number_of_parameters() == 0)
    return conflict;
  Levenberg_marquardt_options options;
  options.max_iterations = 60;
  options.initial_damping = 1e-9;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(problem.number_of_parameters());
  problem.linearize(y); // makes the pattern of the matrix
  minimize_levenberg_marquardt<Curve_length_problem, Solver>(problem, y, options);
  constexpr double significant = 0.1; // at least one residual is 1 if there is a conflict
  const Eigen::VectorXd residuals = problem.residuals(y);
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (const double r = residuals[Eigen::Index(i)]; r > significant) {
      conflict.extent += r * r;
      conflict.halfedges.push_back(edges[i].halfedge);
    }
  return conflict;
}

} // namespace internal
} // namespace Quadrille

#endif
