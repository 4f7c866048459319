// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_FIELD_SOLVER_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_FIELD_SOLVER_H

#include <Quadrille/Odeco_frame_field/internal/Field_hierarchy.h>
#include <Quadrille/Odeco_frame_field/internal/Melting_solver.h>
#include <Quadrille/Odeco_frame_field/internal/Surface_energy.h>
#include <Quadrille/Odeco_frame_field/internal/Surface_prolongation.h>
#include <Quadrille/Odeco_frame_field/internal/harmonic_log_sizes.h>
#include <Quadrille/Odeco_frame_field/internal/surface_restrictions.h>
#include <Quadrille/Surface_field_options.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// A triangulated surface with constrained edges, and what follows for its nodes.
struct Surface_problem {
  Constrained_surface surface;
  std::vector<double> target_size; ///< per vertex, 0 where none is wanted; or empty
  Surface_constraints constraints;

  Surface_problem(Constrained_surface constrained_surface, std::vector<double> targets)
      : surface(std::move(constrained_surface)), target_size(std::move(targets)),
        constraints(Surface_constraint_collector(surface.mesh, surface.points, surface.edges).collect())
  {
  }
};

/// The logarithms of the values that one expects at the nodes: harmonic between those that are known, and zero in
/// components where none is.
inline std::vector<double> expected_log_values(const Surface_problem& problem)
{
  const Constrained_surface& surface = problem.surface;
  const Surface_nodes& nodes = problem.constraints.nodes;
  std::vector<std::optional<double>> known(surface.points.size());
  for (std::size_t v = 0; v < nodes.vertex.size(); ++v)
    if (problem.constraints.of_node[v].has_size())
      known[std::size_t(nodes.vertex[v])] = std::log(problem.constraints.of_node[v].mean_size());
  for (std::size_t v = 0; v < problem.constraints.weak_of_node.size(); ++v) {
    auto& value = known[std::size_t(nodes.vertex[v])];
    if (!value && problem.constraints.weak_of_node[v].has_size())
      value = std::log(problem.constraints.weak_of_node[v].mean_size());
  }
  for (std::size_t v = 0; v < problem.target_size.size(); ++v)
    if (problem.target_size[v] > 0 && !known[v])
      known[v] = -std::log(problem.target_size[v]);
  for (const int v : first_vertices_of_components(surface.mesh, known))
    known[std::size_t(v)] = 0;
  const std::vector<double> values = harmonic_extension(surface.mesh, surface.points, known);
  std::vector<double> of_node;
  for (const int v : nodes.vertex)
    of_node.push_back(values[std::size_t(v)]);
  return of_node;
}

template <int N>
Surface_elements<N> make_surface_elements(const Surface_problem& problem, Restricted_unknowns<N> unknowns,
                                          Normal_value normal_value)
{
  const Surface_nodes& nodes = problem.constraints.nodes;
  std::vector<double> target_weights;
  if (!problem.target_size.empty())
    for (const int v : nodes.vertex)
      target_weights.push_back(problem.target_size[std::size_t(v)] > 0 ? 1 : 0);
  Surface_elements<N> elements(nodes, problem.surface.mesh, problem.surface.points,
                               local_triangle_sizes(problem.surface.mesh, problem.surface.points), std::move(unknowns),
                               expected_log_values(problem), std::move(target_weights), normal_value);
  elements.set_weak_targets(weak_targets<N>(problem.constraints));
  return elements;
}

/// Minimises the energies of one field on a surface.
template <int N> class Surface_field_solver : public Melting_solver<Surface_energy<N>> {
public:
  using Base = Melting_solver<Surface_energy<N>>;
  using Coefficients = typename Surface_elements<N>::Coefficients;

  Surface_field_solver(const Surface_problem& problem, const Surface_elements<N>& elements,
                       const Surface_weights& weights, const Melt_and_freeze_schedule& schedule, int threads,
                       const Progress_observer* observer, Field_solver_kind kind)
      : Base(elements, Surface_energy<N>(elements, weights), schedule, threads, observer, kind), m_problem(problem)
  {
  }
  Surface_field_solver(const Surface_field_solver& other, int threads)
      : Base(other, threads), m_problem(other.m_problem)
  {
  }

  /// Isotropic frames of the expected sizes, with the directions of an octahedral field that minimises surface, eq.
  /// (57).
  Eigen::VectorXd smooth_field()
  {
    const Surface_elements<N> octahedral =
        make_surface_elements<N>(m_problem, restrict_to_octahedral<N>(m_problem.constraints), Normal_value::one);
    Surface_smoothness<N> energy(octahedral, 0);
    Element_least_squares<Surface_smoothness<N>> problem(energy, octahedral.number_of_unknowns(),
                                                         m_integrable_problem.threads());
    Eigen::VectorXd directions = Eigen::VectorXd::Zero(Eigen::Index(octahedral.number_of_unknowns()));
    minimize_smoothness(problem, directions); // quadratic
    // Tensors that are small there, as everywhere on surfaces without constraints, are far from any frame's.
    for (std::size_t v = 0; v < octahedral.number_of_nodes(); ++v)
      octahedral.assign_coefficients(v, frame_coefficients(octahedral.coefficients(v, directions), 1), directions);
    energy.set_odeco_weight(1);
    minimize_smoothness(problem, directions);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(Eigen::Index(m_elements.number_of_unknowns()));
    for (std::size_t v = 0; v < m_elements.number_of_nodes(); ++v) {
      const double value = std::exp(m_elements.expected_log_value(v));
      m_elements.assign_coefficients(v, frame_coefficients(octahedral.coefficients(v, directions), value), x);
    }
    return x;
  }

  Surface_energy_terms energy_terms(const Eigen::VectorXd& x) const
  {
    using Rows = Surface_energy_rows<N>;
    const auto energies = this->template energy_by_rows<6>(
        x, {Rows::first_odeco, Rows::first_size, Rows::first_angle, Rows::first_smooth, Rows::first_weak, Rows::count});
    return {energies[0], energies[1], energies[2], energies[3], energies[5]};
  }

private:
  /// Of an isotropic frame in the direction of the tensor nearest to the given one.
  static Coefficients frame_coefficients(const Coefficients& q, double value)
  {
    Orthogonal_frame_2 frame;
    frame.direction = nearest_odeco_frame(Tensor_coefficients<N>::harmonics(q)).direction;
    frame.size_u = frame.size_v = value;
    return Tensor_coefficients<N>::from_harmonics(odeco_harmonics(frame));
  }

  template <class Problem> void minimize_smoothness(Problem& problem, Eigen::VectorXd& x)
  {
    if (x.size() == 0)
      return;
#ifdef QUADRILLE_WITH_ALGLIB
    if (m_kind != Field_solver_kind::levenberg_marquardt) {
      Lbfgs_options options;
      options.relative_decrease = 1e-5;
      m_iterations += minimize_lbfgs(problem, x, options).iterations;
      return;
    }
#endif
    Levenberg_marquardt_options options;
    options.relative_decrease = 1e-3;
    options.observer = m_observer;
    options.stage = "field";
    m_iterations += minimize_levenberg_marquardt(problem, x, options).iterations;
  }

  using Base::m_elements;
  using Base::m_integrable_problem;
  using Base::m_iterations;
  using Base::m_kind;
  using Base::m_observer;
  const Surface_problem& m_problem;
};

/// A coarser copy of a field on a surface.
template <int N> struct Surface_level {
  using Mesh = Surface_problem;
  using Elements = Surface_elements<N>;
  using Solver = Surface_field_solver<N>;
  static constexpr bool relaxes_from_coarse = true;

  Surface_level(const Surface_problem& finer, const Surface_elements<N>& finer_elements, std::size_t n_faces)
      : mesh(coarsen_with_local_sizes(finer.surface, n_faces, fine_vertex, coarse_vertex), targets_of(finer)),
        elements(make_surface_elements<N>(mesh, restrict_surface<N>(mesh.constraints), finer_elements.normal_value())),
        to_finer(mesh.surface.mesh, mesh.surface.points, finer.surface.points, coarse_vertex)
  {
  }
  // The prolongation refers to the rest.
  Surface_level(const Surface_level&) = delete;
  Surface_level& operator=(const Surface_level&) = delete;

  std::vector<int> fine_vertex, coarse_vertex;
  Surface_problem mesh;
  Surface_elements<N> elements;
  Surface_prolongation to_finer;

private:
  std::vector<double> targets_of(const Surface_problem& finer) const
  {
    std::vector<double> targets;
    if (!finer.target_size.empty())
      for (const int v : fine_vertex)
        targets.push_back(finer.target_size[std::size_t(v)]);
    return targets;
  }
};

} // namespace internal
} // namespace Quadrille

#endif
