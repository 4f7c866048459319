// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Quad_pipeline.h"

#include "field_maps.h"
#include "labelled_quads.h"
#include "mesh_score.h"
#include "refine_around_singularities.h"

#include <Quadrille/Curve_projector.h>
#include <Quadrille/odeco_frame_field.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace Quadrille {

namespace {

using Mesh = Planar_domain::Mesh;
using Point_2 = Planar_domain::Point_2;

Seamless_map<Mesh> integrate(const Planar_domain& domain, const std::vector<Gradient_pair>& gradients,
                             const Seamless_parametrization_options& options, std::vector<Point_2>& corner_uv)
{
  corner_uv.assign(domain.mesh.number_of_halfedges(), Point_2(0, 0));
  std::vector<Gradient_pair> copy = gradients;
  return seamless_parametrization(domain.mesh, domain.mesh.points(), vector_map(copy),
                                  Is_on_curve<Planar_domain>{&domain}, vector_map(corner_uv), options);
}

/// How fields become quads.
struct Meshing_options {
  Seamless_parametrization_options map;
  Quad_extraction_options extraction;
  Quantizer_kind quantizer;
  Optimal_quantizer::Options optimal; ///< limits of one field
};

using Candidate = Field_candidate<Mesh>;

/// Quads of the map in `result`, which is made of `result.gradients` unless it is there. `result` is filled as far as
/// that gets.
void mesh_field(const Planar_domain& domain, const Meshing_options& options, Quad_pipeline_result& result)
{
  if (!result.map)
    result.map = integrate(domain, result.gradients, options.map, result.corner_uv);
  result.extraction = extract_quads(domain.mesh, domain.mesh.points(), vector_map(result.corner_uv), domain.chain_map(),
                                    domain.region_map(), result.quads, options.extraction,
                                    Chosen_quantizer(options.quantizer, options.optimal), Curve_projector(domain));
  result.mesh = labelled_quads(domain, result.quads, *result.extraction);
}

void choose_start(std::size_t start, const Candidate& candidate, Quad_pipeline_result& result)
{
  result.gradients = candidate.gradients;
  result.map = candidate.map;
  result.corner_uv = candidate.corner_uv;
  Odeco_field_result& field = *result.field;
  field.chosen = int(start);
  field.energy = field.starts[start].energy;
  field.energy_lie = field.starts[start].energy_lie;
  field.energy_odeco = field.starts[start].energy_odeco;
}

/// A meshed start, and what its mesh is worth.
struct Scored_result {
  double score = std::numeric_limits<double>::infinity();
  Quad_pipeline_result result;
};

/// The field of a meshed start again, on finer triangles around its singularities; nothing unless that is better than
/// `best`.
std::optional<Quad_pipeline_result>
solved_again_around_singularities(const std::vector<Edge_frame_constraint>& constraints, const Planar_domain& domain,
                                  const Odeco_field_options& field_options, Meshing_options meshing,
                                  const Quad_pipeline_result& result, const Scored_result& best)
{
  // A map that is much harder to untangle than the one that there is will hardly be better, and takes long.
  meshing.map.move_singularities = false;
  constexpr int few_rounds = 8;
  meshing.map.max_untangling_rounds =
      std::min(meshing.map.max_untangling_rounds, std::max(few_rounds, result.map->untangling_rounds));
  Quad_pipeline_result attempt;
  attempt.field = result.field;
  Field_problem problem =
      refine_around_singularities(domain, constraints, field_options, result.gradients, result.map->singular_vertices);
  attempt.refined_domain = std::move(problem.domain);
  const Planar_domain& refined = *attempt.refined_domain;
  attempt.gradients.resize(refined.mesh.number_of_faces());
  try {
    const Odeco_field_result field =
        odeco_frame_field(refined.mesh, refined.mesh.points(), vector_map(problem.constraints),
                          vector_map(attempt.gradients), problem.options);
    attempt.field->energy = field.energy;
    attempt.field->energy_lie = field.energy_lie;
    attempt.field->energy_odeco = field.energy_odeco;
    attempt.field->iterations += field.iterations;
    attempt.field->seconds += field.seconds;
    mesh_field(refined, meshing, attempt);
  } catch (const Error&) { // also where the finer triangles are too small for doubles
    return {};
  }
  const double refined_score = mesh_score(refined, problem.constraints, field_options.isotropic, attempt.mesh,
                                          attempt.extraction->irregular_vertices);
  if (attempt.map->integration_error >= best.result.map->integration_error ||
      refined_score > tolerated_score_ratio * best.score)
    return {};
  attempt.smooth_integration_error = result.smooth_integration_error;
  return attempt;
}

} // namespace

void run_quad_pipeline(const Planar_domain& domain, const std::vector<Edge_frame_constraint>& constraints,
                       const Quad_pipeline_options& options, Quad_pipeline_result& result)
{
  Start_maps<Mesh> maps(options.field.starts);
  std::vector<Candidate>& candidates = maps.candidates;
  Seamless_parametrization_options map_options = options.map;
  map_options.threads = 1; // the starts themselves run in parallel
  const Field_evaluator evaluate =
      maps.cost([&](const std::vector<Gradient_pair>& gradients, std::vector<Point_2>& uv) {
        return integrate(domain, gradients, map_options, uv);
      });
  std::vector<Edge_frame_constraint> edge_constraints = constraints;
  result.gradients.resize(domain.mesh.number_of_faces());
  Odeco_field_options field_options = options.field;
  field_options.observer = options.observer;
  result.field = odeco_frame_field(domain.mesh, domain.mesh.points(), vector_map(edge_constraints),
                                   vector_map(result.gradients), field_options, evaluate);
  result.smooth_integration_error = maps.smooth_integration_error();

  const std::vector<Field_start> starts = result.field->starts;
  std::vector<std::size_t> order = starts_by_cost(starts, options.same_field_energy, [&](std::size_t i) {
    return i > 0 && !candidates[i].gradients.empty(); // the smooth one is only a reference
  });
  if (order.empty()) { // only the smooth field has positive sizes, or is wanted
    order.push_back(0);
    candidates[0] = {result.gradients, {}, {}};
  }

  std::optional<No_result_error> first_error;
  std::optional<Quad_pipeline_result> first_failed;
  std::optional<Scored_result> best, second_best;
  std::vector<std::string> rejected;
  const auto is_good = [&](std::size_t start) {
    return starts[start].cost <= options.meshed_cost_ratio * starts[order.front()].cost;
  };
  const auto n_good = std::min(options.max_meshed_starts, int(std::count_if(order.begin(), order.end(), is_good)));
  Meshing_options meshing{options.map, options.extraction, options.quantizer, options.optimal};
  double work_left = meshing.optimal.work_limit;
  meshing.optimal.time_limit /= std::max(1, n_good);
  meshing.map.threads = meshing.extraction.threads = options.field.threads;
  meshing.extraction.observer = options.observer;
  int n_meshed = 0;
  std::vector<double> scores(starts.size(), -1);
  for (const std::size_t start : order) {
    if (best && n_meshed >= n_good)
      break;
    meshing.optimal.work_limit = std::max(0.0, work_left) / std::max(1, n_good - n_meshed);
    ++n_meshed;
    Quad_pipeline_result attempt = result;
    try {
      choose_start(start, candidates[start], attempt);
      mesh_field(domain, meshing, attempt);
      work_left -= attempt.extraction->quantization.work;
      const double score = scores[start] = mesh_score(domain, constraints, options.field.isotropic, attempt.mesh,
                                                      attempt.extraction->irregular_vertices);
      if (!best || score < best->score) {
        second_best = std::move(best);
        best = {score, std::move(attempt)};
      } else if (!second_best || score < second_best->score) {
        second_best = {score, std::move(attempt)};
      }
    } catch (const No_result_error& error) {
      work_left -= meshing.optimal.work_limit; // it may all be used up
      rejected.push_back("start " + std::to_string(start) + ": " + error.what());
      if (!first_error) {
        first_error = error;
        first_failed = std::move(attempt);
      }
    }
  }
  result = best ? best->result : std::move(*first_failed);
  if (best && domain.mesh.number_of_faces() <= options.max_refined_triangles && options.field.integrable &&
      options.field.solver == Field_solver_kind::levenberg_marquardt)
    // Where singularities are is not known exactly before: which of two fields is the better one may turn out only
    // then.
    for (const auto& candidate : {&best, &second_best})
      if (*candidate && !(*candidate)->result.map->singular_vertices.empty())
        if (auto again = solved_again_around_singularities(constraints, domain, field_options, meshing,
                                                           (*candidate)->result, *best)) {
          result = std::move(*again);
          break;
        }
  result.mesh_scores = std::move(scores);
  result.rejected = std::move(rejected);
  if (!result.extraction)
    throw *first_error;
}

} // namespace Quadrille
