// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_VERTEX_RESTRICTIONS_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_VERTEX_RESTRICTIONS_H

#include <Quadrille/Frame_size.h>
#include <Quadrille/Odeco_frame_field/internal/Restricted_unknowns.h>
#include <Quadrille/Odeco_frame_field/internal/Tensor_coefficients.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

namespace Quadrille {
namespace internal {

/// A constrained edge: frames align with it, and have the given sizes at the halfedge's source and target.
struct Constrained_halfedge {
  int halfedge;
  bool aligned;
  std::array<Frame_size, 2> size;
  bool is_weak = false; ///< only on surfaces
};

/// What the constrained edges around one vertex ask for together.
struct Vertex_constraint {
  /// The prescribed sizes of one vector of the frame.
  struct Vector_size {
    double log_sum = 0, least = 0, greatest = 0;
    int n = 0;

    void add(double size)
    {
      const double log_size = std::log(size);
      least = n == 0 ? log_size : std::min(least, log_size);
      greatest = n == 0 ? log_size : std::max(greatest, log_size);
      log_sum += log_size;
      ++n;
    }
    void add(const Vector_size& other)
    {
      if (other.n == 0)
        return;
      least = n == 0 ? other.least : std::min(least, other.least);
      greatest = n == 0 ? other.greatest : std::max(greatest, other.greatest);
      log_sum += other.log_sum;
      n += other.n;
    }
    bool is_given() const { return n > 0; }
    /// Sizes that jump within one triangle would cost more than they can tell.
    bool is_consistent() const { return n > 0 && greatest - least <= std::log(1.5); }
    double value() const { return std::exp(log_sum / n); }
  };

  std::complex<double> alignment; ///< sum of exp(4 i t) over the aligned edges' angles t
  int n_aligned = 0;
  std::array<Vector_size, 2> size; ///< of the vectors along `angle()` and 90 degrees further

  bool has_size() const { return size[0].is_given() || size[1].is_given(); }
  bool is_constrained() const { return n_aligned > 0 || has_size(); }
  /// Geometric mean of all prescribed sizes. \pre `has_size()`
  double mean_size() const { return std::exp((size[0].log_sum + size[1].log_sum) / (size[0].n + size[1].n)); }

  /// Edges that meet at an angle off by more than 30 degrees from a multiple of 90 have no common frame: bisecting them
  /// would turn the frame by more than 30 degrees against both, and which way is a guess. Such corners are left free.
  bool has_direction() const { return n_aligned > 0 && std::abs(alignment) >= 0.5 * n_aligned; }
  bool is_free_corner() const { return n_aligned > 0 && !has_direction(); }
  /// Of the bisector of all aligned edges, modulo 90 degrees. \pre `has_direction()`
  double angle() const { return std::arg(alignment) / 4; }
};

inline std::vector<Vertex_constraint> collect_vertex_constraints(const Indexed_triangulation& mesh,
                                                                 const std::vector<Eigen::Vector2d>& points,
                                                                 const std::vector<Constrained_halfedge>& edges)
{
  std::vector<Vertex_constraint> constraints(points.size());
  const auto squared_direction = [&](int halfedge) {
    const Eigen::Vector2d d =
        (points[std::size_t(mesh.target(halfedge))] - points[std::size_t(mesh.source(halfedge))]).normalized();
    return std::complex<double>(d.x(), d.y()) * std::complex<double>(d.x(), d.y());
  };
  for (const Constrained_halfedge& edge : edges) {
    if (!edge.aligned)
      continue;
    const std::complex<double> square = squared_direction(edge.halfedge);
    for (const int v : {mesh.source(edge.halfedge), mesh.target(edge.halfedge)}) {
      constraints[std::size_t(v)].alignment += square * square;
      ++constraints[std::size_t(v)].n_aligned;
    }
  }
  for (const Constrained_halfedge& edge : edges) {
    const int ends[2] = {mesh.source(edge.halfedge), mesh.target(edge.halfedge)};
    for (std::size_t i = 0; i < 2; ++i) {
      Vertex_constraint& constraint = constraints[std::size_t(ends[i])];
      // The edge is nearer to the frame's first vector or to its second one.
      std::size_t along = 0;
      if (edge.aligned && constraint.has_direction())
        along = std::real(squared_direction(edge.halfedge) * std::polar(1.0, -2 * constraint.angle())) > 0 ? 0 : 1;
      if (edge.size[i].tangential > 0)
        constraint.size[along].add(edge.size[i].tangential);
      if (edge.size[i].normal > 0)
        constraint.size[1 - along].add(edge.size[i].normal);
    }
  }
  return constraints;
}

/// The unit frame along a vertex's direction, or along the axes where it has none.
inline Orthogonal_frame_2 constrained_unit_frame(const Vertex_constraint& constraint)
{
  Orthogonal_frame_2 frame;
  if (constraint.has_direction())
    frame.direction = {std::cos(constraint.angle()), std::sin(constraint.angle())};
  return frame;
}

/// Only (q3, q4) are unknown: a size without a direction, which is isotropic.
template <int N> Vertex_restriction<N> undirected_restriction(double size)
{
  Vertex_restriction<N> restriction;
  restriction.is_free = false;
  restriction.basis.setZero();
  restriction.dimension = 2;
  restriction.offset[0] = size * Tensor_coefficients<N>::from_harmonics(odeco_harmonics({}))[0];
  restriction.basis(Tensor_coefficients<N>::band4, 0) = restriction.basis(Tensor_coefficients<N>::band4 + 1, 1) = 1;
  return restriction;
}

/// How a vertex's constraint eliminates unknowns of an isotropic field.
inline void restrict_vertex(const Vertex_constraint& constraint, Vertex_restriction<3>& restriction)
{
  if (!constraint.is_constrained() || constraint.is_free_corner())
    return;
  if (!constraint.has_direction()) {
    restriction = undirected_restriction<3>(constraint.mean_size());
    return;
  }
  restriction.is_free = false;
  restriction.basis.setZero();
  const Eigen::Vector3d unit =
      Tensor_coefficients<3>::from_harmonics(odeco_harmonics(constrained_unit_frame(constraint)));
  restriction.dimension = constraint.has_size() ? 0 : 1;
  if (constraint.has_size())
    restriction.offset = constraint.mean_size() * unit;
  else
    restriction.basis.col(0) = unit;
}

/// How a vertex's constraint eliminates unknowns of an anisotropic field: with a fixed direction the tensor is linear
/// in the frame's two sizes, each of which is given or unknown.
inline void restrict_vertex(const Vertex_constraint& constraint, Vertex_restriction<5>& restriction)
{
  if (!constraint.is_constrained() || constraint.is_free_corner())
    return;
  if (!constraint.has_direction()) {
    restriction = undirected_restriction<5>(constraint.mean_size());
    return;
  }
  restriction.is_free = false;
  restriction.basis.setZero();
  restriction.dimension = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    Orthogonal_frame_2 frame = constrained_unit_frame(constraint);
    (k == 0 ? frame.size_v : frame.size_u) = 0;
    const Circular_harmonics power = odeco_harmonics(frame); // of the k-th unit vector alone
    if (constraint.size[k].is_consistent())
      restriction.offset += constraint.size[k].value() * power;
    else
      restriction.basis.col(restriction.dimension++) = power;
  }
}

} // namespace internal
} // namespace Quadrille

#endif
