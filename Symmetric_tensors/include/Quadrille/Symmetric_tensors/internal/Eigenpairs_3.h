// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_EIGENPAIRS_3_H
#define QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_EIGENPAIRS_3_H

#include <Quadrille/Symmetric_tensor_3.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Finds the vectors w that are parallel to T w^3.
///
/// The components of w x T w^3 are three quartic forms. Their multiples of degree six are all forms of that degree but
/// a complement of dimension 13, if they have 13 zeros (with multiplicity, complex ones included), as many as is
/// generic. The values of all monomials at a zero are then a vector of the null space of the multiples' coefficients,
/// and multiplication by a linear form is a linear map there, whose eigenvectors tell the zeros. The monomials are
/// scaled as is invariant under rotations; Newton's method ends the search for the real ones.
class Eigenpairs_3 {
public:
  explicit Eigenpairs_3(const Symmetric_tensor_3& T) : m_tensor(T) {}

  std::vector<std::pair<double, Eigen::Vector3d>> operator()()
  {
    if (!find_null_space())
      return {};
    find_zeros();
    std::sort(m_pairs.begin(), m_pairs.end(), [](const auto& p, const auto& q) { return p.first > q.first; });
    return m_pairs;
  }

private:
  static constexpr int n_zeros = 13, degree = 6, n_monomials = 28, n_rows = 18, n_lower = 21;

  /// Visits the monomials x^(degree - n2 - n3) y^n2 z^n3 by their exponents.
  template <class Visit> static void for_monomials(int of_degree, const Visit& visit)
  {
    for (int n = 0; n <= of_degree; ++n)
      for (int c = 0; c <= n; ++c)
        visit(n - c, c);
  }

  static double multinomial(int of_degree, int n2, int n3)
  {
    constexpr double factorial[] = {1, 1, 2, 6, 24, 120, 720};
    return factorial[of_degree] / (factorial[of_degree - n2 - n3] * factorial[n2] * factorial[n3]);
  }

  bool find_null_space()
  {
    Eigen::Matrix<double, n_rows, n_monomials> rows = Eigen::Matrix<double, n_rows, n_monomials>::Zero();
    for_monomials(3, [&](int n2, int n3) {
      int index[3]; // of the tensor, but one
      for (int k = 0; k < 3; ++k)
        index[k] = k < 3 - n2 - n3 ? 0 : k < 3 - n3 ? 1 : 2;
      for (int i = 0; i < 3; ++i) {
        // The coefficient of the monomial in component i of T w^3 appears in the other two components of the product.
        const double coefficient = multinomial(3, n2, n3) * m_tensor(i, index[0], index[1], index[2]);
        for (const int other : {(i + 1) % 3, (i + 2) % 3}) {
          const int row = 6 * (3 - i - other);
          const double sign = other == (i + 1) % 3 ? -1 : 1;
          for_monomials(2, [&](int k2, int k3) {
            const int m2 = n2 + k2 + (other == 1), m3 = n3 + k3 + (other == 2);
            rows(row + entry_number(k2, k3), entry_number(m2, m3)) +=
                sign * coefficient / std::sqrt(multinomial(degree, m2, m3));
          });
        }
      }
    });
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullV);
    constexpr int rank = n_monomials - n_zeros;
    // Otherwise the zeros are infinitely many.
    if (!(svd.singularValues()[rank - 1] > 1e-10 * svd.singularValues()[0]))
      return false;
    m_null_space = svd.matrixV().rightCols<n_zeros>();
    for_monomials(degree, [&](int n2, int n3) {
      m_null_space.row(entry_number(n2, n3)) /= std::sqrt(multinomial(degree, n2, n3));
    });
    return true;
  }

  /// Values of monomials of degree five times a linear form.
  Eigen::Matrix<double, n_lower, n_zeros> times(const Eigen::Vector3d& form) const
  {
    Eigen::Matrix<double, n_lower, n_zeros> product;
    for_monomials(degree - 1, [&](int n2, int n3) {
      product.row(entry_number(n2, n3)) =
          std::sqrt(multinomial(degree - 1, n2, n3)) *
          (form[0] * m_null_space.row(entry_number(n2, n3)) + form[1] * m_null_space.row(entry_number(n2 + 1, n3)) +
           form[2] * m_null_space.row(entry_number(n2, n3 + 1)));
    });
    return product;
  }

  void find_zeros()
  {
    // Of dynamic size, since compilers take half a minute for decompositions of these fixed ones.
    using Decomposition = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;
    // No zero of the divisor may be near a zero of the forms: the best of some in general position.
    const Eigen::Vector3d forms[] = {{0.48, 0.62, 0.62}, {-0.55, 0.72, 0.43}, {0.71, -0.36, 0.61}, {0.64, 0.58, -0.5}};
    Decomposition divisor;
    int best = -1;
    double largest = -1;
    for (int i = 0; i < 4; ++i) {
      const Decomposition decomposition(times(forms[i]));
      const double smallest = std::abs(decomposition.matrixR()(n_zeros - 1, n_zeros - 1));
      if (smallest > largest) {
        largest = smallest;
        divisor = decomposition;
        best = i;
      }
    }
    const Eigen::MatrixXd multiplication = divisor.solve(times(forms[(best + 1) % 4]));
    const Eigen::EigenSolver<Eigen::MatrixXd> eigen(multiplication);
    for (int i = 0; i < n_zeros; ++i)
      add(zero_of_monomials(m_null_space * eigen.eigenvectors().col(i)));
  }

  /// The real part of w, up to a factor, from the values of the monomials: those of x, y and z times a large one.
  static Eigen::Vector3d zero_of_monomials(const Eigen::Matrix<std::complex<double>, n_monomials, 1>& values)
  {
    Eigen::Vector3cd w = Eigen::Vector3cd::Zero();
    for_monomials(degree - 1, [&](int n2, int n3) {
      const Eigen::Vector3cd triple(values[entry_number(n2, n3)], values[entry_number(n2 + 1, n3)],
                                    values[entry_number(n2, n3 + 1)]);
      if (triple.squaredNorm() > w.squaredNorm())
        w = triple;
    });
    int largest = 0;
    w.cwiseAbs().maxCoeff(&largest);
    return (w / w[largest]).real().normalized();
  }

  /// Newton's method for T w^3 = l w in the plane across w.
  void add(const Eigen::Vector3d& start)
  {
    const double scale = m_tensor.entries().cwiseAbs().maxCoeff();
    Eigen::Vector3d w = start;
    for (int i = 0; i < 12; ++i) {
      const Eigen::Matrix3d at_w = m_tensor.contract_twice(w);
      const double value = w.dot(at_w * w);
      Eigen::Matrix<double, 3, 2> plane;
      plane.col(0) = w.unitOrthogonal();
      plane.col(1) = w.cross(plane.col(0));
      const Eigen::Matrix2d derivative = plane.transpose() * (3 * at_w - value * Eigen::Matrix3d::Identity()) * plane;
      if (!(std::abs(derivative.determinant()) > 1e-14 * scale * scale))
        return; // a multiple zero
      const Eigen::Vector2d step = -derivative.inverse() * (plane.transpose() * (at_w * w));
      if (!(step.norm() < 0.1))
        return; // from a complex zero
      w = (w + plane * step).normalized();
      if (step.norm() < 1e-9) {
        for (const auto& pair : m_pairs)
          if (std::abs(pair.second.dot(w)) > 1 - 1e-12)
            return;
        m_pairs.emplace_back(m_tensor(w), w);
        return;
      }
    }
  }

  const Symmetric_tensor_3& m_tensor;
  Eigen::Matrix<double, n_monomials, n_zeros> m_null_space;
  std::vector<std::pair<double, Eigen::Vector3d>> m_pairs;
};

} // namespace internal
} // namespace Quadrille

#endif
