// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Our minimiser of E_integ against ALGLIB's L-BFGS, the papers' method, on the rows of planar-2's Table 1 for which
// examples/data has a case, and on a square of 40,000 triangles.
//
// Both start from the same smooth field and minimise the same energy at the same epsilon (environment variable EPSILON,
// in local triangle sizes; default 1, "the order of magnitude of the local mesh size") with the same evaluation code,
// one after the other on one thread. Each runs until one of its steps lowers the energy by less than 1e-9 of it, and
// records its energy against time. What is compared is the time until the energy is within 1e-4 (relative) of the lower
// one of the two final energies. Ours contains the sparsity pattern and its symbolic analysis. A solver that ends in a
// higher minimum never gets there; then all of its time counts, and the row says so.

#include "solver_comparison.h"

#include <Quadrille/Odeco_frame_field/internal/Planar_field.h>
#include <Quadrille/Size_specification.h>
#include <Quadrille/minimize_lbfgs.h>
#include <Quadrille/odeco_frame_field.h>
#include <Quadrille/read_planar_domain.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#ifdef QUADRILLE_WITH_ALGLIB

namespace {

using namespace Quadrille;
using Mesh = Planar_domain::Mesh;

/// A case's field, of which only the elements are used.
template <int N>
std::unique_ptr<internal::Planar_field<N>> read_field(const std::string& name, double triangle_size,
                                                      const Odeco_field_options& options,
                                                      const Field_evaluator& evaluator)
{
  Planar_domain_options domain_options;
  domain_options.triangle_size = triangle_size;
  const Planar_domain domain = read_planar_domain(QUADRILLE_EXAMPLE_DATA "/" + name + ".geo", domain_options);
  const Domain_sizes sizes = Size_specification().apply(domain);
  const internal::Mesh_index<Mesh> index(domain.mesh);
  std::vector<Eigen::Vector2d> points;
  for (const Mesh::Vertex_index v : index.vertex_of)
    points.emplace_back(domain.mesh.point(v).x(), domain.mesh.point(v).y());
  std::vector<internal::Constrained_halfedge> edges;
  for (std::size_t h = 0; h < index.halfedge_of.size(); ++h) {
    const Mesh::Halfedge_index halfedge = index.halfedge_of[h];
    const Mesh::Edge_index edge = domain.mesh.edge(halfedge);
    const bool is_first = domain.mesh.halfedge(edge) == halfedge;
    if (domain.edge_curve[edge.idx()] < 0 || (!is_first && !domain.mesh.is_border(domain.mesh.halfedge(edge))))
      continue;
    auto size = sizes.of_edge[edge.idx()];
    if (!is_first)
      std::swap(size[0], size[1]);
    edges.push_back({int(h), true, size});
  }
  return std::make_unique<internal::Planar_field<N>>(index.triangulation, points, edges, options, evaluator);
}

std::vector<double> table_ratios;

template <int N> void compare(benchmark::State& state, const std::string& name, double triangle_size, bool is_in_table)
{
  using Energy = internal::Field_energy<N, internal::Field_energy_kind::integrability>;
  const char* text = std::getenv("EPSILON");
  const double epsilon = text ? std::atof(text) : 1;
  const Odeco_field_options field_options;
  const Field_evaluator evaluator;
  const auto field = read_field<N>(name, triangle_size, field_options, evaluator);
  const internal::Field_elements<N>& elements = field->elements();
  Melt_and_freeze_schedule schedule;
  schedule.smooth_epsilon = epsilon;
  const Eigen::VectorXd start =
      internal::Field_solver<N>(elements, schedule, 1, nullptr, Field_solver_kind::levenberg_marquardt).smooth_field();
  const Energy energy(elements, epsilon);

  for (auto _ : state) {
    const internal::Stopwatch stopwatch;
    Element_least_squares<Energy> problem(energy, elements.number_of_unknowns());
    Cholesky_solver solver;
    solver.analyze(problem.gauss_newton_matrix());
    const double preparation = stopwatch.seconds();
    Levenberg_marquardt_options options;
    options.max_iterations = 1000;
    options.record_history = true;
    Eigen::VectorXd x = start;
    const Minimization_report ours = minimize_levenberg_marquardt(problem, x, options, &solver);

    Lbfgs_options lbfgs_options;
    lbfgs_options.relative_decrease = options.relative_decrease;
    lbfgs_options.record_history = true;
    x = start;
    const Minimization_report lbfgs = minimize_lbfgs(problem, x, lbfgs_options);

    const double common = (1 + 1e-4) * std::min(ours.energy, lbfgs.energy);
    const double our_time = preparation + time_to_energy(ours, common), lbfgs_time = time_to_energy(lbfgs, common);
    if (is_in_table)
      table_ratios.push_back(lbfgs_time / our_time);
    state.counters["triangles"] = double(elements.number_of_elements());
    state.counters["ours_ms"] = 1e3 * our_time;
    state.counters["lbfgs_ms"] = 1e3 * lbfgs_time;
    state.counters["ratio"] = lbfgs_time / our_time;
    state.counters["our_energy"] = ours.energy;
    state.counters["lbfgs_energy"] = lbfgs.energy;
    state.counters["factorizations"] = ours.factorizations;
    state.counters["lbfgs_evaluations"] = lbfgs.evaluations;
    state.SetLabel(ours.energy > common ? "ours ends higher" : lbfgs.energy > common ? "L-BFGS ends higher" : "");
  }
}

template <int N> void add(const std::string& name, double triangle_size, bool is_in_table = true)
{
  const std::string label = name + (N == 3 ? "/isotropic" : "/anisotropic") + (is_in_table ? "" : "/fine");
  benchmark::RegisterBenchmark(label.c_str(), compare<N>, name, triangle_size, is_in_table)
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
}

} // namespace

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  // Triangles about as large as the paper's.
  add<3>("three_component_wing", 3.45);
  add<3>("disk", 1.03);
  add<3>("square_1_2", 0);
  add<3>("square_1_10", 0);
  add<3>("annulus", 2.04);
  add<5>("square_1_2", 0);
  add<3>("tilted_squares", 2.35);
  add<5>("tilted_squares", 2.35);
  add<3>("nautilus", 0.857);
  add<5>("nautilus", 0.857);
  add<3>("square_1_2", 0.152, false);
  benchmark::RunSpecifiedBenchmarks();
  if (!table_ratios.empty())
    std::printf("geometric mean of the ratios of %zu rows of Table 1: %.1f\n", table_ratios.size(),
                geometric_mean(table_ratios));
  return 0;
}

#else
int main() {}
#endif
