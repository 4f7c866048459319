// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_LENGTH_CONSTRAINTS_H
#define QUADRILLE_LENGTH_CONSTRAINTS_H

#include <Quadrille/Curve_count.h>
#include <Quadrille/Quad_extraction/internal/Collapse_check.h>
#include <Quadrille/Quad_extraction/internal/layout_sums.h>
#include <Quadrille/Quad_layout.h>
#include <Quadrille/exceptions.h>

#include <limits>
#include <utility>
#include <vector>

namespace Quadrille {

/// Which integer lengths the arcs of a layout may have, so that the quads have the topology of the domain.
///
/// In every patch, opposite sides have equal lengths. Lengths may be 0: an arc of length 0 merges its nodes, a patch of
/// width 0 identifies its two sides, and that must not damage the domain. What is merged into one vertex must be
/// contractible, hold at most one critical node, meet the curves in one connected piece, and not join an interior
/// singularity with a curve; what becomes one edge must be contractible and hold at most one edge of a curve. Every
/// border loop, closed feature, and pair of curves with the same ends keeps at least `min_loop_edges` edges. Then the
/// collapse preserves the surface, its border, its curves and all valences.
///
/// For quantizers all of this takes the form of sums of arcs' lengths with lower bounds. There are very many that could
/// matter, so they are found lazily: start with `sums()`, hand lengths to `learn`, repeat with what it added.
class Length_constraints {
public:
  struct Sum {
    std::vector<int> arcs; ///< their lengths are added up (an arc as often as it is listed) and shall be
    int least = 1;         ///< at least this
    int most = std::numeric_limits<int>::max(); ///< and at most this: equal for a requested count, otherwise unbounded
    int request = -1;                           ///< index of the `Curve_count`, or -1
  };

  /// `min_loop_edges`: see above. `counts`: requests.
  /// \throws Invalid_argument_error if a count is negative or 0, its curves do not exist in the layout, or a curve is
  /// in
  ///         several requests.
  explicit Length_constraints(const Quad_layout& layout, int min_loop_edges = 4, std::vector<Curve_count> counts = {})
      : m_layout(&layout), m_counts(std::move(counts))
  {
    for (int i = 0; i < internal::extraction::size_of(m_counts); ++i)
      m_sums.push_back({internal::extraction::requested_arcs(layout, m_counts, i), m_counts[std::size_t(i)].count,
                        m_counts[std::size_t(i)].count, i});
    for (auto& loop : internal::extraction::curve_loops(layout))
      m_sums.push_back({std::move(loop), min_loop_edges});
    for (auto& arcs : internal::extraction::arcs_to_keep(layout))
      m_sums.push_back({std::move(arcs)});
  }

  const Quad_layout& layout() const { return *m_layout; }
  const std::vector<Curve_count>& counts() const { return m_counts; }
  /// The conditions known so far.
  const std::vector<Sum>& sums() const { return m_sums; }
  /// Asks for more.
  void require(Sum sum) { m_sums.push_back(std::move(sum)); }

  /// Are these lengths (by arc) admissible? If not because something would be merged that must stay apart, conditions
  /// that forbid it are added to `sums()`. Complexity: linear in the sum of all lengths, practically.
  bool learn(const std::vector<int>& lengths)
  {
    if (!internal::extraction::is_consistent(*m_layout, lengths))
      return false;
    for (const Sum& sum : m_sums) {
      const long long value = internal::extraction::sum_of(sum.arcs, lengths);
      if (value < sum.least || value > sum.most)
        return false;
    }
    const internal::extraction::Collapsed_layout collapsed(*m_layout, lengths);
    std::vector<std::vector<int>> conflicts = internal::extraction::Collapse_check(collapsed).run();
    for (std::vector<int>& arcs : conflicts)
      m_sums.push_back({std::move(arcs)});
    return conflicts.empty();
  }

private:
  const Quad_layout* m_layout;
  std::vector<Curve_count> m_counts;
  std::vector<Sum> m_sums;
};

} // namespace Quadrille

#endif
