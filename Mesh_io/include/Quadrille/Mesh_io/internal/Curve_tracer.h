// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_CURVE_TRACER_H
#define QUADRILLE_MESH_IO_INTERNAL_CURVE_TRACER_H

#include <Quadrille/Mesh_io/internal/format_place.h>
#include <Quadrille/Triangulated_domain.h>
#include <Quadrille/exceptions.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

/// Turns the labelled lines and the border of a domain into simple paths (`Triangulated_domain::curves`) and chains.
template <class Point> class Curve_tracer {
public:
  using Domain = Triangulated_domain<Point>;
  using Mesh = typename Domain::Mesh;
  using Halfedge = typename Domain::halfedge_descriptor;
  using Vertex = typename Domain::vertex_descriptor;

  /// \param point_of_input per point of `input`, the vertex that it became; -1 for none
  Curve_tracer(const Labelled_mesh& input, const std::vector<int>& point_of_input, double corner_degrees,
               Domain& domain)
      : m_input(input), m_point_of_input(point_of_input), m_cos_corner(std::cos(corner_degrees * CGAL_PI / 180)),
        m_domain(domain), m_mesh(domain.mesh)
  {
  }

  /// \param unlabelled edges that lie on curves, beside the lines of the input and the border
  void run(const std::vector<Halfedge>& unlabelled = {})
  {
    collect_lines();
    for (const Halfedge h : unlabelled)
      if (curve_of(h) < 0)
        add_edge(h, unnamed_label());
    collect_unlabelled_border();
    count_degrees();
    m_visited.assign(m_mesh.number_of_edges(), 0);
    for (int label = 0; label < int(m_halfedges.size()); ++label)
      trace(label);
    name_chains();
  }

private:
  /// The edges of each label, as halfedges in the direction of the file's lines.
  void collect_lines()
  {
    m_domain.edge_curve.assign(m_mesh.number_of_edges(), -1);
    m_halfedges.resize(m_input.curves.size());
    m_labels = m_input.curves;
    for (std::size_t l = 0; l < m_input.lines.size(); ++l) {
      const int a = m_point_of_input[std::size_t(m_input.lines[l][0])];
      const int b = m_point_of_input[std::size_t(m_input.lines[l][1])];
      const Halfedge h = a < 0 || b < 0 ? Mesh::null_halfedge() : m_mesh.halfedge(vertex(a), vertex(b));
      if (h == Mesh::null_halfedge()) {
        throw Invalid_input_error(m_domain.source + ": line element " + std::to_string(l) + " (counting from 0, from " +
                                  domain_place<Point>(m_input.points[std::size_t(m_input.lines[l][0])]) +
                                  ") is not an edge of the triangles; remove it or make the mesh conform to it");
      }
      const int label = m_input.line_curve[l];
      if (curve_of(h) < 0)
        add_edge(h, label < 0 ? unnamed_label() : label);
    }
  }

  /// Border edges without a line join the unlabelled lines: one label, cut into curves at corners.
  void collect_unlabelled_border()
  {
    for (const Halfedge h : m_mesh.halfedges())
      if (!m_mesh.is_border(h) && m_mesh.is_border(m_mesh.opposite(h)) && curve_of(h) < 0)
        add_edge(h, unnamed_label());
  }

  void add_edge(Halfedge h, int label)
  {
    m_domain.edge_curve[std::size_t(m_mesh.edge(h).idx())] = label;
    m_halfedges[std::size_t(label)].push_back(h);
  }

  int unnamed_label()
  {
    if (m_unnamed_label < 0) {
      m_unnamed_label = int(m_labels.size());
      m_labels.push_back({next_tag(), {}});
      m_halfedges.emplace_back();
    }
    return m_unnamed_label;
  }

  void count_degrees()
  {
    m_degree.assign(m_mesh.number_of_vertices(), 0);
    for (const std::vector<Halfedge>& halfedges : m_halfedges)
      for (const Halfedge h : halfedges) {
        ++m_degree[std::size_t(m_mesh.source(h).idx())];
        ++m_degree[std::size_t(m_mesh.target(h).idx())];
      }
  }

  /// Splits the edges of one label into simple paths and loops, in the order of their first lines.
  void trace(int label)
  {
    for (const Halfedge seed : m_halfedges[std::size_t(label)]) {
      if (m_visited[std::size_t(m_mesh.edge(seed).idx())])
        continue;
      std::vector<Halfedge> path{seed};
      m_visited[std::size_t(m_mesh.edge(seed).idx())] = 1;
      extend(path, label);
      if (!is_path_end(m_mesh.source(seed), label) && m_mesh.source(seed) != m_mesh.target(path.back())) {
        // The seed need not be the path's first edge: go on backwards from there.
        reverse(path);
        extend(path, label);
        reverse(path);
      }
      add_curve(label, std::move(path));
    }
  }

  void extend(std::vector<Halfedge>& path, int label)
  {
    while (!is_path_end(m_mesh.target(path.back()), label)) {
      Halfedge following = Mesh::null_halfedge();
      for (const Halfedge h : CGAL::halfedges_around_source(m_mesh.target(path.back()), m_mesh))
        if (curve_of(h) == label && !m_visited[std::size_t(m_mesh.edge(h).idx())])
          following = h;
      if (following == Mesh::null_halfedge())
        return;
      m_visited[std::size_t(m_mesh.edge(following).idx())] = 1;
      path.push_back(following);
    }
  }

  void reverse(std::vector<Halfedge>& path) const
  {
    std::reverse(path.begin(), path.end());
    for (Halfedge& h : path)
      h = m_mesh.opposite(h);
  }

  /// Paths end where another curve joins, and lines without labels also at corners.
  bool is_path_end(Vertex v, int label) const
  {
    Halfedge ends[2];
    int n = 0;
    if (m_degree[std::size_t(v.idx())] != 2)
      return true;
    for (const Halfedge h : CGAL::halfedges_around_source(v, m_mesh))
      if (curve_of(h) >= 0 && n < 2)
        ends[n++] = h;
    if (curve_of(ends[0]) != label || curve_of(ends[1]) != label)
      return true;
    return label == m_unnamed_label && is_corner(ends[0], ends[1]);
  }

  /// Whether two halfedges with the same source deviate from a straight line.
  bool is_corner(Halfedge a, Halfedge b) const
  {
    const auto u = m_mesh.point(m_mesh.target(a)) - m_mesh.point(m_mesh.source(a));
    const auto v = m_mesh.point(m_mesh.target(b)) - m_mesh.point(m_mesh.source(b));
    return -(u * v) < m_cos_corner * std::sqrt(u.squared_length()) * std::sqrt(v.squared_length());
  }

  void add_curve(int label, std::vector<Halfedge> path)
  {
    typename Domain::Curve curve;
    static_cast<Entity_label&>(curve) = m_labels[std::size_t(label)];
    if (label == m_unnamed_label && m_unnamed_pieces++ > 0)
      curve.tag = next_tag();
    m_last_tag = std::max(m_last_tag, curve.tag);
    curve.first = m_mesh.source(path.front());
    curve.last = m_mesh.target(path.back());
    curve.closed = curve.first == curve.last;
    curve.path = std::move(path);
    for (const Halfedge h : curve.path)
      m_curve_of_edge.emplace_back(m_mesh.edge(h), int(m_domain.curves.size()));
    m_domain.curves.push_back(std::move(curve));
  }

  void name_chains()
  {
    for (const auto& [edge, curve] : m_curve_of_edge)
      m_domain.edge_curve[std::size_t(edge.idx())] = curve;
    std::vector<int> parent(m_domain.curves.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int c) {
      while (parent[std::size_t(c)] != c)
        c = parent[std::size_t(c)];
      return c;
    };
    for (const Vertex v : m_mesh.vertices()) {
      if (m_degree[std::size_t(v.idx())] != 2)
        continue;
      Halfedge ends[2];
      int n = 0;
      for (const Halfedge h : CGAL::halfedges_around_source(v, m_mesh))
        if (curve_of(h) >= 0)
          ends[n++] = h;
      const int a = root(curve_of(ends[0])), b = root(curve_of(ends[1]));
      if (m_domain.curves[std::size_t(a)].names == m_domain.curves[std::size_t(b)].names &&
          !is_corner(ends[0], ends[1]))
        parent[std::size_t(std::max(a, b))] = std::min(a, b);
    }
    for (std::size_t c = 0; c < parent.size(); ++c)
      m_domain.curves[c].chain =
          root(int(c)) == int(c) ? m_domain.number_of_chains++ : m_domain.curves[std::size_t(root(int(c)))].chain;
    m_domain.edge_chain.assign(m_domain.edge_curve.size(), -1);
    for (std::size_t e = 0; e < m_domain.edge_curve.size(); ++e)
      if (m_domain.edge_curve[e] >= 0)
        m_domain.edge_chain[e] = m_domain.curves[std::size_t(m_domain.edge_curve[e])].chain;
  }

  int curve_of(Halfedge h) const { return m_domain.edge_curve[std::size_t(m_mesh.edge(h).idx())]; }

  static Vertex vertex(int v) { return Vertex(typename Vertex::size_type(v)); }

  int next_tag()
  {
    for (const Entity_label& label : m_labels)
      m_last_tag = std::max(m_last_tag, label.tag);
    return ++m_last_tag;
  }

  const Labelled_mesh& m_input;
  const std::vector<int>& m_point_of_input;
  double m_cos_corner;
  Domain& m_domain;
  Mesh& m_mesh;
  std::vector<Entity_label> m_labels;
  std::vector<std::vector<Halfedge>> m_halfedges; ///< by label
  std::vector<int> m_degree;                      ///< constrained edges at each vertex
  std::vector<char> m_visited;                    ///< by edge
  std::vector<std::pair<typename Domain::edge_descriptor, int>> m_curve_of_edge;
  int m_unnamed_label = -1;
  int m_unnamed_pieces = 0;
  int m_last_tag = 0;
};

} // namespace internal
} // namespace Quadrille

#endif
