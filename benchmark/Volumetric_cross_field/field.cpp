// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The field of a ball by the multilevel solver, and by the averaging of the paper (at most 1,000 sweeps) with its own
// projection and with the exact one; counters: energy, arcs of the singular graph and its ends on the boundary (right
// are 20 and 8). The argument: cells across the ball; it has 6 n^3 tetrahedra.

#include "tetrahedral_test_meshes.h"

#include <Quadrille/Singular_graph.h>
#include <Quadrille/average_crosses.h>
#include <Quadrille/volumetric_cross_field.h>

#include <benchmark/benchmark.h>

namespace {

using namespace Quadrille;

template <class Field> void report(benchmark::State& state, const Tetrahedral_mesh& mesh, const Field& field)
{
  const Singular_graph graph = singular_graph(mesh, field.frames);
  state.counters["tetrahedra"] = double(mesh.number_of_tetrahedra());
  state.counters["energy"] = field.energy;
  state.counters["arcs"] = double(graph.arcs.size());
  state.counters["ends"] = double(graph.boundary_ends);
}

void multilevel(benchmark::State& state)
{
  const Tetrahedral_mesh mesh = ball_of_tetrahedra(int(state.range(0)));
  const Vertex_alignments alignments = align_with_boundary(mesh);
  Volumetric_cross_field field;
  for (auto _ : state)
    field = volumetric_cross_field(mesh, alignments);
  report(state, mesh, field);
}

void averaging(benchmark::State& state, bool exact_projection)
{
  const Tetrahedral_mesh mesh = ball_of_tetrahedra(int(state.range(0)));
  const Vertex_alignments alignments = align_with_boundary(mesh);
  Averaging_options options;
  options.exact_projection = exact_projection;
  Averaged_crosses field;
  for (auto _ : state)
    field = average_crosses(mesh, alignments, options);
  report(state, mesh, field);
}

} // namespace

BENCHMARK(multilevel)->Arg(12)->Arg(24)->Arg(48)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(averaging, eigentensors, false)->Arg(12)->Arg(24)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(averaging, exact, true)->Arg(12)->Arg(24)->Unit(benchmark::kMillisecond)->UseRealTime();
