// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_SPLIT_CHORDS_IN_SPACE_H
#define QUADRILLE_MESH_IO_INTERNAL_SPLIT_CHORDS_IN_SPACE_H

#include <Quadrille/Surface_domain.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <tuple>
#include <vector>

namespace Quadrille {
namespace internal {

/// Gives the triangles between the curves of a surface free vertices: edges that join two vertices of curves (chords)
/// get one in their middle, triangles between three curve edges one at their centre. The shape of the surface stays.
///
/// A map that is aligned with the curves flattens a triangle whose three corners lie on one side, a frame field cannot
/// turn where all vertices lie on curves, and a triangle between three curve edges has too few right angles to become
/// quads without a vertex of valence 3 inside. Chords that cut off a corner sharper than 50 degrees stay: halving such
/// corners would make needles. But a patch between curves that has no free vertex otherwise, and is no quadrilateral by
/// its angles, gets one on its longest chord in any case. Complexity: O(n log n).
class Chord_splitter_in_space {
public:
  using Mesh = Surface_domain::Mesh;
  using Vertex = Surface_domain::vertex_descriptor;
  using Edge = Surface_domain::edge_descriptor;
  using Halfedge = Surface_domain::halfedge_descriptor;
  using Face = Surface_domain::face_descriptor;
  using Point_3 = Surface_domain::Point_3;

  /// \pre the curves of `domain` are known.
  explicit Chord_splitter_in_space(Surface_domain& domain)
      : m_domain(domain), m_mesh(domain.mesh), m_is_on_curve(m_mesh.number_of_vertices(), 0)
  {
    for (const Edge e : m_mesh.edges())
      if (is_on_curve(e))
        for (const int end : {0, 1})
          m_is_on_curve[std::size_t(m_mesh.vertex(e, unsigned(end)).idx())] = 1;
  }

  /// Returns the number of new vertices.
  int run()
  {
    const std::size_t n_before = m_mesh.number_of_vertices();
    const std::vector<Face> closed = closed_triangles();
    const std::vector<Edge> chords = sorted_chords();
    const std::vector<Edge> last_resorts = chords_of_rigid_patches(chords);
    for (const Face f : closed)
      split_face(f);
    for (const std::vector<Edge>* edges : {&chords, &last_resorts})
      for (const Edge e : *edges)
        split_edge(m_mesh.halfedge(e));
    m_domain.edge_curve.resize(m_mesh.number_of_edges(), -1);
    m_domain.edge_chain.resize(m_mesh.number_of_edges(), -1);
    return int(m_mesh.number_of_vertices() - n_before);
  }

private:
  bool is_on_curve(Edge e) const
  {
    return std::size_t(e.idx()) < m_domain.edge_curve.size() && m_domain.edge_curve[std::size_t(e.idx())] >= 0;
  }
  bool is_on_curve(Halfedge h) const { return is_on_curve(m_mesh.edge(h)); }
  const Point_3& source(Halfedge h) const { return m_mesh.point(m_mesh.source(h)); }
  const Point_3& target(Halfedge h) const { return m_mesh.point(m_mesh.target(h)); }

  std::vector<Face> closed_triangles() const
  {
    std::vector<Face> result;
    for (const Face f : m_mesh.faces()) {
      const Halfedge h = m_mesh.halfedge(f);
      if (is_on_curve(h) && is_on_curve(m_mesh.next(h)) && is_on_curve(m_mesh.prev(h)))
        result.push_back(f);
    }
    return result;
  }

  bool is_on_curve(Vertex v) const { return m_is_on_curve[std::size_t(v.idx())] != 0; }

  bool is_chord(Edge e) const
  {
    const Halfedge h = m_mesh.halfedge(e);
    return !is_on_curve(e) && is_on_curve(m_mesh.vertex(e, 0)) && is_on_curve(m_mesh.vertex(e, 1)) &&
           !cuts_off_sharp_corner(h) && !cuts_off_sharp_corner(m_mesh.opposite(h));
  }

  /// The longest inner edges of the patches that neither have a free vertex, also not with `chords` split, nor four
  /// corners.
  std::vector<Edge> chords_of_rigid_patches(const std::vector<Edge>& chords) const
  {
    const std::set<Edge> split(chords.begin(), chords.end());
    std::vector<Edge> result;
    std::vector<char> is_visited(m_mesh.number_of_faces(), 0);
    for (const Face first : m_mesh.faces()) {
      if (is_visited[std::size_t(first.idx())])
        continue;
      std::vector<Face> patch{first};
      is_visited[std::size_t(first.idx())] = 1;
      bool has_free_vertex = false;
      std::map<Vertex, double> angles;
      Edge longest;
      for (std::size_t i = 0; i < patch.size(); ++i)
        for (const Halfedge h : m_mesh.halfedges_around_face(m_mesh.halfedge(patch[i]))) {
          angles[m_mesh.target(h)] += angle(h);
          has_free_vertex = has_free_vertex || !is_on_curve(m_mesh.target(h)) || split.count(m_mesh.edge(h)) > 0;
          if (is_on_curve(h))
            continue;
          if (!longest.is_valid() || squared_length(m_mesh.edge(h)) > squared_length(longest))
            longest = m_mesh.edge(h);
          const Face beyond = m_mesh.face(m_mesh.opposite(h));
          if (!is_visited[std::size_t(beyond.idx())]) {
            is_visited[std::size_t(beyond.idx())] = 1;
            patch.push_back(beyond);
          }
        }
      if (has_free_vertex || !longest.is_valid())
        continue;
      long turn = 0; // in quarters
      for (const auto& [v, a] : angles)
        turn += 2 - std::max(1L, std::lround(a / (0.5 * CGAL_PI)));
      if (turn != 4)
        result.push_back(longest);
    }
    return result;
  }

  /// Of the corner at the target.
  double angle(Halfedge h) const
  {
    const auto u = source(h) - target(h), v = target(m_mesh.next(h)) - target(h);
    return std::atan2(length(CGAL::cross_product(u / length(u), v / length(v))), (u / length(u)) * (v / length(v)));
  }

  double squared_length(Edge e) const
  {
    return CGAL::squared_distance(m_mesh.point(m_mesh.vertex(e, 0)), m_mesh.point(m_mesh.vertex(e, 1)));
  }

  bool cuts_off_sharp_corner(Halfedge h) const
  {
    if (!is_on_curve(m_mesh.next(h)) || !is_on_curve(m_mesh.prev(h)))
      return false;
    constexpr double sharp_degrees = 50;
    return angle(m_mesh.next(h)) < sharp_degrees * CGAL_PI / 180;
  }

  static double length(const Surface_domain::Vector_3& v) { return std::hypot(v.x(), v.y(), v.z()); }

  /// From long to short; the order does not depend on that of the input.
  std::vector<Edge> sorted_chords() const
  {
    std::vector<Edge> chords;
    for (const Edge e : m_mesh.edges())
      if (is_chord(e))
        chords.push_back(e);
    const auto key = [&](Edge e) {
      const Point_3 middle = CGAL::midpoint(m_mesh.point(m_mesh.vertex(e, 0)), m_mesh.point(m_mesh.vertex(e, 1)));
      return std::tuple(-squared_length(e), middle.x(), middle.y(), middle.z());
    };
    std::stable_sort(chords.begin(), chords.end(), [&](Edge a, Edge b) { return key(a) < key(b); });
    return chords;
  }

  /// Is the triangle from `p` to the edge `h` high enough for doubles?
  bool is_proper(const Point_3& p, Halfedge h) const
  {
    constexpr double least = 1e-9; // of the longest side
    const auto u = source(h) - p, v = target(h) - p, w = target(h) - source(h);
    const double longest = std::max({length(u), length(v), length(w)});
    return longest > 0 && length(CGAL::cross_product(u / longest, v / longest)) > least;
  }

  void split_face(Face f)
  {
    const Halfedge h = m_mesh.halfedge(f);
    const Point_3 center = CGAL::centroid(source(h), target(h), target(m_mesh.next(h)));
    if (!is_proper(center, h) || !is_proper(center, m_mesh.next(h)) || !is_proper(center, m_mesh.prev(h)))
      return;
    const int region = m_domain.face_region[std::size_t(f.idx())];
    const Halfedge spoke = CGAL::Euler::add_center_vertex(h, m_mesh);
    m_mesh.point(m_mesh.target(spoke)) = center;
    m_domain.face_region.resize(m_mesh.number_of_faces(), region);
  }

  void split_edge(Halfedge h)
  {
    const Halfedge o = m_mesh.opposite(h);
    const Point_3 middle = CGAL::midpoint(source(h), target(h));
    for (const Halfedge side : {m_mesh.next(h), m_mesh.prev(h), m_mesh.next(o), m_mesh.prev(o)})
      if (!is_proper(middle, side))
        return;
    const int left = m_domain.face_region[std::size_t(m_mesh.face(h).idx())];
    const int right = m_domain.face_region[std::size_t(m_mesh.face(o).idx())];
    const Halfedge first = CGAL::Euler::split_edge(h, m_mesh); // from the source of h to the middle
    m_mesh.point(m_mesh.target(first)) = middle;
    CGAL::Euler::split_face(first, m_mesh.next(m_mesh.next(first)), m_mesh);
    m_domain.face_region.resize(m_mesh.number_of_faces(), left);
    const Halfedge arriving = m_mesh.prev(m_mesh.opposite(first)); // at the middle, on the other side
    CGAL::Euler::split_face(arriving, m_mesh.next(m_mesh.next(arriving)), m_mesh);
    m_domain.face_region.resize(m_mesh.number_of_faces(), right);
  }

  Surface_domain& m_domain;
  Mesh& m_mesh;
  std::vector<char> m_is_on_curve; ///< by vertex
};

} // namespace internal
} // namespace Quadrille

#endif
