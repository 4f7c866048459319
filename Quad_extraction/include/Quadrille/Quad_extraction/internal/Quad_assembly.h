// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUAD_ASSEMBLY_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUAD_ASSEMBLY_H

#include <Quadrille/Quad_extraction/internal/Curve_chains.h>
#include <Quadrille/Quad_extraction/internal/Indexed_quads.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Makes the quads of a quantized layout: each remaining patch becomes a grid between the points of its sides.
///
/// The points of arcs are shared by the patches, so the mesh is conforming by construction. Positions: on curves
/// exactly; elsewhere where the map puts them, blended to the points that the collapse has moved.
template <int D> class Quad_assembly {
public:
  using Point = Eigen::Matrix<double, D, 1>;
  using Place = typename Layout_geometry<D>::Place;

  Quad_assembly(const Quad_layout& layout, const Collapsed_layout& collapsed, const Layout_geometry<D>& geometry)
      : m_layout(layout), m_collapsed(collapsed), m_geometry(geometry), m_chains(layout, collapsed, geometry)
  {
  }

  Indexed_quads<D> build()
  {
    m_quads.curves = m_chains.curves();
    add_vertices();
    add_curve_edges();
    for (int p = 0; p < size_of(m_layout.patches); ++p)
      add_grid(p);
    return std::move(m_quads);
  }

private:
  struct Mean {
    Point sum = Point::Zero();
    int number = 0;

    void add(const Point& p)
    {
      sum += p;
      ++number;
    }
    Point value() const { return sum / number; }
  };

  /// The vertices of the collapsed layout, with the same numbers: those on curves, those that hold nodes, then those
  /// between nodes.
  void add_vertices()
  {
    const std::size_t n = std::size_t(m_collapsed.number_of_vertices());
    m_quads.points.assign(n, Point::Zero());
    m_quads.vertices.resize(n);
    std::vector<char> is_placed(n, 0);
    for (int a = 0; a < size_of(m_layout.arcs); ++a)
      for (int i = 1; i < m_collapsed.length(a) && at(m_layout.arcs, a).curve >= 0; ++i) {
        const int v = m_collapsed.vertex(m_collapsed.point(2 * a, i));
        const double x = at(m_layout.arcs, a).length * i / m_collapsed.length(a);
        put_on_curve(v, m_chains.place(a, x), at(m_layout.arcs, a).border);
        at(is_placed, v) = 1;
      }
    std::vector<Mean> nodes(n);
    for (int i = 0; i < size_of(m_layout.nodes); ++i)
      if (!at(is_placed, m_collapsed.vertex(i)))
        add_node(i, nodes);
    for (int v = 0; v < size_of(nodes); ++v)
      if (at(nodes, v).number > 0) {
        at(is_placed, v) = 1;
        if (!at(m_quads.vertices, v).constrained && m_collapsed.critical_node(v) < 0)
          at(m_quads.points, v) = at(nodes, v).value();
      }
    std::vector<Mean> between(n);
    for (int a = 0; a < size_of(m_layout.arcs); ++a) {
      const Point start = displacement(at(m_layout.arcs, a).source);
      const Point end = displacement(at(m_layout.arcs, a).target);
      for (int i = 1; i < m_collapsed.length(a); ++i) {
        const int v = m_collapsed.vertex(m_collapsed.point(2 * a, i));
        if (at(is_placed, v))
          continue;
        const double fraction = double(i) / m_collapsed.length(a);
        const Place place = m_geometry.place_on_arc(2 * a, fraction * at(m_layout.arcs, a).length);
        at(m_quads.vertices, v).face = place.face;
        at(between, v).add(place.point + (1 - fraction) * start + fraction * end);
      }
    }
    for (int v = 0; v < size_of(between); ++v)
      if (at(between, v).number > 0)
        at(m_quads.points, v) = at(between, v).value();
  }

  void put_on_curve(int v, const typename Curve_chains<D>::Place& place, bool border)
  {
    typename Indexed_quads<D>::Vertex& vertex = at(m_quads.vertices, v);
    vertex.constrained = true;
    vertex.border = border;
    vertex.quadrants = border ? 2 : 4;
    vertex.chain = place.chain;
    vertex.position = place.position;
    at(m_quads.points, v) = at(m_chains.curves(), place.chain).point(place.position);
  }

  void add_node(int i, std::vector<Mean>& nodes)
  {
    const Quad_layout::Node& node = at(m_layout.nodes, i);
    const int v = m_collapsed.vertex(i);
    at(nodes, v).add(m_geometry.point(node.point));
    at(m_quads.vertices, v).face = node.point.face;
    typename Indexed_quads<D>::Vertex& vertex = at(m_quads.vertices, v);
    vertex.border = vertex.border || node.border;
    if (node.critical) {
      vertex.constrained = node.constrained;
      vertex.quadrants = node.quadrants;
      vertex.input_vertex = node.constrained ? node.vertex : -1;
      at(m_quads.points, v) = m_geometry.point(node.point);
    } else if (node.constrained && m_collapsed.critical_node(v) < 0) {
      put_on_curve(v, m_chains.vertex_place(v), vertex.border);
    }
  }

  Point displacement(int node) const
  {
    return at(m_quads.points, m_collapsed.vertex(node)) - m_geometry.point(at(m_layout.nodes, node).point);
  }

  void add_curve_edges()
  {
    for (int a = 0; a < size_of(m_layout.arcs); ++a) {
      const Quad_layout::Arc& arc = at(m_layout.arcs, a);
      for (int i = 0; i < m_collapsed.length(a) && arc.curve >= 0; ++i)
        m_quads.curve_edges.push_back({m_collapsed.vertex(m_collapsed.point(2 * a, i)),
                                       m_collapsed.vertex(m_collapsed.point(2 * a, i + 1)), arc.curve, arc.border});
    }
  }

  /// Map positions of the points along a side, measured from its first corner.
  std::vector<double> side_positions(int patch, int side) const
  {
    std::vector<double> positions = {0};
    double begin = 0;
    for (const int h : at(at(m_layout.patches, patch).sides, side)) {
      const double length = m_layout.arc_of(h).length;
      const int n = m_collapsed.length(h / 2);
      for (int i = 1; i <= n; ++i)
        positions.push_back(begin + length * i / n);
      begin += length;
    }
    positions.back() = begin; // arcs of length 0 at the end
    return positions;
  }

  /// A grid of m x n quads in a patch: ids of its vertices by (i, j), and positions in the original patch.
  struct Grid {
    int m = 0;
    int n = 0;
    std::vector<double> x; ///< map coordinates of the columns
    std::vector<double> y; ///< and of the rows
    std::vector<int> id;
    std::vector<Point> in_map;
    std::vector<int> face; ///< of the inner points

    int index(int i, int j) const { return j * (m + 1) + i; }
  };

  void add_grid(int p)
  {
    Grid grid;
    grid.m = m_collapsed.side_length(p, 0);
    grid.n = m_collapsed.side_length(p, 1);
    if (grid.m == 0 || grid.n == 0)
      return;
    grid.id.assign(std::size_t((grid.m + 1) * (grid.n + 1)), -1);
    set_sides(p, grid);
    sample(p, grid);
    add_inner_vertices(grid);
    add_centers(p, grid);
    for (int j = 0; j < grid.n; ++j)
      for (int i = 0; i < grid.m; ++i) {
        const std::array<int, 4> corner = {grid.index(i, j), grid.index(i + 1, j), grid.index(i + 1, j + 1),
                                           grid.index(i, j + 1)};
        const auto id = [&](std::size_t k) { return at(grid.id, corner[k]); };
        const auto side = [&](std::size_t k, std::size_t l) {
          return (at(grid.in_map, corner[k]) - at(grid.in_map, corner[l])).norm();
        };
        m_quads.quads.push_back({id(0), id(1), id(2), id(3)});
        m_quads.region.push_back(at(m_layout.patches, p).region);
        m_quads.patch.push_back(p);
        // One unit of the map is the wanted size.
        m_quads.target.push_back({(side(0, 1) + side(2, 3)) / 2 / (at(grid.x, i + 1) - at(grid.x, i)),
                                  (side(0, 3) + side(1, 2)) / 2 / (at(grid.y, j + 1) - at(grid.y, j))});
      }
  }

  void set_sides(int p, Grid& grid) const
  {
    const std::array<std::vector<int>, 4> points = {m_collapsed.side_points(p, 0), m_collapsed.side_points(p, 1),
                                                    m_collapsed.side_points(p, 2), m_collapsed.side_points(p, 3)};
    for (int i = 0; i <= grid.m; ++i) {
      at(grid.id, grid.index(i, 0)) = m_collapsed.vertex(at(points[0], i));
      at(grid.id, grid.index(i, grid.n)) = m_collapsed.vertex(at(points[2], grid.m - i));
    }
    for (int j = 0; j <= grid.n; ++j) {
      at(grid.id, grid.index(grid.m, j)) = m_collapsed.vertex(at(points[1], j));
      at(grid.id, grid.index(0, j)) = m_collapsed.vertex(at(points[3], grid.n - j));
    }
    // Where opposite sides are divided differently, columns and rows go to the middle.
    const auto middle = [&](int side, std::vector<double>& coordinates) {
      coordinates = side_positions(p, side);
      const std::vector<double> opposite = side_positions(p, side + 2);
      const int last = size_of(coordinates) - 1;
      for (int i = 1; i < last; ++i)
        at(coordinates, i) = (at(coordinates, i) + opposite.back() - at(opposite, last - i)) / 2;
    };
    middle(0, grid.x);
    middle(1, grid.y);
  }

  /// The point of the patch's side at map position `x` from its first corner.
  Point point_on_side(int p, int side, double x) const
  {
    const std::vector<int>& half_arcs = at(at(m_layout.patches, p).sides, side);
    const auto [h, rest] = find_on_side(half_arcs, x);
    return m_geometry.point_on_arc(h, rest);
  }

  std::pair<int, double> find_on_side(const std::vector<int>& half_arcs, double x) const
  {
    std::size_t k = 0;
    for (; k + 1 < half_arcs.size() && x > m_layout.arc_of(half_arcs[k]).length; ++k)
      x -= m_layout.arc_of(half_arcs[k]).length;
    return {half_arcs[k], std::min(x, m_layout.arc_of(half_arcs[k]).length)};
  }

  /// The grid's points at their columns and rows in the original patch, in the domain.
  void sample(int p, Grid& grid) const
  {
    grid.in_map.resize(grid.id.size());
    grid.face.resize(grid.id.size(), -1);
    for (int i = 0; i <= grid.m; ++i) {
      at(grid.in_map, grid.index(i, 0)) = point_on_side(p, 0, at(grid.x, i));
      at(grid.in_map, grid.index(i, grid.n)) = point_on_side(p, 2, grid.x.back() - at(grid.x, i));
    }
    for (int j = 1; j < grid.n; ++j) {
      at(grid.in_map, grid.index(grid.m, j)) = point_on_side(p, 1, at(grid.y, j));
      at(grid.in_map, grid.index(0, j)) = point_on_side(p, 3, grid.y.back() - at(grid.y, j));
    }
    const std::vector<double> heights(grid.y.begin() + 1, grid.y.end() - 1);
    std::vector<Place> column;
    for (int i = 1; i < grid.m && grid.n > 1; ++i) {
      const auto [h, x] = find_on_side(at(m_layout.patches, p).sides[0], at(grid.x, i));
      m_geometry.sample(h, x, heights, column);
      for (int j = 1; j < grid.n; ++j) {
        at(grid.in_map, grid.index(i, j)) = at(column, j - 1).point;
        at(grid.face, grid.index(i, j)) = at(column, j - 1).face;
      }
    }
  }

  /// The triangles at the quads' centres.
  void add_centers(int p, const Grid& grid)
  {
    const std::size_t first = m_quads.face.size();
    m_quads.face.resize(first + std::size_t(grid.m * grid.n));
    std::vector<double> heights;
    for (int j = 0; j < grid.n; ++j)
      heights.push_back((at(grid.y, j) + at(grid.y, j + 1)) / 2);
    std::vector<Place> column;
    for (int i = 0; i < grid.m; ++i) {
      const auto [h, x] = find_on_side(at(m_layout.patches, p).sides[0], (at(grid.x, i) + at(grid.x, i + 1)) / 2);
      m_geometry.sample(h, x, heights, column);
      for (int j = 0; j < grid.n; ++j)
        m_quads.face[first + std::size_t(j * grid.m + i)] = at(column, j).face;
    }
  }

  /// Inner vertices follow the displacements of the sides by transfinite interpolation.
  void add_inner_vertices(Grid& grid)
  {
    const int m = grid.m;
    const int n = grid.n;
    const auto moved = [&](int i, int j) -> Point {
      return at(m_quads.points, at(grid.id, grid.index(i, j))) - at(grid.in_map, grid.index(i, j));
    };
    for (int j = 1; j < n; ++j)
      for (int i = 1; i < m; ++i) {
        const double x = double(i) / m;
        const double y = double(j) / n;
        const Point blended = (1 - y) * moved(i, 0) + y * moved(i, n) + (1 - x) * moved(0, j) + x * moved(m, j) -
                              (1 - y) * ((1 - x) * moved(0, 0) + x * moved(m, 0)) -
                              y * ((1 - x) * moved(0, n) + x * moved(m, n));
        at(grid.id, grid.index(i, j)) = size_of(m_quads.points);
        m_quads.points.push_back(at(grid.in_map, grid.index(i, j)) + blended);
        m_quads.vertices.emplace_back();
        m_quads.vertices.back().face = at(grid.face, grid.index(i, j));
      }
  }

  const Quad_layout& m_layout;
  const Collapsed_layout& m_collapsed;
  const Layout_geometry<D>& m_geometry;
  Curve_chains<D> m_chains;
  Indexed_quads<D> m_quads;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
