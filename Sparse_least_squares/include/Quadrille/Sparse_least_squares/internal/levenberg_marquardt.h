// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_LEVENBERG_MARQUARDT_H
#define QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_LEVENBERG_MARQUARDT_H

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

namespace Quadrille {
namespace internal {

class Stopwatch {
public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count(); }

private:
  std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
};

/// The Gauss-Newton matrix plus `damping` times its diagonal. Unknowns without any residual keep a unit diagonal.
class Damped_matrix {
public:
  using Matrix = Eigen::SparseMatrix<double>;

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
  }

  const Matrix& damped(double damping)
  {
    for (Eigen::Index c = 0; c < m_matrix.cols(); ++c)
      m_matrix.valuePtr()[m_matrix.outerIndexPtr()[c]] = m_diagonal[c] + damping * m_scale[c];
    return m_matrix;
  }

  const Eigen::VectorXd& scale() const { return m_scale; }

private:
  Matrix m_matrix;
  Eigen::VectorXd m_diagonal, m_scale;
};

} // namespace internal

template <class Problem, class Solver>
Minimization_report minimize_levenberg_marquardt(Problem& problem, Eigen::VectorXd& x,
                                                 const Levenberg_marquardt_options& options, Solver* analyzed_solver)
{
  const internal::Stopwatch stopwatch;
  Minimization_report report;
  double energy = problem.linearize(x);
  report.evaluations = 1;
  report.initial_energy = report.energy = energy;
  if (!std::isfinite(energy)) {
    report.status = Minimization_status::outside_domain;
    return report;
  }
  std::unique_ptr<Solver> own_solver;
  if (!analyzed_solver) {
    own_solver = std::make_unique<Solver>();
    own_solver->analyze(problem.gauss_newton_matrix());
    analyzed_solver = own_solver.get();
  }
  internal::Damped_matrix matrix;
  matrix.assign(problem.gauss_newton_matrix());
  double damping = options.initial_damping;
  double growth = 2;
  Eigen::VectorXd step, trial;
  while (report.iterations < options.max_iterations) {
    if (options.observer)
      options.observer->report(options.stage, double(report.iterations) / options.max_iterations);
    if (energy <= options.negligible_energy) {
      report.status = Minimization_status::converged;
      break;
    }
    if (!(damping < 1e12)) {
      report.status = Minimization_status::no_progress;
      break;
    }
    ++report.factorizations;
    bool accepted = false;
    double predicted = 0;
    if (analyzed_solver->factorize(matrix.damped(damping))) {
      analyzed_solver->solve(problem.gradient(), step);
      trial = x - step;
      // The model's decrease of a damped step: 1/2 step . (damping D step + gradient).
      predicted = 0.5 * (damping * step.cwiseAbs2().dot(matrix.scale()) + step.dot(problem.gradient()));
      const double trial_energy = problem.energy(trial);
      ++report.evaluations;
      const double gain = predicted > 0 ? (energy - trial_energy) / predicted : -1;
      if (std::isfinite(trial_energy) && gain > 0) {
        accepted = true;
        x.swap(trial);
        const double decrease = (energy - trial_energy) / std::max(energy, 1e-300);
        energy = problem.linearize(x);
        ++report.evaluations;
        ++report.iterations;
        damping *= std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3));
        growth = 2;
        if (decrease < options.relative_decrease && gain > 0.25) {
          report.status = Minimization_status::converged;
          break;
        }
        matrix.assign(problem.gauss_newton_matrix());
      }
    }
    if (!accepted) {
      if (predicted > 0 && predicted <= 1e-15 * energy) {
        report.status = Minimization_status::converged;
        break;
      }
      damping *= growth;
      growth *= 2;
    }
  }
  report.energy = energy;
  report.gradient_norm = problem.gradient().norm();
  report.seconds = stopwatch.seconds();
  return report;
}

} // namespace Quadrille

#endif
