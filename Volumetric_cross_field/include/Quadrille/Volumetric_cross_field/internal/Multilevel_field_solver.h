// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_MULTILEVEL_FIELD_SOLVER_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_MULTILEVEL_FIELD_SOLVER_H

#include <Quadrille/Progress_observer.h>
#include <Quadrille/Volumetric_cross_field/internal/Cross_diffusion.h>
#include <Quadrille/Volumetric_cross_field/internal/Cross_energy_newton.h>
#include <Quadrille/Volumetric_cross_field/internal/Field_graph.h>
#include <Quadrille/Volumetric_cross_field/internal/coarsen_field_graph.h>
#include <Quadrille/Volumetric_cross_field/internal/solve_field_graph.h>
#include <Quadrille/nearest_cross.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace Quadrille {
namespace internal {

/// Minimises the energy from coarse to fine: on the coarsest graph from the harmonic extension of the alignments (or at
/// random), then on each finer one from the field of the coarser.
///
/// On each level diffusion alternates with projection onto the crosses. Its time, in squared lengths of edges, falls
/// from hundreds, by which arcs of singularities straighten quickly, to about one, below which they do not move any
/// more. Newton's method then finds the minimum.
class Multilevel_field_solver {
public:
  using Counters = Field_graph_counters;

  Multilevel_field_solver(const Field_graph& graph, std::uint64_t seed, int threads, const Progress_observer& progress)
      : m_finest(graph), m_seed(seed), m_threads(threads), m_progress(progress)
  {
  }

  Frames_and_crosses solve(int max_newton_steps, const Field_has_settled& has_settled)
  {
    std::vector<Coarse_field_graph> coarser;
    const auto graph = [&](std::size_t level) -> const Field_graph& {
      return level == 0 ? m_finest : coarser[level - 1].graph;
    };
    while (graph(coarser.size()).number_of_vertices() > large_enough) {
      Coarse_field_graph coarse = Field_graph_coarsener(graph(coarser.size())).coarsen();
      if (2 * coarse.graph.number_of_vertices() > graph(coarser.size()).number_of_vertices())
        break;
      coarser.push_back(std::move(coarse));
    }
    m_counters.levels = coarser.size() + 1;
    for (std::size_t level = 0; level <= coarser.size(); ++level)
      m_work += double(graph(level).number_of_vertices()) *
                (steps_of_diffusion(level == coarser.size()) + usual_newton_steps);
    Frames_and_crosses field = start(graph(coarser.size()));
    const std::size_t coarsest = coarser.size();
    for (std::size_t level = coarsest;; --level) {
      const bool is_coarsest = level == coarsest;
      diffuse(graph(level), is_coarsest, field);
      if (level == 0)
        break;
      run_newton(graph(level), newton_steps_when_coarse, field,
                 [](const Frames_and_crosses&, const Cross_energy_newton::Step& step) {
                   return step.energy_before - step.energy < 1e-4 * step.energy;
                 });
      field = on_finer(coarser[level - 1], graph(level - 1), field);
      coarser.resize(level - 1);
    }
    run_newton(m_finest, max_newton_steps, field, has_settled);
    return field;
  }

  const Counters& counters() const { return m_counters; }

private:
  static constexpr std::size_t large_enough = 5000;
  ///< vertices: below, a coarser level would save nothing
  static constexpr double shortest_time = 1.4;
  static constexpr double accuracy = 0.02; ///< of a step of diffusion, relative to what it changes
  static constexpr int newton_steps_when_coarse = 10, usual_newton_steps = 15;
  static constexpr double least_damping = 0.1; ///< of Newton's steps, until they converge

  static constexpr int steps_of_diffusion(bool is_coarsest) { return is_coarsest ? 30 : 8; }

  /// A step on so many vertices is about to begin.
  void report(std::size_t vertices)
  {
    m_progress.report("field", std::min(m_done / m_work, 1.0));
    m_done += double(vertices);
  }

  Frames_and_crosses start(const Field_graph& graph)
  {
    const std::size_t n = graph.number_of_vertices();
    Frames_and_crosses field(n);
    Cross_diffusion::Field x(n, Cross_diffusion::Harmonics::Zero());
    parallel_for(n, m_threads, [&](std::size_t v) {
      if (m_seed != 0)
        x[v] = cross_harmonics(random_rotation(v)).cast<float>();
      else if (const Cross_alignment* alignment = graph.alignment(v))
        x[v] = alignment->crosses.offset.cast<float>();
    });
    if (m_seed == 0) {
      // Far beyond the extent of a coarsest graph: as good as the harmonic extension.
      constexpr double time = 1000;
      m_counters.diffusion_passes +=
          std::size_t(Cross_diffusion(graph, m_threads)
                          .solve(time, Cross_diffusion::Field(n, Cross_diffusion::Harmonics::Zero()), x, accuracy));
    }
    project(graph, x, false, field);
    return field;
  }

  /// Uniform, and the same for each vertex whatever the order.
  Eigen::Matrix3d random_rotation(std::size_t v) const
  {
    std::uint64_t state = m_seed * 0x9E3779B97F4A7C15u + v * 0xD1B54A32D192ED03u;
    const auto next = [&] { // splitmix64
      state += 0x9E3779B97F4A7C15u;
      std::uint64_t z = state;
      z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
      z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
      return double((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
    };
    const double u = next(), a = 2 * std::acos(-1.0) * next(), b = 2 * std::acos(-1.0) * next();
    return Eigen::Quaterniond(std::sqrt(1 - u) * std::sin(a), std::sqrt(1 - u) * std::cos(a),
                              std::sqrt(u) * std::sin(b), std::sqrt(u) * std::cos(b))
        .toRotationMatrix();
  }

  void diffuse(const Field_graph& graph, bool is_coarsest, Frames_and_crosses& field)
  {
    const std::size_t n = graph.number_of_vertices();
    // At first far enough for everything to feel all of the boundary; on finer levels for arcs to move by some spacings
    // of the coarser one.
    const int steps = steps_of_diffusion(is_coarsest);
    const double longest_time = is_coarsest ? 3 * std::pow(double(n), 2.0 / 3) : 300;
    Cross_diffusion diffusion(graph, m_threads);
    Cross_diffusion::Field before(n), after;
    for (int i = 0; i < steps; ++i) {
      report(n);
      parallel_for(n, m_threads, [&](std::size_t v) { before[v] = field.crosses[v].cast<float>(); });
      after = before;
      const double time =
          longest_time * std::pow(shortest_time / std::max(longest_time, shortest_time), double(i) / (steps - 1));
      m_counters.diffusion_passes += std::size_t(diffusion.solve(time, before, after, accuracy));
      project(graph, after, !is_coarsest, field);
    }
    m_counters.diffusions += std::size_t(steps);
  }

  /// The nearest crosses; `has_guess`: the field's own are close to them.
  void project(const Field_graph& graph, const Cross_diffusion::Field& x, bool has_guess, Frames_and_crosses& field)
  {
    const std::size_t n = graph.number_of_vertices();
    std::vector<std::size_t> free;
    std::vector<Cross_harmonics> at_free;
    for (std::size_t v = 0; v < n; ++v)
      if (graph.alignment_of[v] == Field_graph::is_free) {
        free.push_back(v);
        if (!has_guess)
          at_free.push_back(x[v].cast<double>());
      }
    const std::vector<Nearest_cross> nearest = Quadrille::nearest_crosses(at_free, m_threads);
    parallel_for(free.size(), m_threads, [&](std::size_t i) {
      const std::size_t v = free[i];
      field.frames[v] =
          has_guess ? nearest_cross(Cross_harmonics(x[v].cast<double>()), field.frames[v]).frame : nearest[i].frame;
    });
    parallel_for(n, m_threads, [&](std::size_t v) {
      if (const Cross_alignment* alignment = graph.alignment(v))
        field.frames[v] = alignment->nearest(x[v].cast<double>());
      field.crosses[v] = cross_harmonics(field.frames[v]);
    });
  }

  template <class Done>
  void run_newton(const Field_graph& graph, int max_steps, Frames_and_crosses& field, const Done& is_done)
  {
    Cross_energy_newton newton(graph, m_threads);
    double damping = least_damping;
    for (int i = 0; i < max_steps; ++i) {
      report(graph.number_of_vertices());
      const double tolerance = damping > 0 ? 0.1 : 0.01;
      const Cross_energy_newton::Step step = newton.step(field.frames, field.crosses, damping, 60, tolerance);
      ++m_counters.newton_steps;
      m_counters.conjugate_gradients += std::size_t(step.conjugate_gradients);
      if (!step.is_downhill && damping < 1) {
        damping = std::min(1.0, damping + 0.3);
        continue;
      }
      if (is_done(field, step) || !step.is_downhill)
        return;
      damping = step.energy_before - step.energy < 1e-4 * step.energy ? 0 : least_damping;
    }
  }

  /// The field of the aggregates, turned to follow the alignments of their vertices.
  Frames_and_crosses on_finer(const Coarse_field_graph& coarse, const Field_graph& fine,
                              const Frames_and_crosses& field) const
  {
    const std::size_t n = fine.number_of_vertices();
    Frames_and_crosses result(n);
    parallel_for(n, m_threads, [&](std::size_t v) {
      Eigen::Matrix3d& frame = result.frames[v];
      frame = field.frames[std::size_t(coarse.aggregate_of[v])];
      if (!coarse.to_fine.empty())
        frame = (coarse.to_fine[v] * frame).eval();
      if (const Cross_alignment* alignment = fine.alignment(v))
        frame = alignment->nearest(cross_harmonics(frame));
      result.crosses[v] = cross_harmonics(frame);
    });
    return result;
  }

  const Field_graph& m_finest;
  std::uint64_t m_seed;
  int m_threads;
  const Progress_observer& m_progress;
  Counters m_counters;
  double m_work = 0, m_done = 0; ///< steps times vertices
};

QUADRILLE_INLINE Frames_and_crosses solve_field_graph(const Field_graph& graph, std::uint64_t seed, int threads,
                                                      int max_newton_steps, const Field_has_settled& has_settled,
                                                      const Progress_observer& progress, Field_graph_counters& counters)
{
  Multilevel_field_solver solver(graph, seed, threads, progress);
  Frames_and_crosses field = solver.solve(max_newton_steps, has_settled);
  counters = solver.counters();
  return field;
}

} // namespace internal
} // namespace Quadrille

#endif
