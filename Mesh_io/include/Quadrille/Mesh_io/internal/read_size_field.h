// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_READ_SIZE_FIELD_H
#define QUADRILLE_MESH_IO_INTERNAL_READ_SIZE_FIELD_H

#include <Quadrille/Mesh_io/internal/Gmsh_session.h>
#include <Quadrille/Mesh_io/internal/files.h>
#include <Quadrille/Mesh_io/internal/run_in_child_process.h>
#include <Quadrille/read_size_field.h>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace Quadrille {
namespace internal {

/// Sizes that are wanted around a point.
struct Size_place {
  Planar_domain::Point_2 position;
  std::array<double, 2> size = {};
  double angle = 0; ///< of the first size's direction, in radians
  double radius = 0;
  bool has_direction = false;

  Eigen::Matrix2d metric() const
  {
    const Eigen::Rotation2Dd turn(angle);
    const Eigen::Matrix2d metric =
        turn * Eigen::Vector2d(1 / (size[0] * size[0]), 1 / (size[1] * size[1])).asDiagonal() * turn.inverse();
    return 0.5 * (metric + metric.transpose());
  }
};

inline std::vector<Size_place> parse_size_places(const std::string& text, const std::string& path)
{
  const std::string form = "a line should be 'x y size [radius]' or 'x y size size angle [radius]'";
  std::vector<Size_place> places;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto fail = [&](const std::string& reason) {
      throw Invalid_input_error(path + ", line " + std::to_string(number) + ": " + reason);
    };
    line.erase(std::min(line.find('#'), line.size()));
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == ',' || c == ';' || c == '\t' || c == '\r'; }, ' ');
    std::vector<double> values;
    for (const char *at = line.data(), *end = line.data() + line.size();;) {
      at = std::find_if(at, end, [](char c) { return c != ' '; });
      if (at == end)
        break;
      double value = 0;
      const auto [next, error] = std::from_chars(at, end, value);
      if (error != std::errc() || (next != end && *next != ' ') || !std::isfinite(value))
        fail(form + ", and what stands in column " + std::to_string(at - line.data() + 1) + " is not a finite number");
      values.push_back(value);
      at = next;
    }
    if (values.empty())
      continue;
    if (values.size() < 3 || values.size() > 6)
      fail(form + ", and this one has " + std::to_string(values.size()) + " numbers");
    Size_place place;
    place.position = {values[0], values[1]};
    place.has_direction = values.size() > 4;
    place.size = {values[2], place.has_direction ? values[3] : values[2]};
    place.angle = place.has_direction ? values[4] * CGAL_PI / 180 : 0;
    const bool has_radius = values.size() % 2 == 0;
    place.radius = has_radius ? values.back() : 2 * std::max(place.size[0], place.size[1]);
    if (!(place.size[0] > 0) || !(place.size[1] > 0) || !(place.radius > 0))
      fail("sizes and radii must be positive");
    places.push_back(place);
  }
  if (places.empty())
    throw Invalid_input_error(path + ": there is no size in this file; " + form);
  return places;
}

inline Size_field sizes_around_places(const std::vector<Size_place>& places, const Planar_domain& domain)
{
  using Vertex_base = CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Planar_domain::Kernel>;
  using Delaunay =
      CGAL::Delaunay_triangulation_2<Planar_domain::Kernel, CGAL::Triangulation_data_structure_2<Vertex_base>>;
  Delaunay vertices, centers;
  std::vector<std::pair<Planar_domain::Point_2, std::size_t>> points;
  for (const auto v : domain.mesh.vertices())
    points.emplace_back(domain.mesh.point(v), std::size_t(v.idx()));
  vertices.insert(points.begin(), points.end());
  points.clear();
  for (std::size_t i = 0; i < places.size(); ++i)
    points.emplace_back(places[i].position, i);
  centers.insert(points.begin(), points.end());

  Size_field field;
  field.size.assign(domain.mesh.number_of_vertices(), 0.0);
  if (std::any_of(places.begin(), places.end(), [](const Size_place& place) { return place.has_direction; }))
    field.metric.assign(domain.mesh.number_of_vertices(), Eigen::Matrix2d::Zero());
  const auto set = [&](std::size_t v, const Size_place& place) {
    field.size[v] = place.has_direction ? 0 : place.size[0];
    if (!field.metric.empty())
      field.metric[v] = place.has_direction ? place.metric() : Eigen::Matrix2d(Eigen::Matrix2d::Zero());
  };
  for (const Size_place& place : places)
    set(vertices.nearest_vertex(place.position)->info(), place);
  for (const auto v : domain.mesh.vertices()) {
    const Size_place& place = places[centers.nearest_vertex(domain.mesh.point(v))->info()];
    if (CGAL::squared_distance(place.position, domain.mesh.point(v)) <= place.radius * place.radius)
      set(std::size_t(v.idx()), place);
  }
  return field;
}

/// The last view of a file at the vertices of a domain: per vertex the size, or the entries xx, xy, yy of the metric;
/// zero where there is none. Runs in the child process.
inline std::vector<double> probe_view(const std::string& path, const Planar_domain& domain)
{
  const Gmsh_session session;
  constexpr int in_plane[3] = {0, 1, 4}; // of the nine entries of a tensor
  std::vector<double> result;
  Gmsh_session::call(path, [&] {
    gmsh::merge(path);
    std::vector<int> views;
    gmsh::view::getTags(views);
    if (views.empty())
      throw Invalid_input_error(path + ": there are no node data in this file; a size field is a Gmsh view with one "
                                       "number, or one tensor, per node");
    const auto probe = [&](const Planar_domain::Point_2& p, int n_components) {
      std::vector<double> values; // of all time steps
      gmsh::view::probe(views.back(), p.x(), p.y(), domain.z, values, -1, n_components);
      if (values.size() > std::size_t(n_components))
        values.erase(values.begin(), values.end() - n_components);
      return values;
    };
    const auto vertices = domain.mesh.vertices();
    const bool has_tensors =
        std::any_of(vertices.begin(), vertices.end(), [&](auto v) { return !probe(domain.mesh.point(v), 9).empty(); });
    for (const auto v : vertices) {
      const auto& p = domain.mesh.point(v);
      const std::vector<double> values = probe(p, has_tensors ? 9 : 1);
      if (values.empty()) {
        result.resize(result.size() + (has_tensors ? 3 : 1), 0.0);
        continue;
      }
      const std::string place = "(" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ")";
      if (!has_tensors) {
        if (!(values[0] > 0) || !std::isfinite(values[0]))
          throw Invalid_input_error(path + ": the size at " + place + " is " + std::to_string(values[0]) +
                                    "; sizes must be positive and finite");
        result.push_back(values[0]);
        continue;
      }
      const double xx = values[in_plane[0]], xy = values[in_plane[1]], yy = values[in_plane[2]];
      if (values[3] != xy || !(xx > 0) || !(xx * yy - xy * xy > 0) || !std::isfinite(xx + yy))
        throw Invalid_input_error(path + ": the tensor at " + place + " is (" + std::to_string(xx) + ", " +
                                  std::to_string(xy) + "; " + std::to_string(values[3]) + ", " + std::to_string(yy) +
                                  ") in the plane; metrics must be symmetric and positive definite");
      result.insert(result.end(), {xx, xy, yy});
    }
  });
  return result;
}

} // namespace internal

inline Size_field read_size_field(const std::string& path, const Planar_domain& domain, double time_limit_seconds)
{
  const std::string ending = internal::extension_of(path);
  if (ending == ".txt" || ending == ".csv")
    return internal::sizes_around_places(internal::parse_size_places(internal::read_whole_file(path), path), domain);
  if (ending != ".pos" && ending != ".msh")
    throw Invalid_argument_error(path + ": the name of a size field has to end in .pos, .msh, .txt or .csv");
  internal::check_readable(path); // Gmsh would only log it
  const std::vector<double> values = internal::run_in_child_process<std::vector<double>>(
      [&] { return internal::probe_view(path, domain); }, time_limit_seconds, path);
  if (std::none_of(values.begin(), values.end(), [](double value) { return value > 0; }))
    throw Invalid_input_error(path + ": the size field says nothing anywhere inside the domain " + domain.source);
  Size_field field;
  if (values.size() == domain.mesh.number_of_vertices()) {
    field.size = values;
  } else {
    for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
      field.metric.emplace_back();
      field.metric.back() << values[i], values[i + 1], values[i + 1], values[i + 2];
    }
  }
  return field;
}

} // namespace Quadrille

#endif
