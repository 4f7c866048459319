// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SURFACE_DOMAIN_H
#define QUADRILLE_SURFACE_DOMAIN_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Triangulated_domain.h>
#include <Quadrille/exceptions.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <string>

namespace Quadrille {

/// A triangulated surface in space with its curves, regions and their names: what a run on a surface starts from.
///
/// It may have a border or be closed, have any genus and several components. Its curves are the features that elements
/// have to follow, and all of its border. Made by `read_surface_domain()` or `make_surface_domain()`, which check all
/// that.
struct Surface_domain : Triangulated_domain<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> {
  using Point_3 = Kernel::Point_3;
  using Vector_3 = Kernel::Vector_3;
};

/// Options of `make_surface_domain()` and `read_surface_domain()`.
struct Surface_domain_options {
  /// Largest edge of the triangulation of a geometry file, in the file's units; 0: chosen from the area (about 10,000
  /// triangles, before local refinement). Ignored for mesh files, whose triangles are taken as they are.
  double triangle_size = 0;
  /// Make triangles of geometry files smaller where curvature and short curves need it.
  bool refine_locally = true;
  double edges_per_circle = 24; ///< of curvature-based refinement
  double edges_per_curve = 3;   ///< at least, also on short curves
  double size_gradation = 0.2;  ///< growth of the triangle size per unit of distance from curves
  /// Local refinement is reduced until there are no more triangles than this (or three times what `triangle_size` alone
  /// needs).
  int max_triangles = 40000;
  /// In mesh files that mark no features inside, edges whose two triangles deviate by more than this many degrees from
  /// a plane are features; 180: none.
  double crease_angle = 40;
  /// But connected ones with a loose end and fewer edges than this are taken for noise. The creases of technical parts
  /// hardly ever end, and those that noise makes are short.
  int min_crease_edges = 10;
  /// Repair mesh files first, see `repair_mesh()`; a note tells what was changed.
  bool repair = false;
  /// Edges inside that join two vertices of curves get a vertex in their middle, and triangles between three curve
  /// edges one at their centre: frame fields need free vertices there. Edges that cut off a corner sharper than 50
  /// degrees stay.
  bool split_chords = true;
  /// Two feature edges that deviate by more than this many degrees from a straight line meet in a corner.
  double corner_degrees = 40;
  /// Let the geometry library work in a child process (where the system has them), so that its crashes, endless loops
  /// and global state stay out of this process.
  bool isolate_geometry_kernel = true;
  double time_limit_seconds = 300; ///< for the child process
};

/// Checks `input` and turns it into a surface; `source` names it in messages.
///
/// * Polygons with more than three corners are divided into triangles, points that no polygon uses are left out; both
///   are noted, and so are vertices added between curves (`split_chords`). Nothing else is changed unless
///   `Surface_domain_options::repair` is set: points with equal coordinates stay apart (noted), and so does the
///   orientation. Closed components whose normals point inwards are
///   noted only, since cavities have such walls; no frame field depends on it.
/// * The lines of the input, edges between two regions and the border are curves. If none of these are inside the
///   surface, edges sharper than `Surface_domain_options::crease_angle` are, too; a note says which were used. Those
///   without a label are grouped into curves that end at corners and where curves meet.
/// * Slivers are tolerated as long as doubles can bear them: the smallest altitude of a triangle has to be at least
///   1e-10 times its longest edge.
/// * Surfaces that intersect or touch themselves are not recognised: frame fields do not mind.
///
/// Complexity: O(n log n).
/// \throws Invalid_input_error naming `source`, the element and the reason, if `input` is empty or not finite, has a
/// polygon that is degenerate or cannot be divided, a triangle twice, an edge with more than two triangles or a vertex
/// with several fans, is not oriented consistently or cannot be, has cracks (border edges at the same place, see
/// `repair_mesh()`), or has lines that are not edges.
/// \throws Invalid_argument_error if an option is out of range.
Surface_domain make_surface_domain(const Labelled_mesh& input, const std::string& source,
                                   const Surface_domain_options& options = {});

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/make_surface_domain.h>
#endif

#endif
