// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Reads tetrahedra, or fills a part with them, and writes them with the volume of each, and the feature edges.
// Usage: tetrahedra_of_a_part [part.step|part.stl|part.msh|... [size]]

#include <Quadrille/fill_with_tetrahedra.h>
#include <Quadrille/write_vtu.h>

#include <Eigen/LU>

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv)
{
  try {
    Quadrille::Filling_options options;
    if (argc > 2)
      options.tetrahedron_size = std::atof(argv[2]);
    const Quadrille::Tetrahedral_mesh mesh =
        Quadrille::load_tetrahedral_mesh(argc > 1 ? argv[1] : QUADRILLE_EXAMPLE_DATA "/block_with_hole.geo", options);

    std::vector<double> volumes;
    double sum = 0;
    for (const std::array<int, 4>& t : mesh.tetrahedra) {
      Eigen::Matrix3d edges;
      for (std::size_t i = 0; i < 3; ++i)
        edges.col(Eigen::Index(i)) = mesh.point(std::size_t(t[i + 1])) - mesh.point(std::size_t(t[0]));
      volumes.push_back(edges.determinant() / 6);
      sum += volumes.back();
    }
    std::cout << mesh.number_of_vertices() << " vertices, " << mesh.number_of_tetrahedra() << " tetrahedra, "
              << mesh.feature_edges.size() << " feature edges, volume " << sum << "\n";
    Quadrille::write_vtu("tetrahedra.vtu", mesh, {{}, {{"volume", 1, volumes}}});

    std::vector<std::vector<int>> lines;
    for (const std::array<int, 2>& edge : mesh.feature_edges)
      lines.push_back({edge[0], edge[1]});
    Quadrille::write_vtu("features.vtu", mesh.points, lines);
  } catch (const Quadrille::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
