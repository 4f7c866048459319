// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_CANONICAL_SPACE_POSITION_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_CANONICAL_SPACE_POSITION_H

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <vector>

namespace Quadrille {
namespace internal {

/// The similarity that brings a surface to unit size, with its first triangle in a fixed direction: as
/// `Canonical_position` in the plane.
class Canonical_space_position {
public:
  /// `axes`: of the first triangle, columns.
  Canonical_space_position(const std::vector<Eigen::Vector3d>& points, const Eigen::Matrix3d& axes, double size_unit)
      : m_axes(axes), m_size_unit(size_unit)
  {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(HUGE_VAL), high = -low;
    for (const Eigen::Vector3d& p : points) {
      low = low.cwiseMin(m_axes.transpose() * p);
      high = high.cwiseMax(m_axes.transpose() * p);
    }
    m_center = 0.5 * (low + high);
    m_diameter = (high - low).norm();
  }

  Eigen::Vector3d point(const Eigen::Vector3d& p) const
  {
    return ((m_axes.transpose() * p - m_center) / m_diameter).unaryExpr(&rounded);
  }
  double size(double s) const { return rounded(s / m_size_unit); }
  double original_size(double s) const { return s * m_size_unit; }
  Eigen::Vector3d original_direction(const Eigen::Vector3d& d) const { return m_axes * d; }
  const Eigen::Matrix3d& axes() const { return m_axes; }

private:
  static double rounded(double x) { return std::ldexp(std::round(std::ldexp(x, 32)), -32); }

  Eigen::Matrix3d m_axes;
  Eigen::Vector3d m_center;
  double m_diameter = 1;
  double m_size_unit;
};

} // namespace internal
} // namespace Quadrille

#endif
