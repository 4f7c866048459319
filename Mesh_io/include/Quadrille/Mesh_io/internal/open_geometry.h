// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_OPEN_GEOMETRY_H
#define QUADRILLE_MESH_IO_INTERNAL_OPEN_GEOMETRY_H

#include <Quadrille/Mesh_io/internal/Gmsh_session.h>
#include <Quadrille/Mesh_io/internal/check_geo_script.h>
#include <Quadrille/Mesh_io/internal/files.h>

#include <set>
#include <string>

namespace Quadrille {
namespace internal {

/// Whether the name is that of a geometry, rather than a mesh.
inline bool is_geometry_file(const std::string& path)
{
  static const std::set<std::string> extensions = {".geo", ".step", ".stp", ".brep", ".iges", ".igs"};
  return extensions.count(extension_of(path)) > 0;
}

/// Gmsh takes any text for a script, so the kinds that can be told are told here. \throws Invalid_input_error
inline void check_geometry_file(const std::string& path)
{
  const auto fail = [&](const std::string& reason) { throw Invalid_input_error(path + ": " + reason); };
  check_readable(path);
  const std::string extension = extension_of(path);
  const std::string beginning = read_beginning(path, 4096);
  if ((extension == ".step" || extension == ".stp") && beginning.find("ISO-10303-21") == std::string::npos)
    fail("this is not a STEP file (it does not begin with ISO-10303-21)");
  if (extension == ".brep" && beginning.find("CASCADE Topology") == std::string::npos)
    fail("this is not an Open CASCADE boundary representation (no line 'CASCADE Topology')");
  if ((extension == ".iges" || extension == ".igs") && (beginning.size() < 73 || beginning[72] != 'S'))
    fail("this is not an IGES file (column 73 of the first line is not 'S')");
  if (extension == ".geo" && beginning.find('\0') != std::string::npos)
    fail("this is not a text file");
  if (extension == ".geo" && !is_complete_geo_script(read_whole_file(path)))
    fail("the script ends within a statement, a comment or a block: it is truncated (or the last semicolon is "
         "missing)");
}

/// Makes the geometry of a file Gmsh's current model. \throws Invalid_input_error
inline void open_geometry(const std::string& path, const Gmsh_session& session)
{
  check_geometry_file(path);
  Gmsh_session::call(path, [&] { gmsh::open(path); });
  const std::string error = session.first_error();
  if (!error.empty())
    throw Invalid_input_error(path + ": the geometry cannot be read: " + error);
}

} // namespace internal
} // namespace Quadrille

#endif
