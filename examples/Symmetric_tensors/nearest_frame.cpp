// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The tensor of an orthogonal frame, and the frame nearest to a tensor that has none.

#include <Quadrille/odeco_tensors_2.h>

#include <cmath>
#include <iostream>

int main()
{
  using namespace Quadrille;

  // A frame turned by 20 degrees with element sizes 2 along its first vector and 1 along its second.
  const double angle = 20 * std::acos(-1.0) / 180;
  const Orthogonal_frame_2 frame{{std::cos(angle), std::sin(angle)}, 2, 1};
  const Circular_harmonics q = odeco_harmonics(frame);
  std::cout << "coefficients " << q.transpose() << "\narea " << frame_area(q) << "\n";

  // The mean of two frames is in general not the tensor of a frame: the equations of the odeco variety tell.
  const Orthogonal_frame_2 other{{1, 0}, 1, 1};
  const Circular_harmonics mean = 0.5 * (q + odeco_harmonics(other));
  std::cout << "residuals of the mean " << odeco_residuals(mean).transpose() << "\n";

  const Orthogonal_frame_2 nearest = nearest_odeco_frame(mean);
  std::cout << "nearest frame: direction " << nearest.direction.transpose() << ", sizes " << nearest.size_u << " and "
            << nearest.size_v << "\n";
  const double left = odeco_residuals(odeco_harmonics(nearest)).norm();
  std::cout << "residuals of the nearest frame " << left << "\n";
  return left < 1e-12 ? 0 : 1;
}
