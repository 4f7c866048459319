// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_GREEDY_QUANTIZATION_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_GREEDY_QUANTIZATION_H

#include <Quadrille/Length_constraints.h>
#include <Quadrille/Quad_extraction/internal/Strip_floors.h>
#include <Quadrille/Quad_extraction/internal/at.h>
#include <Quadrille/Quad_layout.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// One run of `Greedy_quantizer`, under the conditions known so far.
///
/// Where a strip passes through a patch, a *visit*, it has a current width. The cost of width q for a strip is the sum
/// over its visits of |l - q| w, where l is the visit's width and w the patch's current length along the strip. A
/// priority queue holds upper bounds of the strips' least costs: when a patch changes, the costs of its strips are
/// updated at their current q; the best q, a weighted median, is recomputed when a strip's turn comes.
class Greedy_quantization {
public:
  Greedy_quantization(const Quad_layout& layout, const Length_constraints& constraints)
      : m_layout(layout), m_visits_in(layout.patches.size()), m_first_open(layout.patches.size(), {0, 0}),
        m_extent(layout.patches.size(), {0, 0}), m_visits_of(layout.strips.size()), m_result(layout.strips.size(), -1),
        m_best(layout.strips.size(), 0), m_cost(layout.strips.size(), 0), m_stamp(layout.strips.size(), 0),
        m_sums_of(layout.strips.size())
  {
    find_sums(constraints);
    const std::vector<double> factor = scaling(constraints);
    for (int s = 0; s < size_of(layout.strips); ++s)
      for (const auto& [p, side] : at(layout.strips, s).patches) {
        at(m_visits_of, s).push_back(size_of(m_visits));
        at(at(m_visits_in, p), side).push_back(size_of(m_visits));
        m_visits.push_back({s, p, side, at(factor, s) * at(layout.strips, s).length});
        at(at(m_extent, p), side) += m_visits.back().width;
      }
  }

  /// Returns the widths of the strips. They may violate conditions where these leave no choice.
  std::vector<int> run()
  {
    find_floors();
    for (int s = 0; s < size_of(m_layout.strips); ++s)
      evaluate(s);
    while (!m_queue.empty()) {
      const auto [cost, s, stamp] = m_queue.top();
      m_queue.pop();
      if (at(m_result, s) >= 0 || stamp != at(m_stamp, s))
        continue;
      fix(s, best_width(s));
      for (const int visit : at(m_visits_of, s))
        hand_on(visit);
    }
    return std::move(m_result);
  }

private:
  struct Visit {
    int strip;
    int patch;
    int side;
    double width;
  };
  /// A condition and how far it is decided.
  struct Sum {
    int least;
    int most;
    int fixed = 0;
    int open = 0; ///< passages of strips without a width
  };

  void find_sums(const Length_constraints& constraints)
  {
    std::vector<std::vector<int>> strips_across(m_layout.arcs.size());
    for (int s = 0; s < size_of(m_layout.strips); ++s)
      for (const int a : at(m_layout.strips, s).arcs)
        at(strips_across, a).push_back(s);
    for (const Length_constraints::Sum& sum : constraints.sums()) {
      std::vector<int> strips;
      for (const int a : sum.arcs)
        strips.insert(strips.end(), at(strips_across, a).begin(), at(strips_across, a).end());
      std::sort(strips.begin(), strips.end());
      for (std::size_t i = 0; i < strips.size();) {
        const std::size_t begin = i;
        while (i < strips.size() && strips[i] == strips[begin])
          ++i;
        at(m_sums_of, strips[begin]).emplace_back(size_of(m_sums), static_cast<int>(i - begin));
      }
      m_sums.push_back({sum.least, sum.most, 0, size_of(strips)});
    }
  }

  /// Factors for the strips' widths such that the requested counts are nearly met (iterative proportional fitting).
  std::vector<double> scaling(const Length_constraints& constraints) const
  {
    constexpr int rounds = 50;
    std::vector<double> factor(m_layout.strips.size(), 1);
    if (constraints.counts().empty())
      return factor;
    std::vector<std::vector<std::pair<int, int>>> strips_of(m_sums.size());
    for (int s = 0; s < size_of(m_sums_of); ++s)
      for (const auto& [sum, times] : at(m_sums_of, s))
        if (at(m_sums, sum).least == at(m_sums, sum).most)
          at(strips_of, sum).emplace_back(s, times);
    for (int round = 0; round < rounds; ++round)
      for (std::size_t i = 0; i < m_sums.size(); ++i) {
        double length = 0;
        for (const auto& [s, times] : strips_of[i])
          length += times * at(factor, s) * at(m_layout.strips, s).length;
        for (const auto& [s, times] : strips_of[i])
          at(factor, s) *= m_sums[i].least / length;
      }
    return factor;
  }

  /// Requested counts are left out: the widths are scaled to them.
  void find_floors()
  {
    std::vector<int> bounds;
    for (const Sum& sum : m_sums)
      bounds.push_back(sum.most < std::numeric_limits<int>::max() ? 0 : sum.least);
    std::vector<int> wanted;
    for (int s = 0; s < size_of(m_layout.strips); ++s)
      wanted.push_back(best_width(s));
    m_floor = Strip_floors(std::move(bounds), m_sums_of).run(std::move(wanted), [this](int s, int width) {
      double price = 0;
      for (const int visit : at(m_visits_of, s))
        price += cost(at(m_visits, visit), width + 1) - cost(at(m_visits, visit), width);
      return price;
    });
  }

  double weight(const Visit& visit) const { return std::max(0.0, at(at(m_extent, visit.patch), 1 - visit.side)); }

  double cost(const Visit& visit, int q) const { return std::abs(visit.width - q) * weight(visit); }

  void evaluate(int s)
  {
    at(m_best, s) = best_width(s);
    at(m_cost, s) = 0;
    for (const int visit : at(m_visits_of, s))
      at(m_cost, s) += cost(at(m_visits, visit), at(m_best, s));
    m_queue.emplace(at(m_cost, s), s, ++at(m_stamp, s));
  }

  /// The cost is convex and piecewise linear in q: the best integer is next to the weighted median of the widths.
  int best_width(int s) const
  {
    std::vector<std::pair<double, double>> widths;
    double total = 0;
    for (const int visit : at(m_visits_of, s)) {
      widths.emplace_back(at(m_visits, visit).width, weight(at(m_visits, visit)));
      total += widths.back().second;
    }
    if (total <= 0)
      for (auto& width : widths)
        total += width.second = 1;
    std::sort(widths.begin(), widths.end());
    double below = 0;
    double median = 0;
    for (const auto& width : widths) {
      median = width.first;
      below += width.second;
      if (2 * below >= total)
        break;
    }
    const int low = std::max(0, static_cast<int>(std::floor(median)));
    double difference = 0; // cost(low + 1) - cost(low)
    for (const auto& width : widths)
      difference += width.second * (std::abs(width.first - (low + 1)) - std::abs(width.first - low));
    return difference <= 0 ? low + 1 : low;
  }

  /// Gives a strip the admissible width nearest to `wanted`: at least its floor and what conditions without other open
  /// strips miss, at most what is left of requested counts.
  void fix(int s, int wanted)
  {
    int least = 0;
    int most = std::numeric_limits<int>::max();
    for (const auto& [index, times] : at(m_sums_of, s)) {
      const Sum& sum = at(m_sums, index);
      if (sum.open == times && sum.fixed < sum.least)
        least = std::max(least, (sum.least - sum.fixed + times - 1) / times);
      if (sum.most < std::numeric_limits<int>::max())
        most = std::min(most, std::max(0, sum.most - sum.fixed) / times);
    }
    const int width = std::max(least, std::min(std::max(wanted, at(m_floor, s)), most));
    at(m_result, s) = width;
    for (const auto& [index, times] : at(m_sums_of, s)) {
      at(m_sums, index).fixed += times * width;
      at(m_sums, index).open -= times;
    }
  }

  /// Gives what the visit lost to open strips: to the next one in the same patch, otherwise half of it to the next open
  /// patch on either side.
  void hand_on(int index)
  {
    const Visit visit = at(m_visits, index);
    const double excess = visit.width - at(m_result, visit.strip);
    const int beside = open_visit(visit.patch, visit.side);
    if (beside >= 0) { // the patch's extent stays
      at(m_visits, index).width -= excess;
      change_cost(beside, -1);
      at(m_visits, beside).width += excess;
      change_cost(beside, 1);
      queue_again(at(m_visits, beside).strip);
      return;
    }
    set(index, at(m_result, visit.strip));
    const int first = open_neighbor(visit.patch, visit.side + 1);
    const int second = open_neighbor(visit.patch, (visit.side + 3) % 4);
    const double share = first >= 0 && second >= 0 ? excess / 2 : excess;
    for (const int neighbor : {first, second})
      if (neighbor >= 0)
        set(neighbor, at(m_visits, neighbor).width + share);
  }

  /// A visit of a strip without a width between the sides `side` and `side + 2` of `patch`, or -1.
  int open_visit(int patch, int side)
  {
    const std::vector<int>& visits = at(at(m_visits_in, patch), side % 2);
    std::size_t& first = at(at(m_first_open, patch), side % 2);
    while (first < visits.size() && at(m_result, at(m_visits, visits[first]).strip) >= 0)
      ++first;
    return first == visits.size() ? -1 : visits[first];
  }

  /// An open visit in the nearest patch beyond side `exit` of `patch` that has one in that direction; -1 if a curve
  /// comes first.
  int open_neighbor(int patch, int exit)
  {
    const int start = patch;
    for (std::size_t passed = 0; passed < m_layout.patches.size(); ++passed) {
      const std::vector<int>& side = at(at(m_layout.patches, patch).sides, exit);
      const int half_arc = at(side, size_of(side) / 2);
      if (m_layout.arc_of(half_arc).curve >= 0)
        return -1;
      patch = at(m_layout.left_patch, half_arc ^ 1);
      if (patch == start)
        return -1;
      const auto& sides = at(m_layout.patches, patch).sides;
      const auto is_entry = [half_arc](const std::vector<int>& half_arcs) {
        return std::find(half_arcs.begin(), half_arcs.end(), half_arc ^ 1) != half_arcs.end();
      };
      const int entry = static_cast<int>(std::find_if(sides.begin(), sides.end(), is_entry) - sides.begin());
      const int visit = open_visit(patch, entry + 1);
      if (visit >= 0)
        return visit;
      exit = (entry + 2) % 4;
    }
    return -1;
  }

  /// Changes a visit's width, and with it the weights of the visits of the patch in the other direction.
  void set(int index, double width)
  {
    Visit& visit = at(m_visits, index);
    change_costs(visit.patch, visit.side, index, -1);
    at(at(m_extent, visit.patch), visit.side) += width - visit.width;
    visit.width = width;
    change_costs(visit.patch, visit.side, index, 1);
    queue_again(visit.strip);
    for (const int other : at(at(m_visits_in, visit.patch), 1 - visit.side))
      queue_again(at(m_visits, other).strip);
  }

  void change_costs(int patch, int side, int index, int sign)
  {
    change_cost(index, sign);
    for (const int other : at(at(m_visits_in, patch), 1 - side))
      change_cost(other, sign);
  }

  void change_cost(int index, int sign)
  {
    const Visit& visit = at(m_visits, index);
    if (at(m_result, visit.strip) < 0)
      at(m_cost, visit.strip) += sign * cost(visit, at(m_best, visit.strip));
  }

  void queue_again(int s)
  {
    if (at(m_result, s) < 0)
      m_queue.emplace(at(m_cost, s), s, ++at(m_stamp, s));
  }

  using Entry = std::tuple<double, int, int>; ///< cost, strip, stamp

  const Quad_layout& m_layout;
  std::vector<Visit> m_visits;
  std::vector<std::array<std::vector<int>, 2>> m_visits_in; ///< by patch and side
  std::vector<std::array<std::size_t, 2>> m_first_open;     ///< by patch and side: those before have a width
  std::vector<std::array<double, 2>> m_extent;              ///< by patch and side: current sum of the widths
  std::vector<std::vector<int>> m_visits_of;                ///< by strip
  std::vector<int> m_floor;                                 ///< by strip
  std::vector<int> m_result;
  std::vector<int> m_best;
  std::vector<double> m_cost;
  std::vector<int> m_stamp;
  std::vector<Sum> m_sums;
  std::vector<std::vector<std::pair<int, int>>> m_sums_of; ///< by strip: sum, number of passages
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> m_queue;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
