// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Cholesky_solver.h>

#include <gtest/gtest.h>

#include <random>
#include <thread>
#include <vector>

namespace {

using namespace Quadrille;
using Matrix = Eigen::SparseMatrix<double>;

/// The lower triangle of a random diagonally dominant matrix: a grid of side x side vertices with `block` unknowns each
/// (of the vertices divisible by 5 only one), coupled with their neighbours' unknowns.
Matrix grid_matrix(int side, int block, unsigned seed)
{
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<int> first{0};
  for (int v = 0; v < side * side; ++v)
    first.push_back(first.back() + (v % 5 == 0 ? 1 : block));
  std::vector<Eigen::Triplet<double>> entries;
  const auto couple = [&](int v, int w) {
    for (int i = first[std::size_t(v)]; i < first[std::size_t(v) + 1]; ++i)
      for (int j = first[std::size_t(w)]; j < first[std::size_t(w) + 1]; ++j)
        if (i >= j)
          entries.emplace_back(i, j, i == j ? 40 + uniform(engine) : uniform(engine));
  };
  for (int v = 0; v < side * side; ++v) {
    couple(v, v);
    if (v % side > 0)
      couple(v, v - 1);
    if (v >= side)
      couple(v, v - side);
  }
  Matrix lower(first.back(), first.back());
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

double residual(const Matrix& lower, const Eigen::VectorXd& x, const Eigen::VectorXd& b)
{
  return (lower.selfadjointView<Eigen::Lower>() * x - b).norm() / b.norm();
}

TEST(Cholesky_solver, solves_matrices_of_blocks_and_of_single_unknowns)
{
  for (const int block : {1, 3, 5})
    for (const int side : {1, 2, 7, 20}) {
      const Matrix lower = grid_matrix(side, block, 1);
      Cholesky_solver solver;
      solver.analyze(lower);
      ASSERT_TRUE(solver.factorize(lower));
      const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(lower.cols(), 1, 2);
      Eigen::VectorXd x;
      solver.solve(b, x);
      EXPECT_LT(residual(lower, x, b), 1e-14);
    }
}

TEST(Cholesky_solver, recovers_from_indefinite_matrices)
{
  const Matrix lower = grid_matrix(8, 3, 2);
  Matrix indefinite = lower;
  indefinite.coeffRef(20, 20) = -1;
  Cholesky_solver solver;
  solver.analyze(lower);
  EXPECT_FALSE(solver.factorize(indefinite));
  ASSERT_TRUE(solver.factorize(lower));
  EXPECT_FALSE(solver.factorize(indefinite));
  ASSERT_TRUE(solver.factorize(lower));
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(lower.cols());
  Eigen::VectorXd x;
  solver.solve(b, x);
  EXPECT_LT(residual(lower, x, b), 1e-14);
}

TEST(Cholesky_solver, analyses_another_pattern)
{
  Cholesky_solver solver;
  for (const int side : {9, 4, 12}) {
    const Matrix lower = grid_matrix(side, 3, 3);
    solver.analyze(lower);
    ASSERT_TRUE(solver.factorize(lower));
    const Eigen::VectorXd b = Eigen::VectorXd::Ones(lower.cols());
    Eigen::VectorXd x;
    solver.solve(b, x);
    EXPECT_LT(residual(lower, x, b), 1e-14);
  }
}

TEST(Cholesky_solver, copies_work_at_the_same_time_and_give_the_same_bits)
{
  Cholesky_solver analyzed;
  analyzed.analyze(grid_matrix(15, 3, 1));
  const Eigen::Index n = grid_matrix(15, 3, 1).cols();
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, 1, 2);
  std::vector<Eigen::VectorXd> expected(4), found(4);
  const auto solve = [&](unsigned i, Eigen::VectorXd& x) {
    Cholesky_solver solver(analyzed);
    EXPECT_TRUE(solver.factorize(grid_matrix(15, 3, i)));
    solver.solve(b, x);
  };
  for (unsigned i = 0; i < 4; ++i)
    solve(i, expected[i]);
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < 4; ++i)
    threads.emplace_back([&, i] { solve(i, found[i]); });
  for (std::thread& thread : threads)
    thread.join();
  for (unsigned i = 0; i < 4; ++i)
    EXPECT_EQ(found[i], expected[i]);
  EXPECT_NE(found[0], found[1]);
}

} // namespace
