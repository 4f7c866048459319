// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The average of some crosses, which is no cross, the cross nearest to it, and how frames match.

#include <Quadrille/nearest_cross.h>
#include <Quadrille/octahedral_group.h>

#include <Eigen/Geometry>

#include <iostream>

int main()
{
  using namespace Quadrille;

  // Frames that turn about (1, 1, 0), one of them with its axes renamed: crosses do not notice.
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 1, 0).normalized();
  const Octahedral_rotation renaming(7);
  Cross_harmonics mean = Cross_harmonics::Zero();
  for (const double angle : {0.1, 0.3, 0.5}) {
    Eigen::Matrix3d frame = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    if (angle > 0.4)
      frame = frame * renaming.matrix();
    mean += cross_harmonics(frame) / 3;
  }
  std::cout << "norm of the mean: " << mean.norm() << " (of a cross: 1)\n";

  const Nearest_cross nearest = nearest_cross(mean);
  std::cout << "nearest cross, by " << nearest.iterations << " Newton steps:\n" << nearest.frame << "\n";

  // It is the one in the middle, up to the order and the signs of its axes.
  const Eigen::Matrix3d middle = Eigen::AngleAxisd(0.3, axis).toRotationMatrix();
  const Octahedral_rotation matching = matching_of_frames(nearest.frame, middle);
  const double difference = (nearest.frame * matching.matrix() - middle).norm();
  std::cout << "matching number " << matching.number() << " takes it to the middle one, up to " << difference << "\n";

  // As the paper recovers it: exact for crosses, not the nearest one otherwise.
  const Eigen::Matrix3d recovered = cross_of_eigentensors(cross_tensor(mean));
  std::cout << "product with the mean: " << nearest.alignment << ", of the eigentensors' cross "
            << mean.dot(cross_harmonics(recovered)) << "\n";
  return difference < 1e-9 ? 0 : 1;
}
