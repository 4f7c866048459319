// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// An integrable frame field on a sphere, and its singularities: eight of valence 3, as of a cube that is blown up.

#include <Quadrille/Surface_tangent_traits.h>
#include <Quadrille/frame_field_topology.h>
#include <Quadrille/odeco_surface_field.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>

#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

int main()
{
  Mesh mesh;
  CGAL::make_icosahedron<Mesh, Kernel::Point_3>(mesh);
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(3));
  for (const Mesh::Vertex_index v : mesh.vertices()) {
    const Kernel::Vector_3 p = mesh.point(v) - CGAL::ORIGIN;
    mesh.point(v) = CGAL::ORIGIN + p / CGAL::approximate_sqrt(p.squared_length());
  }

  // Nothing is prescribed: no edge is constrained.
  auto constraint = mesh.add_property_map<Mesh::Edge_index, Quadrille::Edge_frame_constraint>("e:frame").first;
  auto gradients = mesh.add_property_map<Mesh::Face_index, Quadrille::Gradient_pair>("f:gradients").first;
  Quadrille::Surface_field_options options;
  options.starts = 1;
  options.typical_size = 0.1;
  const Quadrille::Surface_field_result field =
      Quadrille::odeco_surface_field(mesh, mesh.points(), constraint, gradients, options);
  std::cout << "energy: curl " << field.terms.curl << ", odeco " << field.terms.odeco << "\n";

  auto is_feature = mesh.add_property_map<Mesh::Edge_index, bool>("e:feature", false).first;
  auto matching = mesh.add_property_map<Mesh::Halfedge_index, int>("h:matching", 0).first;
  const Quadrille::Surface_tangent_traits traits(mesh, mesh.points());
  const auto topology = Quadrille::frame_field_topology_with_traits(mesh, traits, gradients, is_feature, matching);
  for (const auto& [vertex, quarters] : topology.singular_vertices)
    std::cout << "valence " << 4 - quarters << " at " << mesh.point(vertex) << "\n";
  return topology.quarter_index_sum == 8 ? 0 : 1;
}
