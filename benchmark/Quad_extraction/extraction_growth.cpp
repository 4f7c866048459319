// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// How the time for quads grows with the domain: one singularity of valence 5, twice as many quads as cells of the
// triangulation. Argument: cells along each side of its five squares. And how the time for a quantization grows.

#include <Quadrille/Greedy_quantizer.h>
#include <Quadrille/Quad_extraction/internal/extract_indexed_quads.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
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

void extract(benchmark::State& state)
{
  const int n = int(state.range(0));
  const Mapped_mesh mesh = star(5, n, 1.4 * n + 0.37);
  const internal::Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  Quad_extraction_result result;
  std::size_t quads = 0;
  for (auto _ : state) {
    const Seamless_map map(triangulation, mesh.uv, mesh.curve, std::vector<int>(mesh.triangles.size(), 0));
    result = Quad_extraction_result();
    quads = extract_indexed_quads(
                map, mesh.points, {}, Greedy_quantizer(), [](int, const Eigen::Vector2d& p) { return p; }, result)
                .quads.size();
  }
  state.counters["triangles"] = double(mesh.triangles.size());
  state.counters["quads"] = double(quads);
  state.counters["layout_s"] = result.layout_seconds;
  state.counters["smoothing_s"] = result.smoothing.seconds;
  state.counters["iterations"] = result.smoothing.iterations;
}
BENCHMARK(extract)->Arg(10)->Arg(32)->Arg(100)->Unit(benchmark::kMillisecond)->Iterations(1);

/// The quantization alone, of n x n patches of random sizes.
void quantize(benchmark::State& state)
{
  const int n = int(state.range(0));
  std::mt19937 random(1);
  Quad_layout layout;
  layout.strips.resize(std::size_t(2 * n));
  layout.nodes.resize(std::size_t((n + 1) * (n + 1)));
  const auto add_arcs = [&](bool vertical) {
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j < n; ++j) {
        Quad_layout::Arc arc;
        arc.source = vertical ? j * (n + 1) + i : i * (n + 1) + j;
        arc.target = arc.source + (vertical ? n + 1 : 1);
        arc.strip = (vertical ? n : 0) + j;
        arc.curve = i == 0 || i == n ? 0 : -1;
        layout.strips[std::size_t(arc.strip)].arcs.push_back(int(layout.arcs.size()));
        layout.arcs.push_back(arc);
      }
  };
  add_arcs(false);
  add_arcs(true);
  for (Quad_layout::Strip& strip : layout.strips)
    strip.length = 0.05 + 1.5 * double(random()) / 4294967296.0;
  layout.left_patch.assign(2 * layout.arcs.size(), -1);
  const int vertical = n * (n + 1);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int p = int(layout.patches.size());
      layout.patches.push_back({{2 * (j * n + i), 2 * (vertical + (i + 1) * n + j), 2 * ((j + 1) * n + i) + 1,
                                 2 * (vertical + i * n + j) + 1},
                                0});
      for (const int h : layout.patches.back().half_arcs)
        layout.left_patch[std::size_t(h)] = p;
      layout.strips[std::size_t(i)].patches.push_back({p, 0});
      layout.strips[std::size_t(n + j)].patches.push_back({p, 1});
    }
  for (auto _ : state) {
    Strip_constraints constraints(layout);
    benchmark::DoNotOptimize(Greedy_quantizer()(layout, constraints));
  }
  state.counters["patches"] = double(layout.patches.size());
}
BENCHMARK(quantize)->Arg(30)->Arg(100)->Arg(300)->Unit(benchmark::kMillisecond)->Iterations(1);

} // namespace
