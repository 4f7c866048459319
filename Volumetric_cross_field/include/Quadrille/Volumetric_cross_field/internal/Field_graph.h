// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_FIELD_GRAPH_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_FIELD_GRAPH_H

#include <Quadrille/Support/internal/parallel_sum.h>
#include <Quadrille/cross_alignment.h>
#include <Quadrille/cross_harmonics.h>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <vector>

namespace Quadrille {
namespace internal {

/// What the smoothness of a field of crosses is measured on: vertices with masses, edges with weights and, under a
/// metric, with rotations; and what some crosses are aligned with. A mesh, or a coarser image of one.
///
/// The energy is `energy_unit` times the sum over edges of w |q_v - D q_u|^2 / 2, where D takes crosses from u to v.
/// Masses and degrees have the mean 1 (see `normalize`), so that times of diffusion count in squared lengths of edges
/// and single precision does for the weights.
struct Field_graph {
  struct Edge {
    int neighbour;
    float weight;
  };

  /// Edges of vertex v are number `first[v]` to `first[v + 1]` (excluded). Each edge is there from both of its ends.
  std::vector<std::size_t> first;
  std::vector<Edge> edges;
  std::vector<Eigen::Matrix3d> turn;        ///< per edge, carries frames from the neighbour to v; empty: the identity
  std::vector<Harmonic_rotation> transport; ///< the same for crosses
  std::vector<double> degree;               ///< sum of the weights at a vertex
  std::vector<double> absolute_degree;      ///< of their absolute values: cotangents can be negative
  std::vector<double> mass;
  double energy_unit = 1;

  static constexpr int is_free = -1;
  std::vector<int> alignment_of; ///< per vertex: index into `alignments`, or `is_free`
  std::vector<Cross_alignment> alignments;

  std::size_t number_of_vertices() const { return mass.size(); }

  const Cross_alignment* alignment(std::size_t v) const
  {
    return alignment_of[v] == is_free ? nullptr : &alignments[std::size_t(alignment_of[v])];
  }

  /// The sum over the neighbours u of w D x(u).
  template <class Harmonics> Harmonics sum_of_neighbours(std::size_t v, const std::vector<Harmonics>& x) const
  {
    Harmonics sum = Harmonics::Zero();
    if (transport.empty())
      for (std::size_t e = first[v]; e < first[v + 1]; ++e)
        sum += typename Harmonics::Scalar(edges[e].weight) * x[std::size_t(edges[e].neighbour)];
    else
      for (std::size_t e = first[v]; e < first[v + 1]; ++e) {
        const Cross_harmonics there = x[std::size_t(edges[e].neighbour)].template cast<double>();
        sum += (edges[e].weight * transport[e](there)).template cast<typename Harmonics::Scalar>();
      }
    return sum;
  }

  void set_transport(int threads)
  {
    transport.resize(turn.size());
    parallel_for(turn.size(), threads, [&](std::size_t e) { transport[e] = Harmonic_rotation(turn[e]); });
  }

  /// Adds up the degrees, and scales masses and weights by their means. `weights` are those of the edges so far.
  void set_weights(const std::vector<double>& weights, int threads)
  {
    const std::size_t n = number_of_vertices();
    const double mean_mass = parallel_sum(n, threads, [&](std::size_t v) { return mass[v]; }) / double(n);
    const double mean_degree = parallel_sum(n, threads,
                                            [&](std::size_t v) {
                                              double sum = 0;
                                              for (std::size_t e = first[v]; e < first[v + 1]; ++e)
                                                sum += std::abs(weights[e]);
                                              return sum;
                                            }) /
                               double(n);
    energy_unit *= mean_degree;
    degree.assign(n, 0);
    absolute_degree.assign(n, 0);
    parallel_for(n, threads, [&](std::size_t v) {
      mass[v] /= mean_mass;
      for (std::size_t e = first[v]; e < first[v + 1]; ++e) {
        edges[e].weight = float(weights[e] / mean_degree);
        degree[v] += double(edges[e].weight);
        absolute_degree[v] += std::abs(double(edges[e].weight));
      }
    });
  }
};

} // namespace internal
} // namespace Quadrille

#endif
