// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// How the time for quads grows with the domain: one singularity of valence 5, twice as many quads as cells of the
// triangulation. Argument: cells along each side of its five squares. And how the time for a quantization grows.

#include "grid_layout.h"

#include <Quadrille/Greedy_quantizer.h>
#include <Quadrille/Optimal_quantizer.h>
#include <Quadrille/Quad_extraction/internal/Layout_builder.h>
#include <Quadrille/Quad_extraction/internal/extract_indexed_quads.h>

#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <cmath>
#include <random>

namespace {

using namespace Quadrille;
using namespace Quadrille::internal::extraction;

struct Mapped_mesh {
  std::vector<Eigen::Vector2d> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<Uv> uv;
  std::vector<int> curve;
};

/// `valence` squares around a point, each `n` x `n` cells with a map of side `size`, moved randomly inside.
Mapped_mesh star(int valence, int n, double size)
{
  Mapped_mesh mesh;
  std::mt19937 random(1);
  const double turn = 2 * std::acos(-1.0) / valence;
  const auto on_grid = [](double x) { return std::round(std::ldexp(x, 25)) / std::ldexp(1.0, 25); };
  const int row = n + 1;
  const auto id = [&](int square, int i, int j) { // the side i = 0 of a square is the side j = 0 of the next
    if (i == 0 && j == 0)
      return 0;
    return i == 0 ? 1 + ((square + 1) % valence) * n * row + j - 1 : 1 + square * n * row + j * n + i - 1;
  };
  mesh.points.resize(std::size_t(1 + valence * n * row), Eigen::Vector2d::Zero());
  std::vector<Uv> of_node(std::size_t(row * row));
  for (int square = 0; square < valence; ++square) {
    const Eigen::Vector2d a(std::cos(turn * square), std::sin(turn * square));
    const Eigen::Vector2d b(std::cos(turn * (square + 1)), std::sin(turn * (square + 1)));
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const bool inner = i > 0 && i < n && j > 0 && j < n;
        const auto shifted = [&](int k) { return inner ? k + 0.2 * (double(random()) / 2147483648.0 - 1) : k; };
        const double x = shifted(i) / n, y = shifted(j) / n;
        of_node[std::size_t(j * row + i)] = {on_grid(size * x), on_grid(size * y)};
        if (i > 0 || square == 0)
          mesh.points[std::size_t(id(square, i, j))] = x * a + y * b;
      }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (const auto& t : {std::array<int, 6>{i, j, i + 1, j, i + 1, j + 1}, {i, j, i + 1, j + 1, i, j + 1}}) {
          mesh.triangles.push_back({id(square, t[0], t[1]), id(square, t[2], t[3]), id(square, t[4], t[5])});
          for (std::size_t k = 0; k < 6; k += 2) {
            mesh.uv.push_back(of_node[std::size_t(t[k + 1] * row + t[k])]);
            const std::size_t l = (k + 2) % 6;
            const bool border = (t[k] == n && t[l] == n) || (t[k + 1] == n && t[l + 1] == n);
            mesh.curve.push_back(border ? square : -1);
          }
        }
  }
  return mesh;
}

template <Layout_kind kind> void extract(benchmark::State& state)
{
  const int n = int(state.range(0));
  const Mapped_mesh mesh = star(5, n, 1.4 * n + 0.37);
  const internal::Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  Quad_extraction_options options;
  options.layout = kind;
  Quad_extraction_result result;
  std::size_t quads = 0;
  for (auto _ : state) {
    const Seamless_map map(triangulation, mesh.uv, mesh.curve, std::vector<int>(mesh.triangles.size(), 0));
    result = Quad_extraction_result();
    quads = extract_indexed_quads<2>(
                map, mesh.points, options, Greedy_quantizer(), [](int, const Eigen::Vector2d& p) { return p; }, result)
                .quads.size();
  }
  state.counters["triangles"] = double(mesh.triangles.size());
  state.counters["quads"] = double(quads);
  state.counters["layout_s"] = result.layout_seconds;
  state.counters["quantization_s"] = result.quantization_seconds;
  state.counters["mesh_s"] = result.mesh_seconds;
  state.counters["smoothing_s"] = result.smoothing.seconds;
  state.counters["iterations"] = result.smoothing.iterations;
}
BENCHMARK_TEMPLATE(extract, Layout_kind::base_complex)
    ->Arg(10)
    ->Arg(32)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

/// Layouts of thousands of arcs: holes at random in a square, the identity as map.
/// Argument: holes along a side.
template <Layout_kind kind> void trace(benchmark::State& state)
{
  const int n = int(state.range(0));
  std::mt19937 random(3);
  const auto uniform = [&](double a, double b) { return a + (b - a) * double(random()) / 4294967296.0; };
  constexpr int cells = 12; // of the triangulation per period
  // Holes are whole cells of a grid with lines at random places.
  std::vector<double> x(std::size_t(n * cells + 1), 0.0), y = x;
  for (auto* line : {&x, &y})
    for (std::size_t i = 1; i < line->size(); ++i)
      (*line)[i] = (*line)[i - 1] + std::round(std::ldexp(uniform(0.1, 0.5), 20)) / std::ldexp(1.0, 20);
  std::vector<char> is_hole(std::size_t(n * n * cells * cells), 0);
  const auto hole = [&](int i, int j) -> char& { return is_hole[std::size_t(j * n * cells + i)]; };
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      const int i0 = a * cells + 2 + int(random() % 4), j0 = b * cells + 2 + int(random() % 4);
      for (int i = i0; i < i0 + 4; ++i)
        for (int j = j0; j < j0 + 4; ++j)
          hole(i, j) = 1;
    }
  Mapped_mesh mesh;
  const int row = n * cells + 1;
  std::vector<int> id(std::size_t(row * row), -1);
  for (int j = 0; j + 1 < row; ++j)
    for (int i = 0; i + 1 < row; ++i)
      for (const auto& t : {std::array<int, 6>{i, j, i + 1, j, i + 1, j + 1}, {i, j, i + 1, j + 1, i, j + 1}}) {
        if (hole(i, j))
          continue;
        std::array<int, 3> triangle;
        for (std::size_t k = 0; k < 3; ++k) {
          int& v = id[std::size_t(t[2 * k + 1] * row + t[2 * k])];
          if (v < 0) {
            v = int(mesh.points.size());
            mesh.points.emplace_back(x[std::size_t(t[2 * k])], y[std::size_t(t[2 * k + 1])]);
          }
          triangle[k] = v;
          mesh.uv.push_back({x[std::size_t(t[2 * k])], y[std::size_t(t[2 * k + 1])]});
        }
        mesh.triangles.push_back(triangle);
      }
  const internal::Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  for (int h = 0; h < triangulation.number_of_halfedges(); ++h)
    mesh.curve.push_back(triangulation.is_boundary(h) ? 0 : -1);
  Quad_layout layout;
  for (auto _ : state) {
    const Seamless_map map(triangulation, mesh.uv, mesh.curve, std::vector<int>(mesh.triangles.size(), 0));
    layout = build_layout(map, std::vector<char>(mesh.points.size(), 0), kind, 4 * mesh.triangles.size());
  }
  state.counters["triangles"] = double(mesh.triangles.size());
  state.counters["arcs"] = double(layout.arcs.size());
  state.counters["strips"] = double(layout.strips.size());
  Length_constraints constraints(layout);
  const auto start = std::chrono::steady_clock::now();
  const Quantization result = Greedy_quantizer()(layout, constraints);
  state.counters["greedy_s"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  state.counters["repetitions"] = result.repetitions;
#ifdef QUADRILLE_WITH_CBC
  const auto middle = std::chrono::steady_clock::now();
  const Quantization optimal = Optimal_quantizer()(layout, constraints);
  state.counters["optimal_s"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - middle).count();
  state.counters["interrupted"] = optimal.note.empty() ? 0 : 1;
#endif
}
BENCHMARK_TEMPLATE(trace, Layout_kind::base_complex)
    ->Arg(4)
    ->Arg(10)
    ->Arg(30)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_TEMPLATE(trace, Layout_kind::t_mesh)->Arg(4)->Arg(10)->Arg(30)->Unit(benchmark::kMillisecond)->Iterations(1);

/// The quantization alone, of n x n patches of random sizes.
template <class Quantizer> void quantize(benchmark::State& state)
{
  const int n = int(state.range(0));
  std::mt19937 random(1);
  const auto sizes = [&] {
    std::vector<double> result(std::size_t(n), 0.0);
    for (double& size : result)
      size = 0.05 + 1.5 * double(random()) / 4294967296.0;
    return result;
  };
  const std::vector<double> widths = sizes();
  const Quad_layout layout = quad_extraction_test::grid_layout(widths, sizes());
  Quantization result;
  for (auto _ : state) {
    Length_constraints constraints(layout);
    result = Quantizer()(layout, constraints);
  }
  state.counters["patches"] = double(layout.patches.size());
  const Length_deviation deviation(layout);
  state.counters["deviation"] = deviation.relative(deviation.cost(result.lengths));
}
BENCHMARK_TEMPLATE(quantize, Greedy_quantizer)
    ->Arg(30)
    ->Arg(100)
    ->Arg(300)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
#ifdef QUADRILLE_WITH_CBC
BENCHMARK_TEMPLATE(quantize, Optimal_quantizer)
    ->Arg(30)
    ->Arg(100)
    ->Arg(300)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
#endif

} // namespace
