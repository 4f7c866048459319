// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_ODECO_TENSORS_3_IMPL_H
#define QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_ODECO_TENSORS_3_IMPL_H

#include <Quadrille/Odeco_quadrics_3.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/Symmetric_tensors/internal/Cross_seeds.h>
#include <Quadrille/Symmetric_tensors/internal/Eigenpairs_3.h>
#include <Quadrille/Symmetric_tensors/internal/Odeco_frame_search.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

inline std::array<double, 15> entry_array(const Symmetric_tensor_3& tensor)
{
  std::array<double, 15> t;
  Eigen::Map<Symmetric_tensor_3::Entries>(t.data()) = tensor.entries();
  return t;
}

/// The objective of the nearest odeco tensor: with the scalar products b_i of the tensor with the axes' fourth powers
/// p_i, the squared norm of the projection is b^T G^-1 b, G the matrix of the products of the p_i among themselves.
struct Odeco_projection {
  Symmetric_tensor_3 tensor; ///< whose value at the axes is b
  double diagonal;           ///< of G^-1, with `mixed` taken off: G^-1 = diagonal (I - mixed 1 1^T)
  double mixed;
  double squared_norm; ///< of the tensor to project

  Odeco_projection(const Symmetric_tensor_3& T, Tensor_norm norm) : tensor(T), diagonal(1), mixed(0)
  {
    if (norm == Tensor_norm::components) { // G = I
      squared_norm = T.squared_norm();
      return;
    }
    // On the sphere (r . x)^4 = 1/5 + 4/7 P2 + 8/35 P4, so that b_i are values of the tensor with scaled harmonics; and
    // G has 4 pi / 9 on its diagonal and 4 pi / 105 elsewhere.
    Spherical_harmonics q = T.harmonics();
    squared_norm = q.squaredNorm();
    q.head<1>() *= 4 * pi / 5;
    q.segment<5>(1) *= 16 * pi / 35;
    q.tail<9>() *= 32 * pi / 315;
    tensor = Symmetric_tensor_3::from_harmonics(q);
    diagonal = 1 / (4 * pi / 9 - 4 * pi / 105);
    mixed = 3.0 / 41;
  }

  Eigen::Vector3d values(const Eigen::Vector3d& b) const
  {
    return diagonal * (b - Eigen::Vector3d::Constant(mixed * b.sum()));
  }
};

/// The seeds of crosses, with what is needed to compare them as frames.
class Odeco_seeds {
public:
  Odeco_seeds()
  {
    for (int k = 0; k < Cross_seeds::number; ++k) {
      const Eigen::Matrix3d axes = frame(k);
      for (int i = 0; i < 3; ++i)
        m_harmonics[std::size_t(i)].row(k) =
            even_harmonics(axes(0, i), axes(1, i), axes(2, i)).transpose().cast<float>();
    }
  }

  Eigen::Matrix3d frame(int k) const
  {
    const Eigen::Vector4d& q = m_crosses.quaternion(k);
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  }

  /// The best seed, and the best one of those that are not close to it.
  std::array<int, 2> best(const Odeco_projection& projection) const
  {
    const Spherical_harmonics q = projection.tensor.harmonics();
    const double norm = q.norm();
    const Eigen::Matrix<float, 15, 1> p = (q / (norm > 0 ? norm : 1)).cast<float>();
    Cross_seeds::Products squares = Cross_seeds::Products::Zero(), sum = Cross_seeds::Products::Zero();
    for (const Table& table : m_harmonics) {
      Cross_seeds::Products b = p[0] * table.col(0);
      for (int i = 1; i < 15; ++i)
        b += p[i] * table.col(i);
      squares += b.cwiseAbs2();
      sum += b;
    }
    return m_crosses.best(squares - float(projection.mixed) * sum.cwiseAbs2());
  }

private:
  using Table = Eigen::Matrix<float, Cross_seeds::number, 15>;

  Cross_seeds m_crosses;
  std::array<Table, 3> m_harmonics; ///< by axis
};

inline const Odeco_seeds& odeco_seeds()
{
  static const Odeco_seeds seeds;
  return seeds;
}

inline Orthogonal_frame_3 frame_of(const Odeco_frame_search& search, const Odeco_projection& projection)
{
  Orthogonal_frame_3 frame;
  frame.axes = search.axes();
  frame.values = projection.values(search.powers());
  return frame;
}

} // namespace internal

QUADRILLE_INLINE Symmetric_tensor_3 odeco_tensor(const Orthogonal_frame_3& frame)
{
  return frame.values[0] * Symmetric_tensor_3::power(frame.axes.col(0)) +
         frame.values[1] * Symmetric_tensor_3::power(frame.axes.col(1)) +
         frame.values[2] * Symmetric_tensor_3::power(frame.axes.col(2));
}

QUADRILLE_INLINE Odeco_residuals_3 odeco_residuals(const Symmetric_tensor_3& tensor)
{
  return Odeco_residuals_3(odeco_quadrics_3().values(internal::entry_array(tensor)).data());
}

QUADRILLE_INLINE Eigen::Matrix<double, 27, 15> odeco_residual_derivatives(const Symmetric_tensor_3& tensor)
{
  const auto rows = odeco_quadrics_3().jacobian(internal::entry_array(tensor));
  Eigen::Matrix<double, 27, 15> jacobian;
  for (int i = 0; i < 27; ++i)
    jacobian.row(i) = Eigen::Map<const Eigen::Matrix<double, 1, 15>>(rows[std::size_t(i)].data());
  return jacobian;
}

QUADRILLE_INLINE Symmetric_tensor_3 with_power(const Symmetric_tensor_3& tensor, int exponent)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(tensor.partial_trace());
  const Eigen::Vector3d powers =
      eigen.eigenvalues().unaryExpr([&](double value) { return std::pow(value, exponent - 1); });
  const Eigen::Matrix3d M = eigen.eigenvectors() * powers.asDiagonal() * eigen.eigenvectors().transpose();
  Symmetric_tensor_3::Entries entries;
  for (int n = 0; n <= 4; ++n)
    for (int c = 0; c <= n; ++c) {
      int index[4];
      for (int k = 0; k < 4; ++k)
        index[k] = k < 4 - n ? 0 : k < 4 - c ? 1 : 2;
      double sum = 0; // over which index is contracted
      for (int k = 0; k < 4; ++k)
        for (int a = 0; a < 3; ++a)
          sum += M(index[k], a) * tensor(index[(k + 1) % 4], index[(k + 2) % 4], index[(k + 3) % 4], a);
      entries[internal::entry_number(n - c, c)] = 0.25 * sum;
    }
  return Symmetric_tensor_3(entries);
}

QUADRILLE_INLINE Symmetric_tensor_2 restricted_to_plane(const Symmetric_tensor_3& tensor, const Eigen::Vector3d& e1,
                                                        const Eigen::Vector3d& e2)
{
  const Eigen::Matrix3d first = tensor.contract_twice(e1), second = tensor.contract_twice(e2);
  Symmetric_tensor_2::Entries entries;
  entries << e1.dot(first * e1), e1.dot(first * e2), e2.dot(first * e2), e1.dot(second * e2), e2.dot(second * e2);
  return Symmetric_tensor_2(entries);
}

QUADRILLE_INLINE Orthogonal_frame_3 nearest_odeco_frame(const Symmetric_tensor_3& tensor, Tensor_norm norm)
{
  const internal::Odeco_projection projection(tensor, norm);
  const auto [first, second] = internal::odeco_seeds().best(projection);
  internal::Odeco_frame_search search(projection.tensor, projection.mixed, internal::odeco_seeds().frame(first));
  search.run();
  // Next to the variety the search ends where it should.
  constexpr double near = 1e-4;
  if (projection.diagonal * search.objective() > (1 - near) * projection.squared_norm)
    return internal::frame_of(search, projection);
  internal::Odeco_frame_search other(projection.tensor, projection.mixed, internal::odeco_seeds().frame(second));
  other.run();
  return internal::frame_of(other.objective() > search.objective() ? other : search, projection);
}

QUADRILLE_INLINE Orthogonal_frame_3 nearest_odeco_frame(const Symmetric_tensor_3& tensor, const Eigen::Matrix3d& start,
                                                        Tensor_norm norm)
{
  const internal::Odeco_projection projection(tensor, norm);
  internal::Odeco_frame_search search(projection.tensor, projection.mixed, start);
  search.run();
  return internal::frame_of(search, projection);
}

QUADRILLE_INLINE std::vector<std::pair<double, Eigen::Vector3d>> eigenpairs(const Symmetric_tensor_3& tensor)
{
  return internal::Eigenpairs_3(tensor)();
}

} // namespace Quadrille

#endif
