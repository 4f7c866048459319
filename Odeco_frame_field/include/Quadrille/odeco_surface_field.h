// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_SURFACE_FIELD_H
#define QUADRILLE_ODECO_SURFACE_FIELD_H

#include <Quadrille/Frame_edge_constraints.h>
#include <Quadrille/Odeco_frame_field/internal/solve_surface_field.h>
#include <Quadrille/Surface_field_options.h>
#include <Quadrille/exceptions.h>

#include <Eigen/Core>

#include <vector>

namespace Quadrille {

/// Computes an integrable orthogonal frame field on a triangulated surface in space, aligned with its normals and with
/// constrained edges, that has the sizes prescribed there (Couplet, Chemin, Bommes, Chien: Surface Quadrilateral
/// Meshing from Integrable Odeco Fields).
///
/// Without constraints frames find creases and principal directions of strong curvature by themselves. Constrained
/// edges that frames align with separate the two sides: at their vertices each side has its own tangent plane and
/// tensor; sizes along the edge are the same on both. Corners between them are treated as in `odeco_frame_field`.
///
/// Several candidates are computed: a smooth octahedral field relaxed to an integrable one, and `options.starts` fields
/// by melting and freezing. `evaluator` chooses among them; without one the lowest energy does.
///
/// \tparam TriangleMesh model of CGAL's `FaceListGraph` and `HalfedgeListGraph`; closed or with boundary, of any
///   genus, with any number of components; self-intersections do not matter
/// \tparam VertexPointMap readable property map, `vertex_descriptor` to a point with `x()`, `y()` and `z()`
/// \tparam EdgeConstraintMap readable property map, `edge_descriptor` to `Edge_frame_constraint`
/// \tparam FaceGradientMap writable property map, `face_descriptor` to `Gradient_pair`; receives the chosen
///   field in the basis of every face that `Surface_tangent_traits` has: along `halfedge(f, mesh)`, and across
///
/// \throws Invalid_input_error if the mesh is not a manifold oriented triangle mesh, a triangle has no area,
///   or triangles are folded onto each other at a vertex, so that it has no normal.
/// \throws Invalid_argument_error if a size is negative or not finite, or an option is out of range.
/// \throws No_result_error ("field") if no candidate has positive sizes everywhere.
///
/// Slivers are used as they are: they count by their areas. Results do not depend on `options.threads`. Cost: about 100
/// sparse factorisations of 5,000 triangles and 30 of all of them per start, O(n^1.5) for n faces.
template <class TriangleMesh, class VertexPointMap, class EdgeConstraintMap, class FaceGradientMap>
Surface_field_result odeco_surface_field(const TriangleMesh& mesh, const VertexPointMap& points,
                                         const EdgeConstraintMap& constraints, const FaceGradientMap& gradients,
                                         const Surface_field_options& options = {},
                                         const Field_evaluator& evaluator = {})
{
  const internal::Mesh_index<TriangleMesh> index(mesh);
  std::vector<Eigen::Vector3d> coordinates;
  coordinates.reserve(index.vertex_of.size());
  for (const auto v : index.vertex_of) {
    const auto& p = get(points, v);
    coordinates.emplace_back(double(p.x()), double(p.y()), double(p.z()));
  }
  std::vector<Gradient_pair> chosen;
  Surface_field_result result = internal::solve_surface_field(index.triangulation, coordinates,
                                                              internal::constrained_halfedges(index, mesh, constraints),
                                                              options, evaluator, chosen);
  for (std::size_t f = 0; f < index.face_of.size(); ++f)
    put(gradients, index.face_of[f], chosen[f]);
  return result;
}

} // namespace Quadrille

#endif
