// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_SOLVE_WITH_CBC_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_SOLVE_WITH_CBC_H

#ifndef QUADRILLE_WITH_CBC
#error "CBC is needed here"
#endif

#include <Quadrille/Quad_extraction/internal/Integer_program.h>
#include <Quadrille/Quad_extraction/internal/Lap_timer.h>

#include <coin/Cbc_C_Interface.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Solves a program with COIN-OR's branch and cut solver CBC, on one thread; deterministic unless time runs out.
/// `relaxed`: integers may be fractions; then neither gap nor work matter.
///
/// The relaxations of our programs are nearly integral: a few fractions of one half, for which some cuts or nodes are
/// enough. CBC's preprocessing and probing, made for other programs, would take far more time than all the rest (on
/// 100,000 columns half a minute), and so would most heuristics; one that dives is kept, so that there is a solution
/// wherever the search ends.
inline Integer_solution solve_with_cbc(const Integer_program& program, bool relaxed, const Search_limits& limits)
{
  Integer_solution solution;
  const double max_nodes =
      limits.work / std::max(1.0, double(program.columns.size())) - Search_limits::root_nodes; // nodes but the root
  if (!relaxed && max_nodes < 0) {
    solution.interrupted = true;
    return solution;
  }
  const std::unique_ptr<Cbc_Model, void (*)(Cbc_Model*)> model(Cbc_newModel(), &Cbc_deleteModel);
  const std::size_t n = program.columns.size();
  std::vector<CoinBigIndex> start(n + 1, 0);
  for (const Integer_program::Row& row : program.rows)
    for (const auto& entry : row.entries)
      ++start[std::size_t(entry.first) + 1];
  for (std::size_t c = 0; c < n; ++c)
    start[c + 1] += start[c];
  const auto n_entries = static_cast<std::size_t>(start[n]);
  std::vector<int> index(n_entries);
  std::vector<double> value(index.size());
  std::vector<double> row_low, row_high, low, high, cost;
  std::vector<CoinBigIndex> end(start.begin(), start.end() - 1);
  for (std::size_t r = 0; r < program.rows.size(); ++r) {
    row_low.push_back(program.rows[r].low);
    row_high.push_back(program.rows[r].high);
    for (const auto& [column, coefficient] : program.rows[r].entries) {
      const auto place = std::size_t(end[std::size_t(column)]++);
      index[place] = static_cast<int>(r);
      value[place] = coefficient;
    }
  }
  for (const Integer_program::Column& column : program.columns) {
    low.push_back(column.low);
    high.push_back(column.high);
    cost.push_back(column.cost);
  }
  Cbc_loadProblem(model.get(), static_cast<int>(n), static_cast<int>(program.rows.size()), start.data(), index.data(),
                  value.data(), low.data(), high.data(), cost.data(), row_low.data(), row_high.data());
  for (std::size_t c = 0; c < n && !relaxed; ++c)
    if (program.columns[c].integer)
      Cbc_setInteger(model.get(), static_cast<int>(c));
  Cbc_setLogLevel(model.get(), 0);
  Cbc_setParameter(model.get(), "log", "0");
  if (std::isfinite(limits.seconds)) {
    Cbc_setParameter(model.get(), "timeMode", "elapsed");
    Cbc_setParameter(model.get(), "seconds", std::to_string(std::max(limits.seconds, 0.01)).c_str());
  }
  if (std::isfinite(max_nodes))
    Cbc_setParameter(model.get(), "maxNodes", std::to_string(static_cast<int>(std::min(max_nodes, 1e9))).c_str());
  Cbc_setParameter(model.get(), "ratioGap", std::to_string(limits.gap).c_str());
  for (const char* off : {"preprocess", "probingCuts", "heuristicsOnOff"})
    Cbc_setParameter(model.get(), off, "off");
  Cbc_setParameter(model.get(), "DivingCoefficient", "on");
  const Lap_timer timer;
  Cbc_solve(model.get());

  solution.work = (Search_limits::root_nodes + Cbc_getNodeCount(model.get()) +
                   Cbc_getIterationCount(model.get()) / Search_limits::iterations_per_node) *
                  double(n);
  // When time runs out before there is a solution, CBC may say "infeasible", too.
  constexpr double certainly_in_time = 0.8;
  const bool no_solution = Cbc_isProvenInfeasible(model.get()) != 0;
  solution.infeasible = no_solution && timer.passed() < certainly_in_time * limits.seconds;
  solution.interrupted = Cbc_status(model.get()) == 1 || (no_solution && !solution.infeasible);
  if (no_solution)
    return solution;
  const double* best = relaxed ? Cbc_getColSolution(model.get()) : Cbc_bestSolution(model.get());
  if (best) {
    solution.value.assign(best, best + n);
    solution.cost = Cbc_getObjValue(model.get());
  }
  if (!relaxed)
    solution.lower_bound = Cbc_getBestPossibleObjValue(model.get());
  else if (Cbc_isProvenOptimal(model.get()))
    solution.lower_bound = solution.cost;
  return solution;
}

} // namespace internal::extraction
} // namespace Quadrille

#endif
