// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_OCTAHEDRAL_GROUP_IMPL_H
#define QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_OCTAHEDRAL_GROUP_IMPL_H

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace Quadrille {
namespace internal {

/// Elements, products and inverses of the group, made once.
class Octahedral_tables {
public:
  static constexpr int n = Octahedral_rotation::number_of_elements;

  Octahedral_tables()
  {
    constexpr int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    int g = 0;
    for (int p = 0; p < 6; ++p)
      for (int signs = 0; signs < 8; ++signs) {
        Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
        for (int c = 0; c < 3; ++c)
          m(order[p][c], c) = (signs >> c & 1) ? -1 : 1;
        if (m.determinant() > 0)
          matrix[std::size_t(g++)] = m;
      }
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) {
        product[std::size_t(a)][std::size_t(b)] = find(matrix[std::size_t(a)] * matrix[std::size_t(b)]);
        if (product[std::size_t(a)][std::size_t(b)] == 0)
          inverse[std::size_t(a)] = b;
      }
    number_of_code.fill(-1);
    for (int a = 0; a < n; ++a)
      number_of_code[std::size_t(code(matrix[std::size_t(a)]).first)] = a;
  }

  /// A number for where the largest entries of the rows are and for their signs, different for all elements; and the
  /// sum of the absolute values of these entries.
  static std::pair<int, double> code(const Eigen::Matrix3d& P)
  {
    int code = 0;
    double sum = 0;
    for (int r = 0; r < 3; ++r) {
      const double a = std::abs(P(r, 0)), b = std::abs(P(r, 1)), c = std::abs(P(r, 2));
      const int largest = a >= b && a >= c ? 0 : (b >= c ? 1 : 2);
      code = 6 * code + 2 * largest + (P(r, largest) < 0 ? 1 : 0);
      sum += std::abs(P(r, largest));
    }
    return {code, sum};
  }

  std::array<Eigen::Matrix3d, n> matrix;
  std::array<std::array<int, n>, n> product;
  std::array<int, n> inverse;
  std::array<int, 216> number_of_code; ///< -1 for those of no element

private:
  int find(const Eigen::Matrix3d& m) const
  {
    int g = 0;
    while (matrix[std::size_t(g)] != m)
      ++g;
    return g;
  }
};

inline const Octahedral_tables& octahedral_tables()
{
  static const Octahedral_tables tables;
  return tables;
}

} // namespace internal

inline Octahedral_rotation Octahedral_rotation::nearest(const Eigen::Matrix3d& P)
{
  // Within 45 degrees the trace of P^T G is at least 1 + sqrt(2), and no other element is as near.
  const auto [code, trace_of_largest] = internal::Octahedral_tables::code(P);
  const int number = internal::octahedral_tables().number_of_code[std::size_t(code)];
  if (number >= 0 && trace_of_largest > 1 + std::sqrt(2.0))
    return Octahedral_rotation(number);
  const auto& matrices = internal::octahedral_tables().matrix;
  int best = 0;
  double best_trace = -4;
  for (int g = 0; g < number_of_elements; ++g) {
    const double trace = P.cwiseProduct(matrices[std::size_t(g)]).sum();
    if (trace > best_trace) {
      best_trace = trace;
      best = g;
    }
  }
  return Octahedral_rotation(best);
}

inline const Eigen::Matrix3d& Octahedral_rotation::matrix() const
{
  return internal::octahedral_tables().matrix[std::size_t(m_number)];
}

inline Octahedral_rotation Octahedral_rotation::inverse() const
{
  return Octahedral_rotation(internal::octahedral_tables().inverse[std::size_t(m_number)]);
}

inline Octahedral_rotation operator*(Octahedral_rotation a, Octahedral_rotation b)
{
  return Octahedral_rotation(internal::octahedral_tables().product[std::size_t(a.m_number)][std::size_t(b.m_number)]);
}

inline Octahedral_rotation::Kind Octahedral_rotation::kind() const
{
  switch (static_cast<int>(std::lround(matrix().trace()))) { // 1 + 2 cos(angle)
  case 3:
    return Kind::identity;
  case 1:
    return Kind::quarter_turn;
  case 0:
    return Kind::third_turn;
  default:
    return matrix().diagonal().cwiseAbs().sum() == 3 ? Kind::half_turn : Kind::diagonal_half_turn;
  }
}

inline Eigen::Vector3i Octahedral_rotation::axis() const
{
  const Eigen::Matrix3i m = matrix().cast<int>();
  const Eigen::Vector3i skew(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)); // 2 sin(angle) times the axis
  if (!skew.isZero())
    return skew / skew.cwiseAbs().maxCoeff();
  if (m_number == 0)
    return Eigen::Vector3i::Zero();
  const Eigen::Matrix3i sum = m + Eigen::Matrix3i::Identity(); // a half turn: twice the projector on the axis
  for (int c = 0; c < 3; ++c)
    if (!sum.col(c).isZero())
      return sum.col(c) / sum.col(c).cwiseAbs().maxCoeff();
  return Eigen::Vector3i::Zero();
}

} // namespace Quadrille

#endif
