// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_CROSS_ALIGNMENT_H
#define QUADRILLE_CROSS_ALIGNMENT_H

#include <Quadrille/cross_harmonics.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

namespace Quadrille {

/// What the cross at a vertex has to follow: an axis, such as the boundary's normal or a crease's tangent, or a frame.
///
/// An axis leaves two unknowns of the nine, the amplitude and the phase of the cross's turn about it; they replace the
/// nine (affine elimination), so that alignment is exact at every stage of the solution.
struct Cross_alignment {
  bool is_fixed = false; ///< to the frame `crosses.frame`; else only to its last column, the axis
  Aligned_crosses crosses;

  /// \pre `n` is a unit vector.
  static Cross_alignment with_axis(const Eigen::Vector3d& n) { return {false, crosses_aligned_with(n)}; }

  /// \pre `R` is a rotation.
  static Cross_alignment with_frame(const Eigen::Matrix3d& R)
  {
    Cross_alignment result{true, {}};
    result.crosses.offset = cross_harmonics(R);
    result.crosses.basis.setZero();
    result.crosses.frame = R;
    return result;
  }

  /// The frame nearest to `q` among those with this alignment.
  Eigen::Matrix3d nearest(const Cross_harmonics& q) const
  {
    if (is_fixed)
      return crosses.frame;
    const Eigen::Vector2d s = crosses.basis.transpose() * q;
    return crosses.frame * Eigen::AngleAxisd(std::atan2(s[0], s[1]) / 4, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }
};

} // namespace Quadrille

#endif
