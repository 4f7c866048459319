// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_FACE_GRAPH_ADAPTOR_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_FACE_GRAPH_ADAPTOR_H

#include <Quadrille/Seamless_parametrization/internal/Tangent_geometry.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>

#include <boost/property_map/property_map.hpp>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// A FaceGraph and its property maps as the index arrays that the algorithms work on.
template <class TriangleMesh> struct Face_graph_adaptor {
  template <class Traits, class FaceGradientMap, class EdgeConstrainedMap>
  Face_graph_adaptor(const TriangleMesh& mesh, const Traits& traits, FaceGradientMap gradient_map,
                     EdgeConstrainedMap constrained_map)
      : index(mesh)
  {
    const Indexed_triangulation& triangulation = index.triangulation;
    for (int h = 0; h < triangulation.number_of_halfedges(); ++h) {
      const auto descriptor = index.halfedge_of[std::size_t(h)];
      const std::array<double, 2> vector = traits.edge_vector(descriptor);
      geometry.edge_vector.emplace_back(vector[0], vector[1]);
      geometry.transport.push_back(triangulation.is_boundary(h) ? 0.0 : traits.transport_angle(descriptor));
      constrained.push_back(triangulation.is_boundary(h) || get(constrained_map, edge(descriptor, mesh)) ? 1 : 0);
    }
    check_geometry(geometry);
    for (const auto f : index.face_of) {
      const auto& [du, dv] = get(gradient_map, f);
      gradients.emplace_back(Eigen::Vector2d(double(du.x()), double(du.y())),
                             Eigen::Vector2d(double(dv.x()), double(dv.y())));
    }
  }

  Mesh_index<TriangleMesh> index;
  Tangent_geometry geometry;
  std::vector<char> constrained; ///< by halfedge
  std::vector<Gradient_pair> gradients;
};

} // namespace internal
} // namespace Quadrille

#endif
