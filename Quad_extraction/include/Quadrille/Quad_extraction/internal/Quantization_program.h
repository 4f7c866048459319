// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUANTIZATION_PROGRAM_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUANTIZATION_PROGRAM_H

#include <Quadrille/Length_constraints.h>
#include <Quadrille/Quad_extraction/internal/Integer_program.h>
#include <Quadrille/Quad_extraction/internal/Length_deviation.h>
#include <Quadrille/Quad_extraction/internal/is_parity_violated.h>
#include <Quadrille/Quad_extraction/internal/solve_with_cbc.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// The lengths of least cost (`Length_deviation`) as an integer program.
///
/// Columns: the length of each group of arcs; per window, one column for each linear piece of its cost. Rows: each
/// window's length is its best number plus and minus the pieces; opposite sides of patches agree; the conditions.
class Quantization_program {
public:
  explicit Quantization_program(const Quad_layout& layout) : m_layout(layout), m_deviation(layout)
  {
    for (int g = 0; g < m_deviation.number_of_groups(); ++g)
      m_program.add_column({0, infinity, 0, true});
    add_patches();
    for (const Length_deviation::Window& window : m_deviation.windows())
      add_window(window);
    m_rows_without_conditions = m_program.rows.size();
  }

  const Length_deviation& deviation() const { return m_deviation; }

  /// Solves the program with these conditions, and of the requests those that `with_request` holds.
  template <class Predicate>
  Integer_solution solve(const Length_constraints& constraints, const Predicate& with_request, bool relaxed,
                         const Search_limits& limits)
  {
    const Integer_program& program = with_conditions(constraints, with_request);
    if (!constraints.counts().empty() && !relaxed && is_parity_violated(program)) {
      Integer_solution solution;
      solution.infeasible = true;
      return solution;
    }
    return solve_with_cbc(program, relaxed, limits);
  }

  /// Arcs' lengths with these conditions (of the requests those that `with_request` holds) for which `request` comes
  /// as near as possible to being met, whatever they cost.
  template <class Predicate>
  Integer_solution solve_nearest(const Length_constraints& constraints, const Predicate& with_request,
                                 const Length_constraints::Sum& request, const Search_limits& limits)
  {
    Integer_program program = with_conditions(constraints, with_request);
    for (Integer_program::Column& column : program.columns)
      column.cost = 0;
    Integer_program::Row row{entries(request), double(request.least), double(request.least)};
    row.entries.emplace_back(program.add_column({0, infinity, 1, false}), 1);
    row.entries.emplace_back(program.add_column({0, infinity, 1, false}), -1);
    program.rows.push_back(std::move(row));
    return solve_with_cbc(program, false, limits);
  }

  /// By arc.
  std::vector<int> lengths(const Integer_solution& solution) const
  {
    std::vector<int> result;
    for (int a = 0; a < size_of(m_layout.arcs); ++a)
      result.push_back(static_cast<int>(std::lround(at(solution.value, m_deviation.group(a)))));
    return result;
  }

private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  template <class Predicate>
  const Integer_program& with_conditions(const Length_constraints& constraints, const Predicate& with_request)
  {
    m_program.rows.resize(m_rows_without_conditions);
    for (const Length_constraints::Sum& sum : constraints.sums()) {
      if (sum.request >= 0 && !with_request(sum.request))
        continue;
      const double most = sum.most == std::numeric_limits<int>::max() ? infinity : sum.most;
      m_program.rows.push_back({entries(sum), double(sum.least), most});
    }
    return m_program;
  }

  std::vector<std::pair<int, double>> entries(const Length_constraints::Sum& sum) const
  {
    std::map<int, double> result;
    for (const int a : sum.arcs)
      result[m_deviation.group(a)] += 1;
    return {result.begin(), result.end()};
  }

  void add_patches()
  {
    std::set<std::vector<std::pair<int, double>>> rows;
    for (const Quad_layout::Patch& patch : m_layout.patches)
      for (std::size_t side = 0; side < 2; ++side) {
        std::map<int, double> difference;
        for (const int h : patch.sides[side])
          difference[m_deviation.group(h / 2)] += 1;
        for (const int h : patch.sides[side + 2])
          difference[m_deviation.group(h / 2)] -= 1;
        std::vector<std::pair<int, double>> entries;
        for (const auto& entry : difference)
          if (entry.second != 0)
            entries.push_back(entry);
        if (!entries.empty() && rows.insert(entries).second)
          m_program.rows.push_back({std::move(entries), 0, 0});
      }
  }

  void add_window(const Length_deviation::Window& window)
  {
    Integer_program::Row row{{}, double(window.best), double(window.best)};
    for (const auto& [group, times] : window.groups)
      row.entries.emplace_back(group, times);
    for (const bool up : {false, true})
      for (const Length_deviation::Piece& piece : Length_deviation::pieces(window, up))
        row.entries.emplace_back(m_program.add_column({0, piece.length, piece.slope, false}), up ? -1 : 1);
    m_program.rows.push_back(std::move(row));
  }

  const Quad_layout& m_layout;
  Length_deviation m_deviation;
  Integer_program m_program;
  std::size_t m_rows_without_conditions = 0;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
