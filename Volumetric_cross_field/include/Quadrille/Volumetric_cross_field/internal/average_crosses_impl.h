// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_AVERAGE_CROSSES_IMPL_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_AVERAGE_CROSSES_IMPL_H

#include <Quadrille/Volumetric_cross_field/internal/Cross_energy_newton.h>
#include <Quadrille/Volumetric_cross_field/internal/make_field_graph.h>
#include <Quadrille/nearest_cross.h>

#include <chrono>
#include <cmath>

namespace Quadrille {

template <class TetrahedralMesh>
Averaged_crosses average_crosses(const TetrahedralMesh& mesh, const Vertex_alignments& alignments,
                                 const Averaging_options& options)
{
  using namespace internal;
  const auto start = std::chrono::steady_clock::now();
  const Mesh_field_graph numbered(mesh, alignments, nullptr, Metric_connection(), options.threads);
  const Field_graph& graph = numbered.graph();
  const std::size_t n = graph.number_of_vertices();
  std::vector<Eigen::Matrix3d> frames(n);
  std::vector<Cross_harmonics> crosses(n), means(n);
  const auto project = [&](std::size_t v, const Cross_harmonics& q) -> Eigen::Matrix3d {
    if (const Cross_alignment* alignment = graph.alignment(v))
      return alignment->nearest(q);
    return options.exact_projection ? nearest_cross(q).frame : cross_of_eigentensors(cross_tensor(q));
  };
  const Cross_harmonics reference = cross_harmonics(Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  parallel_for(n, options.threads, [&](std::size_t v) {
    frames[v] = graph.alignment(v) ? project(v, reference) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
    crosses[v] = cross_harmonics(frames[v]);
  });
  Averaged_crosses result;
  double first = 0;
  while (result.sweeps < options.max_sweeps) {
    ++result.sweeps;
    parallel_for(n, options.threads, [&](std::size_t v) {
      means[v].setZero();
      for (std::size_t e = graph.first[v]; e < graph.first[v + 1]; ++e)
        means[v] += crosses[std::size_t(graph.edges[e].neighbour)];
      means[v] /= double(graph.first[v + 1] - graph.first[v]);
    });
    const double change = std::sqrt(parallel_sum(n, options.threads, [&](std::size_t v) {
      frames[v] = project(v, means[v]);
      const Cross_harmonics before = crosses[v];
      crosses[v] = cross_harmonics(frames[v]);
      return (crosses[v] - before).squaredNorm();
    }));
    if (result.sweeps == 1)
      first = change;
    if (change <= options.residual * first)
      break;
  }
  result.energy = Cross_energy_newton(graph, options.threads).energy(crosses);
  result.frames.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    result.frames[std::size_t(numbered.mesh_vertex(i))] = frames[i];
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

} // namespace Quadrille

#endif
