// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_BENCHMARK_SOLVER_COMPARISON_H
#define QUADRILLE_BENCHMARK_SOLVER_COMPARISON_H

#include <Quadrille/minimize_least_squares.h>

#include <cmath>
#include <vector>

namespace Quadrille {

/// When an energy was reached that is at most the given one; all of the time if it never was.
inline double time_to_energy(const Minimization_report& report, double energy)
{
  for (const Energy_sample& sample : report.history)
    if (sample.energy <= energy)
      return sample.seconds;
  return report.seconds;
}

inline double geometric_mean(const std::vector<double>& values)
{
  double log_sum = 0;
  for (const double value : values)
    log_sum += std::log(value);
  return std::exp(log_sum / double(values.size()));
}

} // namespace Quadrille

#endif
