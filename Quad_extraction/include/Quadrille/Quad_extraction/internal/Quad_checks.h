// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUAD_CHECKS_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUAD_CHECKS_H

#include <Quadrille/Quad_extraction/internal/Indexed_quads.h>
#include <Quadrille/Quad_extraction/internal/Quad_ground.h>
#include <Quadrille/Support/internal/segment_intersections.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// What every extracted mesh must satisfy, checked in release builds too. \throws No_result_error("mesh", ...).
template <int D> class Quad_checks {
public:
  using Point = Eigen::Matrix<double, D, 1>;

  explicit Quad_checks(const Indexed_quads<D>& quads) : m_quads(quads) {}

  void check_topology() const
  {
    const std::size_t n = m_quads.points.size();
    std::unordered_map<std::uint64_t, int> quad_of_edge;
    const auto key = [n](int a, int b) { return std::uint64_t(a) * n + std::uint64_t(b); };
    std::vector<int> valence(n, 0);
    for (int q = 0; q < size_of(m_quads.quads); ++q) {
      const auto& quad = at(m_quads.quads, q);
      for (std::size_t i = 0; i < 4; ++i) {
        ++at(valence, quad[i]);
        if (quad[i] == quad[(i + 1) % 4] || quad[i] == quad[(i + 2) % 4])
          fail(q, "uses a vertex twice");
        if (!quad_of_edge.emplace(key(quad[i], quad[(i + 1) % 4]), q).second)
          fail(q, "shares an edge with two other quads");
      }
    }
    std::size_t border_edges = 0;
    std::vector<char> has_border_edge(n, 0);
    for (int q = 0; q < size_of(m_quads.quads); ++q)
      for (std::size_t i = 0; i < 4; ++i) {
        const int a = at(m_quads.quads, q)[i];
        const int b = at(m_quads.quads, q)[(i + 1) % 4];
        if (quad_of_edge.count(key(b, a)))
          continue;
        ++border_edges;
        if (at(has_border_edge, a))
          fail(q, "touches another part of the border in a vertex");
        at(has_border_edge, a) = 1;
      }
    for (const typename Indexed_quads<D>::Curve_edge& edge : m_quads.curve_edges) {
      const bool left = quad_of_edge.count(key(edge.source, edge.target)) > 0;
      const bool right = quad_of_edge.count(key(edge.target, edge.source)) > 0;
      if (!left || right == edge.border)
        throw No_result_error("mesh", "an edge on curve " + std::to_string(edge.curve) + " is lost");
      border_edges -= edge.border ? 1 : 0;
    }
    if (border_edges != 0)
      throw No_result_error("mesh", "the mesh has border edges that do not lie on the domain's border");
    for (int v = 0; v < size_of(m_quads.vertices); ++v)
      if (at(valence, v) != at(m_quads.vertices, v).quadrants)
        throw No_result_error("mesh", "vertex " + std::to_string(v) + " has " + std::to_string(at(valence, v)) +
                                          " quads where the map has " +
                                          std::to_string(at(m_quads.vertices, v).quadrants) + " right angles");
  }

  /// No inverted quads (`is_inverted` by quad), and in the plane a border that does not meet itself: then the quads do
  /// not overlap.
  void check_geometry(const std::vector<char>& is_inverted) const
  {
    for (int q = 0; q < size_of(m_quads.quads); ++q)
      if (at(is_inverted, q))
        fail(q, "has a corner that is not strictly convex; smaller elements there may help");
    const std::vector<int> edges = conflicting_border_edges();
    if (edges.empty())
      return;
    const typename Indexed_quads<D>::Curve_edge& edge = at(m_quads.curve_edges, edges.front());
    throw No_result_error("mesh", "the element's straight side on curve " + std::to_string(edge.curve) + " near " +
                                      text((at(m_quads.points, edge.source) + at(m_quads.points, edge.target)) / 2) +
                                      " meets another part of the border: the elements are too large for a gap there; "
                                      "ask for smaller ones");
  }

  /// Edges of `curve_edges` on the border that meet another one elsewhere than in a common end, in order. Exact. Of
  /// surfaces in space: none.
  std::vector<int> conflicting_border_edges() const
  {
    if constexpr (D == 3)
      return {};
    std::vector<Segment_kernel::Point_2> points;
    for (const Point& p : m_quads.points)
      points.emplace_back(p.x(), p.y());
    std::vector<Numbered_segment> segments;
    std::vector<int> index;
    for (int e = 0; e < size_of(m_quads.curve_edges); ++e)
      if (at(m_quads.curve_edges, e).border) {
        segments.push_back({{at(m_quads.curve_edges, e).source, at(m_quads.curve_edges, e).target}});
        index.push_back(e);
      }
    std::set<int> found;
    visit_close_segments(points, segments, [&](std::size_t i, std::size_t j) {
      if (segments_conflict(points, segments[i], segments[j]))
        found.insert({index[i], index[j]});
    });
    return {found.begin(), found.end()};
  }

  /// Valence -> number of interior vertices other than 4.
  std::map<int, int> irregular_vertices() const
  {
    std::map<int, int> count;
    for (const typename Indexed_quads<D>::Vertex& vertex : m_quads.vertices)
      if (!vertex.border && vertex.quadrants != 4)
        ++count[vertex.quadrants];
    return count;
  }

private:
  [[noreturn]] void fail(int q, const std::string& what) const
  {
    Point center = Point::Zero();
    for (const int v : at(m_quads.quads, q))
      center += 0.25 * at(m_quads.points, v);
    throw No_result_error("mesh", "quad " + std::to_string(q) + " near " + text(center) + " " + what);
  }

  static std::string text(const Point& p)
  {
    std::ostringstream result;
    result << '(' << p[0];
    for (int i = 1; i < D; ++i)
      result << ", " << p[i];
    result << ')';
    return result.str();
  }

  const Indexed_quads<D>& m_quads;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
