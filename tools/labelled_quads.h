// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_LABELLED_QUADS_H
#define QUADRILLE_TOOLS_LABELLED_QUADS_H

#include <Quadrille/Curve_locator.h>
#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Mesh_quality.h>
#include <Quadrille/Planar_domain.h>
#include <Quadrille/Quad_extraction_options.h>
#include <Quadrille/Surface_domain.h>
#include <Quadrille/exceptions.h>

#include <CGAL/Kernel/global_functions.h>

namespace Quadrille {

inline std::array<double, 3> coordinates(const Planar_domain& domain, const Planar_domain::Point_2& p)
{
  return {p.x(), p.y(), domain.z};
}

inline std::array<double, 3> coordinates(const Surface_domain&, const Surface_domain::Point_3& p)
{
  return {p.x(), p.y(), p.z()};
}

/// The quads of a domain with the names of its curves and regions, checked once more as the mesh that they are.
/// \throws No_result_error("mesh", ...) if they are not valid
/// \tparam Domain `Planar_domain` or `Surface_domain`
template <class Domain>
Labelled_mesh labelled_quads(const Domain& domain, const typename Domain::Mesh& quads,
                             const Quad_extraction_result& extraction)
{
  Labelled_mesh mesh;
  for (const auto v : quads.vertices())
    mesh.points.push_back(coordinates(domain, quads.point(v)));
  for (const auto f : quads.faces()) {
    mesh.polygons.emplace_back();
    for (const auto v : quads.vertices_around_face(quads.halfedge(f)))
      mesh.polygons.back().push_back(int(v.idx()));
  }
  mesh.polygon_region = extraction.quad_regions;
  // The extraction knows chains of curves; the nearest curve of the chain gives an edge its label.
  const Curve_locator locator(domain);
  const auto point = [&quads](int v) { return quads.point(typename Domain::vertex_descriptor(unsigned(v))); };
  for (const Quad_extraction_result::Curve_edge& edge : extraction.curve_edges) {
    const auto place = locator.nearest(CGAL::midpoint(point(edge.source), point(edge.target)), edge.curve);
    mesh.lines.push_back({edge.source, edge.target});
    mesh.line_curve.push_back(domain.edge_curve[std::size_t(place.edge.idx())]);
  }
  for (const typename Domain::Curve& curve : domain.curves)
    mesh.curves.push_back(curve);
  mesh.regions = domain.regions;
  mesh.groups = domain.groups;
  const Mesh_validity validity = check_quad_mesh(mesh);
  if (!validity.is_valid())
    throw No_result_error("mesh", validity.problems[0]);
  return mesh;
}

} // namespace Quadrille

#endif
