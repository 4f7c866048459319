// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_CROSS_HARMONICS_IMPL_H
#define QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_CROSS_HARMONICS_IMPL_H

#include <Quadrille/Symmetric_tensors/internal/spherical_harmonics.h>

#include <Eigen/Geometry>

#include <cmath>
#include <utility>

namespace Quadrille {
namespace internal {

/// The coefficients of degree 4 of a cross's tensor are (8/5) sqrt(pi / 21) q, and q = c (Y(r1) + Y(r2) + Y(r3)).
inline double tensor_factor() { return 8.0 / 5 * std::sqrt(std::acos(-1.0) / 21); }
inline double cross_factor() { return std::sqrt(16 * std::acos(-1.0) / 189); }

/// Turns the pairs of orders -m and m by m times the angle whose cosine and sine are given.
template <class S> void rotate_about_z(const S& cosine, const S& sine, Eigen::Matrix<S, 9, 1>& q)
{
  S c = cosine, s = sine;
  for (int m = 1; m <= 4; ++m) {
    const S low = q[4 - m], high = q[4 + m];
    q[4 - m] = c * low + s * high;
    q[4 + m] = c * high - s * low;
    const S next = c * cosine - s * sine;
    s = s * cosine + c * sine;
    c = next;
  }
}

/// The action of the rotation about x by 90 degrees.
inline Cross_harmonics rotate_about_x_by_90(const Cross_harmonics& q)
{
  const double r2 = std::sqrt(2.0) / 4, r5 = std::sqrt(5.0) / 4, r7 = std::sqrt(7.0) / 4, r14 = std::sqrt(14.0) / 4,
               r35 = std::sqrt(35.0) / 8;
  Cross_harmonics p;
  p << r14 * q[5] - r2 * q[7], -0.75 * q[1] + r7 * q[3], r2 * q[5] + r14 * q[7], r7 * q[1] + 0.75 * q[3],
      0.375 * q[4] + r5 * q[6] + r35 * q[8], -r14 * q[0] - r2 * q[2], r5 * q[4] + 0.5 * q[6] - r7 * q[8],
      r2 * q[0] - r14 * q[2], r35 * q[4] - r7 * q[6] + 0.125 * q[8];
  return p;
}

/// And of its inverse.
inline Cross_harmonics rotate_about_x_by_minus_90(const Cross_harmonics& q)
{
  const double r2 = std::sqrt(2.0) / 4, r5 = std::sqrt(5.0) / 4, r7 = std::sqrt(7.0) / 4, r14 = std::sqrt(14.0) / 4,
               r35 = std::sqrt(35.0) / 8;
  Cross_harmonics p;
  p << -r14 * q[5] + r2 * q[7], -0.75 * q[1] + r7 * q[3], -r2 * q[5] - r14 * q[7], r7 * q[1] + 0.75 * q[3],
      0.375 * q[4] + r5 * q[6] + r35 * q[8], r14 * q[0] + r2 * q[2], r5 * q[4] + 0.5 * q[6] - r7 * q[8],
      -r2 * q[0] + r14 * q[2], r35 * q[4] - r7 * q[6] + 0.125 * q[8];
  return p;
}

} // namespace internal

inline Cross_harmonics zonal_harmonics(const Eigen::Vector3d& n)
{
  return internal::harmonics_of_degree_4(n.x(), n.y(), n.z());
}

inline Cross_harmonics cross_harmonics(const Eigen::Matrix3d& R)
{
  return internal::cross_factor() * (zonal_harmonics(R.col(0)) + zonal_harmonics(R.col(1)) + zonal_harmonics(R.col(2)));
}

inline Symmetric_tensor_3 cross_tensor(const Cross_harmonics& q)
{
  Spherical_harmonics h = Spherical_harmonics::Zero();
  h[0] = 6 * std::sqrt(std::acos(-1.0)) / 5;
  h.tail<9>() = internal::tensor_factor() * q;
  return Symmetric_tensor_3::from_harmonics(h);
}

inline Cross_harmonics cross_harmonics(const Symmetric_tensor_3& tensor)
{
  return tensor.harmonics().tail<9>() / internal::tensor_factor();
}

inline Harmonic_rotation::Harmonic_rotation(const Eigen::Matrix3d& R)
{
  const double sine = std::hypot(R(0, 2), R(1, 2));
  const auto set = [this](int i, double cosine, double sine_i) {
    const double length = std::hypot(cosine, sine_i);
    m_cosines[i] = length > 0 ? cosine / length : 1;
    m_sines[i] = length > 0 ? sine_i / length : 0;
  };
  set(1, R(2, 2), sine);
  // Near the poles a and c are not well determined each; whatever a is, c is then taken from what is left.
  set(0, R(0, 2), R(1, 2));
  const Eigen::Vector3d x(m_cosines[0] * m_cosines[1], m_sines[0] * m_cosines[1], -m_sines[1]); // Rz(a) Ry(b) e_x
  const Eigen::Vector3d y(-m_sines[0], m_cosines[0], 0);                                        // Rz(a) Ry(b) e_y
  set(2, x.dot(R.col(0)), y.dot(R.col(0)));
}

inline Cross_harmonics Harmonic_rotation::operator()(const Cross_harmonics& q) const
{
  Cross_harmonics p = q;
  internal::rotate_about_z(m_cosines[2], m_sines[2], p);
  p = internal::rotate_about_x_by_90(p);
  internal::rotate_about_z(m_cosines[1], m_sines[1], p);
  p = internal::rotate_about_x_by_minus_90(p);
  internal::rotate_about_z(m_cosines[0], m_sines[0], p);
  return p;
}

inline Cross_harmonics Harmonic_rotation::inverse(const Cross_harmonics& q) const
{
  Cross_harmonics p = q;
  internal::rotate_about_z(m_cosines[0], -m_sines[0], p);
  p = internal::rotate_about_x_by_90(p);
  internal::rotate_about_z(m_cosines[1], -m_sines[1], p);
  p = internal::rotate_about_x_by_minus_90(p);
  internal::rotate_about_z(m_cosines[2], -m_sines[2], p);
  return p;
}

template <class S> Eigen::Matrix<S, 9, 1> rotation_generator(int axis, const Eigen::Matrix<S, 9, 1>& q)
{
  const S a = S(std::sqrt(2.0)), b = S(std::sqrt(3.5)), c = S(3 / std::sqrt(2.0)), d = S(std::sqrt(10.0));
  Eigen::Matrix<S, 9, 1> p;
  if (axis == 0)
    p << -a * q[7], -a * q[8] - b * q[6], -b * q[7] - c * q[5], -c * q[6] - d * q[4], d * q[3], c * q[2],
        b * q[1] + c * q[3], a * q[0] + b * q[2], a * q[1];
  else if (axis == 1)
    p << a * q[1], -a * q[0] + b * q[2], -b * q[1] + c * q[3], -c * q[2], -d * q[5], d * q[4] - c * q[6],
        c * q[5] - b * q[7], b * q[6] - a * q[8], a * q[7];
  else
    p << S(4) * q[8], S(3) * q[7], S(2) * q[6], q[5], S(0), -q[3], S(-2) * q[2], S(-3) * q[1], S(-4) * q[0];
  return p;
}

inline double product_of_crosses(const Eigen::Matrix3d& P) { return 5.0 / 6 * P.array().square().square().sum() - 1.5; }

inline Aligned_crosses crosses_aligned_with(const Eigen::Vector3d& n)
{
  Aligned_crosses result;
  const Eigen::Vector3d x = n.unitOrthogonal();
  result.frame << x, n.cross(x), n;
  const Harmonic_rotation rotation(result.frame);
  result.offset = std::sqrt(7.0 / 12) * rotation(Cross_harmonics::Unit(4));
  result.basis << rotation(Cross_harmonics::Unit(0)), rotation(Cross_harmonics::Unit(8));
  return result;
}

} // namespace Quadrille

#endif
