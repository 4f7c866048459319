// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_CONNECTION_FORM_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_CONNECTION_FORM_H

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace Quadrille {
namespace internal {

inline Eigen::Matrix3d rotation_of(const Eigen::Vector3d& w)
{
  const double angle = w.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, w / angle).toRotationMatrix()
                   : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
}

inline Eigen::Vector3d rotation_vector_of(const Eigen::Matrix3d& R)
{
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

/// The gradients of the four linear functions that are 1 at one corner and 0 at the others, as columns.
inline Eigen::Matrix<double, 3, 4> gradients_of_corners(const Eigen::Matrix<double, 3, 4>& points)
{
  Eigen::Matrix3d edges;
  for (int i = 0; i < 3; ++i)
    edges.col(i) = points.col(i + 1) - points.col(0);
  const Eigen::Matrix3d inverse = edges.inverse();
  Eigen::Matrix<double, 3, 4> gradients;
  gradients.rightCols<3>() = inverse.transpose();
  gradients.col(0) = -inverse.colwise().sum().transpose();
  return gradients;
}

template <class Mesh> Eigen::Matrix<double, 3, 4> points_of(const Mesh& mesh, std::size_t t)
{
  Eigen::Matrix<double, 3, 4> points;
  const auto& corners = mesh.tetrahedron(t);
  for (int i = 0; i < 4; ++i)
    points.col(i) = Eigen::Vector3d(mesh.point(std::size_t(corners[std::size_t(i)])));
  return points;
}

} // namespace internal
} // namespace Quadrille

#endif
