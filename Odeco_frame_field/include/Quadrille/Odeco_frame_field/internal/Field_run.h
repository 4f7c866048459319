// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_RUN_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_RUN_H

#include <Quadrille/Frame_edge_constraints.h>
#include <Quadrille/Odeco_field_options.h>
#include <Quadrille/Odeco_frame_field/internal/Field_hierarchy.h>
#include <Quadrille/Odeco_frame_field/internal/check_field_arguments.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// The frame nearest to a tensor, with the area of the tensor itself. False if a size is not positive.
inline bool recover_frame_of_area(const Circular_harmonics& q, Orthogonal_frame_2& frame)
{
  frame = recover_frame(q);
  const double area = frame_area(q);
  if (!(frame.size_u > 0) || !(frame.size_v > 0) || !(area > 0))
    return false;
  const double scale = std::sqrt(area / (frame.size_u * frame.size_v));
  frame.size_u *= scale;
  frame.size_v *= scale;
  return true;
}

/// The starts of one field, in the plane or on a surface, and the choice among them.
///
/// `Derived` has `make_level_solver(level, schedule)` for the levels of a `Field_hierarchy`, `face_frames(x)`, the
/// frame of every face or nothing if a size is not positive, and `gradients_of(frame)`, the original gradient pair.
template <class Derived, class Level> class Field_run {
public:
  using Mesh = typename Level::Mesh;
  using Elements = typename Level::Elements;
  using Solver = typename Level::Solver;

protected:
  Field_run(const Field_run_options& options, const Field_evaluator& evaluator)
      : m_options(options), m_evaluator(evaluator)
  {
  }

  /// Smooth, relaxed, and unless the solver is one of the references, melted ones. Only copies of `analyzed`
  /// factorise, so that no factor is kept longer than it is used.
  void compute_starts(const Mesh& mesh, const Elements& elements, const Solver& analyzed, int n_melted)
  {
    const bool is_reference = m_options.solver != Field_solver_kind::levenberg_marquardt;
    n_melted = m_options.integrable && !is_reference ? n_melted : 0;
    m_starts.resize(m_options.integrable ? 2 + std::size_t(n_melted) : 1);
    m_fields.resize(m_starts.size());
    compute_smooth_start(elements, analyzed);
    if (!m_options.integrable)
      return;
    const bool needs_levels = n_melted > 0 || (Level::relaxes_from_coarse && !is_reference);
    const auto hierarchy = needs_levels ? std::make_unique<Field_hierarchy<Level>>(
                                              mesh, elements, m_options.schedule, n_melted > 0,
                                              [this](const Level& level, const Melt_and_freeze_schedule& schedule) {
                                                return derived().make_level_solver(level, schedule);
                                              })
                                        : nullptr;
    compute_relaxed_start(elements, analyzed, hierarchy.get());
    if (n_melted == 0)
      return;
    const int at_once = int(std::clamp<std::size_t>(triangles_at_once / elements.number_of_elements(), 1, 1000));
    const int start_threads = m_options.threads > 0 ? std::min(m_options.threads, at_once) : at_once;
    parallel_for(
        std::size_t(n_melted), start_threads,
        [&](std::size_t i) {
          compute_melted_start(i, elements, analyzed, start_threads > 1 ? 1 : m_options.threads, *hierarchy);
        },
        1);
  }

  void finish_start(std::size_t i, Field_start start, const Elements& elements, const Solver& solver,
                    const Stopwatch& watch)
  {
    const Eigen::VectorXd& x = m_fields[i];
    start.energy = solver.integrability_energy(x);
    const auto parts = solver.energy_parts(x);
    start.energy_lie = parts.lie;
    start.energy_odeco = parts.odeco;
    const std::vector<Orthogonal_frame_2> frames =
        std::isfinite(start.energy) ? derived().face_frames(x) : std::vector<Orthogonal_frame_2>();
    start.valid = !frames.empty();
    start.cost = std::numeric_limits<double>::infinity();
    if (start.valid) {
      start.size_deviation = size_deviation(elements, frames);
      start.cost = (m_evaluator.cost ? m_evaluator.cost(i, gradients_of_frames(frames)) : start.energy) +
                   m_options.size_deviation_weight * start.size_deviation;
    }
    start.seconds = watch.seconds();
    m_starts[i] = start;
  }

  /// Fills `result` with what is the same in the plane and on surfaces. \returns the unknowns of the chosen start
  const Eigen::VectorXd& choose_start(Field_run_result& result, Gradients& gradients)
  {
    const int best = best_start(m_starts);
    result.chosen = m_evaluator.choose ? int(m_evaluator.choose(m_starts)) : best;
    result.starts = m_starts;
    for (const Field_start& start : m_starts)
      result.iterations += start.iterations;
    result.energy = m_starts[std::size_t(result.chosen)].energy;
    const Eigen::VectorXd& x = m_fields[std::size_t(result.chosen)];
    gradients = gradients_of_frames(derived().face_frames(x));
    return x;
  }

private:
  void compute_smooth_start(const Elements& elements, const Solver& analyzed)
  {
    const Stopwatch watch;
    Solver solver(analyzed, m_options.threads);
    m_fields[0] = solver.smooth_field();
    Field_start start;
    start.iterations = solver.iterations();
    finish_start(0, start, elements, solver, watch);
  }

  void compute_relaxed_start(const Elements& elements, const Solver& analyzed, const Field_hierarchy<Level>* hierarchy)
  {
    const Stopwatch watch;
    Solver solver(analyzed, m_options.threads);
    Field_start start;
    start.kind = Field_start::Kind::relaxed;
    if (hierarchy && hierarchy->can_relax())
      m_fields[1] = hierarchy->relax(solver, m_options.threads, start.iterations);
    // Coarse triangles between curves may leave no room for frames of positive size.
    if (m_fields[1].size() == 0 || !std::isfinite(solver.integrability_energy(m_fields[1]))) {
      m_fields[1] = m_fields[0];
      solver.integrate(m_fields[1]);
    }
    start.iterations += solver.iterations();
    finish_start(1, start, elements, solver, watch);
  }

  void compute_melted_start(std::size_t i, const Elements& elements, const Solver& analyzed, int threads,
                            const Field_hierarchy<Level>& hierarchy)
  {
    const Stopwatch watch;
    Solver solver(analyzed, threads);
    Field_start start;
    start.kind = Field_start::Kind::melted;
    start.seed = m_options.seed + i;
    m_fields[i + 2] = hierarchy.can_melt() ? hierarchy.melt_and_freeze(start.seed, solver, start.iterations)
                                           : solver.melt_and_freeze(m_fields[0], start.seed);
    start.iterations += solver.iterations();
    finish_start(i + 2, start, elements, solver, watch);
  }

  /// Mean of log(size / expected)^2.
  double size_deviation(const Elements& elements, const std::vector<Orthogonal_frame_2>& frames) const
  {
    double sum = 0;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      double log_ratio = 0.5 * std::log(frames[f].size_u * frames[f].size_v);
      for (const int v : elements.corners(f))
        log_ratio -= elements.expected_log_value(std::size_t(v)) / 3;
      sum += elements.element(f).area * log_ratio * log_ratio;
    }
    return sum / elements.total_area();
  }

  Gradients gradients_of_frames(const std::vector<Orthogonal_frame_2>& frames) const
  {
    Gradients pairs;
    for (const Orthogonal_frame_2& frame : frames)
      pairs.push_back(derived().gradients_of(frame));
    return pairs;
  }

  const Derived& derived() const { return static_cast<const Derived&>(*this); }

  const Field_run_options& m_options;
  const Field_evaluator& m_evaluator;

protected:
  std::vector<Field_start> m_starts;
  std::vector<Eigen::VectorXd> m_fields; ///< by start
};

} // namespace internal
} // namespace Quadrille

#endif
