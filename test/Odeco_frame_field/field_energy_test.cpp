// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "energy_checks.h"
#include "field_test_meshes.h"

#include <Quadrille/check_jacobian.h>

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace Quadrille;
using namespace Quadrille::internal;
using namespace Quadrille_test;

template <int N> Field_elements<N> free_elements(const Triangles& triangles)
{
  return Field_elements<N>(triangles.indexed(), triangles.points, std::vector<double>(triangles.faces.size(), 1),
                           std::vector<Vertex_restriction<N>>(triangles.points.size()),
                           std::vector<double>(triangles.points.size(), 0.1));
}

/// The unknowns of a field without constraints that samples `frame` at the vertices.
template <int N>
Eigen::VectorXd sample(const Field_elements<N>& elements, const Triangles& triangles,
                       const std::function<Orthogonal_frame_2(const Eigen::Vector2d&)>& frame)
{
  Eigen::VectorXd x(Eigen::Index(elements.number_of_unknowns()));
  for (std::size_t v = 0; v < triangles.points.size(); ++v)
    elements.assign_coefficients(v, Tensor_coefficients<N>::from_harmonics(odeco_harmonics(frame(triangles.points[v]))),
                                 x);
  return x;
}

/// Jacobians on two triangles against finite differences. `make_energy(elements)` gives the term.
template <int N, class Make_energy> void expect_right_derivatives(const Make_energy& make_energy)
{
  Triangles triangles = square(1, 1);
  triangles.points[0] += Eigen::Vector2d(0.1, -0.2);
  std::vector<Vertex_restriction<N>> restrictions(4);
  // One vertex with a restriction of each kind: fixed, one unknown, N - 1 unknowns, free.
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int v = 0; v < 3; ++v) {
    restrictions[std::size_t(v)].is_free = false;
    restrictions[std::size_t(v)].dimension = v == 0 ? 0 : v == 1 ? 1 : N - 1;
    restrictions[std::size_t(v)].offset = Eigen::Matrix<double, N, 1>::Unit(0) * 3;
    restrictions[std::size_t(v)].basis = Eigen::Matrix<double, N, N>::NullaryExpr([&] { return uniform(engine); });
  }
  Vertex_targets targets{{1, 0.5, 0, 1}, {4, Metric_residual::Zero()}};
  for (const std::size_t v : {0, 2, 3})
    targets.metric[v] = Metric_residual::NullaryExpr([&] { return uniform(engine); });
  const Field_elements<N> elements(triangles.indexed(), triangles.points, {0.7, 0.9}, restrictions, {0.1, -0.2, 0.3, 0},
                                   targets);
  const auto energy = make_energy(elements);
  for (int repeat = 0; repeat < 10; ++repeat) {
    std::vector<Eigen::Matrix<double, 3 * N, 1>> unknowns;
    for (std::size_t e = 0; e < 2; ++e) {
      Eigen::Matrix<double, 3 * N, 1> x;
      std::array<int, std::size_t(3 * N)> index;
      const int count = energy.element_unknowns(e, index);
      x.setZero();
      for (int i = 0; i < count; ++i)
        x[i] = 0.3 * uniform(engine) + (index[std::size_t(i)] == elements.first_unknown(3) ? 3 : 0);
      EXPECT_LT(jacobian_error(energy, e, x), 1e-7);
      unknowns.push_back(x);
    }
    expect_equal_batches(energy, unknowns);
  }
}

template <int N, Field_energy_kind kind> Field_energy<N, kind> attracted_energy(const Field_elements<N>& elements)
{
  Field_energy<N, kind> energy(elements, 1.5);
  Melt_and_freeze_schedule schedule;
  schedule.size_attraction = 0.8;
  energy.attract(schedule);
  energy.set_target_attraction(0.6);
  energy.set_grading_attraction(0.4);
  return energy;
}

TEST(Field_energy, derivatives_agree_with_finite_differences)
{
  expect_right_derivatives<3>(attracted_energy<3, Field_energy_kind::smoothness>);
  expect_right_derivatives<3>(attracted_energy<3, Field_energy_kind::integrability>);
  expect_right_derivatives<5>(attracted_energy<5, Field_energy_kind::smoothness>);
  expect_right_derivatives<5>(attracted_energy<5, Field_energy_kind::integrability>);
}

TEST(Kappa_energy, derivatives_agree_with_finite_differences)
{
  for (const double kappa : {1.0, 0.1, 0.0}) {
    expect_right_derivatives<3>([&](const auto& elements) { return Kappa_energy<3>(elements, 1.5, kappa); });
    expect_right_derivatives<5>([&](const auto& elements) { return Kappa_energy<5>(elements, 1.5, kappa); });
  }
}

template <class Term> double total_energy(const Term& term, const Eigen::VectorXd& x)
{
  return Element_least_squares<Term>(term, std::size_t(x.size())).energy(x);
}

TEST(Kappa_energy, is_the_weighted_sum_of_its_three_terms)
{
  const Triangles triangles = square(6, 1);
  const auto elements = free_elements<5>(triangles);
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  Eigen::VectorXd x = sample<5>(elements, triangles, [](const Eigen::Vector2d&) { return Orthogonal_frame_2(); });
  for (double& value : x)
    value += uniform(engine);

  // Its parts from the definitions: quadrature over the triangles, the Lie bracket as in planar-2's energy.
  double odeco = 0, dirichlet = 0;
  for (std::size_t e = 0; e < elements.number_of_elements(); ++e) {
    const auto& element = elements.element(e);
    Eigen::Matrix<double, 5, 3> q;
    for (int k = 0; k < 3; ++k)
      q.col(k) = elements.coefficients(std::size_t(element.vertex[std::size_t(k)]), x);
    dirichlet += 0.5 * element.area * (q * element.gradient.transpose()).squaredNorm();
    for (int p = 0; p < 3; ++p) {
      Eigen::Vector3d weights = Eigen::Vector3d::Constant(1. / 6);
      weights[p] = 2. / 3;
      odeco += element.area / 3 * odeco_residuals(q * weights).squaredNorm();
    }
  }
  const double lie =
      Field_solver<5>(elements, {}, 1, nullptr, Field_solver_kind::levenberg_marquardt).energy_parts(x).lie;
  const double epsilon = 0.7;
  for (const double kappa : {1.0, 0.3, 0.0}) {
    const double expected = (1 - kappa) * lie + kappa * dirichlet + odeco / (epsilon * epsilon);
    EXPECT_NEAR(total_energy(Kappa_energy<5>(elements, epsilon, kappa), x), expected, 1e-12 * expected);
  }
  // Tensors of zero, from where the paper starts, belong to its domain while kappa is 1.
  EXPECT_EQ(total_energy(Kappa_energy<5>(elements, epsilon, 1), Eigen::VectorXd::Zero(x.size())), 0);
  EXPECT_TRUE(std::isinf(total_energy(Kappa_energy<5>(elements, epsilon, 0.1), Eigen::VectorXd::Zero(x.size()))));
}

TEST(Field_energy, lie_residual_is_the_lie_bracket_of_the_frame)
{
  // Any smooth frame: its bracket [u, v] = (Dv) u - (Du) v by finite differences, against the residual of a tiny
  // triangle, which is sqrt(2/3 area) Lie / area of the frame.
  const auto frame = [](const Eigen::Vector2d& p) {
    const double t = 0.4 + p.x() - 0.7 * p.y();
    return Orthogonal_frame_2{{std::cos(t), std::sin(t)}, 1 + 0.5 * p.x() * p.y(), 2 - 0.3 * p.y()};
  };
  const auto u = [&](const Eigen::Vector2d& p) { return Eigen::Vector2d(frame(p).size_u * frame(p).direction); };
  const auto v = [&](const Eigen::Vector2d& p) { return Eigen::Vector2d(frame(p).size_v * frame(p).normal()); };
  const auto derivative = [](const auto& f, const Eigen::Vector2d& p, const Eigen::Vector2d& d) {
    const double h = 1e-5;
    return Eigen::Vector2d((f(p + h * d) - f(p - h * d)) / (2 * h));
  };
  const Eigen::Vector2d p(0.3, 0.8);
  const Eigen::Vector2d bracket = derivative(v, p, u(p)) - derivative(u, p, v(p));

  const double size = 1e-4;
  Triangles triangle;
  for (int i = 0; i < 3; ++i)
    triangle.points.push_back(p + size * Eigen::Vector2d(std::cos(2.1 * i), std::sin(2.1 * i)));
  triangle.faces = {{0, 1, 2}};
  const auto elements = free_elements<5>(triangle);
  const Field_energy<5, Field_energy_kind::integrability> energy(elements, 1);
  using Energy = Field_energy<5, Field_energy_kind::integrability>;
  Energy::Unknowns x = sample<5>(elements, triangle, frame);
  Energy::Residuals r;
  ASSERT_TRUE(energy.evaluate(0, x, r, nullptr));
  const double factor = std::sqrt(2. / 3 * elements.element(0).area) / (frame(p).size_u * frame(p).size_v);
  for (int point = 0; point < 3; ++point)
    EXPECT_LT((r.segment<2>(2 * point) / factor - bracket).norm(), 1e-3);
  EXPECT_GT(bracket.norm(), 0.5);
}

template <int N>
double lie_energy(const Triangles& triangles, const std::function<Orthogonal_frame_2(const Eigen::Vector2d&)>& frame)
{
  const auto elements = free_elements<N>(triangles);
  Field_solver<N> solver(elements, {}, 1, nullptr, Field_solver_kind::levenberg_marquardt);
  return solver.energy_parts(sample<N>(elements, triangles, frame)).lie;
}

TEST(Lie_energy, vanishes_with_refinement_on_integrable_fields)
{
  // Polar coordinates with sizes proportional to the radius (the map log z), and an anisotropic graded rectangle.
  const auto polar = [](const Eigen::Vector2d& p) { return Orthogonal_frame_2{p.normalized(), p.norm(), p.norm()}; };
  const auto graded = [](const Eigen::Vector2d& p) {
    return Orthogonal_frame_2{Eigen::Vector2d::UnitX(), 1 + p.x(), 1 + 2 * p.y()};
  };
  double last_polar = 1e300, last_graded = 1e300;
  for (const int n : {8, 16, 32}) {
    const Triangles sector =
        grid(n, n, [](double s, double t) { return Eigen::Vector2d((1 + s) * std::cos(t), (1 + s) * std::sin(t)); });
    const double polar_energy = lie_energy<3>(sector, polar);
    EXPECT_LT(polar_energy, last_polar / 3); // first order in the gradient, so second order in the energy
    last_polar = polar_energy;
    // Sizes are linear along the axes, so linear triangles represent this field exactly.
    last_graded = lie_energy<5>(square(n, 1), graded);
    EXPECT_LT(last_graded, 1e-20);
  }
  EXPECT_GT(lie_energy<3>(square(16, 1),
                          [](const Eigen::Vector2d& p) {
                            return Orthogonal_frame_2{Eigen::Vector2d::UnitX(), 1 + p.x(), 1 + p.x()};
                          }),
            0.1);
}

TEST(Lie_energy, does_not_depend_on_sizes_scale_or_turn)
{
  const auto frame = [](double angle, double scale, double size) {
    return [=](const Eigen::Vector2d& p) {
      const Eigen::Vector2d q = Eigen::Rotation2Dd(-angle) * p / scale;
      const double t = angle + q.x();
      return Orthogonal_frame_2{{std::cos(t), std::sin(t)}, size * (1 + q.y()), size * (1 + q.y())};
    };
  };
  const Triangles plain = square(8, 1);
  Triangles moved = plain;
  for (Eigen::Vector2d& p : moved.points)
    p = Eigen::Rotation2Dd(0.3) * p * 1e8;
  const double energy = lie_energy<3>(plain, frame(0, 1, 1));
  EXPECT_NEAR(lie_energy<3>(moved, frame(0.3, 1e8, 1e-8)), energy, 1e-6 * energy);
}

TEST(Lie_energy, converges_around_exact_singularities)
{
  // The integrable frames of planar-2, eq. (34): sizes r^i, angle i t, for index i = 1/4 (valence 3) and -1/4 (5).
  for (const double index : {0.25, -0.25}) {
    std::vector<double> energies;
    for (const int rings : {4, 8, 16, 32, 64}) {
      const Triangles triangles = disk(rings);
      energies.push_back(lie_energy<3>(triangles, [&](const Eigen::Vector2d& p) {
        const double t = index * std::atan2(p.y(), p.x());
        // At the singularity itself: the isotropic tensor of the mean of its neighbours is what a solver finds.
        const double r = std::max(p.norm(), 0.5 / rings);
        return Orthogonal_frame_2{{std::cos(t), std::sin(t)}, std::pow(r, index), std::pow(r, index)};
      }));
    }
    for (std::size_t i = 2; i < energies.size(); ++i)
      EXPECT_LT(std::abs(energies[i] - energies[i - 1]), 0.6 * std::abs(energies[i - 1] - energies[i - 2]));
    EXPECT_LT(std::abs(energies[4] - energies[3]), 0.02 * energies[4]);
    RecordProperty(index > 0 ? "valence_3" : "valence_5", std::to_string(energies.back()));
  }
}

} // namespace
