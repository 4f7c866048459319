// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_CROSS_FIELD_INDICATORS_H
#define QUADRILLE_CROSS_FIELD_INDICATORS_H

#include <Quadrille/Metric_connection.h>
#include <Quadrille/Volumetric_cross_field/internal/Tetrahedron_adjacency.h>
#include <Quadrille/cross_harmonics.h>
#include <Quadrille/nearest_cross.h>
#include <Quadrille/parallel_for.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Quadrille {

/// What a field of frames at the vertices says about each tetrahedron.
struct Tetrahedron_crosses {
  std::vector<Eigen::Matrix3d> frames; ///< of the crosses nearest to the means of those at the corners
  /// The indicator of singularities of volume: the Frobenius distance of that mean, a tensor, from its projection onto
  /// the crosses. 0 where the field is constant, 0.3 and more next to singularities.
  std::vector<double> eta;
};

/// The mean crosses of tetrahedra, under a metric carried to the first corner. Time is linear in the size.
template <class TetrahedralMesh>
Tetrahedron_crosses crosses_of_tetrahedra(const TetrahedralMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                                          const Metric_connection& connection = {}, int threads = 0)
{
  const std::size_t n = mesh.number_of_tetrahedra();
  Tetrahedron_crosses result{std::vector<Eigen::Matrix3d>(n), std::vector<double>(n)};
  parallel_for(n, threads, [&](std::size_t t) {
    const std::array<int, 4> corners = internal::corners_of(mesh, t);
    const Eigen::Matrix3d& first = frames[std::size_t(corners[0])];
    Cross_harmonics mean = 0.25 * cross_harmonics(first);
    for (std::size_t i = 1; i < 4; ++i) {
      const Eigen::Matrix3d& frame = frames[std::size_t(corners[i])];
      mean += 0.25 * cross_harmonics(connection.is_identity()
                                         ? frame
                                         : Eigen::Matrix3d(connection(corners[i], corners[0]) * frame));
    }
    // Away from singularities the first corner's cross is close to the mean.
    constexpr double close = 0.8;
    result.frames[t] =
        (mean.dot(cross_harmonics(first)) > close ? nearest_cross(mean, first) : nearest_cross(mean)).frame;
    const double length_of_tensor = std::sqrt(1.2); // Frobenius norm of the harmonic part of a cross's tensor
    result.eta[t] = length_of_tensor * (mean - cross_harmonics(result.frames[t])).norm();
  });
  return result;
}

} // namespace Quadrille

#endif
