// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_EXTRACT_QUADS_IMPL_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_EXTRACT_QUADS_IMPL_H

#include <Quadrille/Quad_extraction/internal/Lap_timer.h>
#include <Quadrille/Quad_extraction/internal/extract_indexed_quads.h>
#include <Quadrille/quad_extraction.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// 3 for points that have a `z()`, otherwise 2.
template <class Point, class = void> struct Dimension_of : std::integral_constant<int, 2> {
};
template <class Point>
struct Dimension_of<Point, std::void_t<decltype(std::declval<const Point&>().z())>> : std::integral_constant<int, 3> {
};

template <class Point> Eigen::Matrix<double, Dimension_of<Point>::value, 1> coordinates_of(const Point& p)
{
  if constexpr (Dimension_of<Point>::value == 2)
    return {CGAL::to_double(p.x()), CGAL::to_double(p.y())};
  else
    return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
}

template <class Point> Point make_point(const Eigen::Vector2d& p) { return Point(p.x(), p.y()); }

template <class Point> Point make_point(const Eigen::Vector3d& p) { return Point(p.x(), p.y(), p.z()); }

/// Adds an indexed quad mesh to a `MutableFaceGraph`.
template <int D, class QuadMesh> void add_quads(const Indexed_quads<D>& quads, QuadMesh& mesh)
{
  using Traits = boost::graph_traits<QuadMesh>;
  auto point_map = get(CGAL::vertex_point, mesh);
  using Point = typename boost::property_traits<decltype(point_map)>::value_type;
  std::vector<typename Traits::vertex_descriptor> vertices;
  for (const auto& p : quads.points) {
    vertices.push_back(add_vertex(mesh));
    put(point_map, vertices.back(), make_point<Point>(p));
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
  constexpr int D = internal::extraction::Dimension_of<Point>::value;
  std::vector<Eigen::Matrix<double, D, 1>> positions;
  for (const auto v : index.vertex_of)
    positions.push_back(internal::extraction::coordinates_of(get(points, v)));
  const internal::extraction::Seamless_map map(index.triangulation, std::move(uv), std::move(curve), std::move(region));
  const auto project_point = [&](int id, const Eigen::Matrix<double, D, 1>& p) {
    return internal::extraction::coordinates_of(Point(project(id, internal::extraction::make_point<Point>(p))));
  };
  Quad_extraction_result result;
  result.layout_seconds = timer.lap();
  const internal::extraction::Indexed_quads<D> indexed = internal::extraction::extract_indexed_quads<D>(
      map, positions, options, std::cref(quantizer), project_point, result);
  internal::extraction::add_quads(indexed, quads);
  return result;
}

} // namespace Quadrille

#endif
