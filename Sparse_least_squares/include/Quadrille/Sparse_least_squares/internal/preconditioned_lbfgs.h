// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_PRECONDITIONED_LBFGS_H
#define QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_PRECONDITIONED_LBFGS_H

#include <Quadrille/Sparse_least_squares/internal/levenberg_marquardt.h>

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

template <class Problem, class Solver>
Minimization_report minimize_preconditioned_lbfgs(Problem& problem, Eigen::VectorXd& x,
                                                  const Preconditioned_lbfgs_options& options, Solver* analyzed_solver)
{
  const internal::Stopwatch stopwatch;
  Minimization_report report;
  std::unique_ptr<Solver> own_solver;
  if (!analyzed_solver) {
    own_solver = std::make_unique<Solver>();
    own_solver->analyze(problem.gauss_newton_matrix());
    analyzed_solver = own_solver.get();
  }
  internal::Damped_matrix matrix;
  internal::Lbfgs_memory memory(options.memory);
  Eigen::VectorXd gradient, new_gradient, direction, trial;
  double energy = problem.energy_and_gradient(x, gradient);
  report.evaluations = 1;
  report.initial_energy = report.energy = energy;
  if (!std::isfinite(energy)) {
    report.status = Minimization_status::outside_domain;
    return report;
  }

  const auto refresh_preconditioner = [&] {
    problem.linearize(x);
    ++report.evaluations;
    matrix.assign(problem.gauss_newton_matrix());
    double damping = options.damping;
    do {
      ++report.factorizations;
      if (analyzed_solver->factorize(matrix.damped(damping)))
        return true;
      damping *= 10;
    } while (damping < 1e12);
    return false;
  };

  std::deque<double> history{energy};
  int since_refresh = options.refresh;
  while (report.iterations < options.max_iterations) {
    if (options.observer)
      options.observer->report(options.stage, double(report.iterations) / options.max_iterations);
    if (energy <= options.negligible_energy) {
      report.status = Minimization_status::converged;
      break;
    }
    if (since_refresh >= options.refresh) {
      if (!refresh_preconditioner()) {
        report.status = Minimization_status::no_progress;
        break;
      }
      since_refresh = 0;
    }
    memory.apply(*analyzed_solver, gradient, direction);
    double slope = -direction.dot(gradient);
    if (!(slope < 0)) {
      memory.clear();
      analyzed_solver->solve(gradient, direction);
      slope = -direction.dot(gradient);
    }
    double length = 1;
    double new_energy = 0;
    bool found = false;
    for (int trials = 0; trials < 30 && !found; ++trials) {
      trial = x - length * direction;
      new_energy = problem.energy_and_gradient(trial, new_gradient);
      ++report.evaluations;
      if (std::isfinite(new_energy) && new_energy <= energy + 1e-4 * length * slope) {
        found = true;
      } else if (std::isfinite(new_energy)) {
        // The minimum of the parabola through the two energies and the slope, kept away from both ends.
        const double parabola = -slope * length * length / (2 * (new_energy - energy - slope * length));
        length = std::min(0.5 * length, std::max(0.1 * length, parabola));
      } else {
        length *= 0.3;
      }
    }
    if (!found) {
      if (since_refresh == 0) {
        report.status =
            energy > 0 && -slope <= 1e-12 * energy ? Minimization_status::converged : Minimization_status::no_progress;
        break;
      }
      memory.clear();
      since_refresh = options.refresh;
      continue;
    }
    memory.add(trial - x, new_gradient - gradient);
    x.swap(trial);
    gradient.swap(new_gradient);
    energy = new_energy;
    ++report.iterations;
    ++since_refresh;
    history.push_back(energy);
    if (int(history.size()) > options.window) {
      if (history.front() - energy < options.relative_decrease * energy) {
        report.status = Minimization_status::converged;
        break;
      }
      history.pop_front();
    }
  }
  report.energy = energy;
  report.gradient_norm = gradient.norm();
  report.seconds = stopwatch.seconds();
  return report;
}

} // namespace Quadrille

#endif
