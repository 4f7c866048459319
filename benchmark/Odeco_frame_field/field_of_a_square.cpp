// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The field of a square with sizes from 1 to 2: Levenberg-Marquardt from the smooth field, one melted start, and the
// papers' L-BFGS, against the number of triangles (argument: cells along a side).

#include <Quadrille/odeco_frame_field.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <benchmark/benchmark.h>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_2>;

static void solve(benchmark::State& state, int starts, Quadrille::Field_solver_kind solver)
{
  const auto n = Mesh::size_type(state.range(0));
  Mesh mesh;
  CGAL::make_grid(
      n, n, mesh, [](auto i, auto j) { return Kernel::Point_2(double(i), double(j)); }, true);
  auto constraint = mesh.add_property_map<Mesh::Edge_index, Quadrille::Edge_frame_constraint>("e:frame").first;
  const auto size = [&](Mesh::Vertex_index v) { return 1 + mesh.point(v).y() / n; };
  for (const Mesh::Edge_index e : mesh.edges())
    if (mesh.is_border(e))
      constraint[e] = {true, true, size(mesh.source(mesh.halfedge(e))), size(mesh.target(mesh.halfedge(e)))};
  const Quadrille::Gradient_pair none(Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero());
  auto gradients = mesh.add_property_map<Mesh::Face_index, Quadrille::Gradient_pair>("f:gradients", none).first;
  Quadrille::Odeco_field_options options;
  options.starts = starts;
  options.threads = 1;
  options.solver = solver;
  double energy = 0;
  for (auto _ : state)
    energy = Quadrille::odeco_frame_field(mesh, mesh.points(), constraint, gradients, options).energy;
  state.counters["triangles"] = double(mesh.number_of_faces());
  state.counters["energy"] = energy;
}

static void relaxed(benchmark::State& state) { solve(state, 0, Quadrille::Field_solver_kind::levenberg_marquardt); }
static void melted(benchmark::State& state) { solve(state, 1, Quadrille::Field_solver_kind::levenberg_marquardt); }
BENCHMARK(relaxed)->Arg(32)->Arg(64)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond);
BENCHMARK(melted)->Arg(32)->Arg(64)->Arg(128)->Unit(benchmark::kMillisecond);
#ifdef QUADRILLE_WITH_ALGLIB
static void lbfgs(benchmark::State& state) { solve(state, 0, Quadrille::Field_solver_kind::lbfgs); }
BENCHMARK(lbfgs)->Arg(32)->Arg(64)->Unit(benchmark::kMillisecond);
#endif
