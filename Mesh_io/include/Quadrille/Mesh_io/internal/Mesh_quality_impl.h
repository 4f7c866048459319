// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_MESH_QUALITY_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_MESH_QUALITY_IMPL_H

#include <Quadrille/Curve_locator.h>
#include <Quadrille/Mesh_io/internal/Planar_quad_mesh_checker.h>
#include <Quadrille/Mesh_io/internal/Spatial_extent.h>
#include <Quadrille/Mesh_io/internal/Surface_quad_mesh_checker.h>
#include <Quadrille/Mesh_io/internal/quad_geometry.h>
#include <Quadrille/Mesh_io/internal/vector_length.h>
#include <Quadrille/Mesh_quality.h>
#include <Quadrille/Support/internal/separate_compilation.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

namespace Quadrille {

QUADRILLE_INLINE std::vector<std::array<int, 2>> border_edges(const Labelled_mesh& mesh)
{
  std::set<std::pair<int, int>> directed;
  for (const std::vector<int>& polygon : mesh.polygons)
    for (std::size_t i = 0; i < polygon.size(); ++i)
      directed.insert({polygon[i], polygon[(i + 1) % polygon.size()]});
  std::vector<std::array<int, 2>> border;
  for (const auto& [a, b] : directed)
    if (!directed.count({b, a}))
      border.push_back({a, b});
  return border;
}

QUADRILLE_INLINE Mesh_validity check_quad_mesh(const Labelled_mesh& mesh)
{
  if (internal::is_flat(mesh))
    return internal::Planar_quad_mesh_checker(mesh).run();
  return internal::Surface_quad_mesh_checker(mesh).run();
}

namespace internal {

/// Scaled Jacobian and skew of a quad.
struct Quad_shape {
  double jacobian = 1;
  double skew = 0; ///< in degrees
};

/// \param normal of length 1
inline Quad_shape shape_of(const std::array<Space_kernel::Point_3, 4>& quad, const Space_kernel::Vector_3& normal)
{
  Quad_shape shape;
  for (std::size_t i = 0; i < 4; ++i) {
    const Space_kernel::Vector_3 next = quad[(i + 1) % 4] - quad[i], previous = quad[(i + 3) % 4] - quad[i];
    const Space_kernel::Vector_3 cross = CGAL::cross_product(next, previous);
    const double sine = length_of(cross), cosine = next * previous;
    const double scale = std::hypot(sine, cosine); // product of the two edge lengths
    const double jacobian = scale > 0 ? cross * normal / scale : 0;
    const double angle = std::atan2(sine, cosine) * 180 / CGAL_PI;
    shape.jacobian = std::min(shape.jacobian, jacobian);
    shape.skew = std::max(shape.skew, std::abs((jacobian < 0 ? 360 - angle : angle) - 90));
  }
  return shape;
}

} // namespace internal

QUADRILLE_INLINE Mesh_quality measure_quality(const Labelled_mesh& mesh)
{
  using internal::Space_kernel;
  // In a plane, all quads have one normal, and one that is turned over is inverted.
  const bool is_flat = internal::is_flat(mesh);
  double area = 0;
  for (const std::vector<int>& polygon : mesh.polygons)
    if (polygon.size() == 4)
      area += internal::doubled_area_vector(mesh, polygon).z();
  const Space_kernel::Vector_3 normal_of_plane(0, 0, area < 0 ? -1 : 1);

  Mesh_quality quality;
  std::vector<int> n_quads(mesh.points.size(), 0);
  std::size_t n = 0;
  quality.scaled_jacobian_min = 1;
  for (const std::vector<int>& polygon : mesh.polygons) {
    if (polygon.size() != 4)
      continue;
    ++n;
    std::array<Space_kernel::Point_3, 4> quad;
    for (std::size_t i = 0; i < 4; ++i) {
      ++n_quads[std::size_t(polygon[i])];
      const std::array<double, 3>& p = mesh.points[std::size_t(polygon[i])];
      quad[i] = Space_kernel::Point_3(p[0], p[1], is_flat ? 0 : p[2]);
    }
    const internal::Quad_shape shape = internal::shape_of(
        quad, is_flat ? normal_of_plane : internal::direction_of(internal::doubled_area_vector(mesh, polygon)));
    quality.scaled_jacobian_min = std::min(quality.scaled_jacobian_min, shape.jacobian);
    quality.scaled_jacobian_mean += shape.jacobian;
    quality.skew_mean += shape.skew;
    quality.skew_max = std::max(quality.skew_max, shape.skew);
  }
  if (n == 0)
    return Mesh_quality();
  quality.scaled_jacobian_mean /= double(n);
  quality.skew_mean /= double(n);
  std::vector<char> is_on_border(mesh.points.size(), 0);
  for (const std::array<int, 2>& edge : border_edges(mesh))
    is_on_border[std::size_t(edge[0])] = is_on_border[std::size_t(edge[1])] = 1;
  for (std::size_t v = 0; v < n_quads.size(); ++v)
    if (n_quads[v] != 0 && n_quads[v] != (is_on_border[v] ? 2 : 4))
      ++(is_on_border[v] ? quality.irregular_boundary : quality.irregular)[n_quads[v]];
  return quality;
}

namespace internal {

inline void add_deviation(Log_deviation& deviation, double ratio)
{
  const double value = std::abs(std::log(ratio));
  ++deviation.n;
  deviation.mean += (value - deviation.mean) / double(deviation.n);
  deviation.squared_mean += (value * value - deviation.squared_mean) / double(deviation.n);
  deviation.max = std::max(deviation.max, value);
}

inline bool is_finite(const Labelled_mesh& mesh, const std::vector<int>& polygon)
{
  return std::all_of(polygon.begin(), polygon.end(), [&](int v) {
    const std::array<double, 3>& p = mesh.points[std::size_t(v)];
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  });
}

/// The length that a share of all is shorter than. Changes the order.
inline double percentile(std::vector<double>& lengths, double share)
{
  const auto place = lengths.begin() + std::ptrdiff_t(share * double(lengths.size() - 1) + 0.5);
  std::nth_element(lengths.begin(), place, lengths.end());
  return *place;
}

template <class Point> Point point_at(const Labelled_mesh& mesh, int v)
{
  const std::array<double, 3>& p = mesh.points[std::size_t(v)];
  if constexpr (CGAL::Ambient_dimension<Point>::value == 2)
    return Point(p[0], p[1]);
  else
    return Point(p[0], p[1], p[2]);
}

/// Per given edge, the mean lengths of the two sides that leave it in each of the quads beside it.
template <class Point>
std::vector<std::vector<double>> widths_at_edges(const Labelled_mesh& mesh,
                                                 const std::vector<std::array<int, 2>>& edges)
{
  const auto key = [](int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    return (std::uint64_t(low) << 32) | std::uint64_t(high);
  };
  const auto length = [&](int a, int b) { return length_of(point_at<Point>(mesh, b) - point_at<Point>(mesh, a)); };
  std::unordered_map<std::uint64_t, std::size_t> place;
  for (std::size_t i = 0; i < edges.size(); ++i)
    place.emplace(key(edges[i][0], edges[i][1]), i);
  std::vector<std::vector<double>> widths(edges.size());
  for (const std::vector<int>& polygon : mesh.polygons)
    if (polygon.size() == 4)
      for (std::size_t i = 0; i < 4; ++i) {
        const int a = polygon[i], b = polygon[(i + 1) % 4], c = polygon[(i + 2) % 4], d = polygon[(i + 3) % 4];
        if (const auto edge = place.find(key(a, b)); edge != place.end())
          widths[edge->second].push_back(0.5 * (length(b, c) + length(d, a)));
      }
  return widths;
}

template <class Point>
Size_error size_error_on(const Labelled_mesh& mesh, const Triangulated_domain<Point>& domain, const Domain_sizes& sizes)
{
  const Curve_locator<Point> locator(domain);
  Size_error error;
  const std::vector<std::array<int, 2>> lines = mesh.lines.empty() ? border_edges(mesh) : mesh.lines;
  const std::vector<std::vector<double>> widths = widths_at_edges<Point>(mesh, lines);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Point p = point_at<Point>(mesh, lines[i][0]), q = point_at<Point>(mesh, lines[i][1]);
    const auto place = locator.nearest(CGAL::midpoint(p, q));
    if (place.edge == Triangulated_domain<Point>::Mesh::null_edge() || !sizes.is_prescribed(place.edge))
      continue;
    const std::array<Frame_size, 2>& ends = sizes.of_edge[std::size_t(place.edge.idx())];
    const auto between = [&](double a, double b) { return a + place.parameter * (b - a); };
    const double size = between(ends[0].tangential, ends[1].tangential);
    const double length = length_of(q - p);
    add_deviation(error.length, length / size);
    const double width = between(ends[0].normal, ends[1].normal);
    if (width > 0)
      for (const double actual : widths[i])
        add_deviation(error.aspect, (actual / length) / (width / size));
  }
  return error;
}

} // namespace internal

QUADRILLE_INLINE Mesh_distortion measure_distortion(const Labelled_mesh& mesh)
{
  Mesh_distortion distortion;
  std::vector<double> areas, lengths;
  std::set<std::pair<int, int>> edges;
  for (const std::vector<int>& quad : mesh.polygons) {
    if (quad.size() != 4)
      continue;
    const double area = internal::area_along_diagonal(mesh, quad);
    if (!(area > 0) || !std::isfinite(area) || !internal::is_finite(mesh, quad))
      continue;
    std::array<double, 4> side{};
    for (std::size_t i = 0; i < 4; ++i) {
      const int a = quad[i], b = quad[(i + 1) % 4];
      side[i] = internal::length_of(internal::space_point(mesh, b) - internal::space_point(mesh, a));
      if (edges.insert(std::minmax(a, b)).second)
        lengths.push_back(side[i]);
    }
    areas.push_back(area);
    internal::add_deviation(distortion.aspect, (side[0] + side[2]) / (side[1] + side[3]));
  }
  if (lengths.empty())
    return distortion;
  const double mean_area = std::accumulate(areas.begin(), areas.end(), 0.0) / double(areas.size());
  for (const double area : areas)
    internal::add_deviation(distortion.area, area / mean_area);
  distortion.edge_length_percentile_1 = internal::percentile(lengths, 0.01);
  distortion.edge_length_median = internal::percentile(lengths, 0.5);
  distortion.edge_length_percentile_99 = internal::percentile(lengths, 0.99);
  return distortion;
}

QUADRILLE_INLINE Size_error measure_size_error(const Labelled_mesh& mesh, const Planar_domain& domain,
                                               const Domain_sizes& sizes)
{
  return internal::size_error_on(mesh, domain, sizes);
}

QUADRILLE_INLINE Size_error measure_size_error(const Labelled_mesh& mesh, const Surface_domain& domain,
                                               const Domain_sizes& sizes)
{
  return internal::size_error_on(mesh, domain, sizes);
}

} // namespace Quadrille

#endif
