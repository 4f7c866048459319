// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_PROLONGATION_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_PROLONGATION_H

#include <Quadrille/Odeco_frame_field/internal/Surface_elements.h>
#include <Quadrille/odeco_tensors_2.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <vector>

namespace Quadrille {
namespace internal {

/// Interpolation of a field from a coarse triangulation of a surface to the nodes of a finer one: linear in the nearest
/// coarse triangle, of tensors that are turned along with the normals.
class Surface_prolongation {
public:
  /// `near_vertex`: of every fine vertex, a coarse vertex that is near on the surface.
  Surface_prolongation(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector3d>& mesh_points,
                       const std::vector<Eigen::Vector3d>& points, const std::vector<int>& near_vertex)
      : m_mesh(mesh), m_mesh_points(mesh_points), m_points(points), m_near_vertex(near_vertex)
  {
  }

  /// The unknowns of the fine field nearest to the interpolated coefficients of the coarse one.
  template <int N>
  Eigen::VectorXd operator()(const Surface_elements<N>& coarse, const Eigen::VectorXd& x,
                             const Surface_elements<N>& fine) const
  {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(Eigen::Index(fine.number_of_unknowns()));
    for (std::size_t v = 0; v < fine.number_of_nodes(); ++v) {
      const Eigen::Matrix3d& axes = fine.nodes().axes[v];
      const Place place = locate(std::size_t(fine.nodes().vertex[v]), axes.col(2));
      Circular_harmonics q = Circular_harmonics::Zero();
      for (int k = 0; k < 3; ++k) {
        const auto node = std::size_t(coarse.nodes().corners[std::size_t(place.face)][std::size_t(k)]);
        const Circular_harmonics at_corner = Tensor_coefficients<N>::harmonics(coarse.coefficients(node, x));
        q += place.weights[k] * transported(at_corner, coarse.nodes().axes[node], axes);
      }
      fine.assign_coefficients(v, Tensor_coefficients<N>::from_harmonics(q), result);
    }
    return result;
  }

private:
  struct Place {
    int face = -1;
    Eigen::Vector3d weights = Eigen::Vector3d::Zero();
    double distance = std::numeric_limits<double>::infinity(); ///< also grows where normals differ
  };

  /// By the shortest rotation from one normal to the other.
  static Circular_harmonics transported(const Circular_harmonics& q, const Eigen::Matrix3d& from,
                                        const Eigen::Matrix3d& to)
  {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d(from.col(2)), Eigen::Vector3d(to.col(2)));
    const Eigen::Vector3d axis = to.transpose() * (turn * Eigen::Vector3d(from.col(0)));
    return Symmetric_tensor_2::from_harmonics(q).rotated(std::atan2(axis.y(), axis.x())).harmonics();
  }

  /// From the triangles around the vertex downhill to the nearest one.
  Place locate(std::size_t v, const Eigen::Vector3d& normal) const
  {
    Place best;
    const int start = m_mesh.outgoing(m_near_vertex[v]);
    for (int h = start; h >= 0; h = m_mesh.next_around_source(h)) {
      improve(h / 3, m_points[v], normal, best);
      if (m_mesh.next_around_source(h) == start)
        break;
    }
    for (int face = -1; face != best.face;) {
      face = best.face;
      for (int i = 0; i < 3; ++i)
        for (const int h : {3 * face + i, Indexed_triangulation::next(3 * face + i)})
          if (const int other = m_mesh.opposite(h); other >= 0)
            improve(other / 3, m_points[v], normal, best);
    }
    return best;
  }

  void improve(int f, const Eigen::Vector3d& p, const Eigen::Vector3d& normal, Place& best) const
  {
    const std::array<int, 3>& t = m_mesh.triangle(f);
    const Eigen::Vector3d &a = m_mesh_points[std::size_t(t[0])], &b = m_mesh_points[std::size_t(t[1])],
                          &c = m_mesh_points[std::size_t(t[2])];
    const Eigen::Vector3d doubled = (b - a).cross(c - a);
    Eigen::Vector3d weights(doubled.dot((b - p).cross(c - p)), doubled.dot((c - p).cross(a - p)), 0);
    weights /= doubled.squaredNorm();
    weights[2] = 1 - weights[0] - weights[1];
    weights = weights.cwiseMax(0.0);
    weights /= weights.sum();
    const Eigen::Vector3d nearest = weights[0] * a + weights[1] * b + weights[2] * c;
    const double disagreement = 1 - doubled.dot(normal) / doubled.norm();
    const double distance = (nearest - p).squaredNorm() + disagreement * doubled.norm();
    if (distance < best.distance)
      best = {f, weights, distance};
  }

  const Indexed_triangulation& m_mesh;
  const std::vector<Eigen::Vector3d>&m_mesh_points, &m_points;
  const std::vector<int>& m_near_vertex;
};

} // namespace internal
} // namespace Quadrille

#endif
