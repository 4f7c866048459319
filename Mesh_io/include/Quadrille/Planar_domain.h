// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_PLANAR_DOMAIN_H
#define QUADRILLE_PLANAR_DOMAIN_H

#include <Quadrille/Labelled_mesh.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace Quadrille {

/// A readable property map over a vector that is indexed by a descriptor's `idx()`.
template <class Descriptor, class Value> struct Indexed_property_map {
  using key_type = Descriptor;
  using value_type = Value;
  using reference = Value;
  using category = boost::readable_property_map_tag;

  const std::vector<Value>* values = nullptr;

  friend Value get(const Indexed_property_map& map, const Descriptor& d) { return (*map.values)[std::size_t(d.idx())]; }
};

/// A triangulated region of the plane with its curves, regions and their names: what a planar run starts from.
///
/// The mesh is manifold, connected, positively oriented (exact predicate) and has no removed elements, so descriptors
/// are dense indices. Made by `read_planar_domain()` or `make_planar_domain()`, which check all that.
struct Planar_domain {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point_2 = Kernel::Point_2;
  using Mesh = CGAL::Surface_mesh<Point_2>;
  using vertex_descriptor = Mesh::Vertex_index;
  using halfedge_descriptor = Mesh::Halfedge_index;
  using edge_descriptor = Mesh::Edge_index;
  using face_descriptor = Mesh::Face_index;

  /// A simple path or loop of mesh edges that belongs to one curve of the input.
  struct Curve : Entity_label {
    std::vector<halfedge_descriptor> path; ///< consecutive, from the curve's first to its last point
    vertex_descriptor first, last;         ///< equal when `closed`
    bool closed = false;
    int chain = -1;
  };

  Mesh mesh;
  std::vector<Curve> curves;
  std::vector<Entity_label> regions;
  std::vector<Physical_group> groups;

  std::vector<int> edge_curve;  ///< per edge: index into `curves`, -1 inside the regions; never -1 on the border
  std::vector<int> edge_chain;  ///< per edge: the chain of its curve, -1 inside the regions
  std::vector<int> face_region; ///< per face: index into `regions`
  /// Chains are maximal sequences of curves with the same names that join smoothly (no corner, no third curve):
  /// what a mesher should keep as one feature.
  int number_of_chains = 0;

  /// Per edge, the unit tangents of its curve at source and target of `halfedge(edge)` (x, y, x, y); zero where they
  /// are not known. Empty for meshes taken as they are.
  std::vector<std::array<double, 4>> edge_tangents;
  /// Per vertex, the element size that the input file prescribes there; 0 where it prescribes none.
  std::vector<double> point_size;

  double z = 0;                   ///< of the plane that it lies in
  std::string source;             ///< where it came from, for messages: usually the file name
  double triangle_size = 0;       ///< largest triangle edge that was asked for; 0 for meshes taken as they are
  int number_of_split_chords = 0; ///< see `Planar_domain_options::split_chords`
  std::vector<std::string> notes; ///< choices made while reading that the user should know

  Indexed_property_map<edge_descriptor, int> curve_map() const { return {&edge_curve}; }
  Indexed_property_map<edge_descriptor, int> chain_map() const { return {&edge_chain}; }
  Indexed_property_map<face_descriptor, int> region_map() const { return {&face_region}; }
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

#include <Quadrille/Mesh_io/internal/make_planar_domain.h>

#endif
