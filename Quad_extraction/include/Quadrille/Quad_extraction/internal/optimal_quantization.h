// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_OPTIMAL_QUANTIZATION_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_OPTIMAL_QUANTIZATION_H

#include <Quadrille/Greedy_quantizer.h>
#include <Quadrille/Optimal_quantizer.h>
#include <Quadrille/exceptions.h>

#ifdef QUADRILLE_WITH_CBC
#include <Quadrille/Quad_extraction/internal/Lap_timer.h>
#include <Quadrille/Quad_extraction/internal/Quantization_program.h>
#include <Quadrille/Quad_extraction/internal/Request_conflict.h>
#endif

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {

#ifdef QUADRILLE_WITH_CBC

namespace internal::extraction {

/// One run of `Optimal_quantizer`.
class Optimal_quantization {
public:
  Optimal_quantization(const Quad_layout& layout, Length_constraints& constraints,
                       const Optimal_quantizer::Options& options)
      : m_layout(layout), m_constraints(constraints), m_options(options), m_work_left(options.work_limit),
        m_program(layout)
  {
    m_result.method = "optimal";
  }

  Quantization run()
  {
    start_greedily();
    while (true) {
      const double seconds = m_options.time_limit - m_timer.passed();
      if (seconds <= 0)
        return give_up();
      const Integer_solution solution =
          m_program.solve(m_constraints, [](int) { return true; }, false, {m_options.gap, m_work_left, seconds});
      m_work_left -= solution.work;
      m_result.work += solution.work;
      if (solution.infeasible && m_result.lengths.empty())
        throw No_result_error("quantization", Request_conflict(m_program, m_constraints).explanation());
      m_result.lower_bound = std::max(m_result.lower_bound, solution.lower_bound + m_program.deviation().least_cost());
      if (solution.value.empty())
        return give_up();
      std::vector<int> lengths = m_program.lengths(solution);
      const std::size_t known = m_constraints.sums().size();
      if (m_constraints.learn(lengths)) {
        consider(std::move(lengths));
        return solution.interrupted ? give_up() : std::move(m_result);
      }
      if (m_constraints.sums().size() == known)
        throw No_result_error("quantization", "the integer program's solution violates its own conditions");
      ++m_result.repetitions;
    }
  }

private:
  /// The fallback; it also finds many of the conditions at little cost.
  void start_greedily()
  {
    try {
      consider(Greedy_quantizer()(m_layout, m_constraints).lengths);
    } catch (const No_result_error&) { // requested counts that it does not meet
    }
  }

  void consider(std::vector<int> lengths)
  {
    const double cost = m_program.deviation().cost(lengths);
    if (m_result.lengths.empty() || cost < m_best_cost) {
      m_result.lengths = std::move(lengths);
      m_best_cost = cost;
    }
  }

  Quantization give_up()
  {
    const bool by_time = m_timer.passed() >= m_options.time_limit;
    const std::string limit = by_time ? "the limit of time" : "the limit of work";
    if (m_result.lengths.empty())
      throw No_result_error("quantization", limit + " was too low to find any integer lengths");
    m_result.note = limit + " ended the search for better integer lengths";
    return std::move(m_result);
  }

  const Quad_layout& m_layout;
  Length_constraints& m_constraints;
  Optimal_quantizer::Options m_options;
  Lap_timer m_timer;
  double m_work_left;
  Quantization_program m_program;
  Quantization m_result;
  double m_best_cost = 0;
};

} // namespace internal::extraction

inline Quantization Optimal_quantizer::operator()(const Quad_layout& layout, Length_constraints& constraints) const
{
  return internal::extraction::Optimal_quantization(layout, constraints, m_options).run();
}

inline double quantization_bound(const Quad_layout& layout, const Length_constraints& constraints)
{
  internal::extraction::Quantization_program program(layout);
  const auto solution = program.solve(constraints, [](int) { return true; }, true, {});
  return solution.lower_bound + program.deviation().least_cost();
}

#else

inline Quantization Optimal_quantizer::operator()(const Quad_layout&, Length_constraints&) const
{
  throw Invalid_argument_error("the optimal quantizer needs the solver CBC, and this is a build without it; use the "
                               "greedy one, or build with QUADRILLE_WITH_CBC");
}

inline double quantization_bound(const Quad_layout&, const Length_constraints&)
{
  return -std::numeric_limits<double>::infinity();
}

#endif

} // namespace Quadrille

#endif
