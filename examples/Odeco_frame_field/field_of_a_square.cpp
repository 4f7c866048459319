// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// An integrable frame field on a square whose elements shall be twice as large at the top as at the bottom.

#include <Quadrille/odeco_frame_field.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_2>;

int main()
{
  const int n = 24;
  Mesh mesh;
  CGAL::make_grid(
      n, n, mesh, [](unsigned i, unsigned j) { return Kernel::Point_2(i, j); }, true);

  // Frames along the boundary, with element sizes from 1 (bottom) to 2 (top).
  auto constraint = mesh.add_property_map<Mesh::Edge_index, Quadrille::Edge_frame_constraint>("e:frame").first;
  const auto size = [&](Mesh::Vertex_index v) { return 1 + mesh.point(v).y() / n; };
  for (const Mesh::Edge_index e : mesh.edges())
    if (mesh.is_border(e)) {
      const Mesh::Halfedge_index h = mesh.halfedge(e);
      constraint[e] = {true, true, size(mesh.source(h)), size(mesh.target(h))};
    }

  auto gradients = mesh.add_property_map<Mesh::Face_index, Quadrille::Gradient_pair>("f:gradients").first;
  Quadrille::Odeco_field_options options;
  options.starts = 2;
  const Quadrille::Odeco_field_result field =
      Quadrille::odeco_frame_field(mesh, mesh.points(), constraint, gradients, options);

  for (const Quadrille::Field_start& start : field.starts)
    std::cout << "energy " << start.energy << " after " << start.iterations << " steps, " << start.seconds << " s\n";
  std::cout << "chosen: start " << field.chosen << "; element size in the first face "
            << 1 / gradients[Mesh::Face_index(0)].first.norm() << "\n";
  return 0;
}
