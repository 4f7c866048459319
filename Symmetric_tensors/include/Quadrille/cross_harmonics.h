// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_CROSS_HARMONICS_H
#define QUADRILLE_CROSS_HARMONICS_H

#include <Quadrille/Symmetric_tensor_3.h>

#include <Eigen/Core>

namespace Quadrille {

/// A cross of space, three orthogonal axes without order and sign, by the part of degree 4 of its tensor's harmonics,
/// scaled so that |q| = 1; or a linear combination of such. Entries by order m = -4, ..., 4 as in
/// `Spherical_harmonics`. The numbers are those of Ray, Sokolov and Levy (2016) and Palmer, Bommes and Solomon (2020).
using Cross_harmonics = Eigen::Matrix<double, 9, 1>;

/// The harmonics of degree 4 at a unit vector.
Cross_harmonics zonal_harmonics(const Eigen::Vector3d& n);

/// The cross whose axes are the columns of the orthogonal matrix `R`.
Cross_harmonics cross_harmonics(const Eigen::Matrix3d& R);

/// (3/5) S + H(q), where S is the part that all crosses share: for a cross the sum of the fourth powers of its axes.
/// Affine in q, onto the tensors with partial trace I; volume, eqs. (4), (7).
Symmetric_tensor_3 cross_tensor(const Cross_harmonics& q);

/// The inverse of `cross_tensor` on tensors with partial trace I; other parts of a tensor are left out.
Cross_harmonics cross_harmonics(const Symmetric_tensor_3& tensor);

/// The action of a rotation on harmonics of degree 4: (D q) . Y(v) = q . Y(R^T v), D orthogonal.
///
/// By R = Rz(a) Ry(b) Rz(c) and Ry(b) = Rx(90)^T Rz(b) Rx(90), with rotations about z that turn pairs of entries and a
/// constant sparse matrix: 90 multiplications, where the 9 x 9 matrix would take 81 but cost 81 numbers to store.
class Harmonic_rotation {
public:
  Harmonic_rotation() : Harmonic_rotation(Eigen::Matrix3d::Identity()) {}
  /// \pre `R` is orthogonal with determinant 1.
  explicit Harmonic_rotation(const Eigen::Matrix3d& R);

  Cross_harmonics operator()(const Cross_harmonics& q) const;
  /// D^T q, the action of the inverse.
  Cross_harmonics inverse(const Cross_harmonics& q) const;

private:
  Eigen::Vector3d m_cosines, m_sines; ///< of a, b, c
};

/// L q, where exp(t L) is the action of the rotation about coordinate axis 0, 1 or 2 by the angle t; L is skew. In the
/// precision of `q`.
template <class S> Eigen::Matrix<S, 9, 1> rotation_generator(int axis, const Eigen::Matrix<S, 9, 1>& q);

/// q(R) . q(S) for the crosses of two rotations, from P = R^T S alone: 5/6 sum P_ij^4 - 3/2.
double product_of_crosses(const Eigen::Matrix3d& P);

/// The crosses that have `n` as an axis are q = offset + basis s with |s|^2 = 5/12: `offset` and the two columns of
/// `basis` for a unit vector `n`. Such s = sqrt(5/12) (sin 4t, cos 4t) for the other axes turned about n by t.
struct Aligned_crosses {
  Cross_harmonics offset;
  Eigen::Matrix<double, 9, 2> basis;
  Eigen::Matrix3d frame; ///< a rotation with n as its last column, against whose first column t is measured
};
Aligned_crosses crosses_aligned_with(const Eigen::Vector3d& n);

} // namespace Quadrille

#include <Quadrille/Symmetric_tensors/internal/cross_harmonics_impl.h>

#endif
