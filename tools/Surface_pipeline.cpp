// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Surface_pipeline.h"

#include "field_maps.h"
#include "folded_map.h"
#include "labelled_quads.h"
#include "mesh_score.h"

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

bool is_folded(const Seamless_map<Mesh>& map) { return !map.flipped_faces.empty() || !map.misturned_vertices.empty(); }

/// What became of one start.
struct Outcome {
  double score = std::numeric_limits<double>::infinity(); ///< of its mesh, or of its map if there are to be no quads
  std::optional<No_result_error> error;                   ///< why there is none
  Surface_pipeline_result result;                         ///< as far as it got
};

/// The starts of a field, and the choice among them by what becomes of them.
class Start_chooser {
public:
  Start_chooser(const Surface_domain& domain, const std::vector<Edge_frame_constraint>& constraints,
                const Surface_pipeline_options& options)
      : m_domain(domain), m_constraints(constraints), m_options(options),
        m_gradients(2 + std::size_t(std::max(0, options.field.starts))),
        m_poisson_errors(m_gradients.size(), std::numeric_limits<double>::infinity())
  {
  }

  /// Of the map before it is untangled, which takes much longer and can only make the error larger. Infinite if there
  /// is none. Called from several threads at once.
  double poisson_error(std::size_t start, const std::vector<Gradient_pair>& gradients)
  {
    m_gradients[start] = gradients;
    Seamless_parametrization_options poisson = m_options.map;
    poisson.untangle = false;
    poisson.threads = 1; // the starts themselves run in parallel
    std::vector<Point_2> corner_uv;
    try {
      m_poisson_errors[start] = integrate(m_domain, gradients, poisson, corner_uv).integration_error;
    } catch (const No_result_error&) { // stays infinite
    }
    return m_poisson_errors[start];
  }

  /// The start with the best mesh, or map if there are to be no quads, of the promising ones; of all where these have
  /// none, the smooth one last. Starts that are not melted ones are left out if `only_melted`.
  std::size_t choose(const std::vector<Field_start>& starts, bool only_melted)
  {
    std::vector<std::size_t> order = starts_by_cost(starts, m_options.same_field_energy, [&](std::size_t i) {
      return starts[i].valid && (!only_melted || starts[i].kind == Field_start::Kind::melted);
    });
    std::stable_partition(order.begin(), order.end(),
                          [&](std::size_t i) { return starts[i].kind != Field_start::Kind::smooth; });
    m_scores.assign(starts.size(), -1);
    std::optional<std::size_t> chosen;
    const auto try_start = [&](std::size_t start, int rounds) {
      Outcome outcome = outcome_of(start, rounds);
      if (!outcome.error) {
        ++m_n_valid;
        m_scores[start] = outcome.score;
      }
      if (!chosen || outcome.score < m_best.score) {
        chosen = start;
        m_best = std::move(outcome);
      }
    };
    // What is hard to untangle takes long: only what is least folded after a few rounds gets them all.
    const int all_rounds = m_options.map.max_untangling_rounds, few_rounds = std::min(16, all_rounds);
    for (const std::size_t start : order) {
      if (m_n_valid > 0 && !is_promising(starts, start, order.front()))
        break;
      try_start(start, few_rounds);
    }
    if (chosen && m_best.error && m_best.error->stage() == "map" && few_rounds < all_rounds)
      try_start(*chosen, all_rounds);
    if (chosen)
      return *chosen;
    const auto first_valid = std::find_if(starts.begin(), starts.end(), [](const auto& start) { return start.valid; });
    return std::size_t(first_valid - starts.begin());
  }

  /// Of the chosen start.
  Outcome take_best()
  {
    Outcome best = std::move(m_best);
    best.result.mesh_scores = std::move(m_scores);
    if (std::isfinite(m_poisson_errors[0]))
      best.result.smooth_integration_error = m_poisson_errors[0];
    return best;
  }

private:
  /// Whether it pays to look at a start when there is a valid one.
  bool is_promising(const std::vector<Field_start>& starts, std::size_t start, std::size_t cheapest) const
  {
    if (starts[start].kind == Field_start::Kind::smooth)
      return false;
    if (!m_options.make_quads)
      return starts[start].cost < m_best.score;
    return m_n_valid < m_options.max_meshed_starts &&
           starts[start].cost <= m_options.meshed_cost_ratio * starts[cheapest].cost;
  }

  /// Failures score worse than everything else, by how far the start got.
  Outcome outcome_of(std::size_t start, int untangling_rounds) const
  {
    Outcome outcome;
    Surface_pipeline_result& result = outcome.result;
    result.gradients = m_gradients[start];
    Seamless_parametrization_options map_options = m_options.map;
    map_options.max_untangling_rounds = untangling_rounds;
    try {
      result.map = integrate(m_domain, result.gradients, map_options, result.corner_uv);
      outcome.score = cost_of_map(*result.map);
      if (is_folded(*result.map))
        throw No_result_error("map", reason_of_folded_map(m_domain, *result.map) +
                                         "; try smaller triangles, or sizes nearer to those of the details there");
      if (m_options.make_quads) {
        outcome.score = cost_of_folded_map;
        make_quads(result);
        outcome.score = mesh_score(m_domain, m_constraints, m_options.field.isotropic, result.mesh,
                                   result.extraction->irregular_vertices);
      }
    } catch (const No_result_error& error) {
      outcome.error = error;
    }
    return outcome;
  }

  void make_quads(Surface_pipeline_result& result) const
  {
    result.extraction = extract_quads(m_domain.mesh, m_domain.mesh.points(), vector_map(result.corner_uv),
                                      m_domain.chain_map(), m_domain.region_map(), result.quads, m_options.extraction,
                                      Chosen_quantizer(m_options.quantizer, m_options.optimal));
    result.mesh = labelled_quads(m_domain, result.quads, *result.extraction);
  }

  const Surface_domain& m_domain;
  const std::vector<Edge_frame_constraint>& m_constraints;
  const Surface_pipeline_options& m_options;
  std::vector<std::vector<Gradient_pair>> m_gradients; ///< by start
  std::vector<double> m_poisson_errors;                ///< by start
  std::vector<double> m_scores;                        ///< by start; negative if it has none
  Outcome m_best;
  int m_n_valid = 0;
};

/// The best start of a field, and what became of it.
Outcome best_of_starts(const Surface_domain& domain, const std::vector<Edge_frame_constraint>& constraints,
                       const Surface_pipeline_options& options, bool only_melted)
{
  Start_chooser chooser(domain, constraints, options);
  Field_evaluator evaluator;
  if (options.make_map)
    evaluator = {[&](std::size_t start, const std::vector<Gradient_pair>& gradients) {
                   return chooser.poisson_error(start, gradients);
                 },
                 [&](const std::vector<Field_start>& starts) { return chooser.choose(starts, only_melted); }};
  std::vector<Edge_frame_constraint> edge_constraints = constraints;
  std::vector<Gradient_pair> gradients(domain.mesh.number_of_faces());
  Surface_field_result field = odeco_surface_field(domain.mesh, domain.mesh.points(), vector_map(edge_constraints),
                                                   vector_map(gradients), options.field, evaluator);
  Outcome best = chooser.take_best();
  best.result.gradients = std::move(gradients);
  best.result.field = std::move(field);
  return best;
}

/// Whether another field might do what this one did not: what contradicts itself is no matter of the field.
bool depends_on_field(const No_result_error& error) { return error.stage() != "quantization"; }

} // namespace

void run_surface_pipeline(const Surface_domain& domain, const std::vector<Edge_frame_constraint>& constraints,
                          Surface_pipeline_options options, Surface_pipeline_result& result)
{
  Outcome best = best_of_starts(domain, constraints, options, false);
  const int n_attempts = options.make_map && options.field.starts > 0 ? options.max_attempts : 1;
  for (int attempt = 1; attempt < n_attempts && best.error && depends_on_field(*best.error); ++attempt) {
    options.field.seed += std::uint64_t(options.field.starts);
    Outcome outcome = best_of_starts(domain, constraints, options, true);
    if (outcome.score < best.score) {
      outcome.result.smooth_integration_error = best.result.smooth_integration_error;
      best = std::move(outcome);
    }
  }
  result = std::move(best.result);
  find_singularities(domain, result);
  if (best.error && (options.make_quads || !result.map))
    throw No_result_error(*best.error);
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

} // namespace Quadrille
