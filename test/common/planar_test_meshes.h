// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_COMMON_PLANAR_TEST_MESHES_H
#define QUADRILLE_TEST_COMMON_PLANAR_TEST_MESHES_H

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace Quadrille {
namespace test {

inline constexpr double pi = 3.14159265358979323846;

/// A planar triangle mesh as plain arrays, counterclockwise.
struct Planar_mesh {
  std::vector<Eigen::Vector2d> points;
  std::vector<std::array<int, 3>> triangles;

  Eigen::Vector2d centroid(std::size_t f) const
  {
    const auto& [a, b, c] = triangles[f];
    return (points[std::size_t(a)] + points[std::size_t(b)] + points[std::size_t(c)]) / 3.0;
  }
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Planar_surface_mesh = CGAL::Surface_mesh<Kernel::Point_2>;

inline Planar_surface_mesh to_surface_mesh(const Planar_mesh& mesh)
{
  Planar_surface_mesh result;
  for (const Eigen::Vector2d& p : mesh.points)
    result.add_vertex(Kernel::Point_2(p.x(), p.y()));
  using Vertex = Planar_surface_mesh::Vertex_index;
  using Size = Planar_surface_mesh::size_type;
  for (const auto& [a, b, c] : mesh.triangles)
    result.add_face(Vertex(Size(a)), Vertex(Size(b)), Vertex(Size(c)));
  return result;
}

/// [0, width] x [0, height] in nx x ny cells of two triangles each, with alternating diagonals.
inline Planar_mesh rectangle_mesh(int nx, int ny, double width = 1.0, double height = 1.0)
{
  Planar_mesh mesh;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      mesh.points.emplace_back(width * i / nx, height * j / ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i;
      const int b = a + 1;
      const int c = b + nx + 1;
      const int d = a + nx + 1;
      if ((i + j) % 2 == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
  return mesh;
}

/// Rings of nt vertices between two radii in geometric progression.
inline Planar_mesh annulus_mesh(int nr, int nt, double inner = 1.0, double outer = 2.0)
{
  Planar_mesh mesh;
  for (int j = 0; j <= nr; ++j)
    for (int i = 0; i < nt; ++i) {
      const double r = inner * std::pow(outer / inner, double(j) / nr);
      const double t = 2.0 * pi * (i + 0.5 * (j % 2)) / nt;
      mesh.points.emplace_back(r * std::cos(t), r * std::sin(t));
    }
  for (int j = 0; j < nr; ++j)
    for (int i = 0; i < nt; ++i) {
      const int a = j * nt + i;
      const int b = j * nt + (i + 1) % nt;
      const int c = a + nt;
      const int d = b + nt;
      if (j % 2 == 0) {
        mesh.triangles.push_back({a, c, b});
        mesh.triangles.push_back({b, c, d});
      } else {
        mesh.triangles.push_back({a, c, d});
        mesh.triangles.push_back({a, d, b});
      }
    }
  return mesh;
}

/// A disk around the origin: `rings` rings of 6, 12, 18, ... vertices around one in the centre (vertex 0).
inline Planar_mesh disk_mesh(int rings, double radius = 1.0)
{
  Planar_mesh mesh;
  mesh.points.emplace_back(0.0, 0.0);
  const auto vertex = [](int ring, int i) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1) + i % (6 * ring); };
  for (int ring = 1; ring <= rings; ++ring)
    for (int i = 0; i < 6 * ring; ++i) {
      const double t = 2.0 * pi * i / (6 * ring);
      mesh.points.emplace_back(radius * ring / rings * std::cos(t), radius * ring / rings * std::sin(t));
    }
  for (int ring = 1; ring <= rings; ++ring)
    for (int sector = 0; sector < 6; ++sector)
      for (int i = 0; i < ring; ++i) {
        const int outer = vertex(ring, sector * ring + i);
        const int outer_next = vertex(ring, sector * ring + i + 1);
        const int inner = vertex(ring - 1, sector * (ring - 1) + i);
        mesh.triangles.push_back({outer, outer_next, inner});
        if (i + 1 < ring)
          mesh.triangles.push_back({inner, outer_next, vertex(ring - 1, sector * (ring - 1) + i + 1)});
      }
  return mesh;
}

/// `quadrants` unit squares of n x n cells glued around the origin (vertex 0) and made flat by z = w^(4/quadrants):
/// bounded by isolines of u + i v = z^(quadrants/4), which maps it back.
inline Planar_mesh glued_squares_mesh(int quadrants, int n)
{
  Planar_mesh mesh;
  std::map<std::array<int, 3>, int> index; // square, steps along its first and second side
  const auto vertex = [&](int square, int a, int b) {
    if (a == 0) { // on the next square's first side
      square = b == 0 ? 0 : (square + 1) % quadrants;
      a = b;
      b = 0;
    }
    const auto [place, is_new] = index.emplace(std::array<int, 3>{square, a, b}, int(mesh.points.size()));
    if (is_new) {
      const double radius = std::pow(std::hypot(double(a) / n, double(b) / n), 4.0 / quadrants);
      const double angle = (square * 0.5 * pi + std::atan2(double(b), double(a))) * 4.0 / quadrants;
      mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return place->second;
  };
  vertex(0, 0, 0);
  for (int square = 0; square < quadrants; ++square)
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) { // the diagonals point to the origin: no triangle has both sides on the boundary
        const std::array<int, 4> q = {vertex(square, a, b), vertex(square, a + 1, b), vertex(square, a + 1, b + 1),
                                      vertex(square, a, b + 1)};
        mesh.triangles.push_back({q[0], q[1], q[2]});
        mesh.triangles.push_back({q[0], q[2], q[3]});
      }
  return mesh;
}

/// Delaunay mesh of a domain bounded by polygons (the domain is where the winding parity is odd), refined to `size`.
/// Points of `inner_points` become vertices; `inner_edges` (pairs of their indices) become edge chains.
inline Planar_mesh delaunay_mesh(const std::vector<std::vector<Eigen::Vector2d>>& polygons, double size,
                                 const std::vector<Eigen::Vector2d>& inner_points = {},
                                 const std::vector<std::pair<int, int>>& inner_edges = {})
{
  using Vertex_base = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
  using Face_base = CGAL::Delaunay_mesh_face_base_2<Kernel>;
  using Structure = CGAL::Triangulation_data_structure_2<Vertex_base, Face_base>;
  using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure>;
  using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;
  const auto to_point = [](const Eigen::Vector2d& p) { return Kernel::Point_2(p.x(), p.y()); };
  Triangulation triangulation;
  for (const auto& polygon : polygons)
    for (std::size_t i = 0; i < polygon.size(); ++i)
      triangulation.insert_constraint(to_point(polygon[i]), to_point(polygon[(i + 1) % polygon.size()]));
  for (const Eigen::Vector2d& p : inner_points)
    triangulation.insert(to_point(p));
  for (const auto& [i, j] : inner_edges)
    triangulation.insert_constraint(to_point(inner_points[std::size_t(i)]), to_point(inner_points[std::size_t(j)]));
  // Seeds would have to be known; the parity of boundary crossings to the left tells what is inside.
  const auto inside = [&](const Eigen::Vector2d& p) {
    bool odd = false;
    for (const auto& polygon : polygons)
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Eigen::Vector2d& a = polygon[i];
        const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
        if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
          odd = !odd;
      }
    return odd;
  };
  const auto centroid = [](Triangulation::Face_handle f) {
    Eigen::Vector2d sum(0.0, 0.0);
    for (int i = 0; i < 3; ++i)
      sum += Eigen::Vector2d(f->vertex(i)->point().x(), f->vertex(i)->point().y()) / 3.0;
    return sum;
  };
  std::vector<Kernel::Point_2> seeds;
  for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f)
    if (inside(centroid(f)))
      seeds.push_back(to_point(centroid(f)));
  CGAL::Delaunay_mesher_2<Triangulation, Criteria> mesher(triangulation, Criteria(0.125, size));
  mesher.set_seeds(seeds.begin(), seeds.end(), true);
  mesher.refine_mesh();

  Planar_mesh mesh;
  std::map<Triangulation::Vertex_handle, int> index;
  for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v) {
    index[v] = int(mesh.points.size());
    mesh.points.emplace_back(v->point().x(), v->point().y());
  }
  for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f)
    if (f->is_in_domain())
      mesh.triangles.push_back({index[f->vertex(0)], index[f->vertex(1)], index[f->vertex(2)]});
  return mesh;
}

/// A polygon inscribed in a circle, counterclockwise.
inline std::vector<Eigen::Vector2d> circle_polygon(const Eigen::Vector2d& centre, double radius, int n)
{
  std::vector<Eigen::Vector2d> polygon;
  for (int i = 0; i < n; ++i)
    polygon.emplace_back(centre + radius * Eigen::Vector2d(std::cos(2.0 * pi * i / n), std::sin(2.0 * pi * i / n)));
  return polygon;
}

/// The L of three unit squares around the concave corner (1, 1).
inline Planar_mesh l_shape_mesh(double size)
{
  return delaunay_mesh({{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}}, size);
}

/// The plate [0, 4] x [0, 2] with three round holes.
inline Planar_mesh plate_with_holes_mesh(double size)
{
  const auto hole = [&](double x, double y, double r) {
    return circle_polygon({x, y}, r, std::max(12, int(std::ceil(2.0 * pi * r / size))));
  };
  return delaunay_mesh(
      {{{0, 0}, {4, 0}, {4, 2}, {0, 2}}, hole(0.8, 1.0, 0.35), hole(2.1, 0.7, 0.3), hole(3.2, 1.2, 0.4)}, size);
}

/// The same mesh with its vertices and triangles in another order, and its triangles' corners rotated.
inline Planar_mesh relabelled(const Planar_mesh& mesh, unsigned seed)
{
  std::mt19937 generator(seed);
  std::vector<int> order(mesh.points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = int(i);
  for (std::size_t i = order.size() - 1; i > 0; --i) // not std::shuffle, whose result the standard leaves open
    std::swap(order[i], order[generator() % (i + 1)]);
  Planar_mesh result;
  result.points.resize(mesh.points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    result.points[std::size_t(order[i])] = mesh.points[i];
  for (const auto& triangle : mesh.triangles) {
    const std::size_t turn = generator() % 3;
    result.triangles.push_back({order[std::size_t(triangle[turn])], order[std::size_t(triangle[(turn + 1) % 3])],
                                order[std::size_t(triangle[(turn + 2) % 3])]});
  }
  for (std::size_t i = result.triangles.size() - 1; i > 0; --i)
    std::swap(result.triangles[i], result.triangles[generator() % (i + 1)]);
  return result;
}

/// Every point p becomes `scale` R p + shift, R the rotation by `angle`.
inline Planar_mesh transformed(Planar_mesh mesh, double angle, double scale,
                               const Eigen::Vector2d& shift = Eigen::Vector2d(0.0, 0.0))
{
  Eigen::Matrix2d rotation;
  rotation << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  for (Eigen::Vector2d& p : mesh.points)
    p = scale * (rotation * p) + shift;
  return mesh;
}

} // namespace test
} // namespace Quadrille

#endif
