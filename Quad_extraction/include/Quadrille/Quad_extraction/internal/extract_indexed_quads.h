// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_EXTRACT_INDEXED_QUADS_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_EXTRACT_INDEXED_QUADS_H

#include <Quadrille/Quad_extraction/internal/Lap_timer.h>
#include <Quadrille/Quad_extraction/internal/Layout_builder.h>
#include <Quadrille/Quad_extraction/internal/Quad_assembly.h>
#include <Quadrille/Quad_extraction/internal/Quad_checks.h>
#include <Quadrille/Quad_extraction/internal/Quad_smoother.h>
#include <Quadrille/Quad_extraction_options.h>
#include <Quadrille/Strip_constraints.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

inline void report_progress(const Quad_extraction_options& options, const char* stage, double fraction)
{
  if (options.observer)
    options.observer->report(stage, fraction);
}

/// By vertex: does a curve turn there by more than `degrees` in the plane, though it goes straight on in the map?
inline std::vector<char> kinks(const Seamless_map& map, const std::vector<Eigen::Vector2d>& points, double degrees)
{
  const Indexed_triangulation& mesh = map.mesh();
  // Directions of the one or two curve edges at each vertex, all away from it; border edges leave and arrive.
  std::vector<std::vector<Eigen::Vector2d>> away(points.size());
  for (int h = 0; h < mesh.number_of_halfedges(); ++h)
    if (map.is_constrained(h) && (mesh.is_boundary(h) || h < mesh.opposite(h))) {
      const Eigen::Vector2d direction = (at(points, mesh.target(h)) - at(points, mesh.source(h))).normalized();
      at(away, mesh.source(h)).push_back(direction);
      at(away, mesh.target(h)).push_back(-direction);
    }
  const double cosine = std::cos(degrees * std::acos(-1.0) / 180);
  std::vector<char> result(points.size(), 0);
  for (std::size_t v = 0; v < away.size(); ++v)
    result[v] = away[v].size() == 2 && -away[v][0].dot(away[v][1]) < cosine ? 1 : 0;
  return result;
}

/// A sector of k right angles in the map gets k quads, whose angles are below 180 degrees: so the sector must have less
/// than k times 180 degrees in the plane. \throws No_result_error naming the vertex.
inline void check_sector_angles(const Seamless_map& map, const std::vector<Eigen::Vector2d>& points)
{
  const Indexed_triangulation& mesh = map.mesh();
  const double straight = std::acos(-1.0);
  std::array<int, 2> axes = {};
  for (int start = 0; start < mesh.number_of_halfedges(); ++start) {
    if (!map.is_constrained(start))
      continue;
    double angle = 0;
    int right_angles = 0;
    int h = start;
    do { // the corners up to the next curve
      const Eigen::Vector2d& p = at(points, mesh.source(h));
      const Eigen::Vector2d a = at(points, mesh.target(h)) - p;
      const Eigen::Vector2d b = at(points, mesh.source(Indexed_triangulation::prev(h))) - p;
      angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
      right_angles += map.corner_axes(h, axes);
      h = mesh.next_around_source(h);
    } while (h >= 0 && h != start && !map.is_constrained(h));
    if (angle >= right_angles * straight)
      throw No_result_error(
          "map", "the map has " + std::to_string(right_angles) + " right angle(s) where the domain has " +
                     std::to_string(static_cast<int>(std::lround(180 * angle / straight))) + " degrees, at vertex " +
                     std::to_string(mesh.source(start)) + ": no quads with convex corners fit there");
  }
}

/// Fixes all strips; a quantizer's answer that breaks the constraints is an error of its own.
template <class Quantizer>
std::vector<int> quantize(const Quad_layout& layout, const Quantizer& quantizer, int min_loop_edges,
                          const std::vector<int>& min_length)
{
  Strip_constraints constraints(layout, min_loop_edges, min_length);
  std::vector<int> length = quantizer(layout, constraints);
  if (length.size() != layout.strips.size())
    throw No_result_error("quantization", "the quantizer returned " + std::to_string(length.size()) + " lengths for " +
                                              std::to_string(layout.strips.size()) + " strips");
  Strip_constraints check(layout, min_loop_edges, min_length);
  for (int s = 0; s < size_of(length); ++s)
    if (at(length, s) < 0 || check.fix(s, at(length, s)) != at(length, s))
      throw No_result_error("quantization", "the length " + std::to_string(at(length, s)) + " of strip " +
                                                std::to_string(s) + " would merge what must stay apart");
  return length;
}

/// Sets `result.area_change_relative`, `collapsed_strips`. \throws No_result_error if there are too many quads.
inline void judge_quantization(const Quad_extraction_options& options, Quad_extraction_result& result)
{
  const Quad_layout& layout = result.layout;
  double before = 0;
  double after = 0;
  for (const Quad_layout::Patch& patch : layout.patches) {
    const Quad_layout::Arc& a = at(layout.arcs, patch.half_arcs[0] / 2);
    const Quad_layout::Arc& b = at(layout.arcs, patch.half_arcs[1] / 2);
    before += a.length * b.length;
    after += double(at(result.strip_length, a.strip)) * at(result.strip_length, b.strip);
  }
  result.area_change_relative = (after - before) / before;
  result.collapsed_strips = static_cast<int>(std::count(result.strip_length.begin(), result.strip_length.end(), 0));
  if (after > double(options.max_quads))
    throw No_result_error("quantization", "the mesh would have " + std::to_string(after) +
                                              " quads; ask for larger elements or raise max_quads");
}

/// Asks for one more quad across every strip with an inverted quad. Returns false if there is none.
inline bool refine_strips(const Indexed_quads& quads, const Quad_layout& layout, const std::vector<int>& strip_length,
                          std::vector<int>& min_length)
{
  min_length.resize(layout.strips.size(), 0);
  bool refined = false;
  for (int q = 0; q < size_of(quads.quads); ++q)
    if (!is_convex(quads.points, at(quads.quads, q)))
      for (std::size_t side = 0; side < 2; ++side) {
        const int arc = at(layout.patches, at(quads.patch, q)).half_arcs[side] / 2;
        const int strip = at(layout.arcs, arc).strip;
        at(min_length, strip) = at(strip_length, strip) + 1;
        refined = true;
      }
  return refined;
}

/// From index arrays to a quad mesh as index arrays; `extract_quads` without CGAL.
template <class Quantizer, class Projector>
Indexed_quads extract_indexed_quads(const Seamless_map& map, const std::vector<Eigen::Vector2d>& points,
                                    const Quad_extraction_options& options, const Quantizer& quantizer,
                                    const Projector& project, Quad_extraction_result& result)
{
  Lap_timer timer;
  report_progress(options, "layout", 0);
  check_sector_angles(map, points);
  const std::size_t max_steps =
      options.max_trace_steps > 0 ? options.max_trace_steps : 4 * std::size_t(map.mesh().number_of_faces()) + 1000;
  result.layout = build_layout(map, kinks(map, points, options.kink_degrees), max_steps);
  const Quad_layout& layout = result.layout;
  const Layout_geometry geometry(map, points, layout);
  for (const Quad_layout::Arc& arc : layout.arcs) {
    result.arc_polylines.emplace_back();
    for (const Quad_layout::Arc_point& p : arc.points) {
      const Eigen::Vector2d point = geometry.point(p.point);
      result.arc_polylines.back().push_back({point.x(), point.y()});
    }
  }
  result.layout_seconds += timer.lap();

  Quad_smoothing_options smoothing = options.smoothing;
  smoothing.threads = options.threads;
  smoothing.observer = options.observer;
  Indexed_quads quads;
  const Quad_checks checks(quads);
  std::vector<int> min_length;
  for (int attempt = 0;; ++attempt) {
    report_progress(options, "quantization", 0);
    result.strip_length = quantize(layout, quantizer, options.min_loop_edges, min_length);
    judge_quantization(options, result);
    result.quantization_seconds += timer.lap();

    report_progress(options, "mesh", 0);
    quads = Quad_assembly(layout, Collapsed_layout(layout, result.strip_length), geometry).build();
    checks.check_topology();
    result.mesh_seconds += timer.lap();
    if (!options.smooth)
      break;
    result.smoothing = Quad_smoother(quads, smoothing).run(project);
    result.smoothing.seconds = timer.lap();
    result.mesh_seconds += result.smoothing.seconds;
    result.refinements = attempt;
    if (attempt == options.max_refinements || !refine_strips(quads, layout, result.strip_length, min_length))
      break;
  }
  if (options.smooth)
    checks.check_geometry();
  result.irregular_vertices = checks.irregular_vertices();
  for (const Indexed_quads::Vertex& vertex : quads.vertices)
    result.vertices.push_back({vertex.input_vertex, vertex.chain < 0 ? -1 : at(quads.curves, vertex.chain).curve()});
  for (const Indexed_quads::Curve_edge& edge : quads.curve_edges)
    result.curve_edges.push_back({edge.source, edge.target, edge.curve, edge.border});
  result.quad_regions = quads.region;
  result.mesh_seconds += timer.lap();
  return quads;
}

} // namespace internal::extraction
} // namespace Quadrille

#endif
