// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_READ_LABELLED_MESH_H
#define QUADRILLE_MESH_IO_INTERNAL_READ_LABELLED_MESH_H

#include <Quadrille/Mesh_io/internal/parse_medit.h>
#include <Quadrille/Mesh_io/internal/parse_obj_off.h>
#include <Quadrille/Mesh_io/internal/parse_vtk.h>
#include <Quadrille/Mesh_io/internal/read_msh.h>
#include <Quadrille/Mesh_io/internal/run_in_child_process.h>

#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Simple_cartesian.h>

#include <fstream>
#include <string>

namespace Quadrille {
namespace internal {

/// PLY and STL by CGAL. The corners of an STL file's separate triangles are joined where they have equal coordinates.
inline Labelled_mesh read_by_cgal(const std::string& path, bool is_stl)
{
  using Point_3 = CGAL::Simple_cartesian<double>::Point_3;
  std::vector<Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  std::ifstream file(path, std::ios::binary);
  if (!(is_stl ? CGAL::IO::read_STL(file, points, polygons) : CGAL::IO::read_PLY(file, points, polygons)))
    throw Invalid_input_error(path + ": this is not a complete " + (is_stl ? "STL" : "PLY") + " file");
  if (is_stl)
    CGAL::Polygon_mesh_processing::merge_duplicate_points_in_polygon_soup(points, polygons);
  Labelled_mesh mesh;
  for (const Point_3& p : points)
    mesh.points.push_back({p.x(), p.y(), p.z()});
  for (const std::vector<std::size_t>& polygon : polygons) {
    mesh.polygons.emplace_back();
    for (const std::size_t v : polygon) {
      if (v >= points.size())
        throw Invalid_input_error(path + ": face " + std::to_string(mesh.polygons.size() - 1) + " uses vertex " +
                                  std::to_string(v) + ", which does not exist");
      mesh.polygons.back().push_back(int(v));
    }
  }
  mesh.polygon_region.assign(mesh.polygons.size(), -1);
  return mesh;
}

/// \throws Invalid_argument_error if a triangle size is asked for, although the file has triangles
inline void check_triangle_size_of_mesh(double triangle_size, const std::string& path)
{
  if (triangle_size > 0)
    throw Invalid_argument_error(path + ": a triangle size is only for geometry files; the triangles of a mesh file "
                                        "are taken as they are");
}

/// \throws Invalid_argument_error if a repair is asked for, although the file has no mesh
inline void check_no_repair_of_geometry(bool repair, const std::string& path)
{
  if (repair)
    throw Invalid_argument_error(path + ": only mesh files are repaired (--repair), not geometry");
}

/// A mesh file of any kind that we read, told by its extension. \throws Invalid_input_error, Invalid_argument_error
inline Labelled_mesh read_labelled_mesh(const std::string& path, bool isolate, double time_limit_seconds)
{
  check_readable(path);
  const std::string extension = extension_of(path);
  if (extension == ".obj")
    return parse_obj(read_whole_file(path), path);
  if (extension == ".off")
    return parse_off(read_whole_file(path), path);
  if (extension == ".mesh") {
    Volume_content content = Medit_parser(read_whole_file(path), path).parse();
    if (!content.volume.tetrahedra.empty())
      throw Invalid_input_error(path + ": the file holds " + std::to_string(content.volume.tetrahedra.size()) +
                                " tetrahedra where a mesh of polygons is needed");
    return std::move(content.surface);
  }
  if (extension == ".vtk")
    return vtk_polygons(Vtk_parser(read_whole_file(path), path).parse(), path);
  const auto isolated = [&](const auto& function) {
    return isolate ? run_in_child_process<Labelled_mesh>(function, time_limit_seconds, path) : function();
  };
  if (extension == ".msh")
    return isolated([&] { return Msh_reader(path).read(); });
  if (extension == ".ply" || extension == ".stl")
    return isolated([&] { return read_by_cgal(path, extension == ".stl"); });
  throw Invalid_input_error(path + ": unknown format '" + extension +
                            "'; known are geometry (.geo .step .stp .brep .iges .igs) and meshes (.msh .obj .off .vtk "
                            ".ply .stl .mesh)");
}

} // namespace internal
} // namespace Quadrille

#endif
