// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_CHECK_OUTLINE_H
#define QUADRILLE_MESH_IO_INTERNAL_CHECK_OUTLINE_H

#include <Quadrille/Mesh_io/internal/Outline.h>
#include <Quadrille/Mesh_io/internal/Segment_mesher.h>
#include <Quadrille/Mesh_io/internal/check_triangles.h>
#include <Quadrille/Mesh_io/internal/format_place.h>
#include <Quadrille/Support/internal/segment_intersections.h>

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Finds out, before any triangle is made, that curves do not bound a domain, and says it in the user's terms.
class Outline_checker {
public:
  Outline_checker(const Outline& outline, const std::string& path) : m_outline(outline), m_path(path) {}

  /// What can be told from the ends of curves and from straight curves. Exact.
  void check_ends_and_straight_curves() const
  {
    check_border_is_manifold();
    std::vector<Point_2> points;
    for (const Outline::Point& point : m_outline.points)
      points.push_back(point.position);
    std::vector<Numbered_segment> segments;
    std::vector<int> curves;
    for (std::size_t c = 0; c < m_outline.curves.size(); ++c)
      if (m_outline.curves[c].straight) {
        segments.push_back({{m_outline.curves[c].first, m_outline.curves[c].last}});
        curves.push_back(int(c));
      }
    check_no_conflict(points, segments, curves, false);
  }

  /// The same for all curves, made of segments; and that curves within a surface do not leave it.
  /// \param is_coarse the segments are longer than details and gaps ask for
  void check_segments(const Segmented_outline& segmented, bool is_coarse) const
  {
    check_no_conflict(segmented.points, segmented.segments, segmented.curve_of_segment, is_coarse);
    for (const Outline::Surface& surface : m_outline.surfaces)
      check_embedded_curves(surface, segmented);
  }

private:
  [[noreturn]] void fail(const std::string& reason) const { throw Invalid_input_error(m_path + ": " + reason); }

  std::string tag(int curve) const { return std::to_string(m_outline.curves[std::size_t(curve)].label.tag); }

  static std::string place(const Point_2& p) { return format_place(p.x(), p.y()); }

  /// The border passes through each of its points once.
  void check_border_is_manifold() const
  {
    std::map<int, int> degree;
    for (const Outline::Curve& curve : m_outline.curves)
      if (curve.n_surfaces == 1) {
        ++degree[curve.first];
        ++degree[curve.last];
      }
    for (const auto& [p, n] : degree)
      if (n > 2) {
        const Outline::Point& point = m_outline.points[std::size_t(p)];
        fail("the border touches itself in point " + std::to_string(point.tag) + ", " + place(point.position) +
             ": holes that touch each other or the outline, or parts of the domain that only share a point, cannot "
             "be meshed; move them apart, or let them overlap and merge them");
      }
  }

  void check_no_conflict(const std::vector<Point_2>& points, const std::vector<Numbered_segment>& segments,
                         const std::vector<int>& curve_of_segment, bool is_coarse) const
  {
    const auto pair = find_segment_conflict(points, segments);
    if (!pair)
      return;
    const std::array<int, 2>&s = segments[pair->first].ends, &t = segments[pair->second].ends;
    const int c = curve_of_segment[pair->first], d = curve_of_segment[pair->second];
    const std::string both = "curves " + tag(c) + " and " + tag(d);
    for (const int a : s)
      for (const int b : t)
        if (a != b && points[std::size_t(a)] == points[std::size_t(b)] && is_model_point(a) && is_model_point(b))
          fail("points " + point_tag(a) + " and " + point_tag(b) + " have the same coordinates, " +
               place(points[std::size_t(a)]) + ", so that " + both +
               " touch there without being connected; merge duplicate points, or move apart what shall not touch");
    const Point_2& p = points[std::size_t(s[0])];
    if (c == d)
      fail("curve " + tag(c) + " intersects itself near " + place(p));
    const auto at = [&](int i) { return points[std::size_t(i)]; };
    if (CGAL::collinear(at(s[0]), at(s[1]), at(t[0])) && CGAL::collinear(at(s[0]), at(s[1]), at(t[1])))
      fail(both + " overlap near " + place(p) +
           ": the gap between them has no width; a slit is one curve that is "
           "embedded in its surface, not two in the same place");
    fail("the outline intersects itself: " + both + " cross, touch or overlap near " + place(p) +
         " without a common point there" +
         (is_coarse ? ", or come closer than the triangles there; try a smaller triangle size" : ""));
  }

  bool is_model_point(int p) const { return std::size_t(p) < m_outline.points.size(); }
  std::string point_tag(int p) const { return std::to_string(m_outline.points[std::size_t(p)].tag); }

  /// \pre no two segments conflict, so that a segment is either inside or outside as a whole.
  void check_embedded_curves(const Outline::Surface& surface, const Segmented_outline& segmented) const
  {
    const auto end = [&](int segment, std::size_t i) {
      return segmented.points[std::size_t(segmented.segments[std::size_t(segment)].ends[i])];
    };
    for (const int embedded : surface.embedded)
      for (const int s : segmented.segments_of_curve[std::size_t(embedded)]) {
        const Point_2 middle = CGAL::midpoint(end(s, 0), end(s, 1));
        bool inside = false;
        for (const int curve : surface.boundary)
          for (const int b : segmented.segments_of_curve[std::size_t(curve)])
            inside ^= crosses_ray(end(b, 0), end(b, 1), middle);
        if (!inside)
          fail("curve " + tag(embedded) + " leaves surface " + std::to_string(surface.label.tag) +
               ", in which it is embedded, near " + place(middle) +
               "; cut it where it meets the border, or take it out of the surface");
      }
  }

  /// Whether segment ab crosses the ray from p to the right. Exact.
  static bool crosses_ray(const Point_2& a, const Point_2& b, const Point_2& p)
  {
    return (a.y() > p.y()) != (b.y() > p.y()) &&
           (CGAL::orientation(a, b, p) == CGAL::COUNTERCLOCKWISE) == (b.y() > a.y());
  }

  const Outline& m_outline;
  const std::string& m_path;
};

} // namespace internal
} // namespace Quadrille

#endif
