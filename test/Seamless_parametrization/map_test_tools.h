// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_SEAMLESS_PARAMETRIZATION_MAP_TEST_TOOLS_H
#define QUADRILLE_TEST_SEAMLESS_PARAMETRIZATION_MAP_TEST_TOOLS_H

#include "planar_test_meshes.h"

#include <Quadrille/Seamless_parametrization/internal/Seamless_map_solver.h>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace Quadrille {
namespace test {

using internal::Gradient_pair;
using internal::Indexed_triangulation;
using internal::Seamless_map_data;

/// The frame of size `size` whose u direction has the angle `angle`.
inline Gradient_pair frame(double angle, double size = 1.0)
{
  const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
  return {direction / size, internal::rotate_quarters(direction, 1) / size};
}

/// The gradients of u = log r, v = theta.
inline Gradient_pair polar_frame(const Eigen::Vector2d& p)
{
  return {p / p.squaredNorm(), internal::rotate_quarters(p, 1) / p.squaredNorm()};
}

/// The gradients of u + i v = z^(quadrants/4), around a vertex of that valence at the origin.
inline Gradient_pair power_frame(const Eigen::Vector2d& p, int quadrants)
{
  const double exponent = quadrants / 4.0;
  const std::complex<double> derivative = exponent * std::pow(std::complex<double>(p.x(), p.y()), exponent - 1.0);
  return {{derivative.real(), -derivative.imag()}, {derivative.imag(), derivative.real()}};
}

/// How far the edges of the map are from those of z^(quadrants/4), in the L2 sense, relative.
inline double power_map_error(const Planar_mesh& mesh, const Seamless_map_data& map, int quadrants)
{
  double error = 0.0;
  double norm = 0.0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Eigen::Vector2d c = mesh.centroid(f);
    const std::complex<double> centre(c.x(), c.y());
    std::array<std::complex<double>, 3> exact, computed;
    for (std::size_t i = 0; i < 3; ++i) { // the branch that is continuous in this face
      const Eigen::Vector2d& p = mesh.points[std::size_t(mesh.triangles[f][i])];
      const double exponent = quadrants / 4.0;
      exact[i] = std::pow(centre, exponent) * std::pow(std::complex<double>(p.x(), p.y()) / centre, exponent);
      computed[i] = {map.uv[3 * f + i].x(), map.uv[3 * f + i].y()};
    }
    double best = std::numeric_limits<double>::infinity();
    std::complex<double> turn(1.0, 0.0);
    for (int k = 0; k < 4; ++k, turn *= std::complex<double>(0.0, 1.0)) {
      double sum = 0.0;
      for (std::size_t i = 0; i < 3; ++i)
        sum += std::norm(turn * (exact[(i + 1) % 3] - exact[i]) - (computed[(i + 1) % 3] - computed[i]));
      best = std::min(best, sum);
    }
    error += best;
    for (std::size_t i = 0; i < 3; ++i)
      norm += std::norm(exact[(i + 1) % 3] - exact[i]);
  }
  return std::sqrt(error / norm);
}

/// Frames of equal size, aligned with the boundary and smooth inside: harmonic in the fourfold angle.
inline std::vector<Gradient_pair> smooth_cross_field(const Planar_mesh& mesh, double size = 1.0, int sweeps = 400)
{
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  using Complex = std::complex<double>;
  std::vector<Complex> cross(mesh.points.size(), Complex(0.0, 0.0));
  std::vector<std::vector<std::size_t>> neighbours(mesh.points.size());
  for (int h = 0; h < triangulation.number_of_halfedges(); ++h) {
    const auto from = std::size_t(triangulation.source(h));
    const auto to = std::size_t(triangulation.target(h));
    neighbours[from].push_back(to);
    if (!triangulation.is_boundary(h))
      continue;
    const Eigen::Vector2d edge = mesh.points[to] - mesh.points[from];
    const Complex direction = std::pow(Complex(edge.x(), edge.y()) / edge.norm(), 4.0);
    cross[from] += direction;
    cross[to] += direction;
  }
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t v = 0; v < cross.size(); ++v) {
      if (triangulation.is_boundary_vertex(int(v)))
        continue;
      Complex sum(0.0, 0.0);
      for (const std::size_t w : neighbours[v])
        sum += cross[w];
      cross[v] = sum / double(neighbours[v].size());
    }
  std::vector<Gradient_pair> frames;
  for (const auto& [a, b, c] : mesh.triangles)
    frames.push_back(
        frame(std::arg(cross[std::size_t(a)] + cross[std::size_t(b)] + cross[std::size_t(c)]) / 4.0, size));
  return frames;
}

/// The frames of a function of the position, at the triangles' centroids.
template <class Field> std::vector<Gradient_pair> sample(const Planar_mesh& mesh, const Field& field)
{
  std::vector<Gradient_pair> frames;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    frames.push_back(field(mesh.centroid(f)));
  return frames;
}

/// Every frame turned by a random number of quarter turns, and by up to `noise` radians; lengths change as much.
inline std::vector<Gradient_pair> perturbed(std::vector<Gradient_pair> frames, double noise, unsigned seed)
{
  std::mt19937 generator(seed);
  const auto random = [&] { return double(generator()) / 4294967295.0 * 2.0 - 1.0; };
  for (Gradient_pair& pair : frames) {
    const double angle = noise * random();
    const double length = std::exp(noise * random());
    Eigen::Matrix2d turn;
    turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    const Gradient_pair turned(length * (turn * pair.first), length * (turn * pair.second));
    pair = internal::rotate_quarters(turned, int(generator() % 4));
  }
  return frames;
}

/// Halfedge flags of the edges between consecutive vertices whose midpoints satisfy a predicate.
template <class Predicate> std::vector<char> edges_where(const Planar_mesh& mesh, const Predicate& predicate)
{
  std::vector<char> flags;
  for (const auto& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      flags.push_back(
          predicate(mesh.points[std::size_t(triangle[i])], mesh.points[std::size_t(triangle[(i + 1) % 3])]));
  return flags;
}

inline Seamless_map_data compute_map(const Planar_mesh& mesh, const std::vector<Gradient_pair>& frames,
                                     const std::vector<char>& constrained = {},
                                     const Seamless_parametrization_options& options = {})
{
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  const internal::Seamless_map_solver solver(triangulation, internal::planar_geometry(triangulation, mesh.points),
                                             constrained);
  return solver(frames, options);
}

/// Interior vertices by valence, without the regular ones.
inline std::map<int, int> singularities(const Planar_mesh& mesh, const Seamless_map_data& map)
{
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  std::map<int, int> counts;
  for (int v = 0; v < triangulation.number_of_vertices(); ++v)
    if (!triangulation.is_boundary_vertex(v) && map.topology.quarter_index(triangulation, v) != 0)
      ++counts[map.topology.vertex_quadrants[std::size_t(v)]];
  return counts;
}

/// Asserts what "exactly seamless" promises, from the coordinates and matchings alone, without a tolerance.
inline void expect_exactly_seamless(const Indexed_triangulation& mesh, const Seamless_map_data& map,
                                    const std::vector<char>& constrained = {})
{
  double extent = 0.0;
  for (const Eigen::Vector2d& p : map.uv)
    extent = std::max(extent, p.lpNorm<Eigen::Infinity>());
  const int exponent = extent > 0.0 ? std::ilogb(extent) - 44 : 0;
  for (const Eigen::Vector2d& p : map.uv)
    for (int c = 0; c < 2; ++c)
      ASSERT_EQ(std::ldexp(p[c], -exponent), std::round(std::ldexp(p[c], -exponent))) << "not on a common grid";

  using Transition = std::pair<int, Eigen::Vector2d>; // x -> R^k x + T
  const auto transition = [&](int h) {
    const int opposite = mesh.opposite(h);
    const int k = map.matching[std::size_t(h)];
    const auto translation = [&](int from, int to) -> Eigen::Vector2d {
      return map.uv[std::size_t(to)] - internal::rotate_quarters(map.uv[std::size_t(from)], k);
    };
    const Eigen::Vector2d first = translation(h, Indexed_triangulation::next(opposite));
    const Eigen::Vector2d second = translation(Indexed_triangulation::next(h), opposite);
    EXPECT_EQ(first, second) << "halfedge " << h;
    return Transition(k, first);
  };
  for (int h = 0; h < mesh.number_of_halfedges(); ++h) {
    const Eigen::Vector2d along = map.uv[std::size_t(Indexed_triangulation::next(h))] - map.uv[std::size_t(h)];
    if (mesh.is_boundary(h) || (!constrained.empty() && constrained[std::size_t(h)])) {
      ASSERT_EQ(along.cwiseAbs().minCoeff(), 0.0) << "halfedge " << h << " is not aligned";
    }
    if (mesh.is_boundary(h))
      continue;
    ASSERT_EQ((map.matching[std::size_t(h)] + map.matching[std::size_t(mesh.opposite(h))]) % 4, 0);
    const Transition across = transition(h);
    if (!map.cut.is_cut[std::size_t(h)]) {
      ASSERT_EQ(across.first, 0);
      ASSERT_EQ(across.second, Eigen::Vector2d(0.0, 0.0));
    }
  }
  for (int v = 0; v < mesh.number_of_vertices(); ++v) {
    if (mesh.is_boundary_vertex(v) || map.topology.quarter_index(mesh, v) != 0)
      continue;
    Transition around(0, Eigen::Vector2d(0.0, 0.0));
    int h = mesh.outgoing(v);
    do {
      const int incoming = Indexed_triangulation::prev(h);
      const Transition across = transition(incoming);
      around.second = internal::rotate_quarters(around.second, across.first) + across.second;
      around.first = (around.first + across.first) % 4;
      h = mesh.opposite(incoming);
    } while (h != mesh.outgoing(v));
    ASSERT_EQ(around.first, 0) << "vertex " << v;
    ASSERT_EQ(around.second, Eigen::Vector2d(0.0, 0.0)) << "vertex " << v;
  }
}

inline void expect_exactly_seamless(const Planar_mesh& mesh, const Seamless_map_data& map,
                                    const std::vector<char>& constrained = {})
{
  expect_exactly_seamless(Indexed_triangulation(mesh.points.size(), mesh.triangles), map, constrained);
}

/// A closed or open surface of triangles in space with the tangent bases that its faces' first edges define.
struct Surface_mesh_arrays {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;

  std::array<Eigen::Vector3d, 2> basis(std::size_t f) const
  {
    const Eigen::Vector3d a = points[std::size_t(triangles[f][0])];
    const Eigen::Vector3d ab = points[std::size_t(triangles[f][1])] - a;
    const Eigen::Vector3d ac = points[std::size_t(triangles[f][2])] - a;
    const Eigen::Vector3d x = ab.normalized();
    return {x, ab.cross(ac).normalized().cross(x)};
  }

  internal::Tangent_geometry geometry(const Indexed_triangulation& mesh) const
  {
    internal::Tangent_geometry result;
    for (int h = 0; h < mesh.number_of_halfedges(); ++h) {
      const Eigen::Vector3d edge = points[std::size_t(mesh.target(h))] - points[std::size_t(mesh.source(h))];
      const auto [x, y] = basis(std::size_t(h / 3));
      result.edge_vector.emplace_back(edge.dot(x), edge.dot(y));
    }
    for (int h = 0; h < mesh.number_of_halfedges(); ++h) {
      const Eigen::Vector2d here = result.edge(h);
      const Eigen::Vector2d there = mesh.is_boundary(h) ? here : Eigen::Vector2d(-result.edge(mesh.opposite(h)));
      result.transport.push_back(std::atan2(there.y(), there.x()) - std::atan2(here.y(), here.x()));
    }
    return result;
  }
};

/// The surface of the cube [-1/2, 1/2]^3 with n x n x 2 triangles a side, as it is or blown up to a sphere.
inline Surface_mesh_arrays cube_surface(int n, bool spherical)
{
  Surface_mesh_arrays mesh;
  std::map<std::array<int, 3>, int> index;
  const auto vertex = [&](const std::array<int, 3>& steps) {
    const auto [place, is_new] = index.emplace(steps, int(mesh.points.size()));
    if (is_new) {
      const Eigen::Vector3d p = Eigen::Vector3d(steps[0], steps[1], steps[2]) / n - Eigen::Vector3d::Constant(0.5);
      mesh.points.push_back(spherical ? Eigen::Vector3d(p.normalized()) : p);
    }
    return place->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto at = [&](int a, int b) {
            std::array<int, 3> steps{};
            steps[axis] = side;
            steps[(axis + 1) % 3] = side == 0 ? b : a; // outwards oriented
            steps[(axis + 2) % 3] = side == 0 ? a : b;
            return vertex(steps);
          };
          mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
          mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
  return mesh;
}

/// Frames along the edges of the cube on each of its sides.
inline std::vector<Gradient_pair> cube_frames(const Surface_mesh_arrays& mesh)
{
  std::vector<Gradient_pair> frames;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto [x, y] = mesh.basis(f);
    Eigen::Index axis = 0;
    x.cross(y).cwiseAbs().maxCoeff(&axis);
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    direction[(axis + 1) % 3] = 1.0;
    frames.push_back(frame(std::atan2(direction.dot(y), direction.dot(x))));
  }
  return frames;
}

} // namespace test
} // namespace Quadrille

#endif
