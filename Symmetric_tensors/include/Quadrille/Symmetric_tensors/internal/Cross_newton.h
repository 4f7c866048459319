// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_CROSS_NEWTON_H
#define QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_CROSS_NEWTON_H

#include <Quadrille/Support/internal/Pack.h>
#include <Quadrille/cross_harmonics.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace Quadrille {
namespace internal {

/// Maximises q(R) . q over rotations R by Newton's method, for one pair of q and start or for a pack of them.
///
/// With v = q(R), turning R by a small rotation vector w changes v by sum w_a L_a v + 1/2 sum w_a w_b L_a L_b v. Since
/// the generators L_a are skew, the gradient is -(L_a q) . v and the Hessian is symmetric part of -(L_a q) . (L_b v).
template <class S> class Cross_newton {
public:
  using Harmonics = std::array<S, 9>;
  using Quaternion = std::array<S, 4>; ///< w, x, y, z

  static constexpr int n_lanes = std::is_same_v<S, Pack> ? Pack::size : 1;

  /// `q(lane)` and `start(lane)`: a cross's harmonics, and a unit quaternion w, x, y, z as a vector.
  template <class Harmonics_of_lane, class Quaternion_of_lane>
  Cross_newton(const Harmonics_of_lane& q, const Quaternion_of_lane& start)
  {
    // The scale of q does not matter, but tests for convergence and definiteness are relative to it.
    const S norm = from_lanes<S>([&](int lane) { return q(lane).norm(); });
    m_scale = from_lanes<S>([&](int lane) { return value(norm, lane) > 0 ? value(norm, lane) : 1; });
    for (std::size_t i = 0; i < 9; ++i)
      m_q[i] = from_lanes<S>([&](int lane) { return q(lane)[Eigen::Index(i)]; }) / m_scale;
    for (std::size_t i = 0; i < 4; ++i)
      m_quaternion[i] = from_lanes<S>([&](int lane) { return start(lane)[Eigen::Index(i)]; });
    for (int a = 0; a < 3; ++a)
      generate(a, m_q, m_generated[std::size_t(a)]);
  }

  /// Returns the number of steps, the same for all lanes. Of each `group` of neighbouring lanes only the best one has
  /// to converge, and those that may still overtake it.
  int run(int max_iterations, int group)
  {
    place();
    for (int i = 0; i < max_iterations; ++i) {
      differentiate();
      step();
      place();
      bool is_done = true;
      for (int lane = 0; lane < n_lanes; lane += group)
        is_done = is_done && is_decided(lane, lane + group);
      if (is_done)
        return i + 1;
    }
    return max_iterations;
  }

  bool is_converged(int lane) const { return value(m_squared_step, lane) < converged; }
  double alignment(int lane) const { return value(m_alignment, lane) * value(m_scale, lane); }

  Eigen::Matrix3d frame(int lane) const
  {
    Eigen::Matrix3d R;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        R(r, c) = value(m_axes[std::size_t(c)][std::size_t(r)], lane);
    return R;
  }

private:
  static constexpr double converged = 1e-14; ///< squared angle of a step; the next one would be about its square

  bool is_decided(int first, int end) const
  {
    constexpr double possible_rise = 0.15; // for unit q, once a start has been improved by a step
    double best = value(m_alignment, first);
    for (int lane = first + 1; lane < end; ++lane)
      best = std::max(best, value(m_alignment, lane));
    for (int lane = first; lane < end; ++lane)
      if (!is_converged(lane) && value(m_alignment, lane) > best - possible_rise)
        return false;
    return true;
  }

  static double value(double x, int) { return x; }
  static double value(const Pack& x, int lane) { return x.lane(lane); }
  static double largest(double x) { return x; }
  static double largest(const Pack& x) { return std::max({x.lane(0), x.lane(1), x.lane(2), x.lane(3)}); }

  static S dot(const Harmonics& p, const Harmonics& q)
  {
    S sum = p[0] * q[0];
    for (std::size_t i = 1; i < 9; ++i)
      sum += p[i] * q[i];
    return sum;
  }

  /// `rotation_generator` for packs.
  static void generate(int axis, const Harmonics& q, Harmonics& p)
  {
    const S a(std::sqrt(2.0)), b(std::sqrt(3.5)), c(3 / std::sqrt(2.0)), d(std::sqrt(10.0));
    if (axis == 0)
      p = {-(a * q[7]),
           -(a * q[8]) - b * q[6],
           -(b * q[7]) - c * q[5],
           -(c * q[6]) - d * q[4],
           d * q[3],
           c * q[2],
           b * q[1] + c * q[3],
           a * q[0] + b * q[2],
           a * q[1]};
    else if (axis == 1)
      p = {a * q[1],    b * q[2] - a * q[0], c * q[3] - b * q[1], -(c * q[2]),
           -(d * q[5]), d * q[4] - c * q[6], c * q[5] - b * q[7], b * q[6] - a * q[8],
           a * q[7]};
    else
      p = {S(4) * q[8], S(3) * q[7], S(2) * q[6], q[5], S(0), -q[3], S(-2) * q[2], S(-3) * q[1], S(-4) * q[0]};
  }

  /// Axes, cross and alignment at the quaternion.
  void place()
  {
    const auto& [w, x, y, z] = m_quaternion;
    const S two(2), one(1);
    m_axes[0] = {one - two * (y * y + z * z), two * (x * y + w * z), two * (x * z - w * y)};
    m_axes[1] = {two * (x * y - w * z), one - two * (x * x + z * z), two * (y * z + w * x)};
    m_axes[2] = {two * (x * z + w * y), two * (y * z - w * x), one - two * (x * x + y * y)};
    Harmonics& v = m_cross;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto h = harmonics_of_degree_4(m_axes[k][0], m_axes[k][1], m_axes[k][2]);
      for (std::size_t i = 0; i < 9; ++i)
        v[i] = k == 0 ? h[Eigen::Index(i)] : v[i] + h[Eigen::Index(i)];
    }
    const S factor(cross_factor());
    for (S& entry : v)
      entry = factor * entry;
    m_alignment = dot(m_q, v);
  }

  /// Gradient and Hessian there.
  void differentiate()
  {
    std::array<Harmonics, 3> generated;
    for (int a = 0; a < 3; ++a) {
      generate(a, m_cross, generated[std::size_t(a)]);
      m_gradient[std::size_t(a)] = -dot(m_generated[std::size_t(a)], m_cross);
    }
    // Minus the Hessian: diagonal, then 12, 02, 01.
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      m_curvature[a] = dot(m_generated[a], generated[a]);
      m_curvature[3 + a] = S(0.5) * (dot(m_generated[b], generated[c]) + dot(m_generated[c], generated[b]));
    }
  }

  /// Newton's step where the alignment is concave; else of that with a multiple of the identity added, which climbs.
  void step()
  {
    constexpr double least = 0.05; // of the curvature, which is 20/3 at a cross
    constexpr double longest = 0.3;
    auto& k = m_curvature;
    const S first = k[0], second = minor(), third = determinant(); // Sylvester's criterion
    const auto is_concave = [&](int lane) {
      return value(first, lane) > least && value(second, lane) > least * least &&
             value(third, lane) > least * least * least;
    };
    bool all_concave = true;
    for (int lane = 0; lane < n_lanes; ++lane)
      all_concave = all_concave && is_concave(lane);
    if (!all_concave) {
      const S shift = from_lanes<S>([&](int lane) { return is_concave(lane) ? 0 : least - bound(lane); });
      for (std::size_t a = 0; a < 3; ++a)
        k[a] += shift;
    }
    std::array<S, 3> w = newton_step();
    S squared = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    if (largest(squared) > longest * longest) {
      const S factor = from_lanes<S>([&](int lane) {
        const double length = std::sqrt(value(squared, lane));
        return length > longest ? longest / length : 1;
      });
      for (S& entry : w)
        entry = factor * entry;
      squared = factor * factor * squared;
    }
    m_squared_step = squared;
    turn(w);
  }

  S minor() const { return m_curvature[0] * m_curvature[1] - m_curvature[5] * m_curvature[5]; }
  S determinant() const
  {
    const auto& k = m_curvature;
    return k[2] * minor() - k[3] * (k[0] * k[3] - k[5] * k[4]) + k[4] * (k[5] * k[3] - k[1] * k[4]);
  }

  /// Gershgorin's for the least eigenvalue of minus the Hessian.
  double bound(int lane) const
  {
    const auto k = [&](std::size_t i) { return value(m_curvature[i], lane); };
    return std::min({k(0) - std::abs(k(5)) - std::abs(k(4)), k(1) - std::abs(k(5)) - std::abs(k(3)),
                     k(2) - std::abs(k(4)) - std::abs(k(3))});
  }

  /// By Cramer's rule.
  std::array<S, 3> newton_step() const
  {
    const auto& k = m_curvature;
    const auto& g = m_gradient;
    const S c00 = k[1] * k[2] - k[3] * k[3], c11 = k[0] * k[2] - k[4] * k[4], c22 = minor();
    const S c12 = k[4] * k[5] - k[0] * k[3], c02 = k[5] * k[3] - k[4] * k[1], c01 = k[4] * k[3] - k[5] * k[2];
    const S inverse = S(1) / (k[0] * c00 + k[5] * c01 + k[4] * c02);
    return {inverse * (c00 * g[0] + c01 * g[1] + c02 * g[2]), inverse * (c01 * g[0] + c11 * g[1] + c12 * g[2]),
            inverse * (c02 * g[0] + c12 * g[1] + c22 * g[2])};
  }

  /// (1, w / 2) times the quaternion, normalised: the angle is |w| up to third order.
  void turn(const std::array<S, 3>& step)
  {
    const S half(0.5);
    const S a = half * step[0], b = half * step[1], c = half * step[2];
    const auto [w, x, y, z] = m_quaternion;
    m_quaternion = {w - a * x - b * y - c * z, x + a * w + b * z - c * y, y + b * w + c * x - a * z,
                    z + c * w + a * y - b * x};
    S sum = m_quaternion[0] * m_quaternion[0];
    for (std::size_t i = 1; i < 4; ++i)
      sum += m_quaternion[i] * m_quaternion[i];
    const S scale = S(1) / square_root(sum);
    for (S& entry : m_quaternion)
      entry = scale * entry;
  }

  S m_scale; ///< norm of q
  Harmonics m_q;
  std::array<Harmonics, 3> m_generated; ///< L_a q
  Quaternion m_quaternion;
  std::array<std::array<S, 3>, 3> m_axes;
  Harmonics m_cross;
  S m_alignment;
  S m_squared_step;
  std::array<S, 3> m_gradient;
  std::array<S, 6> m_curvature;
};

} // namespace internal
} // namespace Quadrille

#endif
