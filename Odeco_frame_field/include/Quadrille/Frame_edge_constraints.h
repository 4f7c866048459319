// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_FRAME_EDGE_CONSTRAINTS_H
#define QUADRILLE_FRAME_EDGE_CONSTRAINTS_H

#include <Quadrille/Frame_size.h>
#include <Quadrille/Odeco_field_options.h>
#include <Quadrille/Odeco_frame_field/internal/vertex_restrictions.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>

#include <boost/unordered_map.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <type_traits>
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
  /// On surfaces: imposed weakly, as a term of the energy (`Surface_field_options::weak_weight`). The edge does not
  /// part the surface then. Not in the plane.
  bool is_weak = false;
};

/// The pair of gradients (du, dv) that a map should have on a face; sizes of elements are 1 / |du|, 1 / |dv|.
using Gradient_pair = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

/// Judges candidate fields, and chooses among them.
struct Field_evaluator {
  /// What a candidate costs, lower is better. `start` is its place in the result's `starts`; it is given by its
  /// gradient pairs in the order of `faces(mesh)`.
  using Cost = std::function<double(std::size_t start, const std::vector<Gradient_pair>&)>;
  /// The place of the start to take, of at least one valid one, by their costs or by what was kept of them in `Cost`.
  using Choice = std::function<std::size_t(const std::vector<Field_start>&)>;

  Cost cost;     ///< of every candidate; called from several threads at once; empty: the field's energy
  Choice choose; ///< called once. Empty: the start with the least cost, the smooth one only if no other is valid

  Field_evaluator() = default;
  template <
      class Function,
      class = std::enable_if_t<std::is_invocable_r_v<double, Function, std::size_t, const std::vector<Gradient_pair>&>>>
  Field_evaluator(Function cost) : cost(std::move(cost))
  {
  }
  Field_evaluator(Cost cost, Choice choose) : cost(std::move(cost)), choose(std::move(choose)) {}
};

namespace internal {

/// The constrained edges by our halfedge indices. Which halfedge an edge descriptor stands for may depend on where it
/// comes from, so they are taken from edges(mesh).
template <class TriangleMesh, class EdgeConstraintMap>
std::vector<Constrained_halfedge> constrained_halfedges(const Mesh_index<TriangleMesh>& index, const TriangleMesh& mesh,
                                                        const EdgeConstraintMap& constraints)
{
  boost::unordered_map<typename boost::graph_traits<TriangleMesh>::halfedge_descriptor, int> halfedge_index;
  for (std::size_t h = 0; h < index.halfedge_of.size(); ++h)
    halfedge_index[index.halfedge_of[h]] = int(h);
  std::vector<Constrained_halfedge> constrained;
  const auto all_edges = edges(mesh);
  for (auto e = all_edges.first; e != all_edges.second; ++e) {
    const Edge_frame_constraint constraint = get(constraints, *e);
    if (!constraint.constrained)
      continue;
    const auto place = halfedge_index.find(halfedge(*e, mesh));
    if (place != halfedge_index.end())
      constrained.push_back(
          {place->second, constraint.aligned, {constraint.source_size, constraint.target_size}, constraint.is_weak});
    else
      constrained.push_back({halfedge_index.at(opposite(halfedge(*e, mesh), mesh)),
                             constraint.aligned,
                             {constraint.target_size, constraint.source_size},
                             constraint.is_weak});
  }
  return constrained;
}

} // namespace internal
} // namespace Quadrille

#endif
