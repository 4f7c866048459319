// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cross_command.h"

#include "Console.h"
#include "cross_output.h"
#include "output_files.h"
#include "picture_file.h"

#include <Quadrille/align_with_boundary.h>
#include <Quadrille/check_tetrahedral_mesh.h>
#include <Quadrille/fill_with_tetrahedra.h>
#include <Quadrille/read_metric.h>
#include <Quadrille/write_file.h>

#include <chrono>
#include <cstddef>
#include <sstream>
#include <thread>

#include <sys/resource.h>

namespace Quadrille {

namespace {

using Json = nlohmann::ordered_json;

void check_outputs(const Cross_arguments& arguments)
{
  for (const std::string& output : arguments.outputs)
    check_cross_output_name(output);
  if (!arguments.picture.empty())
    check_picture_name(arguments.picture);
  check_ending(arguments.graph, ".vtu");
  std::vector<std::string> paths = arguments.outputs;
  paths.insert(paths.end(), {arguments.graph, arguments.picture, arguments.json});
  check_output_files(paths, {arguments.input, arguments.metric});
}

/// The most memory that the program has had at a time, in bytes.
std::size_t peak_memory()
{
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  return std::size_t(usage.ru_maxrss);
#else
  return std::size_t(usage.ru_maxrss) * 1024;
#endif
}

/// One run of the program: the state that its steps hand on.
class Cross_run {
public:
  explicit Cross_run(const Cross_arguments& arguments)
      : m_arguments(arguments), m_console(arguments.quiet), m_start(std::chrono::steady_clock::now())
  {
  }

  void run()
  {
    read();
    compute();
    write();
    report();
  }

private:
  void read()
  {
    Filling_options filling;
    filling.tetrahedron_size = m_arguments.tetrahedron_size;
    m_result.mesh = load_tetrahedral_mesh(m_arguments.input, filling);
    try {
      check_tetrahedral_mesh(m_result.mesh);
    } catch (const Invalid_input_error& error) {
      throw Invalid_input_error(m_arguments.input + ": " + error.what());
    }
    std::ostringstream line;
    line << m_arguments.input << ": " << m_result.mesh.number_of_tetrahedra() << " tetrahedra, "
         << m_result.mesh.number_of_vertices() << " vertices";
    m_console.print(line.str());
  }

  void compute()
  {
    Crease_options creases;
    if (m_arguments.crease_angle)
      creases.crease_angle = creases.marked_crease_angle = *m_arguments.crease_angle;
    m_crease_angle = creases.crease_angle;
    Cross_field_options options;
    options.seed = m_arguments.seed;
    options.threads = m_arguments.threads;
    Singular_graph_options graph;
    graph.threads = m_arguments.threads;
    const Tetrahedral_mesh& mesh = m_result.mesh;
    const auto align = [&](const Metric_field* metric) {
      const Vertex_alignments alignments = align_with_boundary(mesh, creases, mesh.feature_edges, metric);
      std::ostringstream line;
      line << alignments.alignments.size() << " vertices aligned, of which " << alignments.crease_vertices
           << " on creases; " << alignments.corner_vertices << " corners";
      m_console.print(line.str());
      return alignments;
    };
    if (m_arguments.metric.empty()) {
      m_result.field = volumetric_cross_field(mesh, align(nullptr), options, m_console.observer());
      m_result.graph = singular_graph(mesh, m_result.field.frames, graph);
      return;
    }
    try {
      m_result.metric = Metric_field(read_metric(m_arguments.metric, mesh.number_of_vertices()));
    } catch (const Invalid_input_error& error) {
      const std::string message = error.what();
      const bool is_named = message.rfind(m_arguments.metric, 0) == 0;
      throw Invalid_input_error(is_named ? message : m_arguments.metric + ": " + message);
    }
    constexpr double tolerance = 1e-4; // in radians
    m_result.connection = Metric_connection(mesh, m_result.metric, tolerance, m_arguments.threads);
    m_result.field = volumetric_cross_field(mesh, align(&m_result.metric), m_result.metric, m_result.connection,
                                            options, m_console.observer());
    m_result.graph = singular_graph(mesh, m_result.field.frames, m_result.metric, m_result.connection, graph);
  }

  void write()
  {
    for (const std::string& output : m_arguments.outputs)
      write_cross_output(output, m_result, m_arguments.threads);
    if (!m_arguments.graph.empty())
      write_graph(m_arguments.graph, m_result.graph);
    if (!m_arguments.picture.empty())
      write_picture_file(m_arguments.picture, svg_picture_of_graph(m_result.mesh, m_result.graph, m_crease_angle));
    if (m_arguments.json.empty())
      return;
    Json json;
    json["input"] = {{"vertices", m_result.mesh.number_of_vertices()},
                     {"tetrahedra", m_result.mesh.number_of_tetrahedra()}};
    add_cross_stages(m_result, json);
    json["peak_memory_bytes"] = peak_memory();
    json["seconds"] = seconds();
    json["threads"] = m_arguments.threads > 0 ? m_arguments.threads : int(std::thread::hardware_concurrency());
    json["seed"] = m_arguments.seed;
    json["version"] = QUADRILLE_VERSION;
    write_file(m_arguments.json, json.dump(2) + "\n");
  }

  void report()
  {
    std::ostringstream line;
    line.precision(4);
    line << "field: energy " << m_result.field.energy << " after " << m_result.field.diffusions << " diffusions and "
         << m_result.field.newton_steps << " Newton steps, " << m_result.field.seconds << " s"
         << (m_result.field.has_settled ? "" : "; it has not settled");
    m_console.print(line.str());
    line.str("");
    const Singular_graph& graph = m_result.graph;
    line << "singular graph: " << graph.arcs.size() << " arcs, " << graph.loops << " of them loops, "
         << graph.boundary_ends << " ends on the boundary, " << graph.nodes.size() << " nodes";
    m_console.print(line.str());
    for (const Singular_graph::Obstacle& obstacle : graph.obstacles)
      m_console.print("not hex-meshable: " + std::string(obstacle.arc >= 0 ? "arc " : "node ") +
                      std::to_string(obstacle.arc >= 0 ? obstacle.arc : obstacle.node) + ": " + obstacle.reason);
    line.str("");
    line << m_arguments.outputs.front() << ": " << seconds() << " s";
    m_console.print(line.str());
  }

  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count(); }

  const Cross_arguments& m_arguments;
  Console m_console;
  std::chrono::steady_clock::time_point m_start;
  double m_crease_angle = 0;
  Cross_run_result m_result;
};

} // namespace

void run_cross_command(const Cross_arguments& arguments)
{
  check_outputs(arguments);
  Cross_run(arguments).run();
}

} // namespace Quadrille
