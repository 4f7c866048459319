// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_H
#define QUADRILLE_ODECO_FRAME_FIELD_H

#include <Quadrille/Frame_edge_constraints.h>
#include <Quadrille/Odeco_field_options.h>
#include <Quadrille/Odeco_frame_field/internal/solve_planar_field.h>
#include <Quadrille/exceptions.h>

#include <boost/property_map/property_map.hpp>

#include <vector>

namespace Quadrille {

/// Computes an integrable orthogonal frame field on a planar triangle mesh that has the sizes and directions prescribed
/// on constrained edges (Couplet, Chemin, Remacle: Size-Controlled Quadrilateral Meshing using Integrable Odeco
/// Fields).
///
/// Several candidates are computed: the smooth field relaxed to an integrable one, and `options.starts` fields by
/// melting and freezing, which places the singularities that the sizes need. `evaluator` chooses among them; without
/// one the lowest energy does (energies are comparable only between equal numbers of singularities, so a map-based
/// evaluator is better).
///
/// A vertex between constrained edges takes the bisector of their frames; corners more than 30 degrees off a multiple
/// of 90 degrees are left free. What the edges prescribe for the same vector of the frame is averaged (geometric mean);
/// where that differs by more than a factor of 1.5 in an anisotropic field, the vector's size is left free.
///
/// \tparam TriangleMesh model of CGAL's `FaceListGraph` and `HalfedgeListGraph`
/// \tparam VertexPointMap readable property map, `vertex_descriptor` to a point with `x()` and `y()`
/// \tparam EdgeConstraintMap readable property map, `edge_descriptor` to `Edge_frame_constraint`
/// \tparam FaceGradientMap writable property map, `face_descriptor` to `Gradient_pair`; receives the chosen field
///
/// \pre faces are counterclockwise.
/// \throws Invalid_input_error if the mesh is not a manifold oriented triangle mesh, or no edge is constrained.
/// \throws Invalid_argument_error if a size is negative or not finite, or an option is out of range.
/// \throws No_result_error ("field") if no candidate has positive sizes everywhere.
///
/// Results do not depend on `options.threads`. Cost: about 250 sparse factorisations per start, O(n^1.5) for n faces.
template <class TriangleMesh, class VertexPointMap, class EdgeConstraintMap, class FaceGradientMap>
Odeco_field_result odeco_frame_field(const TriangleMesh& mesh, const VertexPointMap& points,
                                     const EdgeConstraintMap& constraints, const FaceGradientMap& gradients,
                                     const Odeco_field_options& options = {}, const Field_evaluator& evaluator = {})
{
  const internal::Mesh_index<TriangleMesh> index(mesh);
  std::vector<Eigen::Vector2d> coordinates;
  coordinates.reserve(index.vertex_of.size());
  for (const auto v : index.vertex_of) {
    const auto& p = get(points, v);
    coordinates.emplace_back(double(p.x()), double(p.y()));
  }
  std::vector<Gradient_pair> chosen;
  Odeco_field_result result = internal::solve_planar_field(index.triangulation, coordinates,
                                                           internal::constrained_halfedges(index, mesh, constraints),
                                                           options, evaluator, chosen);
  for (std::size_t f = 0; f < index.face_of.size(); ++f)
    put(gradients, index.face_of[f], chosen[f]);
  return result;
}

} // namespace Quadrille

#endif
