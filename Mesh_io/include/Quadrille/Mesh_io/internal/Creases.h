// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_CREASES_H
#define QUADRILLE_MESH_IO_INTERNAL_CREASES_H

#include <Quadrille/Surface_domain.h>

#include <CGAL/number_utils.h>

#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace Quadrille {
namespace internal {

/// Sharp edges of a surface, in the order of its edges.
struct Creases {
  using Mesh = Surface_domain::Mesh;
  using Halfedge = Surface_domain::halfedge_descriptor;

  std::vector<Halfedge> edges;
  std::size_t n_noise = 0; ///< edges that were left out, since they are connected with too few others and end loosely

  Creases(const Mesh& mesh, double angle_degrees, int min_edges)
  {
    for (const auto e : mesh.edges())
      if (!mesh.is_border(e) && bend(mesh, mesh.halfedge(e)) > angle_degrees * CGAL_PI / 180)
        edges.push_back(mesh.halfedge(e));
    remove_noise(mesh, min_edges);
  }

  /// Angle between the normals of the two triangles of an edge.
  static double bend(const Mesh& mesh, Halfedge h)
  {
    const auto a = normal(mesh, h), b = normal(mesh, mesh.opposite(h));
    const auto c = CGAL::cross_product(a, b);
    return std::atan2(std::hypot(c.x(), c.y(), c.z()), a * b);
  }

private:
  /// Of a length that depends on the triangle's angles only, so that it stays within the range of doubles.
  static Surface_domain::Vector_3 normal(const Mesh& mesh, Halfedge h)
  {
    const auto &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h)),
               &r = mesh.point(mesh.target(mesh.next(h)));
    const Surface_domain::Vector_3 u = q - p, v = r - p;
    return CGAL::cross_product(u / std::hypot(u.x(), u.y(), u.z()), v / std::hypot(v.x(), v.y(), v.z()));
  }

  /// Creases end loosely where neither another one nor the border goes on.
  void remove_noise(const Mesh& mesh, int min_edges)
  {
    const auto index = [](auto v) { return std::size_t(v.idx()); };
    std::vector<std::size_t> parent(mesh.number_of_vertices());
    std::iota(parent.begin(), parent.end(), std::size_t(0));
    const auto root = [&](std::size_t v) {
      while (parent[v] != v)
        v = parent[v] = parent[parent[v]];
      return v;
    };
    std::vector<int> degree(parent.size(), 0), n_edges(parent.size(), 0);
    std::vector<char> is_loose(parent.size(), 0);
    for (const Halfedge h : edges) {
      ++degree[index(mesh.source(h))];
      ++degree[index(mesh.target(h))];
      parent[root(index(mesh.source(h)))] = root(index(mesh.target(h)));
    }
    for (const auto v : mesh.vertices())
      if (degree[index(v)] == 1 && !mesh.is_border(v))
        is_loose[root(index(v))] = 1;
    for (const Halfedge h : edges)
      ++n_edges[root(index(mesh.source(h)))];
    std::vector<Halfedge> kept;
    for (const Halfedge h : edges)
      if (const std::size_t r = root(index(mesh.source(h))); !is_loose[r] || n_edges[r] >= min_edges)
        kept.push_back(h);
    n_noise = edges.size() - kept.size();
    edges = std::move(kept);
  }
};

} // namespace internal
} // namespace Quadrille

#endif
