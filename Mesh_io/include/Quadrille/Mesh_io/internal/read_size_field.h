// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_READ_SIZE_FIELD_H
#define QUADRILLE_MESH_IO_INTERNAL_READ_SIZE_FIELD_H

#include <Quadrille/Mesh_io/internal/Gmsh_session.h>
#include <Quadrille/Mesh_io/internal/files.h>
#include <Quadrille/Mesh_io/internal/run_in_child_process.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/read_size_field.h>

#include <CGAL/Dimension.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_2.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/property_map.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Sizes that are wanted around a point.
template <class Point> struct Size_place {
  Point position;
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

/// In the plane, places may have directions.
template <class Point>
std::vector<Size_place<Point>> parse_size_places(const std::string& text, const std::string& path)
{
  constexpr std::size_t dimension = CGAL::Ambient_dimension<Point>::value;
  const std::string form = dimension == 2 ? "a line should be 'x y size [radius]' or 'x y size size angle [radius]'"
                                          : "a line should be 'x y z size [radius]'";
  std::vector<Size_place<Point>> places;
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
    const std::size_t n = values.size();
    if (n < dimension + 1 || n > (dimension == 2 ? 6 : 5))
      fail(form + ", and this one has " + std::to_string(n) + " numbers");
    Size_place<Point> place;
    bool has_radius = n == dimension + 2;
    place.size = {values[dimension], values[dimension]};
    if constexpr (dimension == 2) {
      place.position = {values[0], values[1]};
      place.has_direction = n > 4;
      if (place.has_direction) {
        place.size[1] = values[3];
        place.angle = values[4] * CGAL_PI / 180;
        has_radius = n == 6;
      }
    } else {
      place.position = {values[0], values[1], values[2]};
    }
    place.radius = has_radius ? values.back() : 2 * std::max(place.size[0], place.size[1]);
    if (!(place.size[0] > 0) || !(place.size[1] > 0) || !(place.radius > 0))
      fail("sizes and radii must be positive");
    places.push_back(place);
  }
  if (places.empty())
    throw Invalid_input_error(path + ": there is no size in this file; " + form);
  return places;
}

/// Answers which of some points is the nearest one.
template <class Point> class Nearest_point {
  using Kernel = Planar_domain::Kernel;
  using Entry = std::pair<Point, std::size_t>;
  using Base_traits = std::conditional_t<CGAL::Ambient_dimension<Point>::value == 2, CGAL::Search_traits_2<Kernel>,
                                         CGAL::Search_traits_3<Kernel>>;
  using Traits = CGAL::Search_traits_adapter<Entry, CGAL::First_of_pair_property_map<Entry>, Base_traits>;
  using Search = CGAL::Orthogonal_k_neighbor_search<Traits>;

public:
  explicit Nearest_point(const std::vector<Point>& points)
  {
    for (std::size_t i = 0; i < points.size(); ++i)
      m_tree.insert(Entry(points[i], i));
    m_tree.build();
  }
  std::size_t operator()(const Point& p) const { return Search(m_tree, p, 1).begin()->first.second; }

private:
  typename Search::Tree m_tree;
};

template <class Point>
Size_field sizes_around_places(const std::vector<Size_place<Point>>& places, const Triangulated_domain<Point>& domain)
{
  std::vector<Point> points, centers;
  for (const auto v : domain.mesh.vertices())
    points.push_back(domain.mesh.point(v));
  for (const Size_place<Point>& place : places)
    centers.push_back(place.position);
  const Nearest_point<Point> nearest_vertex(points), nearest_place(centers);

  Size_field field;
  field.size.assign(domain.mesh.number_of_vertices(), 0.0);
  if (std::any_of(places.begin(), places.end(), [](const auto& place) { return place.has_direction; }))
    field.metric.assign(domain.mesh.number_of_vertices(), Eigen::Matrix2d::Zero());
  const auto set = [&](std::size_t v, const Size_place<Point>& place) {
    field.size[v] = place.has_direction ? 0 : place.size[0];
    if (!field.metric.empty())
      field.metric[v] = place.has_direction ? place.metric() : Eigen::Matrix2d(Eigen::Matrix2d::Zero());
  };
  for (const Size_place<Point>& place : places)
    set(nearest_vertex(place.position), place);
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Size_place<Point>& place = places[nearest_place(points[v])];
    if (CGAL::squared_distance(place.position, points[v]) <= place.radius * place.radius)
      set(v, place);
  }
  return field;
}

/// The last view of a file at some points: of each the size, or (if `may_be_tensors`) the entries xx, xy, yy of the
/// metric; zero where there is none. Runs in the child process.
inline std::vector<double> probe_view(const std::string& path, const std::vector<std::array<double, 3>>& points,
                                      bool may_be_tensors)
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
    const auto probe = [&](const std::array<double, 3>& p, int n_components) {
      std::vector<double> values; // of all time steps
      gmsh::view::probe(views.back(), p[0], p[1], p[2], values, -1, n_components);
      if (values.size() > std::size_t(n_components))
        values.erase(values.begin(), values.end() - n_components);
      return values;
    };
    const bool has_tensors = may_be_tensors && std::any_of(points.begin(), points.end(),
                                                           [&](const auto& p) { return !probe(p, 9).empty(); });
    for (const std::array<double, 3>& p : points) {
      const std::vector<double> values = probe(p, has_tensors ? 9 : 1);
      if (values.empty()) {
        result.resize(result.size() + (has_tensors ? 3 : 1), 0.0);
        continue;
      }
      const std::string place =
          "(" + std::to_string(p[0]) + ", " + std::to_string(p[1]) + ", " + std::to_string(p[2]) + ")";
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

template <class Point>
Size_field load_size_field(const std::string& path, const Triangulated_domain<Point>& domain,
                           const std::vector<std::array<double, 3>>& points, double time_limit_seconds)
{
  constexpr bool is_planar = CGAL::Ambient_dimension<Point>::value == 2;
  const std::string ending = extension_of(path);
  if (ending == ".txt" || ending == ".csv")
    return sizes_around_places(parse_size_places<Point>(read_whole_file(path), path), domain);
  if (ending != ".pos" && ending != ".msh")
    throw Invalid_argument_error(path + ": the name of a size field has to end in .pos, .msh, .txt or .csv");
  check_readable(path); // Gmsh would only log it
  const std::vector<double> values = run_in_child_process<std::vector<double>>(
      [&] { return probe_view(path, points, is_planar); }, time_limit_seconds, path);
  if (std::none_of(values.begin(), values.end(), [](double value) { return value > 0; }))
    throw Invalid_input_error(path + ": the size field says nothing anywhere " +
                              (is_planar ? "inside the domain " : "on the surface ") + domain.source);
  Size_field field;
  if (values.size() == points.size()) {
    field.size = values;
  } else {
    for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
      field.metric.emplace_back();
      field.metric.back() << values[i], values[i + 1], values[i + 1], values[i + 2];
    }
  }
  return field;
}

} // namespace internal

QUADRILLE_INLINE Size_field read_size_field(const std::string& path, const Planar_domain& domain,
                                            double time_limit_seconds)
{
  std::vector<std::array<double, 3>> points;
  for (const auto v : domain.mesh.vertices())
    points.push_back({domain.mesh.point(v).x(), domain.mesh.point(v).y(), domain.z});
  return internal::load_size_field(path, domain, points, time_limit_seconds);
}

QUADRILLE_INLINE std::vector<double> read_size_field(const std::string& path, const Surface_domain& domain,
                                                     double time_limit_seconds)
{
  std::vector<std::array<double, 3>> points;
  for (const auto v : domain.mesh.vertices())
    points.push_back({domain.mesh.point(v).x(), domain.mesh.point(v).y(), domain.mesh.point(v).z()});
  return internal::load_size_field(path, domain, points, time_limit_seconds).size;
}

} // namespace Quadrille

#endif
