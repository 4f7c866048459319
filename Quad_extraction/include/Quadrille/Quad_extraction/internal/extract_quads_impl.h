// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_EXTRACT_QUADS_IMPL_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_EXTRACT_QUADS_IMPL_H

#include <Quadrille/Quad_extraction/internal/extract_indexed_quads.h>
#include <Quadrille/quad_extraction.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Adds an indexed quad mesh to a `MutableFaceGraph`.
template <class QuadMesh> void add_quads(const Indexed_quads& quads, QuadMesh& mesh)
{
  using Traits = boost::graph_traits<QuadMesh>;
  auto point_map = get(CGAL::vertex_point, mesh);
  using Point = typename boost::property_traits<decltype(point_map)>::value_type;
  std::vector<typename Traits::vertex_descriptor> vertices;
  for (const Indexed_quads::Point& p : quads.points) {
    vertices.push_back(add_vertex(mesh));
    put(point_map, vertices.back(), Point(p.x(), p.y()));
  }
  for (const auto& quad : quads.quads) {
    std::vector<typename Traits::vertex_descriptor> corners;
    for (const int v : quad)
      corners.push_back(at(vertices, v));
    if (CGAL::Euler::add_face(corners, mesh) == Traits::null_face())
      throw No_result_error("mesh", "a quad cannot be added to the face graph");
  }
}

} // namespace internal::extraction

template <class TriangleMesh, class VertexPointMap, class CornerUvMap, class EdgeCurveMap, class FaceRegionMap,
          class QuadMesh, class Quantizer, class CurveProjector>
Quad_extraction_result extract_quads(const TriangleMesh& mesh, VertexPointMap points, CornerUvMap corner_uv,
                                     EdgeCurveMap edge_curves, FaceRegionMap face_regions, QuadMesh& quads,
                                     const Quad_extraction_options& options, const Quantizer& quantizer,
                                     const CurveProjector& project)
{
  using Point = typename boost::property_traits<VertexPointMap>::value_type;
  internal::extraction::Lap_timer timer;
  const internal::Mesh_index<TriangleMesh> index(mesh);
  std::vector<internal::extraction::Uv> uv;
  std::vector<int> curve;
  for (const auto h : index.halfedge_of) {
    const auto corner = get(corner_uv, prev(h, mesh)); // ours is the corner that h leaves
    uv.push_back({CGAL::to_double(corner.x()), CGAL::to_double(corner.y())});
    curve.push_back(get(edge_curves, edge(h, mesh)));
  }
  std::vector<int> region;
  for (const auto f : index.face_of)
    region.push_back(get(face_regions, f));
  std::vector<Eigen::Vector2d> positions;
  for (const auto v : index.vertex_of)
    positions.emplace_back(CGAL::to_double(get(points, v).x()), CGAL::to_double(get(points, v).y()));
  const internal::extraction::Seamless_map map(index.triangulation, std::move(uv), std::move(curve), std::move(region));
  const auto project_point = [&](int id, const Eigen::Vector2d& p) -> Eigen::Vector2d {
    const Point projected = project(id, Point(p.x(), p.y()));
    return {CGAL::to_double(projected.x()), CGAL::to_double(projected.y())};
  };
  Quad_extraction_result result;
  result.layout_seconds = timer.lap();
  const internal::extraction::Indexed_quads indexed =
      internal::extraction::extract_indexed_quads(map, positions, options, quantizer, project_point, result);
  internal::extraction::add_quads(indexed, quads);
  return result;
}

} // namespace Quadrille

#endif
