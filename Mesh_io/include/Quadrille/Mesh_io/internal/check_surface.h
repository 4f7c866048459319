// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_CHECK_SURFACE_H
#define QUADRILLE_MESH_IO_INTERNAL_CHECK_SURFACE_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Mesh_io/internal/Triangle_adjacency.h>
#include <Quadrille/Mesh_io/internal/find_cracks.h>
#include <Quadrille/Mesh_io/internal/format_place.h>
#include <Quadrille/Mesh_io/internal/triangulate_polygon.h>
#include <Quadrille/exceptions.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Triangles in space whose points are all used; what is left of a `Labelled_mesh` once it has been checked.
struct Checked_surface {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

  std::vector<Kernel::Point_3> points;
  std::vector<std::array<int, 3>> triangles; ///< manifold, consistently oriented
  std::vector<std::size_t> polygon;          ///< per triangle: of the input
  std::vector<int> point_of_input;           ///< per input point: index into `points`, -1 for isolated points
  std::vector<std::string> notes;
};

/// The checks that every surface has to pass, in the order in which their messages help most.
class Surface_checker {
public:
  using Point_3 = Checked_surface::Kernel::Point_3;
  using Vector_3 = Checked_surface::Kernel::Vector_3;

  /// `rejects_cracks`: borders at the same place are no parts that touch, but should be connected.
  Surface_checker(const Labelled_mesh& input, const std::string& source, bool rejects_cracks)
      : m_input(input), m_source(source), m_rejects_cracks(rejects_cracks)
  {
  }

  Checked_surface run()
  {
    if (m_input.polygons.empty())
      fail("there are no triangles; a surface is read from a geometry with surfaces or from a mesh of polygons");
    check_corners();
    check_coordinates();
    compact();
    for (std::size_t f = 0; f < m_input.polygons.size(); ++f)
      add_polygon(f);
    check_repeated_triangles();
    const Triangle_adjacency adjacency(m_result.triangles);
    check_edges(adjacency);
    check_orientation(adjacency);
    check_vertices(adjacency);
    if (m_rejects_cracks)
      check_cracks(adjacency);
    add_notes(adjacency);
    return std::move(m_result);
  }

  /// The least altitude of a triangle relative to its longest edge.
  static constexpr double sliver_tolerance = 1e-10;

private:
  [[noreturn]] void fail(const std::string& reason) const { throw Invalid_input_error(m_source + ": " + reason); }

  void check_corners() const
  {
    for (std::size_t f = 0; f < m_input.polygons.size(); ++f) {
      std::vector<int> corners = m_input.polygons[f];
      if (corners.size() < 3)
        fail(polygon_name(f) + " has " + std::to_string(corners.size()) + " corners");
      std::sort(corners.begin(), corners.end());
      if (corners.front() < 0 || std::size_t(corners.back()) >= m_input.points.size())
        fail(polygon_name(f) + " uses a point that does not exist");
      if (std::adjacent_find(corners.begin(), corners.end()) != corners.end())
        fail(polygon_name(f) + " is degenerate: it uses a point twice");
    }
  }

  void check_coordinates() const
  {
    for (const std::vector<int>& polygon : m_input.polygons)
      for (const int v : polygon)
        for (const double x : m_input.points[std::size_t(v)]) {
          if (!std::isfinite(x))
            fail("point " + std::to_string(v) + " (counting from 0) has a coordinate that is not a finite number");
          // Products of three coordinates have to stay inside the range of doubles.
          if (std::abs(x) > 1e100)
            fail("point " + std::to_string(v) + " (counting from 0) has a coordinate beyond 1e100; change the unit");
        }
  }

  void compact()
  {
    m_result.point_of_input.assign(m_input.points.size(), -1);
    for (const std::vector<int>& polygon : m_input.polygons)
      for (const int v : polygon)
        m_result.point_of_input[std::size_t(v)] = 0;
    for (std::size_t v = 0; v < m_input.points.size(); ++v)
      if (m_result.point_of_input[v] == 0) {
        m_result.point_of_input[v] = int(m_result.points.size());
        m_result.points.emplace_back(m_input.points[v][0], m_input.points[v][1], m_input.points[v][2]);
      }
  }

  void add_polygon(std::size_t f)
  {
    std::vector<int> corners;
    for (const int v : m_input.polygons[f])
      corners.push_back(m_result.point_of_input[std::size_t(v)]);
    if (corners.size() == 3) {
      add_triangle({corners[0], corners[1], corners[2]}, f);
      return;
    }
    ++m_n_divided;
    std::vector<Point_3> outline;
    for (const int v : corners)
      outline.push_back(point(v));
    const std::vector<std::array<int, 3>> triangles = triangulate_polygon(outline);
    if (triangles.empty())
      fail(polygon_name(f) + " at " + place(corners[0]) + " cannot be divided into triangles");
    for (const std::array<int, 3>& t : triangles)
      add_triangle({corners[std::size_t(t[0])], corners[std::size_t(t[1])], corners[std::size_t(t[2])]}, f);
  }

  void add_triangle(const std::array<int, 3>& t, std::size_t f)
  {
    const Point_3 &p = point(t[0]), &q = point(t[1]), &r = point(t[2]);
    const auto describe = [&] { return polygon_name(f) + " at " + place(t[0]) + " is degenerate: "; };
    if (CGAL::collinear(p, q, r))
      fail(describe() + (m_input.polygons[f].size() > 3 ? "it can only be divided with a triangle whose" : "its") +
           " corners lie on a line");
    const double longest = std::max({length(q - p), length(r - q), length(p - r)});
    const double altitude = length(CGAL::cross_product((q - p) / longest, (r - p) / longest)); // relative
    if (!(altitude >= sliver_tolerance))
      fail(describe() + "its smallest altitude is only " + format_value(altitude) +
           " times its longest edge; remove such slivers");
    m_result.triangles.push_back(t);
    m_result.polygon.push_back(f);
  }

  static double length(const Vector_3& v) { return std::hypot(v.x(), v.y(), v.z()); }

  void check_repeated_triangles() const
  {
    std::vector<std::pair<std::array<int, 3>, std::size_t>> sorted;
    for (std::size_t t = 0; t < m_result.triangles.size(); ++t) {
      sorted.emplace_back(m_result.triangles[t], t);
      std::sort(sorted.back().first.begin(), sorted.back().first.end());
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 1; i < sorted.size(); ++i)
      if (sorted[i].first == sorted[i - 1].first)
        fail("triangle " + std::to_string(m_result.polygon[sorted[i - 1].second]) + " (counting from 0) at " +
             place(sorted[i].first[0]) + " is repeated as triangle " +
             std::to_string(m_result.polygon[sorted[i].second]) + "; remove one of them");
  }

  void check_edges(const Triangle_adjacency& adjacency) const
  {
    const auto& edges = adjacency.crowded_edges();
    if (edges.empty())
      return;
    std::string list;
    const std::vector<std::size_t>& triangles = edges[0].triangles;
    for (std::size_t i = 0; i < std::min<std::size_t>(triangles.size(), 5); ++i)
      list += (i == 0 ? "" : ", ") + std::to_string(m_result.polygon[triangles[i]]);
    fail("the surface is not manifold: the edge from " + place(edges[0].ends[0]) + " to " + place(edges[0].ends[1]) +
         " belongs to " + std::to_string(triangles.size()) + " triangles (" + list +
         (triangles.size() > 5 ? ", ..." : "") + ", counting from 0)" +
         (edges.size() > 1 ? ", and so do " + std::to_string(edges.size() - 1) + " other edges to more than two" : "") +
         "; separate the parts that meet there");
  }

  void check_orientation(const Triangle_adjacency& adjacency) const
  {
    const auto polygons = [&](const Triangle_adjacency::Side& side) {
      return std::pair(m_result.polygon[side.triangle],
                       m_result.polygon[std::size_t(adjacency.neighbor(side.triangle, side.edge))]);
    };
    const auto edge_name = [&](const Triangle_adjacency::Side& side) {
      const std::array<int, 3>& t = m_result.triangles[side.triangle];
      const auto [f, g] = polygons(side);
      return "the edge from " + place(t[side.edge]) + " to " + place(t[(side.edge + 1) % 3]) +
             (m_n_divided > 0 ? " (of polygons " : " (of triangles ") + std::to_string(f) + " and " +
             std::to_string(g) + ", counting from 0)";
    };
    const auto& one_sided = adjacency.one_sided_edges();
    if (!one_sided.empty()) {
      const auto between_polygons = std::find_if(one_sided.begin(), one_sided.end(), [&](const auto& side) {
        return polygons(side).first != polygons(side).second;
      });
      fail("the surface is not orientable, like a Moebius strip: no order of the triangles' corners is consistent "
           "everywhere, for instance across " +
           edge_name(between_polygons != one_sided.end() ? *between_polygons : one_sided[0]) +
           "; cut the surface open");
    }
    std::vector<std::size_t> n_all(std::size_t(adjacency.number_of_components()), 0), n_turned(n_all);
    for (std::size_t t = 0; t < m_result.triangles.size(); ++t) {
      ++n_all[std::size_t(adjacency.component(t))];
      n_turned[std::size_t(adjacency.component(t))] += adjacency.is_turned(t);
    }
    std::size_t n = 0;
    for (std::size_t c = 0; c < n_all.size(); ++c)
      n += std::min(n_turned[c], n_all[c] - n_turned[c]);
    if (n == 0)
      return;
    for (std::size_t t = 0; t < m_result.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i)
        if (adjacency.is_oriented_differently({t, i}))
          fail("the triangles are not oriented consistently: both of " + edge_name({t, i}) +
               " have it in the same direction; the surface is orientable, and turning around " + std::to_string(n) +
               " of " + std::to_string(m_result.triangles.size()) + " triangles makes it consistent");
  }

  /// The triangles around a vertex have to be neighbors one after the other.
  void check_vertices(const Triangle_adjacency& adjacency) const
  {
    std::vector<int> n_triangles(m_result.points.size(), 0);
    for (const std::array<int, 3>& t : m_result.triangles)
      for (const int v : t)
        ++n_triangles[std::size_t(v)];
    std::vector<char> is_done(m_result.points.size(), 0);
    for (std::size_t t = 0; t < m_result.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const int v = m_result.triangles[t][i];
        if (std::exchange(is_done[std::size_t(v)], char(1)))
          continue;
        if (size_of_fan(adjacency, t, v) != n_triangles[std::size_t(v)])
          fail("the surface is not manifold: at " + place(v) +
               " several separate fans of triangles meet in one point (one of them with triangle " +
               std::to_string(m_result.polygon[t]) + ", counting from 0); give each a point of its own");
      }
  }

  void check_cracks(const Triangle_adjacency& adjacency) const
  {
    std::vector<std::array<double, 3>> points;
    for (const Point_3& p : m_result.points)
      points.push_back({p.x(), p.y(), p.z()});
    const std::vector<Crack> cracks = Crack_finder(points, m_result.triangles)(adjacency);
    if (cracks.empty())
      return;
    const Crack& crack = cracks.front();
    fail("the surface has a crack: at the edge from " + place(crack.first[0]) + " to " + place(crack.first[1]) +
         (m_n_divided > 0 ? ", polygons " : ", triangles ") + std::to_string(m_result.polygon[crack.triangles[0]]) +
         " and " + std::to_string(m_result.polygon[crack.triangles[1]]) +
         " (counting from 0) touch without having points in common" +
         (cracks.size() > 1 ? ", and so do others at " + counted(cracks.size() - 1, "edge") : "") +
         "; merge such points, or let them be merged by repairing the mesh (--repair)");
  }

  int size_of_fan(const Triangle_adjacency& adjacency, std::size_t first, int v) const
  {
    const auto corner_of = [&](std::size_t t) {
      const std::array<int, 3>& corners = m_result.triangles[t];
      return std::size_t(std::find(corners.begin(), corners.end(), v) - corners.begin());
    };
    int n = 1;
    for (const std::size_t direction : {0, 2}) { // across the edge that leaves v, then across the one that comes to it
      int t = adjacency.neighbor(first, (corner_of(first) + direction) % 3);
      for (; t >= 0 && std::size_t(t) != first; ++n)
        t = adjacency.neighbor(std::size_t(t), (corner_of(std::size_t(t)) + direction) % 3);
      if (t >= 0)
        return n;
    }
    return n;
  }

  void add_notes(const Triangle_adjacency& adjacency)
  {
    if (m_n_divided > 0)
      m_result.notes.push_back(counted(m_n_divided, "polygon") + " with more than three corners " +
                               (m_n_divided == 1 ? "was" : "were") + " divided into triangles");
    if (const std::size_t n = m_input.points.size() - m_result.points.size())
      m_result.notes.push_back(counted(n, "point") + " that no triangle uses " + (n == 1 ? "was" : "were") +
                               " left out");
    note_coincident_points();
    std::vector<char> is_closed(std::size_t(adjacency.number_of_components()), 1);
    for (const Triangle_adjacency::Side& side : adjacency.border())
      is_closed[std::size_t(adjacency.component(side.triangle))] = 0;
    const std::vector<double> volumes = enclosed_volumes(m_result.points, m_result.triangles, adjacency);
    std::size_t n_closed = 0, n_inward = 0;
    for (std::size_t c = 0; c < volumes.size(); ++c) {
      n_closed += is_closed[c] != 0;
      n_inward += is_closed[c] && volumes[c] < 0;
    }
    if (n_inward > 0)
      m_result.notes.push_back("the normals of " + std::to_string(n_inward) + " of " +
                               counted(n_closed, "closed component") +
                               " point inwards, as those of a cavity do; they were left so");
  }

  void note_coincident_points()
  {
    std::vector<int> order(m_result.points.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      const CGAL::Comparison_result c = CGAL::compare_xyz(point(a), point(b));
      return c == CGAL::SMALLER || (c == CGAL::EQUAL && a < b);
    });
    std::size_t n = 0;
    int first = -1;
    for (std::size_t i = 1; i < order.size(); ++i)
      if (point(order[i - 1]) == point(order[i])) {
        ++n;
        first = first < 0 ? order[i] : std::min(first, order[i]);
      }
    if (n > 0)
      m_result.notes.push_back(counted(n, "point") + " (one at " + place(first) + ") " + (n == 1 ? "has" : "have") +
                               " the same coordinates as another one, and the surface is not connected there; merge "
                               "such points if it should be");
  }

  static std::string counted(std::size_t n, const std::string& what)
  {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
  }

  std::string polygon_name(std::size_t f) const
  {
    return (m_input.polygons[f].size() == 3 ? "triangle " : "polygon ") + std::to_string(f) + " (counting from 0)";
  }
  const Point_3& point(int v) const { return m_result.points[std::size_t(v)]; }
  std::string place(int v) const { return place_in_words(point(v)); }

  const Labelled_mesh& m_input;
  const std::string& m_source;
  bool m_rejects_cracks;
  Checked_surface m_result;
  std::size_t m_n_divided = 0;
};

} // namespace internal
} // namespace Quadrille

#endif
