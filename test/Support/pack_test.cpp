// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Support/internal/Pack.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace {

using Quadrille::internal::Pack;

/// Values whose sums and products round, overflow and vanish.
constexpr std::array<double, 8> values = {1.0 / 3, -7.1, 1e-170, 1e170, 0.0, 3e-310, -1e16, 2.5};

Pack rotated(int k)
{
  const auto value = [k](int lane) { return values[std::size_t(k + lane) % values.size()]; };
  return {value(0), value(1), value(2), value(3)};
}

void expect_same(const Pack& pack, int lane, double expected)
{
  if (std::isnan(expected))
    EXPECT_TRUE(std::isnan(pack.lane(lane)));
  else
    EXPECT_EQ(pack.lane(lane), expected);
}

TEST(Pack, computes_with_every_number_as_double_does)
{
  for (int i = 0; i < int(values.size()); ++i)
    for (int j = 0; j < int(values.size()); ++j) {
      const Pack a = rotated(i), b = rotated(j);
      Pack sum = a;
      sum += b;
      for (int lane = 0; lane < Pack::size; ++lane) {
        const double x = values[std::size_t(i + lane) % values.size()],
                     y = values[std::size_t(j + lane) % values.size()];
        expect_same(a + b, lane, x + y);
        expect_same(sum, lane, x + y);
        expect_same(a - b, lane, x - y);
        expect_same(-a, lane, -x);
        expect_same(a * b, lane, x * y);
        expect_same(a / b, lane, x / y);
        const volatile double product = x * y; // no fused multiply-add
        expect_same(a * b + b, lane, product + y);
        expect_same(square_root(a * a), lane, std::sqrt(x * x));
        expect_same(logarithm(a * a), lane, std::log(x * x));
        expect_same(exponential(a), lane, std::exp(x));
      }
    }
}

TEST(Pack, is_positive_where_all_its_numbers_are)
{
  EXPECT_TRUE(all_positive(Pack(1e-300)));
  for (const double value : {0.0, -0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    for (int lane = 0; lane < Pack::size; ++lane)
      EXPECT_FALSE(all_positive(
          Pack(lane == 0 ? value : 1, lane == 1 ? value : 1, lane == 2 ? value : 1, lane == 3 ? value : 1)));
}

} // namespace
