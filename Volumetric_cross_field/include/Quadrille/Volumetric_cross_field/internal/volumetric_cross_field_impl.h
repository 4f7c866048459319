// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_VOLUMETRIC_CROSS_FIELD_IMPL_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_VOLUMETRIC_CROSS_FIELD_IMPL_H

#include <Quadrille/Volumetric_cross_field/internal/make_field_graph.h>
#include <Quadrille/Volumetric_cross_field/internal/singular_faces.h>
#include <Quadrille/Volumetric_cross_field/internal/solve_field_graph.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <chrono>
#include <cstddef>
#include <utility>

namespace Quadrille {
namespace internal {

template <class Mesh>
Volumetric_cross_field smoothest_field(const Mesh& mesh, const Vertex_alignments& alignments,
                                       const Metric_field* metric, const Metric_connection& connection,
                                       const Cross_field_options& options, const Progress_observer& progress)
{
  const auto start = std::chrono::steady_clock::now();
  const Mesh_field_graph numbered(mesh, alignments, metric, connection, options.threads);
  Volumetric_cross_field result;
  const std::size_t n = mesh.number_of_vertices();
  result.frames.resize(n);
  const auto take = [&](const Frames_and_crosses& field) {
    parallel_for(n, options.threads,
                 [&](std::size_t i) { result.frames[std::size_t(numbered.mesh_vertex(i))] = field.frames[i]; });
  };
  const Edge_matcher matcher(result.frames, connection);
  std::array<std::size_t, 5> last{};
  const auto has_settled = [&](const Frames_and_crosses& field, const Cross_energy_newton::Step& step) {
    result.energy = std::max(step.energy, 0.0);
    // Of fields that are smooth altogether only rounding errors are left.
    const double rounding = 1e-12 * numbered.graph().energy_unit * double(n);
    const double decrease = (step.energy_before - step.energy) / (result.energy + rounding);
    if (!(decrease > 1e-2 * options.energy_tolerance) || step.energy_before < rounding)
      return result.has_settled = true;
    if (decrease > 3 * options.energy_tolerance)
      return false;
    take(field);
    std::array<std::size_t, 5> counts{};
    for (const unsigned char faces : singular_faces(mesh, matcher, options.threads))
      ++counts[std::bitset<4>(faces).count()];
    // Arcs that move change the numbers of tetrahedra with two singular faces, but not of those with three and four.
    const bool is_same = counts[3] == last[3] && counts[4] == last[4];
    last = counts;
    return result.has_settled = is_same && decrease <= options.energy_tolerance;
  };
  Field_graph_counters counters;
  take(solve_field_graph(numbered.graph(), options.seed, options.threads, options.max_newton_steps, has_settled,
                         progress, counters));
  result.levels = counters.levels;
  result.diffusions = counters.diffusions;
  result.newton_steps = counters.newton_steps;
  result.conjugate_gradients = counters.conjugate_gradients;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

} // namespace internal

template <class TetrahedralMesh>
Volumetric_cross_field volumetric_cross_field(const TetrahedralMesh& mesh, const Vertex_alignments& alignments,
                                              const Cross_field_options& options, const Progress_observer& progress)
{
  return internal::smoothest_field(mesh, alignments, nullptr, Metric_connection(), options, progress);
}

template <class TetrahedralMesh>
Volumetric_cross_field volumetric_cross_field(const TetrahedralMesh& mesh, const Vertex_alignments& alignments,
                                              const Metric_field& metric, const Metric_connection& connection,
                                              const Cross_field_options& options, const Progress_observer& progress)
{
  return internal::smoothest_field(mesh, alignments, &metric, connection, options, progress);
}

} // namespace Quadrille

#endif
