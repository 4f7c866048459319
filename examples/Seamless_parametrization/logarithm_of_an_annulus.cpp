// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Maps an annulus by u = log r, v = angle, knowing only the directions and lengths of their gradients: the seam's
// translation comes out as 2 pi, up to the size of the triangles, and both of its sides agree bit for bit.

#include <Quadrille/seamless_parametrization.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/property_map.h>

#include <cmath>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_2>;
using Vector = Kernel::Vector_2;

int main()
{
  const double pi = std::acos(-1.0);
  const Mesh::size_type rings = 16, steps = 128; // from radius 1 to 2
  Mesh mesh;
  for (Mesh::size_type j = 0; j <= rings; ++j)
    for (Mesh::size_type i = 0; i < steps; ++i) {
      const double radius = std::pow(2.0, double(j) / rings), angle = 2 * pi * (i + 0.5 * j) / steps;
      mesh.add_vertex({radius * std::cos(angle), radius * std::sin(angle)});
    }
  using Vertex = Mesh::Vertex_index;
  for (Mesh::size_type j = 0; j < rings; ++j)
    for (Mesh::size_type i = 0; i < steps; ++i) {
      const Vertex a(j * steps + i), b(j * steps + (i + 1) % steps), c(a + steps), d(b + steps);
      mesh.add_face(a, c, b);
      mesh.add_face(b, c, d);
    }

  auto gradients = mesh.add_property_map<Mesh::Face_index, std::pair<Vector, Vector>>("f:gradients").first;
  for (const Mesh::Face_index f : mesh.faces()) {
    Vector p(0, 0);
    for (const Vertex v : mesh.vertices_around_face(mesh.halfedge(f)))
      p += (mesh.point(v) - CGAL::ORIGIN) / 3;
    gradients[f] = {p / p.squared_length(), p.perpendicular(CGAL::COUNTERCLOCKWISE) / p.squared_length()};
  }

  auto uv = mesh.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
  const CGAL::Constant_property_map<Mesh::Edge_index, bool> no_features(false);
  const auto map = Quadrille::seamless_parametrization(mesh, mesh.points(), gradients, no_features, uv);

  std::cout << mesh.number_of_faces() << " triangles, " << map.seconds << " s, integration error "
            << map.integration_error << ", flipped " << map.flipped << "\n";
  for (const auto& seam : map.seams)
    std::cout << "seam of " << seam.halfedges.size() << " edges: " << seam.matching << " quarter turns, translation ("
              << seam.translation[0] << ", " << seam.translation[1] << "); 2 pi = " << 2 * pi << "\n";
  return map.flipped == 0 && map.seams.size() == 1 ? 0 : 1;
}
