// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_TETRAHEDRAL_MESH_CHECKER_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_TETRAHEDRAL_MESH_CHECKER_H

#include <Quadrille/Volumetric_cross_field/internal/Tetrahedron_adjacency.h>
#include <Quadrille/exceptions.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

/// See `check_tetrahedral_mesh`.
template <class Mesh> class Tetrahedral_mesh_checker {
public:
  explicit Tetrahedral_mesh_checker(const Mesh& mesh) : m_mesh(mesh) {}

  void check()
  {
    if (m_mesh.number_of_tetrahedra() == 0)
      throw Invalid_input_error("the mesh has no tetrahedra");
    check_vertices();
    for (std::size_t t = 0; t < m_mesh.number_of_tetrahedra(); ++t)
      check_tetrahedron(t);
    check_boundary(boundary_faces(m_mesh, Tetrahedron_adjacency(m_mesh)));
  }

private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

  void check_vertices() const
  {
    const std::size_t n = m_mesh.number_of_vertices();
    std::vector<char> is_used(n, 0);
    for (std::size_t t = 0; t < m_mesh.number_of_tetrahedra(); ++t)
      for (const int v : corners_of(m_mesh, t)) {
        if (v < 0 || std::size_t(v) >= n)
          throw Invalid_input_error("tetrahedron " + std::to_string(t) + " uses vertex " + std::to_string(v) +
                                    ", which does not exist");
        is_used[std::size_t(v)] = 1;
      }
    for (std::size_t v = 0; v < n; ++v) {
      if (!is_used[v])
        throw Invalid_input_error("vertex " + described(int(v)) + " belongs to no tetrahedron. Remove it");
      if (!point(int(v)).allFinite())
        throw Invalid_input_error("vertex " + described(int(v)) + " has a coordinate that is not a finite number");
    }
  }

  void check_tetrahedron(std::size_t t) const
  {
    const std::array<int, 4> corners = corners_of(m_mesh, t);
    std::array<Kernel::Point_3, 4> p;
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector3d x = point(corners[i]);
      p[i] = Kernel::Point_3(x[0], x[1], x[2]);
    }
    const CGAL::Orientation orientation = CGAL::orientation(p[0], p[1], p[2], p[3]);
    if (orientation == CGAL::NEGATIVE)
      fail(t, "is inverted. Mesh the volume again, or give its corners in positive orientation");
    double longest = 0;
    for (const auto& edge : corners_of_edges)
      longest = std::max(longest, (point(corners[std::size_t(edge[0])]) - point(corners[std::size_t(edge[1])])).norm());
    Eigen::Matrix3d edges;
    for (int i = 0; i < 3; ++i)
      edges.col(i) = (point(corners[std::size_t(i + 1)]) - point(corners[0])) / longest;
    if (orientation == CGAL::ZERO || !(edges.determinant() > 6e-12))
      fail(t, "is degenerate: its corners lie in a plane. Improve the mesh");
  }

  void check_boundary(const std::vector<std::array<int, 3>>& faces) const
  {
    // Edges from their first to their second vertex, each of which the face on its other side has the other way.
    std::map<std::array<int, 2>, int> edges;
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::array<int, 2> edge = {faces[f][i], faces[f][(i + 1) % 3]};
        if (!edges.emplace(edge, int(f)).second)
          throw Invalid_input_error("the boundary touches itself along the edge from vertex " + described(edge[0]) +
                                    " to vertex " + described(edge[1]) +
                                    ": it is not manifold. Separate the parts, or join them by a face");
      }
    std::vector<int> fans(m_mesh.number_of_vertices(), 0), sizes(fans);
    for (const auto& face : faces)
      for (const int v : face)
        ++sizes[std::size_t(v)];
    for (const auto& face : faces)
      for (std::size_t i = 0; i < 3; ++i) {
        if (fans[std::size_t(face[i])] != 0)
          continue;
        fans[std::size_t(face[i])] = size_of_fan(faces, edges, face[i], face[(i + 1) % 3]);
        if (fans[std::size_t(face[i])] != sizes[std::size_t(face[i])])
          throw Invalid_input_error("the boundary touches itself at vertex " + described(face[i]) +
                                    ": it is not manifold. Separate the parts, or join them by a face");
      }
  }

  /// The number of faces around `v`, from the one with the edge from v to `next` on.
  static int size_of_fan(const std::vector<std::array<int, 3>>& faces, const std::map<std::array<int, 2>, int>& edges,
                         int v, int next)
  {
    int size = 0;
    const int start = next;
    do {
      const std::array<int, 3>& face = faces[std::size_t(edges.at({v, next}))];
      for (std::size_t i = 0; i < 3; ++i)
        if (face[i] == v)
          next = face[(i + 2) % 3];
      ++size;
    } while (next != start);
    return size;
  }

  Eigen::Vector3d point(int v) const { return m_mesh.point(std::size_t(v)); }

  std::string described(int v) const
  {
    const Eigen::Vector3d p = point(v);
    std::ostringstream text;
    text << v << " at (" << p[0] << ", " << p[1] << ", " << p[2] << ")";
    return text.str();
  }

  [[noreturn]] void fail(std::size_t t, const std::string& reason) const
  {
    throw Invalid_input_error("tetrahedron " + std::to_string(t) + " with a corner at vertex " +
                              described(corners_of(m_mesh, t)[0]) + " " + reason);
  }

  const Mesh& m_mesh;
};

} // namespace internal
} // namespace Quadrille

#endif
