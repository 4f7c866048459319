// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The whole way from a part to quads of its surface: triangles, field, map, quads. Usage: surface_to_quads [part]

#include <Quadrille/Size_specification.h>
#include <Quadrille/Surface_tangent_traits.h>
#include <Quadrille/odeco_surface_field.h>
#include <Quadrille/quad_extraction.h>
#include <Quadrille/read_surface_domain.h>
#include <Quadrille/seamless_parametrization.h>

#include <iostream>

using namespace Quadrille;
using Mesh = Surface_domain::Mesh;

int main(int argc, char** argv)
{
  try {
    const char* file = argc > 1 ? argv[1] : QUADRILLE_EXAMPLE_DATA "/box_transition.geo";
    Surface_domain domain = read_surface_domain(file);
    Mesh& mesh = domain.mesh;

    const Domain_sizes sizes = Size_specification().apply(domain); // of the file, or a part of its extent
    auto constraint = mesh.add_property_map<Mesh::Edge_index, Edge_frame_constraint>("e:frame").first;
    auto is_feature = mesh.add_property_map<Mesh::Edge_index, bool>("e:feature", false).first;
    for (const Mesh::Edge_index e : mesh.edges()) {
      is_feature[e] = get(domain.curve_map(), e) >= 0;
      if (is_feature[e])
        constraint[e] = {true, true, sizes.of_edge[e.idx()][0], sizes.of_edge[e.idx()][1]};
    }

    auto gradients = mesh.add_property_map<Mesh::Face_index, Gradient_pair>("f:gradients").first;
    Surface_field_options options;
    options.starts = 0; // the relaxed field is enough for a box
    odeco_surface_field(mesh, mesh.points(), constraint, gradients, options);

    auto uv = mesh.add_property_map<Mesh::Halfedge_index, Planar_domain::Point_2>("h:uv").first;
    const auto map = seamless_parametrization_with_traits(mesh, Surface_tangent_traits(mesh, mesh.points()), gradients,
                                                          is_feature, uv);
    std::cout << "map: integration error " << map.integration_error << ", " << map.singular_vertices.size()
              << " singularities\n";

    Mesh quads;
    const auto result = extract_quads(mesh, mesh.points(), uv, domain.chain_map(), domain.region_map(), quads);
    std::cout << "mesh: " << quads.number_of_faces() << " quads, " << result.curve_edges.size()
              << " of their edges on features\n";
    return quads.number_of_faces() > 0 ? 0 : 1;
  } catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
