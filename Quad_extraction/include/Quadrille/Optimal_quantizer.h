// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_OPTIMAL_QUANTIZER_H
#define QUADRILLE_OPTIMAL_QUANTIZER_H

#include <Quadrille/Length_constraints.h>
#include <Quadrille/Quad_layout.h>
#include <Quadrille/Quantization.h>
#include <Quadrille/exceptions.h>

#include <limits>

namespace Quadrille {

/// Finds integer lengths of least cost (see `Quantization`) by integer programming. Model of `Quantizer`.
///
/// Lazily: solve the program with the conditions known so far; if what comes out would merge something that must stay
/// apart, add a condition that forbids it, and solve again. The integer lengths of arcs of a T-mesh were first
/// determined like this by Campen, Bommes and Kobbelt, "Quantized global parametrization" (2015); the cost is ours.
/// Where a patch of width 0 would merge two critical nodes, only its width is asked to be positive, though shifting the
/// nodes along it could part them, too: "optimal" is meant with this restriction.
///
/// Solved with COIN-OR's CBC (`QUADRILLE_WITH_CBC`). Complexity: exponential in the worst case, but the program is
/// nearly a flow, and practically solved in a few relaxations.
class Optimal_quantizer {
public:
  struct Options {
    /// Where a limit is reached, the best lengths known are returned (those of `Greedy_quantizer` at least), with a
    /// note. Work is counted in nodes of the search tree times columns of the integer program (up to ten for each arc
    /// of the layout), each repetition's root as ten nodes, and 30 iterations of the simplex method as one. So results
    /// do not depend on the machine and its load; the default is some twenty seconds. A root is always finished.
    /// Practically all searches end with a few nodes, far below.
    double work_limit = 3e7;
    double time_limit = std::numeric_limits<double>::infinity(); ///< seconds; results then depend on the machine
    double gap = 1e-3; ///< relative distance from the optimum that is good enough
  };

  Optimal_quantizer() = default;
  explicit Optimal_quantizer(const Options& options) : m_options(options) {}

  /// Was Quadrille built with a solver?
  static constexpr bool is_available()
  {
#ifdef QUADRILLE_WITH_CBC
    return true;
#else
    return false;
#endif
  }

  /// \throws Invalid_argument_error without a solver.
  /// \throws No_result_error("quantization", ...) if the requested counts cannot be met, naming those that are in
  /// conflict,
  ///         or if a limit was too low to find any lengths.
  Quantization operator()(const Quad_layout& layout, Length_constraints& constraints) const;

private:
  Options m_options;
};

/// A lower bound of the cost of all admissible lengths, by linear programming; -infinity without a solver.
double quantization_bound(const Quad_layout& layout, const Length_constraints& constraints);

} // namespace Quadrille

#include <Quadrille/Quad_extraction/internal/optimal_quantization.h>

#endif
