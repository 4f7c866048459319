// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "surface_output.h"

#include "field_maps.h"

#include <algorithm>
#include <cmath>

namespace Quadrille {

namespace {

using Mesh = Surface_domain::Mesh;

} // namespace

std::array<std::vector<std::array<double, 3>>, 2> frame_vectors(const Surface_domain& domain,
                                                                const std::vector<Gradient_pair>& gradients)
{
  std::array<std::vector<std::array<double, 3>>, 2> vectors;
  const auto traits = tangent_traits(domain);
  for (const auto f : domain.mesh.faces()) {
    const Gradient_pair& pair = gradients[std::size_t(f.idx())];
    for (std::size_t k = 0; k < 2; ++k) {
      const Eigen::Vector2d& gradient = k == 0 ? pair.first : pair.second;
      const Eigen::Vector3d v = traits.basis(f) * gradient / gradient.squaredNorm();
      vectors[k].push_back({v.x(), v.y(), v.z()});
    }
  }
  return vectors;
}

namespace {

Surface_drawing quad_drawing(const Surface_pipeline_result& result)
{
  Surface_drawing drawing;
  const Labelled_mesh& mesh = result.mesh;
  drawing.points = mesh.points;
  for (const std::vector<int>& quad : mesh.polygons) {
    drawing.triangles.push_back({quad[0], quad[1], quad[2]});
    drawing.triangles.push_back({quad[0], quad[2], quad[3]});
  }
  for (const auto e : result.quads.edges())
    drawing.mesh_edges.push_back({int(result.quads.vertex(e, 0).idx()), int(result.quads.vertex(e, 1).idx())});
  drawing.feature_edges = mesh.lines;
  for (const auto v : result.quads.vertices())
    if (const int valence = int(result.quads.degree(v)); valence != 4 && !result.quads.is_border(v))
      drawing.singular_vertices.emplace_back(int(v.idx()), valence);
  return drawing;
}

} // namespace

Surface_drawing surface_drawing(const Surface_domain& domain, const Surface_pipeline_result& result)
{
  if (result.extraction)
    return quad_drawing(result);
  const Mesh& mesh = domain.mesh;
  Surface_drawing drawing;
  for (const auto v : mesh.vertices())
    drawing.points.push_back({mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()});
  double steps = 0; // area in (u, v)
  for (const auto f : mesh.faces()) {
    drawing.triangles.emplace_back();
    std::array<Eigen::Vector2d, 3> uv;
    std::size_t k = 0;
    for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      drawing.triangles.back()[k] = int(mesh.target(h).idx());
      if (!result.corner_uv.empty())
        uv[k] = {result.corner_uv[std::size_t(h.idx())].x(), result.corner_uv[std::size_t(h.idx())].y()};
      ++k;
    }
    if (!result.corner_uv.empty()) {
      const Eigen::Vector2d a = uv[1] - uv[0], b = uv[2] - uv[0];
      steps += 0.5 * std::abs(a.x() * b.y() - a.y() * b.x());
      drawing.uv.push_back(uv);
    }
  }
  const double lines_to_see = 60; // across, of a surface seen from the front
  drawing.isoline_spacing = std::max(1.0, std::round(std::sqrt(steps / 2) / lines_to_see));
  for (const auto e : mesh.edges())
    if (domain.edge_curve[std::size_t(e.idx())] >= 0)
      drawing.feature_edges.push_back({int(mesh.vertex(e, 0).idx()), int(mesh.vertex(e, 1).idx())});
  for (const auto& [vertex, valence] : result.singular_vertices)
    drawing.singular_vertices.emplace_back(int(vertex.idx()), valence);
  if (drawing.uv.empty()) {
    const auto [u, v] = frame_vectors(domain, result.gradients);
    for (std::size_t f = 0; f < u.size(); ++f)
      drawing.frames.push_back({Eigen::Vector3d(u[f].data()), Eigen::Vector3d(v[f].data())});
  }
  return drawing;
}

} // namespace Quadrille
