// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_OUTLINE_H
#define QUADRILLE_MESH_IO_INTERNAL_OUTLINE_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Support/internal/segment_intersections.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace Quadrille {
namespace internal {

using Point_2 = Segment_kernel::Point_2;

inline double distance(const Point_2& p, const Point_2& q) { return std::hypot(p.x() - q.x(), p.y() - q.y()); }

/// A geometry in the plane: points, curves between them, surfaces between curves.
struct Outline {
  struct Point {
    int tag;
    Point_2 position;
    double size; ///< prescribed element size, 0 for none
  };
  struct Curve {
    Entity_label label;
    int first = -1, last = -1; ///< indices into `points`; equal for a closed curve
    bool straight = false;
    /// Dense samples from first to last: parameter, arc length from the first point, position.
    std::vector<double> parameter, arc_length;
    std::vector<Point_2> position;
    /// By how much the geometry library's curve misses its first and its last point; in between, linear in the
    /// parameter.
    std::array<Segment_kernel::Vector_2, 2> end_gap = {CGAL::NULL_VECTOR, CGAL::NULL_VECTOR};
    int n_surfaces = 0; ///< how many surfaces it bounds

    double length() const { return arc_length.back(); }
    /// What has to be added to the geometry library's point at parameter `t`.
    Segment_kernel::Vector_2 correction_at(double t) const
    {
      const double w = (t - parameter.front()) / (parameter.back() - parameter.front());
      return (1 - w) * end_gap[0] + w * end_gap[1];
    }
    bool closed() const { return first == last; }

    /// The parameter of the point at arc length `s`, linear between samples.
    double parameter_at(double s) const
    {
      const std::size_t i = sample_before(s);
      const double width = arc_length[i + 1] - arc_length[i];
      const double w = width > 0 ? (s - arc_length[i]) / width : 0;
      return parameter[i] + w * (parameter[i + 1] - parameter[i]);
    }

    /// The sampled position at arc length `s`.
    Point_2 position_at(double s) const
    {
      const std::size_t i = sample_before(s);
      const double width = arc_length[i + 1] - arc_length[i];
      const double w = width > 0 ? (s - arc_length[i]) / width : 0;
      return position[i] + w * (position[i + 1] - position[i]);
    }

  private:
    std::size_t sample_before(double s) const
    {
      const auto after = std::upper_bound(arc_length.begin() + 1, arc_length.end() - 1, s);
      return std::size_t(after - arc_length.begin()) - 1;
    }
  };
  struct Surface {
    Entity_label label;
    std::vector<int> boundary; ///< indices into `curves`
    std::vector<int> embedded; ///< curves inside
  };

  std::vector<Point> points;
  std::vector<Curve> curves;
  std::vector<Surface> surfaces;
  std::vector<Physical_group> groups;
  std::vector<std::string> notes; ///< what the user should know
  double z = 0;

  CGAL::Bbox_2 bbox() const
  {
    CGAL::Bbox_2 box;
    for (const Curve& curve : curves)
      for (const Point_2& p : curve.position)
        box += p.bbox();
    return box;
  }
  double diagonal() const
  {
    const CGAL::Bbox_2 box = bbox();
    return std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin());
  }
};

/// The region inside a set of segments by the even-odd rule, in floating point: for choosing sizes, not for decisions.
class Even_odd_region {
public:
  explicit Even_odd_region(std::vector<std::array<Point_2, 2>> segments) : m_segments(std::move(segments))
  {
    m_low = std::numeric_limits<double>::infinity();
    m_high = -m_low;
    for (const auto& [p, q] : m_segments) {
      m_low = std::min({m_low, p.y(), q.y()});
      m_high = std::max({m_high, p.y(), q.y()});
    }
    m_slabs.resize(std::clamp<std::size_t>(m_segments.size(), 64, 4096));
    for (std::size_t i = 0; i < m_segments.size(); ++i) {
      const auto [low, high] = std::minmax(m_segments[i][0].y(), m_segments[i][1].y());
      for (std::size_t s = slab(low); s <= slab(high); ++s)
        m_slabs[s].push_back(i);
    }
  }

  bool contains(const Point_2& p) const
  {
    if (!(p.y() > m_low && p.y() < m_high))
      return false;
    bool inside = false;
    for (const std::size_t i : m_slabs[slab(p.y())])
      inside ^= crosses(m_segments[i], p.y()) && abscissa(m_segments[i], p.y()) > p.x();
    return inside;
  }

  /// By one horizontal line in the middle of each slab: good to a few percent.
  double area() const
  {
    const double height = (m_high - m_low) / double(m_slabs.size());
    double total = 0;
    std::vector<double> crossings;
    for (std::size_t s = 0; s < m_slabs.size(); ++s) {
      const double y = m_low + (double(s) + 0.5) * height;
      crossings.clear();
      for (const std::size_t i : m_slabs[s])
        if (crosses(m_segments[i], y))
          crossings.push_back(abscissa(m_segments[i], y));
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t k = 1; k < crossings.size(); k += 2)
        total += (crossings[k] - crossings[k - 1]) * height;
    }
    return total;
  }

private:
  using Segment = std::array<Point_2, 2>;
  static bool crosses(const Segment& s, double y) { return (s[0].y() > y) != (s[1].y() > y); }
  static double abscissa(const Segment& s, double y)
  {
    return s[0].x() + (y - s[0].y()) / (s[1].y() - s[0].y()) * (s[1].x() - s[0].x());
  }
  std::size_t slab(double y) const
  {
    const double s = (y - m_low) / (m_high - m_low) * double(m_slabs.size());
    return std::min(m_slabs.size() - 1, std::size_t(std::max(0.0, s)));
  }

  std::vector<Segment> m_segments;
  std::vector<std::vector<std::size_t>> m_slabs;
  double m_low, m_high;
};

/// The part of the plane that the surfaces of an outline cover.
inline Even_odd_region covered_region(const Outline& outline)
{
  std::vector<std::array<Point_2, 2>> segments;
  for (const Outline::Curve& curve : outline.curves)
    if (curve.n_surfaces % 2 == 1)
      for (std::size_t i = 1; i < curve.position.size(); ++i)
        segments.push_back({curve.position[i - 1], curve.position[i]});
  return Even_odd_region(std::move(segments));
}

} // namespace internal
} // namespace Quadrille

#endif
