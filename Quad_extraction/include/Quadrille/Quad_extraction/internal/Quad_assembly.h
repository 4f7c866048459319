// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUAD_ASSEMBLY_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUAD_ASSEMBLY_H

#include <Quadrille/Quad_extraction/internal/Curve_chains.h>
#include <Quadrille/Quad_extraction/internal/Indexed_quads.h>

#include <limits>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Makes the quads of a quantized layout: each remaining patch becomes a grid between the subdivisions of its arcs.
///
/// The grid nodes of arcs belong to the arcs' classes, so patches share them and the mesh is conforming by
/// construction. Positions: on curves exactly; elsewhere where the map puts them, blended to the ends and sides that
/// the collapse has moved.
class Quad_assembly {
public:
  using Point = Indexed_quads::Point;

  Quad_assembly(const Quad_layout& layout, const Collapsed_layout& collapsed, const Layout_geometry& geometry)
      : m_layout(layout), m_collapsed(collapsed), m_geometry(geometry), m_chains(layout, collapsed, geometry)
  {
  }

  Indexed_quads build()
  {
    m_quads.curves = m_chains.curves();
    add_cluster_vertices();
    add_arc_vertices();
    for (int p = 0; p < size_of(m_layout.patches); ++p)
      add_grid(p);
    return std::move(m_quads);
  }

private:
  int add_vertex(const Point& point, const Indexed_quads::Vertex& vertex)
  {
    m_quads.points.push_back(point);
    m_quads.vertices.push_back(vertex);
    return size_of(m_quads.points) - 1;
  }

  void add_cluster_vertices()
  {
    for (int c = 0; c < size_of(m_collapsed.clusters()); ++c) {
      const Collapsed_layout::Cluster& cluster = at(m_collapsed.clusters(), c);
      const Quad_layout::Node& node =
          at(m_layout.nodes, cluster.critical >= 0 ? cluster.critical : cluster.nodes.front());
      Indexed_quads::Vertex vertex;
      vertex.constrained = cluster.constrained;
      vertex.border = false;
      for (const int n : cluster.nodes)
        vertex.border = vertex.border || at(m_layout.nodes, n).border;
      vertex.quadrants = cluster.critical >= 0 ? node.quadrants : vertex.border ? 2 : 4;
      Point point = Point::Zero();
      if (cluster.critical >= 0) {
        point = m_geometry.point(node.point);
        vertex.input_vertex = cluster.constrained ? node.vertex : -1;
      } else if (cluster.constrained) {
        const Curve_chains::Place& place = m_chains.cluster_place(c);
        point = at(m_chains.curves(), place.chain).point(place.position);
        vertex.chain = place.chain;
        vertex.position = place.position;
      } else {
        for (const int n : cluster.nodes)
          point += m_geometry.point(at(m_layout.nodes, n).point) / double(cluster.nodes.size());
      }
      add_vertex(point, vertex); // vertex c
    }
  }

  /// The arc that gives a class its shape: one on a curve, or else the one whose ends moved least.
  int representative(const Collapsed_layout::Arc_class& arcs) const
  {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const int h : arcs.half_arcs) {
      const Quad_layout::Arc& arc = at(m_layout.arcs, h / 2);
      if (arc.curve >= 0)
        return h;
      const double moved = displacement(m_layout.source(h)).norm() + displacement(m_layout.target(h)).norm();
      if (moved < least) {
        least = moved;
        best = h;
      }
    }
    return best;
  }

  Point displacement(int node) const
  {
    return at(m_quads.points, m_collapsed.cluster(node)) - m_geometry.point(at(m_layout.nodes, node).point);
  }

  void add_arc_vertices()
  {
    for (const Collapsed_layout::Arc_class& arcs : m_collapsed.classes()) {
      const int h = representative(arcs);
      const Quad_layout::Arc& arc = at(m_layout.arcs, h / 2);
      const Point start = displacement(m_layout.source(h));
      const Point end = displacement(m_layout.target(h));
      std::vector<int> ids = {arcs.source};
      for (int i = 1; i < arcs.length; ++i) {
        const double fraction = double(i) / arcs.length;
        Indexed_quads::Vertex vertex;
        if (arc.curve >= 0) {
          const Curve_chains::Place place = m_chains.place(h / 2, (h % 2 ? 1 - fraction : fraction) * arc.length);
          vertex.chain = place.chain;
          vertex.position = place.position;
          vertex.border = arc.border;
          vertex.constrained = true;
          vertex.quadrants = arc.border ? 2 : 4;
          ids.push_back(add_vertex(at(m_chains.curves(), place.chain).point(place.position), vertex));
        } else {
          const Point p = m_geometry.point_on_arc(h, fraction * arc.length);
          ids.push_back(add_vertex(p + (1 - fraction) * start + fraction * end, vertex));
        }
      }
      ids.push_back(arcs.target);
      if (arc.curve >= 0)
        for (std::size_t i = 0; i + 1 < ids.size(); ++i)
          m_quads.curve_edges.push_back(h % 2 ? Indexed_quads::Curve_edge{ids[i + 1], ids[i], arc.curve, arc.border}
                                              : Indexed_quads::Curve_edge{ids[i], ids[i + 1], arc.curve, arc.border});
      m_arc_vertices.push_back(std::move(ids));
    }
  }

  int arc_vertex(int half_arc, int i) const
  {
    const std::vector<int>& ids = at(m_arc_vertices, m_collapsed.arc_class(half_arc));
    return at(ids, m_collapsed.is_forward(half_arc) ? i : size_of(ids) - 1 - i);
  }

  void add_grid(int patch_index)
  {
    const Quad_layout::Patch& patch = at(m_layout.patches, patch_index);
    const auto& sides = patch.half_arcs;
    const int m = m_collapsed.length(sides[0] / 2);
    const int n = m_collapsed.length(sides[1] / 2);
    if (m == 0 || n == 0)
      return;
    const auto index = [m](int i, int j) { return j * (m + 1) + i; };
    std::vector<int> ids(std::size_t((m + 1) * (n + 1)), -1);
    for (int i = 0; i <= m; ++i) {
      at(ids, index(i, 0)) = arc_vertex(sides[0], i);
      at(ids, index(i, n)) = arc_vertex(sides[2], m - i);
    }
    for (int j = 0; j <= n; ++j) {
      at(ids, index(m, j)) = arc_vertex(sides[1], j);
      at(ids, index(0, j)) = arc_vertex(sides[3], n - j);
    }
    const std::vector<Point> in_map = sample_grid(patch, m, n);
    const auto moved = [&](int i, int j) -> Point {
      return at(m_quads.points, at(ids, index(i, j))) - at(in_map, index(i, j));
    };
    for (int j = 1; j < n; ++j)
      for (int i = 1; i < m; ++i) {
        const double x = double(i) / m;
        const double y = double(j) / n;
        const Point blended = (1 - y) * moved(i, 0) + y * moved(i, n) + (1 - x) * moved(0, j) + x * moved(m, j) -
                              (1 - y) * ((1 - x) * moved(0, 0) + x * moved(m, 0)) -
                              y * ((1 - x) * moved(0, n) + x * moved(m, n));
        at(ids, index(i, j)) = add_vertex(at(in_map, index(i, j)) + blended, {});
      }
    const double unit_u = m / at(m_layout.arcs, sides[0] / 2).length;
    const double unit_v = n / at(m_layout.arcs, sides[1] / 2).length;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < m; ++i) {
        m_quads.quads.push_back(
            {at(ids, index(i, j)), at(ids, index(i + 1, j)), at(ids, index(i + 1, j + 1)), at(ids, index(i, j + 1))});
        m_quads.region.push_back(patch.region);
        m_quads.patch.push_back(patch_index);
        const Point& a = at(in_map, index(i, j));
        const Point& b = at(in_map, index(i + 1, j));
        const Point& c = at(in_map, index(i + 1, j + 1));
        const Point& d = at(in_map, index(i, j + 1));
        // One unit of the map is the wanted size.
        m_quads.target.push_back(
            {unit_u * ((b - a).norm() + (c - d).norm()) / 2, unit_v * ((d - a).norm() + (c - b).norm()) / 2});
      }
  }

  /// The grid of the original patch, in the domain.
  std::vector<Point> sample_grid(const Quad_layout::Patch& patch, int m, int n) const
  {
    const auto& sides = patch.half_arcs;
    const double width = at(m_layout.arcs, sides[0] / 2).length;
    const double height = at(m_layout.arcs, sides[1] / 2).length;
    std::vector<Point> grid(std::size_t((m + 1) * (n + 1)));
    const auto index = [m](int i, int j) { return j * (m + 1) + i; };
    for (int i = 0; i <= m; ++i) {
      at(grid, index(i, 0)) = m_geometry.point_on_arc(sides[0], width * i / m);
      at(grid, index(i, n)) = m_geometry.point_on_arc(sides[2], width * (m - i) / m);
    }
    std::vector<double> heights;
    for (int j = 1; j < n; ++j) {
      heights.push_back(height * j / n);
      at(grid, index(m, j)) = m_geometry.point_on_arc(sides[1], heights.back());
      at(grid, index(0, j)) = m_geometry.point_on_arc(sides[3], height - heights.back());
    }
    std::vector<Point> column;
    for (int i = 1; i < m && n > 1; ++i) {
      m_geometry.sample(sides[0], width * i / m, heights, column);
      for (int j = 1; j < n; ++j)
        at(grid, index(i, j)) = at(column, j - 1);
    }
    return grid;
  }

  const Quad_layout& m_layout;
  const Collapsed_layout& m_collapsed;
  const Layout_geometry& m_geometry;
  Curve_chains m_chains;
  Indexed_quads m_quads;
  std::vector<std::vector<int>> m_arc_vertices; ///< by class
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
