// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_FRAME_FIELD_TOPOLOGY_IMPL_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_FRAME_FIELD_TOPOLOGY_IMPL_H

#include <Quadrille/Seamless_parametrization/internal/Face_graph_adaptor.h>
#include <Quadrille/Seamless_parametrization/internal/Frame_topology.h>

#include <cstddef>

namespace Quadrille {

template <class TriangleMesh, class Traits, class FaceGradientMap, class EdgeConstrainedMap, class MatchingMap>
Frame_field_topology<TriangleMesh>
frame_field_topology_with_traits(const TriangleMesh& mesh, const Traits& traits, FaceGradientMap gradients,
                                 EdgeConstrainedMap constrained, MatchingMap matching)
{
  const internal::Face_graph_adaptor<TriangleMesh> input(mesh, traits, gradients, constrained);
  const internal::Indexed_triangulation& triangulation = input.index.triangulation;
  const internal::Frame_topology topology =
      internal::Frame_topology_builder(triangulation, input.geometry, input.constrained, input.gradients)();

  for (int h = 0; h < triangulation.number_of_halfedges(); ++h) {
    const auto descriptor = input.index.halfedge_of[std::size_t(h)];
    put(matching, descriptor, topology.matching[std::size_t(h)]);
    if (triangulation.is_boundary(h))
      put(matching, opposite(descriptor, mesh), 0);
  }
  Frame_field_topology<TriangleMesh> result;
  for (int v = 0; v < triangulation.number_of_vertices(); ++v) {
    const int index = topology.quarter_index(triangulation, v);
    result.quarter_index_sum += index;
    if (index != 0)
      (triangulation.is_boundary_vertex(v) ? result.boundary_corners : result.singular_vertices)
          .emplace_back(input.index.vertex_of[std::size_t(v)], index);
  }
  return result;
}

template <class TriangleMesh, class VertexPointMap, class FaceGradientMap, class EdgeConstrainedMap, class MatchingMap>
Frame_field_topology<TriangleMesh> frame_field_topology(const TriangleMesh& mesh, VertexPointMap points,
                                                        FaceGradientMap gradients, EdgeConstrainedMap constrained,
                                                        MatchingMap matching)
{
  return frame_field_topology_with_traits(mesh, Planar_tangent_traits<TriangleMesh, VertexPointMap>(mesh, points),
                                          gradients, constrained, matching);
}

} // namespace Quadrille

#endif
