// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Tensors that have a surface's normal as an axis, the frame nearest to one of them that has no frame, and the same
// without knowing the normal.

#include <Quadrille/odeco_restrictions_3.h>
#include <Quadrille/odeco_tensors_2.h>
#include <Quadrille/odeco_tensors_3.h>

#include <Eigen/Geometry>

#include <cmath>
#include <iostream>

int main()
{
  using namespace Quadrille;

  // All tensors with the axis n and value 1 there: five unknowns, a planar tensor up to a factor.
  const Eigen::Vector3d n = Eigen::Vector3d(1, 2, 2) / 3;
  const Odeco_restriction restriction = restriction_to_axis(n, 1);
  const Eigen::Vector3d e1 = restriction.frame.col(0), e2 = restriction.frame.col(1);

  // The mean of two frames that are turned about n by 50 degrees.
  Eigen::VectorXd s = Eigen::VectorXd::Zero(5);
  for (const double angle : {0.2, 0.2 + 50 * std::acos(-1.0) / 180}) {
    Orthogonal_frame_3 frame;
    frame.axes = Eigen::AngleAxisd(angle, n).toRotationMatrix() * restriction.frame;
    frame.values = {2, 0.5, 1};
    s += 0.5 * restriction.coordinates(odeco_tensor(frame).harmonics());
  }
  const Symmetric_tensor_3 mean = Symmetric_tensor_3::from_harmonics(restriction.harmonics(s));
  std::cout << "residual of the mean: " << odeco_residuals(mean).norm() << "\n";

  // In the tangent plane the nearest frame is known in closed form.
  const Orthogonal_frame_2 planar = nearest_odeco_frame(restricted_to_plane(mean, e1, e2).harmonics());
  std::cout << "in the plane: values " << planar.size_u << " and " << planar.size_v << "\n";

  // In space it is searched for, and has the normal as an axis again.
  const Orthogonal_frame_3 nearest = nearest_odeco_frame(mean);
  std::cout << "in space: values " << nearest.values.transpose() << ", axes\n" << nearest.axes << "\n";
  const double left = odeco_residuals(odeco_tensor(nearest)).norm();
  const double alignment = (nearest.axes.transpose() * n).cwiseAbs().maxCoeff();
  std::cout << "residual " << left << ", cosine of the angle between n and its axis " << alignment << "\n";
  return left < 1e-12 && alignment > 0.999 ? 0 : 1;
}
