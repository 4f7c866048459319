// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_CURVE_LOCATOR_H
#define QUADRILLE_CURVE_LOCATOR_H

#include <Quadrille/Planar_domain.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace Quadrille {
/// Finds the nearest point on the curves of a planar domain, by looking at all edges.
///
/// \pre the domain outlives the locator and does not change.
class Curve_locator {
public:
  /// A point on an edge of the domain's mesh.
  struct Place {
    Planar_domain::edge_descriptor edge;
    double parameter = 0; ///< from 0 at the source to 1 at the target of `halfedge(edge)`
    double distance = std::numeric_limits<double>::infinity();
  };

  explicit Curve_locator(const Planar_domain& domain)
      : m_domain(&domain), m_edges(std::size_t(domain.number_of_chains) + 1)
  {
    for (const auto e : domain.mesh.edges())
      if (domain.edge_chain[std::size_t(e.idx())] >= 0) {
        m_edges[std::size_t(domain.edge_chain[std::size_t(e.idx())])].push_back(e);
        m_edges.back().push_back(e);
      }
  }

  /// The nearest point on a chain of the domain, or, without one, on all its curves. Linear in the number of edges.
  Place nearest(double x, double y, int chain = -1) const
  {
    Place best;
    for (const auto e : m_edges[chain < 0 ? m_edges.size() - 1 : std::size_t(chain)]) {
      const auto h = m_domain->mesh.halfedge(e);
      const auto& p = m_domain->mesh.point(m_domain->mesh.source(h));
      const auto& q = m_domain->mesh.point(m_domain->mesh.target(h));
      const double dx = q.x() - p.x(), dy = q.y() - p.y();
      const double t = std::clamp(((x - p.x()) * dx + (y - p.y()) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
      const double d = std::hypot(x - p.x() - t * dx, y - p.y() - t * dy);
      if (d < best.distance)
        best = {e, t, d};
    }
    return best;
  }

private:
  const Planar_domain* m_domain;
  std::vector<std::vector<Planar_domain::edge_descriptor>> m_edges; ///< by chain, then all
};

} // namespace Quadrille

#endif
