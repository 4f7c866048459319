// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_EXTRACT_INDEXED_QUADS_IMPL_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_EXTRACT_INDEXED_QUADS_IMPL_H

#include <Quadrille/Quad_extraction/internal/Grid_displacements.h>
#include <Quadrille/Quad_extraction/internal/Lap_timer.h>
#include <Quadrille/Quad_extraction/internal/Layout_builder.h>
#include <Quadrille/Quad_extraction/internal/Quad_assembly.h>
#include <Quadrille/Quad_extraction/internal/Quad_checks.h>
#include <Quadrille/Quad_extraction/internal/Quad_smoother.h>
#include <Quadrille/Quad_extraction/internal/extract_indexed_quads.h>
#include <Quadrille/Quad_extraction/internal/quantize_layout.h>
#include <Quadrille/Quad_extraction/internal/refine_patches.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
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

/// By vertex: does a curve turn there by more than `degrees` in the plane or in space, though it goes straight on in
/// the map?
template <int D>
std::vector<char> kinks(const Seamless_map& map, const std::vector<Eigen::Matrix<double, D, 1>>& points, double degrees)
{
  const Indexed_triangulation& mesh = map.mesh();
  // Directions of the one or two curve edges at each vertex, all away from it; border edges leave and arrive.
  std::vector<std::vector<Eigen::Matrix<double, D, 1>>> away(points.size());
  for (int h = 0; h < mesh.number_of_halfedges(); ++h)
    if (map.is_constrained(h) && (mesh.is_boundary(h) || h < mesh.opposite(h))) {
      const Eigen::Matrix<double, D, 1> direction =
          (at(points, mesh.target(h)) - at(points, mesh.source(h))).normalized();
      at(away, mesh.source(h)).push_back(direction);
      at(away, mesh.target(h)).push_back(-direction);
    }
  const double cosine = std::cos(degrees * std::acos(-1.0) / 180);
  std::vector<char> result(points.size(), 0);
  for (std::size_t v = 0; v < away.size(); ++v)
    result[v] = away[v].size() == 2 && -away[v][0].dot(away[v][1]) < cosine ? 1 : 0;
  return result;
}

inline double angle_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

inline double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// A sector of k right angles in the map gets k quads, whose angles are below 180 degrees: so the sector must have less
/// than k times 180 degrees in the plane. \throws No_result_error naming the vertex.
template <int D>
void check_sector_angles(const Seamless_map& map, const std::vector<Eigen::Matrix<double, D, 1>>& points)
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
      const Eigen::Matrix<double, D, 1>& p = at(points, mesh.source(h));
      const Eigen::Matrix<double, D, 1> a = at(points, mesh.target(h)) - p;
      const Eigen::Matrix<double, D, 1> b = at(points, mesh.source(Indexed_triangulation::prev(h))) - p;
      angle += angle_between(a, b);
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

inline Quad_ground<2> quad_ground(const Seamless_map&, const std::vector<Eigen::Vector2d>&) { return {}; }

inline Quad_ground<3> quad_ground(const Seamless_map& map, const std::vector<Eigen::Vector3d>& points)
{
  return {map, points};
}

template <int D>
Indexed_quads<D> extract_indexed_quads(const Seamless_map& map, const std::vector<Eigen::Matrix<double, D, 1>>& points,
                                       const Quad_extraction_options& options, const Layout_quantizer& quantizer,
                                       const Curve_projection<D>& project, Quad_extraction_result& result)
{
  Lap_timer timer;
  report_progress(options, "layout", 0);
  check_sector_angles(map, points);
  const std::size_t max_steps =
      options.max_trace_steps > 0 ? options.max_trace_steps : 4 * std::size_t(map.mesh().number_of_faces()) + 1000;
  result.layout = build_layout(map, kinks(map, points, options.kink_degrees), options.layout, max_steps);
  const Quad_layout& layout = result.layout;
  const Layout_geometry<D> geometry(map, points, layout);
  const Quad_ground<D> ground = quad_ground(map, points);
  for (const Quad_layout::Arc& arc : layout.arcs) {
    result.arc_polylines.emplace_back();
    for (const Quad_layout::Arc_point& p : arc.points) {
      const Eigen::Matrix<double, D, 1> point = geometry.point(p.point);
      result.arc_polylines.back().push_back({point[0], point[1], D == 2 ? 0 : point[D - 1]});
    }
  }
  result.layout_seconds += timer.lap();

  Quad_smoothing_options smoothing = options.smoothing;
  smoothing.threads = options.threads;
  smoothing.observer = options.observer;
  Indexed_quads<D> quads;
  const Quad_checks<D> checks(quads);
  Length_constraints constraints(layout, options.min_loop_edges, options.counts);
  Layout_quantization quantization(layout, quantizer, options, constraints);
  constexpr int max_vain_refinements = 1; // in a row, after which fewer places than ever have to be too coarse
  std::size_t least_places = std::numeric_limits<std::size_t>::max();
  int best_attempt = 0;
  for (int attempt = 0;; ++attempt) {
    report_progress(options, "quantization", 0);
    const double work_before = result.quantization.work;
    result.quantization = quantization.run();
    result.quantization.work += work_before;
    result.scale = quantization.scale();
    result.area_change_relative =
        number_of_quads(layout, result.quantization.lengths) / map_area(quantization.scaled()) - 1;
    result.collapsed_arcs =
        static_cast<int>(std::count(result.quantization.lengths.begin(), result.quantization.lengths.end(), 0));
    result.quantization_seconds += timer.lap();

    report_progress(options, "mesh", 0);
    quads = Quad_assembly<D>(layout, Collapsed_layout(layout, result.quantization.lengths), geometry).build();
    checks.check_topology();
    result.mesh_seconds += timer.lap();
    if (!options.smooth)
      break;
    result.smoothing = Quad_smoother<D>(quads, ground, smoothing).run(project);
    result.smoothing.seconds = timer.lap();
    result.mesh_seconds += result.smoothing.seconds;
    result.refinements = attempt;
    if (attempt == options.max_refinements)
      break;
    const std::size_t n_places =
        refine_patches(quads, inverted_quads(quads, ground), layout, result.quantization.lengths, constraints);
    if (n_places < least_places)
      best_attempt = attempt;
    least_places = std::min(least_places, n_places);
    if (n_places == 0 || attempt > best_attempt + max_vain_refinements)
      break;
  }
  if (options.smooth)
    checks.check_geometry(inverted_quads(quads, ground));
  if (options.displacements)
    result.displacements = Grid_displacements(map, layout, result.quantization.lengths).run();
  result.irregular_vertices = checks.irregular_vertices();
  for (const typename Indexed_quads<D>::Vertex& vertex : quads.vertices)
    result.vertices.push_back({vertex.input_vertex, vertex.chain < 0 ? -1 : at(quads.curves, vertex.chain).curve()});
  for (const typename Indexed_quads<D>::Curve_edge& edge : quads.curve_edges)
    result.curve_edges.push_back({edge.source, edge.target, edge.curve, edge.border});
  result.quad_regions = quads.region;
  result.mesh_seconds += timer.lap();
  return quads;
}

} // namespace internal::extraction
} // namespace Quadrille

#endif
