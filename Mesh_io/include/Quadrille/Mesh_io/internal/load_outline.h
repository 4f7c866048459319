// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_LOAD_OUTLINE_H
#define QUADRILLE_MESH_IO_INTERNAL_LOAD_OUTLINE_H

#include <Quadrille/Mesh_io/internal/Gmsh_session.h>
#include <Quadrille/Mesh_io/internal/Outline.h>
#include <Quadrille/Mesh_io/internal/check_triangles.h>
#include <Quadrille/Mesh_io/internal/format_place.h>
#include <Quadrille/Mesh_io/internal/point_sizes.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

/// Reads Gmsh's current model into an `Outline`. The Gmsh session has to outlive it: curves are evaluated later, too.
class Outline_loader {
public:
  explicit Outline_loader(const std::string& path) : m_path(path) {}

  Outline load()
  {
    Gmsh_session::call(m_path, [&] {
      add_surfaces();
      sample_curves();
      check_planar();
    });
    check_closed();
    const std::map<int, double> sizes = read_point_sizes();
    for (Outline::Point& point : m_outline.points)
      if (const auto size = sizes.find(point.tag); size != sizes.end())
        point.size = size->second;
    return std::move(m_outline);
  }

  /// Positions at the given parameters of curve `c`.
  static std::vector<Point_2> evaluate(const Outline::Curve& curve, const std::vector<double>& parameters)
  {
    std::vector<double> xyz;
    gmsh::model::getValue(1, curve.label.tag, parameters, xyz);
    std::vector<Point_2> points;
    for (std::size_t i = 0; i + 2 < xyz.size(); i += 3)
      points.push_back(Point_2(xyz[i], xyz[i + 1]) + curve.correction_at(parameters[i / 3]));
    return points;
  }

private:
  [[noreturn]] void fail(const std::string& reason) const { throw Invalid_input_error(m_path + ": " + reason); }

  void add_surfaces()
  {
    const Gmsh_groups groups;
    m_outline.groups = groups.groups;
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, 3);
    if (!entities.empty())
      fail("the file has volumes: a 3D model was given where a planar domain is needed");
    gmsh::model::getEntities(entities, 2);
    if (entities.empty())
      fail("the geometry has no surfaces; a planar domain is made of plane surfaces (in a .geo file: Plane Surface)");
    // As Gmsh itself does when it saves: groups of surfaces, where there are any, say what belongs to the model.
    const bool grouped = std::any_of(groups.groups.begin(), groups.groups.end(),
                                     [](const Physical_group& group) { return group.dimension == 2; });
    for (const auto& [dimension, tag] : entities) {
      const auto names = groups.names.find({2, tag});
      if (grouped && names == groups.names.end())
        continue;
      std::string type;
      gmsh::model::getType(2, tag, type);
      if (type.find("Discrete") != std::string::npos)
        fail("surface " + std::to_string(tag) + " is a mesh, not a geometry; give the mesh file itself");
      Outline::Surface surface;
      surface.label = {tag, names == groups.names.end() ? std::vector<std::string>() : names->second};
      gmsh::vectorpair boundary, embedded;
      gmsh::model::getBoundary({{2, tag}}, boundary, false, false);
      gmsh::model::mesh::getEmbedded(2, tag, embedded);
      std::map<int, int> uses;
      for (const auto& [d, curve] : boundary)
        ++uses[std::abs(curve)];
      for (const auto& [curve, n] : uses) {
        // A curve that a surface has on both sides is a slit: inside, not on the boundary.
        const int index = curve_index(curve, groups);
        (n % 2 == 1 ? surface.boundary : surface.embedded).push_back(index);
        m_outline.curves[std::size_t(index)].n_surfaces += n % 2;
      }
      for (const auto& [d, curve] : embedded)
        if (d == 1)
          surface.embedded.push_back(curve_index(std::abs(curve), groups));
      if (surface.boundary.empty())
        fail("surface " + std::to_string(tag) + " has no boundary curves");
      m_outline.surfaces.push_back(std::move(surface));
    }
  }

  int curve_index(int tag, const Gmsh_groups& groups)
  {
    const auto [entry, is_new] = m_curve_index.emplace(tag, int(m_outline.curves.size()));
    if (is_new) {
      const auto names = groups.names.find({1, tag});
      m_outline.curves.emplace_back();
      m_outline.curves.back().label = {tag, names == groups.names.end() ? std::vector<std::string>() : names->second};
    }
    return entry->second;
  }

  int point_index(int tag, double& z)
  {
    std::vector<double> xyz;
    gmsh::model::getValue(0, tag, {}, xyz);
    z = xyz[2];
    const auto [entry, is_new] = m_point_index.emplace(tag, int(m_outline.points.size()));
    if (is_new)
      m_outline.points.push_back({tag, Point_2(xyz[0], xyz[1]), 0});
    return entry->second;
  }

  void sample_curves()
  {
    for (Outline::Curve& curve : m_outline.curves) {
      std::string type;
      gmsh::model::getType(1, curve.label.tag, type);
      curve.straight = type == "Line";
      std::vector<double> low, high;
      gmsh::model::getParametrizationBounds(1, curve.label.tag, low, high);
      sample(curve, low[0], high[0]);
      if (!(curve.length() > 0) || !std::isfinite(curve.length()))
        fail("curve " + std::to_string(curve.label.tag) + " has no length or is not finite");
      attach_ends(curve);
    }
  }

  /// Doubles the number of samples until neither length nor direction changes much from one to the next.
  void sample(Outline::Curve& curve, double low, double high)
  {
    double previous_length = 0;
    for (std::size_t n = curve.straight ? 1 : 32; n <= 4096; n *= 2) {
      curve.parameter.resize(n + 1);
      for (std::size_t i = 0; i <= n; ++i)
        curve.parameter[i] = i == n ? high : low + (high - low) * double(i) / double(n);
      curve.position = sampled_positions(curve.label.tag, curve.parameter);
      curve.arc_length.assign(1, 0);
      double largest_turn = 0;
      for (std::size_t i = 1; i <= n; ++i) {
        curve.arc_length.push_back(curve.arc_length.back() + distance(curve.position[i - 1], curve.position[i]));
        if (i > 1)
          largest_turn = std::max(largest_turn, turn(curve.position[i - 2], curve.position[i - 1], curve.position[i]));
      }
      const double length = curve.length();
      if (curve.straight || !std::isfinite(length) ||
          (largest_turn < 0.07 && std::abs(length - previous_length) <= 1e-4 * length))
        return;
      previous_length = length;
    }
  }

  std::vector<Point_2> sampled_positions(int tag, const std::vector<double>& parameters)
  {
    std::vector<double> xyz;
    gmsh::model::getValue(1, tag, parameters, xyz);
    if (xyz.size() != 3 * parameters.size())
      fail("curve " + std::to_string(tag) + " cannot be evaluated");
    std::vector<Point_2> points;
    for (std::size_t i = 0; i < xyz.size(); i += 3) {
      if (!std::isfinite(xyz[i]) || !std::isfinite(xyz[i + 1]) || !std::isfinite(xyz[i + 2]))
        fail("curve " + std::to_string(tag) + " has points that are not finite");
      points.emplace_back(xyz[i], xyz[i + 1]);
      note_z(xyz[i + 2], "curve " + std::to_string(tag));
    }
    return points;
  }

  /// Finds the model points at the curve's two ends, by position: Gmsh does not say which is which.
  void attach_ends(Outline::Curve& curve)
  {
    gmsh::vectorpair ends;
    gmsh::model::getBoundary({{1, curve.label.tag}}, ends, false, false);
    std::set<int> candidates;
    for (const auto& [d, tag] : ends) {
      double z = 0;
      candidates.insert(point_index(std::abs(tag), z));
    }
    if (candidates.empty()) { // a closed curve without points: its start becomes one
      candidates.insert(int(m_outline.points.size()));
      m_outline.points.push_back({-curve.label.tag, curve.position.front(), 0});
    }
    const auto nearest = [&](const Point_2& p) {
      return *std::min_element(candidates.begin(), candidates.end(), [&](int a, int b) {
        return distance(m_outline.points[std::size_t(a)].position, p) <
               distance(m_outline.points[std::size_t(b)].position, p);
      });
    };
    // The periodic splines of the built-in kernel do not pass through the point that starts and ends them.
    const Outline::Point& only = m_outline.points[std::size_t(*candidates.begin())];
    if (candidates.size() == 1 && distance(curve.position.front(), curve.position.back()) < 1e-9 * curve.length() &&
        distance(only.position, curve.position.front()) > 1e-3 * curve.length()) {
      candidates = {int(m_outline.points.size())};
      m_outline.points.push_back({only.tag, curve.position.front(), 0});
    }
    curve.first = nearest(curve.position.front());
    curve.last = nearest(curve.position.back());
    close_gaps(curve);
  }

  /// Circular arcs whose end points have different distances from the centre, for instance, miss one of them.
  void close_gaps(Outline::Curve& curve)
  {
    const Point_2 &first = m_outline.points[std::size_t(curve.first)].position,
                  &last = m_outline.points[std::size_t(curve.last)].position;
    curve.end_gap = {first - curve.position.front(), last - curve.position.back()};
    const double gap = std::sqrt(std::max(curve.end_gap[0].squared_length(), curve.end_gap[1].squared_length()));
    const std::string text = "curve " + std::to_string(curve.label.tag) + " misses its end points by " +
                             format_length(gap) + " (its length is " + format_length(curve.length()) + ")";
    if (gap > 1e-2 * curve.length())
      fail(text + "; an arc's ends, for instance, must have the same distance from its centre");
    if (gap > 1e-6 * curve.length())
      m_outline.notes.push_back(text + ", and was bent to end there");
    for (std::size_t i = 0; i < curve.position.size(); ++i)
      curve.position[i] = curve.position[i] + curve.correction_at(curve.parameter[i]);
    curve.position.front() = first;
    curve.position.back() = last;
  }

  static std::string format_length(double length)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", length);
    return text;
  }

  static double turn(const Point_2& a, const Point_2& b, const Point_2& c)
  {
    const auto u = b - a, v = c - b;
    return std::abs(std::atan2(u.x() * v.y() - u.y() * v.x(), u * v));
  }

  void note_z(double z, const std::string& where)
  {
    if (!m_has_z) {
      m_has_z = true;
      m_outline.z = z;
    }
    if (std::abs(z - m_outline.z) > m_largest_z_difference) {
      m_largest_z_difference = std::abs(z - m_outline.z);
      m_place_of_z = where;
    }
  }

  void check_planar()
  {
    const CGAL::Bbox_2 box = m_outline.bbox();
    for (const Outline::Surface& surface : m_outline.surfaces)
      sample_surface(surface.label.tag);
    const double extent = std::max(box.xmax() - box.xmin(), box.ymax() - box.ymin());
    // Geometry kernels represent planes by rounded rotations, so a looser bound than for meshes.
    if (m_largest_z_difference > 1e-7 * extent)
      fail("z is not constant (" + m_place_of_z +
           "): a surface was given where a planar domain, in a plane z = constant, is needed");
  }

  /// A curved surface can have a plane boundary, so look inside as well.
  void sample_surface(int tag)
  {
    std::string type;
    gmsh::model::getType(2, tag, type);
    if (type.find("Plane") != std::string::npos)
      return;
    std::vector<double> low, high, uv, xyz;
    gmsh::model::getParametrizationBounds(2, tag, low, high);
    for (int i = 1; i < 8; ++i)
      for (int j = 1; j < 8; ++j) {
        uv.push_back(low[0] + (high[0] - low[0]) * i / 8);
        uv.push_back(low[1] + (high[1] - low[1]) * j / 8);
      }
    gmsh::model::getValue(2, tag, uv, xyz);
    for (std::size_t i = 2; i < xyz.size(); i += 3)
      note_z(xyz[i], "surface " + std::to_string(tag));
  }

  void check_closed() const
  {
    for (const Outline::Surface& surface : m_outline.surfaces) {
      std::map<int, int> degree;
      for (const int c : surface.boundary) {
        ++degree[m_outline.curves[std::size_t(c)].first];
        ++degree[m_outline.curves[std::size_t(c)].last];
      }
      for (const auto& [p, n] : degree)
        if (n % 2 == 1) {
          const Outline::Point& point = m_outline.points[std::size_t(p)];
          fail("the outline of surface " + std::to_string(surface.label.tag) + " is open at point " +
               std::to_string(point.tag) + ", " + format_place(point.position.x(), point.position.y()) +
               ": a curve ends there and none goes on");
        }
    }
  }

  const std::string& m_path;
  Outline m_outline;
  std::map<int, int> m_curve_index, m_point_index; ///< by tag
  bool m_has_z = false;
  double m_largest_z_difference = 0;
  std::string m_place_of_z;
};

} // namespace internal
} // namespace Quadrille

#endif
