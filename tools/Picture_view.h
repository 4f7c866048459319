// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_PICTURE_VIEW_H
#define QUADRILLE_TOOLS_PICTURE_VIEW_H

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace Quadrille {

/// A view of points in space without perspective, by default from the front, the right and above, fitted to a page.
class Picture_view {
public:
  using Points = std::vector<std::array<double, 3>>;

  /// `toward`: from the points to the viewer, not vertical.
  explicit Picture_view(const Points& points, const Eigen::Vector3d& toward = {0.45, -0.8, 0.4})
  {
    const Eigen::Vector3d z = toward.normalized(), x = Eigen::Vector3d::UnitZ().cross(z).normalized();
    m_rotation << x.transpose(), z.cross(x).transpose(), z.transpose();
    Eigen::Vector3d low = Eigen::Vector3d::Constant(HUGE_VAL), high = -low;
    for (const auto& [px, py, pz] : points) {
      const Eigen::Vector3d p = m_rotation * Eigen::Vector3d(px, py, pz);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    m_low = low;
    m_high = high;
    m_scale = size / std::max({high[0] - low[0], high[1] - low[1], 1e-300});
  }

  double width() const { return (m_high[0] - m_low[0]) * m_scale + 2 * margin; }
  double height() const { return (m_high[1] - m_low[1]) * m_scale + 2 * margin; }

  /// x and y on the page; z towards the viewer.
  Eigen::Vector3d operator()(const Eigen::Vector3d& p) const
  {
    const Eigen::Vector3d q = m_rotation * p;
    return {(q[0] - m_low[0]) * m_scale + margin, (m_high[1] - q[1]) * m_scale + margin, q[2] * m_scale};
  }

  /// A direction in axes to the right, up and towards the viewer.
  Eigen::Vector3d turned(const Eigen::Vector3d& direction) const { return m_rotation * direction; }

  /// The first line of an SVG text and a white page.
  std::string page() const
  {
    const std::string extent = "width=\"" + number(width()) + "\" height=\"" + number(height()) + "\"";
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" " + extent + ">\n<rect " + extent + " fill=\"#fff\"/>\n";
  }

  /// One decimal is a tenth of a pixel.
  static std::string number(double x)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", x);
    return text;
  }

  /// A place on the page, in paths.
  static std::string place(const Eigen::Vector3d& p) { return number(p[0]) + " " + number(p[1]); }

  static std::string dot(const Eigen::Vector3d& p, int radius, const std::string& fill)
  {
    return "<circle r=\"" + std::to_string(radius) + "\" cx=\"" + number(p[0]) + "\" cy=\"" + number(p[1]) +
           "\" fill=\"" + fill + "\"/>\n";
  }

private:
  static constexpr double size = 860, margin = 20;
  Eigen::Matrix3d m_rotation;
  Eigen::Vector3d m_low, m_high;
  double m_scale = 1;
};

} // namespace Quadrille

#endif
