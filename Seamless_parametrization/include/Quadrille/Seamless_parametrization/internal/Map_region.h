// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_MAP_REGION_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_MAP_REGION_H

#include <Quadrille/Seamless_parametrization/internal/Seamless_constraints.h>
#include <Quadrille/Seamless_parametrization/internal/Union_find.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace Quadrille {
namespace internal {

/// A part of a map that may change while the rest of it stays.
struct Map_region {
  std::vector<int> faces;      ///< in ascending order
  std::vector<int> parameters; ///< free ones that no other face depends on, in ascending order
};

inline Map_region whole_map(const Seamless_space& space)
{
  Map_region region;
  region.faces.resize(space.copy_of_corner.size() / 3);
  std::iota(region.faces.begin(), region.faces.end(), 0);
  region.parameters.resize(std::size_t(space.number_of_parameters));
  std::iota(region.parameters.begin(), region.parameters.end(), 0);
  return region;
}

/// `seeds` and the faces that share vertices with them, that many times over.
inline std::vector<char> faces_around(const Indexed_triangulation& mesh, const std::vector<int>& seeds, int rings)
{
  std::vector<char> is_near(std::size_t(mesh.number_of_vertices()), 0);
  std::vector<char> is_inside(std::size_t(mesh.number_of_faces()), 0);
  for (const int f : seeds)
    is_inside[std::size_t(f)] = 1;
  for (int ring = 0; ring < rings; ++ring) {
    for (int h = 0; h < mesh.number_of_halfedges(); ++h)
      if (is_inside[std::size_t(h / 3)])
        is_near[std::size_t(mesh.source(h))] = 1;
    for (int h = 0; h < mesh.number_of_halfedges(); ++h)
      if (is_near[std::size_t(mesh.source(h))])
        is_inside[std::size_t(h / 3)] = 1;
  }
  return is_inside;
}

/// How many of `faces` hang together by vertices, at most. Complexity: near-linear.
inline std::size_t largest_cluster(const Indexed_triangulation& mesh, const std::vector<int>& faces)
{
  Signed_union_find clusters{std::size_t(mesh.number_of_vertices())};
  for (const int f : faces)
    for (const int h : {3 * f, 3 * f + 1})
      clusters.unite(mesh.source(h), mesh.target(h), 1);
  std::vector<std::size_t> n_faces(std::size_t(mesh.number_of_vertices()), 0);
  std::size_t largest = 0;
  for (const int f : faces)
    largest = std::max(largest, ++n_faces[std::size_t(clusters.find(mesh.source(3 * f)).first)]);
  return largest;
}

/// The faces up to `rings` around `seeds`, with the parameters that move nothing else. Complexity: O(rings n).
inline Map_region map_region(const Indexed_triangulation& mesh, const Seamless_space& space,
                             const std::vector<int>& seeds, int rings)
{
  const std::vector<char> is_inside = faces_around(mesh, seeds, rings);
  std::vector<char> is_used_inside(std::size_t(space.number_of_parameters), 0);
  std::vector<char> is_used_outside = is_used_inside;
  for (std::size_t corner = 0; corner < space.copy_of_corner.size(); ++corner) {
    std::vector<char>& is_used = is_inside[corner / 3] ? is_used_inside : is_used_outside;
    const int row = 2 * space.copy_of_corner[corner];
    for (const Seamless_space::Entry* e = space.begin(row); e != space.end(row + 1); ++e)
      is_used[std::size_t(e->parameter)] = 1;
  }
  Map_region region;
  for (std::size_t f = 0; f < is_inside.size(); ++f)
    if (is_inside[f])
      region.faces.push_back(int(f));
  for (std::size_t i = 0; i < is_used_inside.size(); ++i)
    if (is_used_inside[i] && !is_used_outside[i])
      region.parameters.push_back(int(i));
  return region;
}

} // namespace internal
} // namespace Quadrille

#endif
