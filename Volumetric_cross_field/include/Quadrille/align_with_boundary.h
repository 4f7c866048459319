// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ALIGN_WITH_BOUNDARY_H
#define QUADRILLE_ALIGN_WITH_BOUNDARY_H

#include <Quadrille/Metric_field.h>
#include <Quadrille/Volumetric_cross_field/internal/Boundary_aligner.h>
#include <Quadrille/cross_alignment.h>

#include <array>
#include <cstddef>
#include <vector>

namespace Quadrille {

/// Which edges of a boundary are creases.
struct Crease_options {
  /// In degrees: an edge is a crease where the normals of its two faces differ by more.
  double crease_angle = 40;
  /// The same for marked edges, such as curves of a CAD model: many of these are no creases but seams of cylinders and
  /// spheres, or curves where one smooth surface goes on in another. 0: every marked edge on the boundary is a crease.
  double marked_crease_angle = 10;
};

/// What the crosses at the vertices of a mesh have to follow.
struct Vertex_alignments {
  static constexpr int is_free = -1;
  std::vector<int> alignment_of; ///< per vertex: index into `alignments`, or `is_free`
  std::vector<Cross_alignment> alignments;
  std::size_t crease_vertices = 0, corner_vertices = 0; ///< counts
};

/// Aligns the crosses of the boundary's vertices: with the normal on smooth parts; on creases with the tangent, and
/// with both normals as well as one cross can (the cross in the plane normal to the tangent whose fourfold angle is the
/// mean of theirs; where the two contradict each other, about 45 degrees apart, that angle stays free). Corners (where
/// creases meet, end in an angle, or bend by more than 45 degrees) and vertices with normals all around stay free.
///
/// `marked_edges` are pairs of vertices, in any order; those inside the volume are ignored. Under a `metric` everything
/// is said in its orthonormal coordinates: normals are taken to A^-1 n, tangents to A t; angles of creases are those of
/// the mesh. \pre `mesh` passes `check_tetrahedral_mesh()`. Time is linear in the size.
template <class TetrahedralMesh>
Vertex_alignments align_with_boundary(const TetrahedralMesh& mesh, const Crease_options& options = {},
                                      const std::vector<std::array<int, 2>>& marked_edges = {},
                                      const Metric_field* metric = nullptr)
{
  Vertex_alignments result;
  internal::Boundary_aligner<TetrahedralMesh> aligner(mesh, options.crease_angle, options.marked_crease_angle,
                                                      marked_edges, metric);
  aligner.align(result.alignment_of, result.alignments);
  result.crease_vertices = aligner.number_of_crease_vertices();
  result.corner_vertices = aligner.number_of_corner_vertices();
  return result;
}

} // namespace Quadrille

#endif
