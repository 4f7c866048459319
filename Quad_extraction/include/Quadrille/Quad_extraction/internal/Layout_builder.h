// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_LAYOUT_BUILDER_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_LAYOUT_BUILDER_H

#include <Quadrille/Quad_extraction/internal/Separatrices.h>
#include <Quadrille/Quad_extraction/internal/Strip_decomposition.h>
#include <Quadrille/Quad_extraction/internal/Trace_crossings.h>
#include <Quadrille/Quad_layout.h>

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// The layout of the separatrices: nodes, arcs between them, and the quadrilateral patches that they bound.
///
/// Around every node the axis directions carry arcs, one right angle apart; only where a separatrix ends on another one
/// or on a feature, the direction opposite to it has none. So the corners of all patches are right angles, and by the
/// theorem of Gauss and Bonnet there are exactly four.
class Layout_builder {
public:
  Layout_builder(const Seamless_map& map, const Separatrices& separatrices)
      : m_map(map), m_mesh(map.mesh()), m_separatrices(separatrices), m_trace_events(separatrices.traces().size()),
        m_edge_events(std::size_t(m_mesh.number_of_halfedges()))
  {
  }

  Quad_layout build()
  {
    add_vertex_nodes();
    add_edge_nodes();
    add_crossing_nodes();
    add_trace_arcs();
    add_curve_arcs();
    add_patches();
    m_layout.strips = decompose_into_strips(m_layout);
    return std::move(m_layout);
  }

private:
  /// Something that a trace meets: a node, and the half-arcs' slots there ahead of and behind the trace.
  struct Trace_event {
    double position;
    int node;
    int step; ///< the node lies in this step's triangle, for an edge node at its exit
    bool at_exit;
    int slot_ahead;
    int slot_behind;
  };
  /// A node on a constrained edge, measured from the source of its canonical halfedge.
  struct Edge_event {
    double position;
    int node;
    int slot_ahead;
    int slot_behind;
  };

  int canonical(int h) const { return m_mesh.is_boundary(h) ? h : std::min(h, m_mesh.opposite(h)); }

  /// Nodes on an isoline that goes straight on count their slots from its direction.
  enum class Node_kind : char { on_border, interior, on_isoline };

  int add_node(const Quad_layout::Node& node, int slots, Node_kind kind)
  {
    m_layout.nodes.push_back(node);
    m_slots.emplace_back(std::size_t(slots), -1);
    m_kind.push_back(kind);
    return size_of(m_layout.nodes) - 1;
  }

  Quad_layout::Mesh_point point_in_face(int f, const Uv& p) const
  {
    const Uv& a = m_map.uv(3 * f);
    const Uv& b = m_map.uv(3 * f + 1);
    const Uv& c = m_map.uv(3 * f + 2);
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    Quad_layout::Mesh_point point;
    point.face = f;
    point.b1 = ((p[0] - a[0]) * (c[1] - a[1]) - (p[1] - a[1]) * (c[0] - a[0])) / area;
    point.b2 = ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / area;
    return point;
  }

  /// The point at fraction `t` of halfedge `h`.
  static Quad_layout::Mesh_point point_on_edge(int h, double t)
  {
    std::array<double, 3> weight = {0, 0, 0};
    weight[std::size_t(h % 3)] = 1 - t;
    weight[std::size_t((h + 1) % 3)] = t;
    return {h / 3, weight[1], weight[2]};
  }

  void add_vertex_nodes()
  {
    for (int i = 0; i < m_separatrices.vertices().size(); ++i) {
      const Layout_vertices::Vertex& vertex = m_separatrices.vertices()[i];
      Quad_layout::Node node;
      node.point = point_on_edge(m_mesh.outgoing(vertex.vertex), 0);
      node.vertex = vertex.vertex;
      node.quadrants = vertex.quadrants;
      node.border = vertex.border;
      node.constrained = vertex.constrained;
      node.critical = vertex.critical;
      add_node(node, vertex.quadrants + (vertex.border ? 1 : 0),
               vertex.border ? Node_kind::on_border : Node_kind::interior);
    }
  }

  /// Nodes where traces cross features or end on curves.
  void add_edge_nodes()
  {
    const std::vector<Trace>& traces = m_separatrices.traces();
    for (int t = 0; t < size_of(traces); ++t)
      for (int s = 0; s < size_of(at(traces, t).steps); ++s) {
        const Isoline_step& step = at(at(traces, t).steps, s);
        if (step.exit < 0 || !m_map.is_constrained(step.exit))
          continue;
        const double position = step.position(m_map.uv(step.exit));
        if (position <= at(traces, t).length)
          add_edge_node(t, s, position);
      }
    for (std::vector<Edge_event>& events : m_edge_events)
      std::sort(events.begin(), events.end(),
                [](const Edge_event& a, const Edge_event& b) { return a.position < b.position; });
  }

  void add_edge_node(int t, int s, double position)
  {
    const Isoline_step& step = at(at(m_separatrices.traces(), t).steps, s);
    const int edge = canonical(step.exit);
    Uv p = step.point(position);
    int direction = step.direction;
    if (edge != step.exit) {
      const Transition& transition = m_map.transition(step.exit);
      p = turned(transition.k, p);
      p = {p[0] + transition.t[0], p[1] + transition.t[1]};
      direction += transition.k;
    }
    const int along_edge = m_map.edge_direction(edge);
    const double from_source = along(along_edge, p) - along(along_edge, m_map.uv(edge));
    const double length = edge_length(edge);
    const bool is_border = m_mesh.is_boundary(edge);
    int slot_ahead = (direction - along_edge + 8) & 3;
    // Two traces may end on a feature at one point, from both sides.
    const int vertex = from_source == 0 ? m_mesh.source(edge) : from_source == length ? m_mesh.target(edge) : -1;
    const auto [place, is_new] = m_node_on_curve.emplace(
        vertex >= 0 ? std::pair(-1 - vertex, 0.0) : std::pair(edge, from_source), Node_on_curve{-1, edge});
    if (is_new) {
      Quad_layout::Node node;
      node.border = is_border;
      node.constrained = true;
      node.quadrants = is_border ? 2 : 4;
      node.point = point_on_edge(edge, from_source / length);
      place->second.node = add_node(node, is_border ? 3 : 4, is_border ? Node_kind::on_border : Node_kind::on_isoline);
      at(m_edge_events, edge).push_back({from_source, place->second.node, 0, 2});
    } else if (place->second.edge != edge &&
               (m_mesh.source(place->second.edge) == vertex) == (m_mesh.source(edge) == vertex)) {
      slot_ahead = (slot_ahead + 2) & 3; // the node counts from the other direction of the curve
    }
    at(m_trace_events, t).push_back({position, place->second.node, s, true, slot_ahead, (slot_ahead + 2) & 3});
  }

  void add_crossing_nodes()
  {
    std::map<std::pair<int, double>, int> node_on_trace; // two traces may end on a third one at one point
    const std::vector<Trace>& traces = m_separatrices.traces();
    for (const Trace_crossing& crossing : find_crossings(m_map, traces)) {
      const std::size_t through = crossing.position[0] < at(traces, crossing.trace[0]).length ? 0 : 1;
      const std::array<int, 2> d = {at(at(traces, crossing.trace[0]).steps, crossing.step[0]).direction,
                                    at(at(traces, crossing.trace[1]).steps, crossing.step[1]).direction};
      const auto [place, is_new] =
          node_on_trace.emplace(std::pair(crossing.trace[through], crossing.position[through]), -1);
      if (is_new) {
        Quad_layout::Node node;
        node.point = point_in_face(crossing.face, crossing.point);
        place->second = add_node(node, 4, Node_kind::on_isoline);
      }
      for (std::size_t i = 0; i < 2; ++i)
        if (i != through || is_new) {
          const int slot = (d[i] - d[through] + 4) & 3;
          at(m_trace_events, crossing.trace[i])
              .push_back({crossing.position[i], place->second, crossing.step[i], false, slot, (slot + 2) & 3});
        }
    }
  }

  /// Registers an arc whose points are complete; `slots` are those at its source and target.
  void add_arc(Quad_layout::Arc arc, int source_slot, int target_slot, int left_region, int right_region)
  {
    if (!(arc.length > 0))
      throw No_result_error("layout", "two nodes of the layout coincide in the map");
    const int a = size_of(m_layout.arcs);
    for (int end = 0; end < 2; ++end) {
      int& slot = at(at(m_slots, end ? arc.target : arc.source), end ? target_slot : source_slot);
      if (slot >= 0)
        throw No_result_error("layout", "two arcs leave a node of the layout in one direction");
      slot = 2 * a + end;
    }
    m_slot_of.push_back(source_slot);
    m_slot_of.push_back(target_slot);
    m_half_arc_region.push_back(left_region);
    m_half_arc_region.push_back(right_region);
    m_layout.arcs.push_back(std::move(arc));
  }

  void add_trace_arcs()
  {
    for (int t = 0; t < size_of(m_trace_events); ++t) {
      const Trace& trace = at(m_separatrices.traces(), t);
      std::vector<Trace_event>& events = at(m_trace_events, t);
      events.push_back({0, trace.source, 0, false, trace.source_slot, -1});
      if (trace.target >= 0)
        events.push_back({trace.length, trace.target, size_of(trace.steps) - 1, false, -1, trace.target_slot});
      std::sort(events.begin(), events.end(),
                [](const Trace_event& a, const Trace_event& b) { return a.position < b.position; });
      m_layout.separatrices.emplace_back();
      for (std::size_t i = 0; i + 1 < events.size(); ++i) {
        m_layout.separatrices.back().push_back(2 * size_of(m_layout.arcs));
        add_trace_arc(trace, events[i], events[i + 1]);
      }
    }
  }

  void add_trace_arc(const Trace& trace, const Trace_event& from, const Trace_event& to)
  {
    Quad_layout::Arc arc;
    arc.source = from.node;
    arc.target = to.node;
    arc.length = to.position - from.position;
    const int first_step = from.at_exit ? from.step + 1 : from.step;
    for (int s = first_step; s <= to.step; ++s) {
      const Isoline_step& step = at(trace.steps, s);
      Quad_layout::Arc_point point;
      if (s == first_step) {
        point.point = at(m_layout.nodes, from.node).point;
      } else {
        const int entry = at(trace.steps, s - 1).exit;
        const Isoline_step& before = at(trace.steps, s - 1);
        const Uv& a = m_map.uv(entry);
        const Uv& b = m_map.uv(Indexed_triangulation::next(entry));
        const double from_a = before.level - along(before.direction + 1, a);
        const double t = from_a / (along(before.direction + 1, b) - along(before.direction + 1, a));
        point.point = point_on_edge(entry, t);
        const double position = (1 - t) * before.position(a) + t * before.position(b) - from.position;
        point.position = std::min(std::max(position, arc.points.back().position), arc.length);
      }
      point.face = step.face;
      point.direction = step.direction;
      point.level = step.level;
      point.offset = step.offset - from.position;
      arc.points.push_back(point);
    }
    Quad_layout::Arc_point last;
    last.point = at(m_layout.nodes, to.node).point;
    last.position = arc.length;
    arc.points.push_back(last);
    const int region = m_map.region(arc.points.front().face);
    add_arc(std::move(arc), from.slot_ahead, to.slot_behind, region, region);
  }

  /// Walks along the curves: first from the layout vertices, then around the loops that have none.
  void add_curve_arcs()
  {
    std::vector<char> visited(m_edge_events.size(), 0);
    const Layout_vertices& vertices = m_separatrices.vertices();
    for (int v = 0; v < vertices.size(); ++v)
      m_map.for_each_slot(vertices[v].vertex, [&](int slot, int h, int direction) {
        // A curve leaves along the first side of a corner.
        if (m_map.is_constrained(h) && m_map.edge_direction(h) == direction && !at(visited, canonical(h)))
          walk_curve(h, -1, v, slot, !vertices[v].critical, visited);
      });
    for (const std::vector<int>& loop : m_separatrices.loops())
      if (!at(visited, canonical(loop.front()))) {
        const auto start =
            std::find_if(loop.begin(), loop.end(), [&](int h) { return !at(m_edge_events, canonical(h)).empty(); });
        const std::vector<Edge_event> events = events_along(*start);
        walk_curve(*start, 0, events.front().node, events.front().slot_ahead, true, visited);
      }
  }

  /// The nodes on constrained halfedge `h`, in its direction.
  std::vector<Edge_event> events_along(int h) const
  {
    std::vector<Edge_event> events = at(m_edge_events, canonical(h));
    if (canonical(h) != h) {
      std::reverse(events.begin(), events.end());
      for (Edge_event& event : events) {
        event.position = edge_length(h) - event.position;
        std::swap(event.slot_ahead, event.slot_behind);
      }
    }
    return events;
  }

  double edge_length(int h) const
  {
    const int d = m_map.edge_direction(h);
    return along(d, m_map.uv(Indexed_triangulation::next(h))) - along(d, m_map.uv(h));
  }

  /// Adds the arcs of the curve that starts on halfedge `start` at its source (`start_event` = -1) or at its event
  /// `start_event`, which is node `node`, up to the next layout vertex or back to the start.
  void walk_curve(int start, int start_event, int node, int slot, bool loop, std::vector<char>& visited)
  {
    Quad_layout::Curve_chain chain;
    chain.loop = loop;
    Quad_layout::Arc arc;
    double begin = 0; // position of the arc's source relative to the source of the current halfedge
    const auto add_point = [&](const Quad_layout::Mesh_point& point, int h) {
      Quad_layout::Arc_point on_curve;
      on_curve.point = point;
      on_curve.face = h / 3;
      on_curve.halfedge = h;
      on_curve.direction = m_map.edge_direction(h);
      on_curve.level = along(on_curve.direction + 1, m_map.uv(h));
      on_curve.offset = -along(on_curve.direction, m_map.uv(h)) - begin;
      on_curve.position = arc.points.empty() ? 0 : -begin;
      arc.points.push_back(on_curve);
    };
    const auto finish = [&](int target, int target_slot, double position) {
      arc.source = node;
      arc.target = target;
      arc.length = position - begin;
      Quad_layout::Arc_point last;
      last.point = at(m_layout.nodes, target).point;
      last.position = arc.length;
      arc.points.push_back(last);
      const int h = arc.points.front().halfedge;
      arc.curve = m_map.curve(h);
      arc.border = m_mesh.is_boundary(h);
      chain.half_arcs.push_back(2 * size_of(m_layout.arcs));
      add_arc(std::move(arc), slot, target_slot, m_map.region(h / 3),
              arc.border ? -1 : m_map.region(m_mesh.opposite(h) / 3));
      arc = Quad_layout::Arc();
    };
    int h = start;
    int next_event = start_event + 1;
    if (start_event >= 0)
      begin = at(events_along(h), start_event).position;
    add_point(at(m_layout.nodes, node).point, h);
    while (true) {
      at(visited, canonical(h)) = 1;
      const std::vector<Edge_event> events = events_along(h);
      for (; next_event < size_of(events); ++next_event) {
        const Edge_event& event = at(events, next_event);
        finish(event.node, event.slot_behind, event.position);
        if (h == start && next_event == start_event) {
          m_layout.chains.push_back(std::move(chain));
          return;
        }
        node = event.node;
        slot = event.slot_ahead;
        begin = event.position;
        add_point(at(m_layout.nodes, node).point, h);
      }
      next_event = 0;
      const int end = m_separatrices.vertices().index(m_mesh.target(h));
      if (end >= 0) {
        finish(end, arrival_slot(h), edge_length(h));
        m_layout.chains.push_back(std::move(chain));
        return;
      }
      begin -= edge_length(h);
      h = m_separatrices.vertices().next_on_curve(h);
      add_point(point_on_edge(h, 0), h);
    }
  }

  /// Slot at the target of constrained halfedge `h` that points back along it.
  int arrival_slot(int h) const
  {
    if (m_mesh.is_boundary(h))
      return m_map.quadrants(m_mesh.target(h));
    const int back = m_mesh.opposite(h);
    return m_map.slot(back, m_map.edge_direction(back));
  }

  /// The half-arc that follows `h` around the patch on its left, and whether there is a corner between them.
  std::pair<int, bool> next_around_patch(int h) const
  {
    const int node = m_layout.target(h);
    const std::vector<int>& slots = at(m_slots, node);
    int slot = at(m_slot_of, h ^ 1);
    for (const bool is_corner : {true, false}) {
      if (slot == 0 && at(m_kind, node) == Node_kind::on_border)
        break;
      slot = slot == 0 ? size_of(slots) - 1 : slot - 1;
      if (at(slots, slot) >= 0)
        return {at(slots, slot), is_corner};
    }
    throw No_result_error("layout", "the outline of a patch of the layout ends");
  }

  void add_patches()
  {
    for (int n = 0; n < size_of(m_slots); ++n)
      for (int slot = 0; slot < size_of(at(m_slots, n)); ++slot)
        if (at(at(m_slots, n), slot) < 0 && (at(m_kind, n) != Node_kind::on_isoline || slot % 2 == 0))
          throw No_result_error("layout", "a direction of a node of the layout has no arc");
    m_layout.left_patch.assign(2 * m_layout.arcs.size(), -1);
    for (int start = 0; start < size_of(m_layout.left_patch); ++start) {
      const bool outside = at(m_layout.arcs, start / 2).border && start % 2 == 1;
      if (!outside && at(m_layout.left_patch, start) < 0)
        add_patch(start);
    }
  }

  void add_patch(int start)
  {
    std::vector<std::vector<int>> sides(1);
    bool is_corner = false;
    int h = start;
    do {
      if (is_corner)
        sides.emplace_back();
      sides.back().push_back(h);
      at(m_layout.left_patch, h) = size_of(m_layout.patches);
      std::tie(h, is_corner) = next_around_patch(h);
      if (h != start && at(m_layout.left_patch, h) >= 0)
        throw No_result_error("layout", "the outlines of two patches of the layout overlap");
    } while (h != start);
    if (!is_corner && sides.size() > 1) { // the first side starts with the last part
      sides.front().insert(sides.front().begin(), sides.back().begin(), sides.back().end());
      sides.pop_back();
    }
    if (sides.size() != 4)
      throw No_result_error("layout", "a patch of the layout has " + std::to_string(sides.size()) + " sides");
    Quad_layout::Patch patch;
    patch.region = at(m_half_arc_region, start);
    std::move(sides.begin(), sides.end(), patch.sides.begin());
    m_layout.patches.push_back(std::move(patch));
  }

  const Seamless_map& m_map;
  const Indexed_triangulation& m_mesh;
  const Separatrices& m_separatrices;
  Quad_layout m_layout;
  std::vector<std::vector<int>> m_slots; ///< by node: the half-arcs that leave it, counterclockwise
  std::vector<Node_kind> m_kind;         ///< by node
  std::vector<int> m_slot_of;            ///< by half-arc: its slot at its source
  std::vector<int> m_half_arc_region;
  std::vector<std::vector<Trace_event>> m_trace_events; ///< by trace
  std::vector<std::vector<Edge_event>> m_edge_events;   ///< by canonical halfedge
  struct Node_on_curve {
    int node;
    int edge; ///< canonical; the node counts its slots from its direction
  };
  std::map<std::pair<int, double>, Node_on_curve> m_node_on_curve; ///< by edge and position, or -1 - vertex and 0
};

/// \throws No_result_error as documented at `extract_quads`.
inline Quad_layout build_layout(const Seamless_map& map, const std::vector<char>& kept, Layout_kind kind,
                                std::size_t max_steps)
{
  const Separatrices separatrices(map, kept, kind, max_steps);
  Quad_layout layout = Layout_builder(map, separatrices).build();
  layout.kind = kind;
  return layout;
}

} // namespace internal::extraction
} // namespace Quadrille

#endif
