// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSOR_2_H
#define QUADRILLE_SYMMETRIC_TENSOR_2_H

#include <Eigen/Core>

#include <Eigen/Geometry>

#include <cmath>
#include <utility>

namespace Quadrille {

/// Coefficients (q0, ..., q4) of a tensor's polynomial on the unit circle in the orthonormal basis
/// (1/sqrt(2 pi), cos 2t / sqrt(pi), sin 2t / sqrt(pi), cos 4t / sqrt(pi), sin 4t / sqrt(pi)); planar-2, eq. (18).
using Circular_harmonics = Eigen::Matrix<double, 5, 1>;

/// A fully symmetric fourth-order tensor of the plane, T in S^4(R^2), by its five different entries.
class Symmetric_tensor_2 {
public:
  using Vector = Eigen::Vector2d;
  using Matrix = Eigen::Matrix2d;
  using Entries = Eigen::Matrix<double, 5, 1>;

  Symmetric_tensor_2() : m_t(Entries::Zero()) {}
  /// Entry i of `entries` is the component of T with i indices equal to 2: T1111, T1112, T1122, T1222, T2222.
  explicit Symmetric_tensor_2(const Entries& entries) : m_t(entries) {}
  /// The tensor whose restriction to the unit circle has the coefficients `q`.
  static Symmetric_tensor_2 from_harmonics(const Circular_harmonics& q)
  {
    return Symmetric_tensor_2(Entries(entries_of_harmonics() * q));
  }
  /// w^(4), the fourth tensor power of a vector; planar-2, eq. (15) sums two of them.
  static Symmetric_tensor_2 power(const Vector& w)
  {
    const double x = w.x(), y = w.y();
    return Symmetric_tensor_2(Entries(x * x * x * x, x * x * x * y, x * x * y * y, x * y * y * y, y * y * y * y));
  }

  const Entries& entries() const { return m_t; }
  /// The component T_ijkl, indices in {0, 1}.
  double operator()(int i, int j, int k, int l) const { return m_t[i + j + k + l]; }

  /// The restriction to the unit circle in the orthonormal basis.
  Circular_harmonics harmonics() const { return harmonics_of_entries() * m_t; }

  /// T w: the symmetric third-order tensor by its entries with 0, 1, 2, 3 indices equal to 2.
  Eigen::Vector4d contract_once(const Vector& w) const { return m_t.head<4>() * w.x() + m_t.tail<4>() * w.y(); }
  /// T w^2, a symmetric matrix.
  Matrix contract_twice(const Vector& w) const
  {
    const Eigen::Vector4d a = contract_once(w);
    const Eigen::Vector3d b = a.head<3>() * w.x() + a.tail<3>() * w.y();
    return (Matrix() << b[0], b[1], b[1], b[2]).finished();
  }
  /// T w^3, a vector; w is an eigenvector of T with eigenvalue l if |w| = 1 and T w^3 = l w; planar-2, eq. (12).
  Vector contract_thrice(const Vector& w) const { return contract_twice(w) * w; }
  /// T w^4 = p_T(w), the tensor's polynomial; the size of the frame along a unit direction w; planar-2, eq. (35).
  double operator()(const Vector& w) const { return w.dot(contract_thrice(w)); }

  /// The tensor turned counterclockwise by `angle`: (rotated T)(R w) = T(w).
  Symmetric_tensor_2 rotated(double angle) const
  {
    Circular_harmonics q = harmonics();
    const Eigen::Rotation2Dd twice(2 * angle), four_times(4 * angle);
    q.segment<2>(1) = (twice * Vector(q.segment<2>(1))).eval();
    q.segment<2>(3) = (four_times * Vector(q.segment<2>(3))).eval();
    return from_harmonics(q);
  }

  Symmetric_tensor_2 operator+(const Symmetric_tensor_2& other) const { return Symmetric_tensor_2(m_t + other.m_t); }
  friend Symmetric_tensor_2 operator*(double factor, const Symmetric_tensor_2& tensor)
  {
    return Symmetric_tensor_2(factor * tensor.m_t);
  }

  /// The constant matrix with entries = M q.
  static const Eigen::Matrix<double, 5, 5>& entries_of_harmonics();
  /// Its inverse.
  static const Eigen::Matrix<double, 5, 5>& harmonics_of_entries();

private:
  Entries m_t;
};

} // namespace Quadrille

#include <Quadrille/Symmetric_tensors/internal/circular_harmonics.h>

#endif
