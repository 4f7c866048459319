// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "json_summary.h"

#include <sstream>
#include <string>

namespace Quadrille {

namespace {

using Json = nlohmann::ordered_json;

Json json_of_counts(const std::map<int, int>& counts)
{
  Json json = Json::object();
  for (const auto& [key, count] : counts)
    json[std::to_string(key)] = count;
  return json;
}

Json json_of(const Log_deviation& deviation)
{
  return {{"mean", deviation.mean}, {"squared_mean", deviation.squared_mean}, {"max", deviation.max}};
}

const char* name_of(Field_start::Kind kind)
{
  switch (kind) {
  case Field_start::Kind::smooth:
    return "smooth";
  case Field_start::Kind::relaxed:
    return "relaxed";
  case Field_start::Kind::initial:
    return "initial";
  default:
    return "melted";
  }
}

const char* name_of(Field_solver_kind solver)
{
  switch (solver) {
  case Field_solver_kind::lbfgs:
    return "lbfgs";
  case Field_solver_kind::lbfgs_kappa:
    return "lbfgs-kappa";
  default:
    return "lm";
  }
}

template <class Mesh> int count_boundary_loops(const Mesh& mesh)
{
  std::vector<char> seen(mesh.number_of_halfedges(), 0);
  int n = 0;
  for (const auto start : mesh.halfedges()) {
    if (!mesh.is_border(start) || seen[std::size_t(start.idx())])
      continue;
    ++n;
    auto h = start;
    do {
      seen[std::size_t(h.idx())] = 1;
      h = mesh.next(h);
    } while (h != start);
  }
  return n;
}

template <class Domain> Json json_of_domain(const Domain& domain)
{
  const auto& mesh = domain.mesh;
  return {{"vertices", mesh.number_of_vertices()},
          {"faces", mesh.number_of_faces()},
          {"boundary_loops", count_boundary_loops(mesh)},
          {"euler_characteristic",
           int(mesh.number_of_vertices()) - int(mesh.number_of_edges()) + int(mesh.number_of_faces())},
          {"triangle_size", domain.triangle_size}};
}

/// What both kinds of fields have: solver, starts and effort. `scores`: per start, negative for none; or empty.
template <class Field>
void add_starts(const Field& field, Field_solver_kind solver, const std::vector<double>& scores, Json& json)
{
  json["solver"] = name_of(solver);
  json["starts"] = field.starts.size();
  if (field.chosen >= 0 && std::size_t(field.chosen) < field.starts.size()) {
    const Field_start& chosen = field.starts[std::size_t(field.chosen)];
    json["chosen"] = {{"start", field.chosen}, {"kind", name_of(chosen.kind)}, {"seed", chosen.seed}};
  }
  for (std::size_t i = 0; i < field.starts.size(); ++i) {
    const Field_start& start = field.starts[i];
    Json candidate = {{"kind", name_of(start.kind)}, {"seed", start.seed},
                      {"energy", start.energy},      {"size_deviation", start.size_deviation},
                      {"cost", start.cost},          {"seconds", start.seconds}};
    if (i < scores.size() && scores[i] >= 0)
      candidate["mesh_score"] = scores[i];
    json["candidates"].push_back(std::move(candidate));
  }
}

template <class Mesh> Json json_of_map(const Seamless_map<Mesh>& map, double smooth_integration_error)
{
  return {{"integration_error", map.integration_error},
          {"integration_residual", map.integration_residual},
          {"smooth_integration_error", smooth_integration_error},
          {"seam_residual_max", map.seam_residual_max},
          {"flipped", map.flipped},
          {"seconds", map.seconds}};
}

void add_extraction(const Quad_extraction_result& extraction, Json& summary)
{
  summary["layout"] = {{"kind", extraction.layout.kind == Layout_kind::t_mesh ? "t-mesh" : "base-complex"},
                       {"patches", extraction.layout.patches.size()},
                       {"arcs", extraction.layout.arcs.size()},
                       {"seconds", extraction.layout_seconds}};
  const Quantization& quantization = extraction.quantization;
  Json& json = summary["quantization"];
  json = {{"method", quantization.method},
          {"area_change_relative", extraction.area_change_relative},
          {"deviation", quantization.deviation}};
  if (quantization.optimality_gap >= 0)
    json["optimality_gap"] = quantization.optimality_gap;
  json["collapsed_arcs"] = extraction.collapsed_arcs;
  json["repetitions"] = quantization.repetitions;
  if (!quantization.note.empty())
    json["note"] = quantization.note;
  json["seconds"] = extraction.quantization_seconds;
}

} // namespace

Mesh_summary summarize(const Labelled_mesh& mesh)
{
  Mesh_summary summary;
  summary.vertices = mesh.points.size();
  summary.quads = mesh.polygons.size();
  summary.quality = measure_quality(mesh);
  summary.distortion = measure_distortion(mesh);
  return summary;
}

Mesh_summary summarize(const Labelled_mesh& mesh, const Planar_domain& domain, const Domain_sizes& sizes)
{
  Mesh_summary summary = summarize(mesh);
  summary.size_error = measure_size_error(mesh, domain, sizes);
  return summary;
}

Mesh_summary summarize(const Labelled_mesh& mesh, const Surface_domain& domain, const Domain_sizes& sizes)
{
  Mesh_summary summary = summarize(mesh);
  summary.size_error = measure_size_error(mesh, domain, sizes);
  return summary;
}

Json json_of(const Planar_domain& domain) { return json_of_domain(domain); }

Json json_of(const Surface_domain& domain) { return json_of_domain(domain); }

Json json_of(const Mesh_summary& mesh)
{
  Json json;
  json["vertices"] = mesh.vertices;
  json["quads"] = mesh.quads;
  json["irregular"] = json_of_counts(mesh.quality.irregular);
  json["scaled_jacobian"] = {{"min", mesh.quality.scaled_jacobian_min}, {"mean", mesh.quality.scaled_jacobian_mean}};
  json["skew_degrees"] = {{"mean", mesh.quality.skew_mean}, {"max", mesh.quality.skew_max}};
  json["area_distortion"] = json_of(mesh.distortion.area);
  json["aspect_distortion"] = json_of(mesh.distortion.aspect);
  json["edge_length"] = {{"percentile_1", mesh.distortion.edge_length_percentile_1},
                         {"median", mesh.distortion.edge_length_median},
                         {"percentile_99", mesh.distortion.edge_length_percentile_99}};
  if (mesh.size_error) {
    json["size_error"] = json_of(mesh.size_error->length);
    json["aspect_error"] = json_of(mesh.size_error->aspect);
  }
  return json;
}

Json json_of(const Surface_comparison& comparison)
{
  return {{"hausdorff", comparison.hausdorff},
          {"hausdorff_relative", comparison.hausdorff_relative},
          {"to_surface_max", comparison.to_surface_max},
          {"from_surface_max", comparison.from_surface_max},
          {"feature_distance_max", comparison.feature_distance_max}, // infinity is null
          {"feature_distance_max_relative", comparison.feature_distance_max_relative},
          {"area_change_relative", comparison.area_relative},
          {"flipped_quads", comparison.flipped_quads}};
}

void add_stages(const Quad_pipeline_result& result, Field_solver_kind solver, Json& summary)
{
  if (result.field) {
    const Odeco_field_result& field = *result.field;
    Json& json = summary["field"];
    add_starts(field, solver, result.mesh_scores, json);
    json["triangles"] = result.gradients.size();
    json["iterations"] = field.iterations;
    json["energy"] = field.energy;
    json["energy_terms"] = {{"lie", field.energy_lie}, {"odeco", field.energy_odeco}};
    if (result.map) {
      json["singularities"] = json_of_counts(result.map->singularities);
      json["index_sum"] = result.map->index_sum;
    }
    json["seconds"] = field.seconds;
  }
  if (result.map)
    summary["map"] = json_of_map(*result.map, result.smooth_integration_error);
  if (result.extraction)
    add_extraction(*result.extraction, summary);
}

void add_stages(const Surface_pipeline_result& result, Field_solver_kind solver, Json& summary)
{
  if (result.field) {
    const Surface_field_result& field = *result.field;
    Json& json = summary["field"];
    add_starts(field, solver, result.mesh_scores, json);
    json["triangles"] = result.gradients.size();
    json["iterations"] = field.iterations;
    json["energy"] = field.energy;
    json["energy_terms"] = {{"curl", field.terms.curl},
                            {"odeco", field.terms.odeco},
                            {"sizes", field.terms.sizes},
                            {"angles", field.terms.angles},
                            {"weak", field.terms.weak}};
    std::map<int, int> counts;
    for (const auto& [vertex, valence] : result.singular_vertices)
      ++counts[valence];
    json["singularities"] = json_of_counts(counts);
    json["index_sum"] = 0.25 * result.quarter_index_sum;
    json["typical_size"] = field.typical_size;
    json["seconds"] = field.seconds;
  }
  if (result.map)
    summary["map"] = json_of_map(*result.map, result.smooth_integration_error);
  if (result.size_error)
    summary["map"]["size_error"] = {{"mean", result.size_error->mean}, {"max", result.size_error->max}};
  if (result.extraction)
    add_extraction(*result.extraction, summary);
}

std::string text_of_counts(const std::map<int, int>& counts)
{
  std::ostringstream text;
  for (const auto& [valence, n] : counts)
    text << (text.tellp() > 0 ? ", " : "") << n << " of valence " << valence;
  return counts.empty() ? "none" : text.str();
}

} // namespace Quadrille
