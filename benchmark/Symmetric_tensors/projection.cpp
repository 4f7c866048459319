// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Time of the exact projections, onto the odeco variety in the plane and in space and onto the crosses of space, per
// tensor; of the recovery from eigentensors for comparison (the argument: crosses averaged, 1 for crosses themselves),
// with how much farther than the nearest cross its result is, as a share of that distance.

#include <Quadrille/nearest_cross.h>
#include <Quadrille/odeco_tensors_2.h>
#include <Quadrille/odeco_tensors_3.h>

#include <benchmark/benchmark.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
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

namespace {

/// Means of `n` crosses that are turned from a common one by angles about 0.3.
std::vector<Quadrille::Cross_harmonics> means_of_crosses(int n)
{
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  std::vector<Quadrille::Cross_harmonics> means(1024, Quadrille::Cross_harmonics::Zero());
  for (auto& mean : means) {
    const auto random = [&] { return normal(engine); };
    const Eigen::Quaterniond common = Eigen::Quaterniond(random(), random(), random(), random()).normalized();
    for (int i = 0; i < n; ++i) {
      const Eigen::Quaterniond turn(1, 0.15 * random(), 0.15 * random(), 0.15 * random());
      mean += Quadrille::cross_harmonics((turn.normalized() * common).toRotationMatrix()) / n;
    }
  }
  return means;
}

} // namespace

static void nearest_crosses(benchmark::State& state)
{
  const auto means = means_of_crosses(int(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(Quadrille::nearest_crosses(means));
  state.SetItemsProcessed(state.iterations() * std::int64_t(means.size()));
}
BENCHMARK(nearest_crosses)->Arg(1)->Arg(6);

static void nearest_cross_from_near_start(benchmark::State& state)
{
  const auto means = means_of_crosses(6);
  const auto crosses = Quadrille::nearest_crosses(means);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.05, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(Quadrille::nearest_cross(means[i], turn * crosses[i].frame));
    i = (i + 1) % means.size();
  }
}
BENCHMARK(nearest_cross_from_near_start);

static void cross_of_eigentensors(benchmark::State& state)
{
  const auto means = means_of_crosses(int(state.range(0)));
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(Quadrille::cross_of_eigentensors(Quadrille::cross_tensor(means[i++ % means.size()])));
  double sum = 0, largest = 0;
  for (const Quadrille::Cross_harmonics& q : means) {
    const auto distance = [&](const Eigen::Matrix3d& frame) { return (q - Quadrille::cross_harmonics(frame)).norm(); };
    const Eigen::Matrix3d recovered = Quadrille::cross_of_eigentensors(Quadrille::cross_tensor(q));
    const double excess = distance(recovered) / distance(Quadrille::nearest_cross(q).frame) - 1;
    sum += excess;
    largest = std::max(largest, excess);
  }
  state.counters["excess_mean"] = sum / double(means.size());
  state.counters["excess_max"] = largest;
}
BENCHMARK(cross_of_eigentensors)->Arg(2)->Arg(6);

namespace {

/// Means of `n` odeco tensors with values about 1 whose axes are turned from common ones by angles about 0.3.
std::vector<Quadrille::Symmetric_tensor_3> means_of_odeco_tensors(int n)
{
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  std::vector<Quadrille::Symmetric_tensor_3> means(1024);
  for (auto& mean : means) {
    const auto random = [&] { return normal(engine); };
    const Eigen::Quaterniond common = Eigen::Quaterniond(random(), random(), random(), random()).normalized();
    for (int i = 0; i < n; ++i) {
      const Eigen::Quaterniond turn(1, 0.15 * random(), 0.15 * random(), 0.15 * random());
      const Eigen::Vector3d values(std::exp(random()), std::exp(random()), std::exp(random()));
      mean = mean + (1.0 / n) * Quadrille::odeco_tensor({(turn.normalized() * common).toRotationMatrix(), values});
    }
  }
  return means;
}

} // namespace

static void nearest_odeco_frame_of_space(benchmark::State& state)
{
  const auto means = means_of_odeco_tensors(int(state.range(0)));
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(Quadrille::nearest_odeco_frame(means[i++ % means.size()]));
}
BENCHMARK(nearest_odeco_frame_of_space)->Arg(1)->Arg(3);

static void nearest_odeco_frame_of_space_from_near_start(benchmark::State& state)
{
  const auto means = means_of_odeco_tensors(3);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.05, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Eigen::Matrix3d> starts;
  for (const auto& mean : means)
    starts.push_back(turn * Quadrille::nearest_odeco_frame(mean).axes);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(Quadrille::nearest_odeco_frame(means[i], starts[i]));
    i = (i + 1) % means.size();
  }
}
BENCHMARK(nearest_odeco_frame_of_space_from_near_start);

static void residuals_of_space(benchmark::State& state)
{
  const auto means = means_of_odeco_tensors(3);
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(Quadrille::odeco_residuals(means[i++ % means.size()]));
}
BENCHMARK(residuals_of_space);

static void eigenpairs_of_space(benchmark::State& state)
{
  const auto means = means_of_odeco_tensors(3);
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(Quadrille::eigenpairs(means[i++ % means.size()]));
}
BENCHMARK(eigenpairs_of_space);
