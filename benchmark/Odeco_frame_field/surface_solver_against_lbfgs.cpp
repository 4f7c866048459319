// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Our minimiser of the energies of fields on surfaces against ALGLIB's L-BFGS, the method of the surface paper, as
// solver_against_lbfgs.cpp in the plane: from the same smooth field, on the same energy and evaluation code, on one
// thread, until a step lowers the energy by less than 1e-9 of it; what is compared is the time until the energy is
// within 1e-4 of the lower one of the two final energies.
//
// `--file=F` and `--triangle-size=H` (for geometry files) give the surfaces, repeatable in pairs; without them they are
// two of examples/data. Rows: the paper's own energy with the weights of its presets "area" and "angle", and ours.

#include <Quadrille/odeco_surface_field.h>
#include <Quadrille/read_surface_domain.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#ifdef QUADRILLE_WITH_ALGLIB

namespace {

using namespace Quadrille;
using Mesh = Surface_domain::Mesh;
using Field = internal::Surface_field<5>;

Field make_field(const Surface_domain& domain, const Surface_field_options& options, const Field::Evaluator& evaluator)
{
  const internal::Mesh_index<Mesh> index(domain.mesh);
  std::vector<Eigen::Vector3d> points;
  for (const Mesh::Vertex_index v : index.vertex_of)
    points.emplace_back(domain.mesh.point(v).x(), domain.mesh.point(v).y(), domain.mesh.point(v).z());
  std::vector<Edge_frame_constraint> constraints(domain.mesh.number_of_edges());
  for (std::size_t e = 0; e < constraints.size(); ++e)
    constraints[e].constrained = domain.edge_curve[e] >= 0;
  const auto constraint_map = boost::make_iterator_property_map(constraints.begin(), boost::identity_property_map());
  return Field(index.triangulation, points, internal::constrained_halfedges(index, domain.mesh, constraint_map),
               options, evaluator);
}

/// When an energy was reached that is at most the given one; all of the time if it never was.
double time_to(const Minimization_report& report, double energy)
{
  for (const Energy_sample& sample : report.history)
    if (sample.energy <= energy)
      return sample.seconds;
  return report.seconds;
}

std::vector<double> ratios;

void compare(benchmark::State& state, const std::string& file, double triangle_size,
             const Surface_field_weights& weights, bool as_in_paper)
{
  Surface_domain_options domain_options;
  domain_options.triangle_size = triangle_size;
  const Surface_domain domain = read_surface_domain(file, domain_options);
  Surface_field_options options;
  options.weights = weights;
  options.terms_as_in_paper = as_in_paper;
  const Field::Evaluator evaluator;
  const Field field = make_field(domain, options, evaluator);
  const internal::Surface_elements<5>& elements = field.elements();
  const internal::Surface_energy<5> energy(elements, field.weights());
  const Eigen::VectorXd start =
      internal::Surface_field_solver<5>(field.problem(), elements, field.weights(), options.schedule, 1, nullptr,
                                        Field_solver_kind::levenberg_marquardt)
          .smooth_field();

  for (auto _ : state) {
    const internal::Stopwatch stopwatch;
    Element_least_squares<internal::Surface_energy<5>> problem(energy, elements.number_of_unknowns());
    Cholesky_solver solver;
    solver.analyze(problem.gauss_newton_matrix());
    const double preparation = stopwatch.seconds();
    Levenberg_marquardt_options our_options;
    our_options.max_iterations = 1000;
    our_options.record_history = true;
    Eigen::VectorXd x = start;
    const Minimization_report ours = minimize_levenberg_marquardt(problem, x, our_options, &solver);

    Lbfgs_options lbfgs_options;
    lbfgs_options.relative_decrease = our_options.relative_decrease;
    lbfgs_options.record_history = true;
    x = start;
    const Minimization_report lbfgs = minimize_lbfgs(problem, x, lbfgs_options);

    const double common = (1 + 1e-4) * std::min(ours.energy, lbfgs.energy);
    const double our_time = preparation + time_to(ours, common), lbfgs_time = time_to(lbfgs, common);
    ratios.push_back(lbfgs_time / our_time);
    state.counters["triangles"] = double(elements.number_of_elements());
    state.counters["ours_s"] = our_time;
    state.counters["lbfgs_s"] = lbfgs_time;
    state.counters["ratio"] = ratios.back();
    state.counters["our_energy"] = ours.energy;
    state.counters["lbfgs_energy"] = lbfgs.energy;
    state.counters["factorizations"] = ours.factorizations;
    state.counters["lbfgs_evaluations"] = lbfgs.evaluations;
    state.SetLabel(ours.energy > common ? "ours ends higher" : lbfgs.energy > common ? "L-BFGS ends higher" : "");
  }
}

void add(const std::string& file, double triangle_size)
{
  const std::string name = file.substr(file.rfind('/') + 1);
  for (const bool is_area : {true, false})
    for (const bool as_in_paper : {true, false}) {
      const Surface_field_weights weights =
          is_area ? Surface_field_weights::area_preserving() : Surface_field_weights::angle_preserving();
      const std::string label = name + (is_area ? "/area" : "/angle") + (as_in_paper ? "/paper" : "/ours");
      benchmark::RegisterBenchmark(label.c_str(), compare, file, triangle_size, weights, as_in_paper)
          ->Iterations(1)
          ->Unit(benchmark::kSecond);
    }
}

} // namespace

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  std::vector<std::pair<std::string, double>> files;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.rfind("--file=", 0) == 0) {
      files.emplace_back(argument.substr(7), 0.);
    } else if (argument.rfind("--triangle-size=", 0) == 0 && !files.empty()) {
      files.back().second = std::atof(argument.c_str() + 16);
    } else {
      std::fprintf(stderr, "unknown option %s\n", argv[i]);
      return 2;
    }
  }
  if (files.empty())
    files = {{QUADRILLE_EXAMPLE_DATA "/box_transition.geo", 0.}, {QUADRILLE_EXAMPLE_DATA "/arch.geo", 0.}};
  for (const auto& [file, triangle_size] : files)
    add(file, triangle_size);
  benchmark::RunSpecifiedBenchmarks();
  double log_sum = 0;
  for (const double ratio : ratios)
    log_sum += std::log(ratio);
  if (!ratios.empty())
    std::printf("geometric mean of the ratios: %.1f\n", std::exp(log_sum / double(ratios.size())));
  return 0;
}

#else
int main() {}
#endif
