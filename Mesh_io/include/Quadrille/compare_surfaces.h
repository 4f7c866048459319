// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_COMPARE_SURFACES_H
#define QUADRILLE_COMPARE_SURFACES_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Surface_domain.h>
#include <Quadrille/exceptions.h>

#include <cstddef>

namespace Quadrille {

/// How well a mesh follows a surface. Lengths are in the units of both, or `_relative` to the diagonal of the surface's
/// bounding box.
struct Surface_comparison {
  double to_surface_max = 0;   ///< largest distance of points of the mesh from the surface
  double from_surface_max = 0; ///< largest distance of points of the surface from the mesh
  double hausdorff = 0;        ///< the larger one of these two
  double hausdorff_relative = 0;

  /// Largest distance of points of the surface's curves from the edges of the mesh that stand for curves; zero if the
  /// surface has no curves, infinite if it has some and the mesh has no such edges.
  double feature_distance_max = 0;
  double feature_distance_max_relative = 0;

  double area_relative = 0; ///< area of the mesh / area of the surface - 1
  /// Whose normals point away from those of the triangles nearest to their centres: of the same surface, where the mesh
  /// has its tag, and else of all.
  std::size_t flipped_quads = 0;
};

/// Compares a quad mesh with the surface that it should be of, at these points: of the mesh, those of a regular grid of
/// 4 x 4 cells on each quad (bilinear; corners, middles of edges and the centre are among them); of the surface,
/// vertices and centres of triangles; of curves, vertices and middles of edges.
///
/// Edges that stand for curves are `mesh.lines`; if there are none, border edges and those where the normals of the
/// quads differ by more than 40 degrees. For distances from the surface, and for areas, a quad is two triangles on both
/// sides of its shorter diagonal. Polygons with other than four corners are taken for fans of triangles; their normals
/// do not count.
///
/// Complexity: O(n log n) in the usual case, n the number of quads and triangles.
/// \throws Invalid_argument_error if the mesh has no polygons, or a vertex of a polygon or line has a coordinate that
/// is not finite.
Surface_comparison compare_with_surface(const Labelled_mesh& mesh, const Surface_domain& domain);

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/compare_surfaces_impl.h>
#endif

#endif
