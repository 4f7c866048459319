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

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace Quadrille {
namespace internal {

/// A size that is wanted around a point.
struct Size_place {
  Planar_domain::Point_2 position;
  double size = 0, radius = 0;
};

inline std::vector<Size_place> parse_size_places(const std::string& text, const std::string& path)
{
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
        fail("a line should be 'x y size [radius]', and what stands in column " + std::to_string(at - line.data() + 1) +
             " is not a finite number");
      values.push_back(value);
      at = next;
    }
    if (values.empty())
      continue;
    if (values.size() != 3 && values.size() != 4)
      fail("a line should be 'x y size [radius]', and this one has " + std::to_string(values.size()) + " numbers");
    if (!(values[2] > 0) || (values.size() == 4 && !(values[3] > 0)))
      fail("sizes and radii must be positive");
    places.push_back({{values[0], values[1]}, values[2], values.size() == 4 ? values[3] : 2 * values[2]});
  }
  if (places.empty())
    throw Invalid_input_error(path + ": there is no size in this file; a line should be 'x y size [radius]'");
  return places;
}

inline std::vector<double> sizes_around_places(const std::vector<Size_place>& places, const Planar_domain& domain)
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

  std::vector<double> sizes(domain.mesh.number_of_vertices(), 0.0);
  for (const Size_place& place : places) {
    const auto nearest = vertices.nearest_vertex(place.position);
    sizes[nearest->info()] = place.size;
  }
  for (const auto v : domain.mesh.vertices()) {
    const Size_place& place = places[centers.nearest_vertex(domain.mesh.point(v))->info()];
    if (CGAL::squared_distance(place.position, domain.mesh.point(v)) <= place.radius * place.radius)
      sizes[std::size_t(v.idx())] = place.size;
  }
  return sizes;
}

/// The last view of a file at the vertices of a domain. Runs in the child process.
inline std::vector<double> probe_view(const std::string& path, const Planar_domain& domain)
{
  const Gmsh_session session;
  std::vector<double> sizes(domain.mesh.number_of_vertices(), 0.0);
  Gmsh_session::call(path, [&] {
    gmsh::merge(path);
    std::vector<int> views;
    gmsh::view::getTags(views);
    if (views.empty())
      throw Invalid_input_error(path + ": there are no node data in this file; a size field is a Gmsh view with one "
                                       "number per node");
    std::vector<double> values;
    for (const auto v : domain.mesh.vertices()) {
      const auto& p = domain.mesh.point(v);
      values.clear();
      gmsh::view::probe(views.back(), p.x(), p.y(), domain.z, values);
      if (values.empty())
        continue;
      const double size = values.back();
      if (!(size > 0) || !std::isfinite(size))
        throw Invalid_input_error(path + ": the size at (" + std::to_string(p.x()) + ", " + std::to_string(p.y()) +
                                  ") is " + std::to_string(size) + "; sizes must be positive and finite");
      sizes[std::size_t(v.idx())] = size;
    }
  });
  return sizes;
}

} // namespace internal

inline std::vector<double> read_size_field(const std::string& path, const Planar_domain& domain,
                                           double time_limit_seconds)
{
  const std::string ending = internal::extension_of(path);
  std::vector<double> sizes;
  if (ending == ".txt" || ending == ".csv")
    return internal::sizes_around_places(internal::parse_size_places(internal::read_whole_file(path), path), domain);
  if (ending != ".pos" && ending != ".msh")
    throw Invalid_argument_error(path + ": the name of a size field has to end in .pos, .msh, .txt or .csv");
  internal::check_readable(path); // Gmsh would only log it
  sizes = internal::run_in_child_process<std::vector<double>>([&] { return internal::probe_view(path, domain); },
                                                              time_limit_seconds, path);
  if (std::none_of(sizes.begin(), sizes.end(), [](double size) { return size > 0; }))
    throw Invalid_input_error(path + ": the size field says nothing anywhere inside the domain " + domain.source);
  return sizes;
}

} // namespace Quadrille

#endif
