// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_MOVE_SINGULARITIES_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_MOVE_SINGULARITIES_H

#include <Quadrille/Seamless_parametrization/internal/Frame_topology.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <queue>
#include <vector>

namespace Quadrille {
namespace internal {

/// Moves singularities to where a map without flipped triangles has branch points instead.
///
/// Seams fix by how many quadrants a map turns around a vertex up to multiples of 4 only. Near a singularity of valence
/// 5 a map is, in suitable coordinates, c z^(1/4) + z^(5/4) + ..., and c vanishes for the right place of the
/// singularity only. Unless the triangles hide it, the map therefore turns by one quadrant around the singularity, and
/// by 8 around the place z = -c/5 where the derivative vanishes; no untangling can mend that. A singularity at
/// z = -4c/5 would have c = 0, so moving it to the vertex that turns by 8 leaves three quarters of c, and repeating
/// that leaves nothing.
class Singularity_mover {
public:
  Singularity_mover(const Indexed_triangulation& mesh, Frame_topology& topology)
      : m_mesh(mesh), m_topology(topology), m_arrival(std::size_t(mesh.number_of_vertices())),
        m_search(std::size_t(mesh.number_of_vertices()), -1)
  {
  }

  /// `turned`: by vertex, the quadrants by which the map turns. Hands a quadrant from each of `misturned` around which
  /// the map turns too little to the nearest one around which it turns too much. Returns how many were moved.
  /// Complexity: linear for each, in the vertices that are nearer.
  int operator()(const std::vector<int>& misturned, const std::vector<int>& turned)
  {
    std::vector<int> excess(turned.size(), 0);
    for (const int v : misturned)
      excess[std::size_t(v)] = turned[std::size_t(v)] - m_topology.vertex_quadrants[std::size_t(v)];
    int n_moved = 0;
    for (const int v : misturned) {
      if (excess[std::size_t(v)] >= 0 || sector_at(v).constrained)
        continue;
      const int target = nearest(v, excess);
      if (target < 0)
        continue;
      move_quadrant(v, target);
      excess[std::size_t(target)] = 0;
      ++n_moved;
    }
    return n_moved;
  }

  /// The place where a map has its branch point may be on a curve, or beyond it: then the singularity comes to lie next
  /// to the curve, and the triangle between them stays flipped, since a neighbour takes up what it lacks. Such a
  /// singularity hands a quadrant to that end of the triangle's curve edge where the map `uv` of the corners turns
  /// further; the curve has an irregular vertex there then. Returns how many did.
  /// Complexity: linear in the number of `flipped` faces.
  int hand_to_curves(const std::vector<int>& flipped, const std::vector<Eigen::Vector2d>& uv)
  {
    int n_moved = 0;
    for (const int f : flipped)
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int v = m_mesh.source(h);
        if (sector_at(v).constrained || sector_at(v).quadrants < 5 ||
            m_topology.alignment[std::size_t(Indexed_triangulation::next(h))] < 0)
          continue;
        hand_to_curve(h, uv);
        ++n_moved;
      }
    return n_moved;
  }

private:
  Frame_topology::Sector& sector_at(int v)
  {
    return m_topology.sectors[std::size_t(m_topology.sector_of_corner[std::size_t(m_mesh.outgoing(v))])];
  }

  /// Breadth first, along unconstrained edges, to a vertex that turns too much and may have a quadrant more; -1: none.
  int nearest(int start, const std::vector<int>& excess)
  {
    std::queue<int> queue;
    queue.push(start);
    m_search[std::size_t(start)] = start;
    while (!queue.empty()) {
      const int v = queue.front();
      queue.pop();
      const Frame_topology::Sector& sector = sector_at(v);
      if (excess[std::size_t(v)] > 0 && sector.quadrants == m_topology.vertex_quadrants[std::size_t(v)] &&
          sector.quadrants < sector.most_quadrants)
        return v;
      if (sector.constrained)
        continue;
      int h = m_mesh.outgoing(v);
      do {
        int& search = m_search[std::size_t(m_mesh.target(h))];
        if (search != start) {
          search = start;
          m_arrival[std::size_t(m_mesh.target(h))] = h;
          queue.push(m_mesh.target(h));
        }
        h = m_mesh.next_around_source(h);
      } while (h != m_mesh.outgoing(v));
    }
    return -1;
  }

  /// From the source of `h` to an end of the opposite edge.
  void hand_to_curve(int h, const std::vector<Eigen::Vector2d>& uv)
  {
    const int other = m_mesh.opposite(Indexed_triangulation::prev(h)); // leaves the same vertex
    // The corners at the curve of the faces beyond both edges: that leave `h`'s target, and arrive at the other's.
    const int corner = m_mesh.opposite(h), other_corner = Indexed_triangulation::next(other);
    const bool is_first = turn(corner, uv) >= turn(other_corner, uv);
    const int edge = is_first ? h : other,
              sector = m_topology.sector_of_corner[std::size_t(is_first ? corner : other_corner)];
    const int from = m_mesh.source(h), to = m_mesh.target(edge);
    hand_over(edge);
    sector_at(from).quadrants -= 1;
    m_topology.vertex_quadrants[std::size_t(from)] -= 1;
    m_topology.sectors[std::size_t(sector)].quadrants += 1;
    m_topology.vertex_quadrants[std::size_t(to)] += 1;
    m_topology.repaired_vertices.push_back(to);
  }

  /// The angle of a corner in the map.
  static double turn(int corner, const std::vector<Eigen::Vector2d>& uv)
  {
    const Eigen::Vector2d& apex = uv[std::size_t(corner)];
    const Eigen::Vector2d first = uv[std::size_t(Indexed_triangulation::next(corner))] - apex;
    const Eigen::Vector2d second = uv[std::size_t(Indexed_triangulation::prev(corner))] - apex;
    return std::atan2(cross(first, second), first.dot(second));
  }

  /// A quadrant from the source of a halfedge to its target.
  void hand_over(int h)
  {
    int& matching = m_topology.matching[std::size_t(h)];
    int& opposite_matching = m_topology.matching[std::size_t(m_mesh.opposite(h))];
    matching = (matching + 3) & 3;
    opposite_matching = (opposite_matching + 1) & 3;
  }

  void move_quadrant(int from, int to)
  {
    for (int v = to; v != from;) {
      const int h = m_arrival[std::size_t(v)];
      hand_over(h);
      v = m_mesh.source(h);
    }
    for (const int v : {from, to}) {
      const int change = v == to ? 1 : -1;
      sector_at(v).quadrants += change;
      m_topology.vertex_quadrants[std::size_t(v)] += change;
    }
  }

  const Indexed_triangulation& m_mesh;
  Frame_topology& m_topology;
  std::vector<int> m_arrival; ///< by vertex: halfedge from the vertex before it on the way
  std::vector<int> m_search;  ///< by vertex: start of the last search that visited it
};

} // namespace internal
} // namespace Quadrille

#endif
