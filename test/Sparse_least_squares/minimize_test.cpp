// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Element_least_squares.h>
#include <Quadrille/check_jacobian.h>
#include <Quadrille/minimize_lbfgs.h>
#include <Quadrille/minimize_least_squares.h>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

namespace {

using namespace Quadrille;

/// A chain of Rosenbrock's functions: minimum 0 at (1, ..., 1). `slope_error` spoils the Jacobian on purpose.
struct Rosenbrock_chain {
  static constexpr int max_residuals = 2;
  static constexpr int max_unknowns = 2;
  using Unknowns = Eigen::Vector2d;
  using Residuals = Eigen::Vector2d;
  using Jacobian = Eigen::Matrix2d;
  std::size_t n = 2;
  double slope_error = 0;

  std::size_t number_of_elements() const { return n - 1; }
  int element_unknowns(std::size_t e, std::array<int, 2>& index) const
  {
    index = {int(e), int(e) + 1};
    return 2;
  }
  bool evaluate(std::size_t, const Unknowns& x, Residuals& r, Jacobian* J) const
  {
    r << 10 * (x[1] - x[0] * x[0]), 1 - x[0];
    if (J)
      *J << -20 * x[0] + slope_error, 10, -1, 0;
    return true;
  }
};

/// Rosenbrock's function in turned coordinates.
struct Turned_rosenbrock {
  static constexpr int max_residuals = 2;
  static constexpr int max_unknowns = 2;
  using Unknowns = Eigen::Vector2d;
  using Residuals = Eigen::Vector2d;
  using Jacobian = Eigen::Matrix2d;
  double angle = 0;

  std::size_t number_of_elements() const { return 1; }
  int element_unknowns(std::size_t, std::array<int, 2>& index) const
  {
    index = {0, 1};
    return 2;
  }
  bool evaluate(std::size_t, const Unknowns& y, Residuals& r, Jacobian* J) const
  {
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(-angle).toRotationMatrix();
    const Eigen::Vector2d x = turn * y;
    r << 10 * (x[1] - x[0] * x[0]), 1 - x[0];
    if (J)
      *J = (Eigen::Matrix2d() << -20 * x[0], 10, -1, 0).finished() * turn;
    return true;
  }
};

/// (log x - 1)^2, defined for positive x only.
struct Logarithm {
  static constexpr int max_residuals = 1;
  static constexpr int max_unknowns = 1;
  using Unknowns = Eigen::Matrix<double, 1, 1>;
  using Residuals = Eigen::Matrix<double, 1, 1>;
  using Jacobian = Eigen::Matrix<double, 1, 1>;
  std::size_t number_of_elements() const { return 1; }
  int element_unknowns(std::size_t, std::array<int, 1>& index) const
  {
    index[0] = 0;
    return 1;
  }
  bool evaluate(std::size_t, const Unknowns& x, Residuals& r, Jacobian* J) const
  {
    if (!(x[0] > 0))
      return false;
    r[0] = std::log(x[0]) - 1;
    if (J)
      (*J)(0, 0) = 1 / x[0];
    return true;
  }
};

TEST(Jacobian_error, accepts_the_right_and_rejects_a_wrong_jacobian)
{
  const Eigen::Vector2d x(0.3, -0.7);
  EXPECT_LT(jacobian_error(Rosenbrock_chain(), 0, x), 1e-8);
  EXPECT_GT(jacobian_error(Rosenbrock_chain{2, 0.1}, 0, x), 1e-3);
  EXPECT_TRUE(std::isinf(jacobian_error(Logarithm(), 0, Logarithm::Unknowns(-1.0))));
}

TEST(Element_least_squares, assembles_gradient_and_gauss_newton_matrix)
{
  const Rosenbrock_chain chain{6};
  Element_least_squares<Rosenbrock_chain> problem(chain, 6);
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(6, -1, 1.5);
  const double energy = problem.linearize(x);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(10, 6);
  Eigen::VectorXd r(10);
  for (int e = 0; e < 5; ++e) {
    Eigen::Vector2d local_r;
    Eigen::Matrix2d local_J;
    chain.evaluate(std::size_t(e), x.segment<2>(e), local_r, &local_J);
    r.segment<2>(2 * e) = local_r;
    J.block<2, 2>(2 * e, e) = local_J;
  }
  EXPECT_NEAR(energy, 0.5 * r.squaredNorm(), 1e-12 * energy);
  EXPECT_LT((problem.gradient() - J.transpose() * r).norm(), 1e-10);
  const Eigen::MatrixXd lower = (J.transpose() * J).triangularView<Eigen::Lower>();
  EXPECT_LT((Eigen::MatrixXd(problem.gauss_newton_matrix()) - lower).norm(), 1e-10);
  EXPECT_EQ(problem.energy(x), energy);
}

template <class Minimize> void expect_rosenbrock_minimum(const Minimize& minimize)
{
  const Rosenbrock_chain chain{50};
  Element_least_squares<Rosenbrock_chain> problem(chain, 50);
  Eigen::VectorXd x = Eigen::VectorXd::Constant(50, -0.5);
  const Minimization_report report = minimize(problem, x);
  EXPECT_LT((x - Eigen::VectorXd::Ones(50)).norm(), 1e-3);
  EXPECT_LT(report.energy, 1e-6 * report.initial_energy);
  EXPECT_EQ(report.energy, problem.energy(x));
}

TEST(Minimizers, agree_on_the_minimum)
{
  using Problem = Element_least_squares<Rosenbrock_chain>;
  expect_rosenbrock_minimum([](Problem& problem, Eigen::VectorXd& x) {
    Levenberg_marquardt_options options;
    options.max_iterations = 1000;
    return minimize_levenberg_marquardt(problem, x, options);
  });
  expect_rosenbrock_minimum([](Problem& problem, Eigen::VectorXd& x) {
    Preconditioned_lbfgs_options options;
    options.max_iterations = 5000;
    options.relative_decrease = 1e-12;
    return minimize_preconditioned_lbfgs(problem, x, options);
  });
#ifdef QUADRILLE_WITH_ALGLIB
  expect_rosenbrock_minimum([](Problem& problem, Eigen::VectorXd& x) {
    Lbfgs_options options;
    options.relative_decrease = 1e-12;
    return minimize_lbfgs(problem, x, options);
  });
#endif
}

TEST(Levenberg_marquardt, solves_linear_problems_in_one_undamped_step)
{
  struct Line : Logarithm {
    bool evaluate(std::size_t, const Unknowns& x, Residuals& r, Jacobian* J) const
    {
      r[0] = 3 * x[0] - 6;
      if (J)
        (*J)(0, 0) = 3;
      return true;
    }
  } line;
  Element_least_squares<Line> problem(line, 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(1);
  Levenberg_marquardt_options options;
  options.initial_damping = 0;
  options.max_iterations = 1;
  minimize_levenberg_marquardt(problem, x, options);
  EXPECT_NEAR(x[0], 2, 1e-14);
}

TEST(Levenberg_marquardt, grouped_unknowns_make_steps_independent_of_the_axes)
{
  const auto after_three_steps = [](double angle, std::vector<int> groups) -> Eigen::Vector2d {
    const Turned_rosenbrock term{angle};
    Element_least_squares<Turned_rosenbrock> problem(term, 2);
    Levenberg_marquardt_options options;
    options.max_iterations = 3;
    options.max_reuses = 0;
    options.initial_damping = 0.1;
    options.groups = std::move(groups);
    Eigen::VectorXd x = Eigen::Rotation2Dd(angle) * Eigen::Vector2d(-1.2, 1);
    minimize_levenberg_marquardt(problem, x, options);
    return Eigen::Rotation2Dd(-angle) * Eigen::Vector2d(x);
  };
  EXPECT_LT((after_three_steps(0.7, {2}) - after_three_steps(0, {2})).norm(), 1e-12);
  EXPECT_GT((after_three_steps(0.7, {}) - after_three_steps(0, {})).norm(), 1e-3);
}

TEST(Levenberg_marquardt, stays_inside_the_domain)
{
  const Logarithm term;
  Element_least_squares<Logarithm> problem(term, 1);
  Eigen::VectorXd x(1);
  x[0] = 100; // the full first step leads to a negative x
  minimize_levenberg_marquardt(problem, x);
  EXPECT_NEAR(x[0], std::exp(1.0), 1e-6);
  x[0] = -1;
  EXPECT_EQ(minimize_levenberg_marquardt(problem, x).status, Minimization_status::outside_domain);
}

TEST(Levenberg_marquardt, reuses_factors_and_records_what_it_does)
{
  const Rosenbrock_chain chain{200};
  Element_least_squares<Rosenbrock_chain> problem(chain, 200);
  Minimization_report reports[2];
  for (const int max_reuses : {0, 10}) {
    Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(200, 0.5, 1.5);
    Levenberg_marquardt_options options;
    options.max_iterations = 1000;
    options.max_reuses = max_reuses;
    options.record_history = true;
    Minimization_report& report = reports[max_reuses > 0];
    report = minimize_levenberg_marquardt(problem, x, options);
    EXPECT_LT(report.energy, 1e-12);
    ASSERT_EQ(report.history.size(), std::size_t(1 + report.iterations + report.reuses));
    EXPECT_EQ(report.history.front().energy, report.initial_energy);
    EXPECT_EQ(report.history.back().energy, report.energy);
    for (std::size_t i = 1; i < report.history.size(); ++i) {
      EXPECT_LT(report.history[i].energy, report.history[i - 1].energy);
      EXPECT_GE(report.history[i].seconds, report.history[i - 1].seconds);
    }
  }
  EXPECT_EQ(reports[0].reuses, 0);
  EXPECT_GT(reports[1].reuses, 0);
  EXPECT_LT(reports[1].factorizations, reports[0].factorizations);
}

TEST(Element_least_squares, shares_the_pattern_of_another_problem)
{
  const Rosenbrock_chain chain{30}, other_chain{30, 0.5};
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(30, -1, 2);
  Element_least_squares<Rosenbrock_chain> own(chain, 30), other(other_chain, 30), sharing(chain, other);
  other.linearize(x);
  EXPECT_EQ(sharing.linearize(x), own.linearize(x));
  EXPECT_EQ(sharing.gradient(), own.gradient());
  EXPECT_EQ(Eigen::MatrixXd(sharing.gauss_newton_matrix()), Eigen::MatrixXd(own.gauss_newton_matrix()));
  EXPECT_NE(sharing.gradient(), other.gradient());
}

TEST(Element_least_squares, does_not_depend_on_the_number_of_threads)
{
  const Rosenbrock_chain chain{20000};
  Eigen::VectorXd start = Eigen::VectorXd::LinSpaced(20000, -1, 2), results[3];
  const int threads[3] = {1, 2, 4};
  for (int i = 0; i < 3; ++i) {
    Element_least_squares<Rosenbrock_chain> problem(chain, 20000, threads[i]);
    Levenberg_marquardt_options options;
    options.max_iterations = 5;
    results[i] = start;
    minimize_levenberg_marquardt(problem, results[i], options);
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

TEST(Minimizers, stop_when_the_observer_says_so)
{
  const Rosenbrock_chain chain{10};
  Element_least_squares<Rosenbrock_chain> problem(chain, 10);
  Eigen::VectorXd x = Eigen::VectorXd::Constant(10, -1);
  const Progress_observer observer([](const std::string&, double) { return false; });
  Levenberg_marquardt_options options;
  options.observer = &observer;
  EXPECT_THROW(minimize_levenberg_marquardt(problem, x, options), Cancelled_error);
}

} // namespace
