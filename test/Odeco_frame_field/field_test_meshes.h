// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_FIELD_TEST_MESHES_H
#define QUADRILLE_TEST_FIELD_TEST_MESHES_H

#include <Quadrille/Odeco_frame_field/internal/Planar_field.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <functional>
#include <vector>

namespace Quadrille_test {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_2>;

struct Triangles {
  std::vector<Eigen::Vector2d> points;
  std::vector<std::array<int, 3>> faces;

  Quadrille::internal::Indexed_triangulation indexed() const { return {points.size(), faces}; }

  Mesh surface_mesh() const
  {
    Mesh mesh;
    for (const Eigen::Vector2d& p : points)
      mesh.add_vertex(Kernel::Point_2(p.x(), p.y()));
    for (const auto& f : faces)
      mesh.add_face(Mesh::Vertex_index(unsigned(f[0])), Mesh::Vertex_index(unsigned(f[1])),
                    Mesh::Vertex_index(unsigned(f[2])));
    return mesh;
  }
};

/// The image of an n x m grid on [0, 1]^2, diagonals in turn, so that every corner has two triangles or one diagonal.
inline Triangles grid(int n, int m, const std::function<Eigen::Vector2d(double, double)>& place)
{
  Triangles result;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i)
      result.points.push_back(place(double(i) / n, double(j) / m));
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      if ((i + j) % 2 == 0) {
        result.faces.push_back({a, b, c});
        result.faces.push_back({a, c, d});
      } else {
        result.faces.push_back({a, b, d});
        result.faces.push_back({b, c, d});
      }
    }
  return result;
}

inline Triangles square(int n, double side)
{
  return grid(n, n, [side](double x, double y) { return Eigen::Vector2d(side * x, side * y); });
}

/// A disk of radius 1 around a vertex: `rings` rings of 6, 12, 18, ... triangles' edges.
inline Triangles disk(int rings)
{
  Triangles result;
  result.points.push_back(Eigen::Vector2d::Zero());
  const double turn = 2 * std::acos(-1.0);
  const auto first = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  for (int ring = 1; ring <= rings; ++ring)
    for (int i = 0; i < 6 * ring; ++i) {
      const double t = turn * i / (6 * ring), r = double(ring) / rings;
      result.points.emplace_back(r * std::cos(t), r * std::sin(t));
    }
  for (int ring = 1; ring <= rings; ++ring) {
    const int n = 6 * ring, inner = 6 * (ring - 1);
    int j = 0;
    for (int i = 0; i < n; ++i) {
      const int a = first(ring) + i, b = first(ring) + (i + 1) % n;
      const int c = inner == 0 ? 0 : first(ring - 1) + j % inner;
      result.faces.push_back({a, b, c});
      if ((i + 1) % ring != 0) {
        result.faces.push_back({c, b, first(ring - 1) + (j + 1) % inner});
        ++j;
      }
    }
  }
  return result;
}

} // namespace Quadrille_test

#endif
