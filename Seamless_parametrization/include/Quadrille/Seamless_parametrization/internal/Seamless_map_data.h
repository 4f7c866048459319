// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_SEAMLESS_MAP_DATA_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_SEAMLESS_MAP_DATA_H

#include <Quadrille/Seamless_parametrization/internal/Cut_graph.h>
#include <Quadrille/Seamless_parametrization/internal/Frame_topology.h>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace Quadrille {
namespace internal {

/// A seamless map and all that was found on the way.
struct Seamless_map_data {
  std::vector<Eigen::Vector2d> uv; ///< by corner, in the combed coordinates of its face
  std::vector<int> matching;       ///< by halfedge, combed: (u,v) of the other side = R^k (u,v) + T
  Frame_topology topology;         ///< matchings and alignments of the given frames, before combing
  Cut_graph cut;
  std::vector<int> flipped_faces;
  std::vector<int> flat_faces;         ///< of the flipped ones: all corners on one line because of the constraints
  std::vector<int> misturned_vertices; ///< only looked for when nothing is flipped
  int reversed_edges = 0;              ///< constrained halfedges that run backwards
  int flipped_before_untangling = 0;
  int untangling_rounds = 0;
  int moved_singularities = 0;
  double integration_residual = 0.0;
  double integration_error = 0.0;
  double seam_residual_max = 0.0;
  double seconds = 0.0;

  std::size_t n_invalid() const
  {
    return flipped_faces.size() + std::size_t(reversed_edges) + misturned_vertices.size();
  }
};

} // namespace internal
} // namespace Quadrille

#endif
