// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_POLYLINE_CURVE_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_POLYLINE_CURVE_H

#include <Quadrille/Quad_extraction/internal/at.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// A polyline in the plane or in space, parametrised by arc length, and the smooth curve through its points (cubic
/// Hermite pieces, kinks kept).
template <int D> class Polyline_curve {
public:
  using Point = Eigen::Matrix<double, D, 1>;

  /// A closed curve repeats its first point at the end; its positions are understood modulo the length.
  Polyline_curve(std::vector<Point> points, bool closed, int curve)
      : m_points(std::move(points)), m_closed(closed), m_curve(curve)
  {
    m_position.push_back(0);
    for (std::size_t i = 1; i < m_points.size(); ++i)
      m_position.push_back(m_position.back() + (m_points[i] - m_points[i - 1]).norm());
    estimate_tangents();
  }

  double length() const { return m_position.back(); }
  bool is_closed() const { return m_closed; }
  /// Id of the domain's curve.
  int curve() const { return m_curve; }

  /// The point of the polyline at arc length `t`.
  Point point(double t) const
  {
    t = wrapped(t);
    const std::size_t i = part(t);
    const double s = (t - m_position[i]) / (m_position[i + 1] - m_position[i]);
    return (1 - s) * m_points[i] + s * m_points[i + 1];
  }

  /// The point of the smooth curve at `t` and its derivative there. Outside an open curve it goes on straight.
  std::pair<Point, Point> smooth(double t) const
  {
    t = wrapped(t);
    if (!m_closed && t <= 0)
      return {m_points.front() + t * m_leaving.front(), m_leaving.front()};
    if (!m_closed && t >= length())
      return {m_points.back() + (t - length()) * m_arriving.back(), m_arriving.back()};
    const std::size_t i = part(t);
    const double h = m_position[i + 1] - m_position[i];
    const double s = (t - m_position[i]) / h;
    const Point& p = m_points[i];
    const Point& q = m_points[i + 1];
    const Point& a = m_leaving[i];
    const Point& b = m_arriving[i + 1];
    const Point value = p + s * s * (3 - 2 * s) * (q - p) + h * s * (1 - s) * ((1 - s) * a - s * b);
    const Point derivative = 6 * s * (1 - s) / h * (q - p) + (1 - s) * (1 - 3 * s) * a + s * (3 * s - 2) * b;
    return {value, derivative};
  }

private:
  double wrapped(double t) const
  {
    if (!m_closed)
      return t;
    t = std::fmod(t, length());
    return t < 0 ? t + length() : t;
  }

  std::size_t part(double t) const
  {
    const auto after = std::upper_bound(m_position.begin() + 1, m_position.end() - 1, t);
    return std::size_t(after - m_position.begin()) - 1;
  }

  /// Parabolas through three points; where the polyline turns by more than a smooth curve's would, one-sided ones.
  void estimate_tangents()
  {
    constexpr double cos_of_kink = 0.9;
    const std::size_t n = m_points.size() - 1; // parts
    std::vector<Point> direction;
    for (std::size_t i = 0; i < n; ++i)
      direction.push_back((m_points[i + 1] - m_points[i]) / (m_position[i + 1] - m_position[i]));
    m_leaving.resize(n + 1);
    m_arriving.resize(n + 1);
    std::vector<char> kink(n + 1, 1);
    for (std::size_t i = m_closed ? 0 : 1; i < n; ++i) {
      const std::size_t before = i == 0 ? n - 1 : i - 1;
      kink[i] = direction[before].dot(direction[i]) < cos_of_kink ? 1 : 0;
      if (kink[i])
        continue;
      const double h = m_position[before + 1] - m_position[before];
      const double k = m_position[i + 1] - m_position[i];
      m_leaving[i] = m_arriving[i] = (k * direction[before] + h * direction[i]) / (h + k);
    }
    if (m_closed) {
      kink[n] = kink[0];
      m_arriving[n] = m_arriving[0];
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (kink[i])
        m_leaving[i] = kink[i + 1] ? direction[i] : Point(2 * direction[i] - m_arriving[i + 1]);
      if (kink[i + 1])
        m_arriving[i + 1] = kink[i] ? direction[i] : Point(2 * direction[i] - m_leaving[i]);
    }
    m_leaving[n] = m_leaving[0];
    m_arriving[0] = m_arriving[n];
  }

  std::vector<Point> m_points;
  std::vector<double> m_position; ///< arc length at each point
  std::vector<Point> m_arriving;  ///< tangent on the side of the preceding part
  std::vector<Point> m_leaving;   ///< and of the following one
  bool m_closed;
  int m_curve;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
