// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_GREEDY_QUANTIZATION_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_GREEDY_QUANTIZATION_H

#include <Quadrille/Quad_extraction/internal/at.h>
#include <Quadrille/Quad_layout.h>
#include <Quadrille/Strip_constraints.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// One run of `Greedy_quantizer`.
///
/// The cost of length q for a strip is the sum over its patches of |l - q| w, where l is the patch's current length
/// across the strip and w its current length along it. A priority queue holds upper bounds of the strips' least costs:
/// when a patch changes, the costs of its two strips are updated at their current q; the best q, a weighted median,
/// is recomputed when a strip's turn comes.
class Greedy_quantization {
public:
  Greedy_quantization(const Quad_layout& layout, Strip_constraints& constraints)
      : m_layout(layout), m_constraints(constraints), m_current(layout.patches.size()),
        m_result(layout.strips.size(), -1), m_best(layout.strips.size(), 0), m_cost(layout.strips.size(), 0),
        m_stamp(layout.strips.size(), 0)
  {
    for (int p = 0; p < size_of(layout.patches); ++p)
      for (int side = 0; side < 2; ++side)
        at(at(m_current, p), side) = at(layout.strips, strip_of(p, side)).length;
  }

  std::vector<int> run()
  {
    for (int s = 0; s < size_of(m_layout.strips); ++s)
      evaluate(s);
    while (!m_queue.empty()) {
      const auto [cost, s, stamp] = m_queue.top();
      m_queue.pop();
      if (at(m_result, s) >= 0 || stamp != at(m_stamp, s))
        continue;
      at(m_best, s) = best_length(s);
      at(m_result, s) = m_constraints.fix(s, at(m_best, s));
      for (const auto& [p, side] : at(m_layout.strips, s).patches)
        hand_on(p, side);
    }
    return std::move(m_result);
  }

private:
  int strip_of(int patch, int side) const
  {
    return at(m_layout.arcs, at(at(m_layout.patches, patch).half_arcs, side) / 2).strip;
  }

  double across(int patch, int side) const { return at(at(m_current, patch), side); }
  double weight(int patch, int side) const { return std::max(0.0, at(at(m_current, patch), 1 - side)); }

  double cost(int patch, int side, int q) const { return std::abs(across(patch, side) - q) * weight(patch, side); }

  void evaluate(int s)
  {
    at(m_best, s) = best_length(s);
    at(m_cost, s) = 0;
    for (const auto& [p, side] : at(m_layout.strips, s).patches)
      at(m_cost, s) += cost(p, side, at(m_best, s));
    m_queue.emplace(at(m_cost, s), s, ++at(m_stamp, s));
  }

  /// The cost is convex and piecewise linear in q: the best integer is next to the weighted median of the lengths.
  int best_length(int s) const
  {
    std::vector<std::pair<double, double>> lengths;
    double total = 0;
    for (const auto& [p, side] : at(m_layout.strips, s).patches) {
      lengths.emplace_back(across(p, side), weight(p, side));
      total += lengths.back().second;
    }
    if (total <= 0)
      for (auto& length : lengths)
        total += length.second = 1;
    std::sort(lengths.begin(), lengths.end());
    double below = 0;
    double median = 0;
    for (const auto& length : lengths) {
      median = length.first;
      below += length.second;
      if (2 * below >= total)
        break;
    }
    const int low = std::max(0, static_cast<int>(std::floor(median)));
    double difference = 0; // cost(low + 1) - cost(low)
    for (const auto& length : lengths)
      difference += length.second * (std::abs(length.first - (low + 1)) - std::abs(length.first - low));
    return difference <= 0 ? low + 1 : low;
  }

  /// Fixes the patch's length and gives half of what it lost to the next open patch on either side.
  void hand_on(int patch, int side)
  {
    const double excess = across(patch, side) - at(m_result, strip_of(patch, side));
    set(patch, side, at(m_result, strip_of(patch, side)));
    const auto first = open_neighbor(patch, side + 1);
    const auto second = open_neighbor(patch, (side + 3) % 4);
    const double share = first.first >= 0 && second.first >= 0 ? excess / 2 : excess;
    for (const auto& neighbor : {first, second})
      if (neighbor.first >= 0)
        set(neighbor.first, neighbor.second, across(neighbor.first, neighbor.second) + share);
  }

  /// The nearest patch beyond side `exit` of `patch` whose length in that direction is not fixed yet, with its side;
  /// (-1, 0) if a curve comes first.
  std::pair<int, int> open_neighbor(int patch, int exit) const
  {
    const int start = patch;
    while (true) {
      const int half_arc = at(at(m_layout.patches, patch).half_arcs, exit);
      if (at(m_layout.arcs, half_arc / 2).curve >= 0)
        return {-1, 0};
      patch = at(m_layout.left_patch, half_arc ^ 1);
      if (patch == start)
        return {-1, 0};
      const auto& sides = at(m_layout.patches, patch).half_arcs;
      const int entry = static_cast<int>(std::find(sides.begin(), sides.end(), half_arc ^ 1) - sides.begin());
      const int side = (entry + 1) % 2;
      if (at(m_result, strip_of(patch, side)) < 0)
        return {patch, side};
      exit = (entry + 2) % 4;
    }
  }

  void set(int patch, int side, double length)
  {
    const std::array<int, 2> strips = {strip_of(patch, 0), strip_of(patch, 1)};
    for (int i = 0; i < 2; ++i)
      if (at(m_result, at(strips, i)) < 0)
        at(m_cost, at(strips, i)) -= cost(patch, i, at(m_best, at(strips, i)));
    at(at(m_current, patch), side) = length;
    for (int i = 0; i < 2; ++i)
      if (at(m_result, at(strips, i)) < 0) {
        at(m_cost, at(strips, i)) += cost(patch, i, at(m_best, at(strips, i)));
        m_queue.emplace(at(m_cost, at(strips, i)), at(strips, i), ++at(m_stamp, at(strips, i)));
      }
  }

  using Entry = std::tuple<double, int, int>; ///< cost, strip, stamp

  const Quad_layout& m_layout;
  Strip_constraints& m_constraints;
  std::vector<std::array<double, 2>> m_current; ///< by patch: lengths of sides 0 and 1
  std::vector<int> m_result;
  std::vector<int> m_best;
  std::vector<double> m_cost;
  std::vector<int> m_stamp;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> m_queue;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
