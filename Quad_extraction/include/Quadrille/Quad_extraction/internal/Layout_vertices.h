// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_LAYOUT_VERTICES_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_LAYOUT_VERTICES_H

#include <Quadrille/Quad_extraction/internal/Seamless_map.h>

#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// The vertices of the triangulation that every layout must have as nodes, and what leaves them.
///
/// *Critical* are interior vertices with other than 4 right angles, border vertices with other than 2, vertices where
/// the curve id changes, and ends, corners and junctions of feature curves. `add_seed` makes a regular vertex a node
/// too.
class Layout_vertices {
public:
  struct Port {
    int corner;    ///< the trace starts in this corner's triangle,
    int direction; ///< in this direction of its chart,
    int slot;      ///< which has this number around the vertex
  };
  struct Vertex {
    int vertex = -1;
    int quadrants = 0;
    bool border = false;
    bool constrained = false; ///< on the border or on a feature curve
    bool critical = false;    ///< false: a seed
    std::vector<Port> ports;  ///< directions strictly inside the sectors between curves
  };

  /// `kept`, by vertex: others that count as critical. Complexity: linear.
  Layout_vertices(const Seamless_map& map, const std::vector<char>& kept)
      : m_map(&map), m_index(std::size_t(map.mesh().number_of_vertices()), -1)
  {
    for (int v = 0; v < map.mesh().number_of_vertices(); ++v)
      if (map.mesh().outgoing(v) >= 0 && (at(kept, v) || is_critical(v)))
        add(v, true);
  }

  void add_seed(int v) { add(v, false); }

  int size() const { return size_of(m_vertices); }
  const Vertex& operator[](int i) const { return at(m_vertices, i); }
  /// Index of mesh vertex `v` among these, or -1.
  int index(int v) const { return at(m_index, v); }

  /// The constrained halfedge that continues the curve of `h` beyond its target, which is no layout vertex.
  int next_on_curve(int h) const
  {
    const Indexed_triangulation& mesh = m_map->mesh();
    if (mesh.is_boundary(h))
      return mesh.next_on_boundary(h);
    const int back = mesh.opposite(h);
    int next = mesh.next_around_source(back);
    while (!m_map->is_constrained(next))
      next = mesh.next_around_source(next);
    return next;
  }

private:
  /// Slots of the curve edges that leave `v` and their curve ids; the arriving border edge is left out.
  struct Curves_at_vertex {
    std::vector<std::pair<int, int>> slot_and_curve;
    int quadrants = 0;
  };

  Curves_at_vertex curves_at(int v) const
  {
    Curves_at_vertex result;
    std::array<int, 2> axes = {};
    const int start = m_map->mesh().outgoing(v);
    int h = start;
    do {
      if (m_map->is_constrained(h))
        result.slot_and_curve.emplace_back(result.quadrants, m_map->curve(h));
      result.quadrants += m_map->corner_axes(h, axes);
      h = m_map->mesh().next_around_source(h);
    } while (h >= 0 && h != start);
    return result;
  }

  bool is_critical(int v) const
  {
    const Curves_at_vertex here = curves_at(v);
    const auto& curves = here.slot_and_curve;
    if (m_map->mesh().is_boundary_vertex(v))
      return here.quadrants != 2 || curves.size() != 1 || curves[0].second != arriving_border_curve(v);
    if (here.quadrants != 4 || curves.size() == 1 || curves.size() > 2)
      return true;
    return curves.size() == 2 && (curves[0].second != curves[1].second || curves[1].first - curves[0].first != 2);
  }

  int arriving_border_curve(int v) const
  {
    const Indexed_triangulation& mesh = m_map->mesh();
    int last = mesh.outgoing(v);
    for (int h = last; h >= 0; h = mesh.next_around_source(h))
      last = h;
    return m_map->curve(Indexed_triangulation::prev(last));
  }

  void add(int v, bool critical)
  {
    const Curves_at_vertex here = curves_at(v);
    Vertex vertex;
    vertex.vertex = v;
    vertex.quadrants = here.quadrants;
    vertex.border = m_map->mesh().is_boundary_vertex(v);
    vertex.constrained = vertex.border || !here.slot_and_curve.empty();
    vertex.critical = critical;
    if (here.quadrants == 0)
      throw Invalid_input_error("the map turns by less than a right angle around vertex " + std::to_string(v));
    m_map->for_each_slot(v, [&](int slot, int corner, int direction) {
      for (const auto& curve : here.slot_and_curve)
        if (curve.first == slot)
          return;
      vertex.ports.push_back({corner, direction, slot});
    });
    at(m_index, v) = size();
    m_vertices.push_back(std::move(vertex));
  }

  const Seamless_map* m_map;
  std::vector<Vertex> m_vertices;
  std::vector<int> m_index;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
