// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_QUAD_PIPELINE_H
#define QUADRILLE_TOOLS_QUAD_PIPELINE_H

#include "quantizer_option.h"

#include <Quadrille/Frame_edge_constraints.h>
#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Odeco_field_options.h>
#include <Quadrille/Planar_domain.h>
#include <Quadrille/quad_extraction.h>
#include <Quadrille/seamless_parametrization.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace Quadrille {

/// Number of starts of the field unless the user says otherwise: fewer on many triangles, since the time of each grows
/// faster than their number.
inline int default_number_of_starts(std::size_t n_triangles)
{
  constexpr double all_up_to = 12500;
  const int all = Odeco_field_options().starts;
  const double ratio = all_up_to / double(n_triangles);
  return ratio >= 1 ? all : std::max(2, int(all * ratio * std::sqrt(ratio)));
}

struct Quad_pipeline_options {
  Odeco_field_options field; ///< its threads are used for the whole pipeline
  Seamless_parametrization_options map;
  Quad_extraction_options extraction;
  Quantizer_kind quantizer = default_quantizer();
  Optimal_quantizer::Options
      optimal;               ///< its limits are shared by all meshed starts, the work as it is left by those before
  int max_meshed_starts = 8; ///< of the starts with the best maps, so many are meshed; the best mesh is kept
  double meshed_cost_ratio = 1.5;  ///< but not those whose cost is more than this times the least
  double same_field_energy = 1e-4; ///< relative difference of energies and costs up to which fields are the same one
  /// The best field is solved again on a triangulation that is twice as fine around its singularities, where most of
  /// its integration error is; kept if that is better. Not on more triangles than this: there it no longer pays.
  std::size_t max_refined_triangles = 50000;
  const Progress_observer* observer = nullptr;
};

/// What each stage of a run made; a stage that was not reached is empty.
struct Quad_pipeline_result {
  using Mesh = Planar_domain::Mesh;

  std::optional<Odeco_field_result> field;
  /// The domain with finer triangles around singularities: where it is given, `gradients`, `map` and `corner_uv` are on
  /// its mesh.
  std::optional<Planar_domain> refined_domain;
  std::vector<Gradient_pair> gradients; ///< per face
  /// Integration error of the smooth field's map, the reference for the chosen one; negative if it has no map.
  double smooth_integration_error = -1;

  std::optional<Seamless_map<Mesh>> map;
  std::vector<Planar_domain::Point_2> corner_uv; ///< per halfedge: of the corner at its target

  std::optional<Quad_extraction_result> extraction;
  Mesh quads;
  Labelled_mesh mesh; ///< the quads with the names of curves and regions

  /// Per start, in the order of `field->starts`: its mesh's `mesh_score()`; negative if it was not meshed.
  std::vector<double> mesh_scores;
  /// Why candidates with better maps were passed over.
  std::vector<std::string> rejected;
};

/// Field, map and quads of a planar domain with the sizes of `constraints` (per edge).
///
/// The field's starts are judged by the integration error of their maps and by how far sizes stray; the best few are
/// meshed, and the mesh with the least skew and error of the prescribed sizes is kept. A start whose map or mesh is not
/// valid is passed over. `result` is filled as far as the run gets, also when it throws.
/// \throws No_result_error of the best start if no start led to a valid mesh, and as the stages do.
void run_quad_pipeline(const Planar_domain& domain, const std::vector<Edge_frame_constraint>& constraints,
                       const Quad_pipeline_options& options, Quad_pipeline_result& result);

} // namespace Quadrille

#endif
