// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_JSON_SUMMARY_H
#define QUADRILLE_TOOLS_JSON_SUMMARY_H

#include "Quad_pipeline.h"
#include "Surface_pipeline.h"

#include <Quadrille/Mesh_quality.h>
#include <Quadrille/compare_surfaces.h>

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <string>

namespace Quadrille {

/// What is said about a quad mesh.
struct Mesh_summary {
  std::size_t vertices = 0, quads = 0;
  Mesh_quality quality;
  Mesh_distortion distortion;
  std::optional<Size_error> size_error; ///< where sizes are prescribed
};

Mesh_summary summarize(const Labelled_mesh& mesh);
/// The same with the size error against what is prescribed on the domain's curves.
Mesh_summary summarize(const Labelled_mesh& mesh, const Planar_domain& domain, const Domain_sizes& sizes);
Mesh_summary summarize(const Labelled_mesh& mesh, const Surface_domain& domain, const Domain_sizes& sizes);

/// The entries of the JSON summary. Their keys are stable: scripts rely on them.
nlohmann::ordered_json json_of(const Planar_domain& domain);
nlohmann::ordered_json json_of(const Surface_domain& domain);
nlohmann::ordered_json json_of(const Mesh_summary& mesh);
nlohmann::ordered_json json_of(const Surface_comparison& comparison);
/// "field", "map", "layout" and "quantization", as far as the run got.
void add_stages(const Quad_pipeline_result& result, Field_solver_kind solver, nlohmann::ordered_json& summary);
void add_stages(const Surface_pipeline_result& result, Field_solver_kind solver, nlohmann::ordered_json& summary);

/// Numbers of singular vertices by valence, as a text for the report.
std::string text_of_counts(const std::map<int, int>& counts);

} // namespace Quadrille

#endif
