// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Time of the exact projection onto the odeco variety, per tensor.

#include <Quadrille/odeco_tensors_2.h>

#include <benchmark/benchmark.h>

#include <random>
#include <vector>

static void nearest_odeco_frame(benchmark::State& state)
{
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  std::vector<Quadrille::Circular_harmonics> tensors(1024);
  for (auto& q : tensors)
    q = Quadrille::Circular_harmonics::NullaryExpr([&] { return normal(engine); });
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(Quadrille::nearest_odeco_frame(tensors[i++ % tensors.size()]));
}
BENCHMARK(nearest_odeco_frame);
