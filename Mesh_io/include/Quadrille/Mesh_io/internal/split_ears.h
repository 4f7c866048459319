// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_SPLIT_EARS_H
#define QUADRILLE_MESH_IO_INTERNAL_SPLIT_EARS_H

#include <Quadrille/Mesh_io/internal/Outline.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Makes sure that corners have more than one triangle.
///
/// A triangle with two edges on curves (an ear) has no free vertex, so that a frame field cannot turn within it. Its
/// third edge is flipped where that gives good triangles, or else split in the middle. Ears in corners sharper than 50
/// degrees stay: halving them would make needles. Complexity: O(n log n).
class Ear_splitter {
public:
  using Triangle = std::array<int, 3>;

  Ear_splitter(std::vector<Point_2>& points, std::vector<Triangle>& triangles, std::vector<int>& regions,
               const std::vector<std::array<int, 2>>& lines)
      : m_points(points), m_triangles(triangles), m_regions(regions)
  {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i)
        m_triangle_of[{triangles[t][i], triangles[t][(i + 1) % 3]}] = t;
    for (const std::array<int, 2>& line : lines)
      m_on_curve.insert(key(line[0], line[1]));
  }

  void run()
  {
    const std::size_t n = m_triangles.size();
    for (std::size_t t = 0; t < n; ++t)
      for (std::size_t i = 0; i < 3; ++i)
        if (is_ear(t, i)) {
          split(t, i);
          break;
        }
  }

private:
  static std::pair<int, int> key(int a, int b) { return std::minmax(a, b); }
  bool on_curve(int a, int b) const { return m_on_curve.count(key(a, b)) != 0; }

  bool is_ear(std::size_t t, std::size_t corner) const
  {
    const int c = m_triangles[t][corner], a = m_triangles[t][(corner + 1) % 3], b = m_triangles[t][(corner + 2) % 3];
    return on_curve(c, a) && on_curve(b, c) && !on_curve(a, b) && angle(a, c, b) > 50 * CGAL_PI / 180;
  }

  double angle(int a, int c, int b) const
  {
    const auto u = at(a) - at(c), v = at(b) - at(c);
    return std::abs(std::atan2(u.x() * v.y() - u.y() * v.x(), u * v));
  }

  /// Smallest angle; negative for a triangle that is not positively oriented.
  double quality(int a, int b, int c) const
  {
    if (CGAL::orientation(at(a), at(b), at(c)) != CGAL::COUNTERCLOCKWISE)
      return -1;
    return std::min({angle(a, b, c), angle(b, c, a), angle(c, a, b)});
  }

  void split(std::size_t t, std::size_t corner)
  {
    const int c = m_triangles[t][corner], a = m_triangles[t][(corner + 1) % 3], b = m_triangles[t][(corner + 2) % 3];
    const auto neighbor = m_triangle_of.find({b, a});
    if (neighbor == m_triangle_of.end())
      return;
    const std::size_t u = neighbor->second;
    int d = -1;
    for (const int v : m_triangles[u])
      if (v != a && v != b)
        d = v;
    const double flipped = on_curve(a, d) || on_curve(d, b) ? -1 : std::min(quality(c, a, d), quality(c, d, b));
    if (flipped > 30 * CGAL_PI / 180) {
      set(t, {c, a, d});
      set(u, {c, d, b});
      return;
    }
    const int m = int(m_points.size());
    m_points.push_back(CGAL::midpoint(at(a), at(b)));
    if (std::min({quality(c, a, m), quality(c, m, b), quality(d, b, m), quality(d, m, a)}) <= 0) {
      m_points.pop_back(); // too flat for doubles
      return;
    }
    set(t, {c, a, m});
    set(u, {d, b, m});
    append({c, m, b}, m_regions[t]);
    append({d, m, a}, m_regions[u]);
  }

  void set(std::size_t t, const Triangle& triangle)
  {
    m_triangles[t] = triangle;
    for (std::size_t i = 0; i < 3; ++i)
      m_triangle_of[{triangle[i], triangle[(i + 1) % 3]}] = t;
  }

  void append(const Triangle& triangle, int region)
  {
    m_triangles.emplace_back();
    m_regions.push_back(region);
    set(m_triangles.size() - 1, triangle);
  }

  const Point_2& at(int v) const { return m_points[std::size_t(v)]; }

  std::vector<Point_2>& m_points;
  std::vector<Triangle>& m_triangles;
  std::vector<int>& m_regions;
  std::map<std::pair<int, int>, std::size_t> m_triangle_of; ///< by directed edge
  std::set<std::pair<int, int>> m_on_curve;
};

} // namespace internal
} // namespace Quadrille

#endif
