// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_METRIC_FIELD_H
#define QUADRILLE_METRIC_FIELD_H

#include <Quadrille/exceptions.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {

/// A Riemannian metric g on a tetrahedral mesh by A = sqrt(g) at the vertices, linear within each tetrahedron. The rows
/// of A are orthonormal covectors, so A v are the coordinates of a vector v in an orthonormal frame that turns with the
/// metric: frames R of a cross field under the metric are rotations in these, their axes in space the columns of A^-1
/// R.
class Metric_field {
public:
  Metric_field() = default;

  /// From symmetric positive definite matrices, in units of 1 / length^2, such as I / h^2 for a size h.
  /// \throws Invalid_input_error naming the vertex whose matrix is not finite, symmetric or positive definite.
  explicit Metric_field(const std::vector<Eigen::Matrix3d>& metrics)
  {
    m_roots.reserve(metrics.size());
    for (std::size_t v = 0; v < metrics.size(); ++v)
      m_roots.push_back(root(metrics[v], v));
  }

  /// From a function that gives the metric at a point.
  template <class TetrahedralMesh, class Function>
  static Metric_field sampled(const TetrahedralMesh& mesh, const Function& metric_at)
  {
    std::vector<Eigen::Matrix3d> metrics(mesh.number_of_vertices());
    for (std::size_t v = 0; v < metrics.size(); ++v)
      metrics[v] = metric_at(Eigen::Vector3d(mesh.point(v)));
    return Metric_field(metrics);
  }

  /// The conformal metric I / h^2 of the element sizes h. \throws Invalid_input_error where h is not positive.
  static Metric_field of_sizes(const std::vector<double>& sizes)
  {
    std::vector<Eigen::Matrix3d> metrics(sizes.size());
    for (std::size_t v = 0; v < sizes.size(); ++v) {
      if (!(sizes[v] > 0))
        throw Invalid_input_error("the size at vertex " + std::to_string(v) + " is " + std::to_string(sizes[v]) +
                                  "; sizes have to be positive");
      metrics[v] = Eigen::Matrix3d::Identity() / (sizes[v] * sizes[v]);
    }
    return Metric_field(metrics);
  }

  /// The pull-back J^T J of the Euclidean metric by a map whose Jacobian `jacobian_at` gives.
  template <class TetrahedralMesh, class Function>
  static Metric_field pulled_back(const TetrahedralMesh& mesh, const Function& jacobian_at)
  {
    return sampled(mesh, [&](const Eigen::Vector3d& p) {
      const Eigen::Matrix3d J = jacobian_at(p);
      return Eigen::Matrix3d(J.transpose() * J);
    });
  }

  std::size_t size() const { return m_roots.size(); }
  /// A at a vertex, symmetric.
  const Eigen::Matrix3d& operator[](std::size_t v) const { return m_roots[v]; }

private:
  static Eigen::Matrix3d root(const Eigen::Matrix3d& g, std::size_t v)
  {
    const auto fail = [&](const std::string& what) {
      throw Invalid_input_error("the metric at vertex " + std::to_string(v) + " is not " + what +
                                ". Metrics are symmetric positive definite matrices, such as 1 / size^2 times the "
                                "identity");
    };
    if (!g.allFinite())
      fail("finite");
    const double scale = g.cwiseAbs().maxCoeff();
    if ((g - g.transpose()).cwiseAbs().maxCoeff() > 1e-10 * scale)
      fail("symmetric");
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(g);
    if (!(eigen.eigenvalues()[0] > 1e-14 * eigen.eigenvalues()[2]))
      fail("positive definite (its smallest eigenvalue is " + std::to_string(eigen.eigenvalues()[0]) + ")");
    return eigen.operatorSqrt();
  }

  std::vector<Eigen::Matrix3d> m_roots;
};

} // namespace Quadrille

#endif
