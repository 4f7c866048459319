// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "extraction_helpers.h"
#include "grid_layout.h"

#include <Quadrille/Optimal_quantizer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

using namespace quad_extraction_test;
using Quadrille::Curve_count;
using Quadrille::Greedy_quantizer;
using Quadrille::Layout_kind;
using Quadrille::Length_constraints;
using Quadrille::Optimal_quantizer;
using Quadrille::Quantization;
using Quadrille::internal::extraction::Length_deviation;

namespace {

/// Tries all lengths of groups of arcs up to `most`.
double least_cost_by_trial(const Quad_layout& layout, int most)
{
  const Length_deviation deviation(layout);
  std::vector<int> of_group(std::size_t(deviation.number_of_groups()), 0);
  double best = std::numeric_limits<double>::infinity();
  const std::function<void(std::size_t)> try_from = [&](std::size_t g) {
    if (g < of_group.size()) {
      for (of_group[g] = 0; of_group[g] <= most; ++of_group[g])
        try_from(g + 1);
      return;
    }
    std::vector<int> lengths;
    for (int a = 0; a < int(layout.arcs.size()); ++a)
      lengths.push_back(of_group[std::size_t(deviation.group(a))]);
    if (!Quadrille::internal::extraction::is_consistent(layout, lengths))
      return;
    const double cost = deviation.cost(lengths);
    if (cost < best && Length_constraints(layout).learn(lengths))
      best = cost;
  };
  try_from(0);
  return best;
}

Quantization solve(const Quad_layout& layout, Length_constraints& constraints)
{
  Optimal_quantizer::Options options;
  options.gap = 0;
  return Optimal_quantizer(options)(layout, constraints);
}

std::string error_of(const std::function<void()>& f)
{
  try {
    f();
  } catch (const Quadrille::Error& error) {
    return error.what();
  }
  return "";
}

/// A rectangle whose sides are the curves 1 (below), 4 (left), 3 + 4 = 7 (right), 10 (above).
Glued_rectangles rectangle(double width, double height)
{
  Glued_rectangles domain = cell_grid(1, 1);
  domain.length = [=](int a, int b) { return std::abs(a - b) == 1 ? width : height; };
  domain.curve = [](int a, int b, bool) { return a + b == 1 ? 1 : a + b == 2 ? 4 : a + b == 4 ? 7 : 10; };
  return domain;
}

int edges_on(const Extracted& extracted, int curve)
{
  int n = 0;
  for (const auto& edge : extracted.result.curve_edges)
    n += edge.curve == curve ? 1 : 0;
  return n;
}

} // namespace

class Optimal : public testing::Test {
protected:
  void SetUp() override
  {
    if (!Optimal_quantizer::is_available())
      GTEST_SKIP() << "built without CBC";
  }
};

TEST_F(Optimal, finds_the_optimum_of_small_grids)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> size(0.05, 1.6);
  for (int run = 0; run < 12; ++run) {
    std::vector<double> widths(4), heights(3);
    for (double& w : widths)
      w = size(random);
    for (double& h : heights)
      h = size(random);
    Quad_layout layout = grid_layout(widths, heights);
    layout.nodes[6].critical = run % 2; // an inner one, and another one diagonally beside it
    layout.nodes[12].critical = run % 2;
    Length_constraints constraints(layout);
    const Quantization result = solve(layout, constraints);
    const double cost = Length_deviation(layout).cost(result.lengths);
    EXPECT_NEAR(cost, least_cost_by_trial(layout, 3), 1e-9) << run;
    EXPECT_LE(result.lower_bound, cost + 1e-9);
    EXPECT_NEAR(result.lower_bound, cost, 1e-6 * (1 + cost));
    Length_constraints greedily(layout);
    EXPECT_GE(Length_deviation(layout).cost(Greedy_quantizer()(layout, greedily).lengths), cost - 1e-9);
    EXPECT_LE(Quadrille::quantization_bound(layout, constraints), cost + 1e-9);
  }
}

TEST_F(Optimal, finds_the_optimum_of_small_t_meshes)
{
  Glued_rectangles domain = cell_grid(3, 3, [](int i, int j) { return (i != 0 || j != 0) && (i != 2 || j != 2); });
  std::mt19937 random(5);
  std::uniform_real_distribution<double> size(0.2, 1.8);
  int with_several_arcs = 0;
  for (int run = 0; run < 6; ++run) {
    std::array<double, 6> l;
    for (double& x : l)
      x = size(random);
    domain.length = [l](int a, int b) {
      return std::abs(a - b) == 1 ? l[std::size_t(std::min(a, b) % 4)] : l[std::size_t(3 + std::min(a, b) / 4)];
    };
    const Traced traced(domain.build(), Layout_kind::t_mesh);
    for (const Quad_layout::Patch& patch : traced.layout.patches)
      for (const auto& side : patch.sides)
        with_several_arcs += side.size() > 1 ? 1 : 0;
    Length_constraints constraints(traced.layout);
    const Quantization result = solve(traced.layout, constraints);
    EXPECT_NEAR(Length_deviation(traced.layout).cost(result.lengths), least_cost_by_trial(traced.layout, 3), 1e-9);
  }
  EXPECT_GT(with_several_arcs, 0);
}

TEST_F(Optimal, random_domains_are_valid_and_not_worse_than_greedy)
{
  for (const Layout_kind layout : {Layout_kind::base_complex, Layout_kind::t_mesh})
    for (unsigned seed = 0; seed < 30; ++seed) {
      SCOPED_TRACE(seed);
      const Mapped_mesh mesh = random_domain(seed).build();
      Quadrille::Quad_extraction_options options;
      options.layout = layout;
      const Extracted optimal = extract(mesh, options, Optimal_quantizer());
      EXPECT_TRUE(has_convex_quads(optimal.quads));
      const Traced traced(mesh);
      EXPECT_EQ(euler_characteristic(optimal.quads), traced.triangulation.euler_characteristic());
      EXPECT_LE(optimal.result.quantization.optimality_gap, 2e-3);
      if (optimal.result.refinements > 0)
        continue;
      const Extracted greedy = extract(mesh, options, Greedy_quantizer());
      EXPECT_LE(optimal.result.quantization.cost, greedy.result.quantization.cost * (1 + 2e-3));
      EXPECT_GE(greedy.result.quantization.optimality_gap, 0);
    }
}

TEST_F(Optimal, the_same_again)
{
  const Mapped_mesh mesh = random_domain(4).build();
  Quadrille::Quad_extraction_options options;
  options.layout = Layout_kind::t_mesh;
  const Extracted first = extract(mesh, options, Optimal_quantizer());
  options.threads = 4;
  EXPECT_EQ(first.result.quantization.lengths, extract(mesh, options, Optimal_quantizer()).result.quantization.lengths);
}

TEST_F(Optimal, keeps_greedy_lengths_at_its_limits)
{
  const Quad_layout layout = grid_layout({1.2, 0.3, 2.2}, {3.0});
  Length_constraints greedily(layout);
  const std::vector<int> expected = Greedy_quantizer()(layout, greedily).lengths;
  for (const char* limit : {"work", "time"}) {
    Optimal_quantizer::Options options;
    (limit == std::string("work") ? options.work_limit : options.time_limit) = 0;
    Length_constraints constraints(layout);
    const Quantization result = Optimal_quantizer(options)(layout, constraints);
    EXPECT_EQ(result.lengths, expected);
    EXPECT_NE(result.note.find(std::string("limit of ") + limit), std::string::npos);
  }
}

TEST_F(Optimal, admissible_and_the_same_wherever_the_work_ends)
{
  const Traced traced(random_domain(7).build());
  double last_cost = std::numeric_limits<double>::infinity();
  for (const double work : {0.0, 2e4, 4e4, 8e4, 5e7}) {
    SCOPED_TRACE(work);
    Optimal_quantizer::Options options;
    options.work_limit = work;
    const auto run = [&] {
      Length_constraints constraints(traced.layout);
      const Quantization result = Optimal_quantizer(options)(traced.layout, constraints);
      EXPECT_TRUE(constraints.learn(result.lengths));
      return result;
    };
    const Quantization result = run();
    EXPECT_EQ(run().lengths, result.lengths);
    const double cost = Length_deviation(traced.layout).cost(result.lengths);
    EXPECT_LE(cost, last_cost);
    last_cost = cost;
  }
}

TEST(Counts, are_met_exactly)
{
  for (const int count : {3, 9, 20}) {
    Quadrille::Quad_extraction_options options;
    options.counts = {{{7}, count, ""}};
    const Extracted extracted = extract(rectangle(6.8, 3.3).build(), options);
    EXPECT_EQ(edges_on(extracted, 7), count);
    EXPECT_EQ(edges_on(extracted, 4), count);
    EXPECT_TRUE(has_convex_quads(extracted.quads));
  }
  // On several curves, together and apart, and on parts of a layout's strips.
  Quadrille::Quad_extraction_options options;
  options.counts = {{{1, 10}, 16, ""}, {{4}, 5, ""}};
  const Extracted extracted = extract(rectangle(6.8, 3.3).build(), options);
  EXPECT_EQ(edges_on(extracted, 1) + edges_on(extracted, 10), 16);
  EXPECT_EQ(edges_on(extracted, 4), 5);
}

TEST_F(Optimal, counts_of_random_domains)
{
  // Whatever comes out without a request, plus 2 or 4 on the whole border, is possible: two more quads along a strip.
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const Mapped_mesh mesh = random_domain(seed).build();
    Quadrille::Quad_extraction_options options;
    options.layout = Layout_kind::t_mesh;
    options.max_refinements = 0;
    options.smooth = false;
    const int free = edges_on(extract(mesh, options, Optimal_quantizer()), 0);
    for (const int more : {2, 4}) {
      options.counts = {{{0}, free + more, ""}};
      EXPECT_EQ(edges_on(extract(mesh, options, Optimal_quantizer()), 0), free + more);
    }
  }
}

TEST_F(Optimal, impossible_counts_are_named)
{
  const auto request = [](std::vector<Curve_count> counts) {
    Quadrille::Quad_extraction_options options;
    options.counts = std::move(counts);
    return error_of([&] { extract(rectangle(6.8, 3.3).build(), options, Optimal_quantizer()); });
  };
  const std::string opposite = request({{{4}, 3, "left"}, {{1}, 9, "below"}, {{10}, 8, "above"}});
  EXPECT_NE(opposite.find("9 on below, 8 on above"), std::string::npos) << opposite;
  EXPECT_EQ(opposite.find("left"), std::string::npos) << opposite;
  EXPECT_NE(opposite.find("9 on above would be possible"), std::string::npos) << opposite;

  // The border of a triangle has an even number of edges.
  Quadrille::Quad_extraction_options options;
  options.counts = {{{0}, 21, ""}};
  const std::string odd = error_of([&] { extract(star(3).build(), options, Optimal_quantizer()); });
  EXPECT_NE(odd.find("21 on curve 0"), std::string::npos) << odd;
  EXPECT_TRUE(odd.find("20 on curve 0 would be") != std::string::npos ||
              odd.find("22 on curve 0 would be") != std::string::npos)
      << odd;
}

TEST(Counts, invalid_requests_are_errors)
{
  const auto request = [](std::vector<Curve_count> counts) {
    Quadrille::Quad_extraction_options options;
    options.counts = std::move(counts);
    return error_of([&] { extract(rectangle(6.8, 3.3).build(), options); });
  };
  EXPECT_NE(request({{{2}, 3, ""}}).find("not there"), std::string::npos);
  EXPECT_NE(request({{{1}, 0, ""}}).find("at least one"), std::string::npos);
  EXPECT_NE(request({{{1, 4}, 3, ""}, {{4}, 3, ""}}).find("in common"), std::string::npos);
  EXPECT_NE(request({{{1}, 9, ""}, {{10}, 8, ""}}).find("instead of"), std::string::npos); // greedy
}

TEST(Optimal_quantizer, without_a_solver_is_an_error)
{
  if (Optimal_quantizer::is_available())
    GTEST_SKIP() << "built with CBC";
  const Quad_layout layout = grid_layout({1.0}, {1.0});
  Length_constraints constraints(layout);
  EXPECT_THROW(Optimal_quantizer()(layout, constraints), Quadrille::Invalid_argument_error);
  EXPECT_FALSE(std::isfinite(Quadrille::quantization_bound(layout, constraints)));
}
