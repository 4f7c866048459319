// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_COMMON_TETRAHEDRAL_TEST_MESHES_H
#define QUADRILLE_TEST_COMMON_TETRAHEDRAL_TEST_MESHES_H

#include <Quadrille/Tetrahedral_mesh.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <set>
#include <type_traits>
#include <vector>

/// A box from the origin to `size`, of n[0] x n[1] x n[2] cells each divided into six tetrahedra around a diagonal; the
/// edges of the whole are features. With `is_mirrored` the eight octants of the box are mirror images, the diagonals
/// leading to its corners, so that no tetrahedron has two faces on the boundary. \pre then all n[i] are even.
inline Quadrille::Tetrahedral_mesh box_of_tetrahedra(const std::array<int, 3>& n, const Eigen::Vector3d& size,
                                                     bool is_mirrored = false)
{
  Quadrille::Tetrahedral_mesh mesh;
  const auto vertex = [&](int i, int j, int k) { return (k * (n[1] + 1) + j) * (n[0] + 1) + i; };
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i)
        mesh.points.push_back({size[0] * i / n[0], size[1] * j / n[1], size[2] * k / n[2]});
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        int turned = 0; // bits: the directions in which the cell is mirrored
        if (is_mirrored)
          turned = (2 * i < n[0] ? 0 : 1) + (2 * j < n[1] ? 0 : 2) + (2 * k < n[2] ? 0 : 4);
        const bool is_odd = turned == 1 || turned == 2 || turned == 4 || turned == 7;
        std::array<int, 8> c;
        for (int m = 0; m < 8; ++m)
          c[std::size_t(m ^ turned)] = vertex(i + m % 2, j + m / 2 % 2, k + m / 4);
        for (const auto& [p, q] : {std::array{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}})
          mesh.tetrahedra.push_back({c[0], c[std::size_t(is_odd ? q : p)], c[std::size_t(is_odd ? p : q)], c[7]});
      }
  for (const int p : {0, 1})
    for (const int q : {0, 1}) {
      for (int i = 0; i < n[0]; ++i)
        mesh.feature_edges.push_back({vertex(i, p * n[1], q * n[2]), vertex(i + 1, p * n[1], q * n[2])});
      for (int j = 0; j < n[1]; ++j)
        mesh.feature_edges.push_back({vertex(p * n[0], j, q * n[2]), vertex(p * n[0], j + 1, q * n[2])});
      for (int k = 0; k < n[2]; ++k)
        mesh.feature_edges.push_back({vertex(p * n[0], q * n[1], k), vertex(p * n[0], q * n[1], k + 1)});
    }
  return mesh;
}

/// n x n x n such cells.
inline Quadrille::Tetrahedral_mesh cube_of_tetrahedra(int n, double side = 1)
{
  return box_of_tetrahedra({n, n, n}, {side, side, side});
}

/// With every point moved to map(point).
template <class Map> Quadrille::Tetrahedral_mesh mapped(Quadrille::Tetrahedral_mesh mesh, const Map& map)
{
  static_assert(std::is_same<decltype(map(mesh.point(0))), Eigen::Vector3d>::value,
                "expressions may refer to what no longer exists");
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    Eigen::Vector3d::Map(mesh.points[v].data()) = map(mesh.point(v));
  return mesh;
}

/// The ball of radius 1 around the origin: a cube of n x n x n cells whose cubes around the centre become spheres.
/// \pre n is even.
inline Quadrille::Tetrahedral_mesh ball_of_tetrahedra(int n)
{
  return mapped(box_of_tetrahedra({n, n, n}, {2, 2, 2}, true), [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    const Eigen::Vector3d q = p - Eigen::Vector3d::Ones();
    const double length = q.norm();
    return length > 0 ? Eigen::Vector3d(q.cwiseAbs().maxCoeff() / length * q) : q;
  });
}

/// A triangulated disk, to be extruded.
struct Planar_triangles {
  std::vector<Eigen::Vector2d> points;
  std::vector<std::array<int, 3>> triangles; ///< counterclockwise
};

/// A convex polygon: n rings around the mean of its corners, which are given counterclockwise.
inline Planar_triangles polygon_of_triangles(const std::vector<Eigen::Vector2d>& corners, int n)
{
  const int sides = int(corners.size());
  Planar_triangles result;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : corners)
    center += corner / double(sides);
  const auto vertex = [&](int ring, int i) {
    return ring == 0 ? 0 : 1 + sides * ring * (ring - 1) / 2 + i % (sides * ring);
  };
  result.points.push_back(center);
  for (int ring = 1; ring <= n; ++ring)
    for (int side = 0; side < sides; ++side)
      for (int i = 0; i < ring; ++i) {
        const Eigen::Vector2d &a = corners[std::size_t(side)], &b = corners[std::size_t((side + 1) % sides)];
        result.points.push_back(center + double(ring) / n * (a + double(i) / ring * (b - a) - center));
        const int inner = side * (ring - 1) + i, outer = side * ring + i;
        result.triangles.push_back({vertex(ring - 1, inner), vertex(ring, outer), vertex(ring, outer + 1)});
        if (i + 1 < ring)
          result.triangles.push_back({vertex(ring - 1, inner), vertex(ring, outer + 1), vertex(ring - 1, inner + 1)});
      }
  return result;
}

/// The corners of a regular polygon on the circle of radius 1.
inline std::vector<Eigen::Vector2d> regular_polygon(int corners)
{
  std::vector<Eigen::Vector2d> result;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / corners;
    result.emplace_back(std::cos(angle), std::sin(angle));
  }
  return result;
}

/// The disk of radius 1: n rings around the origin.
inline Planar_triangles disk_of_triangles(int n)
{
  constexpr int sides = 6;
  Planar_triangles result = polygon_of_triangles(regular_polygon(sides), n);
  std::size_t v = 1;
  for (int ring = 1; ring <= n; ++ring)
    for (int i = 0; i < sides * ring; ++i) {
      const double angle = 2 * std::acos(-1.0) * i / (sides * ring);
      result.points[v++] = double(ring) / n * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
  return result;
}

/// `layers` of prisms over triangles, each divided into three tetrahedra; `place` says where the point p of a triangle
/// comes to lie at the height 0 to 1. With `is_closed` the last layer ends where the first begins.
template <class Place>
Quadrille::Tetrahedral_mesh extruded(const Planar_triangles& base, int layers, bool is_closed, const Place& place)
{
  Quadrille::Tetrahedral_mesh mesh;
  for (int layer = 0; layer < layers + (is_closed ? 0 : 1); ++layer)
    for (const Eigen::Vector2d& p : base.points) {
      const Eigen::Vector3d q = place(p, double(layer) / layers);
      mesh.points.push_back({q[0], q[1], q[2]});
    }
  const int n = int(base.points.size());
  for (int layer = 0; layer < layers; ++layer)
    for (std::array<int, 3> t : base.triangles) {
      // Diagonals lead up from the smaller number. To begin with the smallest keeps the orientation.
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      const auto low = [&](std::size_t i) { return layer * n + t[i]; };
      const auto high = [&](std::size_t i) { return (layer + 1) % (is_closed ? layers : layers + 1) * n + t[i]; };
      mesh.tetrahedra.push_back({low(0), high(1), high(2), high(0)});
      if (t[1] < t[2]) {
        mesh.tetrahedra.push_back({low(0), low(1), low(2), high(2)});
        mesh.tetrahedra.push_back({low(0), low(1), high(2), high(1)});
      } else {
        mesh.tetrahedra.push_back({low(0), low(1), low(2), high(1)});
        mesh.tetrahedra.push_back({low(0), high(1), low(2), high(2)});
      }
    }
  return mesh;
}

/// A prism or cylinder of the given height.
inline Quadrille::Tetrahedral_mesh prism_of_tetrahedra(const Planar_triangles& base, int layers, double height)
{
  return extruded(base, layers, false,
                  [&](const Eigen::Vector2d& p, double t) { return Eigen::Vector3d(p[0], p[1], t * height); });
}

/// A solid torus: a disk of radius 1, of n rings, on its way around the z axis at a distance of `radius` > 1.
inline Quadrille::Tetrahedral_mesh torus_of_tetrahedra(int n, int layers, double radius)
{
  return extruded(disk_of_triangles(n), layers, true, [&](const Eigen::Vector2d& p, double t) {
    const double angle = 2 * std::acos(-1.0) * t;
    return Eigen::Vector3d((radius + p[0]) * std::cos(angle), (radius + p[0]) * std::sin(angle), -p[1]);
  });
}

/// Two meshes as one, without common vertices.
inline Quadrille::Tetrahedral_mesh both(Quadrille::Tetrahedral_mesh first, const Quadrille::Tetrahedral_mesh& second)
{
  const int n = int(first.points.size());
  first.points.insert(first.points.end(), second.points.begin(), second.points.end());
  for (const auto& [a, b, c, d] : second.tetrahedra)
    first.tetrahedra.push_back({a + n, b + n, c + n, d + n});
  for (const auto& [a, b] : second.feature_edges)
    first.feature_edges.push_back({a + n, b + n});
  return first;
}

/// What `keeps(center)` keeps of the tetrahedra, and the vertices that these use; no features.
template <class Predicate>
Quadrille::Tetrahedral_mesh part_of(const Quadrille::Tetrahedral_mesh& mesh, const Predicate& keeps)
{
  Quadrille::Tetrahedral_mesh part;
  std::vector<int> number(mesh.points.size(), -1);
  for (std::array<int, 4> t : mesh.tetrahedra) {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    for (const int v : t)
      center += mesh.point(std::size_t(v)) / 4;
    if (!keeps(center))
      continue;
    for (int& v : t) {
      int& new_number = number[std::size_t(v)];
      if (new_number < 0) {
        new_number = int(part.points.size());
        part.points.push_back(mesh.points[std::size_t(v)]);
      }
      v = new_number;
    }
    part.tetrahedra.push_back(t);
  }
  return part;
}

/// The faces that belong to one tetrahedron, sorted.
inline std::set<std::array<int, 3>> boundary_of(const Quadrille::Tetrahedral_mesh& mesh)
{
  std::set<std::array<int, 3>> open;
  for (const std::array<int, 4>& t : mesh.tetrahedra)
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<int, 3> face = {t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4]};
      std::sort(face.begin(), face.end());
      if (!open.insert(face).second)
        open.erase(face);
    }
  return open;
}

/// With the vertices inside moved at random by up to `distance` in each direction.
inline Quadrille::Tetrahedral_mesh jittered(Quadrille::Tetrahedral_mesh mesh, double distance, unsigned seed)
{
  std::vector<bool> is_inside(mesh.points.size(), true);
  for (const std::array<int, 3>& face : boundary_of(mesh))
    for (const int v : face)
      is_inside[std::size_t(v)] = false;
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> offset(-distance, distance);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    for (double& x : mesh.points[v])
      x += is_inside[v] ? offset(engine) : 0;
  return mesh;
}

/// The same with other numbers of vertices and tetrahedra and other, even, orders of corners; vertex v becomes
/// `new_number[v]`.
inline Quadrille::Tetrahedral_mesh relabelled(const Quadrille::Tetrahedral_mesh& mesh, unsigned seed,
                                              std::vector<int>& new_number)
{
  std::mt19937 engine(seed);
  new_number.resize(mesh.points.size());
  std::iota(new_number.begin(), new_number.end(), 0);
  std::shuffle(new_number.begin(), new_number.end(), engine);
  Quadrille::Tetrahedral_mesh result = mesh;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    result.points[std::size_t(new_number[v])] = mesh.points[v];
  for (std::array<int, 4>& t : result.tetrahedra) {
    for (int& v : t)
      v = new_number[std::size_t(v)];
    std::rotate(t.begin(), t.begin() + engine() % 3, t.begin() + 3);
    if (engine() % 2 != 0)
      t = {t[1], t[0], t[3], t[2]};
  }
  for (std::array<int, 2>& edge : result.feature_edges)
    edge = {new_number[std::size_t(edge[0])], new_number[std::size_t(edge[1])]};
  std::shuffle(result.tetrahedra.begin(), result.tetrahedra.end(), engine);
  return result;
}

inline double volume(const Quadrille::Tetrahedral_mesh& mesh, const std::array<int, 4>& t)
{
  const auto point = [&](std::size_t i) { return mesh.point(std::size_t(t[i])); };
  Eigen::Matrix3d edges;
  edges << point(1) - point(0), point(2) - point(0), point(3) - point(0);
  return edges.determinant() / 6;
}

inline double volume(const Quadrille::Tetrahedral_mesh& mesh)
{
  double sum = 0;
  for (const std::array<int, 4>& t : mesh.tetrahedra)
    sum += volume(mesh, t);
  return sum;
}

/// As a set: the corners of each in ascending order.
template <std::size_t n> std::set<std::array<int, n>> as_set(std::vector<std::array<int, n>> simplices)
{
  for (std::array<int, n>& corners : simplices)
    std::sort(corners.begin(), corners.end());
  return {simplices.begin(), simplices.end()};
}

#endif
