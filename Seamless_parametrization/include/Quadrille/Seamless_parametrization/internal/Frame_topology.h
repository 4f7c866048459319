// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_FRAME_TOPOLOGY_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_FRAME_TOPOLOGY_H

#include <Quadrille/Seamless_parametrization/internal/Tangent_geometry.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>
#include <Quadrille/exceptions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

/// The discrete side of a frame field: how frames of neighbouring faces correspond, along which frame direction every
/// constrained edge runs, and how many quadrants (quarter turns of the frame's coordinates) lie around every vertex.
///
/// A sector is a maximal run of corners around a vertex without a constrained edge between them: one for each
/// unconstrained interior vertex, several around a vertex where feature edges meet.
struct Frame_topology {
  struct Sector {
    int vertex = -1;
    int first_corner = -1;   ///< the corner that starts it, counterclockwise
    int quadrants = 0;       ///< turns of 90 degrees from its first edge to its last one, in (u, v)
    double angle = 0.0;      ///< of the domain, in turns of 90 degrees
    int least_quadrants = 1; ///< fewer would be a mesh without elements or with elements spread too wide
    int most_quadrants = std::numeric_limits<int>::max(); ///< more would squeeze the elements
    bool constrained = false; ///< bounded by constrained edges; otherwise it is the whole ring of an interior vertex
  };

  std::vector<int> matching;  ///< by halfedge, in {0, 1, 2, 3}: (u,v) of the other side = R^k (u,v); 0 on the boundary
  std::vector<int> alignment; ///< by halfedge: direction of a constrained edge, 0..3: +u, +v, -u, -v; -1 unconstrained
  std::vector<int> sector_of_corner;  ///< by corner (= the halfedge that leaves it)
  std::vector<Sector> sectors;        ///< by vertex, counterclockwise around it
  std::vector<int> vertex_quadrants;  ///< by vertex: the sum over its sectors; 0 for an isolated vertex
  std::vector<int> repaired_vertices; ///< on constrained edges, whose quadrants were changed

  /// The matching that maps the direction of a constrained edge on one side to that on the other.
  int matching_by_alignment(int h, int opposite) const
  {
    return (alignment[std::size_t(opposite)] + 2 - alignment[std::size_t(h)]) & 3;
  }

  /// Four times the index of vertex v: 4 - quadrants in the interior, 2 - quadrants on the boundary.
  int quarter_index(const Indexed_triangulation& mesh, int v) const
  {
    if (mesh.outgoing(v) < 0)
      return 0;
    return (mesh.is_boundary_vertex(v) ? 2 : 4) - vertex_quadrants[std::size_t(v)];
  }
};

/// The direction of a face's frame as one angle: that of du for orthogonal gradients, and midway between du and dv
/// turned back by 90 degrees for others. Independent of the gradients' lengths.
/// \throws Invalid_input_error if the gradients are not finite, vanish or are left-handed.
inline std::vector<double> frame_angles(const std::vector<Gradient_pair>& gradients)
{
  std::vector<double> angles;
  angles.reserve(gradients.size());
  for (const Gradient_pair& gradient : gradients) {
    const Eigen::Vector2d u = gradient.first.stableNormalized();
    const Eigen::Vector2d v = gradient.second.stableNormalized();
    if (!(cross(u, v) > 0.0))
      throw Invalid_input_error("the gradients (du, dv) of face " + std::to_string(angles.size()) +
                                " are not a right-handed pair of finite vectors");
    const Eigen::Vector2d direction = u + rotate_quarters(v, 3);
    angles.push_back(std::atan2(direction.y(), direction.x()));
  }
  return angles;
}

/// Computes a `Frame_topology`; the rotations between frames are the smallest ones, the alignments the nearest ones.
class Frame_topology_builder {
public:
  Frame_topology_builder(const Indexed_triangulation& mesh, const Tangent_geometry& geometry,
                         const std::vector<char>& constrained, const std::vector<Gradient_pair>& gradients)
      : m_mesh(mesh), m_geometry(geometry), m_constrained(constrained), m_angles(frame_angles(gradients)),
        m_turn(std::size_t(mesh.number_of_halfedges()), 0.0), m_offset(m_turn.size(), 0.0)
  {
  }

  /// Complexity: linear. \throws No_result_error if the index sum is not the Euler characteristic.
  Frame_topology operator()()
  {
    match_frames();
    align_constrained_edges();
    count_quadrants();
    check_index_sum();
    return std::move(m_topology);
  }

private:
  /// Splits an angle into the nearest number of quarter turns and the rest.
  static int nearest_quarters(double angle, double& rest)
  {
    const double quarters = std::round(angle / quarter_turn);
    rest = angle - quarters * quarter_turn;
    return int(quarters);
  }

  void match_frames()
  {
    m_topology.matching.assign(m_turn.size(), 0);
    for (int h = 0; h < m_mesh.number_of_halfedges(); ++h) {
      const int opposite = m_mesh.opposite(h);
      if (opposite < h) // done from the other side, or boundary: exactly antisymmetric by construction
        continue;
      double turn = 0.0;
      const int quarters = nearest_quarters(
          m_angles[std::size_t(opposite / 3)] - m_angles[std::size_t(h / 3)] - m_geometry.transport_angle(h), turn);
      m_turn[std::size_t(h)] = turn;
      m_turn[std::size_t(opposite)] = -turn;
      // Coordinates turn against their frame.
      m_topology.matching[std::size_t(h)] = -quarters & 3;
      m_topology.matching[std::size_t(opposite)] = quarters & 3;
    }
  }

  void align_constrained_edges()
  {
    m_topology.alignment.assign(m_turn.size(), -1);
    for (int h = 0; h < m_mesh.number_of_halfedges(); ++h) {
      if (!m_constrained[std::size_t(h)])
        continue;
      const Eigen::Vector2d& edge = m_geometry.edge(h);
      const double angle = std::atan2(edge.y(), edge.x()) - m_angles[std::size_t(h / 3)];
      m_topology.alignment[std::size_t(h)] = nearest_quarters(angle, m_offset[std::size_t(h)]) & 3;
    }
    for (int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if (m_constrained[std::size_t(h)] && !m_mesh.is_boundary(h))
        m_topology.matching[std::size_t(h)] = m_topology.matching_by_alignment(h, m_mesh.opposite(h));
  }

  void count_quadrants()
  {
    m_topology.sector_of_corner.assign(m_turn.size(), -1);
    m_topology.vertex_quadrants.assign(std::size_t(m_mesh.number_of_vertices()), 0);
    for (int v = 0; v < m_mesh.number_of_vertices(); ++v) {
      const int start = first_corner(v);
      int h = start;
      while (h >= 0) {
        h = add_sector(v, h);
        m_topology.vertex_quadrants[std::size_t(v)] += m_topology.sectors.back().quadrants;
        if (h == start)
          break;
      }
    }
  }

  /// A corner that starts a sector of v.
  int first_corner(int v) const
  {
    const int start = m_mesh.outgoing(v);
    int h = start;
    while (h >= 0 && !m_constrained[std::size_t(h)]) {
      h = m_mesh.next_around_source(h);
      if (h == start)
        break;
    }
    return h;
  }

  /// Adds the sector that starts with corner `start`; returns the corner that starts the next one, -1 at a boundary.
  int add_sector(int v, int start)
  {
    const bool constrained = m_constrained[std::size_t(start)] != 0;
    double angle = constrained ? m_offset[std::size_t(start)] : 0.0;
    double domain_angle = 0.0;
    int h = start;
    int last_edge = -1;
    do {
      m_topology.sector_of_corner[std::size_t(h)] = int(m_topology.sectors.size());
      const double corner_angle = m_geometry.corner_angle(h);
      angle += corner_angle;
      domain_angle += corner_angle;
      last_edge = Indexed_triangulation::prev(h);
      h = m_mesh.opposite(last_edge);
      if (m_constrained[std::size_t(last_edge)])
        break;
      angle -= m_turn[std::size_t(last_edge)];
    } while (h != start);
    if (constrained)
      angle -= m_offset[std::size_t(last_edge)];
    Frame_topology::Sector sector;
    sector.vertex = v;
    sector.first_corner = start;
    sector.quadrants = int(std::lround(angle / quarter_turn));
    sector.constrained = constrained;
    sector.angle = domain_angle / quarter_turn;
    if (constrained)
      set_limits(sector);
    m_topology.sectors.push_back(sector);
    return h;
  }

  /// A straight side shall not become a corner of the mesh, nor a right angle a straight side; but what a corner of 45
  /// or 135 degrees becomes is the frames' choice, and so is a step of one quadrant at the end of a feature line.
  static void set_limits(Frame_topology::Sector& sector)
  {
    const double tolerance = sector.angle > 3.5 ? 1.2 : 0.84;
    sector.least_quadrants = std::max(1, int(std::ceil(sector.angle - tolerance)));
    sector.most_quadrants = std::max(sector.least_quadrants, int(std::floor(sector.angle + tolerance)));
  }

  void check_index_sum() const
  {
    long sum = 0;
    for (int v = 0; v < m_mesh.number_of_vertices(); ++v)
      sum += m_topology.quarter_index(m_mesh, v);
    if (sum != 4L * m_mesh.euler_characteristic())
      throw No_result_error("map", "the indices of the frame field add up to " + std::to_string(double(sum) / 4.0) +
                                       " instead of the Euler characteristic " +
                                       std::to_string(m_mesh.euler_characteristic()) +
                                       "; the surface's angles or transports are inconsistent");
  }

  const Indexed_triangulation& m_mesh;
  const Tangent_geometry& m_geometry;
  const std::vector<char>& m_constrained; ///< by halfedge, equal on both sides, set on the whole boundary
  std::vector<double> m_angles;           ///< by face
  std::vector<double> m_turn;             ///< by halfedge: angle from its face's frame to the matched one across it
  std::vector<double> m_offset;           ///< by constrained halfedge: its angle to the frame direction it runs along
  Frame_topology m_topology;
};

} // namespace internal
} // namespace Quadrille

#endif
