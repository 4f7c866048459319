// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_STRIP_FLOORS_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_STRIP_FLOORS_H

#include <Quadrille/Quad_extraction/internal/at.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Least widths of strips with which conditions (weighted sums of widths with lower bounds) are met at little cost.
///
/// Starting from the widths that strips want, the strip that costs least per missing unit of all conditions is widened,
/// again and again: Chvatal's greedy covering. Then, the dearest first, strips are narrowed as far as the conditions
/// allow; what is left is needed. Without this, where many strips are much narrower than a quad, a rounding that begins
/// with the cheapest strips lets those vanish that could meet a condition for little, and leaves it to the dearest.
class Strip_floors {
public:
  /// `bounds`: by condition; `times`: by strip, conditions and how often it counts there.
  Strip_floors(std::vector<int> bounds, const std::vector<std::vector<std::pair<int, int>>>& times)
      : m_missing(std::move(bounds)), m_times(times)
  {
  }

  /// `price(strip, width)`: what one unit more than `width` costs; must not decrease with `width`.
  /// Complexity: the sum of the strips' widths and their conditions, times a logarithm.
  template <class Price> std::vector<int> run(std::vector<int> width, const Price& price)
  {
    for (int s = 0; s < size_of(width); ++s)
      change(s, at(width, s));
    widen(width, price);
    std::vector<int> order(width.size());
    std::vector<double> last_unit(width.size(), 0);
    std::iota(order.begin(), order.end(), 0);
    for (const int s : order)
      if (at(width, s) > 0)
        at(last_unit, s) = price(s, at(width, s) - 1);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return at(last_unit, a) > at(last_unit, b); });
    for (const int s : order)
      narrow(s, at(width, s));
    return width;
  }

private:
  using Entry = std::tuple<double, int>; ///< cost per missing unit, strip

  template <class Price> void widen(std::vector<int>& width, const Price& price)
  {
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    const auto add = [&](int s) {
      if (const int gain = gain_of(s); gain > 0)
        queue.emplace(price(s, at(width, s)) / gain, s);
    };
    for (int s = 0; s < size_of(width); ++s)
      add(s);
    while (!queue.empty()) {
      const auto [cost, s] = queue.top();
      queue.pop();
      const int gain = gain_of(s);
      if (gain > 0 && price(s, at(width, s)) / gain <= cost) { // gains only fall: what was not up to date comes again
        ++at(width, s);
        change(s, 1);
      }
      add(s);
    }
  }

  void narrow(int s, int& width)
  {
    int most = width;
    for (const auto& [condition, times] : at(m_times, s))
      most = std::min(most, std::max(0, -at(m_missing, condition)) / times);
    width -= most;
    change(s, -most);
  }

  /// How many missing units of conditions one more of the strip's width supplies.
  int gain_of(int s) const
  {
    int gain = 0;
    for (const auto& [condition, times] : at(m_times, s))
      gain += std::min(times, std::max(0, at(m_missing, condition)));
    return gain;
  }

  void change(int s, int units)
  {
    for (const auto& [condition, times] : at(m_times, s))
      at(m_missing, condition) -= times * units;
  }

  std::vector<int> m_missing; ///< by condition: units; negative: to spare
  const std::vector<std::vector<std::pair<int, int>>>& m_times;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
