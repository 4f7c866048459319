// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_FILL_WITH_TETRAHEDRA_H
#define QUADRILLE_FILL_WITH_TETRAHEDRA_H

#include <Quadrille/Tetrahedral_mesh.h>
#include <Quadrille/exceptions.h>

#include <cstddef>
#include <string>

namespace Quadrille {

/// Options of `fill_with_tetrahedra()`.
struct Filling_options {
  /// Length that edges should have, about, in the unit of the file. 0: in geometry files 1/20 of the diagonal of the
  /// bounding box, and down to 1/8 of that where surfaces are curved; in surfaces, whose triangles are kept then, as
  /// long as the triangles' edges near them, growing inwards up to 1/20 of that diagonal.
  double tetrahedron_size = 0;
  /// It is an error if the tetrahedra of this size would be more, as far as that can be foreseen.
  std::size_t max_tetrahedra = 20'000'000;
  double time_limit_seconds = 1800; ///< for Gmsh and TetGen
  bool isolate = true;              ///< run Gmsh and TetGen in a child process, which may crash
};

/// Fills what a file describes with tetrahedra, all positively oriented.
///
/// * Geometry, `.geo .step .stp .brep .iges .igs`: by Gmsh. Curves between surfaces, and those embedded in them,
///   become feature edges; the seams of closed surfaces do not. As in Gmsh, when there are physical volumes, only they
///   belong to the model. Sizes that the file gives are overruled; meshes by layers, which a script may ask for, have
///   to be of tetrahedra. Surfaces that enclose a volume without being one are sewn.
/// * Closed surfaces, `.off .obj .ply .stl`, and `.msh .vtk .mesh` with polygons: by TetGen, if it is installed.
///   Polygons with more than three corners are triangulated, points with equal coordinates become one, and the order of
///   corners does not matter. Surfaces inside others bound cavities, and those inside cavities bound parts. If
///   `Filling_options::tetrahedron_size` is 0, the surface's triangles are faces of the result; otherwise they are
///   divided, and triangles in one plane are replaced by others (or kept, if TetGen fails at that). The surface's
///   points come first, in their order. Line elements of the file become feature edges.
///
/// A `.geo` file is a program, which can also write files and start commands: use only those that you trust.
///
/// \throws Invalid_input_error naming the file, the place and the reason: it cannot be read; there are no volumes; the
/// surface is not closed (which edge), has degenerate polygons, intersects itself (which polygons); the tetrahedra
/// would be too many; Gmsh or TetGen failed or did not finish in time; there are tetrahedra already; TetGen is needed
/// and this was built without it.
/// \throws Invalid_argument_error if an option is out of range.
Tetrahedral_mesh fill_with_tetrahedra(const std::string& path, const Filling_options& options = {});

/// `read_tetrahedral_mesh()` if the file has tetrahedra, otherwise `fill_with_tetrahedra()`.
Tetrahedral_mesh load_tetrahedral_mesh(const std::string& path, const Filling_options& options = {});

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/fill_with_tetrahedra_impl.h>
#endif

#endif
