// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_TRIANGLE_ADJACENCY_H
#define QUADRILLE_MESH_IO_INTERNAL_TRIANGLE_ADJACENCY_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Which triangles share an edge, whatever their orientation, what they form together, and which would have to be
/// turned around so that all have the same side up. Complexity: O(n log n).
class Triangle_adjacency {
public:
  using Triangle = std::array<int, 3>;

  /// Edge `edge` of a triangle goes from its corner `edge` to the next one.
  struct Side {
    std::size_t triangle = 0, edge = 0;
  };
  struct Crowded_edge {
    std::array<int, 2> ends;
    std::vector<std::size_t> triangles; ///< three or more
  };

  explicit Triangle_adjacency(const std::vector<Triangle>& triangles) : m_triangles(triangles)
  {
    pair_sides();
    find_components();
  }

  /// Edges with more than two triangles, which count as borders in everything else. Sorted by their ends.
  const std::vector<Crowded_edge>& crowded_edges() const { return m_crowded_edges; }
  /// Edges with one triangle, sorted by their ends.
  const std::vector<Side>& border() const { return m_border; }
  /// The triangle on the other side of an edge; -1 on the border.
  int neighbor(std::size_t triangle, std::size_t edge) const { return m_neighbors[triangle][edge]; }

  int number_of_components() const { return m_n_components; }
  int component(std::size_t triangle) const { return m_component[triangle]; }
  /// Whether a triangle is oriented otherwise than the first one of its component.
  bool is_turned(std::size_t triangle) const { return m_is_turned[triangle]; }
  /// Edges across which no consistent orientation can be continued; none if the triangles are orientable.
  const std::vector<Side>& one_sided_edges() const { return m_one_sided_edges; }

  /// Whether the triangles on both sides of an inner edge pass it in the same direction.
  bool is_oriented_differently(const Side& side) const
  {
    const Triangle& t = m_triangles[side.triangle];
    const int other = neighbor(side.triangle, side.edge);
    return other >= 0 && has_edge(m_triangles[std::size_t(other)], t[side.edge], t[(side.edge + 1) % 3]);
  }

private:
  static bool has_edge(const Triangle& t, int a, int b)
  {
    return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
  }

  void pair_sides()
  {
    using Item = std::pair<std::array<int, 2>, Side>; // ends in ascending order
    std::vector<Item> items;
    items.reserve(3 * m_triangles.size());
    for (std::size_t t = 0; t < m_triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [a, b] = std::minmax(m_triangles[t][i], m_triangles[t][(i + 1) % 3]);
        items.push_back({{a, b}, {t, i}});
      }
    std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
      return std::pair(a.first, a.second.triangle) < std::pair(b.first, b.second.triangle);
    });
    m_neighbors.assign(m_triangles.size(), {-1, -1, -1});
    for (std::size_t begin = 0, end = 0; begin < items.size(); begin = end) {
      while (end < items.size() && items[end].first == items[begin].first)
        ++end;
      const Side a = items[begin].second;
      if (end - begin == 1) {
        m_border.push_back(a);
      } else if (end - begin == 2) {
        const Side b = items[begin + 1].second;
        m_neighbors[a.triangle][a.edge] = int(b.triangle);
        m_neighbors[b.triangle][b.edge] = int(a.triangle);
      } else {
        m_crowded_edges.push_back({items[begin].first, {}});
        for (std::size_t i = begin; i < end; ++i)
          m_crowded_edges.back().triangles.push_back(items[i].second.triangle);
      }
    }
  }

  void find_components()
  {
    m_component.assign(m_triangles.size(), -1);
    m_is_turned.assign(m_triangles.size(), 0);
    for (std::size_t seed = 0; seed < m_triangles.size(); ++seed) {
      if (m_component[seed] >= 0)
        continue;
      std::vector<std::size_t> stack = {seed};
      m_component[seed] = m_n_components++;
      while (!stack.empty()) {
        const std::size_t t = stack.back();
        stack.pop_back();
        for (std::size_t i = 0; i < 3; ++i) {
          if (neighbor(t, i) < 0)
            continue;
          const std::size_t u = std::size_t(neighbor(t, i));
          const char turned = char(m_is_turned[t] != char(is_oriented_differently({t, i})));
          if (m_component[u] < 0) {
            m_component[u] = m_component[t];
            m_is_turned[u] = turned;
            stack.push_back(u);
          } else if (m_is_turned[u] != turned) {
            m_one_sided_edges.push_back({t, i});
          }
        }
      }
    }
  }

  const std::vector<Triangle>& m_triangles;
  std::vector<std::array<int, 3>> m_neighbors;
  std::vector<Side> m_border;
  std::vector<Crowded_edge> m_crowded_edges;
  std::vector<int> m_component;
  std::vector<char> m_is_turned;
  int m_n_components = 0;
  std::vector<Side> m_one_sided_edges;
};

/// Volumes that the components enclose, positive if normals point outwards once the triangles that `is_turned()` tells
/// are turned around; without a meaning for components with a border.
template <class Point>
std::vector<double> enclosed_volumes(const std::vector<Point>& points,
                                     const std::vector<Triangle_adjacency::Triangle>& triangles,
                                     const Triangle_adjacency& adjacency)
{
  const std::size_t n = std::size_t(adjacency.number_of_components());
  std::vector<double> volumes(n, 0);
  std::vector<const Point*> origins(n, nullptr);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::size_t c = std::size_t(adjacency.component(t));
    const auto point = [&](std::size_t i) -> const Point& { return points[std::size_t(triangles[t][i])]; };
    if (!origins[c])
      origins[c] = &point(0);
    volumes[c] += (adjacency.is_turned(t) ? -1 : 1) * CGAL::volume(*origins[c], point(0), point(1), point(2));
  }
  return volumes;
}

} // namespace internal
} // namespace Quadrille

#endif
