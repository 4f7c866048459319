// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_CROSS_DIFFUSION_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_CROSS_DIFFUSION_H

#include <Quadrille/Volumetric_cross_field/internal/Field_graph.h>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <vector>

namespace Quadrille {
namespace internal {

/// Implicit diffusion of the crosses' harmonics: (M + t L) x = M p at all vertices, within the affine space of the
/// alignments.
///
/// Chebyshev's iteration, preconditioned by the diagonal, without a matrix and without inner products: one pass over
/// the edges for each iteration, all nine components together, in single precision (the projection onto crosses that
/// follows forgives more). With the absolute degrees in the preconditioner all eigenvalues are at most 2.
class Cross_diffusion {
public:
  using Harmonics = Eigen::Matrix<float, 9, 1>;
  using Field = std::vector<Harmonics>;

  Cross_diffusion(const Field_graph& graph, int threads)
      : m_graph(graph), m_threads(threads), m_previous(graph.number_of_vertices())
  {
    for (const Cross_alignment& alignment : graph.alignments)
      m_bases.push_back(alignment.crosses.basis.cast<float>());
  }

  /// `x` is the start, in the affine space, and becomes the solution but for about `error` of the start's distance from
  /// it. Returns the number of passes.
  int solve(double time, const Field& p, Field& x, double error)
  {
    const double lowest = 1 / (1 + time), highest = 2;
    const double center = 0.5 * (highest + lowest), radius = 0.5 * (highest - lowest);
    const int passes = int(std::ceil(0.5 * std::sqrt(highest / lowest) * std::log(2 / error)));
    double rho = radius / center;
    pass(time, p, x, 0, 1 / center);
    x.swap(m_previous);
    for (int i = 1; i < passes; ++i) {
      const double next = 1 / (2 * center / radius - rho);
      pass(time, p, x, next * rho, 2 * next / radius);
      x.swap(m_previous);
      rho = next;
    }
    return passes;
  }

private:
  /// m_previous becomes x + momentum (x - m_previous) + factor (preconditioned residual of x).
  void pass(double time, const Field& p, const Field& x, double momentum, double factor)
  {
    parallel_for(m_graph.number_of_vertices(), m_threads, [&](std::size_t v) {
      const double mass = m_graph.mass[v];
      const float scale = float(factor / (mass + time * m_graph.absolute_degree[v]));
      const Harmonics residual = float(mass) * (p[v] - x[v]) +
                                 float(time) * (m_graph.sum_of_neighbours(v, x) - float(m_graph.degree[v]) * x[v]);
      Harmonics change = scale * residual;
      if (momentum > 0)
        change += float(momentum) * (x[v] - m_previous[v]);
      const int alignment = m_graph.alignment_of[v];
      if (alignment != Field_graph::is_free) {
        const auto& basis = m_bases[std::size_t(alignment)];
        change = (basis * (basis.transpose() * change)).eval();
      }
      m_previous[v] = x[v] + change;
    });
  }

  const Field_graph& m_graph;
  int m_threads;
  Field m_previous;
  std::vector<Eigen::Matrix<float, 9, 2>> m_bases; ///< per alignment; zero where a frame is given
};

} // namespace internal
} // namespace Quadrille

#endif
