// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_FIND_CRACKS_H
#define QUADRILLE_MESH_IO_INTERNAL_FIND_CRACKS_H

#include <Quadrille/Mesh_io/internal/Nearest_tree.h>
#include <Quadrille/Mesh_io/internal/Spatial_extent.h>
#include <Quadrille/Mesh_io/internal/Triangle_adjacency.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace Quadrille {
namespace internal {

/// Two border edges at the same place that are not one edge.
struct Crack {
  std::array<std::size_t, 2> triangles;
  std::array<int, 2> first, second; ///< their ends: `second[i]` is where `first[i]` is
  bool is_unique = true;            ///< there is no third one
};

/// Finds border edges at the same place, up to 1e-6 of the diagonal and a tenth of their lengths.
/// Complexity: O(n log n) unless edges crowd within the tolerance.
class Crack_finder {
public:
  Crack_finder(const std::vector<std::array<double, 3>>& points,
               const std::vector<Triangle_adjacency::Triangle>& triangles)
      : m_points(points), m_triangles(triangles)
  {
  }

  /// Each pair once, in the order of the border.
  std::vector<Crack> operator()(const Triangle_adjacency& adjacency)
  {
    Spatial_extent extent;
    for (const Triangle_adjacency::Triangle& t : m_triangles)
      for (const int v : t)
        extent.add(m_points[std::size_t(v)]);
    m_low = extent.low;
    m_tolerance = 1e-6 * length_of(space_point(extent.high) - space_point(extent.low));
    for (const Triangle_adjacency::Side& side : adjacency.border()) {
      const Triangle_adjacency::Triangle& t = m_triangles[side.triangle];
      m_edges.push_back({side.triangle, {t[side.edge], t[(side.edge + 1) % 3]}});
    }
    for (std::size_t i = 0; i < m_edges.size(); ++i)
      m_edges_in_cell[cell_of(middle(m_edges[i]))].push_back(i);
    std::vector<Crack> cracks;
    std::vector<int> n_partners(m_edges.size(), 0);
    std::vector<std::array<std::size_t, 2>> pairs;
    for (std::size_t i = 0; i < m_edges.size(); ++i)
      for_each_near(i, [&](std::size_t j) {
        Crack crack{{m_edges[i].triangle, m_edges[j].triangle}, m_edges[i].ends, m_edges[j].ends};
        if (j <= i || !is_crack(crack))
          return;
        cracks.push_back(crack);
        pairs.push_back({i, j});
        ++n_partners[i];
        ++n_partners[j];
      });
    for (std::size_t k = 0; k < cracks.size(); ++k)
      cracks[k].is_unique = n_partners[pairs[k][0]] == 1 && n_partners[pairs[k][1]] == 1;
    return cracks;
  }

private:
  using Cell = std::array<std::int64_t, 3>;

  struct Edge {
    std::size_t triangle;
    std::array<int, 2> ends;
  };

  Space_kernel::Point_3 point(int v) const { return space_point(m_points[std::size_t(v)]); }

  Space_kernel::Point_3 middle(const Edge& edge) const
  {
    return CGAL::midpoint(point(edge.ends[0]), point(edge.ends[1]));
  }

  Cell cell_of(const Space_kernel::Point_3& p) const
  {
    Cell cell{};
    for (int k = 0; k < 3; ++k)
      cell[std::size_t(k)] =
          m_tolerance > 0 ? std::int64_t(std::floor((p[k] - m_low[std::size_t(k)]) / m_tolerance)) : 0;
    return cell;
  }

  /// The edges whose middles may be within the tolerance of that of edge i.
  template <class Visit> void for_each_near(std::size_t i, const Visit& visit) const
  {
    const Cell centre = cell_of(middle(m_edges[i]));
    for (std::int64_t x = -1; x <= 1; ++x)
      for (std::int64_t y = -1; y <= 1; ++y)
        for (std::int64_t z = -1; z <= 1; ++z)
          if (const auto found = m_edges_in_cell.find({centre[0] + x, centre[1] + y, centre[2] + z});
              found != m_edges_in_cell.end())
            for (const std::size_t j : found->second)
              visit(j);
  }

  /// Brings the ends into correspondence.
  bool is_crack(Crack& crack) const
  {
    const auto deviation = [&] {
      return std::max(length_of(point(crack.second[0]) - point(crack.first[0])),
                      length_of(point(crack.second[1]) - point(crack.first[1])));
    };
    const double as_it_is = deviation();
    std::swap(crack.second[0], crack.second[1]);
    const double turned = deviation();
    if (as_it_is < turned)
      std::swap(crack.second[0], crack.second[1]);
    const double length = std::min(length_of(point(crack.first[1]) - point(crack.first[0])),
                                   length_of(point(crack.second[1]) - point(crack.second[0])));
    return std::min(as_it_is, turned) <= std::min(m_tolerance, 0.1 * length);
  }

  const std::vector<std::array<double, 3>>& m_points;
  const std::vector<Triangle_adjacency::Triangle>& m_triangles;
  std::array<double, 3> m_low{};
  double m_tolerance = 0;
  std::vector<Edge> m_edges;
  std::map<Cell, std::vector<std::size_t>> m_edges_in_cell;
};

} // namespace internal
} // namespace Quadrille

#endif
