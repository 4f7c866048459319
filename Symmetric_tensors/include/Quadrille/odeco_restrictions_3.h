// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_RESTRICTIONS_3_H
#define QUADRILLE_ODECO_RESTRICTIONS_3_H

#include <Quadrille/Symmetric_tensor_3.h>

#include <Eigen/Core>

namespace Quadrille {

/// The tensors q = offset + basis s, s any vector: the affine hull of the odeco tensors that have given axes or values.
/// Columns of the basis are orthonormal. surface, Section 3.5.2.
struct Odeco_restriction {
  Spherical_harmonics offset = Spherical_harmonics::Zero();
  Eigen::Matrix<double, 15, Eigen::Dynamic> basis;
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity(); ///< a rotation; the axis, if any, is its last column

  int dimension() const { return int(basis.cols()); }
  Spherical_harmonics harmonics(const Eigen::VectorXd& s) const { return offset + basis * s; }
  /// Those of the restricted tensor that is nearest to `q`.
  Eigen::VectorXd coordinates(const Spherical_harmonics& q) const { return basis.transpose() * (q - offset); }
  /// From the nearest restricted tensor, squared: the left side of a weak restriction.
  double squared_distance(const Spherical_harmonics& q) const { return (q - harmonics(coordinates(q))).squaredNorm(); }
};

/// All tensors; 15 unknowns.
Odeco_restriction unrestricted();

/// A unit vector, such as a normal or the tangent of a curve, is an axis with the given value; 5 unknowns.
///
/// The tensor is value axis^4 plus any tensor of the plane across the axis, and s tells the latter: it is
/// `planar_part_scale` times its `Circular_harmonics` in the basis of the first two columns of `frame`.
Odeco_restriction restriction_to_axis(const Eigen::Vector3d& axis, double value);

/// The same with the last column of `frame`, a rotation, as axis: for a basis of the plane of one's own choice.
Odeco_restriction restriction_to_axis_of_frame(const Eigen::Matrix3d& frame, double value);

/// Of a tensor of a plane, the norm as a function on the sphere by that on the circle: 16 / sqrt(315).
double planar_part_scale();

/// A unit vector is an axis with any value; 6 unknowns, linear (the offset is zero).
Odeco_restriction restriction_to_axis(const Eigen::Vector3d& axis);

/// Two orthogonal unit vectors are axes, both with given values: 1 unknown, for the third value. `frame` is
/// (second, first x second, first).
Odeco_restriction restriction_to_axes(const Eigen::Vector3d& first, double first_value, const Eigen::Vector3d& second,
                                      double second_value);

/// The second one with any value; 2 unknowns.
Odeco_restriction restriction_to_axes(const Eigen::Vector3d& first, double first_value, const Eigen::Vector3d& second);

/// A unit vector is an axis with the given value, and the values of the other two are equal; 3 unknowns. surface, eq.
/// (31).
Odeco_restriction restriction_to_isotropic(const Eigen::Vector3d& axis, double value);

/// All values are 1; 9 unknowns.
Odeco_restriction restriction_to_crosses();

/// And a unit vector is an axis; 2 unknowns.
Odeco_restriction restriction_to_crosses(const Eigen::Vector3d& axis);

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Symmetric_tensors/internal/odeco_restrictions_3_impl.h>
#endif

#endif
