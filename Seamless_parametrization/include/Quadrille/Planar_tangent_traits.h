// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_PLANAR_TANGENT_TRAITS_H
#define QUADRILLE_PLANAR_TANGENT_TRAITS_H

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <array>

namespace Quadrille {

/// Tangent planes of a planar mesh: all faces share the basis of the plane. A model of `TangentPlaneTraits`.
///
/// `VertexPointMap` is a readable property map from vertices to points with `x()` and `y()`.
template <class TriangleMesh, class VertexPointMap> class Planar_tangent_traits {
public:
  using halfedge_descriptor = typename boost::graph_traits<TriangleMesh>::halfedge_descriptor;

  /// \pre `mesh` outlives the traits.
  Planar_tangent_traits(const TriangleMesh& mesh, VertexPointMap points) : m_mesh(mesh), m_points(points) {}

  /// The vector from the source of `h` to its target.
  std::array<double, 2> edge_vector(halfedge_descriptor h) const
  {
    const auto& from = get(m_points, source(h, m_mesh));
    const auto& to = get(m_points, target(h, m_mesh));
    return {double(to.x() - from.x()), double(to.y() - from.y())};
  }

  /// Directions keep their angles from face to face.
  double transport_angle(halfedge_descriptor) const { return 0.0; }

private:
  const TriangleMesh& m_mesh;
  VertexPointMap m_points;
};

} // namespace Quadrille

#endif
