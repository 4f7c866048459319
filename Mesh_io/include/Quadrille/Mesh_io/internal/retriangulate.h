// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_RETRIANGULATE_H
#define QUADRILLE_MESH_IO_INTERNAL_RETRIANGULATE_H

#include <Quadrille/Mesh_io/internal/Outline.h>
#include <Quadrille/Support/internal/segment_intersections.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// The constrained Delaunay triangulation of an outline's segments and of the inner points of a mesh whose triangles
/// cannot be used. Exact, so that it never fails, but points are not moved or added for good shapes.
class Retriangulation {
public:
  /// `points`: those of the segments, then inner ones. `surfaces_of_segment`: which surfaces each one bounds.
  /// \pre the segments meet in common ends only.
  Retriangulation(const std::vector<Point_2>& points, const std::vector<Numbered_segment>& segments,
                  const std::vector<std::vector<int>>& surfaces_of_segment)
  {
    std::size_t n_outer = 0;
    for (const Numbered_segment& segment : segments)
      n_outer = std::max(n_outer, std::size_t(std::max(segment.ends[0], segment.ends[1])) + 1);
    std::vector<Vertex> vertices;
    Face hint;
    for (std::size_t i = 0; i < n_outer; ++i)
      vertices.push_back(insert(points[i], int(i), hint));
    for (std::size_t s = 0; s < segments.size(); ++s) {
      const auto [a, b] = segments[s].ends;
      m_triangulation.insert_constraint(vertices[std::size_t(a)], vertices[std::size_t(b)]);
      m_surfaces_of_edge[std::minmax(a, b)] = surfaces_of_segment[s];
    }
    for (std::size_t i = n_outer; i < points.size(); ++i)
      if (!is_too_near_to_segment(points[i], hint))
        insert(points[i], int(i), hint);
  }

  /// Counterclockwise triangles, and the surface of each.
  void collect(std::vector<std::array<int, 3>>& triangles, std::vector<int>& surfaces)
  {
    find_surfaces();
    triangles.clear();
    surfaces.clear();
    for (const Face f : m_triangulation.finite_face_handles())
      for (const int surface : f->info().surfaces) {
        triangles.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
        surfaces.push_back(surface);
      }
  }

private:
  struct Face_info {
    bool visited = false;
    std::set<int> surfaces; ///< that the face is inside of
  };
  using Vertex_base = CGAL::Triangulation_vertex_base_with_info_2<int, Segment_kernel>;
  using Face_base =
      CGAL::Triangulation_face_base_with_info_2<Face_info, Segment_kernel,
                                                CGAL::Constrained_triangulation_face_base_2<Segment_kernel>>;
  using Triangulation =
      CGAL::Constrained_Delaunay_triangulation_2<Segment_kernel,
                                                 CGAL::Triangulation_data_structure_2<Vertex_base, Face_base>,
                                                 CGAL::No_constraint_intersection_tag>;
  using Vertex = Triangulation::Vertex_handle;
  using Face = Triangulation::Face_handle;

  Vertex insert(const Point_2& p, int number, Face& hint)
  {
    const Vertex v = m_triangulation.insert(p, hint);
    v->info() = number;
    hint = v->face();
    return v;
  }

  /// On a point or a segment, outside, or where a segment is seen at a right angle or more.
  bool is_too_near_to_segment(const Point_2& p, Face& hint) const
  {
    Triangulation::Locate_type where;
    int i = 0;
    const Face f = m_triangulation.locate(p, where, i, hint);
    if (where == Triangulation::VERTEX || m_triangulation.is_infinite(f))
      return true;
    hint = f;
    for (int k = 0; k < 3; ++k)
      if (f->is_constrained(k) && CGAL::angle(f->vertex(Triangulation::cw(k))->point(), p,
                                              f->vertex(Triangulation::ccw(k))->point()) != CGAL::ACUTE)
        return true;
    return false;
  }

  /// From the infinite face, which is outside of all, across edges: those on the border of a surface lead in or out.
  void find_surfaces()
  {
    std::vector<Face> stack = {m_triangulation.infinite_face()};
    stack.back()->info().visited = true;
    while (!stack.empty()) {
      const Face f = stack.back();
      stack.pop_back();
      for (int k = 0; k < 3; ++k) {
        const Face next = f->neighbor(k);
        if (std::exchange(next->info().visited, true))
          continue;
        next->info().surfaces = f->info().surfaces;
        if (f->is_constrained(k))
          for (const int surface : m_surfaces_of_edge.at(
                   std::minmax(f->vertex(Triangulation::cw(k))->info(), f->vertex(Triangulation::ccw(k))->info())))
            if (next->info().surfaces.erase(surface) == 0)
              next->info().surfaces.insert(surface);
        stack.push_back(next);
      }
    }
  }

  Triangulation m_triangulation;
  std::map<std::pair<int, int>, std::vector<int>> m_surfaces_of_edge; ///< by the numbers of its ends, the smaller first
};

} // namespace internal
} // namespace Quadrille

#endif
