// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_LAYOUT_GEOMETRY_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_LAYOUT_GEOMETRY_H

#include <Quadrille/Quad_extraction/internal/Isoline_tracer.h>
#include <Quadrille/Quad_layout.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Positions of a layout's arcs and patches in the domain, in the plane or in space, by the inverse of the map.
template <int D> class Layout_geometry {
public:
  using Point = Eigen::Matrix<double, D, 1>;

  /// A point and the triangle that holds it.
  struct Place {
    int face = -1;
    Point point = Point::Zero();
  };

  /// All arguments must outlive the object.
  Layout_geometry(const Seamless_map& map, const std::vector<Point>& vertex_points, const Quad_layout& layout)
      : m_map(&map), m_points(&vertex_points), m_layout(&layout)
  {
  }

  Point point(const Quad_layout::Mesh_point& p) const
  {
    const std::array<int, 3>& t = m_map->mesh().triangle(p.face);
    // Corners are returned as they are, not as rounded combinations.
    return at(*m_points, t[0]) + p.b1 * (at(*m_points, t[1]) - at(*m_points, t[0])) +
           p.b2 * (at(*m_points, t[2]) - at(*m_points, t[0]));
  }

  /// The point of half-arc `h` at map length `x` from its source.
  Point point_on_arc(int h, double x) const { return place_on_arc(h, x).point; }

  Place place_on_arc(int h, double x) const
  {
    const Quad_layout::Arc& arc = at(m_layout->arcs, h / 2);
    const double s = h % 2 ? arc.length - x : x;
    const int i = part(arc, s);
    const Quad_layout::Arc_point& a = at(arc.points, i);
    const Quad_layout::Arc_point& b = at(arc.points, i + 1);
    const double t = b.position > a.position ? (s - a.position) / (b.position - a.position) : 0;
    return {a.face, (1 - t) * point(a.point) + t * point(b.point)};
  }

  /// Places at the map heights `heights` (increasing) on the isoline that leaves half-arc `h` at map length `x` from
  /// its source, perpendicularly to its left. Positions are sampled, so unlike in tracing rounding is harmless here.
  void sample(int h, double x, const std::vector<double>& heights, std::vector<Place>& result) const
  {
    result.clear();
    Isoline_step step = perpendicular(h, x);
    while (result.size() < heights.size()) {
      step.exit = exit_halfedge(*m_map, step);
      if (step.exit < 0) {
        keep_inside(step);
        step.exit = exit_halfedge(*m_map, step);
      }
      const double exit_height = exit_position(step);
      while (result.size() < heights.size() && heights[result.size()] <= exit_height)
        result.push_back(place_in_face(step.face, step.point(heights[result.size()])));
      if (m_map->mesh().is_boundary(step.exit))
        result.resize(heights.size(), place_in_face(step.face, step.point(exit_height)));
      else
        step = across(*m_map, step);
    }
  }

private:
  /// Index of the part of the arc that holds position `s`.
  static int part(const Quad_layout::Arc& arc, double s)
  {
    const auto after = std::upper_bound(arc.points.begin(), arc.points.end(), s,
                                        [](double x, const Quad_layout::Arc_point& p) { return x < p.position; });
    const int i = static_cast<int>(after - arc.points.begin()) - 1;
    return std::min(std::max(i, 0), size_of(arc.points) - 2);
  }

  Isoline_step perpendicular(int h, double x) const
  {
    const Quad_layout::Arc& arc = at(m_layout->arcs, h / 2);
    const Quad_layout::Arc_point& start = at(arc.points, part(arc, h % 2 ? arc.length - x : x));
    Isoline_step isoline{start.face, start.halfedge, start.direction, start.level, start.offset};
    if (h % 2) {
      if (start.halfedge >= 0)
        isoline = across(*m_map, isoline);
      isoline.direction = (isoline.direction + 2) & 3;
      isoline.level = -isoline.level;
      isoline.offset = arc.length - isoline.offset;
    }
    return {isoline.face, -1, (isoline.direction + 1) & 3, isoline.offset - x, -isoline.level};
  }

  double exit_position(const Isoline_step& step) const
  {
    const Uv& a = m_map->uv(step.exit);
    const Uv& b = m_map->uv(Indexed_triangulation::next(step.exit));
    const double from_a = step.level - along(step.direction + 1, a);
    const double t = from_a / (along(step.direction + 1, b) - along(step.direction + 1, a));
    return (1 - t) * step.position(a) + t * step.position(b);
  }

  /// Moves an isoline that misses its first triangle by rounding back into it.
  void keep_inside(Isoline_step& step) const
  {
    double low = along(step.direction + 1, m_map->uv(3 * step.face));
    double high = low;
    for (int h = 3 * step.face + 1; h < 3 * step.face + 3; ++h) {
      low = std::min(low, along(step.direction + 1, m_map->uv(h)));
      high = std::max(high, along(step.direction + 1, m_map->uv(h)));
    }
    constexpr double inside = 1e-6; // of the triangle's width; only a first step is ever moved
    step.level = std::min({std::max(step.level, low), high - inside * (high - low), std::nextafter(high, low)});
  }

  Place place_in_face(int f, const Uv& p) const
  {
    const Uv& a = m_map->uv(3 * f);
    const Uv& b = m_map->uv(3 * f + 1);
    const Uv& c = m_map->uv(3 * f + 2);
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    const double b1 = ((p[0] - a[0]) * (c[1] - a[1]) - (p[1] - a[1]) * (c[0] - a[0])) / area;
    const double b2 = ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / area;
    return {f, point({f, b1, b2})};
  }

  const Seamless_map* m_map;
  const std::vector<Point>* m_points;
  const Quad_layout* m_layout;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
