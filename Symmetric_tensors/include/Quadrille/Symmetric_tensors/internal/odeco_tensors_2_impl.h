// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_ODECO_TENSORS_2_IMPL_H
#define QUADRILLE_SYMMETRIC_TENSORS_INTERNAL_ODECO_TENSORS_2_IMPL_H

#include <Quadrille/Symmetric_tensors/internal/circular_harmonics.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <complex>

namespace Quadrille {
namespace internal {

// q0 = band0 s, |z2| = band2 |d|, |z4| = band4 s for a frame with s = size_u + size_v, d = size_u - size_v.
inline double odeco_band0() { return std::sqrt(2 * pi) * 3 / 8; }
inline double odeco_band2() { return std::sqrt(pi) / 2; }
inline double odeco_band4() { return std::sqrt(pi) / 8; }

/// The maximiser of A cos(x - x1) + B cos(2 (x - x2)), A, B >= 0.
inline double maximize_two_cosines(double A, double x1, double B, double x2)
{
  double gap = std::remainder(x2 - x1, pi); // to the nearest maximum of the second term
  if (A == 0)
    return x1 + gap;
  const double sign = gap < 0 ? -1 : 1;
  gap = std::abs(gap);
  // The derivative is positive at 0 and negative at the gap; bisection keeps Newton's steps between them.
  double low = 0, high = gap;
  double y = gap * 4 * B / (A + 4 * B);
  for (int i = 0; i < 60 && high - low > 1e-16; ++i) {
    const double slope = -A * std::sin(y) + 2 * B * std::sin(2 * (gap - y));
    (slope > 0 ? low : high) = y;
    const double curvature = -A * std::cos(y) - 4 * B * std::cos(2 * (gap - y));
    double next = y - slope / curvature;
    if (!(next > low && next < high))
      next = 0.5 * (low + high);
    if (std::abs(next - y) < 1e-16)
      break;
    y = next;
  }
  return x1 + sign * y;
}

} // namespace internal

inline Circular_harmonics odeco_harmonics(const Orthogonal_frame_2& frame)
{
  using std::complex;
  const complex<double> w(frame.direction.x(), frame.direction.y());
  const complex<double> w2 = w * w, w4 = w2 * w2;
  const double s = frame.size_u + frame.size_v, d = frame.size_u - frame.size_v;
  Circular_harmonics q;
  q[0] = internal::odeco_band0() * s;
  q[1] = internal::odeco_band2() * d * w2.real();
  q[2] = internal::odeco_band2() * d * w2.imag();
  q[3] = internal::odeco_band4() * s * w4.real();
  q[4] = internal::odeco_band4() * s * w4.imag();
  return q;
}

inline Eigen::Vector3d odeco_residuals(const Circular_harmonics& q)
{
  const double root2 = std::sqrt(2.0);
  return {q[0] * q[0] - 18 * (q[3] * q[3] + q[4] * q[4]), //
          root2 * q[0] * q[1] - 6 * (q[1] * q[3] + q[2] * q[4]), root2 * q[0] * q[2] - 6 * (q[1] * q[4] - q[2] * q[3])};
}

inline double frame_area(const Circular_harmonics& q)
{
  return (8. / 9 * q[0] * q[0] - q[1] * q[1] - q[2] * q[2]) / internal::pi;
}

inline Orthogonal_frame_2 nearest_odeco_frame(const Circular_harmonics& q)
{
  using std::complex;
  const double A = internal::odeco_band0(), C = internal::odeco_band4();
  const complex<double> z2(q[1], q[2]), z4(q[3], q[4]);
  const complex<double> a = 0.5 * z2 * z2 + 2 * A * C / (A * A + C * C) * q[0] * z4;
  const complex<double> b = C * C / (2 * (A * A + C * C)) * z4 * z4;
  // With x = 4 t: Re(a exp(-i x)) = |a| cos(x - arg a), Re(b exp(-2 i x)) = |b| cos(2 (x - arg(b) / 2)).
  const double x = internal::maximize_two_cosines(std::abs(a), std::arg(a), std::abs(b), 0.5 * std::arg(b));
  Orthogonal_frame_2 frame;
  frame.direction = {std::cos(x / 4), std::sin(x / 4)};
  const complex<double> turn = std::polar(1.0, -x / 2);
  const double s = (A * q[0] + C * (z4 * turn * turn).real()) / (A * A + C * C);
  const double d = (z2 * turn).real() / internal::odeco_band2();
  frame.size_u = 0.5 * (s + d);
  frame.size_v = 0.5 * (s - d);
  return frame;
}

inline Orthogonal_frame_2 recover_frame(const Circular_harmonics& q)
{
  Orthogonal_frame_2 frame = nearest_odeco_frame(q);
  const Symmetric_tensor_2 tensor = Symmetric_tensor_2::from_harmonics(q);
  frame.size_u = tensor(frame.direction);
  frame.size_v = tensor(frame.normal());
  return frame;
}

inline std::vector<std::pair<double, Eigen::Vector2d>> eigenpairs(const Symmetric_tensor_2& tensor)
{
  using std::complex;
  // p(t) = ... + Re(c2 exp(2it)) + Re(c4 exp(4it)) is stationary where Im(c2 z + 2 c4 z^2) = 0 on |z| = 1, z =
  // exp(2it): 2 c4 z^4 + c2 z^3 - conj(c2) z - 2 conj(c4) = 0.
  const Circular_harmonics q = tensor.harmonics();
  const complex<double> c2(q[1], -q[2]), c4(q[3], -q[4]);
  std::vector<std::pair<double, Eigen::Vector2d>> pairs;
  std::vector<double> angles;
  const double scale = std::max(std::abs(c2), std::abs(c4));
  if (!(scale > 1e-14 * std::abs(q[0])))
    return pairs;
  if (std::abs(c4) <= 1e-12 * scale) {
    const double t = -0.5 * std::arg(c2);
    angles = {t, t + internal::pi / 2};
  } else {
    Eigen::Matrix4cd companion = Eigen::Matrix4cd::Zero();
    companion.diagonal(-1).setOnes();
    companion(0, 3) = std::conj(c4) / c4;
    companion(1, 3) = 0.5 * std::conj(c2) / c4;
    companion(3, 3) = -0.5 * c2 / c4;
    const Eigen::Vector4cd roots = Eigen::ComplexEigenSolver<Eigen::Matrix4cd>(companion, false).eigenvalues();
    // Roots off the circle come in pairs z, 1 / conj(z); a double root on it may be split by rounding.
    for (int i = 0; i < 4; ++i)
      if (std::abs(std::abs(roots[i]) - 1) < 1e-6)
        angles.push_back(0.5 * std::arg(roots[i]));
  }
  for (double& t : angles) {
    t = std::fmod(t, internal::pi);
    if (t < 0)
      t += internal::pi;
  }
  std::sort(angles.begin(), angles.end());
  for (const double t : angles) {
    const Eigen::Vector2d w(std::cos(t), std::sin(t));
    pairs.emplace_back(tensor(w), w);
  }
  return pairs;
}

} // namespace Quadrille

#endif
