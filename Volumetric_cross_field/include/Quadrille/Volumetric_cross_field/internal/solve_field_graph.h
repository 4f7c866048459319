// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_SOLVE_FIELD_GRAPH_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_SOLVE_FIELD_GRAPH_H

#include <Quadrille/Progress_observer.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/Volumetric_cross_field/internal/Cross_energy_newton.h>
#include <Quadrille/Volumetric_cross_field/internal/Field_graph.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace Quadrille {
namespace internal {

/// A field on a graph.
struct Frames_and_crosses {
  std::vector<Eigen::Matrix3d> frames;
  std::vector<Cross_harmonics> crosses;

  explicit Frames_and_crosses(std::size_t n = 0) : frames(n, Eigen::Matrix3d::Identity()), crosses(n) {}
};

/// What a minimisation took.
struct Field_graph_counters {
  std::size_t levels = 0, diffusions = 0, diffusion_passes = 0, newton_steps = 0, conjugate_gradients = 0;
};

/// Told after each step on the finest level; returns whether the field has settled.
using Field_has_settled = std::function<bool(const Frames_and_crosses&, const Cross_energy_newton::Step&)>;

/// Minimises the energy of a graph's field, from coarse to fine; see `Multilevel_field_solver`.
Frames_and_crosses solve_field_graph(const Field_graph& graph, std::uint64_t seed, int threads, int max_newton_steps,
                                     const Field_has_settled& has_settled, const Progress_observer& progress,
                                     Field_graph_counters& counters);

} // namespace internal
} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Volumetric_cross_field/internal/Multilevel_field_solver.h>
#endif

#endif
