// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_VOLUME_CONTENT_H
#define QUADRILLE_MESH_IO_INTERNAL_VOLUME_CONTENT_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Tetrahedral_mesh.h>
#include <Quadrille/exceptions.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// What a file holds: tetrahedra or, where it has no cells of dimension 3, a surface to be filled with them.
struct Volume_content {
  Tetrahedral_mesh volume;
  Labelled_mesh surface;
};

template <class Archive> void exchange(Archive& archive, Volume_content& c) { archive(c.volume, c.surface); }

/// \param first the number of the file's first vertex, for the message
inline void check_corners(const Tetrahedral_mesh& mesh, const std::string& path, int first)
{
  const auto check = [&](const std::string& kind, std::size_t i, const auto& corners) {
    for (const int v : corners)
      if (v < 0 || std::size_t(v) >= mesh.points.size())
        throw Invalid_input_error(path + ": " + kind + " " + std::to_string(i + std::size_t(first)) + " uses vertex " +
                                  std::to_string(static_cast<long long>(v) + first) +
                                  ", which does not exist (there are " + std::to_string(mesh.points.size()) + ")");
  };
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    check("tetrahedron", t, mesh.tetrahedra[t]);
  for (std::size_t e = 0; e < mesh.feature_edges.size(); ++e)
    check("edge", e, mesh.feature_edges[e]);
}

/// Turns tetrahedra around that are negatively oriented, whatever the file's convention. Degenerate ones stay.
inline void orient_tetrahedra(Tetrahedral_mesh& mesh)
{
  using Point_3 = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  const auto point = [&](int v) {
    const std::array<double, 3>& p = mesh.points[std::size_t(v)];
    return Point_3(p[0], p[1], p[2]);
  };
  for (std::array<int, 4>& t : mesh.tetrahedra)
    if (CGAL::orientation(point(t[0]), point(t[1]), point(t[2]), point(t[3])) == CGAL::NEGATIVE)
      std::swap(t[2], t[3]);
}

/// Leaves each feature edge once, and only those that are edges of tetrahedra: files also mark curves that bound no
/// volume.
inline void select_feature_edges(Tetrahedral_mesh& mesh)
{
  std::vector<std::array<int, 2>>& edges = mesh.feature_edges;
  for (std::array<int, 2>& e : edges)
    e = {std::min(e[0], e[1]), std::max(e[0], e[1])};
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<char> is_marked(mesh.points.size(), 0), is_edge(edges.size(), 0);
  for (const std::array<int, 2>& e : edges)
    is_marked[std::size_t(e[0])] = is_marked[std::size_t(e[1])] = 1;
  for (const std::array<int, 4>& t : mesh.tetrahedra)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (is_marked[std::size_t(t[i])] && is_marked[std::size_t(t[j])]) {
          const std::array<int, 2> e = {std::min(t[i], t[j]), std::max(t[i], t[j])};
          const auto found = std::lower_bound(edges.begin(), edges.end(), e);
          if (found != edges.end() && *found == e && e[0] != e[1])
            is_edge[std::size_t(found - edges.begin())] = 1;
        }
  std::size_t n = 0;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (is_edge[i])
      edges[n++] = edges[i];
  edges.resize(n);
}

/// Removes the points that no tetrahedron has, and the feature edges between them.
inline void remove_unused_points(Tetrahedral_mesh& mesh)
{
  std::vector<int> index(mesh.points.size(), -1);
  for (const std::array<int, 4>& t : mesh.tetrahedra)
    for (const int v : t)
      index[std::size_t(v)] = 0;
  int n = 0;
  for (std::size_t v = 0; v < index.size(); ++v)
    if (index[v] == 0) {
      mesh.points[std::size_t(n)] = mesh.points[v];
      index[v] = n++;
    }
  mesh.points.resize(std::size_t(n));
  for (std::array<int, 4>& t : mesh.tetrahedra)
    for (int& v : t)
      v = index[std::size_t(v)];
  std::vector<std::array<int, 2>> edges;
  for (const std::array<int, 2>& e : mesh.feature_edges)
    if (index[std::size_t(e[0])] >= 0 && index[std::size_t(e[1])] >= 0)
      edges.push_back({index[std::size_t(e[0])], index[std::size_t(e[1])]});
  mesh.feature_edges = std::move(edges);
}

/// What a file without tetrahedra holds instead, in words.
inline std::string words_for_content(const Labelled_mesh& surface)
{
  const auto count = [](std::size_t n, const std::string& what) { return std::to_string(n) + " " + what; };
  if (!surface.polygons.empty())
    return "only " + count(surface.polygons.size(), "polygons of a surface");
  if (!surface.lines.empty())
    return "only " + count(surface.lines.size(), "lines");
  return surface.points.empty() ? "nothing that is read" : "only " + count(surface.points.size(), "points");
}

} // namespace internal
} // namespace Quadrille

#endif
