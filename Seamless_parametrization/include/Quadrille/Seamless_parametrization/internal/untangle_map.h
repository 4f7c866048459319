// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_UNTANGLE_MAP_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_UNTANGLE_MAP_H

#include <Quadrille/Seamless_parametrization/internal/Reduced_elements.h>
#include <Quadrille/Seamless_parametrization/internal/Tangent_geometry.h>
#include <Quadrille/Seamless_parametrization/internal/exact_map.h>
#include <Quadrille/minimize_least_squares.h>
#include <Quadrille/parallel_for.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// The foldover-free energy of Garanzha et al. 2021 together with the Poisson energy, as a function of the free
/// parameters, in the form that `minimize_levenberg_marquardt` minimises.
///
/// J is a triangle's Jacobian relative to its target: the identity where the map has exactly the wanted gradients. A
/// triangle of weight w contributes w / 2 times
///   |J - I|^2 + tau (|J|^2 + 1 + det^2) / chi,   chi = (det + sqrt(eps^2 + det^2)) / 2.
/// Both terms are least at J = I; the second one forbids det <= 0 as eps goes to 0, and tau is small so that triangles
/// far from folding stay where (36) puts them. A constrained edge whose length is rho times the wanted one, negative if
/// it runs backwards, contributes in the same way
///   tau (rho^2 + 1) / chi(rho).
class Untangling_problem {
public:
  /// `targets`: by face, the wanted gradients in combed coordinates; `weights`: by face, those of zero weight are
  /// ignored. `elements`: of `faces`, in their order.
  Untangling_problem(const Tangent_geometry& geometry, const std::vector<Gradient_pair>& targets,
                     const std::vector<Aligned_halfedge>& aligned, const std::vector<double>& weights,
                     const std::vector<int>& faces, Reduced_elements& elements, int threads)
      : m_elements(elements), m_threads(threads)
  {
    const double mean_weight = 1.0 / double(weights.size());
    std::vector<int> place(targets.size(), -1);
    for (const int f : faces) {
      place[std::size_t(f)] = int(m_weights.size());
      m_weights.push_back(weights[std::size_t(f)]);
      m_barriers.push_back(m_weights.back() > 0.0 ? barrier_weight * std::max(m_weights.back(), mean_weight) : 0.0);
      Eigen::Matrix2d target;
      target << targets[std::size_t(f)].first.transpose(), targets[std::size_t(f)].second.transpose();
      const Eigen::Matrix2d inverse = target.inverse();
      for (int i = 0; i < 3; ++i)
        m_gradients.push_back(inverse.transpose() * geometry.hat_gradient(3 * f + i));
    }
    for (const Aligned_halfedge& edge : aligned) {
      const int face = place[std::size_t(edge.halfedge / 3)];
      if (face < 0 || !(m_weights[std::size_t(face)] > 0.0))
        continue;
      const double length = mapped_length(geometry, edge.halfedge, targets[std::size_t(edge.halfedge / 3)]);
      m_edges.push_back({std::size_t(face), 2 * (edge.halfedge % 3) + edge.coordinate,
                         2 * (Indexed_triangulation::next(edge.halfedge) % 3) + edge.coordinate, edge.sign / length});
    }
  }

  void set_epsilon(double epsilon) { m_epsilon = epsilon; }

  /// The smallest determinant of a Jacobian, or relative length of an edge.
  double smallest_determinant(const Eigen::VectorXd& y) const
  {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < m_weights.size(); ++f)
      if (m_weights[f] > 0.0)
        smallest = std::min(smallest, jacobian(f, m_elements.corners(f, y)).determinant());
    for (const Edge& edge : m_edges)
      smallest = std::min(smallest, edge.relative_length(m_elements.corners(edge.face, y)));
    return smallest;
  }

  double energy(const Eigen::VectorXd& y) const
  {
    std::vector<double> energies(m_weights.size());
    parallel_for(m_weights.size(), m_threads, [&](std::size_t f) {
      energies[f] = m_weights[f] > 0.0 ? element_energy(f, m_elements.corners(f, y)) : 0.0;
    });
    double sum = 0.0;
    for (const double energy : energies)
      sum += energy;
    for (const Edge& edge : m_edges)
      sum += 0.5 * evaluate(edge, edge.relative_length(m_elements.corners(edge.face, y))).squaredNorm();
    return sum;
  }

  double linearize(const Eigen::VectorXd& y)
  {
    double sum = 0.0;
    m_elements.set_zero();
    for (std::size_t f = 0; f < m_weights.size(); ++f) {
      if (!(m_weights[f] > 0.0))
        continue;
      Residuals r;
      Residual_jacobian dr;
      evaluate(f, m_elements.corners(f, y), r, &dr);
      sum += 0.5 * r.squaredNorm();
      m_elements.add(f, dr.transpose() * r, dr.transpose() * dr);
    }
    for (const Edge& edge : m_edges)
      sum += linearize(edge, edge.relative_length(m_elements.corners(edge.face, y)));
    return sum;
  }

  const Eigen::VectorXd& gradient() const { return m_elements.gradient(); }
  const Reduced_elements::Matrix& gauss_newton_matrix() const { return m_elements.matrix(); }

  static double chi(double epsilon, double determinant)
  {
    const double root = std::hypot(epsilon, determinant);
    // The second form does not cancel for negative determinants.
    return determinant > 0.0 ? 0.5 * (determinant + root) : 0.5 * epsilon * epsilon / (root - determinant);
  }

private:
  static constexpr double barrier_weight = 0.02; ///< tau

  using Residuals = Eigen::Matrix<double, 10, 1>;
  using Residual_jacobian = Eigen::Matrix<double, 10, 6>;

  struct Edge {
    std::size_t face;
    int source, target;    ///< the coordinate at its ends among those of the face's corners
    double inverse_length; ///< of the wanted one, with a sign

    double relative_length(const Corner_vector& x) const { return inverse_length * (x[target] - x[source]); }
  };

  Eigen::Vector2d evaluate(const Edge& edge, double length) const
  {
    return std::sqrt(m_barriers[edge.face] / chi(m_epsilon, length)) * Eigen::Vector2d(length, 1.0);
  }

  double linearize(const Edge& edge, double length)
  {
    const Eigen::Vector2d r = evaluate(edge, length);
    Eigen::Vector2d slope = (-0.5 / std::hypot(m_epsilon, length)) * r; // as for the determinants
    slope[0] += r[1];
    slope *= edge.inverse_length;
    Eigen::Matrix<double, 2, 6> dr = Eigen::Matrix<double, 2, 6>::Zero();
    dr.col(edge.source) = -slope;
    dr.col(edge.target) = slope;
    m_elements.add(edge.face, dr.transpose() * r, dr.transpose() * dr);
    return 0.5 * r.squaredNorm();
  }

  Eigen::Matrix2d jacobian(std::size_t f, const Corner_vector& x) const
  {
    Eigen::Matrix2d J = Eigen::Matrix2d::Zero();
    for (std::size_t i = 0; i < 3; ++i)
      J += x.segment<2>(Eigen::Index(2 * i)) * m_gradients[3 * f + i].transpose();
    return J;
  }

  double element_energy(std::size_t f, const Corner_vector& x) const
  {
    Residuals r;
    evaluate(f, x, r, nullptr);
    return 0.5 * r.squaredNorm();
  }

  void evaluate(std::size_t f, const Corner_vector& x, Residuals& r, Residual_jacobian* dr) const
  {
    const Eigen::Matrix2d J = jacobian(f, x);
    const double determinant = J.determinant();
    const double value = chi(m_epsilon, determinant);
    const double weight = std::sqrt(m_weights[f]);
    const double barrier = std::sqrt(m_barriers[f] / value);
    r << weight * (J(0, 0) - 1.0), weight * J(0, 1), weight * J(1, 0), weight * (J(1, 1) - 1.0), barrier * J(0, 0),
        barrier * J(0, 1), barrier * J(1, 0), barrier * J(1, 1), barrier, barrier * determinant;
    if (!dr)
      return;
    // d chi / d det = chi / sqrt(eps^2 + det^2), and d (1 / sqrt(chi)) = -1/2 (1 / sqrt(chi)) (d chi / chi).
    const double half_slope = -0.5 / std::hypot(m_epsilon, determinant);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d& g = m_gradients[3 * f + std::size_t(i)];
      for (int c = 0; c < 2; ++c) {
        Eigen::Matrix2d dJ = Eigen::Matrix2d::Zero();
        dJ.row(c) = g.transpose();
        const double d_determinant = dJ(0, 0) * J(1, 1) + J(0, 0) * dJ(1, 1) - dJ(0, 1) * J(1, 0) - J(0, 1) * dJ(1, 0);
        auto column = dr->col(2 * i + c);
        column = (half_slope * d_determinant) * r;
        column.head<4>() << weight * dJ(0, 0), weight * dJ(0, 1), weight * dJ(1, 0), weight * dJ(1, 1);
        column.segment<4>(4) += barrier * column.head<4>() / weight;
        column(9) += barrier * d_determinant;
      }
    }
  }

  Reduced_elements& m_elements;
  std::vector<Eigen::Vector2d> m_gradients; ///< by corner: of its hat function, in the target's coordinates
  std::vector<double> m_weights;
  std::vector<double> m_barriers; ///< weights of the second term
  std::vector<Edge> m_edges;
  int m_threads;
  double m_epsilon = 1.0;
};

/// Where untangling starts from, and how coarsely at first.
struct Untangling_start {
  Eigen::VectorXd y;
  double epsilon;
  int max_iterations; ///< Levenberg-Marquardt steps of a round
};

/// Moves y from one of `starts` after the other until `count_invalid(y)` is 0, and then on to a minimum nearby, or
/// until none is left or `max_rounds` rounds are over. Returns the number of rounds.
///
/// With `stop_misturned` it also ends, with this y, where nothing is folded but something turns too often.
///
/// Each round lowers the energy for one eps by a few Levenberg-Marquardt steps; then eps shrinks by the rule of the
/// paper, which follows the smallest determinant, with a faster least rate, because our rounds are longer. A start is
/// given up when neither the count has fallen nor the smallest determinant come nearer to 0 for a while.
template <class Solver, class Count_invalid>
int untangle(Untangling_problem& problem, Eigen::VectorXd& y, const std::vector<Untangling_start>& starts,
             int max_rounds, bool stop_misturned, Solver& solver, const Count_invalid& count_invalid)
{
  constexpr double last_epsilon = 1e-10;
  constexpr int patience = 12;
  constexpr double least_rate = 0.3;
  constexpr double progress = 0.95; // of the smallest determinant
  Levenberg_marquardt_options options;
  options.relative_decrease = 1e-2;
  int round = 0;
  for (const Untangling_start& start : starts) {
    y = start.y;
    double epsilon = start.epsilon;
    options.max_iterations = start.max_iterations;
    int least = std::numeric_limits<int>::max();
    double largest = -std::numeric_limits<double>::infinity(); // of the negative smallest determinants
    for (int last_success = round; round < max_rounds && round < last_success + patience;) {
      ++round;
      problem.set_epsilon(epsilon);
      const Minimization_report report = minimize_levenberg_marquardt(problem, y, options, &solver);
      const int n_invalid = count_invalid(y);
      if (n_invalid == 0) {
        problem.set_epsilon(last_epsilon);
        minimize_levenberg_marquardt(problem, y, options, &solver);
        count_invalid(y);
        return round;
      }
      const double smallest = problem.smallest_determinant(y);
      if (smallest > 0.0 && stop_misturned)
        return round;
      if (n_invalid < least || (smallest < 0.0 && smallest > progress * largest)) {
        least = std::min(least, n_invalid);
        largest = std::max(largest, smallest);
        last_success = round;
      } else if (smallest > 0.0) { // nothing is folded, but something turns too often: no way from here
        break;
      }
      const double gain = report.initial_energy > 0.0 ? 1.0 - report.energy / report.initial_energy : 0.0;
      const double level = (1.0 - std::max(least_rate, gain)) * Untangling_problem::chi(epsilon, smallest);
      epsilon = smallest < level ? 2.0 * std::sqrt(level * (level - smallest)) : last_epsilon;
    }
  }
  return round;
}

} // namespace internal
} // namespace Quadrille

#endif
