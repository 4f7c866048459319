// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_TENSORS_2_H
#define QUADRILLE_ODECO_TENSORS_2_H

#include <Quadrille/Symmetric_tensor_2.h>

#include <utility>
#include <vector>

namespace Quadrille {

/// An orthogonal frame of the plane up to the quarter turns that exchange its vectors: u = size_u * direction and
/// v = size_v * (direction turned by +90 degrees).
struct Orthogonal_frame_2 {
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX(); ///< unit vector
  double size_u = 1;
  double size_v = 1;

  Eigen::Vector2d normal() const { return {-direction.y(), direction.x()}; }
};

/// The harmonics of the tensor size_u u^4 + size_v v^4; planar-2, eq. (15).
Circular_harmonics odeco_harmonics(const Orthogonal_frame_2& frame);

/// The left sides c1, c2, c3 of the equations of the odeco variety, all zero exactly on it; planar-2, eq. (20).
Eigen::Vector3d odeco_residuals(const Circular_harmonics& q);

/// The product of a frame's two sizes, continued to all tensors; planar-2, eq. (21).
double frame_area(const Circular_harmonics& q);

/// The odeco tensor nearest to `q` in the Euclidean norm of the harmonics, as a frame.
///
/// For a fixed direction the best sizes are linear in q; the squared norm of the projection is then
/// Re(a w) + Re(b w^2) up to a constant, w = exp(-4 i t), a sum of two cosines whose maximum lies between the maxima of
/// the first and of the nearer of the second, where it is the only stationary point. Exact to rounding, about 0.1 us.
/// The sizes are those of the nearest tensor and may be negative for tensors far from the variety.
Orthogonal_frame_2 nearest_odeco_frame(const Circular_harmonics& q);

/// The direction of `nearest_odeco_frame` with the sizes T u^4 and T v^4 of the tensor itself; planar-2, eq. (35).
Orthogonal_frame_2 recover_frame(const Circular_harmonics& q);

/// All eigenpairs T w^3 = l w with |w| = 1, as pairs (l, w) with w in the half plane of angles [0, pi); they are the
/// stationary points of the polynomial on the circle, two to four for tensors that are not multiples of (x^2+y^2)^2.
/// For such a multiple every direction is an eigenvector and the result is empty.
std::vector<std::pair<double, Eigen::Vector2d>> eigenpairs(const Symmetric_tensor_2& tensor);

} // namespace Quadrille

#include <Quadrille/Symmetric_tensors/internal/odeco_tensors_2_impl.h>

#endif
