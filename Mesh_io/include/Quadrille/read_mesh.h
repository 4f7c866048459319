// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_READ_MESH_H
#define QUADRILLE_READ_MESH_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/exceptions.h>

#include <string>

namespace Quadrille {

/// Reads the polygons, lines and labels of a mesh file, `.msh .vtk .obj .off .ply .stl .mesh`, as they are: nothing is
/// checked but the file itself. `isolate` and `time_limit_seconds` as in `Planar_domain_options`.
///
/// \throws Invalid_input_error naming the file, the place in it and the reason.
Labelled_mesh read_mesh(const std::string& path, bool isolate = true, double time_limit_seconds = 120);

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/read_mesh_impl.h>
#endif

#endif
