// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_CUT_GRAPH_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_CUT_GRAPH_H

#include <Quadrille/Seamless_parametrization/internal/Frame_topology.h>
#include <Quadrille/Seamless_parametrization/internal/Tangent_geometry.h>
#include <Quadrille/Seamless_parametrization/internal/Union_find.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>
#include <Quadrille/exceptions.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Edges along which every component becomes a disk without singular vertices inside, and the frames combed on it.
struct Cut_graph {
  /// A chain of cut edges between two nodes (singular vertices, boundary vertices, branchings).
  struct Path {
    std::vector<int> halfedges; ///< consecutive
    int matching = 0;           ///< combed: (u,v) right of the path = R^matching (u,v) left of it + T
  };

  std::vector<char> is_cut; ///< by halfedge, equal on both sides
  std::vector<Path> paths;
  std::vector<int> path_of;       ///< by halfedge: its path, -1 where there is no cut
  std::vector<char> is_forward;   ///< by halfedge: the path runs along it (so its face is left of the path)
  std::vector<int> face_rotation; ///< by face: combed coordinates = R^rotation (coordinates of the face's own frame)
  std::vector<int> component;     ///< by face
  int number_of_components = 0;

  /// The matching between combed frames; 0 wherever there is no cut.
  int combed_matching(const std::vector<int>& matching, const Indexed_triangulation& mesh, int h) const
  {
    return (matching[std::size_t(h)] + face_rotation[std::size_t(mesh.opposite(h) / 3)] -
            face_rotation[std::size_t(h / 3)]) &
           3;
  }
};

/// Builds the cut graph: shortest paths first (Mehlhorn's approximation of a Steiner tree through all singular vertices
/// and boundary loops), completed by tree and cotree to the 2g handles of a component of genus g.
class Cut_graph_builder {
public:
  Cut_graph_builder(const Indexed_triangulation& mesh, const Tangent_geometry& geometry, const Frame_topology& topology)
      : m_mesh(mesh), m_geometry(geometry), m_topology(topology), m_n_vertices(std::size_t(mesh.number_of_vertices())),
        m_n_halfedges(std::size_t(mesh.number_of_halfedges()))
  {
  }

  /// Complexity: O(n log n).
  Cut_graph operator()()
  {
    find_components();
    grow_from_terminals();
    connect_terminals();
    add_handles();
    prune();
    comb();
    trace_paths();
    return std::move(m_cut);
  }

private:
  bool is_singular(int v) const { return m_topology.quarter_index(m_mesh, v) != 0; }
  bool is_terminal(int v) const { return m_mesh.is_boundary_vertex(v) || is_singular(v); }

  void find_components()
  {
    m_cut.component.assign(std::size_t(m_mesh.number_of_faces()), -1);
    for (int seed = 0; seed < m_mesh.number_of_faces(); ++seed) {
      if (m_cut.component[std::size_t(seed)] >= 0)
        continue;
      const int index = m_cut.number_of_components++;
      m_cut.component[std::size_t(seed)] = index;
      std::vector<int> stack{seed};
      while (!stack.empty()) {
        const int f = stack.back();
        stack.pop_back();
        for (int h = 3 * f; h < 3 * f + 3; ++h) {
          if (m_mesh.is_boundary(h) || m_cut.component[std::size_t(m_mesh.opposite(h) / 3)] >= 0)
            continue;
          m_cut.component[std::size_t(m_mesh.opposite(h) / 3)] = index;
          stack.push_back(m_mesh.opposite(h) / 3);
        }
      }
    }
  }

  /// One halfedge for both sides of an edge.
  int edge_of(int h) const { return m_mesh.is_boundary(h) ? h : std::min(h, m_mesh.opposite(h)); }

  /// Shortest paths to the nearest terminal. Every vertex learns its distance, its terminal's region, and the edge that
  /// leads back (m_tree). Components without a terminal start at their first vertex.
  void grow_from_terminals()
  {
    m_distance.assign(m_n_vertices, std::numeric_limits<double>::infinity());
    m_region.assign(m_n_vertices, -1);
    m_back.assign(m_n_vertices, -1);
    for (int v = 0; v < m_mesh.number_of_vertices(); ++v) {
      if (m_mesh.outgoing(v) < 0 || m_region[std::size_t(v)] >= 0)
        continue;
      if (m_mesh.is_boundary_vertex(v)) { // the whole loop is one terminal
        int h = m_mesh.outgoing(v);
        do {
          add_source(m_mesh.source(h));
          h = m_mesh.next_on_boundary(h);
        } while (m_mesh.source(h) != v);
        ++m_n_regions;
      } else if (is_singular(v)) {
        add_source(v);
        ++m_n_regions;
      }
    }
    dijkstra();
    for (int v = 0; v < m_mesh.number_of_vertices(); ++v) {
      if (m_mesh.outgoing(v) < 0 || m_region[std::size_t(v)] >= 0)
        continue;
      add_source(v);
      ++m_n_regions;
      dijkstra();
    }
  }

  void add_source(int v)
  {
    m_distance[std::size_t(v)] = 0.0;
    m_region[std::size_t(v)] = m_n_regions;
    m_queue.emplace(0.0, v);
  }

  void dijkstra()
  {
    while (!m_queue.empty()) {
      const auto [distance, v] = m_queue.top();
      m_queue.pop();
      if (distance > m_distance[std::size_t(v)])
        continue;
      const int start = m_mesh.outgoing(v);
      int h = start;
      do {
        relax(v, h);
        const int incoming = Indexed_triangulation::prev(h);
        h = m_mesh.opposite(incoming);
        if (h < 0)
          relax(v, incoming); // the last edge of a boundary fan is seen from its other end only
      } while (h >= 0 && h != start);
    }
  }

  void relax(int v, int h)
  {
    const int w = m_mesh.source(h) == v ? m_mesh.target(h) : m_mesh.source(h);
    const double distance = m_distance[std::size_t(v)] + m_geometry.edge(h).norm();
    if (!(distance < m_distance[std::size_t(w)]))
      return;
    m_distance[std::size_t(w)] = distance;
    m_region[std::size_t(w)] = m_region[std::size_t(v)];
    m_back[std::size_t(w)] = edge_of(h);
    m_queue.emplace(distance, w);
  }

  /// The shortest connections between regions (a minimum spanning tree of them).
  void connect_terminals()
  {
    m_in_tree.assign(m_n_halfedges, 0);
    for (const int h : m_back)
      if (h >= 0)
        set_both_sides(m_in_tree, h);
    std::vector<std::pair<double, int>> bridges;
    for (int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if (edge_of(h) == h && m_region[std::size_t(m_mesh.source(h))] != m_region[std::size_t(m_mesh.target(h))])
        bridges.emplace_back(m_distance[std::size_t(m_mesh.source(h))] + m_geometry.edge(h).norm() +
                                 m_distance[std::size_t(m_mesh.target(h))],
                             h);
    std::sort(bridges.begin(), bridges.end());
    Signed_union_find sets{std::size_t(m_n_regions)};
    for (const auto& [length, h] : bridges)
      if (sets.unite(m_region[std::size_t(m_mesh.source(h))], m_region[std::size_t(m_mesh.target(h))], 1))
        set_both_sides(m_in_tree, h);
  }

  void set_both_sides(std::vector<char>& flags, int h) const
  {
    flags[std::size_t(h)] = 1;
    if (!m_mesh.is_boundary(h))
      flags[std::size_t(m_mesh.opposite(h))] = 1;
  }

  /// Edges that neither the spanning tree of vertices nor the spanning tree of faces uses close the handles.
  void add_handles()
  {
    m_cut.is_cut = m_in_tree;
    std::vector<char> used = m_in_tree;
    std::vector<char> reached(std::size_t(m_mesh.number_of_faces()), 0);
    for (int seed = 0; seed < m_mesh.number_of_faces(); ++seed) {
      if (reached[std::size_t(seed)])
        continue;
      reached[std::size_t(seed)] = 1;
      std::queue<int> queue;
      queue.push(seed);
      while (!queue.empty()) {
        const int f = queue.front();
        queue.pop();
        for (int h = 3 * f; h < 3 * f + 3; ++h) {
          if (m_mesh.is_boundary(h) || m_in_tree[std::size_t(h)])
            continue;
          const int g = m_mesh.opposite(h) / 3;
          if (reached[std::size_t(g)])
            continue;
          reached[std::size_t(g)] = 1;
          set_both_sides(used, h);
          queue.push(g);
        }
      }
    }
    for (int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if (!used[std::size_t(h)] && !m_mesh.is_boundary(h))
        m_cut.is_cut[std::size_t(h)] = 1;
  }

  /// Removes dangling edges until every end is a terminal.
  void prune()
  {
    m_degree.assign(m_n_vertices, 0);
    for (int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if (m_cut.is_cut[std::size_t(h)])
        ++m_degree[std::size_t(m_mesh.source(h))];
    for (int v = 0; v < m_mesh.number_of_vertices(); ++v) {
      int leaf = v;
      while (leaf >= 0 && m_degree[std::size_t(leaf)] == 1 && !is_terminal(leaf)) {
        const int h = cut_halfedge_leaving(leaf);
        m_cut.is_cut[std::size_t(h)] = m_cut.is_cut[std::size_t(m_mesh.opposite(h))] = 0;
        --m_degree[std::size_t(leaf)];
        leaf = m_mesh.target(h);
        --m_degree[std::size_t(leaf)];
      }
    }
  }

  int cut_halfedge_leaving(int v) const
  {
    int h = m_mesh.outgoing(v);
    while (!m_cut.is_cut[std::size_t(h)])
      h = m_mesh.next_around_source(h);
    return h;
  }

  /// Turns the frames of every component so that they match across all edges that are not cut.
  void comb()
  {
    std::vector<int>& rotation = m_cut.face_rotation;
    rotation.assign(std::size_t(m_mesh.number_of_faces()), -1);
    for (int seed = 0; seed < m_mesh.number_of_faces(); ++seed) {
      if (rotation[std::size_t(seed)] >= 0)
        continue;
      rotation[std::size_t(seed)] = 0;
      std::queue<int> queue;
      queue.push(seed);
      while (!queue.empty()) {
        const int f = queue.front();
        queue.pop();
        for (int h = 3 * f; h < 3 * f + 3; ++h) {
          if (m_mesh.is_boundary(h) || m_cut.is_cut[std::size_t(h)])
            continue;
          int& other = rotation[std::size_t(m_mesh.opposite(h) / 3)];
          const int matched = (rotation[std::size_t(f)] - m_topology.matching[std::size_t(h)]) & 3;
          if (other < 0) {
            other = matched;
            queue.push(m_mesh.opposite(h) / 3);
          } else if (other != matched)
            throw No_result_error("map", "the frames around vertex " + std::to_string(m_mesh.source(h)) +
                                             " cannot be combed: the cut graph misses a singular vertex or a handle");
        }
      }
    }
  }

  bool is_node(int v) const { return m_degree[std::size_t(v)] != 2 || is_terminal(v); }

  void trace_paths()
  {
    m_cut.path_of.assign(m_n_halfedges, -1);
    m_cut.is_forward.assign(m_n_halfedges, 0);
    for (int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if (m_cut.is_cut[std::size_t(h)] && is_node(m_mesh.source(h)))
        trace_path(h);
    for (int h = 0; h < m_mesh.number_of_halfedges(); ++h) // loops without a node
      if (m_cut.is_cut[std::size_t(h)])
        trace_path(h);
  }

  void trace_path(int h)
  {
    if (m_cut.path_of[std::size_t(h)] >= 0)
      return;
    const int index = int(m_cut.paths.size());
    Cut_graph::Path path;
    path.matching = m_cut.combed_matching(m_topology.matching, m_mesh, h);
    const int start = m_mesh.source(h);
    for (;;) {
      if (m_cut.combed_matching(m_topology.matching, m_mesh, h) != path.matching)
        throw No_result_error("map", "the matchings change along a seam at vertex " + std::to_string(m_mesh.source(h)));
      path.halfedges.push_back(h);
      m_cut.path_of[std::size_t(h)] = m_cut.path_of[std::size_t(m_mesh.opposite(h))] = index;
      m_cut.is_forward[std::size_t(h)] = 1;
      const int v = m_mesh.target(h);
      if (is_node(v) || v == start)
        break;
      h = next_cut_halfedge(h);
    }
    m_cut.paths.push_back(std::move(path));
  }

  /// The other cut edge at the target of h.
  int next_cut_halfedge(int h) const
  {
    int next = Indexed_triangulation::next(h); // leaves the target, clockwise of h's other side
    while (!m_cut.is_cut[std::size_t(next)])
      next = Indexed_triangulation::next(m_mesh.opposite(next));
    return next;
  }

  using Queue_entry = std::pair<double, int>;

  const Indexed_triangulation& m_mesh;
  const Tangent_geometry& m_geometry;
  const Frame_topology& m_topology;
  std::size_t m_n_vertices;
  std::size_t m_n_halfedges;
  Cut_graph m_cut;
  std::priority_queue<Queue_entry, std::vector<Queue_entry>, std::greater<Queue_entry>> m_queue;
  std::vector<double> m_distance; ///< by vertex: to its terminal
  std::vector<int> m_region;      ///< by vertex: its terminal
  std::vector<int> m_back;        ///< by vertex: the edge towards its terminal
  std::vector<char> m_in_tree;    ///< by halfedge: in the spanning tree of the vertices
  std::vector<int> m_degree;      ///< by vertex: cut edges
  int m_n_regions = 0;
};

} // namespace internal
} // namespace Quadrille

#endif
