// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// How the time for a map grows with the number of triangles: one singularity of valence 3, and noise on its frames,
// which adds singularities and flipped triangles. Argument: cells along each side of its three squares.

#include "planar_test_meshes.h"

#include <Quadrille/Seamless_parametrization/internal/Seamless_map_solver.h>

#include <benchmark/benchmark.h>

#include <complex>

namespace {

using namespace Quadrille;
using internal::Gradient_pair;

std::vector<Gradient_pair> frames_of(const test::Planar_mesh& mesh, double noise)
{
  std::mt19937 generator(1);
  std::vector<Gradient_pair> frames;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Eigen::Vector2d p = mesh.centroid(f);
    const double turn = noise * (double(generator()) / 2147483648.0 - 1.0);
    const std::complex<double> d = 0.75 * std::pow(std::complex<double>(p.x(), p.y()), -0.25) * std::polar(1.0, turn);
    frames.emplace_back(Eigen::Vector2d(d.real(), -d.imag()), Eigen::Vector2d(d.imag(), d.real()));
  }
  return frames;
}

void compute(benchmark::State& state, double noise)
{
  const test::Planar_mesh mesh = test::glued_squares_mesh(3, int(state.range(0)));
  const internal::Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  const internal::Seamless_map_solver solver(triangulation, internal::planar_geometry(triangulation, mesh.points), {});
  const std::vector<Gradient_pair> frames = frames_of(mesh, noise);
  internal::Seamless_map_data map;
  for (auto _ : state)
    map = solver(frames);
  state.counters["triangles"] = double(mesh.triangles.size());
  state.counters["seams"] = double(map.cut.paths.size());
  state.counters["flipped"] = map.flipped_before_untangling;
  state.counters["left"] = double(map.flipped_faces.size());
}

void one_singularity(benchmark::State& state) { compute(state, 0.0); }
void noisy(benchmark::State& state) { compute(state, 0.5); }
BENCHMARK(one_singularity)->Arg(13)->Arg(41)->Arg(129)->Arg(408)->Unit(benchmark::kMillisecond);
BENCHMARK(noisy)->Arg(13)->Arg(41)->Arg(129)->Unit(benchmark::kMillisecond);

} // namespace
