// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MINIMIZE_LEAST_SQUARES_H
#define QUADRILLE_MINIMIZE_LEAST_SQUARES_H

#include <Quadrille/Cholesky_solver.h>
#include <Quadrille/Progress_observer.h>

#include <Eigen/Core>

#include <vector>

namespace Quadrille {

/// Why a minimisation stopped.
enum class Minimization_status {
  converged,       ///< the relative decrease (or the gradient) fell below the tolerance
  iteration_limit, ///< `max_iterations` were done
  no_progress,     ///< no step along the computed directions lowers the energy any more
  outside_domain   ///< the starting point is outside the energy's domain
};

/// The energy that a minimisation had reached after some time.
struct Energy_sample {
  double seconds;
  double energy;
};

/// What a minimisation did.
struct Minimization_report {
  Minimization_status status = Minimization_status::iteration_limit;
  int iterations = 0;     ///< accepted steps; of Levenberg-Marquardt the full ones
  int reuses = 0;         ///< accepted steps of Levenberg-Marquardt with the factor of an earlier one
  int evaluations = 0;    ///< of the energy, with or without derivatives
  int factorizations = 0; ///< of the (damped) Gauss-Newton matrix
  double initial_energy = 0;
  double energy = 0;
  double gradient_norm = 0;
  double seconds = 0;
  /// If asked for: the start, and every accepted step (of `minimize_lbfgs`: every evaluation that lowers the energy).
  std::vector<Energy_sample> history;
};

struct Levenberg_marquardt_options {
  int max_iterations = 100;        ///< full steps
  double relative_decrease = 1e-9; ///< stop when a full step lowers the energy by less than this fraction of it
  double negligible_energy = 0;    ///< stop as soon as the energy is not above this
  double initial_damping = 1e-3;   ///< times the diagonal of J^T J
  /// Sizes of groups of consecutive unknowns that are the coordinates of one vector and share their damping, so that
  /// steps do not depend on the axes; empty: each unknown has its own.
  std::vector<int> groups;
  int max_reuses = 10; ///< cheap steps at most after a full one; 0: Levenberg and Marquardt's own method
  bool record_history = false;
  const Progress_observer* observer = nullptr;
  const char* stage = ""; ///< the stage's name told to the observer
};

/// Minimises an `Element_least_squares` problem, or another with its functions, from `x` by Levenberg-Marquardt steps
/// with Nielsen's damping rule.
///
/// A full step linearises and factorises. Where the energy then fell about as the quadratic model said, cheap steps
/// follow: L-BFGS steps around the factor at hand, each one gradient and one solve, as long as they keep what they
/// promise. (A problem without `energy_and_gradient` gets full steps only.) Quadratic convergence where residuals
/// vanish. Never raises the energy.
/// `Solver` is a model of `SparseCholeskySolver`; pass one to reuse its symbolic analysis over several calls.
template <class Problem, class Solver = Cholesky_solver>
Minimization_report minimize_levenberg_marquardt(Problem& problem, Eigen::VectorXd& x,
                                                 const Levenberg_marquardt_options& options = {},
                                                 Solver* analyzed_solver = nullptr);

struct Preconditioned_lbfgs_options {
  int max_iterations = 200;
  double relative_decrease = 1e-7; ///< stop when `window` iterations together lower the energy by less than this
  int window = 10;
  double negligible_energy = 0; ///< stop as soon as the energy is not above this
  int refresh = 12;             ///< iterations between factorisations of the preconditioner
  int memory = 12;              ///< pairs kept
  double damping = 1e-3;        ///< of the preconditioner, times the diagonal of J^T J
  bool record_history = false;
  const Progress_observer* observer = nullptr;
  const char* stage = "";
};

/// Minimises an `Element_least_squares` problem from `x` by L-BFGS whose initial inverse Hessian is the Cholesky factor
/// of the Gauss-Newton matrix, refreshed now and then.
///
/// For flat curved valleys, where plain Gauss-Newton crawls because it ignores the residuals' own curvature: the
/// quasi-Newton pairs supply what it misses. Never raises the energy.
template <class Problem, class Solver = Cholesky_solver>
Minimization_report minimize_preconditioned_lbfgs(Problem& problem, Eigen::VectorXd& x,
                                                  const Preconditioned_lbfgs_options& options = {},
                                                  Solver* analyzed_solver = nullptr);

} // namespace Quadrille

#include <Quadrille/Sparse_least_squares/internal/Levenberg_marquardt.h>
#include <Quadrille/Sparse_least_squares/internal/preconditioned_lbfgs.h>

#endif
