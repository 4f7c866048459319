// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cross_output.h"

#include <Quadrille/cross_field_indicators.h>
#include <Quadrille/cross_harmonics.h>
#include <Quadrille/exceptions.h>
#include <Quadrille/write_tetrahedral_mesh.h>
#include <Quadrille/write_vtu.h>

#include <array>
#include <filesystem>
#include <utility>
#include <vector>

namespace Quadrille {

namespace {

using Json = nlohmann::ordered_json;

std::string extension_of(const std::string& path) { return std::filesystem::path(path).extension().string(); }

bool is_frames(const std::string& extension) { return extension == ".fra" || extension == ".ff3"; }

bool has_metric(const Cross_run_result& result) { return result.metric.size() > 0; }

/// A vector of space of a vector in the orthonormal coordinates of a metric with root A at some place.
Eigen::Matrix3d in_space(const Eigen::Matrix3d& A, const Eigen::Matrix3d& R) { return A.inverse() * R; }

std::vector<Eigen::Matrix3d> frames_of_tetrahedra(const Cross_run_result& result, Tetrahedron_crosses& crosses)
{
  std::vector<Eigen::Matrix3d> frames = std::move(crosses.frames);
  if (has_metric(result))
    for (std::size_t t = 0; t < frames.size(); ++t) {
      // The mean cross is in the coordinates of the first corner.
      const std::size_t first = std::size_t(result.mesh.tetrahedra[t][0]);
      frames[t] = in_space(result.metric[first], frames[t]);
    }
  return frames;
}

Vtu_data field_data(const Cross_run_result& result, int threads)
{
  const std::size_t n = result.field.frames.size();
  std::array<std::vector<double>, 3> axes;
  std::vector<double> harmonics;
  for (std::size_t v = 0; v < n; ++v) {
    const Eigen::Matrix3d& R = result.field.frames[v];
    const Eigen::Matrix3d frame = has_metric(result) ? in_space(result.metric[v], R) : R;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 3; ++i)
        axes[axis].push_back(frame(i, Eigen::Index(axis)));
    const Cross_harmonics q = cross_harmonics(R);
    harmonics.insert(harmonics.end(), q.data(), q.data() + 9);
  }
  Vtu_data data;
  data.at_points.push_back({"u", 3, std::move(axes[0])});
  data.at_points.push_back({"v", 3, std::move(axes[1])});
  data.at_points.push_back({"w", 3, std::move(axes[2])});
  data.at_points.push_back({"harmonics", 9, std::move(harmonics)});
  data.at_cells.push_back(
      {"eta", 1, crosses_of_tetrahedra(result.mesh, result.field.frames, result.connection, threads).eta});
  return data;
}

} // namespace

void check_cross_output_name(const std::string& path)
{
  const std::string extension = extension_of(path);
  for (const char* known : {".vtu", ".fra", ".ff3", ".mesh", ".msh", ".vtk"})
    if (extension == known)
      return;
  throw Invalid_argument_error(path + ": unknown format '" + extension +
                               "'; fields are written as .vtu, frames alone as .fra or .ff3, the mesh alone as .mesh, "
                               ".msh or .vtk");
}

void write_cross_output(const std::string& path, const Cross_run_result& result, int threads)
{
  const std::string extension = extension_of(path);
  if (extension == ".vtu") {
    write_vtu(path, result.mesh, field_data(result, threads));
  } else if (is_frames(extension)) {
    Tetrahedron_crosses crosses = crosses_of_tetrahedra(result.mesh, result.field.frames, result.connection, threads);
    write_frames(path, result.mesh, frames_of_tetrahedra(result, crosses));
  } else {
    write_tetrahedral_mesh(path, result.mesh);
  }
}

int number_of(Singular_graph::Valence valence)
{
  switch (valence) {
  case Singular_graph::Valence::three:
    return 3;
  case Singular_graph::Valence::five:
    return 5;
  case Singular_graph::Valence::six:
    return 6;
  case Singular_graph::Valence::two:
    return 2;
  case Singular_graph::Valence::mixed:
    return 0;
  default:
    return -1;
  }
}

void write_graph(const std::string& path, const Singular_graph& graph)
{
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<int>> lines;
  std::vector<double> alignment;
  std::vector<int> valence, arc_number, degree;
  for (std::size_t a = 0; a < graph.arcs.size(); ++a) {
    const Singular_graph::Arc& arc = graph.arcs[a];
    std::vector<int> line;
    for (std::size_t i = 0; i < arc.points.size(); ++i) {
      line.push_back(int(points.size()));
      points.push_back({arc.points[i][0], arc.points[i][1], arc.points[i][2]});
      alignment.push_back(arc.alignment[i]);
    }
    if (arc.is_loop)
      line.push_back(line.front());
    lines.push_back(std::move(line));
    valence.push_back(number_of(arc.valence));
    arc_number.push_back(int(a));
    degree.push_back(0);
  }
  for (const Singular_graph::Node& node : graph.nodes) {
    lines.push_back({int(points.size())});
    points.push_back({node.point[0], node.point[1], node.point[2]});
    alignment.push_back(0);
    valence.push_back(0);
    arc_number.push_back(-1);
    degree.push_back(int(node.arcs.size()));
  }
  Vtu_data data;
  data.at_points.push_back({"alignment", 1, std::move(alignment)});
  data.at_cells.push_back({"valence", 1, std::move(valence)});
  data.at_cells.push_back({"arc", 1, std::move(arc_number)});
  data.at_cells.push_back({"degree", 1, std::move(degree)});
  write_vtu(path, points, lines, data);
}

void add_cross_stages(const Cross_run_result& result, nlohmann::ordered_json& summary)
{
  const Volumetric_cross_field& field = result.field;
  summary["field"] = {{"tetrahedra", result.mesh.number_of_tetrahedra()},
                      {"vertices", result.mesh.number_of_vertices()},
                      {"iterations", field.diffusions + field.newton_steps},
                      {"energy", field.energy},
                      {"settled", field.has_settled},
                      {"seconds", field.seconds}};
  const Singular_graph& graph = result.graph;
  Json nodes = Json::object();
  for (const auto& [degree, n] : graph.nodes_by_degree())
    nodes[std::to_string(degree)] = n;
  using Valence = Singular_graph::Valence;
  Json valences = {{"3", graph.number_of_arcs(Valence::three)},
                   {"5", graph.number_of_arcs(Valence::five)},
                   {"mixed", graph.number_of_arcs(Valence::mixed)},
                   {"compound", graph.number_of_arcs(Valence::compound)}};
  for (const Valence rare : {Valence::two, Valence::six})
    if (const std::size_t n = graph.number_of_arcs(rare); n > 0)
      valences[std::to_string(number_of(rare))] = n;
  Json obstacles = Json::array();
  for (const Singular_graph::Obstacle& obstacle : graph.obstacles) {
    const bool is_arc = obstacle.arc >= 0;
    const Eigen::Vector3d place =
        is_arc ? graph.arcs[std::size_t(obstacle.arc)].points.front() : graph.nodes[std::size_t(obstacle.node)].point;
    obstacles.push_back({{is_arc ? "arc" : "node", is_arc ? obstacle.arc : obstacle.node},
                         {"reason", obstacle.reason},
                         {"place", {place[0], place[1], place[2]}}});
  }
  summary["graph"] = {{"arcs", graph.arcs.size()},
                      {"loops", graph.loops},
                      {"boundary_ends", graph.boundary_ends},
                      {"nodes", nodes},
                      {"arc_valences", valences},
                      {"hex_meshable", graph.is_hex_meshable()},
                      {"obstacles", obstacles},
                      {"unresolved_arcs", graph.unresolved_arcs},
                      {"seconds", graph.seconds}};
}

} // namespace Quadrille
