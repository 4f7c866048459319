// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_REFINE_PLANAR_DOMAIN_H
#define QUADRILLE_REFINE_PLANAR_DOMAIN_H

#include <Quadrille/Planar_domain.h>
#include <Quadrille/exceptions.h>

#include <array>
#include <vector>

namespace Quadrille {

/// A domain with finer triangles, and where its new vertices came from.
struct Refined_planar_domain {
  Planar_domain domain;
  /// Per vertex beyond those of the given domain, in their order: the ends of the edge whose midpoint it is. Both come
  /// before it, so that data at vertices can be interpolated in one pass.
  std::vector<std::array<Planar_domain::vertex_descriptor, 2>> parents;
};

/// Triangulates parts of a domain more finely: triangles are bisected, longest edges first, until none is larger than
/// wanted, and inner edges are flipped where that makes the new triangles Delaunay.
///
/// Curves are not split: their vertices and edges, and all vertices of `domain`, keep their descriptors. Triangles with
/// three edges on curves stay as they are, and no new edge joins two vertices of curves.
///
/// \param largest_area per face of `domain`: parts of it are bisected while they are larger
/// \pre one value per face.
/// \throws Invalid_argument_error if the number of values is not that of faces, or a value is not positive.
/// Complexity: O(n log n) for n triangles of the result. Source: Rivara 1997 (longest-edge propagation paths).
Refined_planar_domain refine_planar_domain(const Planar_domain& domain, const std::vector<double>& largest_area);

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/refine_planar_domain_impl.h>
#endif

#endif
