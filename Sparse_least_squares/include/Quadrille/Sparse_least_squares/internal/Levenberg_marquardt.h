// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_LEVENBERG_MARQUARDT_H
#define QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_LEVENBERG_MARQUARDT_H

#include <Quadrille/Sparse_least_squares/internal/Damped_matrix.h>
#include <Quadrille/Sparse_least_squares/internal/Lbfgs_memory.h>
#include <Quadrille/Sparse_least_squares/internal/Stopwatch.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>
#include <utility>

namespace Quadrille {
namespace internal {

template <class Problem, class = void> struct Has_energy_and_gradient : std::false_type {
};
template <class Problem>
struct Has_energy_and_gradient<Problem, std::void_t<decltype(std::declval<const Problem&>().energy_and_gradient(
                                            std::declval<const Eigen::VectorXd&>(), std::declval<Eigen::VectorXd&>()))>>
    : std::true_type {
};

/// One run of `minimize_levenberg_marquardt`.
template <class Problem, class Solver> class Levenberg_marquardt {
public:
  Levenberg_marquardt(Problem& problem, Eigen::VectorXd& x, const Levenberg_marquardt_options& options, Solver& solver)
      : m_problem(problem), m_x(x), m_options(options), m_solver(solver), m_damping(options.initial_damping),
        m_matrix(options.groups), m_memory(std::max(options.max_reuses, 1))
  {
  }

  Minimization_report run()
  {
    linearize();
    m_report.initial_energy = m_energy;
    if (!std::isfinite(m_energy)) {
      m_report.energy = m_energy;
      m_report.status = Minimization_status::outside_domain;
      return m_report;
    }
    record();
    Outcome outcome = Outcome::go_on;
    while (outcome == Outcome::go_on && m_report.iterations < m_options.max_iterations) {
      if (m_options.observer)
        m_options.observer->report(m_options.stage, double(m_report.iterations) / m_options.max_iterations);
      outcome = is_negligible() ? Outcome::converged : full_step();
    }
    if (outcome != Outcome::go_on)
      m_report.status =
          outcome == Outcome::converged ? Minimization_status::converged : Minimization_status::no_progress;
    m_report.energy = m_energy;
    m_report.gradient_norm = m_gradient.norm();
    m_report.seconds = m_stopwatch.seconds();
    return m_report;
  }

private:
  enum class Outcome { go_on, converged, no_progress };

  // Below the first the model is too far off to use its factor again; Nielsen's rule takes a step from the second on as
  // one that shows convergence by a small decrease.
  static constexpr double trusted_gain = 0.5;
  static constexpr double meaningful_gain = 0.25;
  static constexpr bool can_reuse = Has_energy_and_gradient<Problem>::value;

  bool is_negligible() const { return m_energy <= m_options.negligible_energy; }

  void linearize()
  {
    m_energy = m_problem.linearize(m_x);
    ++m_report.evaluations;
    m_gradient = m_problem.gradient();
    if (std::isfinite(m_energy))
      m_matrix.assign(m_problem.gauss_newton_matrix());
    m_is_linearized = true;
  }

  /// A step of the damped model where the energy stands, and cheap steps after it. A rejected step only raises the
  /// damping.
  Outcome full_step()
  {
    if (!(m_damping < 1e12))
      return Outcome::no_progress;
    if (!m_is_linearized)
      linearize();
    ++m_report.factorizations;
    double predicted = 0;
    if (m_solver.factorize(m_matrix.damped(m_damping))) {
      m_solver.solve(m_gradient, m_step);
      // The model's decrease of a damped step: 1/2 step . (damping D step + gradient).
      predicted = 0.5 * (m_damping * m_step.cwiseAbs2().dot(m_matrix.scale()) + m_step.dot(m_gradient));
      m_memory.clear();
      const double decrease = try_step();
      const double gain = predicted > 0 ? decrease / predicted : -1;
      if (gain > 0) {
        ++m_report.iterations;
        accept_step();
        m_damping *= std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3));
        m_growth = 2;
        if (decrease < m_options.relative_decrease * m_energy && gain > meaningful_gain)
          return Outcome::converged;
        if constexpr (can_reuse)
          if (gain > trusted_gain && m_report.iterations > m_last_failure + m_pause)
            return reuse_factor();
        return Outcome::go_on;
      }
    }
    if (predicted > 0 && predicted <= 1e-15 * m_energy)
      return Outcome::converged;
    m_damping *= m_growth;
    m_growth *= 2;
    return Outcome::go_on;
  }

  /// L-BFGS steps around the last factor, while the energy falls as they predict. When already the first one fails,
  /// the next full steps, twice as many as the last time, go without them.
  Outcome reuse_factor()
  {
    for (int i = 0; i < m_options.max_reuses && !is_negligible(); ++i) {
      m_memory.apply(m_solver, m_gradient, m_step);
      const double predicted = 0.5 * m_step.dot(m_gradient);
      const double decrease = predicted > 0 ? try_step() : 0;
      if (!(decrease > 0)) {
        if (i == 0) {
          m_last_failure = m_report.iterations;
          m_pause = std::max(1, 2 * m_pause);
        }
        return Outcome::go_on;
      }
      m_pause = 0;
      ++m_report.reuses;
      accept_step();
      if (decrease < trusted_gain * predicted)
        return Outcome::go_on;
      if (decrease < m_options.relative_decrease * m_energy)
        return Outcome::converged;
    }
    return Outcome::go_on;
  }

  /// By how much the energy falls from `m_x` to `m_x - m_step`; minus infinity outside its domain.
  double try_step()
  {
    m_trial = m_x - m_step;
    ++m_report.evaluations;
    if constexpr (can_reuse)
      m_trial_energy = m_problem.energy_and_gradient(m_trial, m_trial_gradient);
    else
      m_trial_energy = m_problem.energy(m_trial);
    return m_energy - m_trial_energy;
  }

  void accept_step()
  {
    if constexpr (can_reuse) {
      m_memory.add(m_trial - m_x, m_trial_gradient - m_gradient);
      m_gradient.swap(m_trial_gradient);
    }
    m_x.swap(m_trial);
    m_energy = m_trial_energy;
    m_is_linearized = false;
    record();
  }

  void record()
  {
    if (m_options.record_history)
      m_report.history.push_back({m_stopwatch.seconds(), m_energy});
  }

  Problem& m_problem;
  Eigen::VectorXd& m_x;
  const Levenberg_marquardt_options& m_options;
  Solver& m_solver;
  Stopwatch m_stopwatch;
  Minimization_report m_report;
  double m_energy = 0, m_trial_energy = 0;
  double m_damping;
  double m_growth = 2; ///< of the damping after the next rejected step
  Damped_matrix m_matrix;
  bool m_is_linearized = false;
  int m_last_failure = 0, m_pause = 0; ///< in full steps
  Lbfgs_memory m_memory;
  Eigen::VectorXd m_gradient, m_step, m_trial, m_trial_gradient;
};

} // namespace internal

template <class Problem, class Solver>
Minimization_report minimize_levenberg_marquardt(Problem& problem, Eigen::VectorXd& x,
                                                 const Levenberg_marquardt_options& options, Solver* analyzed_solver)
{
  std::unique_ptr<Solver> own_solver;
  if (!analyzed_solver) {
    own_solver = std::make_unique<Solver>();
    own_solver->analyze(problem.gauss_newton_matrix());
    analyzed_solver = own_solver.get();
  }
  return internal::Levenberg_marquardt<Problem, Solver>(problem, x, options, *analyzed_solver).run();
}

} // namespace Quadrille

#endif
