// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_TRIANGULATE_GEOMETRY_H
#define QUADRILLE_MESH_IO_INTERNAL_TRIANGULATE_GEOMETRY_H

#include <Quadrille/Mesh_io/internal/Byte_archive.h>
#include <Quadrille/Mesh_io/internal/Triangle_size_estimator.h>
#include <Quadrille/Mesh_io/internal/Unit_frame.h>
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

/// The curves of an outline as line segments between numbered points.
struct Segmented_outline {
  std::vector<Point_2> points; ///< the outline's own points first
  std::vector<Numbered_segment> segments;
  std::vector<int> curve_of_segment;
  std::vector<std::vector<int>> segments_of_curve;
  std::vector<std::array<double, 4>> tangents; ///< per segment, unit vectors at its two ends
};

/// Unit tangents of a curve at the given parameters; zero where its derivative vanishes.
inline std::vector<std::array<double, 2>> tangents_at(const Outline::Curve& curve, const std::vector<double>& parameters)
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

/// \param unit `outline` in the coordinates in which `field` is given
inline Segmented_outline segment_outline(const Outline& outline, const Outline& unit, const Triangle_size_field& field)
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
    const std::vector<std::array<double, 2>> tangents = tangents_at(curve, parameters);
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

inline void check_no_conflict(const Outline& outline, const Segmented_outline& segmented, const std::string& path)
{
  const auto pair = find_segment_conflict(segmented.points, segmented.segments);
  if (!pair)
    return;
  const auto tag = [&](std::size_t s) {
    return std::to_string(outline.curves[std::size_t(segmented.curve_of_segment[s])].label.tag);
  };
  const Point_2& p = segmented.points[std::size_t(segmented.segments[pair->first].ends[0])];
  const std::string place = Triangle_checker::format_place(p.x(), p.y());
  const std::string a = tag(pair->first), b = tag(pair->second);
  if (a == b)
    throw Invalid_input_error(path + ": curve " + a + " intersects itself near " + place);
  throw Invalid_input_error(path + ": the outline intersects itself: curves " + a + " and " + b +
                            " cross, touch or overlap near " + place + " without a common point there");
}

/// Meshes the surfaces between given segments by Gmsh in a session of its own and in the unit square, so that neither
/// the user's Gmsh options nor absolute tolerances matter.
class Segment_mesher {
public:
  /// All in unit coordinates.
  Segment_mesher(const Outline& outline, const Segmented_outline& segmented, const Triangle_size_field& field,
                 const std::string& path)
      : m_outline(outline), m_segmented(segmented), m_field(field), m_path(path)
  {
  }

  void run(std::vector<Point_2>& points, std::vector<std::array<int, 3>>& triangles, std::vector<int>& regions)
  {
    const Gmsh_session session;
    Gmsh_session::call(m_path, [&] {
      add_model();
      set_options();
      gmsh::model::mesh::generate(2);
      gmsh::model::mesh::removeSizeCallback();
      collect(points, triangles, regions);
    });
    const std::string error = session.first_error();
    if (!error.empty())
      throw Invalid_input_error(m_path + ": the surfaces cannot be triangulated: " + error);
  }

private:
  void add_model() const
  {
    gmsh::model::add("outline");
    for (std::size_t i = 0; i < m_segmented.points.size(); ++i)
      gmsh::model::geo::addPoint(m_segmented.points[i].x(), m_segmented.points[i].y(), 0, 0, int(i) + 1);
    for (std::size_t s = 0; s < m_segmented.segments.size(); ++s) {
      const std::array<int, 2>& ends = m_segmented.segments[s].ends;
      gmsh::model::geo::addLine(ends[0] + 1, ends[1] + 1, int(s) + 1);
      gmsh::model::geo::mesh::setTransfiniteCurve(int(s) + 1, 2);
    }
    int n_loops = 0;
    for (std::size_t f = 0; f < m_outline.surfaces.size(); ++f) {
      std::vector<int> loop_tags;
      for (const std::vector<int>& loop : loops_of(m_outline.surfaces[f])) {
        gmsh::model::geo::addCurveLoop(loop, ++n_loops);
        loop_tags.push_back(n_loops);
      }
      gmsh::model::geo::addPlaneSurface(loop_tags, int(f) + 1);
    }
    gmsh::model::geo::synchronize();
    for (std::size_t f = 0; f < m_outline.surfaces.size(); ++f) {
      std::vector<int> embedded;
      for (const int c : m_outline.surfaces[f].embedded)
        for (const int s : m_segmented.segments_of_curve[std::size_t(c)])
          embedded.push_back(s + 1);
      if (!embedded.empty())
        gmsh::model::mesh::embed(1, embedded, 2, int(f) + 1);
    }
  }

  /// Closed loops of signed segment tags that use each boundary segment once, the one with the largest box first.
  std::vector<std::vector<int>> loops_of(const Outline::Surface& surface) const
  {
    std::map<int, std::vector<int>> leaving; // point -> signed segment tags
    std::vector<int> order;
    for (const int c : surface.boundary)
      for (const int s : m_segmented.segments_of_curve[std::size_t(c)]) {
        leaving[m_segmented.segments[std::size_t(s)].ends[0]].push_back(s + 1);
        leaving[m_segmented.segments[std::size_t(s)].ends[1]].push_back(-(s + 1));
        order.push_back(s + 1);
      }
    std::map<int, bool> used;
    std::vector<std::pair<double, std::vector<int>>> loops;
    for (const int seed : order) {
      if (used[seed])
        continue;
      std::vector<int> loop{seed};
      used[seed] = true;
      CGAL::Bbox_2 box;
      const int start = end(-seed);
      for (int point = end(seed); point != start; point = end(loop.back())) {
        box += m_segmented.points[std::size_t(point)].bbox();
        const std::vector<int>& candidates = leaving[point];
        const auto next = std::find_if(candidates.begin(), candidates.end(),
                                       [&](int candidate) { return !used[std::abs(candidate)]; });
        used[std::abs(*next)] = true; // exists: every point has an even number of segments
        loop.push_back(*next);
      }
      box += m_segmented.points[std::size_t(start)].bbox();
      loops.emplace_back((box.xmax() - box.xmin()) + (box.ymax() - box.ymin()), std::move(loop));
    }
    std::stable_sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::vector<int>> result;
    for (auto& [size, loop] : loops)
      result.push_back(std::move(loop));
    return result;
  }

  /// The point where a signed segment ends.
  int end(int signed_tag) const
  {
    return m_segmented.segments[std::size_t(std::abs(signed_tag) - 1)].ends[signed_tag > 0 ? 1 : 0];
  }

  void set_options() const
  {
    gmsh::option::setNumber("Mesh.Algorithm", 6); // Frontal-Delaunay
    gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
    gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 0);
    gmsh::option::setNumber("Mesh.MaxNumThreads2D", 1);
    gmsh::model::mesh::setSizeCallback(
        [this](int, int, double x, double y, double) { return m_field(Point_2(x, y)); });
  }

  void collect(std::vector<Point_2>& points, std::vector<std::array<int, 3>>& triangles,
               std::vector<int>& regions) const
  {
    points = m_segmented.points;
    std::map<std::size_t, int> index;
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    for (std::size_t i = 0; i < points.size(); ++i) {
      gmsh::model::mesh::getNodes(tags, coordinates, parameters, 0, int(i) + 1);
      if (!tags.empty())
        index[tags[0]] = int(i);
    }
    for (std::size_t f = 0; f < m_outline.surfaces.size(); ++f) {
      gmsh::model::mesh::getNodes(tags, coordinates, parameters, 2, int(f) + 1);
      for (std::size_t i = 0; i < tags.size(); ++i) {
        index[tags[i]] = int(points.size());
        points.emplace_back(coordinates[3 * i], coordinates[3 * i + 1]);
      }
      std::vector<std::size_t> elements, nodes; // Gmsh takes vectors that are not empty as preallocated
      gmsh::model::mesh::getElementsByType(2, elements, nodes, int(f) + 1);
      for (std::size_t i = 0; i + 2 < nodes.size(); i += 3) {
        std::array<int, 3> triangle;
        for (std::size_t k = 0; k < 3; ++k) {
          const auto found = index.find(nodes[i + k]);
          if (found == index.end())
            throw Invalid_input_error("Gmsh split a boundary segment of surface " +
                                      std::to_string(m_outline.surfaces[f].label.tag));
          triangle[k] = found->second;
        }
        if (CGAL::orientation(points[std::size_t(triangle[0])], points[std::size_t(triangle[1])],
                              points[std::size_t(triangle[2])]) == CGAL::CLOCKWISE)
          std::swap(triangle[1], triangle[2]);
        triangles.push_back(triangle);
        regions.push_back(int(f));
      }
    }
  }

  const Outline& m_outline;
  const Segmented_outline& m_segmented;
  const Triangle_size_field& m_field;
  const std::string& m_path;
};

/// About 2,200 triangles for a simple shape, before local refinement. Every hole beyond the first brings more
/// singularities to be placed, and a quarter more triangles.
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
  return std::sqrt(covered_region(outline).area() / (950 * (1 + 0.25 * std::max(0, n_outlines - 2))));
}

/// A geometry file as labelled triangles. \throws Invalid_input_error
inline Geometry_triangulation triangulate_geometry(const std::string& path, const Planar_domain_options& options)
{
  Geometry_triangulation result;
  Outline outline, unit;
  Segmented_outline segmented;
  std::optional<Unit_frame> frame;
  std::optional<Triangle_size_field> field;
  {
    const Gmsh_session session;
    outline = Outline_loader(path).load(session);
    frame.emplace(outline);
    unit = frame->to_unit(outline);
    const double size =
        options.triangle_size > 0 ? options.triangle_size / frame->extent() : default_triangle_size(unit);
    result.triangle_size = options.triangle_size > 0 ? options.triangle_size : size * frame->extent();
    field = options.refine_locally ? Triangle_size_estimator(unit, options, size).estimate()
                                   : Triangle_size_field(size, options.size_gradation, {});
    Gmsh_session::call(path, [&] { segmented = segment_outline(outline, unit, *field); });
  }
  check_no_conflict(outline, segmented, path);

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
