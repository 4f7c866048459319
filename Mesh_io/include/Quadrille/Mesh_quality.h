// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_QUALITY_H
#define QUADRILLE_MESH_QUALITY_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Planar_domain.h>
#include <Quadrille/Size_specification.h>
#include <Quadrille/Surface_domain.h>

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace Quadrille {

/// Whether polygons form a valid quad mesh of a region in a plane z = constant, or else of a surface in space. Decided
/// exactly, on the coordinates as they are.
struct Mesh_validity {
  std::size_t non_quads = 0;
  std::size_t degenerate_quads = 0; ///< that use a vertex twice
  /// With an angle of 180 degrees or more, or 0 or less; in space as seen along the normal (p2 - p0) x (p3 - p1) of the
  /// quad.
  std::size_t inverted_corners = 0;
  std::size_t non_manifold_edges = 0;    ///< in more than two quads, or in two that are oriented differently
  std::size_t non_manifold_vertices = 0; ///< where several fans of quads meet
  std::size_t duplicate_vertices = 0;    ///< with the coordinates of another one that they should be one with
  std::size_t overlapping_borders = 0;   ///< 1 if a planar border meets itself: hanging vertices, overlaps
  std::size_t isolated_vertices = 0;     ///< in no quad; allowed
  int boundary_loops = 0;
  int components = 0;
  int euler_characteristic = 0;
  bool clockwise = false;            ///< all quads are, which is allowed; false for surfaces
  std::vector<std::string> problems; ///< one sentence per kind, naming the first element; empty for a valid mesh

  bool is_valid() const { return problems.empty(); }
};

/// A mesh whose z varies by more than rounding is one of a surface. Whether a surface meets itself where it is not
/// connected is not examined, except that no two vertices of one part, or of two borders, may have the same
/// coordinates: the parts of an assembly may touch. Complexity: O(n log n).
Mesh_validity check_quad_mesh(const Labelled_mesh& mesh);

/// How good the quads of a mesh are.
///
/// Angles of quads in space are those between edges, and above 180 degrees where the corner is inverted as seen along
/// the normal of its quad.
struct Mesh_quality {
  /// Of a quad: the smallest sine of its corner angles, negative for angles above 180; in space times the cosine
  /// between the normals of the corner and of the quad, so that it says how far the quad is from planar, too.
  double scaled_jacobian_min = 0;
  double scaled_jacobian_mean = 0; ///< over the quads
  double skew_mean = 0;            ///< of a quad: largest |corner angle - 90|, in degrees
  double skew_max = 0;
  std::map<int, int> irregular;          ///< valence -> number of interior vertices with other than 4 edges
  std::map<int, int> irregular_boundary; ///< number of quads -> number of boundary vertices with other than 2 quads
};

/// \pre all polygons are quads. Other polygons are skipped. Complexity: O(n log n).
Mesh_quality measure_quality(const Labelled_mesh& mesh);

/// The edges that are in one polygon only, in its direction, sorted.
std::vector<std::array<int, 2>> border_edges(const Labelled_mesh& mesh);

/// Deviations from a prescription, as |log(actual / prescribed)|.
struct Log_deviation {
  double mean = 0;
  double squared_mean = 0; ///< of their squares
  double max = 0;
  std::size_t n = 0;
};

/// How much the quads of a mesh differ from squares of one size (Couplet et al., Surface Quadrilateral Meshing from
/// Integrable Odeco Fields, sections 5.1 and 5.3), and how long their edges are.
struct Mesh_distortion {
  Log_deviation area;   ///< of quads, each split along a diagonal, against their mean area
  Log_deviation aspect; ///< longer over shorter dimension, each the mean of two opposite sides
  double edge_length_percentile_1 = 0;
  double edge_length_median = 0;
  double edge_length_percentile_99 = 0;
};

/// Polygons other than quads, and quads without a finite area, are skipped. Complexity: O(n log n).
Mesh_distortion measure_distortion(const Labelled_mesh& mesh);

/// How far a mesh is from the sizes that its domain's curves prescribe.
struct Size_error {
  Log_deviation length; ///< of the edges on curves with a prescribed size along them
  /// Of the quads with an edge on a curve that prescribes both sizes: mean length of their two sides that leave that
  /// edge, over its own length.
  Log_deviation aspect;
};

/// Compares `mesh.lines` (or, when it has none, its border edges) and the quads beside them with the sizes at the
/// points of the domain's curves that are nearest to their middles. Complexity: O(n log n).
/// \pre the mesh's coordinates are finite.
Size_error measure_size_error(const Labelled_mesh& mesh, const Planar_domain& domain, const Domain_sizes& sizes);
Size_error measure_size_error(const Labelled_mesh& mesh, const Surface_domain& domain, const Domain_sizes& sizes);

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/Mesh_quality_impl.h>
#endif

#endif
