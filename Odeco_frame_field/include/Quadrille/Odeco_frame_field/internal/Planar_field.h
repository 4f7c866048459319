// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_PLANAR_FIELD_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_PLANAR_FIELD_H

#include <Quadrille/Odeco_field_options.h>
#include <Quadrille/Odeco_frame_field/internal/Field_solver.h>
#include <Quadrille/Odeco_frame_field/internal/vertex_restrictions.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

using Gradients = std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>;

/// The similarity that brings a domain to unit size with its first constrained edge along the x-axis.
///
/// The field is computed there, on coordinates rounded to 32 bits, so that moved, turned and scaled copies of a domain
/// start from the same bits: melting amplifies the smallest difference.
class Canonical_position {
public:
  Canonical_position(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& axis, double size_unit)
      : m_size_unit(size_unit), m_axis(axis.normalized())
  {
    Eigen::Vector2d low = points.front(), high = points.front();
    for (const Eigen::Vector2d& p : points) {
      low = low.cwiseMin(to_axes(p));
      high = high.cwiseMax(to_axes(p));
    }
    m_center = 0.5 * (low + high);
    m_diameter = (high - low).norm();
  }

  Eigen::Vector2d point(const Eigen::Vector2d& p) const
  {
    const double resolution = std::ldexp(1.0, 32);
    const Eigen::Vector2d q = (to_axes(p) - m_center) / m_diameter;
    return {std::round(q.x() * resolution) / resolution, std::round(q.y() * resolution) / resolution};
  }
  double size(double s) const
  {
    const double resolution = std::ldexp(1.0, 32);
    return std::round(s / m_size_unit * resolution) / resolution;
  }
  Eigen::Vector2d original_direction(const Eigen::Vector2d& d) const
  {
    return {m_axis.x() * d.x() - m_axis.y() * d.y(), m_axis.y() * d.x() + m_axis.x() * d.y()};
  }
  double original_size(double s) const { return s * m_size_unit; }
  Circular_harmonics original_harmonics(const Circular_harmonics& q) const
  {
    const double angle = std::atan2(m_axis.y(), m_axis.x());
    return m_size_unit * Symmetric_tensor_2::from_harmonics(q).rotated(angle).harmonics();
  }

private:
  Eigen::Vector2d to_axes(const Eigen::Vector2d& p) const
  {
    return {m_axis.dot(p), m_axis.x() * p.y() - m_axis.y() * p.x()};
  }

  double m_size_unit;
  Eigen::Vector2d m_axis, m_center;
  double m_diameter = 1;
};

inline void check_field_arguments(const std::vector<Constrained_halfedge>& edges, const Odeco_field_options& options)
{
  if (edges.empty())
    throw Invalid_input_error("no edge is constrained, so any constant field would do; align the frames with the "
                              "boundary at least");
  for (const Constrained_halfedge& edge : edges)
    for (const double size : edge.size)
      if (!(size >= 0) || !std::isfinite(size))
        throw Invalid_argument_error("an edge has the prescribed size " + std::to_string(size) +
                                     "; sizes must be positive and finite (0 leaves a size free)");
  const Melt_and_freeze_schedule& schedule = options.schedule;
  if (options.starts < 0 || options.threads < 0)
    throw Invalid_argument_error("the numbers of starts and of threads must not be negative");
  if (!(schedule.smooth_epsilon > 0) || !(schedule.final_epsilon > 0) ||
      !(schedule.melt_epsilon >= schedule.final_epsilon) || !(schedule.freeze_ratio > 1) || !(schedule.noise >= 0))
    throw Invalid_argument_error("the melt-and-freeze schedule needs positive epsilons that do not increase, a ratio "
                                 "above 1 and a noise that is not negative");
}

/// The edge length of an equilateral triangle of the face's area, averaged once over the neighbours.
inline std::vector<double> local_triangle_sizes(const Indexed_triangulation& mesh,
                                                const std::vector<Eigen::Vector2d>& points)
{
  const auto n = std::size_t(mesh.number_of_faces());
  std::vector<double> size(n), smoothed(n);
  for (std::size_t f = 0; f < n; ++f) {
    const auto& t = mesh.triangle(int(f));
    const Eigen::Vector2d a = points[std::size_t(t[1])] - points[std::size_t(t[0])];
    const Eigen::Vector2d b = points[std::size_t(t[2])] - points[std::size_t(t[0])];
    const double area = 0.5 * (a.x() * b.y() - a.y() * b.x());
    if (!(area > 0))
      throw Invalid_input_error("triangle " + std::to_string(f) +
                                " has no area or is clockwise; the mesh must be counterclockwise and not degenerate");
    size[f] = std::sqrt(4 / std::sqrt(3.0) * area);
  }
  for (std::size_t f = 0; f < n; ++f) {
    double sum = size[f];
    int count = 1;
    for (int i = 0; i < 3; ++i)
      if (const int g = mesh.opposite(int(3 * f) + i); g >= 0) {
        sum += size[std::size_t(g / 3)];
        ++count;
      }
    smoothed[f] = sum / count;
  }
  return smoothed;
}

/// One frame per face from the mean of its corners' coefficients; planar-2, section 7.1. Empty if a size is not
/// positive.
template <int N>
std::vector<Orthogonal_frame_2> face_frames(const Field_elements<N>& elements, const Eigen::VectorXd& x)
{
  std::vector<typename Field_elements<N>::Coefficients> q(elements.number_of_vertices());
  for (std::size_t v = 0; v < q.size(); ++v)
    q[v] = elements.coefficients(v, x);
  std::vector<Orthogonal_frame_2> frames(elements.number_of_elements());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const auto& vertex = elements.element(f).vertex;
    frames[f] = recover_frame(Tensor_coefficients<N>::harmonics(
        (q[std::size_t(vertex[0])] + q[std::size_t(vertex[1])] + q[std::size_t(vertex[2])]) / 3));
    if (!(frames[f].size_u > 0) || !(frames[f].size_v > 0))
      return {};
  }
  return frames;
}

/// The field on index arrays: see `odeco_frame_field`.
inline Odeco_field_result
solve_planar_field(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector2d>& points,
                   const std::vector<Constrained_halfedge>& edges, const Odeco_field_options& options,
                   const std::function<double(std::size_t, const Gradients&)>& evaluator, Gradients& gradients)
{
  constexpr int N = 3;
  const Stopwatch stopwatch;
  check_field_arguments(edges, options);

  double log_size = 0;
  int n_sizes = 0;
  for (const Constrained_halfedge& edge : edges)
    for (const double size : edge.size)
      if (size > 0) {
        log_size += std::log(size);
        ++n_sizes;
      }
  const int first = edges.front().halfedge;
  const Canonical_position position(points,
                                    points[std::size_t(mesh.target(first))] - points[std::size_t(mesh.source(first))],
                                    n_sizes > 0 ? std::exp(log_size / n_sizes) : 1);
  std::vector<Eigen::Vector2d> canonical_points(points.size());
  for (std::size_t v = 0; v < points.size(); ++v)
    canonical_points[v] = position.point(points[v]);
  std::vector<Constrained_halfedge> canonical_edges = edges;
  for (Constrained_halfedge& edge : canonical_edges)
    for (double& size : edge.size)
      size = position.size(size);

  Odeco_field_result result;
  std::vector<Vertex_restriction<N>> restrictions;
  for (const Vertex_constraint& constraint : collect_vertex_constraints(mesh, canonical_points, canonical_edges)) {
    restrictions.push_back(isotropic_restriction(constraint));
    result.free_corners += constraint.is_free_corner() ? 1 : 0;
  }
  const Field_elements<N> elements(mesh, canonical_points, local_triangle_sizes(mesh, canonical_points),
                                   std::move(restrictions));

  const auto to_gradients = [&](const Eigen::VectorXd& x) {
    Gradients pairs;
    for (const Orthogonal_frame_2& frame : face_frames(elements, x))
      pairs.emplace_back(position.original_direction(frame.direction) / position.original_size(frame.size_u),
                         position.original_direction(frame.normal()) / position.original_size(frame.size_v));
    return pairs;
  };

  // A singularity has to be soft over the same part of the domain however fine the triangles are.
  Melt_and_freeze_schedule schedule = options.schedule;
  schedule.melt_epsilon *= std::max(1.0, std::sqrt(mesh.number_of_faces() / 2500.0));

  const std::size_t n_starts = 2 + std::size_t(options.solver == Field_solver_kind::lbfgs ? 0 : options.starts);
  result.starts.resize(n_starts);
  std::vector<Eigen::VectorXd> fields(n_starts);
  Field_solver<N> first_solver(elements, schedule, options.threads, options.observer, options.solver);
  const auto finish_start = [&](std::size_t i, Field_start start, const Field_solver<N>& solver,
                                const Stopwatch& watch) {
    start.energy = solver.integrability_energy(fields[i]);
    start.energy_lie = solver.lie_energy(fields[i]);
    const Gradients pairs = std::isfinite(start.energy) ? to_gradients(fields[i]) : Gradients();
    start.valid = !pairs.empty();
    start.cost = !start.valid ? std::numeric_limits<double>::infinity()
                 : evaluator  ? evaluator(i, pairs)
                              : start.energy;
    start.seconds = watch.seconds();
    result.starts[i] = start;
  };
  {
    const Stopwatch watch;
    fields[0] = first_solver.smooth_field(1);
    Field_start start;
    start.iterations = first_solver.iterations();
    finish_start(0, start, first_solver, watch);
  }
  {
    const Stopwatch watch;
    fields[1] = fields[0];
    first_solver.integrate(fields[1]);
    Field_start start;
    start.kind = Field_start::Kind::relaxed;
    start.iterations = first_solver.iterations() - result.starts[0].iterations;
    finish_start(1, start, first_solver, watch);
  }
  parallel_for(
      n_starts - 2, options.threads,
      [&](std::size_t i) {
        const Stopwatch watch;
        Field_solver<N> solver(elements, schedule, 1, options.observer, options.solver);
        Field_start start;
        start.kind = Field_start::Kind::melted;
        start.seed = options.seed + i;
        fields[i + 2] = solver.melt_and_freeze(fields[0], start.seed);
        start.iterations = solver.iterations();
        finish_start(i + 2, start, solver, watch);
      },
      1);

  for (std::size_t i = 0; i < n_starts; ++i) {
    const bool better = result.chosen < 0 ||
                        result.starts[std::size_t(result.chosen)].kind == Field_start::Kind::smooth ||
                        result.starts[i].cost < result.starts[std::size_t(result.chosen)].cost;
    if (result.starts[i].valid && better)
      result.chosen = int(i);
    result.iterations += result.starts[i].iterations;
  }
  if (result.chosen < 0)
    throw No_result_error("field", "no start led to a frame field with positive sizes everywhere; prescribe sizes that "
                                   "change more slowly, or use smaller triangles");
  const Eigen::VectorXd& x = fields[std::size_t(result.chosen)];
  gradients = to_gradients(x);
  result.energy = result.starts[std::size_t(result.chosen)].energy;
  result.energy_lie = result.starts[std::size_t(result.chosen)].energy_lie;
  result.energy_odeco = result.energy - result.energy_lie;
  result.harmonics.reserve(points.size());
  for (std::size_t v = 0; v < points.size(); ++v)
    result.harmonics.push_back(
        position.original_harmonics(Tensor_coefficients<N>::harmonics(elements.coefficients(v, x))));
  result.seconds = stopwatch.seconds();
  return result;
}

} // namespace internal
} // namespace Quadrille

#endif
