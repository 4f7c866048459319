// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_CANONICAL_POSITION_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_CANONICAL_POSITION_H

#include <Quadrille/Symmetric_tensor_2.h>

#include <cmath>
#include <vector>

namespace Quadrille {
namespace internal {

/// The similarity that brings a domain to unit size with its first constrained edge along the x-axis.
///
/// The field is computed there, on coordinates rounded to 32 bits, so that moved, turned and scaled copies of a domain
/// start from the same bits: melting amplifies the smallest difference.
class Canonical_position {
public:
  Canonical_position(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& axis, double size_unit)
      : m_size_unit(size_unit), m_axis(axis.normalized())
  {
    Eigen::Vector2d low = points.front(), high = points.front();
    for (const Eigen::Vector2d& p : points) {
      low = low.cwiseMin(to_axes(p));
      high = high.cwiseMax(to_axes(p));
    }
    m_center = 0.5 * (low + high);
    m_diameter = (high - low).norm();
  }

  Eigen::Vector2d point(const Eigen::Vector2d& p) const
  {
    const double resolution = std::ldexp(1.0, 32);
    const Eigen::Vector2d q = (to_axes(p) - m_center) / m_diameter;
    return {std::round(q.x() * resolution) / resolution, std::round(q.y() * resolution) / resolution};
  }
  double size(double s) const
  {
    const double resolution = std::ldexp(1.0, 32);
    return std::round(s / m_size_unit * resolution) / resolution;
  }
  Eigen::Vector2d original_direction(const Eigen::Vector2d& d) const
  {
    return {m_axis.x() * d.x() - m_axis.y() * d.y(), m_axis.y() * d.x() + m_axis.x() * d.y()};
  }
  Eigen::Matrix2d metric(const Eigen::Matrix2d& m) const
  {
    Eigen::Matrix2d axes; // columns
    axes << m_axis.x(), -m_axis.y(), m_axis.y(), m_axis.x();
    return m_size_unit * m_size_unit * axes.transpose() * m * axes;
  }
  double original_size(double s) const { return s * m_size_unit; }
  Circular_harmonics original_harmonics(const Circular_harmonics& q) const
  {
    return m_size_unit * Symmetric_tensor_2::from_harmonics(q).rotated(axis_angle()).harmonics();
  }
  Circular_harmonics harmonics(const Circular_harmonics& original) const
  {
    return Symmetric_tensor_2::from_harmonics(original).rotated(-axis_angle()).harmonics() / m_size_unit;
  }

private:
  double axis_angle() const { return std::atan2(m_axis.y(), m_axis.x()); }
  Eigen::Vector2d to_axes(const Eigen::Vector2d& p) const
  {
    return {m_axis.dot(p), m_axis.x() * p.y() - m_axis.y() * p.x()};
  }

  double m_size_unit;
  Eigen::Vector2d m_axis, m_center;
  double m_diameter = 1;
};

} // namespace internal
} // namespace Quadrille

#endif
