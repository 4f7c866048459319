// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_CROSS_ENERGY_NEWTON_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_CROSS_ENERGY_NEWTON_H

#include <Quadrille/Volumetric_cross_field/internal/Field_graph.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Quadrille {
namespace internal {

/// Minimises the energy of a graph over the rotations themselves: Newton's method on the frames' manifold, the unknowns
/// of a step being three angles at a vertex, one where an axis is given, none where the frame is.
///
/// With q_v = q(R_v) and s_v the sum of w D q_u over the neighbours, the energy is a constant minus half the sum of
/// q_v . s_v. Turning R_v by the rotation vector w changes q_v by sum w_a L_a q_v + 1/2 sum w_a w_b L_a L_b q_v. The
/// Hessian is mixed with Gauss and Newton's, which is that of the Laplacian and positive: arcs of singularities, where
/// the exact one is not, then move on instead of ending the conjugate gradients at once.
class Cross_energy_newton {
public:
  struct Step {
    double energy_before = 0, energy = 0;
    int conjugate_gradients = 0;
    bool is_downhill = false; ///< else nothing was changed
  };

  Cross_energy_newton(const Field_graph& graph, int threads)
      : m_graph(graph), m_threads(threads), m_hessian(graph.number_of_vertices()), m_step(m_hessian.size()),
        m_residual(m_hessian.size()), m_direction(m_hessian.size()), m_image(m_hessian.size()),
        m_crosses(m_hessian.size()), m_change(m_hessian.size())
  {
  }

  double energy(const std::vector<Cross_harmonics>& q) const
  {
    return m_graph.energy_unit * parallel_sum(m_graph.number_of_vertices(), m_threads, [&](std::size_t v) {
             return 0.5 * (m_graph.degree[v] - q[v].dot(m_graph.sum_of_neighbours(v, q)));
           });
  }

  /// One step from the frames R with crosses q. `damping`: the share of Gauss and Newton's Hessian.
  Step step(std::vector<Eigen::Matrix3d>& R, std::vector<Cross_harmonics>& q, double damping,
            int max_conjugate_gradients, double tolerance)
  {
    const std::size_t n = m_graph.number_of_vertices();
    Step result;
    result.energy_before = result.energy = differentiate(q, damping);
    result.conjugate_gradients = solve(max_conjugate_gradients, tolerance);
    m_old_frames = R;
    m_old_crosses = q;
    double scale = std::min(1.0, longest_step / largest(m_step));
    for (int trial = 0; trial < max_trials; ++trial, scale *= 0.4) {
      parallel_for(n, m_threads, [&](std::size_t v) {
        Eigen::Vector3d w = scale * m_step[v].cast<double>();
        const double angle = w.norm();
        if (!(angle > 0))
          return;
        R[v] = Eigen::AngleAxisd(std::min(angle, largest_angle), w / angle) * m_old_frames[v];
        q[v] = cross_harmonics(R[v]);
      });
      result.energy = energy(q);
      if (result.energy < result.energy_before) {
        result.is_downhill = true;
        return result;
      }
    }
    R.swap(m_old_frames);
    q.swap(m_old_crosses);
    result.energy = result.energy_before;
    return result;
  }

private:
  static constexpr int max_trials = 6;
  /// In radians: angles above the first are cut, one by one, since singularities jump by large ones; but where one is
  /// above the second the whole step is scaled.
  static constexpr double largest_angle = 0.5, longest_step = 4;

  using Vectors = std::vector<Eigen::Vector3f>;
  using Harmonics = Eigen::Matrix<float, 9, 1>;
  using Generated = Eigen::Matrix<float, 9, 3>;

  static double largest(const Vectors& vectors)
  {
    float squared = 0;
    for (const Eigen::Vector3f& w : vectors)
      squared = std::max(squared, w.squaredNorm());
    return std::sqrt(double(squared));
  }

  static Generated generated(const Harmonics& q)
  {
    Generated result;
    for (int a = 0; a < 3; ++a)
      result.col(a) = rotation_generator(a, q);
    return result;
  }

  Eigen::Vector3f allowed(std::size_t v, const Eigen::Vector3f& w) const
  {
    const Cross_alignment* alignment = m_graph.alignment(v);
    if (!alignment)
      return w;
    if (alignment->is_fixed)
      return Eigen::Vector3f::Zero();
    const Eigen::Vector3f axis = alignment->crosses.frame.col(2).cast<float>();
    return axis * axis.dot(w);
  }

  /// The gradient's negative into `m_residual`, the Hessian's diagonal blocks; returns the energy.
  double differentiate(const std::vector<Cross_harmonics>& q, double damping)
  {
    return m_graph.energy_unit * parallel_sum(q.size(), m_threads, [&](std::size_t v) {
             const Cross_harmonics sum = m_graph.sum_of_neighbours(v, q);
             Eigen::Matrix<double, 9, 3> of_sum, of_q;
             for (int a = 0; a < 3; ++a) {
               of_sum.col(a) = rotation_generator(a, sum);
               of_q.col(a) = rotation_generator(a, q[v]);
             }
             m_crosses[v] = q[v].cast<float>();
             m_residual[v] = allowed(v, (-of_sum.transpose() * q[v]).cast<float>());
             const Eigen::Matrix3d product = of_sum.transpose() * of_q;
             const Eigen::Matrix3d hessian =
                 (1 - damping) * 0.5 * (product + product.transpose()) +
                 damping * curvature_of_crosses * m_graph.degree[v] * Eigen::Matrix3d::Identity();
             m_hessian[v] = hessian.cast<float>();
             return 0.5 * (m_graph.degree[v] - q[v].dot(sum));
           });
  }

  /// Crosses form a round manifold: turning one by an angle moves it by the square root of this times the angle.
  static constexpr double curvature_of_crosses = 20.0 / 3;

  float preconditioner(std::size_t v) const { return float(1 / (curvature_of_crosses * m_graph.absolute_degree[v])); }

  /// Newton's equations for `m_step` by conjugate gradients; returns their number.
  int solve(int max_iterations, double tolerance)
  {
    const std::size_t n = m_graph.number_of_vertices();
    double residual = parallel_sum(n, m_threads, [&](std::size_t v) {
      m_step[v].setZero();
      set_direction(v, preconditioner(v) * m_residual[v]);
      return double(m_direction[v].dot(m_residual[v]));
    });
    const double target = tolerance * tolerance * residual;
    for (int i = 0; i < max_iterations; ++i) {
      if (!(residual > target))
        return i;
      const double curvature = parallel_sum(n, m_threads, [&](std::size_t v) {
        const Harmonics sum = m_graph.sum_of_neighbours(v, m_change);
        Eigen::Vector3f image = m_hessian[v] * m_direction[v];
        for (int a = 0; a < 3; ++a)
          image[a] += m_crosses[v].dot(rotation_generator(a, sum));
        m_image[v] = allowed(v, image);
        return double(m_image[v].dot(m_direction[v]));
      });
      if (!(curvature > 0)) {
        if (i == 0)
          m_step = m_direction;
        return i;
      }
      const float factor = float(residual / curvature);
      const double next = parallel_sum(n, m_threads, [&](std::size_t v) {
        m_step[v] += factor * m_direction[v];
        m_residual[v] -= factor * m_image[v];
        return double(preconditioner(v) * m_residual[v].squaredNorm());
      });
      const float ratio = float(next / residual);
      parallel_for(n, m_threads, [&](std::size_t v) {
        set_direction(v, preconditioner(v) * m_residual[v] + ratio * m_direction[v]);
      });
      residual = next;
    }
    return max_iterations;
  }

  /// The direction, and how it changes the cross.
  void set_direction(std::size_t v, const Eigen::Vector3f& direction)
  {
    m_direction[v] = direction;
    m_change[v] = generated(m_crosses[v]) * direction;
  }

  const Field_graph& m_graph;
  int m_threads;
  std::vector<Eigen::Matrix3f> m_hessian;
  Vectors m_step, m_residual, m_direction, m_image;
  std::vector<Harmonics> m_crosses, m_change;
  std::vector<Eigen::Matrix3d> m_old_frames;
  std::vector<Cross_harmonics> m_old_crosses;
};

} // namespace internal
} // namespace Quadrille

#endif
