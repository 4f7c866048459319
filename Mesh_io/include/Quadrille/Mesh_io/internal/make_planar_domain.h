// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_MAKE_PLANAR_DOMAIN_H
#define QUADRILLE_MESH_IO_INTERNAL_MAKE_PLANAR_DOMAIN_H

#include <Quadrille/Mesh_io/internal/Curve_tracer.h>
#include <Quadrille/Mesh_io/internal/check_triangles.h>
#include <Quadrille/Planar_domain.h>

#include <CGAL/boost/graph/iterator.h>

namespace Quadrille {
namespace internal {

inline void add_faces(const Checked_triangles& checked, const std::string& source, Planar_domain::Mesh& mesh)
{
  mesh.reserve(Planar_domain::Mesh::size_type(checked.points.size()),
               Planar_domain::Mesh::size_type(checked.points.size() + checked.triangles.size()),
               Planar_domain::Mesh::size_type(checked.triangles.size()));
  for (const Planar_domain::Point_2& point : checked.points)
    mesh.add_vertex(point);
  using Vertex = Planar_domain::vertex_descriptor;
  const auto vertex = [](int v) { return Vertex(Vertex::size_type(v)); };
  for (const std::array<int, 3>& t : checked.triangles)
    if (mesh.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2])) == Planar_domain::Mesh::null_face())
      throw Invalid_input_error(source + ": the triangles around point " + std::to_string(t[0]) +
                                " do not form a manifold");
}

} // namespace internal

inline Planar_domain make_planar_domain(const Labelled_mesh& input, const std::string& source,
                                        const Planar_domain_options& options)
{
  const internal::Checked_triangles checked = internal::Triangle_checker(input, source).run();
  Planar_domain domain;
  domain.source = source;
  domain.groups = input.groups;
  domain.z = input.points[std::size_t(input.polygons[0][0])][2];
  if (checked.reversed)
    domain.notes.push_back("all triangles of a surface were clockwise: they are read as seen from the other side");
  internal::add_faces(checked, source, domain.mesh);

  domain.regions = input.regions;
  domain.face_region.assign(domain.mesh.number_of_faces(), -1);
  for (std::size_t f = 0; f < input.polygon_region.size(); ++f)
    domain.face_region[f] = input.polygon_region[f];
  for (int& region : domain.face_region)
    if (region < 0) {
      if (domain.regions.size() == input.regions.size()) {
        int tag = 0;
        for (const Entity_label& label : input.regions)
          tag = std::max(tag, label.tag);
        domain.regions.push_back({tag + 1, {}});
      }
      region = int(domain.regions.size()) - 1;
    }

  internal::Curve_tracer(input, checked, options.corner_degrees, domain).run();
  domain.point_size.assign(domain.mesh.number_of_vertices(), 0);
  return domain;
}

} // namespace Quadrille

#endif
