// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MINIMIZE_LBFGS_H
#define QUADRILLE_MINIMIZE_LBFGS_H

#include <Quadrille/exceptions.h>
#include <Quadrille/minimize_least_squares.h>

#ifdef QUADRILLE_WITH_ALGLIB

#include <libalglib/optimization.h>

#include <algorithm>
#include <cmath>

namespace Quadrille {

struct Lbfgs_options {
  int memory = 5; ///< pairs kept
  int max_iterations = 100000;
  double relative_decrease = 1e-6; ///< stop when one iteration lowers the energy by less than this fraction of it
  bool record_history = false;
  const Progress_observer* observer = nullptr;
  const char* stage = "";
};

/// Minimises an `Element_least_squares` problem from `x` by ALGLIB's L-BFGS: the papers' method, kept for comparisons.
///
/// Available when the build has ALGLIB (`QUADRILLE_WITH_ALGLIB`). Unlike the other minimisers it needs no
/// factorisation, and hundreds to thousands of evaluations.
/// \throws Error if ALGLIB fails.
template <class Problem>
Minimization_report minimize_lbfgs(const Problem& problem, Eigen::VectorXd& x, const Lbfgs_options& options = {})
{
  const internal::Stopwatch stopwatch;
  Minimization_report report;
  Eigen::VectorXd gradient;
  report.initial_energy = report.energy = problem.energy_and_gradient(x, gradient);
  if (!std::isfinite(report.energy)) {
    report.status = Minimization_status::outside_domain;
    return report;
  }
  struct Context {
    const Problem* problem;
    Minimization_report* report;
    const internal::Stopwatch* stopwatch;
    const Lbfgs_options* options;
    double barrier;
    double lowest;
    Eigen::VectorXd x, gradient;
  };
  // ALGLIB stops on infinite values, so points outside the domain get a value that its line search will reject.
  Context context{&problem,      &report, &stopwatch, &options, 1e10 * std::max(report.energy, 1e-290),
                  report.energy, x,       gradient};
  if (options.record_history)
    report.history.push_back({stopwatch.seconds(), report.energy});
  const auto evaluate = [](const alglib::real_1d_array& at, double& value, alglib::real_1d_array& slope, void* data) {
    Context& c = *static_cast<Context*>(data);
    std::copy(at.getcontent(), at.getcontent() + c.x.size(), c.x.data());
    value = c.problem->energy_and_gradient(c.x, c.gradient);
    ++c.report->evaluations;
    if (c.options->record_history && value < c.lowest) {
      c.lowest = value;
      c.report->history.push_back({c.stopwatch->seconds(), value});
    }
    if (!std::isfinite(value)) {
      value = c.barrier;
      c.gradient.setZero();
    }
    std::copy(c.gradient.data(), c.gradient.data() + c.gradient.size(), slope.getcontent());
  };
  const auto observe = [](const alglib::real_1d_array&, double, void* data) {
    const Context& c = *static_cast<const Context*>(data);
    if (c.options->observer)
      c.options->observer->report(c.options->stage, 0);
  };
  try {
    alglib::real_1d_array start;
    start.setcontent(x.size(), x.data());
    alglib::minlbfgsstate state;
    alglib::minlbfgsreport lbfgs_report;
    alglib::minlbfgscreate(std::min<alglib::ae_int_t>(options.memory, x.size()), start, state);
    alglib::minlbfgssetcond(state, 0, options.relative_decrease, 0, options.max_iterations);
    alglib::minlbfgssetxrep(state, options.observer != nullptr);
    alglib::minlbfgsoptimize(state, evaluate, observe, &context);
    alglib::real_1d_array end;
    alglib::minlbfgsresults(state, end, lbfgs_report);
    std::copy(end.getcontent(), end.getcontent() + x.size(), x.data());
    report.iterations = int(lbfgs_report.iterationscount);
    report.status = lbfgs_report.terminationtype == 5  ? Minimization_status::iteration_limit
                    : lbfgs_report.terminationtype > 0 ? Minimization_status::converged
                                                       : Minimization_status::no_progress;
  } catch (const alglib::ap_error& error) {
    throw Error("ALGLIB's L-BFGS failed: " + error.msg);
  }
  report.energy = problem.energy_and_gradient(x, gradient);
  report.gradient_norm = gradient.norm();
  report.seconds = stopwatch.seconds();
  return report;
}

} // namespace Quadrille

#endif // QUADRILLE_WITH_ALGLIB

#endif
