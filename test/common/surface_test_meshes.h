// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_COMMON_SURFACE_TEST_MESHES_H
#define QUADRILLE_TEST_COMMON_SURFACE_TEST_MESHES_H

#include <Quadrille/Support/internal/Indexed_triangulation.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace Quadrille_test {

inline constexpr double two_pi = 6.28318530717958647692;

using Space_mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

/// A triangulated surface in space as plain arrays.
struct Space_triangles {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> faces;

  Quadrille::internal::Indexed_triangulation indexed() const { return {points.size(), faces}; }

  Eigen::Vector3d doubled_normal(std::size_t f) const
  {
    const Eigen::Vector3d& apex = points[std::size_t(faces[f][0])];
    return (points[std::size_t(faces[f][1])] - apex).cross(points[std::size_t(faces[f][2])] - apex);
  }
  double area() const
  {
    double sum = 0;
    for (std::size_t f = 0; f < faces.size(); ++f)
      sum += 0.5 * doubled_normal(f).norm();
    return sum;
  }

  Space_mesh surface_mesh() const
  {
    Space_mesh mesh;
    for (const Eigen::Vector3d& p : points)
      mesh.add_vertex({p.x(), p.y(), p.z()});
    const auto vertex = [](int v) { return Space_mesh::Vertex_index(Space_mesh::size_type(v)); };
    for (const auto& [a, b, c] : faces)
      mesh.add_face(vertex(a), vertex(b), vertex(c));
    return mesh;
  }
};

/// The image of an n x m grid on [0, 1]^2, diagonals in turn; its opposite sides are glued where it is `closed`.
inline Space_triangles space_grid(int n, int m, const std::function<Eigen::Vector3d(double, double)>& place,
                                  std::array<bool, 2> closed = {false, false})
{
  Space_triangles result;
  const int columns = closed[0] ? n : n + 1, rows = closed[1] ? m : m + 1;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      result.points.push_back(place(double(i) / n, double(j) / m));
  const auto at = [&](int i, int j) { return j % rows * columns + i % columns; };
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
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

/// Around the third axis, open at both ends, normals outwards.
inline Space_triangles cylinder(int n, int m, double radius, double height)
{
  return space_grid(n, m,
                    [=](double s, double t) {
                      return Eigen::Vector3d(radius * std::cos(two_pi * s), radius * std::sin(two_pi * s), height * t);
                    },
                    {true, false});
}

/// The cone z = slope r between two radii.
inline Space_triangles cone(int n, int m, double slope, double inner, double outer)
{
  return space_grid(n, m,
                    [=](double s, double t) {
                      const double r = inner + t * (outer - inner);
                      return Eigen::Vector3d(r * std::cos(two_pi * s), r * std::sin(two_pi * s), slope * r);
                    },
                    {true, false});
}

/// Around the third axis, normals outwards.
inline Space_triangles torus(int n, int m, double major, double minor)
{
  return space_grid(n, m,
                    [=](double s, double t) {
                      const double r = major + minor * std::cos(two_pi * t);
                      return Eigen::Vector3d(r * std::cos(two_pi * s), r * std::sin(two_pi * s),
                                             minor * std::sin(two_pi * t));
                    },
                    {true, true});
}

/// The unit sphere: the faces of an icosahedron in n^2 triangles each.
inline Space_triangles icosphere(int n)
{
  const double g = 0.5 * (1 + std::sqrt(5.0));
  const Eigen::Vector3d corners[12] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                       {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  const int faces[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                            {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                            {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  Space_triangles result;
  std::map<std::map<int, int>, int> index; // by the steps towards each corner
  for (const auto& face : faces) {
    const auto vertex = [&](int i, int j) {
      std::map<int, int> steps;
      const int weights[3] = {n - i - j, i, j};
      Eigen::Vector3d p = Eigen::Vector3d::Zero();
      for (int k = 0; k < 3; ++k)
        if (weights[k] > 0) {
          steps[face[k]] = weights[k];
          p += weights[k] * corners[face[k]];
        }
      const auto [place, is_new] = index.emplace(steps, int(result.points.size()));
      if (is_new)
        result.points.push_back(p.normalized());
      return place->second;
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        result.faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
        if (i + j + 1 < n)
          result.faces.push_back({vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      }
  }
  return result;
}

/// The surface of [0, 1]^3 in n x n cells per side.
inline Space_triangles cube(int n)
{
  Space_triangles result;
  std::map<std::array<int, 3>, int> index;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, n}) {
      const auto vertex = [&](int i, int j) {
        std::array<int, 3> steps;
        steps[axis] = side;
        steps[(axis + 1) % 3] = side > 0 ? i : j; // normals outwards
        steps[(axis + 2) % 3] = side > 0 ? j : i;
        const auto [place, is_new] = index.emplace(steps, int(result.points.size()));
        if (is_new)
          result.points.push_back(Eigen::Vector3d(steps[0], steps[1], steps[2]) / n);
        return place->second;
      };
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
          if ((i + j) % 2 == 0) {
            result.faces.push_back({a, b, c});
            result.faces.push_back({a, c, d});
          } else {
            result.faces.push_back({a, b, d});
            result.faces.push_back({b, c, d});
          }
        }
    }
  return result;
}

/// Whether the faces at an inner edge are turned against each other by more than 30 degrees; for halfedges of
/// `mesh.indexed()`.
inline bool is_crease(const Space_triangles& mesh, const Quadrille::internal::Indexed_triangulation& indexed, int h)
{
  const int other = indexed.opposite(h);
  if (other < 0)
    return false;
  const Eigen::Vector3d a = mesh.doubled_normal(std::size_t(h / 3)), b = mesh.doubled_normal(std::size_t(other / 3));
  return a.dot(b) < std::cos(two_pi / 12) * a.norm() * b.norm();
}

/// Two surfaces as one.
inline Space_triangles united(Space_triangles a, const Space_triangles& b)
{
  const int shift = int(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& f : b.faces)
    a.faces.push_back({f[0] + shift, f[1] + shift, f[2] + shift});
  return a;
}

/// Every point p becomes scale R p + shift.
inline Space_triangles moved(Space_triangles mesh, const Eigen::Matrix3d& R, double scale = 1,
                             const Eigen::Vector3d& shift = Eigen::Vector3d::Zero())
{
  for (Eigen::Vector3d& p : mesh.points)
    p = scale * (R * p) + shift;
  return mesh;
}

inline const Eigen::Matrix3d some_rotation = Eigen::Quaterniond(0.3, -0.6, 0.5, 0.2).normalized().toRotationMatrix();

} // namespace Quadrille_test

#endif
