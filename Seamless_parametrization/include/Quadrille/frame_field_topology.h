// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_FRAME_FIELD_TOPOLOGY_H
#define QUADRILLE_FRAME_FIELD_TOPOLOGY_H

#include <Quadrille/Planar_tangent_traits.h>
#include <Quadrille/exceptions.h>

#include <boost/graph/graph_traits.hpp>

#include <utility>
#include <vector>

namespace Quadrille {

/// Singularities and corners of a frame field. Indices are given in quarters, so that they are exact.
template <class TriangleMesh> struct Frame_field_topology {
  using vertex_descriptor = typename boost::graph_traits<TriangleMesh>::vertex_descriptor;

  /// Interior vertices of index other than 0: +1 is index 1/4 (valence 3), -1 is index -1/4 (valence 5).
  std::vector<std::pair<vertex_descriptor, int>> singular_vertices;
  /// Boundary vertices of index other than 0: +1 is a convex corner of 90 degrees, -1 a concave one of 270 degrees.
  std::vector<std::pair<vertex_descriptor, int>> boundary_corners;
  int quarter_index_sum = 0; ///< over all vertices: four times the Euler characteristic
};

/// Finds how the frames of neighbouring faces correspond, by the smallest turn between them, and what follows for the
/// vertices by turning numbers. No map is computed, and no corner is repaired: an index of +4 or more is reported as
/// is.
///
/// \param mesh, points, gradients, constrained as for `seamless_parametrization`
/// \param matching writable property map, halfedge -> int: k in {0, 1, 2, 3} such that coordinates of the frame beyond
///   the halfedge are R^k (coordinates of its own face's frame), R (u,v) = (-v,u); 0 on the boundary. Opposite
///   halfedges receive opposite values
/// \throws Invalid_input_error as `seamless_parametrization`
/// Complexity: linear.
template <class TriangleMesh, class VertexPointMap, class FaceGradientMap, class EdgeConstrainedMap, class MatchingMap>
Frame_field_topology<TriangleMesh> frame_field_topology(const TriangleMesh& mesh, VertexPointMap points,
                                                        FaceGradientMap gradients, EdgeConstrainedMap constrained,
                                                        MatchingMap matching);

/// The same on any surface: `Traits`, a model of `TangentPlaneTraits`, knows its faces' tangent bases, in which the
/// `gradients` are given.
template <class TriangleMesh, class Traits, class FaceGradientMap, class EdgeConstrainedMap, class MatchingMap>
Frame_field_topology<TriangleMesh>
frame_field_topology_with_traits(const TriangleMesh& mesh, const Traits& traits, FaceGradientMap gradients,
                                 EdgeConstrainedMap constrained, MatchingMap matching);

} // namespace Quadrille

#include <Quadrille/Seamless_parametrization/internal/frame_field_topology_impl.h>

#endif
