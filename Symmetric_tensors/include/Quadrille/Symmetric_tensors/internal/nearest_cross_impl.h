// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_NEAREST_CROSS_IMPL_H
#define QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_NEAREST_CROSS_IMPL_H

#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/Symmetric_tensors/internal/Cross_newton.h>
#include <Quadrille/Symmetric_tensors/internal/Cross_seeds.h>
#include <Quadrille/nearest_cross.h>
#include <Quadrille/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace Quadrille {

namespace internal {

inline const Cross_seeds& cross_seeds()
{
  static const Cross_seeds seeds;
  return seeds;
}

/// Steps of a pack; some lane may creep along a ridge for long, but hardly ever the one that wins.
constexpr int steps_of_pack = 30;
constexpr int max_steps = 100;

inline Nearest_cross polished(const Cross_harmonics& q, const Eigen::Matrix3d& start, int max_iterations)
{
  const Eigen::Quaterniond rotation(start);
  const Eigen::Vector4d quaternion(rotation.w(), rotation.x(), rotation.y(), rotation.z());
  Cross_newton<double> newton([&](int) -> const Cross_harmonics& { return q; },
                              [&](int) -> const Eigen::Vector4d& { return quaternion; });
  const int iterations = newton.run(max_iterations, 1);
  return {newton.frame(0), newton.alignment(0), iterations};
}

/// The best of the lanes from `first` to `last` of a search for `q` that is over.
inline Nearest_cross best_lane(const Cross_newton<Pack>& newton, const Cross_harmonics& q, int first, int last,
                               int iterations)
{
  int winner = first;
  for (int lane = first + 1; lane <= last; ++lane)
    if (newton.alignment(lane) > newton.alignment(winner))
      winner = lane;
  if (newton.is_converged(winner))
    return {newton.frame(winner), newton.alignment(winner), iterations};
  Nearest_cross result = polished(q, newton.frame(winner), max_steps);
  result.iterations += iterations;
  return result;
}

/// Searches from other seeds that are nearly as near as what was found, where they may lead higher.
inline void try_rivals(const Cross_harmonics& q, double norm, const Cross_seeds::Products& products,
                       Nearest_cross& found)
{
  constexpr double possible_rise = 0.15; // from a seed to the maximum next to it, relative to |q|
  const Cross_seeds& seeds = cross_seeds();
  const std::vector<int> rivals =
      seeds.rivals(products, found.alignment / norm - possible_rise, cross_harmonics(found.frame));
  if (rivals.empty())
    return;
  Cross_newton<Pack> newton(
      [&](int) -> const Cross_harmonics& { return q; },
      [&](int lane) -> const Eigen::Vector4d& { return seeds.quaternion(rivals[std::size_t(lane) % rivals.size()]); });
  const int iterations = found.iterations + newton.run(steps_of_pack, Pack::size);
  const Nearest_cross rival = best_lane(newton, q, 0, Pack::size - 1, iterations);
  if (rival.alignment > found.alignment)
    found = rival;
  found.iterations = rival.iterations;
}

/// Of two crosses at once, each from two seeds.
inline void nearest_crosses(const Cross_harmonics& p, const Cross_harmonics& q, Nearest_cross& of_p,
                            Nearest_cross& of_q)
{
  const Cross_seeds& seeds = cross_seeds();
  const auto norm = [](const Cross_harmonics& x) { return x.norm() > 0 ? x.norm() : 1; };
  const double norm_of_p = norm(p), norm_of_q = norm(q);
  const Cross_seeds::Products products_of_p = seeds.products(p, norm_of_p),
                              products_of_q = seeds.products(q, norm_of_q);
  const std::array<int, 2> best_of_p = seeds.best(products_of_p), best_of_q = seeds.best(products_of_q);
  Cross_newton<Pack> newton([&](int lane) -> const Cross_harmonics& { return lane < 2 ? p : q; },
                            [&](int lane) -> const Eigen::Vector4d& {
                              return seeds.quaternion(lane < 2 ? best_of_p[std::size_t(lane)]
                                                               : best_of_q[std::size_t(lane - 2)]);
                            });
  const int iterations = newton.run(steps_of_pack, 2);
  of_p = best_lane(newton, p, 0, 1, iterations);
  of_q = best_lane(newton, q, 2, 3, iterations);
  try_rivals(p, norm_of_p, products_of_p, of_p);
  try_rivals(q, norm_of_q, products_of_q, of_q);
}

} // namespace internal

QUADRILLE_INLINE Nearest_cross nearest_cross(const Cross_harmonics& q)
{
  Nearest_cross result, same;
  internal::nearest_crosses(q, q, result, same);
  return result;
}

QUADRILLE_INLINE std::vector<Nearest_cross> nearest_crosses(const std::vector<Cross_harmonics>& q, int threads)
{
  std::vector<Nearest_cross> result(q.size());
  parallel_for((q.size() + 1) / 2, threads, [&](std::size_t i) {
    const std::size_t last = std::min(2 * i + 1, q.size() - 1);
    internal::nearest_crosses(q[2 * i], q[last], result[2 * i], result[last]);
  });
  return result;
}

QUADRILLE_INLINE Nearest_cross nearest_cross(const Cross_harmonics& q, const Eigen::Matrix3d& start)
{
  return internal::polished(q, start, internal::max_steps);
}

QUADRILLE_INLINE Eigen::Matrix3d cross_of_eigentensors(const Symmetric_tensor_3& tensor)
{
  const Eigen::SelfAdjointEigenSolver<Symmetric_tensor_3::Mandel_matrix> eigentensors(tensor.mandel());
  // Weights of which no two are equal for any turn of the three among themselves, practically.
  constexpr double weights[] = {1, 0.6180339887, -0.7548776662};
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (int i = 0; i < 3; ++i)
    sum += weights[i] * eigentensors.eigenvectors().col(5 - i);
  Eigen::Matrix3d frame = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix_of_mandel_vector(sum)).eigenvectors();
  if (frame.determinant() < 0)
    frame.col(0) = -frame.col(0);
  return frame;
}

} // namespace Quadrille

#endif
