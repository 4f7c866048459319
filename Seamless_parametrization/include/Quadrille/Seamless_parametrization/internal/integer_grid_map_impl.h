// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_INTEGER_GRID_MAP_IMPL_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_INTEGER_GRID_MAP_IMPL_H

#include <Quadrille/Seamless_parametrization/internal/exact_map.h>
#include <Quadrille/exceptions.h>

#include <CGAL/number_utils.h>

#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// A seamless map's own plane as the geometry of the surface: seams are quarter turns.
/// \throws Invalid_input_error if the map is not exactly seamless or not positively oriented everywhere
inline Tangent_geometry geometry_of_map(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector2d>& uv)
{
  if (const std::vector<int> flipped = flipped_faces(uv); !flipped.empty())
    throw Invalid_input_error("triangle " + std::to_string(flipped.front()) +
                              " is flipped or degenerate in the seamless map");
  Tangent_geometry geometry;
  for (int h = 0; h < mesh.number_of_halfedges(); ++h)
    geometry.edge_vector.push_back(uv[std::size_t(Indexed_triangulation::next(h))] - uv[std::size_t(h)]);
  for (int h = 0; h < mesh.number_of_halfedges(); ++h) {
    int quarters = 0;
    if (!mesh.is_boundary(h))
      while (quarters < 4 && rotate_quarters(geometry.edge(h), quarters) != -geometry.edge(mesh.opposite(h)))
        ++quarters;
    if (quarters == 4)
      throw Invalid_input_error("the map is not exactly seamless across the edge of vertices " +
                                std::to_string(mesh.source(h)) + " and " + std::to_string(mesh.target(h)));
    geometry.transport.push_back(quarters * quarter_turn);
  }
  check_geometry(geometry);
  return geometry;
}

/// \throws Invalid_input_error if a displacement does not lead from corner to corner
inline void check_displacements(const Indexed_triangulation& mesh, const std::vector<Map_displacement>& displacements)
{
  const auto is_halfedge = [&](int h) { return h >= 0 && h < mesh.number_of_halfedges(); };
  for (std::size_t i = 0; i < displacements.size(); ++i) {
    const Map_displacement& displacement = displacements[i];
    bool is_path = is_halfedge(displacement.source_corner) && is_halfedge(displacement.target_corner);
    int face = displacement.source_corner / 3;
    for (const int h : displacement.crossed_halfedges) {
      is_path = is_path && is_halfedge(h) && h / 3 == face && !mesh.is_boundary(h);
      face = is_path ? mesh.opposite(h) / 3 : -1;
    }
    if (!is_path || face != displacement.target_corner / 3)
      throw Invalid_input_error("displacement " + std::to_string(i) + " is no path from its source to its target");
  }
}

} // namespace internal

template <class Solver, class TriangleMesh, class SeamlessUvMap, class EdgeConstrainedMap, class CornerUvMap>
Seamless_map<TriangleMesh> integer_grid_map(const TriangleMesh& mesh, SeamlessUvMap seamless_uv,
                                            EdgeConstrainedMap constrained,
                                            const std::vector<Map_displacement>& displacements, double scale,
                                            CornerUvMap uv, const Seamless_parametrization_options& options)
{
  const auto start = std::chrono::steady_clock::now();
  const internal::Mesh_index<TriangleMesh> index(mesh);
  const internal::Indexed_triangulation& triangulation = index.triangulation;
  std::vector<Eigen::Vector2d> given;
  std::vector<char> is_constrained;
  for (const auto h : index.halfedge_of) {
    const auto corner = get(seamless_uv, prev(h, mesh)); // ours is the corner that h leaves
    given.emplace_back(CGAL::to_double(corner.x()), CGAL::to_double(corner.y()));
    is_constrained.push_back(get(constrained, edge(h, mesh)) ? 1 : 0);
  }
  internal::check_displacements(triangulation, displacements);
  const internal::Seamless_map_solver<Solver> solver(triangulation, internal::geometry_of_map(triangulation, given),
                                                     std::move(is_constrained), displacements);
  Seamless_parametrization_options exact = options;
  exact.repair_corners = exact.move_singularities = false; // the given map has them where they belong
  const std::vector<internal::Gradient_pair> gradients(std::size_t(triangulation.number_of_faces()),
                                                       {Eigen::Vector2d(scale, 0), Eigen::Vector2d(0, scale)});
  Seamless_map<TriangleMesh> map = internal::finish_map(index, solver(gradients, exact), uv);
  map.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return map;
}

} // namespace Quadrille

#endif
