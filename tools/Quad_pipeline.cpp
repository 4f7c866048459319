// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Quad_pipeline.h"

#include <Quadrille/Curve_projector.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <limits>
#include <numeric>

namespace Quadrille {

namespace {

using Mesh = Planar_domain::Mesh;
using Point_2 = Planar_domain::Point_2;

template <class Value> auto vector_map(std::vector<Value>& values)
{
  return boost::make_iterator_property_map(values.begin(), boost::identity_property_map());
}

struct Is_on_curve {
  using key_type = Planar_domain::edge_descriptor;
  using value_type = bool;
  using reference = bool;
  using category = boost::readable_property_map_tag;
  const Planar_domain* domain;
  friend bool get(const Is_on_curve& map, const key_type& e) { return map.domain->edge_curve[e.idx()] >= 0; }
};

Seamless_map<Mesh> integrate(const Planar_domain& domain, const std::vector<Gradient_pair>& gradients,
                             const Seamless_parametrization_options& options, std::vector<Point_2>& corner_uv)
{
  corner_uv.assign(domain.mesh.number_of_halfedges(), Point_2(0, 0));
  std::vector<Gradient_pair> copy = gradients;
  return seamless_parametrization(domain.mesh, domain.mesh.points(), vector_map(copy), Is_on_curve{&domain},
                                  vector_map(corner_uv), options);
}

/// A candidate without a locally injective map is worse than every other, by how much of it is folded.
double cost(const Seamless_map<Mesh>& map) { return map.flipped == 0 ? map.integration_error : 1e3 + map.flipped; }

} // namespace

void run_quad_pipeline(const Planar_domain& domain, const std::vector<Edge_frame_constraint>& constraints,
                       const Quad_pipeline_options& options, Quad_pipeline_result& result)
{
  struct Candidate {
    std::vector<Gradient_pair> gradients;
    double cost = std::numeric_limits<double>::infinity();
  };
  std::vector<Candidate> candidates(2 + std::size_t(std::max(options.field.starts, 0)));
  Seamless_parametrization_options map_options = options.map;
  map_options.threads = 1; // the starts themselves run in parallel
  const auto evaluate = [&](std::size_t start, const std::vector<Gradient_pair>& gradients) {
    try {
      std::vector<Point_2> corner_uv;
      const Seamless_map<Mesh> map = integrate(domain, gradients, map_options, corner_uv);
      if (start == 0)
        result.smooth_integration_error = map.integration_error;
      candidates[start] = {gradients, cost(map)};
    } catch (const No_result_error&) {
      candidates[start] = {gradients, std::numeric_limits<double>::infinity()};
    }
    return candidates[start].cost;
  };
  std::vector<Edge_frame_constraint> edge_constraints = constraints;
  result.gradients.resize(domain.mesh.number_of_faces());
  Odeco_field_options field_options = options.field;
  field_options.observer = options.observer;
  result.field = odeco_frame_field(domain.mesh, domain.mesh.points(), vector_map(edge_constraints),
                                   vector_map(result.gradients), field_options, evaluate);

  // The chosen start first, then the others by cost; the smooth field is only a reference.
  std::vector<std::size_t> order;
  for (std::size_t i = 1; i < candidates.size(); ++i)
    if (!candidates[i].gradients.empty())
      order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return candidates[a].cost < candidates[b].cost; });
  if (order.empty())
    order.push_back(std::size_t(result.field->chosen));

  map_options.threads = options.field.threads;
  Quad_extraction_options extraction_options = options.extraction;
  extraction_options.threads = options.field.threads;
  extraction_options.observer = options.observer;
  std::optional<No_result_error> first_error;
  for (const std::size_t start : order) {
    try {
      if (!candidates[start].gradients.empty())
        result.gradients = candidates[start].gradients;
      result.map = integrate(domain, result.gradients, map_options, result.corner_uv);
      result.field->chosen = int(start);
      result.field->energy = result.field->starts[start].energy;
      result.field->energy_lie = result.field->starts[start].energy_lie;
      result.field->energy_odeco = result.field->energy - result.field->energy_lie;
      result.quads.clear();
      result.extraction = extract_quads(domain.mesh, domain.mesh.points(), vector_map(result.corner_uv),
                                        domain.chain_map(), domain.region_map(), result.quads, extraction_options,
                                        Greedy_quantizer(), Curve_projector(domain));
      return;
    } catch (const No_result_error& error) {
      result.rejected.push_back("start " + std::to_string(start) + ": " + error.what());
      if (!first_error)
        first_error = error;
    }
  }
  throw *first_error;
}

} // namespace Quadrille
