// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_CURVE_CONFLICT_RESOLVER_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_CURVE_CONFLICT_RESOLVER_H

#include <Quadrille/Seamless_parametrization/internal/Cut_graph.h>
#include <Quadrille/Seamless_parametrization/internal/Frame_topology.h>
#include <Quadrille/Seamless_parametrization/internal/Seamless_constraints.h>
#include <Quadrille/Seamless_parametrization/internal/Tangent_geometry.h>
#include <Quadrille/Seamless_parametrization/internal/conflicting_corners.h>
#include <Quadrille/Seamless_parametrization/internal/curve_conflict.h>
#include <Quadrille/Seamless_parametrization/internal/exact_map.h>
#include <Quadrille/Seamless_parametrization/internal/repair_quadrants.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>
#include <Quadrille/exceptions.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Gives corners other numbers of quadrants where curves cannot all have positive lengths. What is not in conflict
/// stays as it is.
template <class Solver> class Curve_conflict_resolver {
public:
  /// `gradients`: by face, the wanted ones.
  Curve_conflict_resolver(const Indexed_triangulation& mesh, const Tangent_geometry& geometry,
                          const std::vector<Gradient_pair>& gradients)
      : m_mesh(mesh), m_geometry(geometry), m_gradients(gradients)
  {
  }

  /// What curves contradict each other with this topology.
  Curve_conflict conflict(const Frame_topology& topology) const
  {
    const Cut_graph cut = Cut_graph_builder(m_mesh, m_geometry, topology)();
    const Seamless_space space = Seamless_constraints(m_mesh, topology, cut)();
    return find_curve_conflict<Solver>(m_geometry, m_gradients, aligned_halfedges(topology, cut), space);
  }

  /// Changes one corner after the other, each time the one that leaves the least conflict, until there is none or no
  /// change lessens it. Returns what is left.
  /// Complexity: near-linear for each of the corners along the sides with the conflict, at most `max_candidates`.
  Curve_conflict operator()(Frame_topology& topology) const
  {
    Curve_conflict rest = conflict(topology);
    while (!rest.halfedges.empty() && improve(topology, rest)) {
    }
    return rest;
  }

private:
  static constexpr std::size_t max_candidates = 24;
  static constexpr double improvement = 0.99; ///< of the conflict's extent; less is within the accuracy of its minimum

  bool improve(Frame_topology& topology, Curve_conflict& conflict_left) const
  {
    std::vector<Corner_change> candidates = Conflicting_corner_finder(m_mesh, topology)(conflict_left.halfedges);
    candidates.resize(std::min(candidates.size(), max_candidates));
    const Frame_topology before = topology;
    bool is_better = false;
    for (const Corner_change& change : candidates) {
      if (conflict_left.halfedges.empty())
        break;
      Frame_topology changed = before;
      if (!Quadrant_repair(m_mesh, changed).change(change.sector, change.amount))
        continue;
      Curve_conflict rest;
      try {
        rest = conflict(changed);
      } catch (const No_result_error&) { // there are no seams for these matchings
        continue;
      }
      if (rest.extent < improvement * conflict_left.extent) {
        conflict_left = std::move(rest);
        topology = std::move(changed);
        is_better = true;
      }
    }
    return is_better;
  }

  const Indexed_triangulation& m_mesh;
  const Tangent_geometry& m_geometry;
  const std::vector<Gradient_pair>& m_gradients;
};

} // namespace internal
} // namespace Quadrille

#endif
