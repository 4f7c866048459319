// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_CURVE_PROJECTOR_H
#define QUADRILLE_CURVE_PROJECTOR_H

#include <Quadrille/Curve_locator.h>
#include <Quadrille/Planar_domain.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Quadrille {

/// Takes points from the polylines of a planar domain to its true curves: model of `CurveProjector`.
///
/// Between two vertices, a curve is represented by the cubic with its points and tangents there, which is off by the
/// sixth power of the angle that it turns by (24 edges per circle: 1e-6 of the radius). Points of meshes that were
/// taken as they are stay where they are. Complexity of a call: that of `Curve_locator::nearest()`.
class Curve_projector {
public:
  explicit Curve_projector(const Planar_domain& domain) : m_domain(&domain), m_locator(domain) {}

  /// \param chain one of the domain's chains (see `Planar_domain::edge_chain`)
  /// \param point on or near the polyline of that chain
  template <class Point> Point operator()(int chain, const Point& point) const
  {
    if (m_domain->edge_tangents.empty())
      return point;
    const auto place = m_locator.nearest(Planar_domain::Point_2(point.x(), point.y()), chain);
    const std::array<double, 4>& tangents = m_domain->edge_tangents[std::size_t(place.edge.idx())];
    const auto h = m_domain->mesh.halfedge(place.edge);
    const auto& p = m_domain->mesh.point(m_domain->mesh.source(h));
    const auto& q = m_domain->mesh.point(m_domain->mesh.target(h));
    const double chord = std::hypot(q.x() - p.x(), q.y() - p.y());
    const double cosine = tangents[0] * tangents[2] + tangents[1] * tangents[3];
    if (!(cosine > 0)) // unknown, or a kink between the two ends
      return point;
    // The length of the end tangents that makes a circular arc's cubic touch the arc in its middle.
    const double angle = std::acos(std::min(1.0, cosine));
    const double length = chord / std::pow(std::cos(0.25 * angle), 2);
    const double t = place.parameter, s = 1 - t;
    const double h0 = s * s * (1 + 2 * t), h1 = t * t * (1 + 2 * s), d0 = length * s * s * t, d1 = -length * s * t * t;
    return Point(h0 * p.x() + h1 * q.x() + d0 * tangents[0] + d1 * tangents[2],
                 h0 * p.y() + h1 * q.y() + d0 * tangents[1] + d1 * tangents[3]);
  }

private:
  const Planar_domain* m_domain;
  Curve_locator<Planar_domain::Point_2> m_locator;
};

} // namespace Quadrille

#endif
