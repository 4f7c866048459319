// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_VERTEX_RESTRICTIONS_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_VERTEX_RESTRICTIONS_H

#include <Quadrille/Odeco_frame_field/internal/Field_elements.h>

#include <array>
#include <cmath>
#include <complex>
#include <vector>

namespace Quadrille {
namespace internal {

/// A constrained edge: frames align with it, and have the given sizes at the halfedge's source and target (0: free).
struct Constrained_halfedge {
  int halfedge;
  bool aligned;
  std::array<double, 2> size;
};

/// What the constrained edges around one vertex ask for together.
struct Vertex_constraint {
  std::complex<double> alignment; ///< sum of exp(4 i t) over the aligned edges' angles t
  int n_aligned = 0;
  double log_size = 0; ///< sum over the edges that prescribe a size
  int n_sizes = 0;
  bool is_constrained() const { return n_aligned + n_sizes > 0; }
  double size() const { return std::exp(log_size / n_sizes); }

  /// Edges that meet at an angle off by more than 30 degrees from a multiple of 90 have no common frame: bisecting them
  /// would turn the frame by more than 30 degrees against both, and which way is a guess. Such corners are left free.
  bool has_direction() const { return n_aligned > 0 && std::abs(alignment) >= 0.5 * n_aligned; }
  bool is_free_corner() const { return n_aligned > 0 && !has_direction(); }
};

inline std::vector<Vertex_constraint> collect_vertex_constraints(const Indexed_triangulation& mesh,
                                                                 const std::vector<Eigen::Vector2d>& points,
                                                                 const std::vector<Constrained_halfedge>& edges)
{
  std::vector<Vertex_constraint> constraints(points.size());
  for (const Constrained_halfedge& edge : edges) {
    const int ends[2] = {mesh.source(edge.halfedge), mesh.target(edge.halfedge)};
    const Eigen::Vector2d d = (points[std::size_t(ends[1])] - points[std::size_t(ends[0])]).normalized();
    const std::complex<double> square = std::complex<double>(d.x(), d.y()) * std::complex<double>(d.x(), d.y());
    for (std::size_t i = 0; i < 2; ++i) {
      Vertex_constraint& constraint = constraints[std::size_t(ends[i])];
      if (edge.aligned) {
        constraint.alignment += square * square;
        ++constraint.n_aligned;
      }
      if (edge.size[i] > 0) {
        constraint.log_size += std::log(edge.size[i]);
        ++constraint.n_sizes;
      }
    }
  }
  return constraints;
}

/// The restriction of an isotropic field's coefficients (q0, q3, q4) to a vertex's constraint.
inline Vertex_restriction<3> isotropic_restriction(const Vertex_constraint& constraint)
{
  Vertex_restriction<3> restriction;
  if (!constraint.is_constrained() || constraint.is_free_corner())
    return restriction;
  restriction.is_free = false;
  restriction.basis.setZero();
  // The bisector of all aligned edges, as a unit frame.
  Orthogonal_frame_2 frame;
  const bool directed = constraint.has_direction();
  if (directed) {
    const double angle = std::arg(constraint.alignment) / 4;
    frame.direction = {std::cos(angle), std::sin(angle)};
  }
  const Eigen::Vector3d unit = Tensor_coefficients<3>::from_harmonics(odeco_harmonics(frame));
  if (directed && constraint.n_sizes > 0) {
    restriction.dimension = 0;
    restriction.offset = constraint.size() * unit;
  } else if (directed) {
    restriction.dimension = 1;
    restriction.basis.col(0) = unit;
  } else {
    restriction.dimension = 2;
    restriction.offset[0] = constraint.size() * unit[0];
    restriction.basis(1, 0) = restriction.basis(2, 1) = 1;
  }
  return restriction;
}

} // namespace internal
} // namespace Quadrille

#endif
