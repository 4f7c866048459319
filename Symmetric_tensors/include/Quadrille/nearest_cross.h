// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_NEAREST_CROSS_H
#define QUADRILLE_NEAREST_CROSS_H

#include <Quadrille/cross_harmonics.h>

#include <Eigen/Core>

#include <vector>

namespace Quadrille {

/// A cross and how it was found.
struct Nearest_cross {
  Eigen::Matrix3d frame; ///< a rotation whose columns are the axes
  double alignment;      ///< q(frame) . q: the larger, the nearer
  int iterations;        ///< Newton steps
};

/// The cross nearest to `q`, in the Euclidean norm of the harmonics and so in the Frobenius norm of the tensors.
///
/// Newton's method on the rotations from the best of 64 crosses that are spread evenly and the best of those that are
/// not close to it, in the vector registers; the better maximum is taken. Exact to rounding on averages of crosses; of
/// tensors far from all crosses (such as normally distributed q) one in some thousand ends in another maximum nearly as
/// high. For q = 0 every cross is as near, and one of them is returned.
Nearest_cross nearest_cross(const Cross_harmonics& q);

/// Those of many, two at a time: half the time for each. `threads` = 0: all cores; the result does not depend on it
/// (but for `iterations`, of which two neighbours share the larger number).
std::vector<Nearest_cross> nearest_crosses(const std::vector<Cross_harmonics>& q, int threads = 1);

/// The local maximum of the alignment that Newton's method reaches from the rotation `start`, such as the nearest
/// cross before q changed a little.
Nearest_cross nearest_cross(const Cross_harmonics& q, const Eigen::Matrix3d& start);

/// The cross whose axes the eigentensors of the three largest eigenvalues share; exact if `tensor` is that of a cross.
///
/// volume, Section 3.2, adds the three up with equal weights and takes the axes of the sum. That sum is the identity
/// when they happen to be the squares of the axes themselves, so here the weights differ. For other tensors the
/// eigentensors share no axes: not the nearest cross, which is the reason for `nearest_cross`.
Eigen::Matrix3d cross_of_eigentensors(const Symmetric_tensor_3& tensor);

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Symmetric_tensors/internal/nearest_cross_impl.h>
#endif

#endif
