// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_PLANAR_DOMAIN_H
#define QUADRILLE_PLANAR_DOMAIN_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Triangulated_domain.h>
#include <Quadrille/exceptions.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace Quadrille {

/// A triangulated region of the plane with its curves, regions and their names: what a planar run starts from.
///
/// Its triangles are also connected and positively oriented (exact predicate). Made by `read_planar_domain()` or
/// `make_planar_domain()`, which check all that.
struct Planar_domain : Triangulated_domain<CGAL::Exact_predicates_inexact_constructions_kernel::Point_2> {
  using Point_2 = Kernel::Point_2;

  /// Per edge, the unit tangents of its curve at source and target of `halfedge(edge)` (x, y, x, y); zero where they
  /// are not known. Empty for meshes taken as they are.
  std::vector<std::array<double, 4>> edge_tangents;

  double z = 0;                   ///< of the plane that it lies in
  int number_of_split_chords = 0; ///< see `Planar_domain_options::split_chords`
};

/// Options of `make_planar_domain()` and `read_planar_domain()`.
struct Planar_domain_options {
  /// Largest edge of the triangulation of a geometry file, in the file's units; 0: chosen from the area (about 2,200
  /// triangles for a simple shape, before local refinement). Ignored for mesh files, whose triangles are taken as they
  /// are.
  double triangle_size = 0;
  /// Largest edge along the curves of a physical group, or along the curve with a tag; names that do not exist are
  /// ignored. Frames that are thin across a curve need it to be about as small as they are.
  std::map<std::string, double> curve_triangle_size;
  /// Refine where curvature, short curves and narrow gaps need it.
  bool refine_locally = true;
  double edges_per_circle = 24;   ///< of curvature-based refinement
  double edges_per_outline = 36;  ///< around each connected set of curves, such as a hole
  double triangles_per_gap = 3.5; ///< across the narrowest place between two curves
  double size_gradation = 0.15;   ///< growth of the triangle size per unit of distance
  /// Local refinement stops at about this number of triangles (or three times what `triangle_size` alone needs).
  int max_triangles = 30000;
  /// Two border edges that deviate by more than this many degrees from a straight line meet in a corner.
  double corner_degrees = 40;
  /// Repair mesh files first, see `repair_mesh()`; a note tells what was changed.
  bool repair = false;
  /// Split inner edges that join two vertices of curves, except across sharp corners: no map that is aligned with the
  /// curves has room for a triangle with all corners on one side. New vertices come after those of the input.
  bool split_chords = true;
  /// Let the geometry library work in a child process (where the system has them), so that its crashes, endless loops
  /// and global state stay out of this process.
  bool isolate_geometry_kernel = true;
  double time_limit_seconds = 120; ///< for the child process
};

/// Checks `input` and turns it into a planar domain; `source` names it in messages.
///
/// Border edges without a label are grouped into curves that end at corners. Complexity: O(n log n).
/// \throws Invalid_input_error naming `source`, the element and the reason, if `input` is empty, not planar, not made
/// of triangles, not finite, not manifold, not connected, self-intersecting, or has degenerate or inverted triangles.
Planar_domain make_planar_domain(const Labelled_mesh& input, const std::string& source,
                                 const Planar_domain_options& options = {});

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/make_planar_domain.h>
#endif

#endif
