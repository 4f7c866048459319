// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_MELTING_SOLVER_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_MELTING_SOLVER_H

#include <Quadrille/Element_least_squares.h>
#include <Quadrille/Odeco_field_options.h>
#include <Quadrille/Odeco_frame_field/internal/Tensor_coefficients.h>
#include <Quadrille/minimize_lbfgs.h>
#include <Quadrille/minimize_least_squares.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Of every face the gradients (du, dv), in the basis of the face.
using Gradients = std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>;

/// Uniform numbers in [-1, 1) that are the same on every platform.
class Noise {
public:
  explicit Noise(std::uint64_t seed) : m_engine(seed) {}
  double operator()() { return std::ldexp(double(m_engine() >> 11), -52) - 1; }

private:
  std::mt19937_64 m_engine;
};

/// The schedule for a field of `n_triangles`: a singularity has to be soft over the same part of the domain however
/// fine the triangles are.
inline Melt_and_freeze_schedule melt_and_freeze_schedule_for(Melt_and_freeze_schedule schedule, std::size_t n_triangles)
{
  schedule.melt_epsilon *= std::max(1.0, std::sqrt(double(n_triangles) / 2500));
  return schedule;
}

/// Minimises the integrability energy of one field, in the plane or on a surface; every method starts from, and
/// returns, a vector of unknowns. `Energy` is a `Triangle_energy` with an epsilon, with attractions that lead
/// melted fields, and with the `final_decrease` of the energy per step, relative to it, at which a field is done.
template <class Energy> class Melting_solver {
public:
  using Elements = typename Energy::Field;
  using Coefficients = typename Elements::Coefficients;
  static constexpr int N = Elements::number_of_coefficients;

  Melting_solver(const Elements& elements, const Energy& energy, const Melt_and_freeze_schedule& schedule, int threads,
                 const Progress_observer* observer, Field_solver_kind kind)
      : m_elements(elements), m_schedule(schedule), m_observer(observer), m_kind(kind), m_integrability(energy),
        m_integrable_problem(m_integrability, elements.number_of_unknowns(), threads)
  {
#ifndef QUADRILLE_WITH_ALGLIB
    if (kind != Field_solver_kind::levenberg_marquardt)
      throw Invalid_argument_error("the L-BFGS reference solvers need ALGLIB, which this build does not have");
#endif
    if (elements.number_of_unknowns() > 0 && kind == Field_solver_kind::levenberg_marquardt)
      m_solver.analyze(m_integrable_problem.gauss_newton_matrix());
  }

  /// Another solver for the same field, to be used on another thread. The pattern and its analysis are shared, the
  /// factor, which takes most of the memory, is not.
  Melting_solver(const Melting_solver& other, int threads)
      : m_elements(other.m_elements), m_schedule(other.m_schedule), m_observer(other.m_observer), m_kind(other.m_kind),
        m_integrability(other.m_integrability),
        m_integrable_problem(m_integrability, other.m_integrable_problem, threads), m_solver(other.m_solver)
  {
  }

  /// From `smooth` and the noise of `seed` to a local minimum of E_integ at the final epsilon.
  ///
  /// How far a field should be melted differs: singularities that are softer go further and vanish more easily, harder
  /// ones find more of the places where the sizes need them. So every other seed melts twice as much.
  Eigen::VectorXd melt_and_freeze(const Eigen::VectorXd& smooth, std::uint64_t seed)
  {
    const double melt_epsilon = (seed % 2 == 0 ? 2 : 1) * m_schedule.melt_epsilon;
    Eigen::VectorXd x = perturbed(smooth, seed);
    m_integrability.set_relative_epsilon(melt_epsilon);
    m_integrability.attract(m_schedule);
    take_noise_out(x);
    settle(x);
    m_integrability.stop_attracting();
    Levenberg_marquardt_options options;
    options.max_iterations = m_schedule.freeze_steps;
    options.relative_decrease = 1e-3;
    for (double epsilon = melt_epsilon / m_schedule.freeze_ratio; epsilon > m_schedule.final_epsilon;
         epsilon /= m_schedule.freeze_ratio) {
      m_integrability.set_relative_epsilon(epsilon);
      minimize(m_integrable_problem, x, options);
    }
    integrate(x);
    return x;
  }

  /// From a field that is frozen where triangles are `ratio` times larger to a local minimum of E_integ at the final
  /// epsilon here.
  void sharpen(Eigen::VectorXd& x, double ratio)
  {
    m_integrability.stop_attracting();
    Levenberg_marquardt_options options;
    options.max_iterations = m_schedule.sharpen_steps;
    options.relative_decrease = 1e-2;
    for (double epsilon = ratio * m_schedule.final_epsilon; epsilon > m_schedule.final_epsilon; epsilon /= 2) {
      m_integrability.set_relative_epsilon(epsilon);
      minimize(m_integrable_problem, x, options);
    }
    integrate(x);
  }

  /// Minimises E_integ at the final epsilon.
  void integrate(Eigen::VectorXd& x)
  {
    m_integrability.set_relative_epsilon(m_schedule.final_epsilon);
    Levenberg_marquardt_options options;
    options.max_iterations = m_schedule.final_steps;
    options.relative_decrease = Energy::final_decrease;
    minimize(m_integrable_problem, x, options);
  }

  double integrability_energy(const Eigen::VectorXd& x) const { return m_integrable_problem.energy(x); }
  /// The papers' two parts of the integrability energy.
  struct Energy_parts {
    double lie = 0;   ///< E_Lie; planar-2, eq. (30); on surfaces that of the curl; surface, eq. (46)
    double odeco = 0; ///< E_odeco / epsilon^2; planar-2, eqs. (31), (33)
  };
  Energy_parts energy_parts(const Eigen::VectorXd& x) const
  {
    const auto energies = energy_by_rows<2>(x, {Energy::first_odeco, Energy::first_size});
    return {energies[0], energies[1]};
  }
  /// The energy by groups of rows, which end before the given ones. Infinite outside of the domain.
  template <std::size_t count>
  std::array<double, count> energy_by_rows(const Eigen::VectorXd& x, const std::array<int, count>& ends) const
  {
    std::array<double, count> energies{};
    std::array<int, std::size_t(Energy::max_unknowns)> index;
    for (std::size_t e = 0; e < m_integrability.number_of_elements(); ++e) {
      typename Energy::Unknowns local = Energy::Unknowns::Zero();
      const int n = m_integrability.element_unknowns(e, index);
      for (int i = 0; i < n; ++i)
        local[i] = x[index[std::size_t(i)]];
      typename Energy::Residuals residuals;
      if (!m_integrability.evaluate(e, local, residuals, nullptr)) {
        energies.fill(std::numeric_limits<double>::infinity());
        return energies;
      }
      int begin = 0;
      for (std::size_t i = 0; i < count; ++i) {
        for (; begin < ends[i]; ++begin)
          energies[i] += 0.5 * residuals[begin] * residuals[begin];
      }
    }
    return energies;
  }
  /// Accepted steps of all minimisations so far.
  int iterations() const { return m_iterations; }

protected:
  /// The energies have no unit; below this the frames are exact to about 1e-9.
  double negligible_energy() const { return 1e-18 * double(m_elements.number_of_elements()); }

  void take_noise_out(Eigen::VectorXd& x)
  {
    Levenberg_marquardt_options options;
    options.max_iterations = m_schedule.melt_steps;
    options.relative_decrease = 1e-5;
    minimize(m_integrable_problem, x, options);
  }

  /// Lets the singularities of a melted field find their places.
  void settle(Eigen::VectorXd& x)
  {
    Preconditioned_lbfgs_options soft;
    soft.max_iterations = m_schedule.soft_iterations;
    soft.relative_decrease = 1e-4;
    soft.negligible_energy = negligible_energy();
    soft.observer = m_observer;
    soft.stage = "field";
    if (x.size() > 0)
      m_iterations += minimize_preconditioned_lbfgs(m_integrable_problem, x, soft, &m_solver).iterations;
  }

  template <class Problem> void minimize(Problem& problem, Eigen::VectorXd& x, Levenberg_marquardt_options options)
  {
    if (x.size() == 0)
      return;
#ifdef QUADRILLE_WITH_ALGLIB
    if (m_kind != Field_solver_kind::levenberg_marquardt) {
      Lbfgs_options lbfgs;
      lbfgs.observer = m_observer;
      lbfgs.stage = "field";
      m_iterations += minimize_lbfgs(problem, x, lbfgs).iterations;
      return;
    }
#endif
    options.negligible_energy = negligible_energy();
    options.observer = m_observer;
    options.stage = "field";
    m_iterations += minimize_levenberg_marquardt(problem, x, options, &m_solver).iterations;
  }

private:
  Eigen::VectorXd perturbed(const Eigen::VectorXd& smooth, std::uint64_t seed) const
  {
    Eigen::VectorXd x = smooth;
    Noise noise(seed);
    for (std::size_t v = 0; v < m_elements.number_of_nodes(); ++v) {
      // The smooth field may have shrunk where its directions cancel; the expected sizes have not.
      Coefficients q = m_elements.coefficients(v, smooth);
      const double size = std::exp(m_elements.expected_log_value(v));
      q[0] = size * Tensor_coefficients<N>::from_harmonics(odeco_harmonics({}))[0];
      const double amplitude = m_schedule.noise * q[0];
      for (const int i : {0, Tensor_coefficients<N>::band4, Tensor_coefficients<N>::band4 + 1})
        q[i] += amplitude * noise();
      if constexpr (N == 5) // relative to the new q0, so that areas stay positive
        for (const int i : {1, 2})
          q[i] = 0.5 * m_schedule.noise * q[0] * noise();
      m_elements.assign_coefficients(v, q, x);
      if (!(Tensor_coefficients<N>::area(m_elements.coefficients(v, x)) > 0))
        m_elements.assign_coefficients(v, m_elements.coefficients(v, smooth), x);
    }
    return x;
  }

protected:
  const Elements& m_elements;
  Melt_and_freeze_schedule m_schedule;
  const Progress_observer* m_observer;
  Field_solver_kind m_kind;
  Energy m_integrability;
  Element_least_squares<Energy> m_integrable_problem;
  Cholesky_solver m_solver;
  int m_iterations = 0;
};

} // namespace internal
} // namespace Quadrille

#endif
