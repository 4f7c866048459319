// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_TENSORS_3_H
#define QUADRILLE_ODECO_TENSORS_3_H

#include <Quadrille/Symmetric_tensor_2.h>
#include <Quadrille/Symmetric_tensor_3.h>

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace Quadrille {

/// An orthogonal frame of space with a number for each axis, up to the order and the signs of the axes. What the values
/// mean is up to the user; in paper surface they are lengths of gradients, reciprocals of element sizes.
struct Orthogonal_frame_3 {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity(); ///< a rotation with the axes as columns
  Eigen::Vector3d values = Eigen::Vector3d::Ones();
};

/// The sum of values[m] times the fourth power of axis m; surface, eq. (11).
Symmetric_tensor_3 odeco_tensor(const Orthogonal_frame_3& frame);

/// Left sides of the 27 quadratic equations of the odeco variety, all zero exactly on it; surface, eq. (20).
using Odeco_residuals_3 = Eigen::Matrix<double, 27, 1>;

/// With G_ijkpqr = T_ijks T_pqrs and its fully symmetric part sym(G), T is odeco exactly if G = sym(G) (Boralevi,
/// Draisma, Horobet and Robeva). The residuals are the coefficients of G - sym(G) in an orthonormal basis: the sum of
/// their squares is |G - sym(G)|^2 over all 729 components, which rotations leave as it is.
Odeco_residuals_3 odeco_residuals(const Symmetric_tensor_3& tensor);

/// Their derivatives with respect to the tensor's entries.
Eigen::Matrix<double, 27, 15> odeco_residual_derivatives(const Symmetric_tensor_3& tensor);

/// T M^(exponent - 1) with M the partial trace: of an odeco tensor, the one with each value raised to `exponent`, so
/// that 0 makes a cross of it and -1 inverts the values; surface, eq. (27). For other tensors, whose contraction with
/// a matrix is not symmetric, its symmetric part. \pre M is regular if `exponent` < 1.
Symmetric_tensor_3 with_power(const Symmetric_tensor_3& tensor, int exponent);

/// The polynomial on the plane of two orthonormal vectors: entries T(e1^(4-m), e2^m), m = 0, ..., 4.
Symmetric_tensor_2 restricted_to_plane(const Symmetric_tensor_3& tensor, const Eigen::Vector3d& e1,
                                       const Eigen::Vector3d& e2);

/// What is nearest depends on the norm: fourth powers of orthogonal axes are orthogonal as tensors, but not as
/// functions on the sphere.
enum class Tensor_norm {
  harmonics, ///< Euclidean of `Spherical_harmonics`, the L2 norm of the polynomial on the sphere; surface, eq. (18)
  components ///< Frobenius, of all 81 components
};

/// The odeco tensor nearest to `tensor`, as a frame.
///
/// For fixed axes the best values are linear in the tensor, and what is left to maximise is a quadratic form of the
/// tensor's values at the axes. Newton's method climbs where that is concave; elsewhere two axes at a time turn to the
/// maximum in their plane, which is that of a sum of two cosines and found exactly. The best one or two of 64 seeds are
/// the starts. The result is a local maximum to rounding, and the global one but for a few of 100,000 means of odeco
/// tensors, and one in 600 of normally distributed tensors; 2 to 4 us. Values may be negative for tensors far from the
/// variety. For zero, values are zero.
Orthogonal_frame_3 nearest_odeco_frame(const Symmetric_tensor_3& tensor, Tensor_norm norm = Tensor_norm::harmonics);

/// The frame that the same search finds from the rotation `start` alone, such as the result before the tensor changed a
/// little.
Orthogonal_frame_3 nearest_odeco_frame(const Symmetric_tensor_3& tensor, const Eigen::Matrix3d& start,
                                       Tensor_norm norm = Tensor_norm::harmonics);

/// The eigenpairs T w^3 = l w with |w| = 1 that are real and simple, as pairs (l, w) with one of w and -w, by falling
/// l.
///
/// They are the stationary points of the polynomial on the sphere where its second derivative is regular. With complex
/// ones, and counting multiple ones as often, there are 13 or infinitely many; in the latter case the result is empty.
/// An odeco tensor with positive values a, b, c has 13 simple ones: its axes r, s, t with a, b, c, two of each kind as
/// r / sqrt(a) + s / sqrt(b), and r / sqrt(a) + s / sqrt(b) + t / sqrt(c) with four choices of signs. Found by linear
/// algebra, no start values are involved; about 150 us.
std::vector<std::pair<double, Eigen::Vector3d>> eigenpairs(const Symmetric_tensor_3& tensor);

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Symmetric_tensors/internal/odeco_tensors_3_impl.h>
#endif

#endif
