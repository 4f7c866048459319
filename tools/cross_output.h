// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_CROSS_OUTPUT_H
#define QUADRILLE_TOOLS_CROSS_OUTPUT_H

#include <Quadrille/Metric_connection.h>
#include <Quadrille/Metric_field.h>
#include <Quadrille/Singular_graph.h>
#include <Quadrille/Tetrahedral_mesh.h>
#include <Quadrille/volumetric_cross_field.h>

#include <nlohmann/json.hpp>

#include <string>

namespace Quadrille {

/// A field with what it was computed under; `metric` is empty for the Euclidean one.
struct Cross_run_result {
  Tetrahedral_mesh mesh;
  Metric_field metric;
  Metric_connection connection;
  Volumetric_cross_field field;
  Singular_graph graph;
};

/// \throws Invalid_argument_error if the program writes no file with this ending.
void check_cross_output_name(const std::string& path);

/// The field or the mesh, by the ending of `path`. Frames are written as vectors of space: under a metric A^-1 R.
/// \throws Output_error
void write_cross_output(const std::string& path, const Cross_run_result& result, int threads);

/// The singular graph as polylines, with valence and alignment, and nodes as vertices with their degree.
void write_graph(const std::string& path, const Singular_graph& graph);

/// The number in files for a kind of arc: 3, 5, 6, 2, 0 for mixed and -1 for compound ones.
int number_of(Singular_graph::Valence valence);

/// The entries "field" and "graph" of the JSON summary. Their keys are stable: scripts rely on them.
void add_cross_stages(const Cross_run_result& result, nlohmann::ordered_json& summary);

/// A picture as SVG text, without perspective: the boundary's creases and outline, and the singular curves (red:
/// valence 3, blue: valence 5, violet: others) with their nodes.
std::string svg_picture_of_graph(const Tetrahedral_mesh& mesh, const Singular_graph& graph, double crease_angle);

} // namespace Quadrille

#endif
