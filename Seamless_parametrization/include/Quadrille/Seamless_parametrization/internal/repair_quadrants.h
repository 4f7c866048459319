// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_REPAIR_QUADRANTS_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_REPAIR_QUADRANTS_H

#include <Quadrille/Seamless_parametrization/internal/Frame_topology.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>

#include <array>
#include <cstddef>
#include <queue>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Brings the quadrants of every sector within its limits (at least one everywhere; two along straight sides, and so
/// on), by handing single quadrants to or from sectors nearby: first choice, within a few edges, is one that is itself
/// out of its limits or singular the other way round, so that both heal; else an interior vertex, which becomes a
/// singularity of valence 3 or 5; and where a region has none, a boundary or feature vertex whose limits allow it. For
/// a sector that no convex quads fill, the limits do not count, and for one without a quadrant, nothing does but that
/// one is left.
///
/// A quadrant is handed on along an edge by changing the edge's matching, or the alignment of one side of a constrained
/// edge, by one. The sum of all quadrants, and so the index sum, stays.
class Quadrant_repair {
public:
  Quadrant_repair(const Indexed_triangulation& mesh, Frame_topology& topology)
      : m_mesh(mesh), m_topology(topology), m_arrival(topology.sectors.size(), -1),
        m_round(topology.sectors.size(), -1), m_depth(topology.sectors.size(), 0)
  {
  }

  /// The sectors that are still without a quadrant because none of their region has one to spare.
  /// Complexity: linear for each quadrant moved, in the number of corners nearer than the sector that spares it.
  std::vector<int> operator()()
  {
    const std::vector<Frame_topology::Sector> before = m_topology.sectors;
    for (int s = 0; s < int(before.size()); ++s) {
      while (sector(s).quadrants < sector(s).least_quadrants && exchange(s, -1)) {
      }
      while (sector(s).quadrants > sector(s).most_quadrants && exchange(s, 1)) {
      }
    }
    std::vector<int> without;
    for (int s = 0; s < int(before.size()); ++s) {
      if (sector(s).quadrants < 1)
        without.push_back(s);
      if (sector(s).constrained && sector(s).quadrants != before[std::size_t(s)].quadrants)
        m_topology.repaired_vertices.push_back(sector(s).vertex);
    }
    update_constrained_matchings();
    return without;
  }

  /// Gives sector `s` `amount` (1 or -1) quadrants more. Returns false if its region has no partner for that.
  bool change(int s, int amount)
  {
    if (!exchange(s, amount > 0 ? -1 : 1))
      return false;
    m_topology.repaired_vertices.push_back(sector(s).vertex);
    update_constrained_matchings();
    return true;
  }

private:
  static constexpr int healing_depth = 4; ///< edges within which a partner that heals too is preferred

  Frame_topology::Sector& sector(int s) { return m_topology.sectors[std::size_t(s)]; }
  int sector_at(int corner) const { return m_topology.sector_of_corner[std::size_t(corner)]; }

  /// Hands `amount` (1 or -1) quadrants from sector s to the best partner; false if there is none.
  bool exchange(int s, int amount)
  {
    const int partner = find_partner(s, amount);
    if (partner < 0)
      return false;
    move_quadrants(partner, s, -amount);
    return true;
  }

  enum class Suitability { heals, regular, tolerable, out_of_limits, not_convex, unsuitable };

  /// So many convex quads fill a sector only if that is below as many times 180 degrees.
  static bool is_convex(const Frame_topology::Sector& sector, int quadrants) { return sector.angle < 2.0 * quadrants; }

  /// What `amount` quadrants more would mean for a sector.
  Suitability suitability(int s, int amount)
  {
    const Frame_topology::Sector& candidate = sector(s);
    if (!candidate.constrained) {
      const int excess = (candidate.quadrants - 4) * amount;
      return excess < 0 ? Suitability::heals : excess == 0 ? Suitability::regular : Suitability::unsuitable;
    }
    if (amount > 0 ? candidate.quadrants < candidate.least_quadrants : candidate.quadrants > candidate.most_quadrants)
      return Suitability::heals;
    const int changed = candidate.quadrants + amount;
    if (changed >= candidate.least_quadrants && changed <= candidate.most_quadrants)
      return Suitability::tolerable;
    return changed < 1                     ? Suitability::unsuitable
           : is_convex(candidate, changed) ? Suitability::out_of_limits
                                           : Suitability::not_convex;
  }

  /// Breadth first from sector `start`. `m_arrival` remembers for each visited sector the halfedge over which a
  /// quadrant travels from it towards `start`.
  int find_partner(int start, int amount)
  {
    ++m_n_rounds;
    std::queue<int> queue;
    visit(start, -1, 0, queue);
    std::array<int, 6> nearest; // by suitability
    nearest.fill(-1);
    while (!queue.empty()) {
      const int s = queue.front();
      queue.pop();
      if (nearest[std::size_t(Suitability::regular)] >= 0 && m_depth[std::size_t(s)] > healing_depth)
        break;
      const Suitability suits = s == start ? Suitability::unsuitable : suitability(s, amount);
      if (suits == Suitability::heals)
        return s;
      if (nearest[std::size_t(suits)] < 0)
        nearest[std::size_t(suits)] = s;
      visit_neighbours(s, queue);
    }
    // The worse a partner, the worse what it has to heal.
    const bool is_empty = sector(start).quadrants < 1;
    const bool is_urgent = is_empty || !is_convex(sector(start), sector(start).quadrants);
    for (const auto& [choice, is_allowed] :
         {std::pair(Suitability::regular, true), std::pair(Suitability::tolerable, true),
          std::pair(Suitability::out_of_limits, is_urgent), std::pair(Suitability::not_convex, is_empty)})
      if (is_allowed && nearest[std::size_t(choice)] >= 0)
        return nearest[std::size_t(choice)];
    return -1;
  }

  void visit_neighbours(int s, std::queue<int>& queue)
  {
    const int depth = m_depth[std::size_t(s)] + 1;
    int h = sector(s).first_corner;
    do { // all edges of the sector, as halfedges that run towards its vertex
      if (m_topology.alignment[std::size_t(h)] >= 0)
        visit(sector_at(Indexed_triangulation::next(h)), mark_reversed(h), depth, queue);
      else
        visit(sector_at(Indexed_triangulation::next(h)), m_mesh.opposite(h), depth, queue);
      const int incoming = Indexed_triangulation::prev(h);
      h = m_mesh.opposite(incoming);
      if (m_topology.alignment[std::size_t(incoming)] >= 0) {
        visit(sector_at(incoming), incoming, depth, queue);
        break;
      }
    } while (h != sector(s).first_corner);
  }

  /// A constrained side h that a quadrant travels backwards, from its target to its source.
  static int mark_reversed(int h) { return -2 - h; }

  void visit(int s, int arrival, int depth, std::queue<int>& queue)
  {
    if (m_round[std::size_t(s)] == m_n_rounds)
      return;
    m_round[std::size_t(s)] = m_n_rounds;
    m_arrival[std::size_t(s)] = arrival;
    m_depth[std::size_t(s)] = depth;
    queue.push(s);
  }

  /// `amount` quadrants travel from a sector to the start of the last search.
  void move_quadrants(int from, int start, int amount)
  {
    for (int s = from; s != start;) {
      const int arrival = m_arrival[std::size_t(s)];
      const bool reversed = arrival < -1;
      const int h = reversed ? -2 - arrival : arrival;
      int& alignment = m_topology.alignment[std::size_t(h)];
      if (alignment >= 0) {
        alignment = (alignment + (reversed ? -amount : amount)) & 3;
      } else {
        int& matching = m_topology.matching[std::size_t(h)];
        int& opposite_matching = m_topology.matching[std::size_t(m_mesh.opposite(h))];
        matching = (matching - amount) & 3;
        opposite_matching = (opposite_matching + amount) & 3;
      }
      s = sector_at(reversed ? h : Indexed_triangulation::next(h));
    }
    add_quadrants(from, -amount);
    add_quadrants(start, amount);
  }

  void add_quadrants(int s, int amount)
  {
    sector(s).quadrants += amount;
    m_topology.vertex_quadrants[std::size_t(sector(s).vertex)] += amount;
  }

  void update_constrained_matchings()
  {
    for (int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if (m_topology.alignment[std::size_t(h)] >= 0 && !m_mesh.is_boundary(h))
        m_topology.matching[std::size_t(h)] = m_topology.matching_by_alignment(h, m_mesh.opposite(h));
  }

  const Indexed_triangulation& m_mesh;
  Frame_topology& m_topology;
  std::vector<int> m_arrival;
  std::vector<int> m_round; ///< by sector: the last search that visited it
  std::vector<int> m_depth; ///< by sector: edges from the start of that search
  int m_n_rounds = -1;
};

} // namespace internal
} // namespace Quadrille

#endif
