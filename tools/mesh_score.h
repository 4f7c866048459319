// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_MESH_SCORE_H
#define QUADRILLE_TOOLS_MESH_SCORE_H

#include <Quadrille/Frame_edge_constraints.h>
#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Mesh_quality.h>
#include <Quadrille/Size_specification.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

namespace Quadrille {

/// What a user feels of a mesh, lower is better: mean skew in units of 5 degrees, plus the mean errors of prescribed
/// sizes and, for anisotropic fields, of prescribed aspect ratios in units of 10 %, plus 0.02 for each irregular
/// vertex: one counts like a tenth of a degree of skew. \tparam Domain `Planar_domain` or `Surface_domain`
template <class Domain>
double mesh_score(const Domain& domain, const std::vector<Edge_frame_constraint>& constraints, bool isotropic,
                  const Labelled_mesh& mesh, const std::map<int, int>& irregular_vertices)
{
  Domain_sizes sizes;
  for (const Edge_frame_constraint& constraint : constraints)
    sizes.of_edge.push_back({constraint.source_size, constraint.target_size});
  int n_irregular = 0;
  for (const auto& [valence, count] : irregular_vertices)
    n_irregular += count;
  const Size_error error = measure_size_error(mesh, domain, sizes);
  const double size_error = error.length.mean + (isotropic ? 0 : error.aspect.mean);
  return measure_quality(mesh).skew_mean / 5 + size_error / 0.1 + 0.02 * n_irregular;
}

/// Scores that differ by less tell of rounding to integers, not of fields.
constexpr double tolerated_score_ratio = 1.1;

/// The starts that may be meshed, by cost: each field once. Fields are the same whose energies and costs differ by at
/// most `tolerance`, relative to them. \param may_be_meshed predicate of a start's place
template <class Predicate>
std::vector<std::size_t> starts_by_cost(const std::vector<Field_start>& starts, double tolerance,
                                        const Predicate& may_be_meshed)
{
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < starts.size(); ++i)
    if (may_be_meshed(i))
      order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return starts[a].cost < starts[b].cost; });
  const auto is_near = [tolerance](double x, double y) { return x == y || std::abs(x - y) <= tolerance * std::abs(x); };
  std::vector<std::size_t> distinct;
  for (const std::size_t i : order)
    if (std::none_of(distinct.begin(), distinct.end(), [&](std::size_t j) {
          return is_near(starts[i].cost, starts[j].cost) && is_near(starts[i].energy, starts[j].energy);
        }))
      distinct.push_back(i);
  return distinct;
}

} // namespace Quadrille

#endif
