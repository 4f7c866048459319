// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_SOLVER_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_SOLVER_H

#include <Quadrille/Odeco_frame_field/internal/Field_energy.h>
#include <Quadrille/Odeco_frame_field/internal/Kappa_energy.h>
#include <Quadrille/Odeco_frame_field/internal/Melting_solver.h>

#include <vector>

namespace Quadrille {
namespace internal {

/// Minimises the energies of one planar field; every method starts from, and returns, a vector of unknowns.
template <int N> class Field_solver : public Melting_solver<Field_energy<N, Field_energy_kind::integrability>> {
public:
  using Smoothness = Field_energy<N, Field_energy_kind::smoothness>;
  using Integrability = Field_energy<N, Field_energy_kind::integrability>;
  using Base = Melting_solver<Integrability>;
  using Coefficients = typename Field_elements<N>::Coefficients;

  Field_solver(const Field_elements<N>& elements, const Melt_and_freeze_schedule& schedule, int threads,
               const Progress_observer* observer, Field_solver_kind kind, double target_attraction = 0)
      : Base(elements, integrability(elements, schedule, target_attraction), schedule, threads, observer, kind),
        m_smoothness(elements, schedule.smooth_epsilon)
  {
  }

  /// As that of `Melting_solver`.
  Field_solver(const Field_solver& other, int threads) : Base(other, threads), m_smoothness(other.m_smoothness) {}

  /// The minimum of E_smooth (of E_kappa, kappa = 1) from the harmonic extension of the constraints, and of
  /// frames of size 1 where these leave it open.
  Eigen::VectorXd smooth_field()
  {
    // Most solvers never need it, and its matrix takes memory.
    Element_least_squares<Smoothness> problem(m_smoothness, m_integrable_problem, m_integrable_problem.threads());
    Eigen::VectorXd x = harmonic_field(problem);
    if (m_kind == Field_solver_kind::lbfgs_kappa) {
      minimize_kappa(x, {1});
      return x;
    }
    Levenberg_marquardt_options options;
    options.relative_decrease = 1e-6;
    this->minimize(problem, x, options);
    return x;
  }

  /// Minimises E_integ (E_kappa down to kappa = 0) at the final epsilon.
  void integrate(Eigen::VectorXd& x)
  {
    if (m_kind == Field_solver_kind::lbfgs_kappa) {
      minimize_kappa(x, {1e-1, 1e-2, 1e-3, 1e-4, 0});
      return;
    }
    Base::integrate(x);
  }

private:
  static Integrability integrability(const Field_elements<N>& elements, const Melt_and_freeze_schedule& schedule,
                                     double target_attraction)
  {
    Integrability energy(elements, schedule.final_epsilon);
    energy.set_target_attraction(target_attraction);
    if constexpr (N == 5)
      energy.set_grading_attraction(schedule.grading_attraction);
    return energy;
  }

  /// The schedule of planar-1, algorithm 1.
  void minimize_kappa(Eigen::VectorXd& x, const std::vector<double>& kappas)
  {
    Kappa_energy<N> energy(m_elements, m_schedule.final_epsilon, 1);
    Element_least_squares<Kappa_energy<N>> problem(energy, m_integrable_problem, m_integrable_problem.threads());
    for (const double kappa : kappas) {
      energy.set_kappa(kappa);
      this->minimize(problem, x, {});
    }
  }

  Eigen::VectorXd harmonic_field(Element_least_squares<Smoothness>& problem)
  {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(Eigen::Index(m_elements.number_of_unknowns()));
    // E_odeco needs a positive area, so the Dirichlet energy alone gives the start. It is quadratic: with a huge
    // epsilon one Gauss-Newton step from any feasible point reaches its minimum.
    const Coefficients uniform = Tensor_coefficients<N>::from_harmonics(odeco_harmonics({}));
    for (std::size_t v = 0; v < m_elements.number_of_nodes(); ++v)
      m_elements.assign_coefficients(v, uniform, x);
    m_smoothness.set_relative_epsilon(1e6);
    Levenberg_marquardt_options options;
    options.max_iterations = 10;
    options.initial_damping = 1e-6;
    options.relative_decrease = 1e-4;
    this->minimize(problem, x, options);
    m_smoothness.set_relative_epsilon(m_schedule.smooth_epsilon);
    return x;
  }

  using Base::m_elements;
  using Base::m_integrable_problem;
  using Base::m_kind;
  using Base::m_schedule;
  Smoothness m_smoothness;
};

} // namespace internal
} // namespace Quadrille

#endif
