// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_ROUND_CURVE_SIZES_H
#define QUADRILLE_MESH_IO_INTERNAL_ROUND_CURVE_SIZES_H

#include <Quadrille/Mesh_io/internal/vector_length.h>
#include <Quadrille/Triangulated_domain.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Finds the sizes that holes and other round outlines need, so that one sees what they are.
///
/// Where smooth feature curves turn by half a circle, sizes are at most a sixth of the length that they need for that.
/// From there, sizes grow with the distance as they do in a polar grid around a circle of twelve elements. Curves that
/// turn less (fillets, rounded corners) do not count: that they look angular costs less than the irregular vertices
/// around them. Turns are added as vectors, so that the zigzag of creases in a scan cancels out.
template <class Point> class Round_curve_sizes {
public:
  static constexpr double edges_per_half_circle = 6;
  static constexpr double growth = 0.5;          ///< per unit of distance
  static constexpr double least_ratio = 1.0 / 8; ///< of the largest size
  static constexpr double corner_degrees = 40;   ///< curves that turn more at once are not smooth

  using Domain = Triangulated_domain<Point>;
  using Vertex = typename Domain::vertex_descriptor;
  using Halfedge = typename Domain::halfedge_descriptor;

  Round_curve_sizes(const Domain& domain, double largest)
      : m_domain(domain), m_largest(largest), m_size(domain.mesh.number_of_vertices(), largest)
  {
  }

  /// Per vertex. Complexity: O(n log n + n w), w the edges of half a circle that is limited.
  std::vector<double> run()
  {
    continue_curves();
    std::vector<char> done(m_domain.mesh.number_of_edges(), 0);
    for (const bool ends_only : {true, false})
      for (const auto& curve : m_domain.curves)
        for (const Halfedge path_edge : curve.path)
          for (const Halfedge h : {path_edge, m_domain.mesh.opposite(path_edge)}) {
            const bool is_first = !m_next[std::size_t(m_domain.mesh.opposite(h).idx())].is_valid();
            if (!done[std::size_t(m_domain.mesh.edge(h).idx())] && (is_first || !ends_only))
              look_at_sequence(h, done);
          }
    grow();
    return std::move(m_size);
  }

private:
  Eigen::Vector3d direction(Halfedge h) const
  {
    const auto d = m_domain.mesh.point(m_domain.mesh.target(h)) - m_domain.mesh.point(m_domain.mesh.source(h));
    Eigen::Vector3d result = Eigen::Vector3d::Zero();
    for (int k = 0; k < int(Domain::dimension); ++k)
      result[k] = CGAL::to_double(d[k]);
    return result.stableNormalized();
  }

  double length(Halfedge h) const
  {
    return length_of(m_domain.mesh.point(m_domain.mesh.target(h)) - m_domain.mesh.point(m_domain.mesh.source(h)));
  }

  /// Axis times angle.
  Eigen::Vector3d turn(Halfedge from, Halfedge to) const
  {
    const Eigen::Vector3d a = direction(from), b = direction(to), axis = a.cross(b);
    return axis.stableNormalized() * std::atan2(axis.norm(), a.dot(b));
  }

  /// Decides how curves go on through the points where they meet: along the two edges that deviate least, if these
  /// choose each other.
  void continue_curves()
  {
    m_next.assign(m_domain.mesh.number_of_halfedges(), Halfedge());
    std::vector<std::vector<Halfedge>> leaving(m_domain.mesh.number_of_vertices());
    for (const auto& curve : m_domain.curves)
      for (const Halfedge h : curve.path) {
        leaving[std::size_t(m_domain.mesh.source(h).idx())].push_back(h);
        leaving[std::size_t(m_domain.mesh.target(h).idx())].push_back(m_domain.mesh.opposite(h));
      }
    const double largest_turn = corner_degrees * CGAL_PI / 180;
    for (const std::vector<Halfedge>& star : leaving) {
      std::vector<std::size_t> best(star.size(), star.size());
      for (std::size_t i = 0; i < star.size(); ++i) {
        double least = largest_turn;
        for (std::size_t j = 0; j < star.size(); ++j) {
          const double angle = j == i ? least : turn(m_domain.mesh.opposite(star[i]), star[j]).norm();
          if (angle < least) {
            least = angle;
            best[i] = j;
          }
        }
      }
      for (std::size_t i = 0; i < star.size(); ++i)
        if (best[i] < star.size() && best[best[i]] == i)
          m_next[std::size_t(m_domain.mesh.opposite(star[i]).idx())] = star[best[i]];
    }
  }

  /// Limits sizes along the sequence of edges that begins with `first`; where that is a loop, it is passed twice.
  void look_at_sequence(Halfedge first, std::vector<char>& done)
  {
    std::vector<Halfedge> edges;
    Halfedge h = first;
    do {
      edges.push_back(h);
      done[std::size_t(m_domain.mesh.edge(h).idx())] = 1;
      h = m_next[std::size_t(h.idx())];
    } while (h.is_valid() && h != first);
    if (h == first)
      for (std::size_t i = 0, n = edges.size(); i < n; ++i)
        edges.push_back(edges[i]);
    std::vector<Eigen::Vector3d> turned{Eigen::Vector3d::Zero()}; // up to the middle of each edge
    std::vector<double> reached{0};
    std::size_t begin = 0;
    for (std::size_t i = 1; i < edges.size(); ++i) {
      turned.push_back(turned.back() + turn(edges[i - 1], edges[i]));
      reached.push_back(reached.back() + 0.5 * (length(edges[i - 1]) + length(edges[i])));
      for (double angle; (angle = (turned[i] - turned[begin]).norm()) >= nearly_half_circle; ++begin) {
        const double limit = (reached[i] - reached[begin]) * CGAL_PI / angle / edges_per_half_circle;
        for (std::size_t k = begin; limit < m_largest && k < i; ++k) {
          double& size = m_size[std::size_t(m_domain.mesh.target(edges[k]).idx())];
          size = std::min(size, std::max(limit, m_largest * least_ratio));
        }
      }
    }
  }

  void grow()
  {
    using Entry = std::pair<double, Vertex>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    for (const Vertex v : m_domain.mesh.vertices())
      if (m_size[std::size_t(v.idx())] < m_largest)
        queue.emplace(m_size[std::size_t(v.idx())], v);
    while (!queue.empty()) {
      const auto [size, v] = queue.top();
      queue.pop();
      if (size > m_size[std::size_t(v.idx())])
        continue;
      for (const Halfedge h : m_domain.mesh.halfedges_around_target(m_domain.mesh.halfedge(v))) {
        const Vertex w = m_domain.mesh.source(h);
        const double grown = size + growth * length(h);
        if (grown < m_size[std::size_t(w.idx())]) {
          m_size[std::size_t(w.idx())] = grown;
          queue.emplace(grown, w);
        }
      }
    }
  }

  /// Polygons turn at their corners only, so that half a circle need not be met exactly.
  static constexpr double nearly_half_circle = 0.95 * CGAL_PI;

  const Domain& m_domain;
  double m_largest;
  std::vector<double> m_size;
  std::vector<Halfedge> m_next; ///< per halfedge of a curve: how the curve goes on, invalid at its end
};

} // namespace internal
} // namespace Quadrille

#endif
