// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SUPPORT_INTERNAL_INDEXED_TRIANGULATION_H
#define QUADRILLE_SUPPORT_INTERNAL_INDEXED_TRIANGULATION_H

#include <Quadrille/exceptions.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/unordered_map.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

namespace Quadrille {
namespace internal {

/// Connectivity of an oriented triangle mesh as plain index arrays: what the packages compute on.
///
/// Halfedge `h = 3 f + i` of face `f` goes from corner `i` to corner `(i + 1) % 3`. Corner `i` of face `f` has the same
/// index `3 f + i`: a corner is named by the halfedge that *leaves* it.
class Indexed_triangulation {
public:
  Indexed_triangulation() = default;

  /// \throws Invalid_input_error if an edge has more than two faces, two faces of an edge are not oriented alike, a
  /// face repeats a vertex, or a vertex has several fans (naming the element). Isolated vertices are allowed.
  /// Complexity: linear.
  Indexed_triangulation(std::size_t n_vertices, std::vector<std::array<int, 3>> triangles)
      : m_triangles(std::move(triangles)), m_opposite(3 * m_triangles.size(), -1), m_outgoing(n_vertices, -1)
  {
    link_opposite_halfedges();
    choose_outgoing_halfedges();
  }

  int number_of_vertices() const { return static_cast<int>(m_outgoing.size()); }
  int number_of_faces() const { return static_cast<int>(m_triangles.size()); }
  int number_of_halfedges() const { return static_cast<int>(m_opposite.size()); }
  int number_of_boundary_edges() const { return m_n_boundary; }
  /// Vertices (isolated ones excluded) - edges + faces.
  int euler_characteristic() const
  {
    const int edges = (number_of_halfedges() + m_n_boundary) / 2;
    return m_n_used_vertices - edges + number_of_faces();
  }

  const std::array<int, 3>& triangle(int f) const { return m_triangles[std::size_t(f)]; }
  static int face(int h) { return h / 3; }
  static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static int prev(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
  int source(int h) const { return m_triangles[std::size_t(h / 3)][std::size_t(h % 3)]; }
  int target(int h) const { return source(next(h)); }
  /// The same edge seen from the other face, or -1 on the boundary.
  int opposite(int h) const { return m_opposite[std::size_t(h)]; }
  bool is_boundary(int h) const { return opposite(h) < 0; }
  /// A halfedge that leaves `v`; for a boundary vertex the one on the boundary, so that `next_around_source` starting
  /// there visits the whole fan counterclockwise. -1 for an isolated vertex.
  int outgoing(int v) const { return m_outgoing[std::size_t(v)]; }
  bool is_boundary_vertex(int v) const { return outgoing(v) < 0 || is_boundary(outgoing(v)); }
  /// The next halfedge that leaves the same vertex, counterclockwise; -1 when the fan ends at the boundary.
  int next_around_source(int h) const { return opposite(prev(h)); }
  /// The previous one (clockwise); -1 at the boundary.
  int previous_around_source(int h) const { return is_boundary(h) ? -1 : next(opposite(h)); }
  /// The boundary halfedge that follows boundary halfedge `h` along the boundary (domain on the left).
  int next_on_boundary(int h) const { return outgoing(target(h)); }

  /// One index per undirected edge for each halfedge (both sides share it), numbered by first appearance.
  std::vector<int> edge_indices(int* n_edges = nullptr) const
  {
    std::vector<int> index(m_opposite.size(), -1);
    int n = 0;
    for (int h = 0; h < number_of_halfedges(); ++h)
      index[std::size_t(h)] = (opposite(h) >= 0 && opposite(h) < h) ? index[std::size_t(opposite(h))] : n++;
    if (n_edges)
      *n_edges = n;
    return index;
  }

private:
  void link_opposite_halfedges()
  {
    const std::size_t n = m_outgoing.size();
    std::unordered_map<std::size_t, int> halfedge_of;
    halfedge_of.reserve(m_opposite.size());
    for (int h = 0; h < number_of_halfedges(); ++h) {
      if (source(h) == target(h))
        throw Invalid_input_error("triangle " + std::to_string(h / 3) + " uses vertex " + std::to_string(source(h)) +
                                  " twice; remove degenerate triangles");
      if (!halfedge_of.emplace(std::size_t(source(h)) * n + std::size_t(target(h)), h).second)
        throw Invalid_input_error(
            "the edge between vertices " + std::to_string(source(h)) + " and " + std::to_string(target(h)) +
            " is non-manifold or its triangles are oriented differently (triangle " + std::to_string(h / 3) + ")");
    }
    for (int h = 0; h < number_of_halfedges(); ++h) {
      const auto other = halfedge_of.find(std::size_t(target(h)) * n + std::size_t(source(h)));
      if (other != halfedge_of.end())
        m_opposite[std::size_t(h)] = other->second;
      else
        ++m_n_boundary;
    }
  }

  void choose_outgoing_halfedges()
  {
    std::vector<int> degree(m_outgoing.size(), 0);
    for (int h = 0; h < number_of_halfedges(); ++h) {
      int& out = m_outgoing[std::size_t(source(h))];
      ++degree[std::size_t(source(h))];
      if (out < 0 || (is_boundary(h) && !is_boundary(out)))
        out = h;
    }
    for (int v = 0; v < number_of_vertices(); ++v) {
      const int start = outgoing(v);
      if (start < 0)
        continue;
      ++m_n_used_vertices;
      int visited = 0;
      int h = start;
      do {
        ++visited;
        h = next_around_source(h);
      } while (h >= 0 && h != start);
      if (visited != degree[std::size_t(v)])
        throw Invalid_input_error("vertex " + std::to_string(v) +
                                  " is non-manifold: several separate fans of triangles meet there");
    }
  }

  std::vector<std::array<int, 3>> m_triangles;
  std::vector<int> m_opposite;
  std::vector<int> m_outgoing;
  int m_n_boundary = 0;
  int m_n_used_vertices = 0;
};

/// An `Indexed_triangulation` of a CGAL FaceGraph, with the tables that lead back to its descriptors.
template <class TriangleMesh> struct Mesh_index {
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using vertex_descriptor = typename Graph_traits::vertex_descriptor;
  using halfedge_descriptor = typename Graph_traits::halfedge_descriptor;
  using face_descriptor = typename Graph_traits::face_descriptor;

  /// \throws Invalid_input_error if a face is not a triangle, and as the constructor of `Indexed_triangulation`.
  explicit Mesh_index(const TriangleMesh& mesh)
  {
    boost::unordered_map<vertex_descriptor, int> vertex_index;
    for (const vertex_descriptor v : make_range(vertices(mesh))) {
      vertex_index[v] = static_cast<int>(vertex_of.size());
      vertex_of.push_back(v);
    }
    std::vector<std::array<int, 3>> triangles;
    for (const face_descriptor f : make_range(faces(mesh))) {
      halfedge_descriptor h = halfedge(f, mesh);
      if (next(next(next(h, mesh), mesh), mesh) != h)
        throw Invalid_input_error("face " + std::to_string(face_of.size()) +
                                  " is not a triangle; triangulate the mesh first");
      std::array<int, 3> triangle;
      for (int& corner : triangle) {
        corner = vertex_index[source(h, mesh)];
        halfedge_of.push_back(h);
        h = next(h, mesh);
      }
      face_of.push_back(f);
      triangles.push_back(triangle);
    }
    triangulation = Indexed_triangulation(vertex_of.size(), std::move(triangles));
  }

  Indexed_triangulation triangulation;
  std::vector<vertex_descriptor> vertex_of;
  std::vector<halfedge_descriptor> halfedge_of; ///< by our halfedge index
  std::vector<face_descriptor> face_of;

private:
  template <class Iterators> struct Range {
    Iterators ends;
    auto begin() const { return ends.first; }
    auto end() const { return ends.second; }
  };
  template <class Iterators> static Range<Iterators> make_range(const Iterators& ends) { return {ends}; }
};

} // namespace internal
} // namespace Quadrille

#endif
