// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_CHECK_TRIANGLES_H
#define QUADRILLE_MESH_IO_INTERNAL_CHECK_TRIANGLES_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Mesh_io/internal/Spatial_extent.h>
#include <Quadrille/Mesh_io/internal/format_place.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>
#include <Quadrille/Support/internal/segment_intersections.h>
#include <Quadrille/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

/// Triangles in the plane whose points are all used; what is left of a `Labelled_mesh` once it has been checked.
struct Checked_triangles {
  std::vector<Segment_kernel::Point_2> points;
  std::vector<std::array<int, 3>> triangles; ///< positively oriented
  std::vector<int> point_of_input;           ///< per input point: index into `points`, -1 for isolated points
  bool reversed = false;                     ///< all triangles of some surface were clockwise
};

/// The checks that every planar triangulation has to pass, in the order in which their messages help most.
class Triangle_checker {
public:
  Triangle_checker(const Labelled_mesh& input, const std::string& source) : m_input(input), m_source(source) {}

  Checked_triangles run()
  {
    check_corners();
    check_coordinates();
    compact();
    orient();
    check_coincident_points();
    try {
      m_triangulation = Indexed_triangulation(m_result.points.size(), m_result.triangles);
    } catch (const Invalid_input_error& error) {
      throw Invalid_input_error(m_source + ": " + error.what() + " (counting from 0, isolated points left out)");
    }
    check_connected();
    check_border();
    return std::move(m_result);
  }

private:
  [[noreturn]] void fail(const std::string& reason) const { throw Invalid_input_error(m_source + ": " + reason); }

  void check_corners() const
  {
    if (m_input.polygons.empty())
      fail("there are no triangles; a planar domain is read from a geometry with surfaces or from a triangle mesh");
    for (std::size_t f = 0; f < m_input.polygons.size(); ++f) {
      const std::vector<int>& polygon = m_input.polygons[f];
      if (polygon.size() != 3)
        fail("face " + std::to_string(f) + " (counting from 0) has " + std::to_string(polygon.size()) +
             " corners; only triangles are read, so triangulate the mesh first");
      if (polygon[0] == polygon[1] || polygon[1] == polygon[2] || polygon[2] == polygon[0])
        fail("triangle " + std::to_string(f) + " (counting from 0) is degenerate: it uses a point twice");
    }
  }

  void check_coordinates() const
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<double, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
    for (const std::vector<int>& polygon : m_input.polygons)
      for (const int v : polygon)
        for (std::size_t k = 0; k < 3; ++k) {
          const double x = m_input.points[std::size_t(v)][k];
          if (!std::isfinite(x))
            fail("point " + std::to_string(v) + " (counting from 0) has a coordinate that is not a finite number");
          // Products of three coordinates have to stay inside the range of doubles.
          if (std::abs(x) > 1e100)
            fail("point " + std::to_string(v) + " (counting from 0) has a coordinate beyond 1e100; change the unit");
          low[k] = std::min(low[k], x);
          high[k] = std::max(high[k], x);
        }
    const double extent = std::max(high[0] - low[0], high[1] - low[1]);
    if (high[2] - low[2] > planarity_tolerance * extent)
      fail("z varies from " + format_value(low[2]) + " to " + format_value(high[2]) +
           ": a surface was given where a planar domain (z constant) is needed");
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
        m_result.points.emplace_back(m_input.points[v][0], m_input.points[v][1]);
      }
    for (const std::vector<int>& polygon : m_input.polygons) {
      std::array<int, 3> triangle;
      for (std::size_t i = 0; i < 3; ++i)
        triangle[i] = m_result.point_of_input[std::size_t(polygon[i])];
      m_result.triangles.push_back(triangle);
    }
  }

  CGAL::Orientation orientation(const std::array<int, 3>& t) const
  {
    return CGAL::orientation(point(t[0]), point(t[1]), point(t[2]));
  }

  /// A surface that is clockwise as a whole is seen from the other side, which is a convention of its file; a triangle
  /// that differs from the others of its surface is inverted.
  void orient()
  {
    struct Counts {
      std::size_t clockwise = 0, all = 0, first_clockwise = 0, first_counterclockwise = 0;
    };
    std::map<int, Counts> counts;
    const auto region = [&](std::size_t f) {
      return f < m_input.polygon_region.size() ? m_input.polygon_region[f] : -1;
    };
    for (std::size_t f = m_result.triangles.size(); f-- > 0;) {
      const CGAL::Orientation o = orientation(m_result.triangles[f]);
      if (o == CGAL::COLLINEAR)
        fail("triangle " + std::to_string(f) + " (counting from 0, at " + place(m_result.triangles[f][0]) +
             ") is degenerate: its corners lie on a line");
      Counts& c = counts[region(f)];
      ++c.all;
      c.clockwise += o == CGAL::CLOCKWISE;
      (o == CGAL::CLOCKWISE ? c.first_clockwise : c.first_counterclockwise) = f;
    }
    for (const auto& [r, c] : counts)
      if (c.clockwise != 0 && c.clockwise != c.all) {
        const std::size_t f = 2 * c.clockwise <= c.all ? c.first_clockwise : c.first_counterclockwise;
        fail("triangle " + std::to_string(f) + " (counting from 0, at " + place(m_result.triangles[f][0]) +
             ") is inverted: its orientation differs from that of most others (" +
             std::to_string(std::min(c.clockwise, c.all - c.clockwise)) + " of " + std::to_string(c.all) +
             " triangles)");
      }
    for (std::size_t f = 0; f < m_result.triangles.size(); ++f)
      if (counts[region(f)].clockwise != 0) {
        m_result.reversed = true;
        std::swap(m_result.triangles[f][1], m_result.triangles[f][2]);
      }
  }

  void check_coincident_points() const
  {
    std::vector<int> order(m_result.points.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      const CGAL::Comparison_result c = CGAL::compare_xy(point(a), point(b));
      return c == CGAL::SMALLER || (c == CGAL::EQUAL && a < b);
    });
    for (std::size_t i = 1; i < order.size(); ++i)
      if (point(order[i - 1]) == point(order[i]))
        fail("two points at " + place(order[i]) +
             " have the same coordinates, so that the triangles there are not "
             "connected; merge duplicate points");
  }

  void check_connected() const
  {
    const int n = m_triangulation.number_of_faces();
    std::vector<char> seen(std::size_t(n), 0);
    std::vector<int> stack{0};
    seen[0] = 1;
    int reached = 0;
    while (!stack.empty()) {
      const int f = stack.back();
      stack.pop_back();
      ++reached;
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int other = m_triangulation.opposite(h);
        if (other >= 0 && !seen[std::size_t(other / 3)]) {
          seen[std::size_t(other / 3)] = 1;
          stack.push_back(other / 3);
        }
      }
    }
    if (reached != n) {
      const std::size_t f = std::size_t(std::find(seen.begin(), seen.end(), 0) - seen.begin());
      fail("the domain is disconnected: triangle " + std::to_string(f) + " (counting from 0, at " +
           place(m_result.triangles[f][0]) + ") is not connected with triangle 0 at " +
           place(m_result.triangles[0][0]) + "; mesh the parts one by one");
    }
  }

  /// Positively oriented triangles with a border that does not meet itself cover every point at most once.
  void check_border() const
  {
    std::vector<Numbered_segment> border;
    for (int h = 0; h < m_triangulation.number_of_halfedges(); ++h)
      if (m_triangulation.is_boundary(h))
        border.push_back({{m_triangulation.source(h), m_triangulation.target(h)}});
    if (border.empty())
      fail("the triangles form a closed surface; a planar domain has a border");
    if (const auto pair = find_segment_conflict(m_result.points, border))
      fail("the outline intersects itself near " + place(border[pair->first].ends[0]) + ": the edge to " +
           place(border[pair->first].ends[1]) + " meets the edge from " + place(border[pair->second].ends[0]) + " to " +
           place(border[pair->second].ends[1]));
  }

  const Segment_kernel::Point_2& point(int v) const { return m_result.points[std::size_t(v)]; }
  std::string place(int v) const { return format_place(point(v).x(), point(v).y()); }

  const Labelled_mesh& m_input;
  const std::string& m_source;
  Checked_triangles m_result;
  Indexed_triangulation m_triangulation;
};

} // namespace internal
} // namespace Quadrille

#endif
