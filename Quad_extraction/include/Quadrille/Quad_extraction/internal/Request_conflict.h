// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_REQUEST_CONFLICT_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_REQUEST_CONFLICT_H

#include <Quadrille/Quad_extraction/internal/Quantization_program.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Explains why requested counts cannot be met: names a smallest set of requests in conflict, and what would be
/// possible on one of them.
class Request_conflict {
public:
  Request_conflict(Quantization_program& program, const Length_constraints& constraints)
      : m_program(program), m_constraints(constraints)
  {
  }

  std::string explanation()
  {
    std::set<int> conflict; // leaving out any of these resolves it
    for (int i = 0; i < size_of(m_constraints.counts()); ++i)
      conflict.insert(i);
    for (int i = 0; i < size_of(m_constraints.counts()); ++i) {
      conflict.erase(i);
      if (!is_infeasible(conflict))
        conflict.insert(i);
    }
    if (conflict.empty())
      return "no integer lengths keep apart what must stay apart";
    std::string text;
    for (const int i : conflict)
      text += (text.empty() ? "" : ", ") + std::to_string(at(m_constraints.counts(), i).count) + " on " +
              name_of(at(m_constraints.counts(), i));
    const int last = *conflict.rbegin();
    conflict.erase(last);
    text = "these numbers of elements are impossible" + std::string(conflict.empty() ? "" : " together") + ": " + text +
           " (opposite sides of all patches of the layout need equal numbers, and what must stay apart at least one)";
    const int possible = nearest(conflict, last);
    if (possible >= 0)
      text +=
          "; " + std::to_string(possible) + " on " + name_of(at(m_constraints.counts(), last)) + " would be possible";
    return text;
  }

private:
  static constexpr double work = 2e7; // per question

  bool is_infeasible(const std::set<int>& requests)
  {
    return m_program.solve(m_constraints, [&requests](int i) { return requests.count(i) > 0; }, false, {0.1, work})
        .infeasible;
  }

  /// The number nearest to what is asked for in `request` that is possible together with the other ones; -1: not known.
  int nearest(const std::set<int>& others, int request)
  {
    for (const Length_constraints::Sum& sum : m_constraints.sums()) {
      if (sum.request != request)
        continue;
      const Integer_solution solution =
          m_program.solve_nearest(m_constraints, [&others](int i) { return others.count(i) > 0; }, sum, {0, work});
      if (!solution.value.empty())
        return static_cast<int>(sum_of(sum.arcs, m_program.lengths(solution)));
    }
    return -1;
  }

  Quantization_program& m_program;
  const Length_constraints& m_constraints;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
