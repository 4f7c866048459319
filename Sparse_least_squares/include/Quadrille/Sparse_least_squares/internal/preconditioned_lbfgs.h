// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_PRECONDITIONED_LBFGS_H
#define QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_PRECONDITIONED_LBFGS_H

#include <Quadrille/Sparse_least_squares/internal/Damped_matrix.h>
#include <Quadrille/Sparse_least_squares/internal/Lbfgs_memory.h>
#include <Quadrille/Sparse_least_squares/internal/Stopwatch.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>

namespace Quadrille {

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
  const auto record = [&] {
    if (options.record_history)
      report.history.push_back({stopwatch.seconds(), energy});
  };
  record();

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
    record();
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
