// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// A sum of squares over small elements, minimised two ways.

#include <Quadrille/Element_least_squares.h>
#include <Quadrille/minimize_least_squares.h>

#include <iostream>

// A model of LeastSquaresTerm: a chain of Rosenbrock functions, element e joins the unknowns e and e + 1.
struct Rosenbrock_chain {
  static constexpr int max_residuals = 2;
  static constexpr int max_unknowns = 2;
  using Unknowns = Eigen::Vector2d;
  using Residuals = Eigen::Vector2d;
  using Jacobian = Eigen::Matrix2d;

  std::size_t number_of_elements() const { return 999; }
  int element_unknowns(std::size_t e, std::array<int, 2>& index) const
  {
    index = {int(e), int(e) + 1};
    return 2;
  }
  bool evaluate(std::size_t, const Unknowns& x, Residuals& r, Jacobian* J) const
  {
    r << 10 * (x[1] - x[0] * x[0]), 1 - x[0];
    if (J)
      *J << -20 * x[0], 10, -1, 0;
    return true;
  }
};

int main()
{
  const Rosenbrock_chain chain;
  Quadrille::Element_least_squares<Rosenbrock_chain> problem(chain, 1000);

  Eigen::VectorXd x = Eigen::VectorXd::Constant(1000, 0.5);
  const auto newton = Quadrille::minimize_levenberg_marquardt(problem, x);
  std::cout << "Levenberg-Marquardt: energy " << newton.energy << " after " << newton.iterations << " steps\n";

  x.setConstant(0.5);
  const auto lbfgs = Quadrille::minimize_preconditioned_lbfgs(problem, x);
  std::cout << "preconditioned L-BFGS: energy " << lbfgs.energy << " after " << lbfgs.iterations << " iterations and "
            << lbfgs.factorizations << " factorisations\n";
  return newton.energy < 1e-6 ? 0 : 1;
}
