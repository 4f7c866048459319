// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSOR_3_H
#define QUADRILLE_SYMMETRIC_TENSOR_3_H

#include <Eigen/Core>

namespace Quadrille {

/// Coefficients of a tensor's polynomial on the unit sphere in the orthonormal real spherical harmonics of degree 0
/// (entry 0), 2 (entries 1 to 5) and 4 (entries 6 to 14), each by order m = -l, ..., l, negative ones with sin |m| phi.
using Spherical_harmonics = Eigen::Matrix<double, 15, 1>;

/// A fully symmetric fourth-order tensor of space, T in S^4(R^3), by its fifteen different entries.
class Symmetric_tensor_3 {
public:
  using Vector = Eigen::Vector3d;
  using Matrix = Eigen::Matrix3d;
  using Mandel_matrix = Eigen::Matrix<double, 6, 6>;
  using Entries = Eigen::Matrix<double, 15, 1>;

  Symmetric_tensor_3() : m_t(Entries::Zero()) {}
  /// Entry n (n + 1) / 2 + c of `entries` is the component with c indices equal to 3 and n - c equal to 2: T1111,
  /// T1112, T1113, T1122, T1123, T1133, T1222, T1223, T1233, T1333, T2222, T2223, T2233, T2333, T3333.
  explicit Symmetric_tensor_3(const Entries& entries) : m_t(entries) {}
  /// The tensor whose restriction to the unit sphere has the coefficients `q`.
  static Symmetric_tensor_3 from_harmonics(const Spherical_harmonics& q)
  {
    return Symmetric_tensor_3(Entries(entries_of_harmonics() * q));
  }
  /// w^(4), the fourth tensor power of a vector; volume, eq. (4) sums three of them.
  static Symmetric_tensor_3 power(const Vector& w);
  /// The tensor with Mandel's form nearest to `m` in the Frobenius norm: the mean over equal components.
  static Symmetric_tensor_3 from_mandel(const Mandel_matrix& m);

  const Entries& entries() const { return m_t; }
  /// The component T_ijkl, indices in {0, 1, 2}.
  double operator()(int i, int j, int k, int l) const;

  /// The restriction to the unit sphere in the orthonormal basis.
  Spherical_harmonics harmonics() const { return harmonics_of_entries() * m_t; }

  /// Mandel's form: the symmetric matrix of A -> T : A for symmetric matrices A = (A11, A22, A33, sqrt(2) A23,
  /// sqrt(2) A13, sqrt(2) A12); contractions T : S of tensors are products of matrices. volume, eq. (23).
  Mandel_matrix mandel() const;
  /// sum_i T_iikl; the identity for tensors of crosses. volume, eq. (7).
  Matrix partial_trace() const;
  /// The Frobenius norm of all 81 components, squared.
  double squared_norm() const;

  /// T w^2, a symmetric matrix.
  Matrix contract_twice(const Vector& w) const;
  /// T w^3, a vector.
  Vector contract_thrice(const Vector& w) const { return contract_twice(w) * w; }
  /// T w^4, the tensor's polynomial.
  double operator()(const Vector& w) const { return w.dot(contract_thrice(w)); }

  /// (rotated T)(R w) = T(w), for orthogonal R.
  Symmetric_tensor_3 rotated(const Matrix& R) const;

  Symmetric_tensor_3 operator+(const Symmetric_tensor_3& other) const { return Symmetric_tensor_3(m_t + other.m_t); }
  friend Symmetric_tensor_3 operator*(double factor, const Symmetric_tensor_3& tensor)
  {
    return Symmetric_tensor_3(factor * tensor.m_t);
  }

  /// The constant matrix with entries = M q.
  static const Eigen::Matrix<double, 15, 15>& entries_of_harmonics();
  /// Its inverse.
  static const Eigen::Matrix<double, 15, 15>& harmonics_of_entries();

private:
  Entries m_t;
};

/// A symmetric matrix as Mandel's vector (A11, A22, A33, sqrt(2) A23, sqrt(2) A13, sqrt(2) A12), with equal norms.
Eigen::Matrix<double, 6, 1> mandel_vector(const Eigen::Matrix3d& a);
/// And back.
Eigen::Matrix3d matrix_of_mandel_vector(const Eigen::Matrix<double, 6, 1>& v);

} // namespace Quadrille

#include <Quadrille/Symmetric_tensors/internal/Symmetric_tensor_3_impl.h>

#endif
