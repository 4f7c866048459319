// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_CONFLICTING_CORNERS_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_CONFLICTING_CORNERS_H

#include <Quadrille/Seamless_parametrization/internal/Frame_topology.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <tuple>
#include <vector>

namespace Quadrille {
namespace internal {

/// A sector that might have `amount` (1 or -1) quadrants more.
struct Corner_change {
  int sector;
  int amount;
};

/// The corners whose quadrants decide over the lengths of some edges of curves.
///
/// A side of a patch is a run of constrained edges up to a corner that is no straight line. All sectors along the sides
/// with these edges and along those next to them are candidates, if the angle of the domain there admits another number
/// of quadrants (`Frame_topology::Sector::least_quadrants` and `most_quadrants`).
class Conflicting_corner_finder {
public:
  Conflicting_corner_finder(const Indexed_triangulation& mesh, const Frame_topology& topology)
      : m_mesh(mesh), m_topology(topology)
  {
  }

  /// For constrained `halfedges`; those first that the angles of the domain speak least against. Complexity: linear.
  std::vector<Corner_change> operator()(const std::vector<int>& halfedges)
  {
    for (const int h : halfedges) {
      walk_forward(h);
      walk_back(h);
    }
    std::vector<std::tuple<double, int, int>> changes;
    for (const int s : m_sectors)
      for (const int amount : {-1, 1}) {
        const Frame_topology::Sector& sector = m_topology.sectors[std::size_t(s)];
        const int changed = sector.quadrants + amount;
        if (changed >= sector.least_quadrants && changed <= sector.most_quadrants)
          changes.emplace_back(std::abs(sector.angle - changed), s, amount);
      }
    std::sort(changes.begin(), changes.end());
    std::vector<Corner_change> result;
    for (const auto& [deviation, s, amount] : changes)
      result.push_back({s, amount});
    return result;
  }

private:
  static constexpr int n_corners = 2; ///< at each end of a side: its own, and the other one of the next side

  const Frame_topology::Sector& sector_at(int corner) const
  {
    return m_topology.sectors[std::size_t(m_topology.sector_of_corner[std::size_t(corner)])];
  }

  /// Along the side of h and the next one, to its end.
  void walk_forward(int h)
  {
    const int start = h;
    int corners_left = n_corners;
    do {
      const int corner = Indexed_triangulation::next(h);
      m_sectors.insert(m_topology.sector_of_corner[std::size_t(corner)]);
      h = sector_at(corner).first_corner;
      if (sector_at(h).quadrants != 2)
        --corners_left;
    } while (h != start && corners_left > 0);
  }

  /// Along the side of h and the one before, to its beginning.
  void walk_back(int h)
  {
    const int start = h;
    int corners_left = n_corners;
    do {
      m_sectors.insert(m_topology.sector_of_corner[std::size_t(h)]);
      if (sector_at(h).quadrants != 2 && --corners_left == 0)
        return;
      h = last_halfedge(h);
    } while (h != start);
  }

  /// The constrained halfedge that arrives at the end of the sector that `corner` begins.
  int last_halfedge(int corner) const
  {
    int arriving = Indexed_triangulation::prev(corner);
    while (m_topology.alignment[std::size_t(arriving)] < 0)
      arriving = Indexed_triangulation::prev(m_mesh.opposite(arriving));
    return arriving;
  }

  const Indexed_triangulation& m_mesh;
  const Frame_topology& m_topology;
  std::set<int> m_sectors;
};

} // namespace internal
} // namespace Quadrille

#endif
