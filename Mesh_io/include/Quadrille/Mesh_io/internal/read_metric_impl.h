// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_READ_METRIC_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_READ_METRIC_IMPL_H

#include <Quadrille/Mesh_io/internal/Text_scanner.h>
#include <Quadrille/Mesh_io/internal/files.h>
#include <Quadrille/Mesh_io/internal/format_numbers.h>
#include <Quadrille/Mesh_io/internal/read_msh_volume.h>
#include <Quadrille/Mesh_io/internal/run_in_child_process.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/read_metric.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

inline void check_number_of_metrics(std::size_t n, std::size_t n_vertices, const std::string& path)
{
  if (n != n_vertices)
    throw Invalid_input_error(path + ": the file has sizes or metrics for " + std::to_string(n) +
                              " vertices, and the mesh has " + std::to_string(n_vertices));
}

/// \param place of the size, for the message
inline Eigen::Matrix3d metric_of_size(double size, const std::string& place)
{
  const double entry = 1 / (size * size);
  if (!(size > 0) || !(entry > 0) || !std::isfinite(entry)) {
    std::string message = place + ": the size is ";
    append_number(message, size);
    throw Invalid_input_error(message + "; sizes must be positive, and neither huge nor tiny");
  }
  return entry * Eigen::Matrix3d::Identity();
}

inline Eigen::Matrix3d symmetric_matrix(double xx, double xy, double xz, double yy, double yz, double zz)
{
  Eigen::Matrix3d metric;
  metric << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return metric;
}

inline std::string line_in_words(const Text_scanner& scanner, const std::string& path)
{
  return path + ", line " + std::to_string(scanner.line());
}

inline std::vector<Eigen::Matrix3d> parse_sol(std::string_view text, const std::string& path, std::size_t n_vertices)
{
  Text_scanner scanner(text, path);
  const auto number = [&](std::string_view what) {
    return scanner.number<long long>(scanner.word_outside_comments(), what);
  };
  if (scanner.word_outside_comments() != "MeshVersionFormatted")
    scanner.fail("the file does not begin with MeshVersionFormatted: this is no MEDIT solution in text form");
  number("the version of the format");
  for (std::string_view keyword = scanner.word_outside_comments(); keyword != "SolAtVertices";
       keyword = scanner.word_outside_comments()) {
    if (keyword.empty())
      scanner.fail("there is no section SolAtVertices");
    if (keyword == "Dimension" && number("the dimension") != 3)
      scanner.fail("the dimension is not 3");
  }
  const std::size_t n = scanner.count(scanner.word_outside_comments(), "the number of solutions", 2);
  check_number_of_metrics(n, n_vertices, path);
  if (number("the number of solutions per vertex") != 1)
    scanner.fail("there has to be one solution per vertex");
  const long long type = number("the type of the solution");
  if (type != 1 && type != 3)
    scanner.fail("the solution is of type " + std::to_string(type) +
                 "; it has to be 1, a size, or 3, a symmetric tensor");
  const auto value = [&] { return scanner.finite_number(scanner.word_outside_comments(), "an entry of the metric"); };
  std::vector<Eigen::Matrix3d> metrics;
  metrics.reserve(n);
  for (std::size_t v = 0; v < n; ++v) {
    if (type == 1) {
      const double size = value();
      metrics.push_back(metric_of_size(size, line_in_words(scanner, path)));
    } else {
      std::array<double, 6> m;
      for (double& entry : m)
        entry = value();
      metrics.push_back(symmetric_matrix(m[0], m[1], m[3], m[2], m[4], m[5])); // the upper triangle by columns
    }
  }
  return metrics;
}

inline std::vector<Eigen::Matrix3d> parse_metric_lines(const std::string& text, const std::string& path,
                                                       std::size_t n_vertices)
{
  Text_scanner scanner(text, path);
  std::vector<Eigen::Matrix3d> metrics;
  for (std::string_view word = scanner.first_word_of_line(); !word.empty(); word = scanner.first_word_of_line()) {
    const std::string place = line_in_words(scanner, path);
    std::vector<double> m;
    for (; !word.empty() && word.front() != '#'; word = scanner.word_on_line())
      m.push_back(scanner.finite_number(word, "a size or an entry of a metric"));
    if (m.size() != 1 && m.size() != 6)
      scanner.fail("a line has a size, or the entries xx xy xz yy yz zz; this one has " + std::to_string(m.size()) +
                   " numbers");
    metrics.push_back(m.size() == 1 ? metric_of_size(m[0], place)
                                    : symmetric_matrix(m[0], m[1], m[2], m[3], m[4], m[5]));
    scanner.rest_of_line();
  }
  check_number_of_metrics(metrics.size(), n_vertices, path);
  return metrics;
}

/// Per node, ascending by tag, the values of the last view. Runs in the child process.
struct Node_data {
  std::vector<std::size_t> tags;
  std::vector<double> values;
  int n_components = 0;
};

template <class Archive> void exchange(Archive& archive, Node_data& d) { archive(d.tags, d.values, d.n_components); }

inline Node_data read_node_data(const std::string& path)
{
  const Gmsh_session session;
  Node_data result;
  Gmsh_session::call(path, [&] {
    open_msh(path, session);
    std::vector<int> views;
    gmsh::view::getTags(views);
    std::string kind;
    std::vector<std::size_t> tags;
    std::vector<std::vector<double>> values;
    double time = 0;
    if (!views.empty()) {
      double n_steps = 1;
      gmsh::option::getNumber("View[" + std::to_string(views.size() - 1) + "].NbTimeStep", n_steps);
      gmsh::view::getModelData(views.back(), std::max(0, int(n_steps) - 1), kind, tags, values, time,
                               result.n_components);
    }
    if (kind != "NodeData" || tags.empty())
      throw Invalid_input_error(path + ": there are no node data in this file");
    if (result.n_components != 1 && result.n_components != 9)
      throw Invalid_input_error(path + ": the node data have " + std::to_string(result.n_components) +
                                " components; a size has 1 and a metric 9");
    std::vector<std::size_t> order(tags.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return tags[a] < tags[b]; });
    std::vector<std::size_t> wanted;
    if (Gmsh_volume::exists())
      wanted = Gmsh_volume(path).node_tags();
    for (const std::size_t i : order)
      if (wanted.empty() || std::binary_search(wanted.begin(), wanted.end(), tags[i])) {
        result.tags.push_back(tags[i]);
        result.values.insert(result.values.end(), values[i].begin(), values[i].end());
      }
  });
  if (result.values.size() != result.tags.size() * std::size_t(result.n_components))
    throw Invalid_input_error(path + ": the node data are incomplete");
  return result;
}

inline std::vector<Eigen::Matrix3d> metrics_at_nodes(const Node_data& data, const std::string& path,
                                                     std::size_t n_vertices)
{
  check_number_of_metrics(data.tags.size(), n_vertices, path);
  std::vector<Eigen::Matrix3d> metrics;
  metrics.reserve(n_vertices);
  for (std::size_t v = 0; v < n_vertices; ++v) {
    const std::string place = path + ", node " + std::to_string(data.tags[v]);
    if (data.n_components == 1) {
      metrics.push_back(metric_of_size(data.values[v], place));
      continue;
    }
    const Eigen::Matrix3d m = Eigen::Map<const Eigen::Matrix3d>(data.values.data() + 9 * v);
    if (!m.allFinite() || m != m.transpose())
      throw Invalid_input_error(place + ": the metric is not finite or not symmetric");
    metrics.push_back(m);
  }
  return metrics;
}

} // namespace internal

QUADRILLE_INLINE std::vector<Eigen::Matrix3d> read_metric(const std::string& path, std::size_t number_of_vertices,
                                                          bool isolate, double time_limit_seconds)
{
  const std::string extension = internal::extension_of(path);
  if (extension == ".sol")
    return internal::parse_sol(internal::read_whole_file(path), path, number_of_vertices);
  if (extension == ".txt")
    return internal::parse_metric_lines(internal::read_whole_file(path), path, number_of_vertices);
  if (extension != ".msh")
    throw Invalid_argument_error(path + ": the name of a metric has to end in .sol, .txt or .msh");
  const auto read = [&] { return internal::read_node_data(path); };
  return internal::metrics_at_nodes(
      isolate ? internal::run_in_child_process<internal::Node_data>(read, time_limit_seconds, path) : read(), path,
      number_of_vertices);
}

} // namespace Quadrille

#endif
