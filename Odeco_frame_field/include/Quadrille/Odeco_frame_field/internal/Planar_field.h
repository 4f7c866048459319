// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_PLANAR_FIELD_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_PLANAR_FIELD_H

#include <Quadrille/Odeco_field_options.h>
#include <Quadrille/Odeco_frame_field/internal/Canonical_position.h>
#include <Quadrille/Odeco_frame_field/internal/Field_run.h>
#include <Quadrille/Odeco_frame_field/internal/Planar_level.h>
#include <Quadrille/Odeco_frame_field/internal/harmonic_log_sizes.h>
#include <Quadrille/Odeco_frame_field/internal/local_triangle_sizes.h>
#include <Quadrille/Odeco_frame_field/internal/vertex_restrictions.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

inline void check_field_arguments(const std::vector<Constrained_halfedge>& edges, const Odeco_field_options& options)
{
  if (edges.empty())
    throw Invalid_input_error("no edge is constrained, so any constant field would do; align the frames with the "
                              "boundary at least");
  if (std::any_of(edges.begin(), edges.end(), [](const Constrained_halfedge& edge) { return edge.is_weak; }))
    throw Invalid_argument_error(
        "an edge is constrained weakly, which is for surfaces only; give target sizes or metrics "
        "instead");
  check_prescribed_sizes(edges, options.isotropic);
  check_target_sizes(options.target_size, options.target_size_weight);
  for (const Eigen::Matrix2d& metric : options.target_metric)
    if (!metric.isZero(0) && (!metric.allFinite() || metric(0, 1) != metric(1, 0) || !(metric(0, 0) > 0) ||
                              !(metric.determinant() > 0) || !std::isfinite(1 / metric.determinant())))
      throw Invalid_argument_error("a vertex has the target metric (" + std::to_string(metric(0, 0)) + ", " +
                                   std::to_string(metric(0, 1)) + "; " + std::to_string(metric(1, 0)) + ", " +
                                   std::to_string(metric(1, 1)) +
                                   "); metrics must be symmetric and positive definite (zero for no target)");
  check_schedule(options.schedule, options.starts, options.threads);
}

/// One run of `odeco_frame_field` on index arrays; N coefficients per vertex (3: isotropic frames).
template <int N> class Planar_field : public Field_run<Planar_field<N>, Planar_level<N>> {
  using Base = Field_run<Planar_field<N>, Planar_level<N>>;

public:
  Planar_field(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector2d>& points,
               const std::vector<Constrained_halfedge>& edges, const Odeco_field_options& options,
               const Field_evaluator& evaluator)
      : Base(options, evaluator), m_options(options), m_position(canonical_position(mesh, points, edges)),
        m_mesh(canonical_mesh(mesh, points, edges)), m_elements(make_elements())
  {
  }

  const Field_elements<N>& elements() const { return m_elements; }

  Odeco_field_result solve(Gradients& gradients)
  {
    const Stopwatch stopwatch;
    const std::unique_ptr<Field_solver<N>> analyzed =
        make_solver(m_elements, melt_and_freeze_schedule_for(m_options.schedule, m_elements.number_of_elements()),
                    m_options.solver);
    if (m_options.initial_field.empty())
      this->compute_starts(m_mesh, m_elements, *analyzed, m_options.starts);
    else
      compute_initial_start(*analyzed);
    m_result.seconds = stopwatch.seconds();
    const Eigen::VectorXd& x = this->choose_start(m_result, gradients);
    m_result.energy_lie = m_result.starts[std::size_t(m_result.chosen)].energy_lie;
    m_result.energy_odeco = m_result.starts[std::size_t(m_result.chosen)].energy_odeco;
    for (std::size_t v = 0; v < m_elements.number_of_nodes(); ++v)
      m_result.harmonics.push_back(
          m_position.original_harmonics(Tensor_coefficients<N>::harmonics(m_elements.coefficients(v, x))));
    return m_result;
  }

private:
  friend Base;

  std::unique_ptr<Field_solver<N>> make_solver(const Field_elements<N>& elements,
                                               const Melt_and_freeze_schedule& schedule, Field_solver_kind kind) const
  {
    return std::make_unique<Field_solver<N>>(elements, schedule, m_options.threads, m_options.observer, kind,
                                             m_options.target_size_weight);
  }
  std::unique_ptr<Field_solver<N>> make_level_solver(const Planar_level<N>& level,
                                                     const Melt_and_freeze_schedule& schedule) const
  {
    return make_solver(level.elements, schedule, Field_solver_kind::levenberg_marquardt);
  }

  void compute_initial_start(const Field_solver<N>& analyzed)
  {
    const Stopwatch watch;
    Field_solver<N> solver(analyzed, m_options.threads);
    m_fields.emplace_back(Eigen::VectorXd::Zero(Eigen::Index(m_elements.number_of_unknowns())));
    for (std::size_t v = 0; v < m_elements.number_of_nodes(); ++v)
      m_elements.assign_coefficients(
          v, Tensor_coefficients<N>::from_harmonics(m_position.harmonics(m_options.initial_field[v])), m_fields[0]);
    if (m_options.integrable)
      solver.integrate(m_fields[0]);
    m_starts.resize(1);
    Field_start start;
    start.kind = Field_start::Kind::initial;
    start.iterations = solver.iterations();
    this->finish_start(0, start, m_elements, solver, watch);
  }

  /// Unit of length: the domain; unit of sizes: the geometric mean of the prescribed ones.
  Canonical_position canonical_position(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector2d>& points,
                                        const std::vector<Constrained_halfedge>& edges) const
  {
    double log_size = 0;
    int n_sizes = 0;
    for (const Constrained_halfedge& edge : edges)
      for (const Frame_size& size : edge.size)
        for (const double value : {size.normal, size.tangential})
          if (value > 0) {
            log_size += std::log(value);
            ++n_sizes;
          }
    if (n_sizes == 0) {
      for (const double size : m_options.target_size)
        if (size > 0) {
          log_size += std::log(size);
          ++n_sizes;
        }
      for (const Eigen::Matrix2d& metric : m_options.target_metric)
        if (!metric.isZero(0)) {
          log_size -= 0.25 * std::log(metric.determinant());
          ++n_sizes;
        }
    }
    const int first = edges.front().halfedge;
    return {points, points[std::size_t(mesh.target(first))] - points[std::size_t(mesh.source(first))],
            n_sizes > 0 ? std::exp(log_size / n_sizes) : 1};
  }

  Constrained_mesh canonical_mesh(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector2d>& points,
                                  std::vector<Constrained_halfedge> edges) const
  {
    std::vector<Eigen::Vector2d> canonical_points;
    for (const Eigen::Vector2d& p : points)
      canonical_points.push_back(m_position.point(p));
    for (Constrained_halfedge& edge : edges)
      for (Frame_size& size : edge.size)
        size = {m_position.size(size.normal), m_position.size(size.tangential)};
    return {mesh, std::move(canonical_points), std::move(edges)};
  }

  Field_elements<N> make_elements()
  {
    const auto& [mesh, points, edges] = m_mesh;
    std::vector<Vertex_restriction<N>> restrictions;
    std::vector<Vertex_constraint> constraints = collect_vertex_constraints(mesh, points, edges);
    std::vector<double> targets = m_options.target_size;
    for (double& size : targets)
      size = m_position.size(size);
    Vertex_targets wanted;
    add_metrics(targets, wanted);
    wanted.weight.resize(targets.size());
    std::transform(targets.begin(), targets.end(), wanted.weight.begin(),
                   [](double size) { return size > 0 ? 1. : 0.; });
    for (std::size_t v = 0; v < constraints.size(); ++v) {
      restrictions.emplace_back();
      if (m_options.impose_target_size && !targets.empty() && targets[v] > 0 && !constraints[v].has_size())
        impose_target(v, targets[v], constraints[v], restrictions.back());
      else
        restrict_vertex(constraints[v], restrictions.back());
      m_result.free_corners += constraints[v].is_free_corner() ? 1 : 0;
    }
    return Field_elements<N>(mesh, points, local_triangle_sizes(mesh, points), std::move(restrictions),
                             harmonic_log_sizes(mesh, points, constraints, targets), std::move(wanted));
  }

  bool has_metric(std::size_t v) const
  {
    return !m_options.target_metric.empty() && !m_options.target_metric[v].isZero(0);
  }

  /// Sizes with the metrics' areas, and what anisotropic fields miss of the metrics.
  void add_metrics(std::vector<double>& targets, Vertex_targets& wanted) const
  {
    targets.resize(std::max(targets.size(), m_options.target_metric.size()), 0);
    if (N == 5 && !m_options.target_metric.empty())
      wanted.metric.assign(targets.size(), Metric_residual::Zero());
    for (std::size_t v = 0; v < m_options.target_metric.size(); ++v)
      if (has_metric(v)) {
        const Eigen::Matrix2d metric = m_position.metric(m_options.target_metric[v]);
        targets[v] = std::pow(metric.determinant(), -0.25);
        if constexpr (N == 5)
          wanted.metric[v] = metric_residual(metric);
      }
  }

  void impose_target(std::size_t v, double size, Vertex_constraint& constraint,
                     Vertex_restriction<N>& restriction) const
  {
    const bool is_on_curve = constraint.is_constrained();
    constraint.size[0].add(size);
    constraint.size[1].add(size);
    restrict_vertex(constraint, restriction);
    if constexpr (N == 5)
      if (!is_on_curve && has_metric(v)) // degree 4 stays free, and follows
        restriction.offset.template head<3>() =
            low_harmonics(metric_power(m_position.metric(m_options.target_metric[v]), -0.5));
  }

  /// One frame per face from the mean of its corners' coefficients; planar-2, section 7.1.
  ///
  /// The sizes of planar-2's eq. (35) keep their ratio but take the area of eq. (21): where the tensor melts around a
  /// singularity the former shrink by up to a quarter, the area does not.
  std::vector<Orthogonal_frame_2> face_frames(const Eigen::VectorXd& x) const
  {
    using Coefficients = typename Field_elements<N>::Coefficients;
    std::vector<Coefficients> q(m_elements.number_of_nodes());
    for (std::size_t v = 0; v < q.size(); ++v)
      q[v] = m_elements.coefficients(v, x);
    std::vector<Orthogonal_frame_2> frames(m_elements.number_of_elements());
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const auto& vertex = m_elements.corners(f);
      const Coefficients mean = (q[std::size_t(vertex[0])] + q[std::size_t(vertex[1])] + q[std::size_t(vertex[2])]) / 3;
      if (!recover_frame_of_area(Tensor_coefficients<N>::harmonics(mean), frames[f]))
        return {};
    }
    return frames;
  }

  Gradients::value_type gradients_of(const Orthogonal_frame_2& frame) const
  {
    return {m_position.original_direction(frame.direction) / m_position.original_size(frame.size_u),
            m_position.original_direction(frame.normal()) / m_position.original_size(frame.size_v)};
  }

  using Base::m_fields;
  using Base::m_starts;
  const Odeco_field_options& m_options;
  Odeco_field_result m_result;
  Canonical_position m_position;
  Constrained_mesh m_mesh; ///< in the canonical position
  Field_elements<N> m_elements;
};

} // namespace internal
} // namespace Quadrille

#endif
