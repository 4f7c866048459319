// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_READ_SURFACE_DOMAIN_H
#define QUADRILLE_READ_SURFACE_DOMAIN_H

#include <Quadrille/Surface_domain.h>
#include <Quadrille/exceptions.h>

#include <string>

namespace Quadrille {

/// Reads a surface; the kind of file is told by its extension.
///
/// * Geometry, `.geo .step .stp .brep .iges .igs`: triangulated by Gmsh, with triangles as small as curvature and short
///   curves need (see `Surface_domain_options`). As in Gmsh, when there are physical surfaces, only they belong to the
///   surface; otherwise the boundaries of the (physical) volumes do, or all surfaces if there are none. All curves on
///   the border or between two surfaces are features, and those embedded in one; the seams of periodic surfaces are
///   not. Surfaces of a file without volumes (other than `.geo`) are sewn first. Closed components have their normals
///   outwards, cavities of volumes inwards, that is, out of the material. The triangulation is the same on every run;
///   mesh-size settings in the file do not influence it, but sizes at points are kept in `Surface_domain::point_size`.
/// * Meshes, `.msh .obj .off .vtk .ply .stl .mesh`: taken as they are (see `make_surface_domain()`). Line elements of
///   `.msh .vtk .obj .mesh` and edges between the surfaces of `.msh` mark features; so do sharp edges if there are
///   none. `.msh` brings the names of curves, regions and physical groups along.
///
/// A `.geo` file is a program, which can also write files and start commands: read only those that you trust.
///
/// \throws Invalid_input_error naming the file, the element and the reason, when the file cannot be read or
/// triangulated, two of its volumes touch along surfaces, or it is no surface (see `make_surface_domain()`).
/// \throws Invalid_argument_error if an option is out of range.
Surface_domain read_surface_domain(const std::string& path, const Surface_domain_options& options = {});

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/read_surface_domain_impl.h>
#endif

#endif
