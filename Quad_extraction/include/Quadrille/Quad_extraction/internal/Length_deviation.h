// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_LENGTH_DEVIATION_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_LENGTH_DEVIATION_H

#include <Quadrille/Quad_extraction/internal/layout_sums.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// How far integer lengths are from the map's, at all scales: what quantizers are compared by.
///
/// Along every separatrix and curve, *windows* of 1, 2, 4, ... consecutive arcs are looked at, each with half of the
/// one before, and the whole. A window of map length P and integer length X costs about w (X - P)^2 / (1 + P), where w
/// is the mean width of the patches beside it: the square of its relative error, a unit being the finest that can be
/// told, times its area. So an arc that is much shorter than a quad may vanish for little, but if many do, the longer
/// windows miss them. Between the whole numbers at distances 0, 1, 2, 4, ... from the best one the cost is
/// interpolated, which makes it convex and piecewise linear.
///
/// Arcs that are equal in all consistent lengths, alone on opposite sides of a patch, are one *group*.
class Length_deviation {
public:
  struct Window {
    std::vector<std::pair<int, int>> groups; ///< and how often
    double target = 0;
    double weight = 0;
    int best = 0; ///< the whole number of least cost
  };
  /// A linear piece of a window's cost, from `length` before it (down) or after it (up).
  struct Piece {
    double length; ///< infinite for the last one upwards
    double slope;  ///< cost per unit away from the best number
  };

  explicit Length_deviation(const Quad_layout& layout) : m_layout(layout)
  {
    find_groups();
    find_widths();
    for (const std::vector<int>& line : layout.separatrices)
      add_windows(arcs_of(line));
    for (const Quad_layout::Curve_chain& chain : layout.chains)
      add_windows(arcs_of(chain.half_arcs));
    merge_windows();
  }

  int number_of_groups() const { return m_n_groups; }
  int group(int arc) const { return at(m_group_of, arc); }
  const std::vector<Window>& windows() const { return m_windows; }

  /// Pieces of the window's cost below or above its best number.
  static std::vector<Piece> pieces(const Window& window, bool up)
  {
    std::vector<Piece> result;
    int done = 0;
    const int all = up ? 64 : window.best;
    for (int length = 1; done < all; done += length, length = std::max(1, done)) {
      length = std::min(length, all - done);
      const double before = exact_cost(window, up ? window.best + done : window.best - done);
      const double after = exact_cost(window, up ? window.best + done + length : window.best - done - length);
      result.push_back({double(length), (after - before) / length});
    }
    if (up)
      result.back().length = std::numeric_limits<double>::infinity();
    return result;
  }

  /// The cost of lengths by arc. Complexity: linear in the number of windows and their arcs.
  double cost(const std::vector<int>& lengths) const
  {
    std::vector<int> of_group(std::size_t(m_n_groups), 0);
    for (int a = 0; a < size_of(lengths); ++a)
      at(of_group, group(a)) = at(lengths, a);
    double sum = 0;
    for (const Window& window : m_windows) {
      int x = 0;
      for (const auto& [g, times] : window.groups)
        x += times * at(of_group, g);
      sum += exact_cost(window, window.best);
      double left = std::abs(x - window.best);
      for (const Piece& piece : pieces(window, x > window.best)) {
        sum += std::min(left, piece.length) * piece.slope;
        left -= std::min(left, piece.length);
      }
    }
    return sum;
  }

  /// The cost if every window had its best number: no lengths cost less.
  double least_cost() const
  {
    double sum = 0;
    for (const Window& window : m_windows)
      sum += exact_cost(window, window.best);
    return sum;
  }

  /// A cost as root of the mean square of the relative errors.
  double relative(double cost) const
  {
    double area = 0;
    for (const Window& window : m_windows)
      area += window.weight * window.target;
    return std::sqrt(cost / area);
  }

private:
  static double exact_cost(const Window& window, int x)
  {
    const double error = x - window.target;
    return window.weight * error * error / (1 + window.target);
  }

  void find_groups()
  {
    std::vector<int> parent(m_layout.arcs.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto find = [&parent](int i) {
      while (at(parent, i) != i)
        i = at(parent, i) = at(parent, at(parent, i));
      return i;
    };
    for (const Quad_layout::Patch& patch : m_layout.patches)
      for (std::size_t side = 0; side < 2; ++side)
        if (patch.sides[side].size() == 1 && patch.sides[side + 2].size() == 1) {
          const int a = find(patch.sides[side][0] / 2);
          const int b = find(patch.sides[side + 2][0] / 2);
          at(parent, std::max(a, b)) = std::min(a, b);
        }
    for (int a = 0; a < size_of(parent); ++a)
      m_group_of.push_back(find(a) == a ? m_n_groups++ : at(m_group_of, find(a)));
  }

  void find_widths()
  {
    m_width.assign(m_layout.arcs.size(), 0);
    std::vector<int> patches(m_layout.arcs.size(), 0);
    for (const Quad_layout::Patch& patch : m_layout.patches)
      for (std::size_t side = 0; side < 4; ++side) {
        double width = 0;
        for (const int h : patch.sides[(side + 1) % 4])
          width += m_layout.arc_of(h).length;
        for (const int h : patch.sides[side]) {
          at(m_width, h / 2) += width;
          ++at(patches, h / 2);
        }
      }
    for (std::size_t a = 0; a < m_width.size(); ++a)
      m_width[a] /= patches[a];
  }

  void add_windows(const std::vector<int>& line)
  {
    const std::size_t n = line.size();
    for (std::size_t size = 1; size < n; size *= 2)
      for (std::size_t begin = 0; begin < n; begin += std::max<std::size_t>(1, size / 2))
        if (begin + size <= n)
          add_window({line.begin() + std::ptrdiff_t(begin), line.begin() + std::ptrdiff_t(begin + size)});
    if (n > 0)
      add_window(line);
  }

  void add_window(const std::vector<int>& arcs)
  {
    Window window;
    std::map<int, int> times;
    double area = 0;
    for (const int a : arcs) {
      ++times[group(a)];
      window.target += at(m_layout.arcs, a).length;
      area += at(m_layout.arcs, a).length * at(m_width, a);
    }
    window.groups.assign(times.begin(), times.end());
    window.weight = area / window.target;
    window.best = static_cast<int>(std::lround(window.target));
    m_windows.push_back(std::move(window));
  }

  void merge_windows()
  {
    std::stable_sort(m_windows.begin(), m_windows.end(),
                     [](const Window& a, const Window& b) { return a.groups < b.groups; });
    std::vector<Window> merged;
    for (Window& window : m_windows)
      if (!merged.empty() && merged.back().groups == window.groups)
        merged.back().weight += window.weight;
      else
        merged.push_back(std::move(window));
    m_windows = std::move(merged);
  }

  const Quad_layout& m_layout;
  std::vector<int> m_group_of; ///< by arc
  int m_n_groups = 0;
  std::vector<double> m_width; ///< by arc: mean of the patches beside it
  std::vector<Window> m_windows;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
