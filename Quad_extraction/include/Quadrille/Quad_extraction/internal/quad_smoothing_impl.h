// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUAD_SMOOTHING_IMPL_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUAD_SMOOTHING_IMPL_H

#include <Quadrille/Quad_extraction/internal/Lap_timer.h>
#include <Quadrille/Quad_extraction/internal/Quad_smoother.h>
#include <Quadrille/quad_smoothing.h>

#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>
#include <boost/unordered_map.hpp>

#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// A quad mesh of the user as index arrays, with its border as curves between fixed vertices.
template <class QuadMesh> class Smoothable_mesh {
public:
  using Traits = boost::graph_traits<QuadMesh>;
  using vertex_descriptor = typename Traits::vertex_descriptor;
  using halfedge_descriptor = typename Traits::halfedge_descriptor;

  /// `target(face, quad)` gives the two lengths; `quad` are the positions of its corners from the source of
  /// `halfedge(face)` on.
  template <class VertexPointMap, class VertexFixedMap, class Target>
  Smoothable_mesh(const QuadMesh& mesh, VertexPointMap points, VertexFixedMap fixed, const Target& target)
      : m_mesh(mesh)
  {
    const auto [begin, end] = vertices(mesh);
    for (auto v = begin; v != end; ++v) {
      m_index[*v] = size_of(vertex_of);
      vertex_of.push_back(*v);
      quads.points.emplace_back(CGAL::to_double(get(points, *v).x()), CGAL::to_double(get(points, *v).y()));
      quads.vertices.emplace_back();
      quads.vertices.back().constrained = get(fixed, *v);
    }
    const auto [first_face, last_face] = faces(mesh);
    for (auto f = first_face; f != last_face; ++f)
      add_quad(*f, target);
    if (quads.quads.empty())
      throw Invalid_input_error("there are no quads to smooth");
    add_border();
  }

  Indexed_quads<2> quads;
  std::vector<vertex_descriptor> vertex_of;

private:
  template <class Face, class Target> void add_quad(Face f, const Target& target)
  {
    std::array<int, 4> quad;
    std::array<Eigen::Vector2d, 4> corner;
    const halfedge_descriptor start = halfedge(f, m_mesh);
    halfedge_descriptor h = start;
    for (std::size_t i = 0; i < 4; ++i, h = next(h, m_mesh)) {
      quad[i] = m_index[source(h, m_mesh)];
      corner[i] = at(quads.points, quad[i]);
    }
    if (h != start)
      throw Invalid_input_error("face " + std::to_string(quads.quads.size()) + " is not a quad");
    const std::pair<double, double> lengths = target(f, corner);
    if (!(lengths.first > 0) || !(lengths.second > 0))
      throw Invalid_input_error("the side lengths wanted for quad " + std::to_string(quads.quads.size()) +
                                " are not positive");
    quads.quads.push_back(quad);
    quads.target.push_back({lengths.first, lengths.second});
  }

  /// Border loops as curves, cut at the fixed vertices.
  void add_border()
  {
    boost::unordered_map<halfedge_descriptor, bool> visited;
    for (const bool from_fixed : {true, false}) { // what is left after the first round are loops without fixed vertices
      const auto [begin, end] = halfedges(m_mesh);
      for (auto h = begin; h != end; ++h) {
        const bool starts = face(*h, m_mesh) == Traits::null_face() && !visited[*h];
        if (starts && (!from_fixed || is_fixed(source(*h, m_mesh))))
          add_curve(*h, visited);
      }
    }
  }

  bool is_fixed(vertex_descriptor v) { return at(quads.vertices, m_index[v]).constrained && !is_on_curve(v); }
  bool is_on_curve(vertex_descriptor v) { return at(quads.vertices, m_index[v]).chain >= 0; }

  void add_curve(halfedge_descriptor start, boost::unordered_map<halfedge_descriptor, bool>& visited)
  {
    std::vector<Eigen::Vector2d> points = {at(quads.points, m_index[source(start, m_mesh)])};
    double position = 0;
    halfedge_descriptor h = start;
    const bool closed = !is_fixed(source(start, m_mesh));
    while (true) {
      visited[h] = true;
      const int v = m_index[target(h, m_mesh)];
      position += (at(quads.points, v) - points.back()).norm();
      points.push_back(at(quads.points, v));
      if (is_fixed(target(h, m_mesh)))
        break;
      Indexed_quads<2>::Vertex& vertex = at(quads.vertices, v);
      vertex.constrained = vertex.border = true;
      vertex.chain = size_of(quads.curves);
      vertex.position = position;
      if (next(h, m_mesh) == start)
        break;
      h = next(h, m_mesh);
    }
    quads.curves.emplace_back(std::move(points), closed, 0);
  }

  const QuadMesh& m_mesh;
  boost::unordered_map<vertex_descriptor, int> m_index;
};

template <class QuadMesh, class VertexPointMap, class VertexFixedMap, class Target>
Quad_smoothing_report smooth_user_quads(const QuadMesh& mesh, VertexPointMap points, VertexFixedMap fixed,
                                        const Target& target, const Quad_smoothing_options& options)
{
  using Point = typename boost::property_traits<VertexPointMap>::value_type;
  Lap_timer timer;
  Smoothable_mesh<QuadMesh> smoothable(mesh, points, fixed, target);
  Indexed_quads<2>& quads = smoothable.quads;
  const Quad_ground<2> plane;
  Quad_smoothing_report report =
      Quad_smoother<2>(quads, plane, options).run([](int, const Eigen::Vector2d& p) { return p; });
  for (const auto& quad : quads.quads)
    report.inverted_quads += is_convex(quads.points, quad) ? 0 : 1;
  for (int v = 0; v < size_of(quads.points); ++v)
    put(points, at(smoothable.vertex_of, v), Point(at(quads.points, v).x(), at(quads.points, v).y()));
  report.seconds = timer.lap();
  return report;
}

} // namespace internal::extraction

template <class QuadMesh, class VertexPointMap, class VertexFixedMap, class FaceTargetMap>
Quad_smoothing_report smooth_quads(const QuadMesh& mesh, VertexPointMap points, VertexFixedMap fixed,
                                   FaceTargetMap targets, const Quad_smoothing_options& options)
{
  const auto target = [&targets](const auto& f, const std::array<Eigen::Vector2d, 4>&) {
    const auto lengths = get(targets, f);
    return std::pair<double, double>(lengths.first, lengths.second);
  };
  return internal::extraction::smooth_user_quads(mesh, points, fixed, target, options);
}

template <class QuadMesh, class VertexPointMap, class VertexFixedMap>
Quad_smoothing_report smooth_quads(const QuadMesh& mesh, VertexPointMap points, VertexFixedMap fixed,
                                   const Quad_smoothing_options& options)
{
  const auto target = [](const auto&, const std::array<Eigen::Vector2d, 4>& p) {
    return std::pair<double, double>(((p[1] - p[0]).norm() + (p[2] - p[3]).norm()) / 2,
                                     ((p[2] - p[1]).norm() + (p[3] - p[0]).norm()) / 2);
  };
  return internal::extraction::smooth_user_quads(mesh, points, fixed, target, options);
}

} // namespace Quadrille

#endif
