// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Seamless_parametrization/internal/Exact_elimination.h>
#include <Quadrille/Seamless_parametrization/internal/exact_map.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace {

using Quadrille::internal::Exact_elimination;
using Quadrille::internal::Linear_form;
using Quadrille::internal::Rational;

TEST(Signed_union_find, signs_along_long_chains)
{
  Quadrille::internal::Signed_union_find sets(1000);
  for (int i = 1; i < 1000; ++i)
    EXPECT_TRUE(sets.unite(i, i - 1, i % 3 == 0 ? -1 : 1));
  EXPECT_FALSE(sets.unite(17, 801, 1));
  int sign = 1;
  for (int i = 0; i < 1000; ++i) {
    if (i > 0 && i % 3 == 0)
      sign = -sign;
    EXPECT_EQ(sets.find(i).first, sets.find(0).first);
    EXPECT_EQ(sets.find(i).second * sets.find(0).second, sign);
  }
  EXPECT_EQ(sets.size_of_set(sets.find(5).first), 1000);
}

TEST(Exact_elimination, equal_and_opposite_variables)
{
  Exact_elimination elimination(std::vector<int>(4, 1));
  elimination.impose_zero({{0, 1}, {1, -1}}); // x0 = x1
  elimination.impose_zero({{1, 2}, {2, 2}});  // x1 = -x2
  elimination.solve();
  const Linear_form x0 = elimination.expression(0);
  const Linear_form x2 = elimination.expression(2);
  ASSERT_EQ(x0.size(), 1u);
  EXPECT_EQ(x0.begin()->first, x2.begin()->first);
  EXPECT_EQ(x0.begin()->second, -x2.begin()->second);
  EXPECT_EQ(elimination.expression(3), (Linear_form{{3, 1}}));
}

TEST(Exact_elimination, contradiction_of_signs_means_zero)
{
  Exact_elimination elimination(std::vector<int>(2, 1));
  elimination.impose_zero({{0, 1}, {1, -1}});
  elimination.impose_zero({{0, 1}, {1, 1}});
  elimination.solve();
  EXPECT_TRUE(elimination.expression(0).empty());
  EXPECT_TRUE(elimination.expression(1).empty());
}

TEST(Exact_elimination, quarter_turn_about_a_singular_vertex_needs_halves)
{
  // (x, y) = R (x, y) + (s, t): x + y = s, y - x = t. Rarely used x and y are expressed by s and t.
  Exact_elimination elimination({5, 5, 100, 100});
  elimination.impose_zero({{0, 1}, {1, 1}, {2, -1}});
  elimination.impose_zero({{1, 1}, {0, -1}, {3, -1}});
  elimination.solve();
  EXPECT_EQ(elimination.expression(0), (Linear_form{{2, Rational(1, 2)}, {3, Rational(-1, 2)}}));
  EXPECT_EQ(elimination.expression(1), (Linear_form{{2, Rational(1, 2)}, {3, Rational(1, 2)}}));
}

TEST(Exact_elimination, random_sparse_systems_are_solved_exactly)
{
  std::mt19937 generator(3);
  for (int run = 0; run < 30; ++run) {
    constexpr int n = 40;
    std::vector<Linear_form> equations;
    for (int e = 0; e < 25; ++e) {
      Linear_form form;
      const int terms = 2 + int(generator() % 3);
      for (int t = 0; t < terms; ++t)
        form[int(generator() % n)] = generator() % 2 ? 1 : -1;
      equations.push_back(form);
    }
    Exact_elimination elimination(std::vector<int>(n, 1));
    for (const Linear_form& form : equations)
      elimination.impose_zero(form);
    elimination.solve();
    std::set<int> free_variables;
    for (int i = 0; i < n; ++i)
      for (const auto& term : elimination.expression(i))
        free_variables.insert(term.first);
    EXPECT_GE(free_variables.size(), std::size_t(n) - equations.size());
    for (const int free : free_variables)
      EXPECT_EQ(elimination.expression(free), (Linear_form{{free, 1}}));
    for (const Linear_form& form : equations) {
      Linear_form value;
      for (const auto& [variable, coefficient] : form)
        Quadrille::internal::add_multiple(value, elimination.expression(variable), coefficient);
      EXPECT_TRUE(value.empty());
    }
  }
}

TEST(Exact_orientation, agrees_with_exact_predicates_on_nearly_collinear_points)
{
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;
  std::mt19937_64 generator(1);
  int degenerate = 0;
  for (int run = 0; run < 20000; ++run) {
    const auto coordinate = [&](std::uint64_t bits) { return double(generator() % (1ull << bits)); };
    const Eigen::Vector2d a(coordinate(44), coordinate(44));
    const Eigen::Vector2d step(coordinate(20) - 5e5, coordinate(20) - 5e5);
    const Eigen::Vector2d shift(coordinate(2) - 1.0, coordinate(2) - 1.0);
    const Eigen::Vector2d b = a + coordinate(22) * step;
    const Eigen::Vector2d c = a + coordinate(22) * step + (run % 2 ? shift : Eigen::Vector2d(0, 0));
    const int expected = int(CGAL::orientation(Point(a.x(), a.y()), Point(b.x(), b.y()), Point(c.x(), c.y())));
    EXPECT_EQ(Quadrille::internal::exact_orientation(a, b, c), expected);
    degenerate += expected == 0;
  }
  EXPECT_GT(degenerate, 5000);
}

} // namespace
