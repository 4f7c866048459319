// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_READ_TETRAHEDRAL_MESH_H
#define QUADRILLE_READ_TETRAHEDRAL_MESH_H

#include <Quadrille/Tetrahedral_mesh.h>
#include <Quadrille/exceptions.h>

#include <string>

namespace Quadrille {

/// Reads a tetrahedral mesh; the kind of file is told by its extension. What the file marks as lying on curves becomes
/// `Tetrahedral_mesh::feature_edges`:
///
/// | file | is | feature edges are |
/// | --- | --- | --- |
/// | `.msh` | Gmsh, versions 2 to 4.1, text and binary | elements of dimension 1 |
/// | `.mesh` | MEDIT, text | Edges |
/// | `.vtk` | legacy VTK, versions 1 to 5, text and binary | lines |
/// | `.node`, `.ele` | TetGen; either name, the other file is found beside it | edges of an `.edge` file beside them
/// that have a marker other than 0, as TetGen gives to those on segments | | `.ovm` | OpenVolumeMesh, text | edges with
/// the property `AlgoHex::FeatureEdges` |
///
/// Every tetrahedron is turned so that it is positively oriented (decided exactly), whatever order of corners the file
/// has; degenerate ones stay as they are. Feature edges that are no edges of tetrahedra are left out: files also mark
/// curves that bound no volume. Polygons are ignored. Of elements of second order the corners are taken.
///
/// Vertices that no tetrahedron has are kept, except nodes in the middle of edges, and in `.msh` files, which hold the
/// nodes of all entities of a model. The others keep their order.
///
/// Nothing else is repaired or checked: tetrahedra may be degenerate, overlap, or share a triangle with more than one
/// other.
///
/// \param isolate whether Gmsh, which reads `.msh`, runs in a child process, for at most `time_limit_seconds`
///
/// Complexity: O(n), and O(n log n) for `.msh`.
/// \throws Invalid_input_error naming the file, the place in it and the reason: not readable, truncated or damaged,
/// unknown format, coordinates that are not finite, vertices that do not exist, other cells of dimension 3 than
/// tetrahedra, no tetrahedra at all.
Tetrahedral_mesh read_tetrahedral_mesh(const std::string& path, bool isolate = true, double time_limit_seconds = 600);

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/read_tetrahedral_mesh_impl.h>
#endif

#endif
