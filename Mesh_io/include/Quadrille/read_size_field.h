// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_READ_SIZE_FIELD_H
#define QUADRILLE_READ_SIZE_FIELD_H

#include <Quadrille/Planar_domain.h>

#include <string>
#include <vector>

namespace Quadrille {

/// Reads the element sizes that are wanted inside a domain: one per vertex of `domain.mesh`, in the domain's unit, 0
/// where the file says nothing.
///
/// * `.pos`, `.msh`: Gmsh post-processing views with one scalar per node (what Gmsh takes as a background field),
///   interpolated at the vertices. The last view of the file counts, and its last time step.
/// * `.txt`, `.csv`: a line `x y size [radius]` per place, separated by spaces or commas; `#` starts a comment. The
/// size
///   is wanted within the radius (default: twice the size); where several places overlap, at each vertex that of the
///   nearest one. A place whose circle has no vertex in it counts for the vertex nearest to it.
///
/// Complexity: O((n + m) log m) for n vertices and m elements or places.
/// \throws Invalid_input_error naming the file, the place in it and the reason, if it cannot be read, has no such data,
/// sizes that are not positive and finite, or nothing inside the domain.
/// \throws Invalid_argument_error for other file names.
std::vector<double> read_size_field(const std::string& path, const Planar_domain& domain,
                                    double time_limit_seconds = 120);

} // namespace Quadrille

#include <Quadrille/Mesh_io/internal/read_size_field.h>

#endif
