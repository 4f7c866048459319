// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_WRITE_MESH_H
#define QUADRILLE_WRITE_MESH_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Planar_domain.h>
#include <Quadrille/exceptions.h>

#include <array>
#include <string>
#include <vector>

namespace Quadrille {

/// The file formats of `write_mesh()`.
enum class Mesh_file_format {
  by_extension, ///< .msh (4.1), .vtk, .vtu, .obj
  msh_4_1,      ///< Gmsh, text, with entities and physical groups
  msh_2_2,      ///< Gmsh's older format, which more programs read; with physical groups
  vtk,          ///< legacy VTK, unstructured grid, text
  vtu,          ///< VTK XML, unstructured grid, text
  obj           ///< Wavefront
};

/// The format that `by_extension` means for `path`. \throws Invalid_argument_error if the extension is unknown.
Mesh_file_format mesh_file_format(const std::string& path);

/// Writes polygons and lines with their labels. Numbers are written so that reading gives the same doubles.
///
/// The file appears at once and complete (it is written beside its place and renamed), or not at all.
/// \throws Output_error naming the file if it cannot be written.
/// \throws Invalid_argument_error as `mesh_file_format()`.
void write_mesh(const std::string& path, const Labelled_mesh& mesh,
                Mesh_file_format format = Mesh_file_format::by_extension);

/// Writes a frame field as VTU (binary): the triangles, and then the edges on curves and the singular vertices as
/// cells.
///
/// At the cells are, for triangles, the frame vectors `u` and `v` (their lengths are the element sizes `size_u`,
/// `size_v`; all zero for other cells), the `dimension` of the cell (2, 1, 0) to choose by, and the tag of its region
/// or curve (`entity`, 0 for vertices). At the points are their `valence` (4 regular; 3, 5, ... singular) and whether
/// they are `singular` (0, 1). \tparam Domain `Planar_domain` or `Surface_domain` \pre one entry of `u` and `v` per
/// face and of `valence` per vertex of `domain.mesh`. \throws Output_error, Invalid_argument_error (the extension is
/// not .vtu, or the number of entries is wrong)
template <class Domain>
void write_frame_field(const std::string& path, const Domain& domain,
                       const std::vector<std::array<double, Domain::dimension>>& u,
                       const std::vector<std::array<double, Domain::dimension>>& v, const std::vector<int>& valence);

/// Writes a map as OBJ with one texture coordinate per corner. `corner_uv` has, per halfedge of `domain.mesh`, the map
/// coordinates of the corner at its target.
/// \tparam Domain `Planar_domain` or `Surface_domain`
/// \throws Output_error, Invalid_argument_error (the extension is not .obj)
template <class Domain>
void write_corner_map(const std::string& path, const Domain& domain,
                      const std::vector<Planar_domain::Point_2>& corner_uv);

} // namespace Quadrille

#include <Quadrille/Mesh_io/internal/write_domain_impl.h>
#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/write_mesh_impl.h>
#endif

#endif
