// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_SPLIT_CHORDS_H
#define QUADRILLE_MESH_IO_INTERNAL_SPLIT_CHORDS_H

#include <Quadrille/Support/internal/segment_intersections.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Splits inner edges that join two vertices of curves (chords) in the middle.
///
/// A map that is aligned with the curves flattens a triangle whose three corners lie on one side, and a frame field
/// cannot turn within a triangle all of whose corners lie on curves. Chords that cut off a corner sharper than 50
/// degrees stay: halving such corners would make needles. Complexity: O(n log n).
class Chord_splitter {
public:
  using Point_2 = Segment_kernel::Point_2;
  using Triangle = std::array<int, 3>;

  /// Positively oriented triangles of a manifold, with a label each; the border is made of curves in any case.
  Chord_splitter(std::vector<Point_2>& points, std::vector<Triangle>& triangles, std::vector<int>& labels,
                 const std::vector<std::array<int, 2>>& lines)
      : m_points(points), m_triangles(triangles), m_labels(labels), m_is_on_curve(points.size(), 0)
  {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i)
        m_triangle_of[{triangles[t][i], triangles[t][(i + 1) % 3]}] = t;
    for (const std::array<int, 2>& line : lines)
      add_curve_edge(line[0], line[1]);
    for (const auto& [edge, triangle] : m_triangle_of)
      if (!m_triangle_of.count({edge.second, edge.first}))
        add_curve_edge(edge.first, edge.second);
  }

  /// Returns the number of edges split. New points and triangles are appended.
  int run()
  {
    std::vector<std::pair<int, int>> chords;
    for (const auto& [edge, triangle] : m_triangle_of)
      if (edge.first < edge.second && is_chord(edge.first, edge.second))
        chords.push_back(edge);
    int n = 0;
    for (const auto& [a, b] : chords)
      n += split(a, b) ? 1 : 0;
    return n;
  }

private:
  void add_curve_edge(int a, int b)
  {
    m_curve_edges.insert(std::minmax(a, b));
    m_is_on_curve[std::size_t(a)] = m_is_on_curve[std::size_t(b)] = 1;
  }

  bool on_curve(int a, int b) const { return m_curve_edges.count(std::minmax(a, b)) != 0; }

  bool is_chord(int a, int b) const
  {
    return m_is_on_curve[std::size_t(a)] && m_is_on_curve[std::size_t(b)] && !on_curve(a, b) &&
           !cuts_off_sharp_corner(a, b, apex({a, b})) && !cuts_off_sharp_corner(a, b, apex({b, a}));
  }

  int apex(const std::pair<int, int>& edge) const
  {
    for (const int v : m_triangles[m_triangle_of.at(edge)])
      if (v != edge.first && v != edge.second)
        return v;
    return -1;
  }

  bool cuts_off_sharp_corner(int a, int b, int c) const
  {
    if (!on_curve(c, a) || !on_curve(c, b))
      return false;
    const auto u = at(a) - at(c), v = at(b) - at(c);
    return std::abs(std::atan2(u.x() * v.y() - u.y() * v.x(), u * v)) < 50 * CGAL_PI / 180;
  }

  bool split(int a, int b)
  {
    const std::size_t t = m_triangle_of.at({a, b}), u = m_triangle_of.at({b, a});
    const int c = apex({a, b}), d = apex({b, a});
    const Point_2 middle = CGAL::midpoint(at(a), at(b));
    const auto is_left = [&](int from, int to) {
      return CGAL::orientation(at(from), at(to), middle) == CGAL::COUNTERCLOCKWISE;
    };
    if (!is_left(b, c) || !is_left(c, a) || !is_left(a, d) || !is_left(d, b))
      return false; // too flat for doubles
    const int m = int(m_points.size());
    m_points.push_back(middle);
    set(t, {a, m, c});
    set(u, {b, m, d});
    append({m, b, c}, m_labels[t]);
    append({m, a, d}, m_labels[u]);
    return true;
  }

  void set(std::size_t t, const Triangle& triangle)
  {
    m_triangles[t] = triangle;
    for (std::size_t i = 0; i < 3; ++i)
      m_triangle_of[{triangle[i], triangle[(i + 1) % 3]}] = t;
  }

  void append(const Triangle& triangle, int label)
  {
    m_triangles.emplace_back();
    m_labels.push_back(label);
    set(m_triangles.size() - 1, triangle);
  }

  const Point_2& at(int v) const { return m_points[std::size_t(v)]; }

  std::vector<Point_2>& m_points;
  std::vector<Triangle>& m_triangles;
  std::vector<int>& m_labels;
  std::vector<char> m_is_on_curve; ///< by vertex
  std::set<std::pair<int, int>> m_curve_edges;
  std::map<std::pair<int, int>, std::size_t> m_triangle_of; ///< by directed edge
};

} // namespace internal
} // namespace Quadrille

#endif
