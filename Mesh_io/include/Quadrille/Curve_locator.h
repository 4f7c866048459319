// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_CURVE_LOCATOR_H
#define QUADRILLE_CURVE_LOCATOR_H

#include <Quadrille/Mesh_io/internal/Nearest_tree.h>
#include <Quadrille/Mesh_io/internal/vector_length.h>
#include <Quadrille/Triangulated_domain.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace Quadrille {

/// Finds the nearest point on the curves of a domain.
///
/// Copies share what they search in. Complexity of the construction: O(n log n) in the number of edges on curves.
/// \pre the domain outlives the locator and does not change.
template <class Point> class Curve_locator {
public:
  using Domain = Triangulated_domain<Point>;

  /// A point on an edge of the domain's mesh.
  struct Place {
    typename Domain::edge_descriptor edge; ///< null if there are no curves
    double parameter = 0;                  ///< from 0 at the source to 1 at the target of `halfedge(edge)`
    double distance = std::numeric_limits<double>::infinity();
  };

  explicit Curve_locator(const Domain& domain) : m_domain(&domain)
  {
    std::vector<Edges> edges(std::size_t(domain.number_of_chains) + 1);
    for (const auto e : domain.mesh.edges())
      if (const int chain = domain.edge_chain[std::size_t(e.idx())]; chain >= 0) {
        edges[std::size_t(chain)].push_back(e);
        edges.back().push_back(e);
      }
    for (Edges& some : edges)
      m_sets.push_back(std::make_shared<const Edge_set>(domain, std::move(some)));
  }

  /// The nearest point on a chain of the domain, or, without one, on all its curves. Complexity: O(log n) in the usual
  /// case.
  Place nearest(const Point& point, int chain = -1) const
  {
    const Edge_set& set = *m_sets[chain < 0 ? m_sets.size() - 1 : std::size_t(chain)];
    if (set.edges.empty())
      return {};
    const auto e = set.edges[set.tree.nearest(in_space(point)).index];
    const Point& source = m_domain->mesh.point(m_domain->mesh.source(m_domain->mesh.halfedge(e)));
    const auto along = m_domain->mesh.point(m_domain->mesh.target(m_domain->mesh.halfedge(e))) - source;
    const auto offset = point - source;
    const double t = std::clamp((offset * along) / (along * along), 0.0, 1.0);
    return {e, t, internal::length_of(offset - t * along)};
  }

private:
  using Edges = std::vector<typename Domain::edge_descriptor>;
  using Segment_3 = internal::Space_kernel::Segment_3;

  struct Edge_set {
    Edges edges;
    internal::Nearest_tree<Segment_3> tree;

    Edge_set(const Domain& domain, Edges some) : edges(std::move(some)), tree(segments_of(domain, edges)) {}
  };

  static internal::Space_kernel::Point_3 in_space(const Point& p)
  {
    if constexpr (Domain::dimension == 2)
      return {p.x(), p.y(), 0};
    else
      return {p.x(), p.y(), p.z()};
  }

  static std::vector<Segment_3> segments_of(const Domain& domain, const Edges& edges)
  {
    std::vector<Segment_3> segments;
    for (const auto e : edges) {
      const auto h = domain.mesh.halfedge(e);
      segments.emplace_back(in_space(domain.mesh.point(domain.mesh.source(h))),
                            in_space(domain.mesh.point(domain.mesh.target(h))));
    }
    return segments;
  }

  const Domain* m_domain;
  std::vector<std::shared_ptr<const Edge_set>> m_sets; ///< by chain, then all
};

} // namespace Quadrille

#endif
