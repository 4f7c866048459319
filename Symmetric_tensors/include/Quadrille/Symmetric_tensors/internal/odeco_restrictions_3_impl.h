// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_ODECO_RESTRICTIONS_3_IMPL_H
#define QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_ODECO_RESTRICTIONS_3_IMPL_H

#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/Symmetric_tensors/internal/spherical_harmonics.h>
#include <Quadrille/cross_harmonics.h>
#include <Quadrille/odeco_tensors_2.h>

#include <Eigen/Geometry>

#include <cmath>

namespace Quadrille {
namespace internal {

/// The restrictions to the third coordinate axis, from which all others are by rotation.
class Canonical_restrictions {
public:
  Canonical_restrictions()
  {
    // With the polar angle t, (x^2 + y^2)^2 = sin^4 t times cos or sin of 0, 2 and 4 times the longitude.
    planar.setZero();
    planar(0, 0) = 7 / std::sqrt(70.0);
    planar(3, 0) = -std::sqrt(20.0 / 70);
    planar(10, 0) = 1 / std::sqrt(70.0);
    planar(5, 1) = planar(1, 2) = std::sqrt(27.0 / 28);
    planar(12, 1) = planar(8, 2) = -std::sqrt(1.0 / 28);
    planar(14, 3) = planar(6, 4) = 1;
    power = power_harmonics(Eigen::Vector3d::UnitZ());
    rest_of_power = (power - planar * (planar.transpose() * power)).normalized();
  }

  /// The fourth power of a unit vector: values of harmonics, scaled by degree since (v . x)^4 = 1/5 + 4/7 P2 + 8/35 P4.
  static Spherical_harmonics power_harmonics(const Eigen::Vector3d& v)
  {
    Spherical_harmonics q = even_harmonics(v.x(), v.y(), v.z());
    q.head<1>() *= 4 * pi / 5;
    q.segment<5>(1) *= 16 * pi / 35;
    q.tail<9>() *= 32 * pi / 315;
    return q;
  }

  Eigen::Matrix<double, 15, 5> planar; ///< orthonormal; the tensors of the plane in the order of `Circular_harmonics`
  Spherical_harmonics power;           ///< of the axis
  Spherical_harmonics rest_of_power;   ///< the part of it across `planar`, a unit vector
};

inline const Canonical_restrictions& canonical_restrictions()
{
  static const Canonical_restrictions restrictions;
  return restrictions;
}

/// The action of a rotation on harmonics of degree 0, 2 and 4.
class Even_harmonic_rotation {
public:
  explicit Even_harmonic_rotation(const Eigen::Matrix3d& R) : m_matrix(R), m_of_degree_4(R) {}

  Spherical_harmonics operator()(const Spherical_harmonics& q) const
  {
    // The part of degree 2 is the quadratic form of a traceless matrix, up to a factor.
    const double root3 = std::sqrt(3.0);
    Eigen::Matrix3d A;
    A << 0.5 * (q[5] - q[3] / root3), 0.5 * q[1], 0.5 * q[4], //
        0.5 * q[1], -0.5 * (q[5] + q[3] / root3), 0.5 * q[2], //
        0.5 * q[4], 0.5 * q[2], q[3] / root3;
    A = m_matrix * A * m_matrix.transpose();
    Spherical_harmonics p;
    p << q[0], 2 * A(0, 1), 2 * A(1, 2), root3 * A(2, 2), 2 * A(0, 2), A(0, 0) - A(1, 1), m_of_degree_4(q.tail<9>());
    return p;
  }

private:
  Eigen::Matrix3d m_matrix;
  Harmonic_rotation m_of_degree_4;
};

inline Eigen::Matrix3d frame_of_axis(const Eigen::Vector3d& axis)
{
  Eigen::Matrix3d frame;
  const Eigen::Vector3d x = axis.unitOrthogonal();
  frame << x, axis.cross(x), axis;
  return frame;
}

/// The given columns of the planar basis, turned to where the frame's last column is.
template <int n>
Odeco_restriction restriction_of_frame(const Eigen::Matrix3d& frame, double value, const int (&columns)[n])
{
  const Canonical_restrictions& canonical = canonical_restrictions();
  const Even_harmonic_rotation rotation(frame);
  Odeco_restriction result;
  result.frame = frame;
  result.offset = value * Canonical_restrictions::power_harmonics(frame.col(2));
  result.basis.resize(15, n);
  for (int i = 0; i < n; ++i)
    result.basis.col(i) = rotation(canonical.planar.col(columns[i]));
  return result;
}

} // namespace internal

QUADRILLE_INLINE double planar_part_scale() { return 16 / std::sqrt(315.0); }

QUADRILLE_INLINE Odeco_restriction unrestricted()
{
  Odeco_restriction result;
  result.basis.setIdentity(15, 15);
  return result;
}

QUADRILLE_INLINE Odeco_restriction restriction_to_axis_of_frame(const Eigen::Matrix3d& frame, double value)
{
  return internal::restriction_of_frame(frame, value, {0, 1, 2, 3, 4});
}

QUADRILLE_INLINE Odeco_restriction restriction_to_axis(const Eigen::Vector3d& axis, double value)
{
  return restriction_to_axis_of_frame(internal::frame_of_axis(axis), value);
}

QUADRILLE_INLINE Odeco_restriction restriction_to_axis(const Eigen::Vector3d& axis)
{
  Odeco_restriction result = restriction_to_axis(axis, 0);
  result.basis.conservativeResize(15, 6);
  result.basis.col(5) =
      internal::Even_harmonic_rotation(result.frame)(internal::canonical_restrictions().rest_of_power);
  return result;
}

QUADRILLE_INLINE Odeco_restriction restriction_to_axes(const Eigen::Vector3d& first, double first_value,
                                                       const Eigen::Vector3d& second, double second_value)
{
  Odeco_restriction result;
  result.frame << second, first.cross(second), first;
  result.offset = first_value * internal::Canonical_restrictions::power_harmonics(first) +
                  second_value * internal::Canonical_restrictions::power_harmonics(second);
  result.basis = internal::Canonical_restrictions::power_harmonics(result.frame.col(1)).normalized();
  return result;
}

QUADRILLE_INLINE Odeco_restriction restriction_to_axes(const Eigen::Vector3d& first, double first_value,
                                                       const Eigen::Vector3d& second)
{
  Odeco_restriction result;
  result.frame << second, first.cross(second), first;
  result.offset = first_value * internal::Canonical_restrictions::power_harmonics(first);
  const Spherical_harmonics p = internal::Canonical_restrictions::power_harmonics(second),
                            q = internal::Canonical_restrictions::power_harmonics(result.frame.col(1));
  result.basis.resize(15, 2);
  result.basis << (p + q).normalized(), (p - q).normalized(); // orthogonal, as p and q have the same norm
  return result;
}

QUADRILLE_INLINE Odeco_restriction restriction_to_isotropic(const Eigen::Vector3d& axis, double value)
{
  return internal::restriction_of_frame(internal::frame_of_axis(axis), value, {0, 3, 4});
}

QUADRILLE_INLINE Odeco_restriction restriction_to_crosses()
{
  Odeco_restriction result;
  result.offset = cross_tensor(Cross_harmonics::Zero()).harmonics();
  result.basis.setZero(15, 9);
  result.basis.bottomRows<9>().setIdentity();
  return result;
}

QUADRILLE_INLINE Odeco_restriction restriction_to_crosses(const Eigen::Vector3d& axis)
{
  Odeco_restriction result = internal::restriction_of_frame(internal::frame_of_axis(axis), 1, {3, 4});
  const Spherical_harmonics round = internal::canonical_restrictions().planar.col(0);
  // The mean of the plane's part is that of two values 1.
  result.offset +=
      planar_part_scale() * 2 * internal::odeco_band0() * internal::Even_harmonic_rotation(result.frame)(round);
  return result;
}

} // namespace Quadrille

#endif
