// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_READ_PLANAR_DOMAIN_H
#define QUADRILLE_READ_PLANAR_DOMAIN_H

#include <Quadrille/Planar_domain.h>
#include <Quadrille/exceptions.h>

#include <string>

namespace Quadrille {

/// Reads a planar domain; the kind of file is told by its extension.
///
/// * Geometry, `.geo .step .stp .brep .iges .igs`: loaded by Gmsh and triangulated, with triangles as small as
///   curvature, short sides and narrow gaps need (see `Planar_domain_options`). As in Gmsh, when there are physical
///   surfaces, only they belong to the domain. The triangulation is the same on every run; mesh-size settings in the
///   file do not influence it, except that small sizes at points make it finer there, at most by two. Those sizes are
///   kept in `Planar_domain::point_size`.
/// * Triangle meshes, `.msh .obj .off .vtk .ply .stl .mesh`: taken as they are, but for chords
///   (`Planar_domain_options::split_chords`). `.msh` brings curves, regions and physical groups along; line elements
///   of `.msh`, `.vtk`, `.obj` and `.mesh` mark feature edges.
///
/// A `.geo` file is a program, which can also write files and start commands: read only those that you trust.
///
/// \throws Invalid_input_error naming the file, the element and the reason, when the file cannot be read, or is no
/// planar domain (see `make_planar_domain()`), or its outline is open or intersects itself.
/// \throws Invalid_argument_error if an option is out of range.
Planar_domain read_planar_domain(const std::string& path, const Planar_domain_options& options = {});

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/read_planar_domain.h>
#endif

#endif
