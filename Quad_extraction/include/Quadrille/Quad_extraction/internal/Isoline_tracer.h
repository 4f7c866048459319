// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_ISOLINE_TRACER_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_ISOLINE_TRACER_H

#include <Quadrille/Quad_extraction/internal/Layout_vertices.h>

#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// A directed isoline within one triangle.
///
/// In the triangle's chart it runs along `direction` d and consists of the points p with along(d + 1, p) = `level`; the
/// arc length since the start of the trace is along(d, p) + `offset`. Symbolically it is moved to its left by an
/// infinitesimal amount: a vertex lies left of it if along(d + 1, vertex) > level, otherwise right of it, so it never
/// passes through a vertex.
struct Isoline_step {
  int face = -1;
  int exit = -1; ///< halfedge of `face` through which it leaves, -1 if it ends at a vertex of the triangle
  int direction = 0;
  double level = 0;
  double offset = 0;

  double position(const Uv& p) const { return along(direction, p) + offset; }
  bool is_left(const Uv& p) const { return along(direction + 1, p) > level; }
  /// The point of the isoline (chart of `face`) at arc length `s`.
  Uv point(double s) const { return turned(direction, {s - offset, level}); }
};

/// The halfedge of the step's triangle that the isoline leaves through, -1 if it misses the triangle.
inline int exit_halfedge(const Seamless_map& map, const Isoline_step& step)
{
  for (int h = 3 * step.face; h < 3 * step.face + 3; ++h)
    if (!step.is_left(map.uv(h)) && step.is_left(map.uv(Indexed_triangulation::next(h))))
      return h;
  return -1;
}

/// Continues the isoline in the triangle across `step.exit`, which must not be on the border. The level stays exact;
/// the offset is exact as long as the sum fits.
inline Isoline_step across(const Seamless_map& map, const Isoline_step& step)
{
  const Transition& transition = map.transition(step.exit);
  Isoline_step next;
  next.face = Indexed_triangulation::face(map.mesh().opposite(step.exit));
  next.direction = (step.direction + transition.k) & 3;
  next.level = step.level + along(next.direction + 1, transition.t);
  next.offset = step.offset - along(next.direction, transition.t);
  return next;
}

/// An isoline from a layout vertex to another one, to a curve or to another trace.
struct Trace {
  int source = -1; ///< index of the layout vertex
  int source_slot = -1;
  int target = -1; ///< index of the layout vertex where it ends, or -1
  int target_slot = -1;
  double length = 0;
  /// At least up to `length`; the last one of a trace that ends on a curve leaves through the curve's edge.
  std::vector<Isoline_step> steps;
};

/// Follows isolines by comparing stored doubles: no decision is rounded.
class Isoline_tracer {
public:
  Isoline_tracer(const Seamless_map& map, std::size_t max_steps) : m_map(&map), m_max_steps(max_steps) {}

  /// Where a trace goes on: its next step, and the corner of that triangle that can lie on the isoline.
  struct Front {
    Isoline_step step;
    int apex = -1;
  };

  std::pair<Trace, Front> start(int source, const Layout_vertices::Port& port) const
  {
    const Uv& start = m_map->uv(port.corner);
    std::pair<Trace, Front> result;
    result.first.source = source;
    result.first.source_slot = port.slot;
    Isoline_step& step = result.second.step;
    step.face = Indexed_triangulation::face(port.corner);
    step.direction = port.direction;
    step.level = along(port.direction + 1, start);
    step.offset = -along(port.direction, start);
    result.second.apex = Indexed_triangulation::next(port.corner);
    return result;
  }

  /// Extends the trace by the triangle of its front. Returns false, with the trace's length, if it ends there: at a
  /// layout vertex or on the border, or, with `stop_at_curves`, on a curve.
  /// \throws No_result_error if the trace has more than the limit of steps.
  bool advance(const Layout_vertices& vertices, bool stop_at_curves, Trace& trace, Front& front) const
  {
    Isoline_step& step = front.step;
    if (along(step.direction + 1, m_map->uv(front.apex)) == step.level && ends_at(vertices, front.apex, step, trace))
      return false;
    step.exit = exit_halfedge(*m_map, step);
    trace.steps.push_back(step);
    if (m_map->mesh().is_boundary(step.exit) || (stop_at_curves && m_map->is_constrained(step.exit))) {
      trace.length = step.position(m_map->uv(step.exit)); // constant along the curve's edge
      return false;
    }
    if (trace.steps.size() > m_max_steps)
      throw No_result_error("layout", "the isoline that leaves " + name(vertices[trace.source]) +
                                          " still goes on after crossing " + std::to_string(m_max_steps) +
                                          " triangles: a limit cycle or a dense spiral of the map");
    front.apex = Indexed_triangulation::prev(m_map->mesh().opposite(step.exit));
    const Isoline_step next = across(*m_map, step);
    if (!is_exact_difference(step.offset, along(next.direction, m_map->transition(step.exit).t), next.offset))
      throw No_result_error("layout", "the isoline that leaves " + name(vertices[trace.source]) +
                                          " is too long for exact arithmetic on the map's grid");
    step = next;
    return true;
  }

private:
  bool ends_at(const Layout_vertices& vertices, int corner, Isoline_step& step, Trace& trace) const
  {
    const int target = vertices.index(m_map->mesh().source(corner));
    if (target < 0)
      return false;
    step.exit = -1;
    trace.steps.push_back(step);
    trace.target = target;
    trace.target_slot = m_map->slot(corner, step.direction + 2);
    trace.length = step.position(m_map->uv(corner));
    return true;
  }

  /// Is `a - b`, which was rounded to `difference`, exact?
  static bool is_exact_difference(double a, double b, double difference)
  {
    const double b_seen = a - difference;
    const double a_seen = difference + b_seen;
    return b_seen == b && a_seen == a;
  }

  static std::string name(const Layout_vertices::Vertex& vertex)
  {
    return (vertex.constrained ? "vertex " : "singular vertex ") + std::to_string(vertex.vertex) + " of " +
           std::to_string(vertex.quadrants) + " right angles";
  }

  const Seamless_map* m_map;
  std::size_t m_max_steps;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
