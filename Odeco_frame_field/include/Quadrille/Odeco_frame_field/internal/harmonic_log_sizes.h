// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_HARMONIC_LOG_SIZES_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_HARMONIC_LOG_SIZES_H

#include <Quadrille/Cholesky_solver.h>
#include <Quadrille/Odeco_frame_field/internal/local_triangle_sizes.h>
#include <Quadrille/Odeco_frame_field/internal/vertex_restrictions.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// A vertex of each component in which no value is known.
inline std::vector<int> first_vertices_of_components(const Indexed_triangulation& mesh,
                                                     const std::vector<std::optional<double>>& known)
{
  std::vector<int> result, stack;
  std::vector<char> is_visited(known.size(), 0);
  for (int first = 0; first < mesh.number_of_vertices(); ++first) {
    if (is_visited[std::size_t(first)] || mesh.outgoing(first) < 0)
      continue;
    bool is_known = false;
    stack.push_back(first);
    is_visited[std::size_t(first)] = 1;
    while (!stack.empty()) {
      const int v = stack.back();
      stack.pop_back();
      is_known = is_known || known[std::size_t(v)];
      const int start = mesh.outgoing(v);
      int h = start;
      do {
        for (const int w : {mesh.target(h), mesh.source(Indexed_triangulation::prev(h))})
          if (!is_visited[std::size_t(w)]) {
            is_visited[std::size_t(w)] = 1;
            stack.push_back(w);
          }
        h = mesh.next_around_source(h);
      } while (h >= 0 && h != start);
    }
    if (!is_known)
      result.push_back(first);
  }
  return result;
}

/// The harmonic extension of values that are known at some vertices; zero if they are known nowhere, or in a component
/// without any.
template <class Point>
std::vector<double> harmonic_extension(const Indexed_triangulation& mesh, const std::vector<Point>& points,
                                       const std::vector<std::optional<double>>& known)
{
  std::vector<double> values(points.size(), 0.0);
  std::vector<int> unknown(points.size(), -1);
  int n = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (known[v])
      values[v] = *known[v];
    else if (mesh.outgoing(int(v)) >= 0)
      unknown[v] = n++;
  }
  if (n == 0 || std::none_of(known.begin(), known.end(), [](const auto& value) { return value.has_value(); }))
    return values;

  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(n), solution;
  for (int h = 0; h < mesh.number_of_halfedges(); ++h) {
    // Half the cotangent of the angle opposite to h couples its two ends.
    const auto a = std::size_t(mesh.source(h)), b = std::size_t(mesh.target(h));
    const Point& apex = points[std::size_t(mesh.source(Indexed_triangulation::prev(h)))];
    const Point p = points[a] - apex, q = points[b] - apex;
    const double weight = 0.5 * p.dot(q) / twice_area(p, q);
    for (const auto& [i, j] : {std::pair(a, b), std::pair(b, a)}) {
      if (unknown[i] < 0)
        continue;
      entries.emplace_back(unknown[i], unknown[i], weight);
      if (unknown[j] < 0)
        load[unknown[i]] += weight * values[j];
      else if (unknown[j] < unknown[i])
        entries.emplace_back(unknown[i], unknown[j], -weight);
    }
  }
  Eigen::SparseMatrix<double> lower(n, n);
  lower.setFromTriplets(entries.begin(), entries.end());
  Cholesky_solver solver;
  solver.analyze(lower);
  if (!solver.factorize(lower))
    return values; // some component has no known value
  solver.solve(load, solution);
  for (std::size_t v = 0; v < points.size(); ++v)
    if (unknown[v] >= 0)
      values[v] = solution[unknown[v]];
  return values;
}

/// The sizes that one expects between the prescribed ones: the harmonic extension of their logarithms, per vertex. Zero
/// where no size is prescribed at all. `target_size`: per vertex, or empty; 0 where there is none.
inline std::vector<double> harmonic_log_sizes(const Indexed_triangulation& mesh,
                                              const std::vector<Eigen::Vector2d>& points,
                                              const std::vector<Vertex_constraint>& constraints,
                                              const std::vector<double>& target_size)
{
  std::vector<std::optional<double>> known(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (constraints[v].has_size())
      known[v] = std::log(constraints[v].mean_size());
    else if (!target_size.empty() && target_size[v] > 0)
      known[v] = std::log(target_size[v]);
  }
  return harmonic_extension(mesh, points, known);
}

} // namespace internal
} // namespace Quadrille

#endif
