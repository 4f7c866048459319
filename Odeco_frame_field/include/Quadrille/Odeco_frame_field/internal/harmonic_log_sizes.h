// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_HARMONIC_LOG_SIZES_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_HARMONIC_LOG_SIZES_H

#include <Quadrille/Cholesky_solver.h>
#include <Quadrille/Odeco_frame_field/internal/vertex_restrictions.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// The sizes that one expects between the prescribed ones: the harmonic extension of their logarithms, per vertex. Zero
/// where no size is prescribed at all. `target_size`: per vertex, or empty; 0 where there is none.
inline std::vector<double> harmonic_log_sizes(const Indexed_triangulation& mesh,
                                              const std::vector<Eigen::Vector2d>& points,
                                              const std::vector<Vertex_constraint>& constraints,
                                              const std::vector<double>& target_size)
{
  std::vector<double> log_sizes(points.size(), 0.0);
  std::vector<int> unknown(points.size(), -1);
  int n = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (constraints[v].has_size())
      log_sizes[v] = std::log(constraints[v].mean_size());
    else if (!target_size.empty() && target_size[v] > 0)
      log_sizes[v] = std::log(target_size[v]);
    else if (mesh.outgoing(int(v)) >= 0)
      unknown[v] = n++;
  }
  const bool any_prescribed =
      std::any_of(constraints.begin(), constraints.end(), [](const auto& c) { return c.has_size(); });
  const bool any_target = std::any_of(target_size.begin(), target_size.end(), [](double s) { return s > 0; });
  if (n == 0 || !(any_prescribed || any_target))
    return log_sizes;

  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(n), solution;
  for (int h = 0; h < mesh.number_of_halfedges(); ++h) {
    // Half the cotangent of the angle opposite to h couples its two ends.
    const auto a = std::size_t(mesh.source(h)), b = std::size_t(mesh.target(h));
    const Eigen::Vector2d& apex = points[std::size_t(mesh.source(Indexed_triangulation::prev(h)))];
    const Eigen::Vector2d p = points[a] - apex, q = points[b] - apex;
    const double weight = 0.5 * p.dot(q) / (p.x() * q.y() - p.y() * q.x());
    for (const auto& [i, j] : {std::pair(a, b), std::pair(b, a)}) {
      if (unknown[i] < 0)
        continue;
      entries.emplace_back(unknown[i], unknown[i], weight);
      if (unknown[j] < 0)
        load[unknown[i]] += weight * log_sizes[j];
      else if (unknown[j] < unknown[i])
        entries.emplace_back(unknown[i], unknown[j], -weight);
    }
  }
  Eigen::SparseMatrix<double> lower(n, n);
  lower.setFromTriplets(entries.begin(), entries.end());
  Cholesky_solver solver;
  solver.analyze(lower);
  if (!solver.factorize(lower))
    return log_sizes; // some component has no prescribed size
  solver.solve(load, solution);
  for (std::size_t v = 0; v < points.size(); ++v)
    if (unknown[v] >= 0)
      log_sizes[v] = solution[unknown[v]];
  return log_sizes;
}

} // namespace internal
} // namespace Quadrille

#endif
