// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_SEPARATRICES_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_SEPARATRICES_H

#include <Quadrille/Quad_extraction/internal/Motorcycles.h>
#include <Quadrille/Quad_layout.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// The separatrices of a map: one through every port of every layout vertex, run to their natural ends or, for a
/// T-mesh, to where they meet another one (`Motorcycles`) or a curve.
///
/// A trace that arrives at a layout vertex uses up the port it arrives through, so no isoline is traced twice. A border
/// or feature loop that has no layout vertex and on one side meets no trace gets a seed, so that every loop carries a
/// node and no patch is a ring. So does a closed component that has neither (a torus).
class Separatrices {
public:
  /// `kept`: as for `Layout_vertices`. `max_steps`: as for `Isoline_tracer`.
  Separatrices(const Seamless_map& map, const std::vector<char>& kept, Layout_kind kind, std::size_t max_steps)
      : m_map(&map), m_kind(kind), m_vertices(map, kept), m_tracer(map, max_steps),
        m_motorcycles(map, m_vertices, m_tracer), m_hit(std::size_t(map.mesh().number_of_halfedges()), 0),
        m_hit_vertex(std::size_t(map.mesh().number_of_vertices()), 0)
  {
    find_loops();
    trace_ports(0);
    for (const std::vector<int>& loop : m_loops)
      if (is_missed(loop)) {
        m_vertices.add_seed(seed_of(loop));
        trace_ports(m_vertices.size() - 1);
      }
    for (const int v : vertices_of_bare_components()) {
      m_vertices.add_seed(v);
      trace_ports(m_vertices.size() - 1);
    }
    if (m_kind == Layout_kind::t_mesh)
      m_traces = m_motorcycles.take_traces();
  }
  Separatrices(const Separatrices&) = delete; // its parts refer to each other
  Separatrices& operator=(const Separatrices&) = delete;

  const Layout_vertices& vertices() const { return m_vertices; }
  const std::vector<Trace>& traces() const { return m_traces; }
  /// Border and feature loops without a critical vertex, as halfedges in order.
  const std::vector<std::vector<int>>& loops() const { return m_loops; }

private:
  void find_loops()
  {
    const Indexed_triangulation& mesh = m_map->mesh();
    std::vector<char> visited(m_hit.size(), 0);
    const auto visit = [&](int h) {
      at(visited, h) = 1;
      if (!mesh.is_boundary(h))
        at(visited, mesh.opposite(h)) = 1;
    };
    for (int h = 0; h < mesh.number_of_halfedges(); ++h)
      if (m_map->is_constrained(h) && !at(visited, h) && m_vertices.index(mesh.source(h)) >= 0) {
        int on_curve = h;
        visit(on_curve);
        while (m_vertices.index(mesh.target(on_curve)) < 0) {
          on_curve = m_vertices.next_on_curve(on_curve);
          visit(on_curve);
        }
      }
    for (int h = 0; h < mesh.number_of_halfedges(); ++h)
      if (m_map->is_constrained(h) && !at(visited, h)) {
        std::vector<int> loop;
        for (int on_curve = h; !at(visited, on_curve); on_curve = m_vertices.next_on_curve(on_curve)) {
          visit(on_curve);
          loop.push_back(on_curve);
        }
        m_loops.push_back(std::move(loop));
      }
  }

  bool is_missed(const std::vector<int>& loop) const
  {
    const auto is_hit = [this](int h) { return h >= 0 && at(m_hit, h) != 0; };
    const auto is_hit_behind = [&](int h) { return is_hit(m_map->mesh().opposite(h)); };
    return std::none_of(loop.begin(), loop.end(), is_hit) ||
           (!m_map->mesh().is_boundary(loop.front()) && std::none_of(loop.begin(), loop.end(), is_hit_behind));
  }

  /// The vertex of lowest index of each component without a layout vertex.
  std::vector<int> vertices_of_bare_components() const
  {
    const Indexed_triangulation& mesh = m_map->mesh();
    std::vector<int> result;
    std::vector<char> visited(std::size_t(mesh.number_of_faces()), 0);
    for (int start = 0; start < mesh.number_of_faces(); ++start) {
      if (at(visited, start))
        continue;
      std::vector<int> faces = {start};
      at(visited, start) = 1;
      bool is_bare = true;
      int lowest = mesh.triangle(start)[0];
      for (std::size_t i = 0; i < faces.size(); ++i)
        for (int h = 3 * faces[i]; h < 3 * faces[i] + 3; ++h) {
          is_bare = is_bare && m_vertices.index(mesh.source(h)) < 0;
          lowest = std::min(lowest, mesh.source(h));
          if (mesh.is_boundary(h) || at(visited, Indexed_triangulation::face(mesh.opposite(h))))
            continue;
          faces.push_back(Indexed_triangulation::face(mesh.opposite(h)));
          at(visited, faces.back()) = 1;
        }
      if (is_bare)
        result.push_back(lowest);
    }
    return result;
  }

  /// The vertex of lowest index at which no trace has ended.
  int seed_of(const std::vector<int>& loop) const
  {
    int seed = -1;
    for (const int h : loop) {
      const int v = m_map->mesh().source(h);
      if (!at(m_hit_vertex, v) && (seed < 0 || v < seed))
        seed = v;
    }
    if (seed < 0)
      throw No_result_error("layout", "isolines end at all vertices of the loop through vertex " +
                                          std::to_string(m_map->mesh().source(loop.front())) + ", on one side");
    return seed;
  }

  void trace_ports(int first_vertex)
  {
    if (m_kind == Layout_kind::t_mesh) {
      m_motorcycles.ride(first_vertex);
      m_motorcycles.for_each_arrival([this](const Isoline_step& step) {
        at(m_hit, step.exit) = 1;
        for (const int h : {step.exit, Indexed_triangulation::next(step.exit)})
          if (along(step.direction + 1, m_map->uv(h)) == step.level)
            at(m_hit_vertex, m_map->mesh().source(h)) = 1;
      });
      return;
    }
    m_used.resize(std::size_t(m_vertices.size()));
    for (int v = first_vertex; v < m_vertices.size(); ++v)
      at(m_used, v).assign(std::size_t(m_vertices[v].quadrants) + 1, 0);
    for (int v = first_vertex; v < m_vertices.size(); ++v)
      for (const Layout_vertices::Port& port : m_vertices[v].ports)
        if (!at(at(m_used, v), port.slot)) {
          auto [trace, front] = m_tracer.start(v, port);
          while (m_tracer.advance(m_vertices, false, trace, front)) {
          }
          use(trace.source, trace.source_slot);
          if (trace.target >= 0)
            use(trace.target, trace.target_slot);
          for (const Isoline_step& step : trace.steps)
            if (step.exit >= 0 && m_map->is_constrained(step.exit)) {
              at(m_hit, step.exit) = 1;
              if (!m_map->mesh().is_boundary(step.exit))
                at(m_hit, m_map->mesh().opposite(step.exit)) = 1;
            }
          m_traces.push_back(std::move(trace));
        }
  }

  void use(int vertex, int slot)
  {
    char& used = at(at(m_used, vertex), slot);
    if (used)
      throw No_result_error("layout", "two separatrices run through one direction of vertex " +
                                          std::to_string(m_vertices[vertex].vertex));
    used = 1;
  }

  const Seamless_map* m_map;
  Layout_kind m_kind;
  Layout_vertices m_vertices;
  Isoline_tracer m_tracer;
  Motorcycles m_motorcycles;
  std::vector<Trace> m_traces;
  std::vector<std::vector<char>> m_used;
  std::vector<char> m_hit;        ///< by halfedge: has a trace come from its triangle?
  std::vector<char> m_hit_vertex; ///< has a trace ended on a curve at this vertex?
  std::vector<std::vector<int>> m_loops;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
