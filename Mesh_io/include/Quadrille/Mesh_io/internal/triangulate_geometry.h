// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_TRIANGULATE_GEOMETRY_H
#define QUADRILLE_MESH_IO_INTERNAL_TRIANGULATE_GEOMETRY_H

#include <Quadrille/Mesh_io/internal/Byte_archive.h>
#include <Quadrille/Mesh_io/internal/Segment_mesher.h>
#include <Quadrille/Mesh_io/internal/Triangle_size_estimator.h>
#include <Quadrille/Mesh_io/internal/Unit_frame.h>
#include <Quadrille/Mesh_io/internal/check_outline.h>
#include <Quadrille/Mesh_io/internal/load_outline.h>
#include <Quadrille/Mesh_io/internal/split_ears.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Unit tangents of a curve at the given parameters; zero where its derivative vanishes.
inline std::vector<std::array<double, 2>> tangents_at(const Outline::Curve& curve,
                                                      const std::vector<double>& parameters)
{
  std::vector<double> derivatives;
  gmsh::model::getDerivative(1, curve.label.tag, parameters, derivatives);
  std::vector<std::array<double, 2>> tangents(parameters.size(), {0, 0});
  for (std::size_t i = 0; i < parameters.size() && 3 * i + 1 < derivatives.size(); ++i) {
    const double length = std::hypot(derivatives[3 * i], derivatives[3 * i + 1]);
    if (length > 0 && std::isfinite(length))
      tangents[i] = {derivatives[3 * i] / length, derivatives[3 * i + 1] / length};
  }
  return tangents;
}

/// The geometry library's derivatives are differences, which are no longer exact far from the origin; those of straight
/// lines can be.
inline std::vector<std::array<double, 2>> tangents_of(const Outline& outline, const Outline::Curve& curve,
                                                      const std::vector<double>& parameters)
{
  if (!curve.straight)
    return tangents_at(curve, parameters);
  const Point_2 p = outline.points[std::size_t(curve.first)].position,
                q = outline.points[std::size_t(curve.last)].position;
  const double length = std::hypot(q.x() - p.x(), q.y() - p.y());
  return std::vector<std::array<double, 2>>(parameters.size(), {(q.x() - p.x()) / length, (q.y() - p.y()) / length});
}

/// \param unit `outline` in the coordinates in which `field` is given
inline Segmented_outline segment_outline(const Outline& outline, const Outline& unit,
                                         const Triangle_size_field<Point_2>& field)
{
  Segmented_outline result;
  for (const Outline::Point& point : outline.points)
    result.points.push_back(point.position);
  for (std::size_t c = 0; c < outline.curves.size(); ++c) {
    const Outline::Curve& curve = outline.curves[c];
    const std::vector<double> division = Triangle_size_estimator::subdivide(unit.curves[c], field, 1);
    std::vector<double> parameters;
    for (const double s : division)
      parameters.push_back(unit.curves[c].parameter_at(s));
    const std::vector<std::array<double, 2>> tangents = tangents_of(outline, curve, parameters);
    std::vector<Point_2> inner;
    if (parameters.size() > 2)
      inner = Outline_loader::evaluate(curve, {parameters.begin() + 1, parameters.end() - 1});
    result.segments_of_curve.emplace_back();
    int previous = curve.first;
    for (std::size_t i = 0; i <= inner.size(); ++i) {
      const int next = i < inner.size() ? int(result.points.size()) : curve.last;
      if (i < inner.size())
        result.points.push_back(inner[i]);
      result.segments_of_curve.back().push_back(int(result.segments.size()));
      result.segments.push_back({{previous, next}});
      result.curve_of_segment.push_back(int(c));
      result.tangents.push_back({tangents[i][0], tangents[i][1], tangents[i + 1][0], tangents[i + 1][1]});
      previous = next;
    }
  }
  return result;
}

/// About 2,200 triangles for a simple shape, before local refinement. Every hole beyond the first brings more
/// singularities to be placed, and a quarter more triangles, up to four times as many.
inline double default_triangle_size(const Outline& outline)
{
  std::vector<int> parent(outline.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int p) {
    while (parent[std::size_t(p)] != p)
      p = parent[std::size_t(p)] = parent[std::size_t(parent[std::size_t(p)])];
    return p;
  };
  int n_outlines = int(parent.size());
  for (const Outline::Curve& curve : outline.curves) {
    const int a = root(curve.first), b = root(curve.last);
    n_outlines -= a != b;
    parent[std::size_t(a)] = b;
  }
  return std::sqrt(covered_region(outline).area() / (950 * (1 + 0.25 * std::clamp(n_outlines - 2, 0, 12))));
}

/// Gmsh's current model, which is that of a planar geometry file, as labelled triangles. \throws Invalid_input_error
/// \param session ends once curves are sampled: triangles are made in a new one, without the options of the file
inline Geometry_triangulation triangulate_geometry(const std::string& path, const Planar_domain_options& options,
                                                   std::optional<Gmsh_session>& session)
{
  Geometry_triangulation result;
  Outline outline, unit;
  Segmented_outline segmented;
  std::optional<Unit_frame> frame;
  std::optional<Triangle_size_field<Point_2>> field;
  const Outline_checker checker(outline, path);
  outline = Outline_loader(path).load();
  checker.check_ends_and_straight_curves();
  frame.emplace(outline);
  unit = frame->to_unit(outline);
  if (!(covered_region(unit).area() > 0))
    throw Invalid_input_error(path + ": the curves enclose no area");
  const double size = options.triangle_size > 0 ? options.triangle_size / frame->extent() : default_triangle_size(unit);
  result.triangle_size = options.triangle_size > 0 ? options.triangle_size : size * frame->extent();
  if (options.refine_locally) {
    Planar_domain_options unit_options = options;
    for (auto& [name, curve_size] : unit_options.curve_triangle_size)
      curve_size /= frame->extent();
    Triangle_size_estimator estimator(unit, unit_options, size);
    field = estimator.estimate();
    if (estimator.coarsened())
      result.notes.push_back("details and gaps are too small for " + std::to_string(options.max_triangles) +
                             " triangles and not fully resolved; a smaller triangle size allows more");
  } else {
    field = Triangle_size_field<Point_2>(size, options.size_gradation, {});
  }
  Gmsh_session::call(path, [&] { segmented = segment_outline(outline, unit, *field); });
  session.reset();
  checker.check_segments(segmented, !result.notes.empty());
  result.notes.insert(result.notes.end(), outline.notes.begin(), outline.notes.end());

  Segmented_outline unit_segmented = segmented;
  for (Point_2& p : unit_segmented.points)
    p = frame->to_unit(p);
  std::vector<Point_2> points;
  std::vector<std::array<int, 3>> triangles;
  Labelled_mesh& mesh = result.mesh;
  Segment_mesher(unit, unit_segmented, *field, path).run(points, triangles, mesh.polygon_region);
  for (const Numbered_segment& segment : segmented.segments)
    mesh.lines.push_back(segment.ends);
  Ear_splitter(points, triangles, mesh.polygon_region, mesh.lines).run();

  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point_2 p = i < segmented.points.size() ? segmented.points[i] : frame->from_unit(points[i]);
    mesh.points.push_back({p.x(), p.y(), outline.z});
  }
  for (const std::array<int, 3>& t : triangles)
    mesh.polygons.push_back({t[0], t[1], t[2]});
  mesh.line_curve = segmented.curve_of_segment;
  result.line_tangents = segmented.tangents;
  for (const Outline::Curve& curve : outline.curves)
    mesh.curves.push_back(curve.label);
  for (const Outline::Surface& surface : outline.surfaces)
    mesh.regions.push_back(surface.label);
  mesh.groups = outline.groups;
  result.point_size.assign(points.size(), 0);
  for (std::size_t i = 0; i < outline.points.size(); ++i)
    result.point_size[i] = outline.points[i].size;
  return result;
}

} // namespace internal
} // namespace Quadrille

#endif
