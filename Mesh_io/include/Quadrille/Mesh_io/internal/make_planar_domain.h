// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_MAKE_PLANAR_DOMAIN_H
#define QUADRILLE_MESH_IO_INTERNAL_MAKE_PLANAR_DOMAIN_H

#include <Quadrille/Mesh_io/internal/Curve_tracer.h>
#include <Quadrille/Mesh_io/internal/check_triangles.h>
#include <Quadrille/Mesh_io/internal/domain_faces.h>
#include <Quadrille/Mesh_io/internal/split_chords.h>
#include <Quadrille/Planar_domain.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/repair_mesh.h>

#include <array>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

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

QUADRILLE_INLINE Planar_domain make_planar_domain(const Labelled_mesh& input, const std::string& source,
                                                  const Planar_domain_options& options)
{
  if (options.repair) {
    Mesh_repair_report report;
    Planar_domain_options of_repaired = options;
    of_repaired.repair = false;
    Planar_domain domain = make_planar_domain(repair_mesh(input, report), source, of_repaired);
    domain.notes.insert(domain.notes.begin(), "repaired: " + report.text());
    return domain;
  }
  internal::Checked_triangles checked = internal::Triangle_checker(input, source).run();
  Planar_domain domain;
  domain.source = source;
  domain.groups = input.groups;
  domain.z = input.points[std::size_t(input.polygons[0][0])][2];
  if (checked.reversed)
    domain.notes.push_back("all triangles of a surface were clockwise: they are read as seen from the other side");
  domain.face_region = internal::regions_of_faces(input, domain.regions);
  if (options.split_chords)
    domain.number_of_split_chords = internal::split_chords(input, checked, domain.face_region);
  internal::add_faces(checked.points, checked.triangles, source, domain.mesh);
  internal::Curve_tracer<Planar_domain::Point_2>(input, checked.point_of_input, options.corner_degrees, domain).run();
  domain.point_size.assign(domain.mesh.number_of_vertices(), 0);
  return domain;
}

} // namespace Quadrille

#endif
