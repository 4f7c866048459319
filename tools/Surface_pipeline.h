// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_SURFACE_PIPELINE_H
#define QUADRILLE_TOOLS_SURFACE_PIPELINE_H

#include "quantizer_option.h"

#include <Quadrille/Frame_edge_constraints.h>
#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Mesh_quality.h>
#include <Quadrille/Optimal_quantizer.h>
#include <Quadrille/Planar_domain.h>
#include <Quadrille/Quad_extraction_options.h>
#include <Quadrille/Size_specification.h>
#include <Quadrille/Surface_domain.h>
#include <Quadrille/Surface_field_options.h>
#include <Quadrille/seamless_parametrization.h>

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace Quadrille {

/// Number of melted starts of a surface's field unless the user says otherwise: fewer on many triangles.
inline int default_number_of_surface_starts(std::size_t n_triangles)
{
  return n_triangles > 40000 ? 1 : n_triangles > 15000 ? 2 : Surface_field_options().starts;
}

struct Surface_pipeline_options {
  Surface_field_options field; ///< its threads are used for the whole pipeline
  Seamless_parametrization_options map;
  bool make_map = true; ///< otherwise the field with the lowest energy is taken
  bool make_quads = true;
  int max_meshed_starts = 2;       ///< of the starts with the best maps, so many are meshed; the best mesh is kept
  double meshed_cost_ratio = 1.5;  ///< but not those whose cost is more than this times the least
  double same_field_energy = 1e-4; ///< relative difference of energies and costs up to which fields are the same one
  /// Fields from other melted starts, the seeds going on, if there is no valid map or no quads otherwise.
  int max_attempts = 3;
  Quad_extraction_options extraction;
  Quantizer_kind quantizer = default_quantizer();
  Optimal_quantizer::Options optimal;
};

/// What each stage of a run on a surface made; a stage that was not reached is empty.
struct Surface_pipeline_result {
  using Mesh = Surface_domain::Mesh;

  std::optional<Surface_field_result> field;
  std::vector<Gradient_pair> gradients; ///< per face, in the basis of `Surface_tangent_traits`
  /// Inner vertices that are singular, with their valences, by the field alone; and four times the sum of all indices.
  std::vector<std::pair<Surface_domain::vertex_descriptor, int>> singular_vertices;
  int quarter_index_sum = 0;
  /// Integration error of the smooth field's Poisson map, the reference for the chosen one; negative if it has no map.
  double smooth_integration_error = -1;
  std::optional<Seamless_map<Mesh>> map;
  std::vector<Planar_domain::Point_2> corner_uv; ///< per halfedge: of the corner at its target
  std::optional<Log_deviation> size_error;       ///< see `measure_map_sizes()`
  std::optional<Quad_extraction_result> extraction;
  Mesh quads;
  Labelled_mesh mesh; ///< the quads with the names of curves and surfaces

  /// Per start, in the order of `field->starts`: its mesh's `mesh_score()`, or the cost of its map if there are to be
  /// no quads; negative if it has none.
  std::vector<double> mesh_scores;
};

/// Field, map and quads of a surface with the sizes of `constraints` (per edge).
///
/// The field's starts are judged by the integration errors of their maps before they are untangled; the best few are
/// meshed, and the mesh with the least `mesh_score()` is kept. Without quads the map with the least error is. A start
/// whose map or mesh is not valid is passed over. `result` is filled as far as the best start gets, also when it
/// throws. \throws No_result_error of that start if none led to a valid mesh, if the indices of the chosen field do not
/// add up to the Euler characteristic, and as the stages do.
void run_surface_pipeline(const Surface_domain& domain, const std::vector<Edge_frame_constraint>& constraints,
                          Surface_pipeline_options options, Surface_pipeline_result& result);

/// |log(size / prescribed size)| along curves where a size is prescribed, with the sizes of the map: length over
/// length in (u, v). Nothing where none is.
std::optional<Log_deviation> measure_map_sizes(const Surface_domain& domain, const Domain_sizes& sizes,
                                               const std::vector<Planar_domain::Point_2>& corner_uv);

} // namespace Quadrille

#endif
