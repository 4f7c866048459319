// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_COLLAPSED_LAYOUT_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_COLLAPSED_LAYOUT_H

#include <Quadrille/Quad_extraction/internal/at.h>
#include <Quadrille/Quad_layout.h>

#include <numeric>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// What remains of a layout whose arcs have integer lengths.
///
/// An arc of length n is divided into n *unit edges* by n + 1 *points*; those at its ends are the layout's nodes. An
/// arc of length 0 makes its nodes one vertex; a patch of width 0 identifies its two sides, unit edge by unit edge.
class Collapsed_layout {
public:
  /// Two points that become one vertex, or two unit edges that become one, because an arc or a patch vanishes.
  struct Link {
    int a;
    int b;
    int arc;   ///< of length 0, or -1
    int patch; ///< of width 0, or -1
  };

  /// \pre the sums of the lengths of opposite sides of every patch agree. The layout must outlive the object.
  /// Complexity: the sum of all lengths, practically.
  Collapsed_layout(const Quad_layout& layout, std::vector<int> arc_length)
      : m_layout(&layout), m_length(std::move(arc_length))
  {
    m_first_point.push_back(size_of(layout.nodes));
    m_first_edge.push_back(0);
    for (const int length : m_length) {
      m_first_point.push_back(m_first_point.back() + (length > 0 ? length - 1 : 0));
      m_first_edge.push_back(m_first_edge.back() + length);
    }
    link_points();
    number_classes(m_point_links, m_first_point.back(), m_vertex_of, m_n_vertices);
    number_classes(m_edge_links, m_first_edge.back(), m_edge_class_of, m_n_edge_classes);
    m_critical.assign(std::size_t(m_n_vertices), -1);
    for (int i = 0; i < size_of(layout.nodes); ++i)
      if (at(layout.nodes, i).critical)
        at(m_critical, vertex(i)) = i;
  }

  const Quad_layout& layout() const { return *m_layout; }
  int length(int arc) const { return at(m_length, arc); }
  int side_length(int patch, int side) const
  {
    int sum = 0;
    for (const int h : at(at(m_layout->patches, patch).sides, side))
      sum += length(h / 2);
    return sum;
  }

  int number_of_points() const { return m_first_point.back(); }
  int number_of_edges() const { return m_first_edge.back(); }
  /// Point `i` of half-arc `h`, from its source to its target.
  int point(int h, int i) const
  {
    const int n = length(h / 2);
    if (h % 2)
      i = n - i;
    if (i == 0)
      return at(m_layout->arcs, h / 2).source;
    return i == n ? at(m_layout->arcs, h / 2).target : at(m_first_point, h / 2) + i - 1;
  }
  /// The unit edge of half-arc `h` from point `i` to point `i + 1`.
  int edge(int h, int i) const { return at(m_first_edge, h / 2) + (h % 2 ? length(h / 2) - 1 - i : i); }

  int number_of_vertices() const { return m_n_vertices; }
  int number_of_edge_classes() const { return m_n_edge_classes; }
  /// What points and unit edges become.
  int vertex(int point) const { return at(m_vertex_of, point); }
  int edge_class(int edge) const { return at(m_edge_class_of, edge); }

  /// The critical node that became this vertex, or -1.
  int critical_node(int vertex) const { return at(m_critical, vertex); }

  const std::vector<Link>& point_links() const { return m_point_links; }
  const std::vector<Link>& edge_links() const { return m_edge_links; }

  /// The points along a side of a patch, from its first to its last corner.
  std::vector<int> side_points(int patch, int side) const
  {
    const std::vector<int>& half_arcs = at(at(m_layout->patches, patch).sides, side);
    std::vector<int> points = {m_layout->source(half_arcs.front())};
    for (const int h : half_arcs)
      for (int i = 1; i <= length(h / 2); ++i)
        points.push_back(point(h, i));
    return points;
  }

private:
  void link_points()
  {
    for (int a = 0; a < size_of(m_length); ++a)
      if (length(a) == 0)
        m_point_links.push_back({at(m_layout->arcs, a).source, at(m_layout->arcs, a).target, a, -1});
    for (int p = 0; p < size_of(m_layout->patches); ++p)
      for (int side = 0; side < 2; ++side) {
        const int n = side_length(p, side);
        if (n == 0 || side_length(p, side + 1) > 0)
          continue;
        const std::vector<int> near = side_points(p, side);
        const std::vector<int> far = side_points(p, side + 2);
        const std::vector<int> near_edges = side_edges(p, side);
        const std::vector<int> far_edges = side_edges(p, side + 2);
        for (int i = 0; i < n; ++i) {
          if (i > 0)
            m_point_links.push_back({at(near, i), at(far, n - i), -1, p});
          m_edge_links.push_back({at(near_edges, i), at(far_edges, n - 1 - i), -1, p});
        }
      }
  }

  std::vector<int> side_edges(int patch, int side) const
  {
    std::vector<int> edges;
    for (const int h : at(at(m_layout->patches, patch).sides, side))
      for (int i = 0; i < length(h / 2); ++i)
        edges.push_back(edge(h, i));
    return edges;
  }

  /// Numbers the classes of linked elements in the order of their first elements.
  static void number_classes(const std::vector<Link>& links, int n, std::vector<int>& class_of, int& n_classes)
  {
    std::vector<int> parent(std::size_t(n), 0);
    std::iota(parent.begin(), parent.end(), 0);
    const auto find = [&parent](int i) {
      while (at(parent, i) != i)
        i = at(parent, i) = at(parent, at(parent, i));
      return i;
    };
    for (const Link& link : links) {
      const int a = find(link.a);
      const int b = find(link.b);
      at(parent, a < b ? b : a) = a < b ? a : b;
    }
    n_classes = 0;
    class_of.resize(std::size_t(n));
    for (int i = 0; i < n; ++i)
      at(class_of, i) = find(i) == i ? n_classes++ : at(class_of, find(i));
  }

  const Quad_layout* m_layout;
  std::vector<int> m_length;
  std::vector<int> m_first_point; ///< by arc: id of its first inner point
  std::vector<int> m_first_edge;
  std::vector<Link> m_point_links;
  std::vector<Link> m_edge_links;
  std::vector<int> m_vertex_of;
  std::vector<int> m_edge_class_of;
  std::vector<int> m_critical; ///< by vertex
  int m_n_vertices = 0;
  int m_n_edge_classes = 0;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
