// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_MAKE_PLANAR_DOMAIN_H
#define QUADRILLE_MESH_IO_INTERNAL_MAKE_PLANAR_DOMAIN_H

#include <Quadrille/Mesh_io/internal/Curve_tracer.h>
#include <Quadrille/Mesh_io/internal/check_triangles.h>
#include <Quadrille/Mesh_io/internal/split_chords.h>
#include <Quadrille/Planar_domain.h>

#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

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

/// The regions of the triangles; unlabelled ones are in a region of their own.
inline std::vector<int> regions_of_faces(const Labelled_mesh& input, std::vector<Entity_label>& regions)
{
  std::vector<int> region_of_face(input.polygons.size(), -1);
  std::copy(input.polygon_region.begin(), input.polygon_region.end(), region_of_face.begin());
  int tag = 0;
  for (const Entity_label& label : input.regions)
    tag = std::max(tag, label.tag);
  for (int& region : region_of_face)
    if (region < 0) {
      if (regions.size() == input.regions.size())
        regions.push_back({tag + 1, {}});
      region = int(regions.size()) - 1;
    }
  return region_of_face;
}

inline int split_chords(const Labelled_mesh& input, Checked_triangles& checked, std::vector<int>& region_of_face)
{
  std::vector<std::array<int, 2>> lines;
  for (const std::array<int, 2>& line : input.lines) {
    const int a = checked.point_of_input[std::size_t(line[0])], b = checked.point_of_input[std::size_t(line[1])];
    if (a >= 0 && b >= 0)
      lines.push_back({a, b});
  }
  return Chord_splitter(checked.points, checked.triangles, region_of_face, lines).run();
}

} // namespace internal

inline Planar_domain make_planar_domain(const Labelled_mesh& input, const std::string& source,
                                        const Planar_domain_options& options)
{
  internal::Checked_triangles checked = internal::Triangle_checker(input, source).run();
  Planar_domain domain;
  domain.source = source;
  domain.groups = input.groups;
  domain.z = input.points[std::size_t(input.polygons[0][0])][2];
  if (checked.reversed)
    domain.notes.push_back("all triangles of a surface were clockwise: they are read as seen from the other side");
  domain.regions = input.regions;
  domain.face_region = internal::regions_of_faces(input, domain.regions);
  if (options.split_chords)
    domain.number_of_split_chords = internal::split_chords(input, checked, domain.face_region);
  internal::add_faces(checked, source, domain.mesh);
  internal::Curve_tracer(input, checked, options.corner_degrees, domain).run();
  domain.point_size.assign(domain.mesh.number_of_vertices(), 0);
  return domain;
}

} // namespace Quadrille

#endif
