// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Reads a planar domain, puts element sizes on its curves, and writes its triangles as read_and_size_a_domain.msh.
// Usage: read_and_size_a_domain [domain.geo [size ...]], sizes as for quadrille quad --size.

#include <Quadrille/Size_specification.h>
#include <Quadrille/read_planar_domain.h>
#include <Quadrille/write_mesh.h>

#include <iostream>

int main(int argc, char** argv)
{
  try {
    const Quadrille::Planar_domain domain =
        Quadrille::read_planar_domain(argc > 1 ? argv[1] : QUADRILLE_EXAMPLE_DATA "/plate_with_holes.geo");
    Quadrille::Size_specification specification;
    for (int i = 2; i < argc; ++i)
      specification.add(argv[i]);
    const Quadrille::Domain_sizes sizes = specification.apply(domain);
    for (const std::string& note : sizes.notes)
      std::cout << note << "\n";

    Quadrille::Labelled_mesh mesh;
    for (const auto v : domain.mesh.vertices())
      mesh.points.push_back({domain.mesh.point(v).x(), domain.mesh.point(v).y(), domain.z});
    for (const auto f : domain.mesh.faces()) {
      mesh.polygons.emplace_back();
      for (const auto v : domain.mesh.vertices_around_face(domain.mesh.halfedge(f)))
        mesh.polygons.back().push_back(int(v.idx()));
    }
    mesh.polygon_region = domain.face_region;
    mesh.regions = domain.regions;
    mesh.groups = domain.groups;
    for (const Quadrille::Planar_domain::Curve& curve : domain.curves) {
      const auto first = domain.mesh.edge(curve.path.front());
      std::cout << "curve " << curve.tag << (curve.names.empty() ? "" : " (" + curve.names[0] + ")") << ": "
                << curve.path.size() << " edges, element size " << sizes.of_edge[first.idx()][0].tangential << "\n";
      for (const auto h : curve.path) {
        mesh.lines.push_back({int(domain.mesh.source(h).idx()), int(domain.mesh.target(h).idx())});
        mesh.line_curve.push_back(int(mesh.curves.size()));
      }
      mesh.curves.push_back(curve);
    }
    Quadrille::write_mesh("read_and_size_a_domain.msh", mesh);
  } catch (const Quadrille::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
