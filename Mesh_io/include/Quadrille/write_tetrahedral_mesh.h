// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_WRITE_TETRAHEDRAL_MESH_H
#define QUADRILLE_WRITE_TETRAHEDRAL_MESH_H

#include <Quadrille/Tetrahedral_mesh.h>
#include <Quadrille/exceptions.h>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace Quadrille {

/// Writes a tetrahedral mesh with its feature edges; the kind of file is told by its extension:
///
/// | file | is | feature edges are |
/// | --- | --- | --- |
/// | `.mesh` | MEDIT, text | Edges |
/// | `.vtk` | legacy VTK 2.0, text, which most programs read | lines, before the tetrahedra |
/// | `.msh` | Gmsh 4.1, text | elements of dimension 1 |
/// | `.vtu` | VTK XML, binary | lines, before the tetrahedra |
///
/// Numbers are written so that reading gives the same doubles. The file appears completely, or not at all.
/// \throws Output_error naming the file if it cannot be written.
/// \throws Invalid_argument_error for other extensions.
void write_tetrahedral_mesh(const std::string& path, const Tetrahedral_mesh& mesh);

/// Writes one frame per tetrahedron, whose three vectors are the columns, as text for other programs that make
/// hexahedra, which take the mesh from a file of its own:
///
/// * `.fra`: CubeCover and Mint3D. "FRA 1", then the number of frames, 3 and 1, then a line per vector.
/// * `.ff3`: MetricDrivenFrame3D and Mint3D. "9" and the number of frames, then a line with the three vectors per
/// frame.
///
/// \pre there are as many frames as the mesh has tetrahedra, in their order.
/// \throws Output_error naming the file if it cannot be written.
/// \throws Invalid_argument_error for other extensions, or another number of frames.
void write_frames(const std::string& path, const Tetrahedral_mesh& mesh, const std::vector<Eigen::Matrix3d>& frames);

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/write_tetrahedral_mesh_impl.h>
#endif

#endif
