// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Surface_pipeline.h"

#include "field_maps.h"
#include "folded_map.h"
#include "labelled_quads.h"

#include <Quadrille/Surface_tangent_traits.h>
#include <Quadrille/frame_field_topology.h>
#include <Quadrille/odeco_surface_field.h>
#include <Quadrille/quad_extraction.h>

#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace Quadrille {

namespace {

using Mesh = Surface_domain::Mesh;
using Point_2 = Planar_domain::Point_2;

auto tangent_traits(const Surface_domain& domain)
{
  return Surface_tangent_traits<Mesh, Mesh::Property_map<Surface_domain::vertex_descriptor, Surface_domain::Point_3>>(
      domain.mesh, domain.mesh.points());
}

Seamless_map<Mesh> integrate(const Surface_domain& domain, std::vector<Gradient_pair> gradients,
                             const Seamless_parametrization_options& options, std::vector<Point_2>& corner_uv)
{
  corner_uv.assign(domain.mesh.number_of_halfedges(), Point_2(0, 0));
  return seamless_parametrization_with_traits(domain.mesh, tangent_traits(domain), vector_map(gradients),
                                              Is_on_curve<Surface_domain>{&domain}, vector_map(corner_uv), options);
}

/// Singularities of the field itself, and whether their indices add up.
void find_singularities(const Surface_domain& domain, Surface_pipeline_result& result)
{
  std::vector<int> matching(domain.mesh.number_of_halfedges(), 0);
  const auto topology =
      frame_field_topology_with_traits(domain.mesh, tangent_traits(domain), vector_map(result.gradients),
                                       Is_on_curve<Surface_domain>{&domain}, vector_map(matching));
  for (const auto& [vertex, quarters] : topology.singular_vertices)
    result.singular_vertices.emplace_back(vertex, 4 - quarters);
  result.quarter_index_sum = topology.quarter_index_sum;
  const int euler =
      int(domain.mesh.number_of_vertices()) - int(domain.mesh.number_of_edges()) + int(domain.mesh.number_of_faces());
  if (result.quarter_index_sum != 4 * euler)
    throw No_result_error(
        "field", "the indices of the frame field add up to " + std::to_string(0.25 * result.quarter_index_sum) +
                     ", and the Euler characteristic is " + std::to_string(euler) + "; please report this");
}

/// The field with the best map, if maps are asked for, and that map.
void compute_field_and_map(const Surface_domain& domain, const std::vector<Edge_frame_constraint>& constraints,
                           const Surface_pipeline_options& options, Surface_pipeline_result& result)
{
  Start_maps<Mesh> maps(options.field.starts);
  std::vector<double> poisson_errors(maps.candidates.size(), std::numeric_limits<double>::infinity());
  const auto poisson_error = [&](std::size_t start, const std::vector<Gradient_pair>& gradients) {
    Seamless_parametrization_options poisson = options.map;
    poisson.untangle = false;
    poisson.threads = 1; // the starts themselves run in parallel
    std::vector<Point_2> corner_uv;
    try {
      poisson_errors[start] = integrate(domain, gradients, poisson, corner_uv).integration_error;
    } catch (const No_result_error&) { // stays infinite
    }
    return poisson_errors[start];
  };
  const auto make_map = [&](const std::vector<Gradient_pair>& gradients, std::vector<Point_2>& corner_uv) {
    return integrate(domain, gradients, options.map, corner_uv);
  };
  // Untangling takes much longer than the Poisson maps, and can only make their errors larger.
  const Field_evaluator evaluator(poisson_error, maps.cost(make_map));
  std::vector<Edge_frame_constraint> edge_constraints = constraints;
  result.gradients.resize(domain.mesh.number_of_faces());
  result.field =
      odeco_surface_field(domain.mesh, domain.mesh.points(), vector_map(edge_constraints), vector_map(result.gradients),
                          options.field, options.make_map ? evaluator : Field_evaluator());
  if (std::isfinite(poisson_errors[0]))
    result.smooth_integration_error = poisson_errors[0];
  find_singularities(domain, result);
  if (!options.make_map)
    return;
  Field_candidate<Mesh>& chosen = maps.candidates[std::size_t(result.field->chosen)];
  result.map = chosen.map ? std::move(chosen.map) : make_map(result.gradients, chosen.corner_uv);
  result.corner_uv = std::move(chosen.corner_uv);
}

bool is_folded(const Seamless_map<Mesh>& map) { return !map.flipped_faces.empty() || !map.misturned_vertices.empty(); }

void compute_quads(const Surface_domain& domain, const Surface_pipeline_options& options,
                   Surface_pipeline_result& result)
{
  if (is_folded(*result.map))
    throw No_result_error("map", reason_of_folded_map(domain, *result.map) +
                                     "; try smaller triangles, or sizes nearer to those of the details there");
  result.extraction = extract_quads(domain.mesh, domain.mesh.points(), vector_map(result.corner_uv), domain.chain_map(),
                                    domain.region_map(), result.quads, options.extraction,
                                    Chosen_quantizer(options.quantizer, options.optimal));
}

} // namespace

void run_surface_pipeline(const Surface_domain& domain, const std::vector<Edge_frame_constraint>& constraints,
                          Surface_pipeline_options options, Surface_pipeline_result& result)
{
  const int n_attempts = options.make_map && options.field.starts > 0 ? options.max_attempts : 1;
  for (int attempt = 1;; ++attempt) {
    result = Surface_pipeline_result();
    const bool is_last = attempt >= n_attempts;
    try {
      compute_field_and_map(domain, constraints, options, result);
      if (options.make_map && options.make_quads)
        compute_quads(domain, options, result);
      if (!result.map || !is_folded(*result.map) || is_last)
        return;
    } catch (const No_result_error&) {
      if (is_last)
        throw;
    }
    options.field.seed += std::uint64_t(options.field.starts);
  }
}

std::optional<Log_deviation> measure_map_sizes(const Surface_domain& domain, const Domain_sizes& sizes,
                                               const std::vector<Point_2>& corner_uv)
{
  Log_deviation deviation;
  double total = 0;
  for (const auto e : domain.mesh.edges()) {
    if (corner_uv.empty() || !sizes.is_prescribed(e))
      continue;
    auto h = domain.mesh.halfedge(e);
    if (domain.mesh.is_border(h))
      h = domain.mesh.opposite(h);
    const Point_2 &from = corner_uv[std::size_t(domain.mesh.prev(h).idx())], &to = corner_uv[std::size_t(h.idx())];
    const double steps = std::sqrt(CGAL::squared_distance(from, to));
    const double length = std::sqrt(
        CGAL::squared_distance(domain.mesh.point(domain.mesh.source(h)), domain.mesh.point(domain.mesh.target(h))));
    const auto& prescribed = sizes.of_edge[std::size_t(e.idx())];
    const double size = std::sqrt(prescribed[0].tangential * prescribed[1].tangential);
    const double error = std::abs(std::log(length / steps / size));
    deviation.mean += length * error;
    deviation.max = std::max(deviation.max, error);
    total += length;
  }
  if (total == 0)
    return std::nullopt;
  deviation.mean /= total;
  return deviation;
}

std::array<std::vector<std::array<double, 3>>, 2> frame_vectors(const Surface_domain& domain,
                                                                const std::vector<Gradient_pair>& gradients)
{
  std::array<std::vector<std::array<double, 3>>, 2> vectors;
  const auto traits = tangent_traits(domain);
  for (const auto f : domain.mesh.faces()) {
    const Gradient_pair& pair = gradients[std::size_t(f.idx())];
    for (std::size_t k = 0; k < 2; ++k) {
      const Eigen::Vector2d& gradient = k == 0 ? pair.first : pair.second;
      const Eigen::Vector3d v = traits.basis(f) * gradient / gradient.squaredNorm();
      vectors[k].push_back({v.x(), v.y(), v.z()});
    }
  }
  return vectors;
}

namespace {

Surface_drawing quad_drawing(const Surface_domain& domain, const Surface_pipeline_result& result)
{
  Surface_drawing drawing;
  const Labelled_mesh mesh = labelled_quads(domain, result.quads, *result.extraction);
  drawing.points = mesh.points;
  for (const std::vector<int>& quad : mesh.polygons) {
    drawing.triangles.push_back({quad[0], quad[1], quad[2]});
    drawing.triangles.push_back({quad[0], quad[2], quad[3]});
  }
  for (const auto e : result.quads.edges())
    drawing.mesh_edges.push_back({int(result.quads.vertex(e, 0).idx()), int(result.quads.vertex(e, 1).idx())});
  drawing.feature_edges = mesh.lines;
  for (const auto v : result.quads.vertices())
    if (const int valence = int(result.quads.degree(v)); valence != 4 && !result.quads.is_border(v))
      drawing.singular_vertices.emplace_back(int(v.idx()), valence);
  return drawing;
}

} // namespace

Surface_drawing surface_drawing(const Surface_domain& domain, const Surface_pipeline_result& result)
{
  if (result.extraction)
    return quad_drawing(domain, result);
  const Mesh& mesh = domain.mesh;
  Surface_drawing drawing;
  for (const auto v : mesh.vertices())
    drawing.points.push_back({mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()});
  double steps = 0; // area in (u, v)
  for (const auto f : mesh.faces()) {
    drawing.triangles.emplace_back();
    std::array<Eigen::Vector2d, 3> uv;
    std::size_t k = 0;
    for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      drawing.triangles.back()[k] = int(mesh.target(h).idx());
      if (!result.corner_uv.empty())
        uv[k] = {result.corner_uv[std::size_t(h.idx())].x(), result.corner_uv[std::size_t(h.idx())].y()};
      ++k;
    }
    if (!result.corner_uv.empty()) {
      const Eigen::Vector2d a = uv[1] - uv[0], b = uv[2] - uv[0];
      steps += 0.5 * std::abs(a.x() * b.y() - a.y() * b.x());
      drawing.uv.push_back(uv);
    }
  }
  const double lines_to_see = 60; // across, of a surface seen from the front
  drawing.isoline_spacing = std::max(1.0, std::round(std::sqrt(steps / 2) / lines_to_see));
  for (const auto e : mesh.edges())
    if (domain.edge_curve[std::size_t(e.idx())] >= 0)
      drawing.feature_edges.push_back({int(mesh.vertex(e, 0).idx()), int(mesh.vertex(e, 1).idx())});
  for (const auto& [vertex, valence] : result.singular_vertices)
    drawing.singular_vertices.emplace_back(int(vertex.idx()), valence);
  if (drawing.uv.empty()) {
    const auto [u, v] = frame_vectors(domain, result.gradients);
    for (std::size_t f = 0; f < u.size(); ++f)
      drawing.frames.push_back({Eigen::Vector3d(u[f].data()), Eigen::Vector3d(v[f].data())});
  }
  return drawing;
}

} // namespace Quadrille
