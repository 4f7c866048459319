// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_UNTANGLE_MAP_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_UNTANGLE_MAP_H

#include <Quadrille/Seamless_parametrization/internal/Reduced_elements.h>
#include <Quadrille/Seamless_parametrization/internal/Tangent_geometry.h>
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
/// far from folding stay where (36) puts them.
class Untangling_problem {
public:
  /// `targets`: by face, the wanted gradients in combed coordinates. Faces of zero `weight` are ignored.
  Untangling_problem(const Tangent_geometry& geometry, const std::vector<Gradient_pair>& targets,
                     std::vector<double> weights, Reduced_elements& elements, int threads)
      : m_elements(elements), m_weights(std::move(weights)), m_threads(threads)
  {
    for (std::size_t f = 0; f < targets.size(); ++f) {
      Eigen::Matrix2d target;
      target << targets[f].first.transpose(), targets[f].second.transpose();
      const Eigen::Matrix2d inverse = target.inverse();
      for (int i = 0; i < 3; ++i)
        m_gradients.push_back(inverse.transpose() * geometry.hat_gradient(3 * int(f) + i));
    }
  }

  void set_epsilon(double epsilon) { m_epsilon = epsilon; }

  /// The smallest determinant of a Jacobian.
  double smallest_determinant(const Eigen::VectorXd& y) const
  {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < m_weights.size(); ++f)
      if (m_weights[f] > 0.0)
        smallest = std::min(smallest, jacobian(f, m_elements.corners(f, y)).determinant());
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
    const double barrier = weight * std::sqrt(barrier_weight / value);
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
  int m_threads;
  double m_epsilon = 1.0;
};

/// Moves y until `is_valid(y)` and then on to a minimum nearby, or until `max_rounds` rounds are over. Returns the
/// number of rounds.
///
/// Each round lowers the energy for one eps by a few Levenberg-Marquardt steps; then eps shrinks by the rule of the
/// paper, which follows the smallest determinant. Half of the rounds start from a small eps, which unfolds what
/// ordinary fields fold, and nearly always suffices; the others start over from a large one.
template <class Solver, class Is_valid>
int untangle(Untangling_problem& problem, Eigen::VectorXd& y, int max_rounds, Solver& solver, const Is_valid& is_valid)
{
  constexpr double small_epsilon = 0.1;
  constexpr double large_epsilon = 1.0;
  constexpr double last_epsilon = 1e-10;
  Levenberg_marquardt_options options;
  options.max_iterations = 4;
  options.relative_decrease = 1e-2;
  const Eigen::VectorXd start = y;
  double epsilon = small_epsilon;
  for (int round = 1; round <= max_rounds; ++round) {
    if (round == max_rounds / 2 + 1) {
      y = start;
      epsilon = large_epsilon;
      options.max_iterations *= 2;
    }
    problem.set_epsilon(epsilon);
    const Minimization_report report = minimize_levenberg_marquardt(problem, y, options, &solver);
    if (is_valid(y)) {
      problem.set_epsilon(last_epsilon);
      minimize_levenberg_marquardt(problem, y, options, &solver);
      is_valid(y);
      return round;
    }
    const double smallest = problem.smallest_determinant(y);
    const double gain = report.initial_energy > 0.0 ? 1.0 - report.energy / report.initial_energy : 0.0;
    const double level = (1.0 - std::max(0.1, gain)) * Untangling_problem::chi(epsilon, smallest);
    epsilon = smallest < level ? 2.0 * std::sqrt(level * (level - smallest)) : last_epsilon;
  }
  return max_rounds;
}

} // namespace internal
} // namespace Quadrille

#endif
