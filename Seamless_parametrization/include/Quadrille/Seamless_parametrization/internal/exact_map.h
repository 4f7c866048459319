// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_EXACT_MAP_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_EXACT_MAP_H

#include <Quadrille/Seamless_parametrization/internal/Cut_graph.h>
#include <Quadrille/Seamless_parametrization/internal/Seamless_constraints.h>
#include <Quadrille/Seamless_parametrization/internal/Tangent_geometry.h>
#include <Quadrille/exceptions.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace Quadrille {
namespace internal {

/// Rounds free parameters so that all corner coordinates are exact integer multiples of one power of two, the finest
/// that leaves every coordinate `coordinate_bits` bits. Then whatever follows from the constraints by sums of a few
/// coordinates holds exactly in doubles, whose 53 bits leave 9 for such sums.
/// \throws No_result_error if a coordinate is not finite.
inline std::vector<Eigen::Vector2d> round_to_exact_map(const Seamless_space& space, const Eigen::VectorXd& y)
{
  constexpr int coordinate_bits = 44;
  const double denominator = double(space.denominator);
  double extent = 0.0;
  for (int row = 0; row < 2 * space.number_of_copies; ++row) {
    double x = double(space.constants[std::size_t(row)]);
    for (const Seamless_space::Entry* e = space.begin(row); e != space.end(row); ++e)
      x += double(e->coefficient) * y[e->parameter];
    if (!std::isfinite(x))
      throw No_result_error("map", "the integrated coordinates are not finite numbers");
    extent = std::max(extent, std::abs(x) / denominator);
  }
  const int exponent = extent > 0.0 ? std::ilogb(extent) + 1 - coordinate_bits : 0;
  std::vector<std::int64_t> units(std::size_t(space.number_of_parameters));
  for (std::size_t i = 0; i < units.size(); ++i)
    units[i] = std::llround(std::ldexp(y[Eigen::Index(i)] / denominator, -exponent));

  std::vector<double> coordinates(2 * std::size_t(space.number_of_copies));
  for (std::size_t row = 0; row < coordinates.size(); ++row) {
    std::int64_t x = std::llround(std::ldexp(space.constant(int(row)), -exponent));
    for (const Seamless_space::Entry* e = space.begin(int(row)); e != space.end(int(row)); ++e)
      x += e->coefficient * units[std::size_t(e->parameter)];
    coordinates[row] = std::ldexp(double(x), exponent);
  }
  std::vector<Eigen::Vector2d> uv;
  uv.reserve(space.copy_of_corner.size());
  for (const int copy : space.copy_of_corner)
    uv.emplace_back(coordinates[2 * std::size_t(copy)], coordinates[2 * std::size_t(copy) + 1]);
  return uv;
}

/// The largest violation of the seams' transitions: 0 if and only if every path has one translation T such that
/// (u,v)_right = R^k (u,v)_left + T at all its vertices, and corners agree across all other edges.
/// Around a vertex the transitions then lead back to the same point; with the combed matchings, which add up to the
/// vertex's quadrants, the holonomy of every regular vertex is the identity.
inline double seam_residual(const Indexed_triangulation& mesh, const Cut_graph& cut,
                            const std::vector<Eigen::Vector2d>& uv)
{
  double residual = 0.0;
  std::vector<Eigen::Vector2d> translations;
  const auto jump = [&](int from, int to, int k) -> Eigen::Vector2d {
    return uv[std::size_t(to)] - rotate_quarters(uv[std::size_t(from)], k);
  };
  for (const Cut_graph::Path& path : cut.paths) {
    const int h = path.halfedges.front();
    translations.push_back(jump(h, Indexed_triangulation::next(mesh.opposite(h)), path.matching));
  }
  for (int h = 0; h < mesh.number_of_halfedges(); ++h) {
    const int opposite = mesh.opposite(h);
    const int path = cut.path_of[std::size_t(h)];
    if (opposite < 0 || (path >= 0 ? !cut.is_forward[std::size_t(h)] : opposite < h))
      continue;
    const int k = path >= 0 ? cut.paths[std::size_t(path)].matching : 0;
    const Eigen::Vector2d translation = path >= 0 ? translations[std::size_t(path)] : Eigen::Vector2d(0.0, 0.0);
    for (const Eigen::Vector2d& difference :
         {Eigen::Vector2d(jump(h, Indexed_triangulation::next(opposite), k) - translation),
          Eigen::Vector2d(jump(Indexed_triangulation::next(h), opposite, k) - translation)})
      residual = std::max(residual, difference.lpNorm<Eigen::Infinity>());
  }
  return residual;
}

/// The largest change along a constrained edge of the coordinate that is to be constant there.
inline double alignment_residual(const Indexed_triangulation& mesh, const Frame_topology& topology,
                                 const Cut_graph& cut, const std::vector<Eigen::Vector2d>& uv)
{
  double residual = 0.0;
  for (int h = 0; h < mesh.number_of_halfedges(); ++h) {
    if (topology.alignment[std::size_t(h)] < 0)
      continue;
    const bool along_v = ((topology.alignment[std::size_t(h)] + cut.face_rotation[std::size_t(h / 3)]) & 1) != 0;
    const Eigen::Vector2d change = uv[std::size_t(Indexed_triangulation::next(h))] - uv[std::size_t(h)];
    residual = std::max(residual, std::abs(along_v ? change.x() : change.y()));
  }
  return residual;
}

/// The sign of (b - a) x (c - a). Exact if the differences are, and the products do not underflow.
inline int exact_orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  const Eigen::Vector2d p = b - a;
  const Eigen::Vector2d q = c - a;
  // Rounding is monotone: different rounded products are ordered as the exact ones, equal ones by their remainders.
  double left = p.x() * q.y();
  double right = p.y() * q.x();
  if (left == right) {
    left = std::fma(p.x(), q.y(), -left);
    right = std::fma(p.y(), q.x(), -right);
  }
  return left > right ? 1 : left < right ? -1 : 0;
}

/// The faces that are not positively oriented in uv.
inline std::vector<int> flipped_faces(const std::vector<Eigen::Vector2d>& uv)
{
  std::vector<int> faces;
  for (std::size_t f = 0; 3 * f < uv.size(); ++f)
    if (exact_orientation(uv[3 * f], uv[3 * f + 1], uv[3 * f + 2]) <= 0)
      faces.push_back(int(f));
  return faces;
}

/// A constrained halfedge with the coordinate that should grow or fall along it.
struct Aligned_halfedge {
  int halfedge;
  int coordinate; ///< 0: u, 1: v
  double sign;    ///< 1: it should grow from source to target, -1: fall
};

inline std::vector<Aligned_halfedge> aligned_halfedges(const Frame_topology& topology, const Cut_graph& cut)
{
  std::vector<Aligned_halfedge> result;
  for (std::size_t h = 0; h < topology.alignment.size(); ++h)
    if (topology.alignment[h] >= 0) {
      const int direction = topology.alignment[h] + cut.face_rotation[h / 3];
      result.push_back({int(h), direction & 1, (direction & 2) != 0 ? -1.0 : 1.0});
    }
  return result;
}

/// Whether it runs backwards, or has no length in uv. Triangles around its ends can be positively oriented
/// nevertheless, but then turn around them by two quadrants more or less than they should.
inline bool is_reversed(const Aligned_halfedge& edge, const std::vector<Eigen::Vector2d>& uv)
{
  const std::size_t source = std::size_t(edge.halfedge);
  const std::size_t target = std::size_t(Indexed_triangulation::next(edge.halfedge));
  return !(edge.sign * (uv[target][edge.coordinate] - uv[source][edge.coordinate]) > 0.0);
}

inline int number_of_reversed(const std::vector<Aligned_halfedge>& aligned, const std::vector<Eigen::Vector2d>& uv)
{
  return int(std::count_if(aligned.begin(), aligned.end(), [&](const auto& edge) { return is_reversed(edge, uv); }));
}

/// By vertex: the quadrants by which the map, without flipped faces, turns around it.
inline std::vector<int> turned_quadrants(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector2d>& uv)
{
  std::vector<double> angle(std::size_t(mesh.number_of_vertices()), 0.0);
  for (int h = 0; h < mesh.number_of_halfedges(); ++h) {
    const Eigen::Vector2d first = uv[std::size_t(Indexed_triangulation::next(h))] - uv[std::size_t(h)];
    const Eigen::Vector2d second = uv[std::size_t(Indexed_triangulation::prev(h))] - uv[std::size_t(h)];
    angle[std::size_t(mesh.source(h))] += std::atan2(cross(first, second), first.dot(second));
  }
  std::vector<int> quadrants;
  for (const double a : angle)
    quadrants.push_back(int(std::lround(a / quarter_turn)));
  return quadrants;
}

/// The vertices around which the map, without flipped faces, does not turn by as many quadrants as the frames do
/// (it covers the neighbourhood of such a vertex more than once, or too rarely).
inline std::vector<int> misturned_vertices(const Indexed_triangulation& mesh, const Frame_topology& topology,
                                           const std::vector<Eigen::Vector2d>& uv)
{
  const std::vector<int> turned = turned_quadrants(mesh, uv);
  std::vector<int> vertices;
  for (std::size_t v = 0; v < turned.size(); ++v)
    if (turned[v] != topology.vertex_quadrants[v])
      vertices.push_back(int(v));
  return vertices;
}

} // namespace internal
} // namespace Quadrille

#endif
