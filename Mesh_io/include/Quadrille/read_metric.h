// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_READ_METRIC_H
#define QUADRILLE_READ_METRIC_H

#include <Quadrille/exceptions.h>

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace Quadrille {

/// Reads a metric: a symmetric matrix M per vertex of a mesh, in the order of the vertices; edges d of elements should
/// have d^T M d = 1. The kind of file is told by its extension:
///
/// | file | is | holds per vertex |
/// | --- | --- | --- |
/// | `.sol` | MEDIT, text, with one solution in SolAtVertices | a size, or xx xy yy xz yz zz |
/// | `.txt` | a line per vertex; blank lines and what follows # do not count | a size, or xx xy xz yy yz zz |
/// | `.msh` | Gmsh, text or binary, with node data (the last that it has) | a size, or the nine entries of M |
///
/// A size h stands for the metric I / h^2. In `.msh` files with tetrahedra the data of their nodes are taken, in the
/// order in which `read_tetrahedral_mesh()` gives the vertices; in those without, all of them in the order of their
/// nodes' tags.
///
/// Whether the matrices are positive definite is not checked.
/// \param isolate whether Gmsh, which reads `.msh`, runs in a child process, for at most `time_limit_seconds`
/// \throws Invalid_input_error naming the file, the line or vertex and the reason: not readable, truncated, a number
/// that is not finite, a size that is not positive, a matrix that is not symmetric, not one metric per vertex. \throws
/// Invalid_argument_error for other extensions.
std::vector<Eigen::Matrix3d> read_metric(const std::string& path, std::size_t number_of_vertices, bool isolate = true,
                                         double time_limit_seconds = 600);

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/read_metric_impl.h>
#endif

#endif
