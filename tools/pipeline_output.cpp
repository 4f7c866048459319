// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pipeline_output.h"

#include <Quadrille/Curve_locator.h>

namespace Quadrille {

Labelled_mesh labelled_quads(const Planar_domain& domain, const Quad_pipeline_result& result)
{
  Labelled_mesh mesh;
  for (const auto v : result.quads.vertices())
    mesh.points.push_back({result.quads.point(v).x(), result.quads.point(v).y(), domain.z});
  for (const auto f : result.quads.faces()) {
    mesh.polygons.emplace_back();
    for (const auto v : result.quads.vertices_around_face(result.quads.halfedge(f)))
      mesh.polygons.back().push_back(int(v.idx()));
  }
  mesh.polygon_region = result.extraction->quad_regions;
  // The extraction knows chains of curves; the nearest curve of the chain gives an edge its label.
  const Curve_locator locator(domain);
  for (const Quad_extraction_result::Curve_edge& edge : result.extraction->curve_edges) {
    const auto &p = mesh.points[std::size_t(edge.source)], &q = mesh.points[std::size_t(edge.target)];
    const auto place = locator.nearest({0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])}, edge.curve);
    mesh.lines.push_back({edge.source, edge.target});
    mesh.line_curve.push_back(domain.edge_curve[std::size_t(place.edge.idx())]);
  }
  for (const Planar_domain::Curve& curve : domain.curves)
    mesh.curves.push_back(curve);
  mesh.regions = domain.regions;
  mesh.groups = domain.groups;
  return mesh;
}

Frames frames_of(const Planar_domain& domain, const Quad_pipeline_result& result)
{
  Frames frames;
  for (const Gradient_pair& gradients : result.gradients) {
    const Eigen::Vector2d u = gradients.first / gradients.first.squaredNorm();
    const Eigen::Vector2d v = gradients.second / gradients.second.squaredNorm();
    frames.u.push_back({u.x(), u.y()});
    frames.v.push_back({v.x(), v.y()});
  }
  frames.valence.assign(domain.mesh.number_of_vertices(), 4);
  if (result.map)
    for (const auto& [vertex, valence] : result.map->singular_vertices)
      frames.valence[std::size_t(vertex.idx())] = valence;
  return frames;
}

} // namespace Quadrille
