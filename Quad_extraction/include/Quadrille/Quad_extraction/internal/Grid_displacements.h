// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_GRID_DISPLACEMENTS_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_GRID_DISPLACEMENTS_H

#include <Quadrille/Map_displacement.h>
#include <Quadrille/Quad_extraction/internal/Seamless_map.h>
#include <Quadrille/Quad_extraction/internal/at.h>
#include <Quadrille/Quad_layout.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// The displacements that make an integer-grid map of a seamless one, by the integer lengths of its layout's arcs.
///
/// Critical nodes are vertices of the triangulation. Every other node belongs to the critical one that is fewest arcs
/// away, and every arc between two nodes closes a path between theirs. Curves without a critical node, and components
/// without any, have a place of their own to start from, whose coordinates are not all known: along the curve, or both.
class Grid_displacements {
public:
  Grid_displacements(const Seamless_map& map, const Quad_layout& layout, const std::vector<int>& lengths)
      : m_map(map), m_layout(layout), m_lengths(lengths), m_leaving(layout.nodes.size()),
        m_origin(layout.nodes.size(), -1), m_arrival(layout.nodes.size(), -1)
  {
    for (int a = 0; a < size_of(layout.arcs); ++a)
      for (const int half_arc : {2 * a, 2 * a + 1})
        at(m_leaving, layout.source(half_arc)).push_back(half_arc);
  }

  /// Complexity: linear in the points of all arcs, times the arcs between nodes and their critical ones.
  std::vector<Map_displacement> run()
  {
    for (int i = 0; i < size_of(m_layout.nodes); ++i)
      if (at(m_layout.nodes, i).critical)
        add_origin(i, {});
    for (const Quad_layout::Curve_chain& chain : m_layout.chains)
      if (chain.loop) {
        const Quad_layout::Arc& arc = m_layout.arc_of(chain.half_arcs.front());
        add_origin(arc.source, {arc.points.front().halfedge, 1 - (arc.points.front().direction & 1)});
      }
    grow();
    for (int i = 0; i < size_of(m_layout.nodes); ++i)
      if (at(m_origin, i) < 0) {
        add_origin(i, {3 * at(m_layout.nodes, i).point.face, neither});
        grow();
      }
    std::vector<Map_displacement> result;
    for (int a = 0; a < size_of(m_layout.arcs); ++a)
      if (at(m_arrival, m_layout.target(2 * a)) != 2 * a && at(m_arrival, m_layout.source(2 * a)) != 2 * a + 1)
        if (std::optional<Map_displacement> displacement = close_path(a))
          result.push_back(std::move(*displacement));
    return result;
  }

private:
  static constexpr int both = -1, neither = -2;

  /// Where paths begin and end. Of a critical node, the corner is that in the face in which a path leaves it.
  struct Origin {
    int corner = -1;
    int known_axis = both; ///< coordinates of the origin that are those of the corner
  };

  struct Walk {
    int face = -1;
    int quarters = 0; ///< by which the charts have turned since the start
    std::array<int, 2> value = {0, 0};
    std::vector<int> crossed;
  };

  void add_origin(int node, const Origin& origin)
  {
    if (at(m_origin, node) >= 0)
      return;
    at(m_origin, node) = size_of(m_origins);
    m_origins.push_back(origin);
    m_queue.push(node);
  }

  void grow()
  {
    for (; !m_queue.empty(); m_queue.pop())
      for (const int half_arc : at(m_leaving, m_queue.front())) {
        const int node = m_layout.target(half_arc);
        if (at(m_origin, node) >= 0)
          continue;
        at(m_origin, node) = at(m_origin, m_queue.front());
        at(m_arrival, node) = half_arc;
        m_queue.push(node);
      }
  }

  /// Half-arcs from the origin of `node` to it.
  std::vector<int> path_to(int node) const
  {
    std::vector<int> path;
    for (; at(m_arrival, node) >= 0; node = m_layout.source(path.back()))
      path.push_back(at(m_arrival, node));
    std::reverse(path.begin(), path.end());
    return path;
  }

  std::optional<Map_displacement> close_path(int arc) const
  {
    std::vector<int> path = path_to(m_layout.source(2 * arc));
    path.push_back(2 * arc);
    const std::vector<int> back = path_to(m_layout.target(2 * arc));
    for (auto half_arc = back.rbegin(); half_arc != back.rend(); ++half_arc)
      path.push_back(*half_arc ^ 1);
    const int first = m_layout.source(path.front());
    const int last = m_layout.target(path.back());
    const Origin& start = at(m_origins, at(m_origin, first));
    const Origin& end = at(m_origins, at(m_origin, last));

    Walk walk;
    walk.face = start.corner < 0 ? face_of_part(path.front(), 0) : start.corner / 3;
    Map_displacement result;
    result.source_corner = start.corner < 0 ? corner_in(walk.face, at(m_layout.nodes, first).vertex) : start.corner;
    for (const int half_arc : path)
      follow(half_arc, walk);
    if (end.corner >= 0)
      go_to(end.corner / 3, walk);
    result.target_corner = end.corner < 0 ? corner_in(walk.face, at(m_layout.nodes, last).vertex) : end.corner;
    const bool is_loop = first == last && (walk.quarters & 3) == 0; // what is not known of the origin cancels
    bool is_any = false;
    for (int c = 0; c < 2; ++c) {
      const int at_start = walk.quarters % 2 == 0 ? c : 1 - c;
      if (is_loop || (is_known(start, at_start) && is_known(end, c))) {
        result.value[std::size_t(c)] = walk.value[std::size_t(c)];
        is_any = true;
      }
    }
    result.crossed_halfedges = std::move(walk.crossed);
    return is_any ? std::optional(std::move(result)) : std::nullopt;
  }

  static bool is_known(const Origin& origin, int axis)
  {
    return origin.known_axis == both || origin.known_axis == axis;
  }

  const Quad_layout::Arc_point& part(int half_arc, std::size_t i) const
  {
    const std::vector<Quad_layout::Arc_point>& points = m_layout.arc_of(half_arc).points;
    return points[half_arc % 2 == 0 ? i : points.size() - 2 - i];
  }
  int face_of_part(int half_arc, std::size_t i) const { return part(half_arc, i).face; }

  void follow(int half_arc, Walk& walk) const
  {
    for (std::size_t i = 0; i + 1 < m_layout.arc_of(half_arc).points.size(); ++i) {
      go_to(face_of_part(half_arc, i), walk);
      if (i > 0)
        continue;
      const int direction = part(half_arc, 0).direction + 2 * (half_arc % 2);
      walk.value[std::size_t(direction & 1)] +=
          (direction & 2) != 0 ? -at(m_lengths, half_arc / 2) : at(m_lengths, half_arc / 2);
    }
  }

  /// To a face that shares an edge, or a vertex without a singularity, with the one so far.
  void go_to(int face, Walk& walk) const
  {
    const Indexed_triangulation& mesh = m_map.mesh();
    if (face == walk.face)
      return;
    for (int h = 3 * walk.face; h < 3 * walk.face + 3; ++h)
      if (mesh.opposite(h) >= 0 && mesh.opposite(h) / 3 == face)
        return cross(h, walk);
    for (int h = 3 * walk.face; h < 3 * walk.face + 3; ++h)
      if (corner_in(face, mesh.source(h)) >= 0 && turn_to(face, h, walk))
        return;
    throw No_result_error("layout", "an arc jumps from triangle " + std::to_string(walk.face) + " to triangle " +
                                        std::to_string(face));
  }

  /// Around the vertex that `corner` belongs to, counterclockwise or, if the border is in the way, clockwise.
  bool turn_to(int face, int corner, Walk& walk) const
  {
    const Indexed_triangulation& mesh = m_map.mesh();
    for (const bool counterclockwise : {true, false}) {
      Walk turned = walk;
      for (int h = corner; h >= 0;) {
        const int side = counterclockwise ? Indexed_triangulation::prev(h) : h;
        if (mesh.opposite(side) < 0)
          break;
        cross(side, turned);
        h = counterclockwise ? mesh.opposite(side) : Indexed_triangulation::next(mesh.opposite(side));
        if (turned.face == face) {
          walk = std::move(turned);
          return true;
        }
        if (h == corner)
          break;
      }
    }
    return false;
  }

  void cross(int h, Walk& walk) const
  {
    const int k = m_map.transition(h).k;
    const std::array<int, 2> value = walk.value;
    walk.value = k == 0   ? value
                 : k == 1 ? std::array<int, 2>{-value[1], value[0]}
                 : k == 2 ? std::array<int, 2>{-value[0], -value[1]}
                          : std::array<int, 2>{value[1], -value[0]};
    walk.quarters = (walk.quarters + k) & 3;
    walk.crossed.push_back(h);
    walk.face = m_map.mesh().opposite(h) / 3;
  }

  /// The corner of a vertex in a face, -1 if it has none.
  int corner_in(int face, int vertex) const
  {
    for (int h = 3 * face; h < 3 * face + 3; ++h)
      if (m_map.mesh().source(h) == vertex)
        return h;
    return -1;
  }

  const Seamless_map& m_map;
  const Quad_layout& m_layout;
  const std::vector<int>& m_lengths;
  std::vector<std::vector<int>> m_leaving; ///< by node: half-arcs
  std::vector<int> m_origin;               ///< by node
  std::vector<int> m_arrival;              ///< by node: the last half-arc from its origin, -1 for the origin itself
  std::vector<Origin> m_origins;
  std::queue<int> m_queue;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
