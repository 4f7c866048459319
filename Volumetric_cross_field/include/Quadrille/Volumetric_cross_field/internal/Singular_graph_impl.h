// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_SINGULAR_GRAPH_IMPL_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_SINGULAR_GRAPH_IMPL_H

#include <Quadrille/Volumetric_cross_field/internal/build_singular_graph.h>
#include <Quadrille/Volumetric_cross_field/internal/singular_face_paths.h>

#include <algorithm>
#include <chrono>

namespace Quadrille {
namespace internal {

template <class Mesh>
Singular_graph make_singular_graph(const Mesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                                   const Metric_field* metric, const Metric_connection& connection,
                                   const Singular_graph_options& options)
{
  const auto start = std::chrono::steady_clock::now();
  const Edge_matcher matcher(frames, connection);
  const std::vector<unsigned char> faces = singular_faces(mesh, matcher, options.threads);
  const Singular_face_paths paths = Singular_face_tracer<Mesh>(mesh, frames, matcher, metric).trace(faces);
  Singular_graph graph = build_singular_graph(paths, options);
  graph.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return graph;
}

} // namespace internal

inline std::map<int, std::size_t> Singular_graph::nodes_by_degree() const
{
  std::map<int, std::size_t> result;
  for (const Node& node : nodes)
    ++result[int(node.arcs.size())];
  return result;
}

inline std::size_t Singular_graph::number_of_arcs(Valence valence) const
{
  return std::size_t(std::count_if(arcs.begin(), arcs.end(), [&](const Arc& arc) { return arc.valence == valence; }));
}

template <class TetrahedralMesh>
Singular_graph singular_graph(const TetrahedralMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                              const Singular_graph_options& options)
{
  return internal::make_singular_graph(mesh, frames, nullptr, Metric_connection(), options);
}

template <class TetrahedralMesh>
Singular_graph singular_graph(const TetrahedralMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                              const Metric_field& metric, const Metric_connection& connection,
                              const Singular_graph_options& options)
{
  return internal::make_singular_graph(mesh, frames, &metric, connection, options);
}

} // namespace Quadrille

#endif
