// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_ENERGY_CHECKS_H
#define QUADRILLE_TEST_ENERGY_CHECKS_H

#include <Quadrille/Element_least_squares.h>

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace Quadrille_test {

/// Energies, gradients and Gauss-Newton matrices of batches against those of single elements' residuals and Jacobians.
/// Which others an element is evaluated with changes no bit.
template <class Term> void expect_equal_batches(const Term& term, const std::vector<typename Term::Unknowns>& x)
{
  using Quadrille::Detail;
  constexpr int n = Term::max_unknowns;
  using Contribution = Quadrille::Element_contribution<n>;
  std::vector<Contribution> results(x.size()), gradients(x.size());
  std::vector<Contribution> place(x.size()); // as above, since the order of sums may depend on the alignment
  ASSERT_TRUE(term.evaluate_batch(0, int(x.size()), x.data(), Detail::matrix, results.data()));
  ASSERT_TRUE(term.evaluate_batch(0, int(x.size()), x.data(), Detail::gradient, gradients.data()));
  std::array<int, std::size_t(n)> index;
  for (std::size_t e = 0; e < x.size(); ++e) {
    typename Term::Residuals r;
    typename Term::Jacobian J;
    ASSERT_TRUE(term.evaluate(e, x[e], r, &J));
    const int count = term.element_unknowns(e, index);
    const auto columns = J.leftCols(count);
    for (const Contribution* result : {&results[e], &gradients[e]}) {
      EXPECT_NEAR(result->energy, 0.5 * r.squaredNorm(), 1e-12 * r.squaredNorm());
      EXPECT_LT((result->gradient.head(count) - columns.transpose() * r).norm(), 1e-12 * J.norm() * r.norm());
    }
    const Eigen::MatrixXd matrix =
        results[e].matrix.topLeftCorner(count, count).template selfadjointView<Eigen::Lower>();
    EXPECT_LT((matrix - columns.transpose() * columns).norm(), 1e-12 * J.squaredNorm());
    Contribution& alone = place[e];
    ASSERT_TRUE(term.evaluate_batch(e, 1, &x[e], Detail::matrix, &alone));
    EXPECT_EQ(alone.energy, results[e].energy);
    EXPECT_EQ(alone.gradient.head(count), results[e].gradient.head(count));
    const Eigen::MatrixXd matrix_alone =
        alone.matrix.topLeftCorner(count, count).template selfadjointView<Eigen::Lower>();
    EXPECT_EQ(matrix_alone, matrix);
    ASSERT_TRUE(term.evaluate_batch(e, 1, &x[e], Detail::gradient, &alone));
    EXPECT_EQ(alone.energy, gradients[e].energy);
    EXPECT_EQ(alone.gradient.head(count), gradients[e].gradient.head(count));
    ASSERT_TRUE(term.evaluate_batch(e, 1, &x[e], Detail::energy, &alone));
    EXPECT_NEAR(alone.energy, results[e].energy, 1e-12 * r.squaredNorm());
  }
  std::vector<typename Term::Unknowns> outside = x;
  outside.back() *= -1;
  EXPECT_EQ(term.evaluate_batch(0, int(x.size()), outside.data(), Detail::gradient, results.data()),
            term.evaluate(x.size() - 1, outside.back(), *std::make_unique<typename Term::Residuals>(), nullptr));
}

} // namespace Quadrille_test

#endif
