// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_H
#define QUADRILLE_ODECO_FRAME_FIELD_H

#include <Quadrille/Frame_size.h>
#include <Quadrille/Odeco_field_options.h>
#include <Quadrille/Odeco_frame_field/internal/Planar_field.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>

#include <boost/property_map/property_map.hpp>
#include <boost/unordered_map.hpp>

#include <functional>
#include <utility>
#include <vector>

namespace Quadrille {

/// What a constrained edge asks of the frames on it.
struct Edge_frame_constraint {
  bool constrained = false; ///< otherwise the rest is ignored
  bool aligned = true;      ///< frames have one vector along the edge
  /// Element sizes at the source and the target of `halfedge(e, mesh)`, for `e` as it stands in `edges(mesh)`, in the
  /// mesh's unit. Where the edge is not aligned, or the field isotropic, those across and along must not differ.
  Frame_size source_size, target_size;
};

/// The pair of gradients (du, dv) that a map should have on a face; sizes of elements are 1 / |du|, 1 / |dv|.
using Gradient_pair = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

/// Judges a candidate field, given by its gradient pairs in the order of `faces(mesh)`: lower is better. `start` is the
/// candidate's place in `Odeco_field_result::starts`. Called from several threads at once.
using Field_evaluator = std::function<double(std::size_t start, const std::vector<Gradient_pair>&)>;

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
  const internal::Indexed_triangulation& triangulation = index.triangulation;
  std::vector<Eigen::Vector2d> coordinates;
  coordinates.reserve(index.vertex_of.size());
  for (const auto v : index.vertex_of) {
    const auto& p = get(points, v);
    coordinates.emplace_back(double(p.x()), double(p.y()));
  }
  boost::unordered_map<typename boost::graph_traits<TriangleMesh>::halfedge_descriptor, int> halfedge_index;
  for (std::size_t h = 0; h < index.halfedge_of.size(); ++h)
    halfedge_index[index.halfedge_of[h]] = int(h);
  // Which halfedge an edge descriptor stands for may depend on where it comes from, so they are taken from edges(mesh).
  std::vector<internal::Constrained_halfedge> constrained;
  const auto all_edges = edges(mesh);
  for (auto e = all_edges.first; e != all_edges.second; ++e) {
    const Edge_frame_constraint constraint = get(constraints, *e);
    if (!constraint.constrained)
      continue;
    const auto place = halfedge_index.find(halfedge(*e, mesh));
    if (place != halfedge_index.end())
      constrained.push_back({place->second, constraint.aligned, {constraint.source_size, constraint.target_size}});
    else
      constrained.push_back({halfedge_index.at(opposite(halfedge(*e, mesh), mesh)),
                             constraint.aligned,
                             {constraint.target_size, constraint.source_size}});
  }
  std::vector<Gradient_pair> chosen;
  Odeco_field_result result =
      internal::solve_planar_field(triangulation, coordinates, constrained, options, evaluator, chosen);
  for (std::size_t f = 0; f < index.face_of.size(); ++f)
    put(gradients, index.face_of[f], chosen[f]);
  return result;
}

} // namespace Quadrille

#endif
