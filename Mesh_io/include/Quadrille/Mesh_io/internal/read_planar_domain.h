// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_READ_PLANAR_DOMAIN_H
#define QUADRILLE_MESH_IO_INTERNAL_READ_PLANAR_DOMAIN_H

#include <Quadrille/Mesh_io/internal/files.h>
#include <Quadrille/Mesh_io/internal/open_geometry.h>
#include <Quadrille/Mesh_io/internal/read_labelled_mesh.h>
#include <Quadrille/Mesh_io/internal/run_in_child_process.h>
#include <Quadrille/Mesh_io/internal/triangulate_geometry.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/read_planar_domain.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace Quadrille {
namespace internal {

inline void check_options(const Planar_domain_options& options)
{
  if (!(options.triangle_size >= 0) || !std::isfinite(options.triangle_size))
    throw Invalid_argument_error("the triangle size must be a positive number");
  if (!(options.edges_per_circle >= 3) || !(options.triangles_per_gap > 0) || !(options.size_gradation > 0) ||
      !(options.corner_degrees > 0 && options.corner_degrees < 180) || !(options.time_limit_seconds > 0))
    throw Invalid_argument_error("an option of reading planar domains is out of range");
}

/// A planar domain of what became of a geometry file.
inline Planar_domain geometry_domain(const Geometry_triangulation& result, const std::string& path,
                                     const Planar_domain_options& options)
{
  Planar_domain domain = make_planar_domain(result.mesh, path, options);
  domain.triangle_size = result.triangle_size;
  // Points that no triangle uses are left out of the domain, the order of the others stays.
  using Vertex = Planar_domain::vertex_descriptor;
  std::vector<Vertex> vertex_of(result.mesh.points.size());
  for (const std::vector<int>& polygon : result.mesh.polygons)
    for (const int v : polygon)
      vertex_of[std::size_t(v)] = Vertex(0);
  Vertex::size_type n = 0;
  for (std::size_t i = 0; i < vertex_of.size(); ++i)
    if (vertex_of[i] != Planar_domain::Mesh::null_vertex()) {
      domain.point_size[n] = result.point_size[i];
      vertex_of[i] = Vertex(n++);
    }
  domain.edge_tangents.assign(domain.mesh.number_of_edges(), {0, 0, 0, 0});
  for (std::size_t l = 0; l < result.mesh.lines.size(); ++l) {
    const auto h = domain.mesh.halfedge(vertex_of[std::size_t(result.mesh.lines[l][0])],
                                        vertex_of[std::size_t(result.mesh.lines[l][1])]);
    // Not `mesh.edge(h)`, whose halfedge is `h`: tangents follow the halfedges of the edges as `mesh.edges()` has them.
    const Planar_domain::edge_descriptor e(domain.mesh.edge(h).idx());
    const std::array<double, 4>& t = result.line_tangents[l];
    domain.edge_tangents[std::size_t(e.idx())] =
        domain.mesh.halfedge(e) == h ? t : std::array<double, 4>{-t[2], -t[3], -t[0], -t[1]};
  }
  domain.notes.insert(domain.notes.end(), result.notes.begin(), result.notes.end());
  return domain;
}

inline Planar_domain read_geometry_domain(const std::string& path, const Planar_domain_options& options)
{
  check_no_repair_of_geometry(options.repair, path);
  const auto triangulate = [&] {
    std::optional<Gmsh_session> session(std::in_place);
    open_geometry(path, *session);
    return triangulate_geometry(path, options, session);
  };
  return geometry_domain(options.isolate_geometry_kernel ? run_in_child_process<Geometry_triangulation>(
                                                               triangulate, options.time_limit_seconds, path)
                                                         : triangulate(),
                         path, options);
}

/// A planar domain of what a mesh file holds.
inline Planar_domain mesh_domain(const Labelled_mesh& mesh, const std::string& path,
                                 const Planar_domain_options& options)
{
  Planar_domain domain = make_planar_domain(mesh, path, options);
  if (domain.number_of_split_chords > 0)
    domain.notes.push_back(std::to_string(domain.number_of_split_chords) +
                           " inner edges of the triangles, between two points of curves, were split");
  return domain;
}

} // namespace internal

QUADRILLE_INLINE Planar_domain read_planar_domain(const std::string& path, const Planar_domain_options& options)
{
  internal::check_options(options);
  internal::check_readable(path);
  if (internal::is_geometry_file(path))
    return internal::read_geometry_domain(path, options);
  internal::check_triangle_size_of_mesh(options.triangle_size, path);
  return internal::mesh_domain(
      internal::read_labelled_mesh(path, options.isolate_geometry_kernel, options.time_limit_seconds), path, options);
}

} // namespace Quadrille

#endif
