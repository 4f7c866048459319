// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_QUAD_EXTRACTION_EXTRACTION_HELPERS_H
#define QUADRILLE_TEST_QUAD_EXTRACTION_EXTRACTION_HELPERS_H

#include "glued_rectangles.h"

#include <Quadrille/Quad_extraction/internal/Layout_builder.h>
#include <Quadrille/quad_extraction.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace quad_extraction_test {

using Point_2 = CGAL::Simple_cartesian<double>::Point_2;
using Mesh = CGAL::Surface_mesh<Point_2>;

/// A layout with its map, from index arrays.
struct Traced {
  explicit Traced(const Mapped_mesh& mesh, Quadrille::Layout_kind kind = Quadrille::Layout_kind::base_complex,
                  std::size_t max_steps = 100000)
      : triangulation(mesh.points.size(), mesh.triangles), map(triangulation, mesh.corner_uv, mesh.curve, mesh.region),
        layout(Quadrille::internal::extraction::build_layout(map, std::vector<char>(mesh.points.size(), 0), kind,
                                                             max_steps))
  {
  }

  Quadrille::internal::Indexed_triangulation triangulation;
  Quadrille::internal::extraction::Seamless_map map;
  Quadrille::Quad_layout layout;
};

template <std::size_t D> struct Extracted_in {
  using Point = std::conditional_t<D == 2, Point_2, CGAL::Simple_cartesian<double>::Point_3>;

  CGAL::Surface_mesh<Point> quads;
  Quadrille::Quad_extraction_result result;
};
using Extracted = Extracted_in<2>;

/// Index arrays as a `CGAL::Surface_mesh` with property maps.
template <std::size_t D> struct Mapped_surface_mesh {
  using Mesh = CGAL::Surface_mesh<typename Extracted_in<D>::Point>;
  using Uv_map = typename Mesh::template Property_map<typename Mesh::Halfedge_index, Point_2>;

  explicit Mapped_surface_mesh(const Mapped_mesh_in<D>& mapped)
      : uv(add_uv_map("h:uv")),
        curve(mesh.template add_property_map<typename Mesh::Edge_index, int>("e:curve", -1).first),
        region(mesh.template add_property_map<typename Mesh::Face_index, int>("f:region", 0).first)
  {
    for (const auto& p : mapped.points)
      if constexpr (D == 2)
        mesh.add_vertex({p[0], p[1]});
      else
        mesh.add_vertex({p[0], p[1], p[2]});
    for (std::size_t f = 0; f < mapped.triangles.size(); ++f) {
      const auto vertex = [&](std::size_t i) {
        return typename Mesh::Vertex_index(unsigned(mapped.triangles[f][i % 3]));
      };
      const auto face = mesh.add_face(vertex(0), vertex(1), vertex(2));
      region[face] = mapped.region[f];
      for (std::size_t i = 0; i < 3; ++i) {
        const auto h = mesh.halfedge(vertex(i), vertex(i + 1));
        curve[mesh.edge(h)] = mapped.curve[3 * f + i];
        const Point& at_target = mapped.corner_uv[3 * f + (i + 1) % 3];
        uv[h] = Point_2(at_target[0], at_target[1]);
      }
    }
  }

  Uv_map add_uv_map(const char* name)
  {
    return mesh.template add_property_map<typename Mesh::Halfedge_index, Point_2>(name).first;
  }

  Mesh mesh;
  Uv_map uv;
  typename Mesh::template Property_map<typename Mesh::Edge_index, int> curve;
  typename Mesh::template Property_map<typename Mesh::Face_index, int> region;
};

/// Runs the public function on a `CGAL::Surface_mesh`.
template <std::size_t D, class Quantizer = Quadrille::Greedy_quantizer, class Projector = Quadrille::No_curve_projector>
Extracted_in<D> extract(const Mapped_mesh_in<D>& mapped, const Quadrille::Quad_extraction_options& options = {},
                        const Quantizer& quantizer = {}, const Projector& projector = {})
{
  const Mapped_surface_mesh<D> input(mapped);
  Extracted_in<D> extracted;
  extracted.result = Quadrille::extract_quads(input.mesh, input.mesh.points(), input.uv, input.curve, input.region,
                                              extracted.quads, options, quantizer, projector);
  return extracted;
}

inline bool has_convex_quads(const Mesh& mesh)
{
  for (const auto h : mesh.halfedges())
    if (!mesh.is_border(h) && CGAL::orientation(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                                mesh.point(mesh.target(mesh.next(h)))) != CGAL::LEFT_TURN)
      return false;
  return true;
}

template <class Quad_mesh> int euler_characteristic(const Quad_mesh& mesh)
{
  return int(mesh.number_of_vertices()) - int(mesh.number_of_edges()) + int(mesh.number_of_faces());
}

inline int euler_characteristic(const Quadrille::Quad_layout& layout)
{
  return int(layout.nodes.size()) - int(layout.arcs.size()) + int(layout.patches.size());
}

/// `count` cells around a hole with `layers` layers of cells: an annulus whose loops have no corners.
inline Glued_rectangles annulus(int count, int layers, double angular_length, double radial_length)
{
  Glued_rectangles result;
  const double pi = std::acos(-1.0);
  for (int layer = 0; layer <= layers; ++layer)
    for (int i = 0; i < count; ++i) {
      const double radius = 1.0 + layer;
      result.corners.push_back({radius * std::cos(2 * pi * i / count), radius * std::sin(2 * pi * i / count)});
    }
  for (int layer = 0; layer < layers; ++layer)
    for (int i = 0; i < count; ++i) {
      const int j = (i + 1) % count;
      result.cells.push_back({layer * count + i, (layer + 1) * count + i, (layer + 1) * count + j, layer * count + j});
    }
  result.length = [=](int a, int b) { return a / count == b / count ? angular_length / count : radial_length; };
  result.curve = [=](int a, int b, bool border) { return border ? (a / count == 0 && b / count == 0 ? 1 : 2) : -1; };
  return result;
}

/// Triangles of a random block, each cut into three cells: singularities everywhere, strips of lengths from 0.05 to 5,
/// random features; some of them make holes.
inline Glued_rectangles random_domain(unsigned seed)
{
  std::mt19937 random(seed);
  const auto uniform = [&random] { return std::uniform_real_distribution<double>(0, 1)(random); };
  const int nx = 2 + int(random() % 3), ny = 2 + int(random() % 3);
  Glued_rectangles result;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      result.corners.push_back({i + 0.3 * (uniform() - 0.5), j + 0.3 * (uniform() - 0.5)});
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [place, is_new] = middles.emplace(std::minmax(a, b), int(result.corners.size()));
    if (is_new)
      result.corners.push_back({(result.corners[std::size_t(a)][0] + result.corners[std::size_t(b)][0]) / 2,
                                (result.corners[std::size_t(a)][1] + result.corners[std::size_t(b)][1]) / 2});
    return place->second;
  };
  const int hole = nx > 2 && ny > 2 && uniform() < 0.5 ? 1 + nx : -1; // an inner block
  for (int block = 0; block < nx * ny; ++block) {
    const int a = (block / nx) * (nx + 1) + block % nx, b = a + 1, c = b + nx + 1, d = a + nx + 1;
    if (block == hole)
      continue;
    const bool turn = uniform() < 0.5;
    for (const std::array<int, 3>& t : {turn ? std::array<int, 3>{a, b, c} : std::array<int, 3>{a, b, d},
                                        turn ? std::array<int, 3>{a, c, d} : std::array<int, 3>{b, c, d}}) {
      Point center = {0, 0};
      for (const int v : t)
        center = {center[0] + result.corners[std::size_t(v)][0] / 3, center[1] + result.corners[std::size_t(v)][1] / 3};
      const int m = int(result.corners.size());
      result.corners.push_back(center);
      for (std::size_t k = 0; k < 3; ++k)
        result.cells.push_back({t[k], middle(t[k], t[(k + 1) % 3]), m, middle(t[(k + 2) % 3], t[k])});
    }
  }
  // Opposite edges of cells have one length.
  std::map<std::pair<int, int>, double> length;
  for (const auto& first_cell : result.cells)
    for (std::size_t first_side = 0; first_side < 4; ++first_side) {
      const auto first = std::minmax(first_cell[first_side], first_cell[(first_side + 1) % 4]);
      if (length.count(first))
        continue;
      const double l = 0.05 * std::exp(4.6 * uniform());
      std::vector<std::pair<int, int>> open = {first};
      length[first] = l;
      while (!open.empty()) {
        const std::pair<int, int> edge = open.back();
        open.pop_back();
        for (const auto& cell : result.cells)
          for (std::size_t k = 0; k < 4; ++k)
            if (std::pair<int, int>(std::minmax(cell[k], cell[(k + 1) % 4])) == edge) {
              const auto opposite = std::minmax(cell[(k + 2) % 4], cell[(k + 3) % 4]);
              if (length.emplace(opposite, l).second)
                open.push_back(opposite);
            }
      }
    }
  const double feature_rate = uniform() < 0.5 ? 0 : 0.1;
  std::set<std::pair<int, int>> features;
  for (const auto& edge : length)
    if (uniform() < feature_rate)
      features.insert(edge.first);
  result.length = [length](int a, int b) { return length.at(std::minmax(a, b)); };
  result.curve = [features](int a, int b, bool border) {
    return border ? 0 : features.count(std::minmax(a, b)) ? 1 : -1;
  };
  result.subdivisions = 3;
  result.jitter = 0.15;
  result.seed = seed;
  return result;
}

} // namespace quad_extraction_test

#endif
