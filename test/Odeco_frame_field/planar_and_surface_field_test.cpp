// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "field_test_meshes.h"
#include "surface_test_meshes.h"

#include <Quadrille/Surface_tangent_traits.h>
#include <Quadrille/frame_field_topology.h>
#include <Quadrille/odeco_frame_field.h>
#include <Quadrille/odeco_surface_field.h>

#include <boost/property_map/property_map.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace {

using namespace Quadrille;
using namespace Quadrille_test;

template <class Value> auto map_of(std::vector<Value>& values)
{
  return boost::make_iterator_property_map(values.begin(), boost::identity_property_map());
}

/// What can be compared: singular vertices with their quarter indices, and the area of an element on every face.
struct Found {
  std::map<int, int> singular_vertices;
  std::vector<double> element_area;
};

/// On all edges of the border.
constexpr double size = 0.1;

/// An ellipse: its axes leave the directions of a field no choice.
Triangles ellipse()
{
  Triangles triangles = disk(14);
  for (Eigen::Vector2d& p : triangles.points)
    p.x() *= 1.5;
  return triangles;
}

template <class Mesh_type> std::vector<Edge_frame_constraint> border_constraints(const Mesh_type& mesh)
{
  std::vector<Edge_frame_constraint> constraints(mesh.number_of_edges());
  for (const auto e : mesh.edges())
    if (mesh.is_border(e))
      constraints[e] = {true, true, size, size};
  return constraints;
}

template <class Topology> Found found(const Topology& topology, const std::vector<Gradient_pair>& gradients)
{
  Found result;
  for (const auto& [v, quarters] : topology.singular_vertices)
    result.singular_vertices[int(v)] = quarters;
  for (const auto& [u, v] : gradients)
    result.element_area.push_back(1 / std::abs(u.x() * v.y() - u.y() * v.x()));
  return result;
}

template <class Mesh_type> std::vector<char> border_edges(const Mesh_type& mesh)
{
  std::vector<char> result(mesh.number_of_edges(), 0);
  for (const auto e : mesh.edges())
    result[e] = mesh.is_border(e);
  return result;
}

Found planar_field(const Triangles& triangles)
{
  const auto mesh = triangles.surface_mesh();
  std::vector<Edge_frame_constraint> constraints = border_constraints(mesh);
  std::vector<Gradient_pair> gradients(mesh.number_of_faces());
  Odeco_field_options options;
  options.isotropic = true;
  options.starts = 2;
  odeco_frame_field(mesh, mesh.points(), map_of(constraints), map_of(gradients), options);
  std::vector<char> is_border = border_edges(mesh);
  std::vector<int> matching(mesh.number_of_halfedges());
  return found(frame_field_topology(mesh, mesh.points(), map_of(gradients), map_of(is_border), map_of(matching)),
               gradients);
}

Found surface_field(const Triangles& triangles, const std::function<Eigen::Vector3d(const Eigen::Vector2d&)>& place)
{
  Space_triangles in_space;
  in_space.faces = triangles.faces;
  for (const Eigen::Vector2d& p : triangles.points)
    in_space.points.push_back(place(p));
  const Space_mesh mesh = in_space.surface_mesh();
  std::vector<Edge_frame_constraint> constraints = border_constraints(mesh);
  std::vector<Gradient_pair> gradients(mesh.number_of_faces());
  Surface_field_options options;
  options.isotropic = true;
  options.starts = 2;
  odeco_surface_field(mesh, mesh.points(), map_of(constraints), map_of(gradients), options);
  std::vector<char> is_border = border_edges(mesh);
  std::vector<int> matching(mesh.number_of_halfedges());
  const Surface_tangent_traits<Space_mesh, Space_mesh::Property_map<Space_mesh::Vertex_index, Space_mesh::Point>>
      traits(mesh, mesh.points());
  return found(frame_field_topology_with_traits(mesh, traits, map_of(gradients), map_of(is_border), map_of(matching)),
               gradients);
}

/// Singularities of valence 3 move along flat valleys of the energy, so a few triangles are allowed.
void expect_same_field(const Triangles& triangles, const Found& planar, const Found& in_space)
{
  ASSERT_EQ(planar.singular_vertices.size(), 4u);
  ASSERT_EQ(in_space.singular_vertices.size(), 4u);
  const double edge = 1. / 14;
  for (const auto& [v, quarters] : planar.singular_vertices) {
    EXPECT_EQ(quarters, 1);
    double nearest = HUGE_VAL;
    for (const auto& [w, others] : in_space.singular_vertices)
      nearest = std::min(nearest, (triangles.points[std::size_t(v)] - triangles.points[std::size_t(w)]).norm());
    EXPECT_LT(nearest, 4 * edge);
  }
  double mean = 0;
  for (std::size_t f = 0; f < planar.element_area.size(); ++f)
    mean += 0.5 * std::abs(std::log(planar.element_area[f] / in_space.element_area[f]));
  EXPECT_LT(mean / double(planar.element_area.size()), 0.05);
}

TEST(Planar_and_surface_field, are_the_same_where_the_plane_is_moved_in_space)
{
  const Triangles triangles = ellipse();
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  expect_same_field(triangles, planar_field(triangles), surface_field(triangles, [&](const Eigen::Vector2d& p) {
                      return Eigen::Vector3d(turn * Eigen::Vector3d(p.x(), p.y(), 0) + Eigen::Vector3d(5, 6, 7));
                    }));
}

TEST(Planar_and_surface_field, are_the_same_where_the_plane_is_rolled_up)
{
  const Triangles triangles = ellipse();
  const Found planar = planar_field(triangles);
  expect_same_field(triangles, planar, surface_field(triangles, [](const Eigen::Vector2d& p) {
                      return Eigen::Vector3d(std::cos(p.x()), std::sin(p.x()), p.y());
                    }));
  expect_same_field(triangles, planar, surface_field(triangles, [](const Eigen::Vector2d& p) {
                      return Eigen::Vector3d(p.x(), std::cos(-p.y()), std::sin(-p.y()));
                    }));
}

} // namespace
