// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_CURVE_CHAINS_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_CURVE_CHAINS_H

#include <Quadrille/Quad_extraction/internal/Collapsed_layout.h>
#include <Quadrille/Quad_extraction/internal/Layout_geometry.h>
#include <Quadrille/Quad_extraction/internal/Polyline_curve.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// The domain's curves between critical nodes as polylines, and where the vertices and arcs of the collapsed layout lie
/// on them, measured by arc length.
template <int D> class Curve_chains {
public:
  using Point = Eigen::Matrix<double, D, 1>;

  struct Place {
    int chain = -1;
    double position = 0;
  };

  Curve_chains(const Quad_layout& layout, const Collapsed_layout& collapsed, const Layout_geometry<D>& geometry)
      : m_layout(&layout), m_collapsed(&collapsed), m_place_of_arc(layout.arcs.size()), m_fractions(layout.arcs.size()),
        m_place_of_vertex(std::size_t(collapsed.number_of_vertices()))
  {
    for (const Quad_layout::Curve_chain& chain : layout.chains)
      add_chain(chain, geometry);
  }

  const std::vector<Polyline_curve<D>>& curves() const { return m_curves; }

  /// Where a vertex that a node without a critical one beside it became slides; chain -1 for other vertices.
  const Place& vertex_place(int vertex) const { return at(m_place_of_vertex, vertex); }

  /// Place of the point at map length `x` of arc `a` (which lies on a curve and has positive quantized length), after
  /// the arc was stretched between the places of its ends.
  Place place(int a, double x) const
  {
    const Place& start = at(m_place_of_arc, a);
    const Quad_layout::Arc& arc = at(m_layout->arcs, a);
    const double fraction = at(m_fractions, a).at(x, arc);
    const double from = end_position(arc.source, false, a);
    const double to = end_position(arc.target, true, a);
    return {start.chain, from + fraction * (to - from)};
  }

private:
  /// Arc length fractions at the points of an arc.
  struct Fractions {
    std::vector<double> values;

    double at(double x, const Quad_layout::Arc& arc) const
    {
      std::size_t i = 1;
      while (i + 1 < values.size() && arc.points[i].position < x)
        ++i;
      const double before = arc.points[i - 1].position;
      const double after = arc.points[i].position;
      const double t = after > before ? (x - before) / (after - before) : 0;
      return (1 - t) * values[i - 1] + t * values[i];
    }
  };

  /// Where the source or target of arc `a` lies on the arc's chain.
  double end_position(int node, bool is_target, int a) const
  {
    const int chain = at(m_place_of_arc, a).chain;
    const int vertex = m_collapsed->vertex(node);
    if (m_collapsed->critical_node(vertex) >= 0)
      return is_target ? at(m_curves, chain).length() : 0; // only zero arcs lie between it and the chain's end
    // The last arc of a loop ends where the first one starts, one turn later.
    const bool one_turn_later = is_target && at(m_curves, chain).is_closed() && at(m_last_arc, chain) == a;
    return at(m_place_of_vertex, vertex).position + (one_turn_later ? at(m_curves, chain).length() : 0);
  }

  void add_chain(const Quad_layout::Curve_chain& chain, const Layout_geometry<D>& geometry)
  {
    const int index = size_of(m_curves);
    std::vector<int> arcs;
    for (const int h : chain.half_arcs)
      arcs.push_back(h / 2);
    if (chain.loop) {
      // Start behind an arc that is not contracted, so that no vertex straddles the start.
      const auto positive =
          std::find_if(arcs.begin(), arcs.end(), [this](int a) { return m_collapsed->length(a) > 0; });
      std::rotate(arcs.begin(), positive + 1, arcs.end());
    }
    std::vector<Point> points;                 // vertices of the triangulation only
    std::vector<std::pair<int, double>> nodes; // with their positions
    double position = 0;
    double first_vertex = 0; // position of the first point; loops may start within an edge
    Point last = Point::Zero();
    for (const int a : arcs) {
      const Quad_layout::Arc& arc = at(m_layout->arcs, a);
      at(m_place_of_arc, a) = {index, position};
      nodes.emplace_back(arc.source, position);
      std::vector<double>& fractions = at(m_fractions, a).values;
      for (std::size_t i = 0; i < arc.points.size(); ++i) {
        const Point p = geometry.point(arc.points[i].point);
        if (a != arcs.front() || i > 0)
          position += (p - last).norm();
        last = p;
        fractions.push_back(position - at(m_place_of_arc, a).position);
        const bool at_node = i == 0 || i + 1 == arc.points.size();
        if (at_node && at(m_layout->nodes, i == 0 ? arc.source : arc.target).vertex < 0)
          continue;
        if (points.empty())
          first_vertex = position;
        if (points.empty() || p != points.back())
          points.push_back(p);
      }
      for (double& fraction : fractions)
        fraction /= position - at(m_place_of_arc, a).position;
    }
    if (!chain.loop)
      nodes.emplace_back(at(m_layout->arcs, arcs.back()).target, position);
    else if (points.front() != points.back())
      points.push_back(points.front());
    for (auto& node : nodes)
      node.second -= first_vertex;
    m_last_arc.push_back(arcs.back());
    place_vertices(index, nodes);
    m_curves.emplace_back(std::move(points), chain.loop, at(m_layout->arcs, arcs.front()).curve);
  }

  void place_vertices(int chain, const std::vector<std::pair<int, double>>& nodes)
  {
    for (std::size_t i = 0; i < nodes.size();) {
      const int vertex = m_collapsed->vertex(nodes[i].first);
      double sum = 0;
      std::size_t end = i;
      for (; end < nodes.size() && m_collapsed->vertex(nodes[end].first) == vertex; ++end)
        sum += nodes[end].second;
      if (m_collapsed->critical_node(vertex) < 0)
        at(m_place_of_vertex, vertex) = {chain, sum / double(end - i)};
      i = end;
    }
  }

  const Quad_layout* m_layout;
  const Collapsed_layout* m_collapsed;
  std::vector<Polyline_curve<D>> m_curves;
  std::vector<Place> m_place_of_arc;
  std::vector<Fractions> m_fractions;
  std::vector<Place> m_place_of_vertex;
  std::vector<int> m_last_arc; ///< by chain
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
