// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_QUAD_EXTRACTION_GLUED_RECTANGLES_H
#define QUADRILLE_TEST_QUAD_EXTRACTION_GLUED_RECTANGLES_H

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace quad_extraction_test {

using Point = std::array<double, 2>;

/// A triangulated domain in the plane or in space with an exactly seamless map, as index arrays (corner = halfedge
/// 3 f + i).
template <std::size_t D> struct Mapped_mesh_in {
  std::vector<std::array<double, D>> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<Point> corner_uv;
  std::vector<int> curve;  // by halfedge, -1 inside
  std::vector<int> region; // by triangle

  void scale_and_rotate(double scale, double angle)
  {
    for (Point& p : points)
      p = {scale * (std::cos(angle) * p[0] - std::sin(angle) * p[1]),
           scale * (std::sin(angle) * p[0] + std::cos(angle) * p[1])};
  }
};
using Mapped_mesh = Mapped_mesh_in<2>;

inline double snapped(double x) { return std::round(std::ldexp(x, 30)) / std::ldexp(1.0, 30); }

/// Rectangles glued along whole sides: a coarse quad mesh whose cells are mapped bilinearly and are exact
/// rectangles in the map. Every singularity, corner and feature is chosen by how the cells are glued.
template <std::size_t D> struct Glued_rectangles_in {
  using Place = std::array<double, D>;
  using Mapped_mesh = Mapped_mesh_in<D>;

  std::vector<Place> corners;
  std::vector<std::array<int, 4>> cells;
  /// Map length of the coarse edge between corners `a` and `b`; must agree on opposite sides of each cell.
  std::function<double(int a, int b)> length = [](int, int) { return 3.7; };
  /// Curve id of a coarse edge; inner edges with an id are features. Border edges must have one.
  std::function<int(int a, int b, bool border)> curve = [](int, int, bool border) { return border ? 0 : -1; };
  std::function<int(int cell)> region = [](int) { return 0; };
  /// Shape of the cells: applied to the bilinear position.
  std::function<Place(const Place&)> shape = [](const Place& p) { return p; };
  int subdivisions = 4;
  double jitter = 0.2; // of a cell's inner vertices, relative to their distance
  unsigned seed = 1;

  Mapped_mesh build() const
  {
    Mapped_mesh mesh;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> noise(-jitter, jitter);
    std::map<std::pair<int, int>, int> uses;
    for (const auto& cell : cells)
      for (std::size_t i = 0; i < 4; ++i)
        ++uses[std::minmax(cell[i], cell[(i + 1) % 4])];

    const int n = subdivisions;
    std::map<std::array<int, 3>, int> edge_vertex; // (a < b, step from a)
    std::map<int, int> corner_vertex;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto& cell = cells[c];
      const double lu = snapped(length(cell[0], cell[1]));
      const double lv = snapped(length(cell[1], cell[2]));
      const auto bilinear = [&](double x, double y) {
        Place p;
        for (std::size_t d = 0; d < D; ++d)
          p[d] = (1 - y) * ((1 - x) * at(cell[0])[d] + x * at(cell[1])[d]) +
                 y * ((1 - x) * at(cell[3])[d] + x * at(cell[2])[d]);
        return shape(p);
      };
      std::vector<int> id(std::size_t((n + 1) * (n + 1)));
      std::vector<Point> uv(id.size());
      const auto index = [n](int i, int j) { return std::size_t(j * (n + 1) + i); };
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
          double x = double(i) / n;
          double y = double(j) / n;
          const bool inner = i > 0 && i < n && j > 0 && j < n;
          if (inner) {
            x += noise(random) / n;
            y += noise(random) / n;
          }
          // The same step along a shared side must give the same value seen from both ends.
          const auto coordinate = [](double l, double t) {
            return t < 0.5 ? snapped(t * l) : l - snapped((1 - t) * l);
          };
          uv[index(i, j)] =
              inner ? Point{snapped(x * lu), snapped(y * lv)} : Point{coordinate(lu, x), coordinate(lv, y)};
          int& vertex = id[index(i, j)];
          if (inner) {
            vertex = new_vertex(mesh, bilinear(x, y));
          } else if ((i == 0 || i == n) && (j == 0 || j == n)) {
            const int corner = cell[std::size_t(j == 0 ? (i == 0 ? 0 : 1) : (i == 0 ? 3 : 2))];
            const auto found = corner_vertex.find(corner);
            vertex = found != corner_vertex.end() ? found->second : new_vertex(mesh, shape(at(corner)));
            corner_vertex[corner] = vertex;
          } else {
            const std::size_t side = j == 0 ? 0 : i == n ? 1 : j == n ? 2 : 3;
            const int step = side == 0 ? i : side == 1 ? j : side == 2 ? n - i : n - j;
            const int a = cell[side];
            const int b = cell[(side + 1) % 4];
            const std::array<int, 3> key = a < b ? std::array<int, 3>{a, b, step} : std::array<int, 3>{b, a, n - step};
            const auto found = edge_vertex.find(key);
            vertex = found != edge_vertex.end() ? found->second : new_vertex(mesh, bilinear(x, y));
            edge_vertex[key] = vertex;
          }
        }
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const std::array<std::size_t, 4> q = {index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)};
          const std::size_t first = (i + j) % 2 ? 0 : 1;
          for (const std::size_t shift : {std::size_t(0), std::size_t(2)}) {
            std::array<int, 3> triangle;
            for (std::size_t k = 0; k < 3; ++k) {
              const std::size_t corner = q[(first + shift + k) % 4];
              triangle[k] = id[corner];
              mesh.corner_uv.push_back(uv[corner]);
            }
            mesh.triangles.push_back(triangle);
            mesh.region.push_back(region(static_cast<int>(c)));
            for (std::size_t k = 0; k < 3; ++k) {
              const std::size_t from = q[(first + shift + k) % 4];
              const std::size_t to = q[(first + shift + (k + 1) % 3) % 4];
              mesh.curve.push_back(curve_of(cell, n, from, to, uses));
            }
          }
        }
    }
    return mesh;
  }

private:
  const Place& at(int corner) const { return corners[std::size_t(corner)]; }

  static int new_vertex(Mapped_mesh& mesh, const Place& p)
  {
    mesh.points.push_back(p);
    return static_cast<int>(mesh.points.size()) - 1;
  }

  int curve_of(const std::array<int, 4>& cell, int n, std::size_t from, std::size_t to,
               const std::map<std::pair<int, int>, int>& uses) const
  {
    const int row = n + 1;
    const int i0 = static_cast<int>(from) % row, j0 = static_cast<int>(from) / row;
    const int i1 = static_cast<int>(to) % row, j1 = static_cast<int>(to) / row;
    std::size_t side = 4;
    if (j0 == 0 && j1 == 0)
      side = 0;
    else if (i0 == n && i1 == n)
      side = 1;
    else if (j0 == n && j1 == n)
      side = 2;
    else if (i0 == 0 && i1 == 0)
      side = 3;
    if (side == 4)
      return -1;
    const int a = cell[side];
    const int b = cell[(side + 1) % 4];
    return curve(a, b, uses.at(std::minmax(a, b)) == 1);
  }
};

using Glued_rectangles = Glued_rectangles_in<2>;
using Glued_rectangles_in_space = Glued_rectangles_in<3>;

/// A block of nx times ny unit cells; corner (i, j) has index j (nx + 1) + i. `keep` chooses the cells.
inline Glued_rectangles cell_grid(int nx, int ny, const std::function<bool(int, int)>& keep = {})
{
  Glued_rectangles grid;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      grid.corners.push_back({double(i), double(j)});
  const auto corner = [nx](int i, int j) { return j * (nx + 1) + i; };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      if (!keep || keep(i, j))
        grid.cells.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
  return grid;
}

/// `valence` cells around corner 0: one interior singularity (or none for 4), and a convex corner per cell.
inline Glued_rectangles star(int valence)
{
  Glued_rectangles result;
  result.corners.push_back({0, 0});
  const double pi = std::acos(-1.0);
  for (int i = 0; i < 2 * valence; ++i) {
    const double radius = i % 2 ? 10 * std::sqrt(2.0) : 10;
    const double angle = pi * i / valence;
    result.corners.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  for (int i = 0; i < valence; ++i)
    result.cells.push_back({0, 1 + 2 * i, 2 + 2 * i, 1 + (2 * i + 2) % (2 * valence)});
  return result;
}

} // namespace quad_extraction_test

#endif
