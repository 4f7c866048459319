// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_CHECK_TETRAHEDRAL_MESH_H
#define QUADRILLE_CHECK_TETRAHEDRAL_MESH_H

#include <Quadrille/exceptions.h>

#include <Quadrille/Volumetric_cross_field/internal/Tetrahedral_mesh_checker.h>

namespace Quadrille {

/// Whether `mesh`, a model of `TetrahedralMesh`, is fit for a field: there are tetrahedra; their corners exist, differ,
/// are finite, and are in positive orientation (by exact predicates) with a volume above 1e-12 times the cube of the
/// longest edge; every vertex is used; faces are shared by at most two tetrahedra, on different sides; and the boundary
/// is a manifold. Several components and cavities are fine. Time is linear in the size.
///
/// \throws Invalid_input_error naming the first tetrahedron, vertex or edge that is not, with its place and the reason.
template <class TetrahedralMesh> void check_tetrahedral_mesh(const TetrahedralMesh& mesh)
{
  internal::Tetrahedral_mesh_checker<TetrahedralMesh>(mesh).check();
}

} // namespace Quadrille

#endif
