// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_OCTAHEDRAL_GROUP_H
#define QUADRILLE_OCTAHEDRAL_GROUP_H

#include <Eigen/Core>

namespace Quadrille {

/// One of the 24 rotations that take the coordinate axes to themselves up to order and sign: how frames of the same
/// cross differ, and by which matching the frames of neighbours correspond. Number 0 is the identity.
class Octahedral_rotation {
public:
  static constexpr int number_of_elements = 24;

  enum class Kind {
    identity,
    quarter_turn,      ///< 90 degrees about a coordinate axis (6)
    half_turn,         ///< 180 degrees about a coordinate axis (3)
    third_turn,        ///< 120 degrees about a diagonal of the cube (8)
    diagonal_half_turn ///< 180 degrees about a diagonal of two axes (6)
  };

  Octahedral_rotation() = default;
  /// \pre 0 <= number < 24
  explicit Octahedral_rotation(int number) : m_number(number) {}
  /// The rotation nearest to the orthogonal matrix `P`: with the largest trace of P^T G. Unique where P turns by less
  /// than 45 degrees from it; every rotation is within 62.8 degrees of one.
  static Octahedral_rotation nearest(const Eigen::Matrix3d& P);

  int number() const { return m_number; }
  /// A signed permutation matrix with determinant 1.
  const Eigen::Matrix3d& matrix() const;
  Octahedral_rotation inverse() const;
  Kind kind() const;
  /// The vector of integers about which it turns counterclockwise by at most 180 degrees, of half turns one of the two;
  /// zero for the identity.
  Eigen::Vector3i axis() const;

  friend Octahedral_rotation operator*(Octahedral_rotation a, Octahedral_rotation b);
  friend bool operator==(Octahedral_rotation a, Octahedral_rotation b) { return a.m_number == b.m_number; }
  friend bool operator!=(Octahedral_rotation a, Octahedral_rotation b) { return !(a == b); }

private:
  int m_number = 0;
};

/// The matching from frame `a` to frame `b`: the rotation g for which a g is nearest to b, that is, axis i of b
/// continues the axis of a that is column i of a g.
inline Octahedral_rotation matching_of_frames(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b)
{
  return Octahedral_rotation::nearest(a.transpose() * b);
}

} // namespace Quadrille

#include <Quadrille/Symmetric_tensors/internal/octahedral_group_impl.h>

#endif
