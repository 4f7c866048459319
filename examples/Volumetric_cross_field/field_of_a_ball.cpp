// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The smoothest cross field of a ball, and the curves around which it turns: an inner cube of twelve arcs whose corners
// are joined to the sphere by eight more.

#include <Quadrille/Singular_graph.h>
#include <Quadrille/align_with_boundary.h>
#include <Quadrille/check_tetrahedral_mesh.h>
#include <Quadrille/fill_with_tetrahedra.h>
#include <Quadrille/volumetric_cross_field.h>

#include <iostream>

int main(int argc, char** argv)
{
  using namespace Quadrille;
  const std::string path = argc > 1 ? argv[1] : QUADRILLE_EXAMPLE_DATA "/ball.geo";

  // Any model of TetrahedralMesh will do; this one comes from a file.
  Filling_options filling;
  filling.tetrahedron_size = 0.12;
  const Tetrahedral_mesh mesh = load_tetrahedral_mesh(path, filling);
  check_tetrahedral_mesh(mesh);

  // Normals and creases of the boundary, then the field inside.
  const Vertex_alignments alignments = align_with_boundary(mesh, {}, mesh.feature_edges);
  const Volumetric_cross_field field = volumetric_cross_field(mesh, alignments);
  std::cout << mesh.number_of_tetrahedra() << " tetrahedra, energy " << field.energy << "\n";

  const Singular_graph graph = singular_graph(mesh, field.frames);
  std::size_t to_boundary = 0;
  for (const Singular_graph::Arc& arc : graph.arcs)
    if (arc.from == Singular_graph::at_boundary || arc.to == Singular_graph::at_boundary)
      ++to_boundary;
  std::cout << graph.arcs.size() << " arcs, " << graph.number_of_arcs(Singular_graph::Valence::three)
            << " of them of valence 3, " << to_boundary << " that end on the boundary\n";
  for (const auto& [degree, n] : graph.nodes_by_degree())
    std::cout << n << " nodes of degree " << degree << "\n";
  for (const Singular_graph::Obstacle& obstacle : graph.obstacles)
    std::cout << "no hexahedral mesh has this graph: " << obstacle.reason << "\n";
  return graph.is_hex_meshable() ? 0 : 1;
}
