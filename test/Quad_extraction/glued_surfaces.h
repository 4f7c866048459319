// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_QUAD_EXTRACTION_GLUED_SURFACES_H
#define QUADRILLE_TEST_QUAD_EXTRACTION_GLUED_SURFACES_H

#include "glued_rectangles.h"

#include <Eigen/Core>

#include <array>
#include <cmath>

namespace quad_extraction_test {

using Place = std::array<double, 3>;

/// The surface of the cube from -1 to 1, each face one cell. Corner `i` has the sign of bit `d` of `i` as coordinate
/// `d`.
inline Glued_rectangles_in_space cube()
{
  Glued_rectangles_in_space result;
  for (int i = 0; i < 8; ++i)
    result.corners.push_back({i & 1 ? 1. : -1., i & 2 ? 1. : -1., i & 4 ? 1. : -1.});
  result.cells = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  result.curve = [](int, int, bool) { return -1; };
  result.length = [](int, int) { return 5.2; };
  result.subdivisions = 10;
  return result;
}

inline Glued_rectangles_in_space sphere()
{
  Glued_rectangles_in_space result = cube();
  result.shape = [](const Place& p) {
    const double r = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    return Place{p[0] / r, p[1] / r, p[2] / r};
  };
  return result;
}

/// `n` cells around, `m` around the tube.
inline Glued_rectangles_in_space torus(int n, int m, double length)
{
  const double pi = std::acos(-1.0), major = 3, minor = 1;
  Glued_rectangles_in_space result;
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const double a = 2 * pi * i / n, b = 2 * pi * j / m, r = major + minor * std::cos(b);
      result.corners.push_back({r * std::cos(a), r * std::sin(a), minor * std::sin(b)});
      const int right = (i + 1) % n, up = (j + 1) % m;
      result.cells.push_back({j * n + i, j * n + right, up * n + right, up * n + i});
    }
  result.shape = [=](const Place& p) {
    const Eigen::Vector3d at(p[0], p[1], p[2]);
    const Eigen::Vector3d center = major * Eigen::Vector3d(p[0], p[1], 0).normalized();
    const Eigen::Vector3d moved = center + minor * (at - center).normalized();
    return Place{moved[0], moved[1], moved[2]};
  };
  result.curve = [](int, int, bool) { return -1; };
  result.length = [=](int, int) { return length; };
  return result;
}

} // namespace quad_extraction_test

#endif
