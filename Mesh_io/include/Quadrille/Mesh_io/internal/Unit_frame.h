// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_UNIT_FRAME_H
#define QUADRILLE_MESH_IO_INTERNAL_UNIT_FRAME_H

#include <Quadrille/Mesh_io/internal/Outline.h>

#include <algorithm>
#include <cmath>

namespace Quadrille {
namespace internal {

/// Coordinates in which an outline fits into the unit square with its first curve pointing right, rounded to a grid.
///
/// Moved, rotated and scaled copies of an outline differ by rounding only, and have the same coordinates here, so that
/// they get the same triangles.
class Unit_frame {
public:
  explicit Unit_frame(const Outline& outline)
  {
    const std::vector<Point_2>& first = outline.curves.front().position;
    const auto direction = first[std::max<std::size_t>(1, first.size() / 3)] - first[0];
    const double length = std::hypot(direction.x(), direction.y());
    m_cos = direction.x() / length;
    m_sin = direction.y() / length;
    CGAL::Bbox_2 box;
    for (const Outline::Curve& curve : outline.curves)
      for (const Point_2& p : curve.position)
        box += turned(p).bbox();
    m_extent = std::max(box.xmax() - box.xmin(), box.ymax() - box.ymin());
    m_center = Point_2(0.5 * (box.xmin() + box.xmax()), 0.5 * (box.ymin() + box.ymax()));
  }

  double extent() const { return m_extent; }

  Point_2 to_unit(const Point_2& p) const
  {
    const Point_2 q = turned(p);
    return Point_2(on_grid((q.x() - m_center.x()) / m_extent), on_grid((q.y() - m_center.y()) / m_extent));
  }

  Point_2 from_unit(const Point_2& p) const
  {
    const double x = m_center.x() + m_extent * p.x(), y = m_center.y() + m_extent * p.y();
    return Point_2(m_cos * x - m_sin * y, m_sin * x + m_cos * y);
  }

  Outline to_unit(const Outline& outline) const
  {
    Outline result = outline;
    for (Outline::Point& point : result.points) {
      point.position = to_unit(point.position);
      point.size = on_grid(point.size / m_extent);
    }
    for (Outline::Curve& curve : result.curves) {
      curve.arc_length.assign(1, 0);
      for (std::size_t i = 0; i < curve.position.size(); ++i) {
        curve.position[i] = to_unit(curve.position[i]);
        if (i > 0)
          curve.arc_length.push_back(curve.arc_length.back() + distance(curve.position[i - 1], curve.position[i]));
      }
    }
    return result;
  }

private:
  Point_2 turned(const Point_2& p) const
  {
    return Point_2(m_cos * p.x() + m_sin * p.y(), -m_sin * p.x() + m_cos * p.y());
  }

  /// Coarse enough that rounding errors hardly ever matter, fine enough for any detail that can be meshed.
  static double on_grid(double x)
  {
    constexpr double grid = 4294967296.0; // 2^32
    return std::round(x * grid) / grid;
  }

  double m_cos = 1, m_sin = 0, m_extent = 1;
  Point_2 m_center;
};

} // namespace internal
} // namespace Quadrille

#endif
