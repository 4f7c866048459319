// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The whole way from a file to quads with the packages: domain, field, map, quads. Usage: domain_to_quads [domain.geo]

#include <Quadrille/Size_specification.h>
#include <Quadrille/odeco_frame_field.h>
#include <Quadrille/quad_extraction.h>
#include <Quadrille/read_planar_domain.h>
#include <Quadrille/seamless_parametrization.h>

#include <boost/property_map/property_map.hpp>

#include <iostream>

using namespace Quadrille;
using Mesh = Planar_domain::Mesh;

int main(int argc, char** argv)
{
  try {
    Planar_domain domain = read_planar_domain(argc > 1 ? argv[1] : QUADRILLE_EXAMPLE_DATA "/square_1_2.geo");
    Mesh& mesh = domain.mesh;

    // Frames along all curves, of the sizes that the file has at its points.
    const Domain_sizes sizes = Size_specification().apply(domain);
    auto constraint = mesh.add_property_map<Mesh::Edge_index, Edge_frame_constraint>("e:frame").first;
    auto is_on_curve = mesh.add_property_map<Mesh::Edge_index, bool>("e:on_curve", false).first;
    for (const Mesh::Edge_index e : mesh.edges()) {
      is_on_curve[e] = get(domain.curve_map(), e) >= 0;
      if (is_on_curve[e])
        constraint[e] = {true, true, sizes.of_edge[e.idx()][0], sizes.of_edge[e.idx()][1]};
    }

    auto gradients = mesh.add_property_map<Mesh::Face_index, Gradient_pair>("f:gradients").first;
    const Odeco_field_result field = odeco_frame_field(mesh, mesh.points(), constraint, gradients);
    std::cout << "field: energy " << field.energy << ", " << field.seconds << " s\n";

    auto uv = mesh.add_property_map<Mesh::Halfedge_index, Planar_domain::Point_2>("h:uv").first;
    const auto map = seamless_parametrization(mesh, mesh.points(), gradients, is_on_curve, uv);
    std::cout << "map: integration error " << map.integration_error << ", " << map.singular_vertices.size()
              << " singularities\n";

    Mesh quads;
    const Quad_extraction_result extraction =
        extract_quads(mesh, mesh.points(), uv, domain.chain_map(), domain.region_map(), quads);
    std::cout << "mesh: " << quads.number_of_faces() << " quads in " << extraction.layout.patches.size()
              << " patches\n";
    return quads.number_of_faces() > 0 ? 0 : 1;
  } catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
