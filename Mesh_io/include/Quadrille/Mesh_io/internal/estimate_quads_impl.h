// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_ESTIMATE_QUADS_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_ESTIMATE_QUADS_IMPL_H

#include <Quadrille/estimate_quads.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Carries the sizes on curves to all vertices, each from the nearest point along edges.
class Size_spreader {
public:
  Size_spreader(const Planar_domain& domain, const Domain_sizes& sizes)
      : m_mesh(domain.mesh), m_area(m_mesh.number_of_vertices(), 0),
        m_distance(m_mesh.number_of_vertices(), std::numeric_limits<double>::infinity())
  {
    for (const auto e : m_mesh.edges())
      for (const std::size_t end : {0u, 1u}) {
        const auto h = m_mesh.halfedge(e);
        add_source(end == 0 ? m_mesh.source(h) : m_mesh.target(h), sizes.of_edge[e.idx()][end]);
      }
    spread();
  }

  /// Of an element at vertex `v`; 0 if there are no sizes.
  double element_area(Planar_domain::vertex_descriptor v) const { return m_area[v.idx()]; }

private:
  void add_source(Planar_domain::vertex_descriptor v, const Frame_size& size)
  {
    if (size.is_free())
      return;
    const double normal = size.normal > 0 ? size.normal : size.tangential;
    const double tangential = size.tangential > 0 ? size.tangential : size.normal;
    // Where curves with different sizes meet, the mean counts.
    const double area = normal * tangential;
    m_area[v.idx()] = m_area[v.idx()] > 0 ? std::sqrt(m_area[v.idx()] * area) : area;
    m_distance[v.idx()] = 0;
  }

  void spread()
  {
    using Entry = std::pair<double, Planar_domain::vertex_descriptor>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    for (const auto v : m_mesh.vertices())
      if (m_distance[v.idx()] == 0)
        queue.emplace(0, v);
    while (!queue.empty()) {
      const auto [distance, v] = queue.top();
      queue.pop();
      if (distance > m_distance[v.idx()])
        continue;
      for (const auto h : CGAL::halfedges_around_source(v, m_mesh)) {
        const auto w = m_mesh.target(h);
        const auto d = m_mesh.point(w) - m_mesh.point(v);
        const double longer = distance + std::hypot(d.x(), d.y());
        if (longer < m_distance[w.idx()]) {
          m_distance[w.idx()] = longer;
          m_area[w.idx()] = m_area[v.idx()];
          queue.emplace(longer, w);
        }
      }
    }
  }

  const Planar_domain::Mesh& m_mesh;
  std::vector<double> m_area;     ///< of elements, by vertex
  std::vector<double> m_distance; ///< from the nearest vertex with sizes
};

} // namespace internal

inline double estimate_number_of_quads(const Planar_domain& domain, const Domain_sizes& sizes)
{
  const internal::Size_spreader spreader(domain, sizes);
  double n = 0;
  for (const auto f : domain.mesh.faces()) {
    const auto h = domain.mesh.halfedge(f);
    const auto a = domain.mesh.source(h), b = domain.mesh.target(h), c = domain.mesh.target(domain.mesh.next(h));
    const double area = CGAL::area(domain.mesh.point(a), domain.mesh.point(b), domain.mesh.point(c));
    for (const auto v : {a, b, c})
      if (spreader.element_area(v) > 0)
        n += area / 3 / spreader.element_area(v);
  }
  return n;
}

} // namespace Quadrille

#endif
