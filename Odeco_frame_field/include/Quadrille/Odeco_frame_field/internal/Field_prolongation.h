// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_PROLONGATION_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_PROLONGATION_H

#include <Quadrille/Odeco_frame_field/internal/Field_elements.h>

#include <array>
#include <vector>

namespace Quadrille {
namespace internal {

/// Linear interpolation from a coarse triangulation to points.
class Field_prolongation {
public:
  /// `near_vertex`: of every point, a coarse vertex that is near on the same side of slits and gaps: from there one
  /// walks through neighbouring triangles to the one that contains the point, or to the last one before the boundary.
  Field_prolongation(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector2d>& mesh_points,
                     const std::vector<Eigen::Vector2d>& points, const std::vector<int>& near_vertex)
      : m_corners(points.size()), m_weights(points.size())
  {
    for (std::size_t i = 0; i < points.size(); ++i)
      locate(mesh, mesh_points, points[i], near_vertex[i], i);
  }

  /// The unknowns of the fine field nearest to the interpolated coefficients of the coarse one.
  template <int N>
  Eigen::VectorXd operator()(const Field_elements<N>& coarse, const Eigen::VectorXd& x,
                             const Field_elements<N>& fine) const
  {
    Eigen::VectorXd result(Eigen::Index(fine.number_of_unknowns()));
    for (std::size_t v = 0; v < m_corners.size(); ++v) {
      typename Field_elements<N>::Coefficients q = Field_elements<N>::Coefficients::Zero();
      for (std::size_t k = 0; k < 3; ++k)
        q += m_weights[v][Eigen::Index(k)] * coarse.coefficients(std::size_t(m_corners[v][k]), x);
      fine.assign_coefficients(v, q, result);
    }
    return result;
  }

private:
  void locate(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector2d>& mesh_points,
              const Eigen::Vector2d& p, int vertex, std::size_t i)
  {
    if (mesh.outgoing(vertex) < 0) { // without triangles, so without influence
      m_corners[i] = {vertex, vertex, vertex};
      m_weights[i] = Eigen::Vector3d::UnitX();
      return;
    }
    // Walks that do not end (they may go round on triangulations that are not Delaunay) stop at the best triangle.
    const int max_steps = 200;
    int h = mesh.outgoing(vertex);
    double best = -1e300;
    for (int step = 0; step < max_steps && h >= 0; ++step) {
      const int f = Indexed_triangulation::face(h);
      const std::array<int, 3>& t = mesh.triangle(f);
      const Eigen::Vector3d weights = barycentric(mesh_points, t, p);
      if (weights.minCoeff() > best) {
        best = weights.minCoeff();
        m_corners[i] = t;
        m_weights[i] = weights;
      }
      if (best >= 0)
        break;
      // Across the edge opposite of the smallest weight, or, on the boundary, of the next one if that is negative too.
      std::array<int, 3> order = {0, 1, 2};
      std::sort(order.begin(), order.end(), [&](int a, int b) { return weights[a] < weights[b]; });
      h = -1;
      for (const int k : order)
        if (h < 0 && weights[k] < 0)
          h = mesh.opposite(3 * f + (k + 1) % 3);
    }
    m_weights[i] = m_weights[i].cwiseMax(0.0);
    m_weights[i] /= m_weights[i].sum();
  }

  static Eigen::Vector3d barycentric(const std::vector<Eigen::Vector2d>& points, const std::array<int, 3>& t,
                                     const Eigen::Vector2d& p)
  {
    const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
    const Eigen::Vector2d a = points[std::size_t(t[0])] - p, b = points[std::size_t(t[1])] - p,
                          c = points[std::size_t(t[2])] - p;
    const Eigen::Vector3d areas(cross(b, c), cross(c, a), cross(a, b));
    return areas / areas.sum();
  }

  std::vector<std::array<int, 3>> m_corners; ///< of the coarse triangle of every point
  std::vector<Eigen::Vector3d> m_weights;
};

} // namespace internal
} // namespace Quadrille

#endif
