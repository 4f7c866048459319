// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "refine_around_singularities.h"

#include <Quadrille/odeco_tensors_2.h>
#include <Quadrille/refine_planar_domain.h>

#include <cmath>
#include <limits>

namespace Quadrille {

namespace {

using Mesh = Planar_domain::Mesh;

/// Two bisections make a quarter of the area; the rest is room for rounding.
constexpr double area_ratio = 0.25 * 1.01;
constexpr int n_layers = 3;

std::vector<double> largest_areas(const Mesh& mesh,
                                  const std::vector<std::pair<Mesh::Vertex_index, int>>& singular_vertices)
{
  std::vector<char> is_near(mesh.number_of_vertices(), 0);
  std::vector<Mesh::Vertex_index> layer;
  for (const auto& [vertex, valence] : singular_vertices) {
    is_near[vertex.idx()] = 1;
    layer.push_back(vertex);
  }
  for (int i = 1; i < n_layers; ++i) {
    std::vector<Mesh::Vertex_index> next;
    for (const auto v : layer)
      for (const auto w : mesh.vertices_around_target(mesh.halfedge(v)))
        if (!is_near[w.idx()]) {
          is_near[w.idx()] = 1;
          next.push_back(w);
        }
    layer.swap(next);
  }
  std::vector<double> areas;
  for (const auto f : mesh.faces()) {
    areas.push_back(std::numeric_limits<double>::infinity());
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      if (is_near[v.idx()]) {
        const auto h = mesh.halfedge(f);
        areas.back() = area_ratio * CGAL::area(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                               mesh.point(mesh.target(mesh.next(h))));
      }
  }
  return areas;
}

/// The mean of the tensors in the faces around each vertex.
std::vector<Circular_harmonics> vertex_tensors(const Mesh& mesh, const std::vector<Gradient_pair>& gradients)
{
  std::vector<Circular_harmonics> tensors;
  for (const auto v : mesh.vertices()) {
    Circular_harmonics sum = Circular_harmonics::Zero();
    int n = 0;
    for (const auto f : mesh.faces_around_target(mesh.halfedge(v))) {
      if (f == Mesh::null_face())
        continue;
      const auto& [du, dv] = gradients[f.idx()];
      Orthogonal_frame_2 frame;
      frame.direction = du.normalized();
      frame.size_u = 1 / du.norm();
      frame.size_v = 1 / dv.norm();
      sum += odeco_harmonics(frame);
      ++n;
    }
    tensors.push_back(sum / n);
  }
  return tensors;
}

} // namespace

Field_problem
refine_around_singularities(const Planar_domain& domain, const std::vector<Edge_frame_constraint>& constraints,
                            const Odeco_field_options& options, const std::vector<Gradient_pair>& gradients,
                            const std::vector<std::pair<Planar_domain::vertex_descriptor, int>>& singular_vertices)
{
  Refined_planar_domain refined = refine_planar_domain(domain, largest_areas(domain.mesh, singular_vertices));
  Field_problem problem{std::move(refined.domain), constraints, options};
  problem.constraints.resize(problem.domain.mesh.number_of_edges());
  std::vector<Circular_harmonics>& field = problem.options.initial_field = vertex_tensors(domain.mesh, gradients);
  std::vector<double>& size = problem.options.target_size;
  std::vector<Eigen::Matrix2d>& metric = problem.options.target_metric;
  for (const auto& [a, b] : refined.parents) {
    field.push_back(0.5 * (field[a.idx()] + field[b.idx()]));
    if (!size.empty()) // zero where there is no target, and so between it and one
      size.push_back(std::sqrt(size[a.idx()] * size[b.idx()]));
    if (!metric.empty())
      metric.push_back(metric[a.idx()].isZero(0) || metric[b.idx()].isZero(0)
                           ? Eigen::Matrix2d(Eigen::Matrix2d::Zero())
                           : Eigen::Matrix2d(0.5 * (metric[a.idx()] + metric[b.idx()])));
  }
  return problem;
}

} // namespace Quadrille
