// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_MAKE_FIELD_GRAPH_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_MAKE_FIELD_GRAPH_H

#include <Quadrille/Metric_connection.h>
#include <Quadrille/Metric_field.h>
#include <Quadrille/Volumetric_cross_field/internal/Field_graph.h>
#include <Quadrille/Volumetric_cross_field/internal/Tetrahedron_adjacency.h>
#include <Quadrille/align_with_boundary.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// A mesh as a graph: linear finite elements (cotangent weights), under a metric those of its Laplacian. The vertices
/// are numbered breadth first, so that neighbours are close to each other in memory.
class Mesh_field_graph {
public:
  template <class Mesh>
  Mesh_field_graph(const Mesh& mesh, const Vertex_alignments& alignments, const Metric_field* metric,
                   const Metric_connection& connection, int threads)
  {
    const Incidence tetrahedra = tetrahedra_of_vertices(mesh);
    order_vertices(mesh, tetrahedra);
    add_edges(mesh, tetrahedra, metric, threads);
    add_transport(connection, threads);
    m_graph.alignments = alignments.alignments;
    m_graph.alignment_of.resize(m_vertex.size());
    for (std::size_t i = 0; i < m_vertex.size(); ++i)
      m_graph.alignment_of[i] = alignments.alignment_of[std::size_t(m_vertex[i])];
  }

  const Field_graph& graph() const { return m_graph; }
  /// The mesh's vertex of a vertex of the graph.
  int mesh_vertex(std::size_t i) const { return m_vertex[i]; }

private:
  struct Element {
    std::array<double, 6> weights; ///< per edge
    double volume;
  };

  template <class Mesh> void order_vertices(const Mesh& mesh, const Incidence& tetrahedra)
  {
    const std::size_t n = mesh.number_of_vertices();
    m_position.assign(n, -1);
    m_vertex.reserve(n);
    for (std::size_t start = 0; start < n; ++start) {
      if (m_position[start] >= 0)
        continue;
      append(int(start));
      for (std::size_t i = m_vertex.size() - 1; i < m_vertex.size(); ++i) {
        const std::size_t v = std::size_t(m_vertex[i]);
        for (const int* t = tetrahedra.begin(v); t != tetrahedra.end(v); ++t)
          for (const int u : corners_of(mesh, std::size_t(*t)))
            if (m_position[std::size_t(u)] < 0)
              append(u);
      }
    }
  }

  void append(int v)
  {
    m_position[std::size_t(v)] = int(m_vertex.size());
    m_vertex.push_back(v);
  }

  template <class Mesh> static Element element(const Mesh& mesh, std::size_t t, const Metric_field* metric)
  {
    const Eigen::Matrix<double, 3, 4> points = points_of(mesh, t);
    Eigen::Matrix<double, 3, 4> gradients = gradients_of_corners(points);
    Eigen::Matrix3d edges;
    for (int i = 0; i < 3; ++i)
      edges.col(i) = points.col(i + 1) - points.col(0);
    Element result;
    result.volume = edges.determinant() / 6;
    if (metric) {
      Eigen::Matrix3d root = Eigen::Matrix3d::Zero();
      for (const int v : corners_of(mesh, t))
        root += 0.25 * (*metric)[std::size_t(v)];
      gradients = (root.inverse() * gradients).eval();
      result.volume *= root.determinant();
    }
    for (std::size_t e = 0; e < 6; ++e)
      result.weights[e] =
          -result.volume * gradients.col(corners_of_edges[e][0]).dot(gradients.col(corners_of_edges[e][1]));
    return result;
  }

  template <class Mesh>
  void add_edges(const Mesh& mesh, const Incidence& tetrahedra, const Metric_field* metric, int threads)
  {
    std::vector<Element> elements(mesh.number_of_tetrahedra());
    parallel_for(elements.size(), threads, [&](std::size_t t) { elements[t] = element(mesh, t, metric); });
    const std::size_t n = m_vertex.size();
    m_graph.first.assign(n + 1, 0);
    m_graph.mass.assign(n, 0);
    // Once to count the neighbours, once to store them; both directions of an edge add up the same numbers in the same
    // order.
    std::vector<double> weights;
    for (const bool is_counting : {true, false}) {
      parallel_for(n, threads, [&](std::size_t i) {
        const int v = m_vertex[i];
        std::vector<std::pair<int, double>> found;
        double mass = 0;
        for (const int* t = tetrahedra.begin(std::size_t(v)); t != tetrahedra.end(std::size_t(v)); ++t) {
          const std::array<int, 4> corners = corners_of(mesh, std::size_t(*t));
          const Element& of_t = elements[std::size_t(*t)];
          mass += of_t.volume / 4;
          for (std::size_t e = 0; e < 6; ++e) {
            const int a = corners[std::size_t(corners_of_edges[e][0])],
                      b = corners[std::size_t(corners_of_edges[e][1])];
            if (a == v || b == v)
              found.emplace_back(m_position[std::size_t(a == v ? b : a)], of_t.weights[e]);
          }
        }
        std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        m_graph.mass[i] = mass;
        std::size_t edge = m_graph.first[i];
        std::size_t count = 0;
        for (std::size_t k = 0; k < found.size(); ++count) {
          double weight = 0;
          const int neighbour = found[k].first;
          for (; k < found.size() && found[k].first == neighbour; ++k)
            weight += found[k].second;
          if (!is_counting) {
            m_graph.edges[edge + count] = {neighbour, 0};
            weights[edge + count] = weight;
          }
        }
        if (is_counting)
          m_graph.first[i + 1] = count;
      });
      if (is_counting) {
        for (std::size_t i = 0; i < n; ++i)
          m_graph.first[i + 1] += m_graph.first[i];
        m_graph.edges.resize(m_graph.first[n]);
        weights.resize(m_graph.first[n]);
      }
    }
    m_graph.set_weights(weights, threads);
  }

  void add_transport(const Metric_connection& connection, int threads)
  {
    if (connection.is_identity())
      return;
    m_graph.turn.resize(m_graph.edges.size());
    parallel_for(m_vertex.size(), threads, [&](std::size_t i) {
      for (std::size_t e = m_graph.first[i]; e < m_graph.first[i + 1]; ++e)
        m_graph.turn[e] = connection(m_vertex[std::size_t(m_graph.edges[e].neighbour)], m_vertex[i]);
    });
    m_graph.set_transport(threads);
  }

  Field_graph m_graph;
  std::vector<int> m_vertex, m_position; ///< per vertex of the graph and of the mesh: its number there
};

} // namespace internal
} // namespace Quadrille

#endif
