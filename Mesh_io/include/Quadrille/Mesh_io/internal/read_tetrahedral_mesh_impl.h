// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_READ_TETRAHEDRAL_MESH_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_READ_TETRAHEDRAL_MESH_IMPL_H

#include <Quadrille/Mesh_io/internal/Volume_content.h>
#include <Quadrille/Mesh_io/internal/files.h>
#include <Quadrille/Mesh_io/internal/parse_medit.h>
#include <Quadrille/Mesh_io/internal/parse_ovm.h>
#include <Quadrille/Mesh_io/internal/parse_tetgen.h>
#include <Quadrille/Mesh_io/internal/parse_vtk.h>
#include <Quadrille/Mesh_io/internal/read_msh_volume.h>
#include <Quadrille/Mesh_io/internal/run_in_child_process.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/read_tetrahedral_mesh.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace Quadrille {
namespace internal {

inline std::string vtk_type_name(int type)
{
  switch (type) {
  case 11:
    return "voxel";
  case 12:
    return "hexahedron";
  case 13:
    return "wedge";
  case 14:
    return "pyramid";
  case 42:
    return "polyhedron";
  default:
    return "number " + std::to_string(type);
  }
}

/// Whether cells of this VTK type have dimension 0, 1 or 2.
inline bool is_below_volume(int type)
{
  return (type >= 0 && type <= 9) || (type >= 21 && type <= 23) || type == 28 || type == 30 || type == 34 ||
         type == 35 || type == 36 || (type >= 68 && type <= 70) || (type >= 75 && type <= 77);
}

/// The tetrahedra of a VTK file, of first or second order, and its lines as feature edges. No tetrahedra if it has no
/// cells of dimension 3.
inline Tetrahedral_mesh vtk_tetrahedra(Vtk_data& data, const std::string& path)
{
  Tetrahedral_mesh mesh;
  bool has_middle_nodes = false;
  for (std::size_t c = 0; c < data.types.size(); ++c) {
    const int type = data.types[c], *corners = data.corners_of(c);
    const std::size_t n = data.number_of_corners(c);
    if (type == 10 || type == 24) {
      if (n != (type == 10 ? 4u : 10u))
        throw Invalid_input_error(path + ": cell " + std::to_string(c) + " is a tetrahedron with " + std::to_string(n) +
                                  " corners");
      mesh.tetrahedra.push_back({corners[0], corners[1], corners[2], corners[3]});
      has_middle_nodes |= type == 24;
    } else if (type == 3 || type == 4 || type == 21) {
      for (std::size_t i = 1; i < (type == 21 ? std::min<std::size_t>(n, 2) : n); ++i)
        mesh.feature_edges.push_back({corners[i - 1], corners[i]});
    } else if (!is_below_volume(type)) {
      throw Invalid_input_error(path + ": cell " + std::to_string(c) + " is of VTK type " + vtk_type_name(type) +
                                "; of cells of dimension 3 only tetrahedra are read");
    }
  }
  if (mesh.tetrahedra.empty())
    return {};
  mesh.points = std::move(data.points);
  if (has_middle_nodes)
    remove_unused_points(mesh);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    for (const double x : mesh.points[v])
      if (!std::isfinite(x))
        throw Invalid_input_error(path + ": point " + std::to_string(v) +
                                  " has a coordinate that is not a finite number");
  return mesh;
}

/// What a file of one of the formats for volumes holds. `volume` is oriented and has its final feature edges.
/// \throws Invalid_input_error
inline Volume_content read_volume_content(const std::string& path, bool isolate, double time_limit_seconds)
{
  const std::string extension = extension_of(path);
  if (extension == ".meshb")
    throw Invalid_input_error(path + ": binary MEDIT files (.meshb) are not read; save the mesh as text (.mesh)");
  if (extension == ".ovmb")
    throw Invalid_input_error(path +
                              ": binary OpenVolumeMesh files (.ovmb) are not read; save the mesh as text (.ovm)");
  check_readable(path);
  Volume_content content;
  if (extension == ".msh") {
    const auto read = [&] { return read_msh_volume(path); };
    return isolate ? run_in_child_process<Volume_content>(read, time_limit_seconds, path) : read();
  }
  if (extension == ".mesh") {
    content = Medit_parser(read_whole_file(path), path).parse();
  } else if (extension == ".vtk") {
    Vtk_data data = Vtk_parser(read_whole_file(path), path).parse();
    content.volume = vtk_tetrahedra(data, path);
    if (content.volume.tetrahedra.empty())
      content.surface = vtk_polygons(std::move(data), path);
  } else if (extension == ".node" || extension == ".ele") {
    content.volume = Tetgen_parser(path).parse();
  } else if (extension == ".ovm") {
    content.volume = Ovm_parser(read_whole_file(path), path).parse();
  } else {
    throw Invalid_input_error(path + ": unknown format '" + extension +
                              "' for a tetrahedral mesh; known are .msh .mesh .vtk .node .ele .ovm");
  }
  orient_tetrahedra(content.volume);
  select_feature_edges(content.volume);
  return content;
}

} // namespace internal

QUADRILLE_INLINE Tetrahedral_mesh read_tetrahedral_mesh(const std::string& path, bool isolate,
                                                        double time_limit_seconds)
{
  internal::Volume_content content = internal::read_volume_content(path, isolate, time_limit_seconds);
  if (content.volume.tetrahedra.empty())
    throw Invalid_input_error(
        path + ": there are no tetrahedra in this file, " + internal::words_for_content(content.surface) +
        (content.surface.polygons.empty() ? std::string()
                                          : "; a closed surface can be filled with tetrahedra (fill_with_tetrahedra)"));
  return std::move(content.volume);
}

} // namespace Quadrille

#endif
