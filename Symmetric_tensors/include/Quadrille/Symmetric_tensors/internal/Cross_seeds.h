// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_CROSS_SEEDS_H
#define QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_CROSS_SEEDS_H

#include <Quadrille/cross_harmonics.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace Quadrille {
namespace internal {

/// Crosses that are spread evenly over all, to start searches from: each one as far as possible from those before,
/// chosen among many rotations of a low-discrepancy sequence.
class Cross_seeds {
public:
  static constexpr int number = 64;

  Cross_seeds()
  {
    constexpr int n_candidates = 4096;
    std::vector<Cross_harmonics> candidates;
    std::vector<Eigen::Vector4d> quaternions;
    for (int i = 0; i < n_candidates; ++i) {
      quaternions.push_back(uniform_quaternion(i));
      candidates.push_back(
          cross_harmonics(Eigen::Quaterniond(quaternions[std::size_t(i)][0], quaternions[std::size_t(i)][1],
                                             quaternions[std::size_t(i)][2], quaternions[std::size_t(i)][3])
                              .toRotationMatrix()));
    }
    std::vector<double> nearest(n_candidates, -std::numeric_limits<double>::infinity()); // product with those chosen
    std::size_t next = 0;
    for (int k = 0; k < number; ++k) {
      m_quaternions[std::size_t(k)] = quaternions[next];
      m_harmonics.row(k) = candidates[next].cast<float>();
      const Cross_harmonics chosen = candidates[next];
      for (std::size_t i = 0; i < n_candidates; ++i) {
        nearest[i] = std::max(nearest[i], chosen.dot(candidates[i]));
        if (nearest[i] < nearest[next])
          next = i;
      }
    }
    find_close_ones();
  }

  const Eigen::Vector4d& quaternion(int k) const { return m_quaternions[std::size_t(k)]; }

  using Products = Eigen::Matrix<float, number, 1>;

  /// By seed, its product with `q` / `norm`: good enough to choose by in single precision, and all seeds side by side
  /// in the vector registers.
  Products products(const Cross_harmonics& q, double norm = 1) const
  {
    const Eigen::Matrix<float, 9, 1> p = (q / norm).cast<float>();
    Products result = p[0] * m_harmonics.col(0);
    for (int i = 1; i < 9; ++i)
      result += p[i] * m_harmonics.col(i);
    return result;
  }

  /// The nearest seed, and the nearest one of those that are not close to that.
  std::array<int, 2> best(const Products& products) const
  {
    std::array<int, 2> found = {0, -1};
    products.maxCoeff(&found[0]);
    const Products others = products - m_penalty.col(found[0]);
    others.maxCoeff(&found[1]);
    return found;
  }

  /// Up to four seeds, the nearest ones, with a product of at least `least` that are not next to the cross `known`.
  std::vector<int> rivals(const Products& products, double least, const Cross_harmonics& known) const
  {
    std::vector<int> found;
    if (!(double(products.maxCoeff()) >= least))
      return found;
    const Products with_known = this->products(known);
    for (int k = 0; k < number; ++k)
      if (double(products[k]) >= least && double(with_known[k]) < same_product)
        found.push_back(k);
    std::sort(found.begin(), found.end(), [&](int i, int j) { return products[i] > products[j]; });
    if (found.size() > 4)
      found.resize(4);
    return found;
  }

private:
  /// Products of crosses 0.55 and 0.35 radians apart, roughly: |difference|^2 = 20/3 angle^2 for small angles. (The
  /// seeds' covering radius is 0.3; from starts that are closer to each other the same maximum is reached, mostly.)
  static constexpr double close_product = 1 - 10.0 / 3 * 0.55 * 0.55;
  static constexpr double same_product = 1 - 10.0 / 3 * 0.35 * 0.35;

  /// Shoemake's map of the cube to the rotations, at a Kronecker sequence (inverse powers of the root of x^4 = x + 1).
  static Eigen::Vector4d uniform_quaternion(int i)
  {
    constexpr double root = 1.2207440846057596;
    double cube[3];
    double step = 1;
    for (double& x : cube) {
      step /= root;
      x = (i + 0.5) * step;
      x -= std::floor(x);
    }
    const double turn = 2 * std::acos(-1.0);
    const double a = std::sqrt(1 - cube[0]), b = std::sqrt(cube[0]);
    return {a * std::sin(turn * cube[1]), a * std::cos(turn * cube[1]), b * std::sin(turn * cube[2]),
            b * std::cos(turn * cube[2])};
  }

  void find_close_ones()
  {
    for (int i = 0; i < number; ++i)
      for (int k = 0; k < number; ++k)
        m_penalty(k, i) = double(m_harmonics.row(i).dot(m_harmonics.row(k))) > close_product
                              ? std::numeric_limits<float>::infinity()
                              : 0.0f;
  }

  Eigen::Matrix<float, number, number> m_penalty; ///< by seed, infinity for those close to it
  std::array<Eigen::Vector4d, number> m_quaternions;
  Eigen::Matrix<float, number, 9> m_harmonics;
};

} // namespace internal
} // namespace Quadrille

#endif
