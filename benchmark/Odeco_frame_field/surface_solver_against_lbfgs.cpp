// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Fields on surfaces by our solver against the surface paper's, L-BFGS (ALGLIB): each from nothing, the smooth field
// included, on the same energy and evaluation code, one after the other on one thread. Ours is what odeco_surface_field
// does without melted starts; L-BFGS stops as in the paper, when an iteration lowers the energy by less than 1e-5 of
// it. "ratio" is its time over ours. Where ours ends lower by more than 1e-4, L-BFGS goes on (to 1e-9) until it is as
// low: "ratio_at_equal_energy", a lower bound where it never is.
//
// `--file=F` and `--triangle-size=H` (for geometry files) give the surfaces, repeatable in pairs; without them they are
// two of examples/data. Rows: the paper's own energy with the weights of its presets "area" and "angle", and ours.

#include "solver_comparison.h"

#include <Quadrille/Odeco_frame_field/internal/Surface_field.h>
#include <Quadrille/minimize_lbfgs.h>
#include <Quadrille/odeco_surface_field.h>
#include <Quadrille/read_surface_domain.h>

#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#ifdef QUADRILLE_WITH_ALGLIB

namespace {

using namespace Quadrille;
using Mesh = Surface_domain::Mesh;
using Field = internal::Surface_field<5>;

Field make_field(const Surface_domain& domain, const Surface_field_options& options, const Field_evaluator& evaluator)
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

std::vector<double> ratios, ratios_at_equal_energy;

void compare(benchmark::State& state, const std::string& file, double triangle_size,
             const Surface_field_weights& weights, bool as_in_paper)
{
  Surface_domain_options domain_options;
  domain_options.triangle_size = triangle_size;
  const Surface_domain domain = read_surface_domain(file, domain_options);
  Surface_field_options options;
  options.weights = weights;
  options.terms_as_in_paper = as_in_paper;
  options.starts = 0;
  options.threads = 1;

  for (auto _ : state) {
    const Field_evaluator evaluator;
    const internal::Stopwatch our_watch;
    Field field = make_field(domain, options, evaluator);
    internal::Gradients gradients;
    const Surface_field_result ours = field.solve(gradients);
    const double our_time = our_watch.seconds();

    const internal::Stopwatch lbfgs_watch;
    const internal::Surface_elements<5>& elements = field.elements();
    const internal::Surface_energy<5> energy(elements, field.weights());
    Eigen::VectorXd x = internal::Surface_field_solver<5>(field.problem(), elements, field.weights(), options.schedule,
                                                          1, nullptr, Field_solver_kind::lbfgs)
                            .smooth_field();
    const Element_least_squares<internal::Surface_energy<5>> problem(energy, elements.number_of_unknowns());
    Lbfgs_options lbfgs_options;
    lbfgs_options.relative_decrease = 1e-5;
    const Minimization_report lbfgs = minimize_lbfgs(problem, x, lbfgs_options);
    const double lbfgs_time = lbfgs_watch.seconds();

    const double as_low = (1 + 1e-4) * ours.energy;
    double lbfgs_time_to_ours = lbfgs_time, lowest = lbfgs.energy;
    if (lbfgs.energy > as_low) {
      lbfgs_options.relative_decrease = 1e-9;
      lbfgs_options.record_history = true;
      const Minimization_report rest = minimize_lbfgs(problem, x, lbfgs_options);
      lbfgs_time_to_ours += time_to_energy(rest, as_low);
      lowest = rest.energy;
    }
    ratios.push_back(lbfgs_time / our_time);
    ratios_at_equal_energy.push_back(lbfgs_time_to_ours / our_time);
    state.counters["triangles"] = double(elements.number_of_elements());
    state.counters["ours_s"] = our_time;
    state.counters["lbfgs_s"] = lbfgs_time;
    state.counters["ratio"] = ratios.back();
    state.counters["ratio_at_equal_energy"] = ratios_at_equal_energy.back();
    state.counters["our_energy"] = ours.energy;
    state.counters["lbfgs_energy"] = lbfgs.energy;
    state.counters["lbfgs_lowest"] = lowest;
    state.counters["lbfgs_evaluations"] = lbfgs.evaluations;
    state.SetLabel(lowest > as_low                 ? "L-BFGS is never as low"
                   : ours.energy > 1.0001 * lowest ? "ours ends higher"
                                                   : "");
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
  std::printf("geometric means of the ratios: %.1f, at equal energy %.1f\n", geometric_mean(ratios),
              geometric_mean(ratios_at_equal_energy));
  return 0;
}

#else
int main() {}
#endif
