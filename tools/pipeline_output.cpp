// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pipeline_output.h"

namespace Quadrille {

Frames frames_of(const Planar_domain& domain, const Quad_pipeline_result& result)
{
  Frames frames;
  for (const Gradient_pair& gradients : result.gradients) {
    const Eigen::Vector2d u = gradients.first / gradients.first.squaredNorm();
    const Eigen::Vector2d v = gradients.second / gradients.second.squaredNorm();
    frames.u.push_back({u.x(), u.y()});
    frames.v.push_back({v.x(), v.y()});
  }
  frames.valence.assign(domain.mesh.number_of_vertices(), 4);
  if (result.map)
    for (const auto& [vertex, valence] : result.map->singular_vertices)
      frames.valence[std::size_t(vertex.idx())] = valence;
  return frames;
}

} // namespace Quadrille
