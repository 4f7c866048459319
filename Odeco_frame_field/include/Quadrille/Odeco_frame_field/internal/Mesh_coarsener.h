// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_MESH_COARSENER_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_MESH_COARSENER_H

#include <Quadrille/Odeco_frame_field/internal/local_triangle_sizes.h>
#include <Quadrille/Odeco_frame_field/internal/vertex_restrictions.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <vector>

namespace Quadrille {
namespace internal {

/// A triangulation with constrained edges.
template <class Point> struct Constrained_triangulation {
  Indexed_triangulation mesh;
  std::vector<Point> points;
  std::vector<Constrained_halfedge> edges;
};
using Constrained_mesh = Constrained_triangulation<Eigen::Vector2d>;
using Constrained_surface = Constrained_triangulation<Eigen::Vector3d>;

/// Coarsens a triangulation by collapsing edges, shortest first relative to the given vertex sizes, one end into the
/// other. Its vertices are vertices of the given one.
///
/// Boundaries and constrained edges stay what they are, only with fewer vertices: those where such a curve ends,
/// branches, turns by more than 25 degrees or changes its constraint stay. No triangle is inverted or becomes worse
/// than both a lower bound and what was there; on surfaces none turns by more than 45 degrees from where it was at
/// first. Deterministic. Complexity: O(n log n).
template <class Point> class Mesh_coarsener {
public:
  using Mesh = Constrained_triangulation<Point>;

  Mesh_coarsener(const Mesh& mesh, const std::vector<double>& vertex_sizes)
      : m_points(mesh.points), m_sizes(vertex_sizes), m_triangles_of(mesh.points.size()),
        m_curves_of(mesh.points.size()), m_collapsed_into(mesh.points.size(), -1)
  {
    for (int f = 0; f < mesh.mesh.number_of_faces(); ++f) {
      m_triangles.push_back(mesh.mesh.triangle(f));
      if constexpr (on_surface)
        m_first_normal.push_back(doubled_normal(m_triangles.back()).normalized());
      for (const int v : m_triangles.back())
        m_triangles_of[std::size_t(v)].push_back(f);
    }
    m_n_triangles = m_triangles.size();
    std::vector<char> is_curve(std::size_t(mesh.mesh.number_of_halfedges()), 0);
    for (const Constrained_halfedge& edge : mesh.edges) {
      add_curve_edge(mesh.mesh.source(edge.halfedge), mesh.mesh.target(edge.halfedge), true, edge.aligned, edge.is_weak,
                     edge.size);
      is_curve[std::size_t(edge.halfedge)] = 1;
      if (const int other = mesh.mesh.opposite(edge.halfedge); other >= 0)
        is_curve[std::size_t(other)] = 1;
    }
    for (int h = 0; h < mesh.mesh.number_of_halfedges(); ++h)
      if (mesh.mesh.is_boundary(h) && !is_curve[std::size_t(h)])
        add_curve_edge(mesh.mesh.source(h), mesh.mesh.target(h), false, false, false, {});
  }

  /// Collapses edges until at most `n_triangles` are left, or none can be collapsed any more.
  void coarsen(std::size_t n_triangles)
  {
    std::size_t before = m_n_triangles + 1;
    // Edges that could not be collapsed get another chance after their surroundings have changed.
    while (m_n_triangles > n_triangles && m_n_triangles < before) {
      before = m_n_triangles;
      queue_all_edges();
      while (m_n_triangles > n_triangles && !m_queue.empty()) {
        const auto [length, v, w] = m_queue.top();
        m_queue.pop();
        if (m_collapsed_into[std::size_t(v)] >= 0 || m_collapsed_into[std::size_t(w)] >= 0 || !are_neighbours(v, w))
          continue;
        const double quality = collapse_quality(v, w), opposite_quality = collapse_quality(w, v);
        if (std::max(quality, opposite_quality) <= 0)
          continue;
        if (quality >= opposite_quality)
          collapse(v, w);
        else
          collapse(w, v);
      }
      m_queue = {};
    }
  }

  /// The coarse triangulation. `fine_vertex` receives the given vertex that each of its vertices is, `coarse_vertex` of
  /// each given vertex the coarse one that it went into.
  Mesh result(std::vector<int>& fine_vertex, std::vector<int>& coarse_vertex) const
  {
    Mesh result;
    fine_vertex.clear();
    coarse_vertex.assign(m_points.size(), -1);
    for (std::size_t v = 0; v < m_points.size(); ++v)
      if (m_collapsed_into[v] < 0) {
        coarse_vertex[v] = int(fine_vertex.size());
        fine_vertex.push_back(int(v));
        result.points.push_back(m_points[v]);
      }
    std::vector<std::array<int, 3>> triangles;
    for (const auto& t : m_triangles)
      if (t[0] >= 0)
        triangles.push_back(
            {coarse_vertex[std::size_t(t[0])], coarse_vertex[std::size_t(t[1])], coarse_vertex[std::size_t(t[2])]});
    result.mesh = Indexed_triangulation(result.points.size(), std::move(triangles));
    for (int h = 0; h < result.mesh.number_of_halfedges(); ++h) {
      const int v = fine_vertex[std::size_t(result.mesh.source(h))],
                w = fine_vertex[std::size_t(result.mesh.target(h))];
      const Curve_end* end = result.mesh.opposite(h) > h ? nullptr : find_curve_end(v, w);
      if (end && end->constrained)
        result.edges.push_back({h, end->aligned, {end->size, find_curve_end(w, v)->size}, end->is_weak});
    }
    for (std::size_t v = 0; v < m_points.size(); ++v) {
      int survivor = int(v);
      while (m_collapsed_into[std::size_t(survivor)] >= 0)
        survivor = m_collapsed_into[std::size_t(survivor)];
      coarse_vertex[v] = coarse_vertex[std::size_t(survivor)];
    }
    return result;
  }

private:
  static constexpr bool on_surface = Point::RowsAtCompileTime == 3;

  /// An edge of a curve, seen from one of its ends.
  struct Curve_end {
    int other;
    bool constrained, aligned, is_weak; ///< of the edge
    Frame_size size;                    ///< here
  };

  void add_curve_edge(int v, int w, bool constrained, bool aligned, bool is_weak, const std::array<Frame_size, 2>& size)
  {
    m_curves_of[std::size_t(v)].push_back({w, constrained, aligned, is_weak, size[0]});
    m_curves_of[std::size_t(w)].push_back({v, constrained, aligned, is_weak, size[1]});
  }

  const Curve_end* find_curve_end(int v, int w) const
  {
    for (const Curve_end& end : m_curves_of[std::size_t(v)])
      if (end.other == w)
        return &end;
    return nullptr;
  }
  Curve_end* find_curve_end(int v, int w) { return const_cast<Curve_end*>(std::as_const(*this).find_curve_end(v, w)); }

  bool has_vertex(int f, int v) const
  {
    const auto& t = m_triangles[std::size_t(f)];
    return t[0] == v || t[1] == v || t[2] == v;
  }
  bool are_neighbours(int v, int w) const
  {
    const auto& faces = m_triangles_of[std::size_t(v)];
    return std::any_of(faces.begin(), faces.end(), [&](int f) { return has_vertex(f, w); });
  }

  std::vector<int> neighbours(int v) const
  {
    std::vector<int> result;
    for (const int f : m_triangles_of[std::size_t(v)])
      for (const int w : m_triangles[std::size_t(f)])
        if (w != v)
          result.push_back(w);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  void queue_edge(int v, int w)
  {
    const double length = (m_points[std::size_t(w)] - m_points[std::size_t(v)]).norm();
    m_queue.emplace(length / (m_sizes[std::size_t(v)] + m_sizes[std::size_t(w)]), std::min(v, w), std::max(v, w));
  }
  void queue_all_edges()
  {
    for (const auto& t : m_triangles)
      if (t[0] >= 0)
        for (std::size_t i = 0; i < 3; ++i)
          if (const int v = t[i], w = t[(i + 1) % 3]; v < w || find_curve_end(v, w))
            queue_edge(v, w);
  }

  Eigen::Vector3d doubled_normal(const std::array<int, 3>& t) const
  {
    const Point& apex = m_points[std::size_t(t[0])];
    return (m_points[std::size_t(t[1])] - apex).cross(m_points[std::size_t(t[2])] - apex);
  }

  /// What triangle `f` with the corners `t` is like: 1 for an equilateral one, 0 for a degenerate one, negative for an
  /// inverted one.
  double quality(int f, const std::array<int, 3>& t) const
  {
    const Point a = m_points[std::size_t(t[1])] - m_points[std::size_t(t[0])];
    const Point b = m_points[std::size_t(t[2])] - m_points[std::size_t(t[0])];
    const double squares = a.squaredNorm() + b.squaredNorm() + (b - a).squaredNorm();
    double area = twice_area(a, b);
    if constexpr (on_surface) {
      const double cos_45 = 0.7071;
      const double along = doubled_normal(t).dot(m_first_normal[std::size_t(f)]);
      if (along < cos_45 * area)
        area = std::min(along, 0.0);
    }
    return 2 * std::sqrt(3.0) * area / squares;
  }

  /// Whether the curve through `v` may lose it in favour of `w`.
  bool may_leave_curve(int v, int w) const
  {
    const std::vector<Curve_end>& ends = m_curves_of[std::size_t(v)];
    if (ends.empty())
      return true;
    if (ends.size() != 2 || (ends[0].other != w && ends[1].other != w))
      return false;
    if (ends[0].constrained != ends[1].constrained || ends[0].aligned != ends[1].aligned ||
        ends[0].size.normal != ends[1].size.normal || ends[0].size.tangential != ends[1].size.tangential)
      return false;
    const int u = ends[ends[0].other == w ? 1 : 0].other;
    const Point before = m_points[std::size_t(v)] - m_points[std::size_t(u)];
    const Point after = m_points[std::size_t(w)] - m_points[std::size_t(v)];
    const double cos_25 = 0.9063;
    return !are_neighbours(u, w) && before.dot(after) >= cos_25 * before.norm() * after.norm();
  }

  /// The worst triangle around after `v` went into `w`; not positive if that must not be.
  double collapse_quality(int v, int w) const
  {
    if (!may_leave_curve(v, w))
      return -1;
    // Link condition: the two ends share no other neighbours than the corners opposite of their edge.
    std::vector<int> common;
    const std::vector<int> of_v = neighbours(v), of_w = neighbours(w);
    std::set_intersection(of_v.begin(), of_v.end(), of_w.begin(), of_w.end(), std::back_inserter(common));
    std::size_t n_shared = 0;
    double before = 1, after = 1;
    for (const int f : m_triangles_of[std::size_t(v)]) {
      std::array<int, 3> t = m_triangles[std::size_t(f)];
      before = std::min(before, quality(f, t));
      if (has_vertex(f, w)) {
        ++n_shared;
      } else {
        std::replace(t.begin(), t.end(), v, w);
        after = std::min(after, quality(f, t));
      }
    }
    const double good = 0.4;
    return common.size() == n_shared && after >= std::min(good, before) ? after : -1;
  }

  void collapse(int v, int w)
  {
    if (!m_curves_of[std::size_t(v)].empty()) {
      const auto& ends = m_curves_of[std::size_t(v)];
      const int u = ends[ends[0].other == w ? 1 : 0].other;
      find_curve_end(u, v)->other = w;
      find_curve_end(w, v)->other = u;
    }
    for (const int f : m_triangles_of[std::size_t(v)]) {
      auto& t = m_triangles[std::size_t(f)];
      if (has_vertex(f, w)) {
        for (const int x : t)
          if (x != v)
            remove(m_triangles_of[std::size_t(x)], f);
        t = {-1, -1, -1};
        --m_n_triangles;
      } else {
        std::replace(t.begin(), t.end(), v, w);
        m_triangles_of[std::size_t(w)].push_back(f);
      }
    }
    m_triangles_of[std::size_t(v)].clear();
    m_collapsed_into[std::size_t(v)] = w;
    for (const int x : neighbours(w))
      queue_edge(w, x);
  }

  static void remove(std::vector<int>& list, int f) { list.erase(std::find(list.begin(), list.end(), f)); }

  using Queued_edge = std::tuple<double, int, int>; ///< relative length and the two ends
  const std::vector<Point>& m_points;
  const std::vector<double>& m_sizes;
  std::vector<std::array<int, 3>> m_triangles; ///< (-1, -1, -1): gone
  std::vector<Point> m_first_normal;           ///< of triangles of a surface
  std::size_t m_n_triangles = 0;
  std::vector<std::vector<int>> m_triangles_of;    ///< of every vertex
  std::vector<std::vector<Curve_end>> m_curves_of; ///< of every vertex
  std::vector<int> m_collapsed_into;               ///< of every vertex; -1: still there
  std::priority_queue<Queued_edge, std::vector<Queued_edge>, std::greater<>> m_queue;
};

} // namespace internal
} // namespace Quadrille

#endif
