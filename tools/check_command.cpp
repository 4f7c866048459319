// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "check_command.h"

#include "Console.h"
#include "json_summary.h"

#include <Quadrille/Curve_locator.h>
#include <Quadrille/compare_surfaces.h>
#include <Quadrille/read_domain.h>
#include <Quadrille/read_mesh.h>
#include <Quadrille/write_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

namespace Quadrille {

namespace {

using Json = nlohmann::ordered_json;

/// How well the border of a mesh follows that of a domain.
struct Border_comparison {
  double distance_max = 0;  ///< of border vertices from the domain's curves
  double relative_max = 0;  ///< the same divided by the bounding box's diagonal
  double area_relative = 0; ///< area of the mesh / area of the domain - 1
};

double area_of(const Labelled_mesh& mesh)
{
  double area = 0;
  for (const std::vector<int>& polygon : mesh.polygons)
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      const auto &p = mesh.points[std::size_t(polygon[0])], &q = mesh.points[std::size_t(polygon[i - 1])],
                 &r = mesh.points[std::size_t(polygon[i])];
      area += 0.5 * ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
    }
  return std::abs(area);
}

Border_comparison compare_borders(const Labelled_mesh& mesh, const Planar_domain& domain)
{
  Border_comparison result;
  const Curve_locator locator(domain);
  for (const std::array<int, 2>& edge : border_edges(mesh)) {
    const auto& p = mesh.points[std::size_t(edge[0])];
    result.distance_max = std::max(result.distance_max, locator.nearest({p[0], p[1]}).distance);
  }
  CGAL::Bbox_2 box;
  double area = 0;
  for (const auto v : domain.mesh.vertices())
    box += domain.mesh.point(v).bbox();
  for (const auto f : domain.mesh.faces()) {
    const auto h = domain.mesh.halfedge(f);
    area += CGAL::area(domain.mesh.point(domain.mesh.source(h)), domain.mesh.point(domain.mesh.target(h)),
                       domain.mesh.point(domain.mesh.target(domain.mesh.next(h))));
  }
  result.relative_max = result.distance_max / std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin());
  result.area_relative = area_of(mesh) / area - 1;
  return result;
}

/// Whether there are distances at all: points that nothing uses do not matter.
bool is_finite(const Labelled_mesh& mesh)
{
  const auto is_finite_vertex = [&](int v) {
    const std::array<double, 3>& p = mesh.points[std::size_t(v)];
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  };
  const auto is_finite_element = [&](const auto& vertices) {
    return std::all_of(vertices.begin(), vertices.end(), is_finite_vertex);
  };
  return std::all_of(mesh.polygons.begin(), mesh.polygons.end(), is_finite_element) &&
         std::all_of(mesh.lines.begin(), mesh.lines.end(), is_finite_element);
}

/// What is said about a mesh and the domain that it should be of: the entry of the JSON summary, and a line.
struct Comparison_report {
  Json json;
  std::string line;
};

Comparison_report compare(const Labelled_mesh& mesh, const Planar_domain& domain)
{
  const Border_comparison comparison = compare_borders(mesh, domain);
  std::ostringstream line;
  line << "border within " << comparison.distance_max << " (" << comparison.relative_max
       << " of the diagonal), area changed by " << 100 * comparison.area_relative << " %";
  return {{{"border_distance_max", comparison.distance_max},
           {"border_distance_max_relative", comparison.relative_max},
           {"area_change_relative", comparison.area_relative}},
          line.str()};
}

Comparison_report compare(const Labelled_mesh& mesh, const Surface_domain& domain)
{
  const Surface_comparison comparison = compare_with_surface(mesh, domain);
  std::ostringstream line;
  line << "surface within " << comparison.hausdorff << " (" << comparison.hausdorff_relative
       << " of the diagonal), features within " << comparison.feature_distance_max << " ("
       << comparison.feature_distance_max_relative << "), area changed by " << 100 * comparison.area_relative << " %, "
       << comparison.flipped_quads << " quads flipped";
  return {json_of(comparison), line.str()};
}

void print_summary(Console& console, const std::string& name, const Mesh_validity& validity,
                   const Mesh_summary& summary)
{
  std::ostringstream line;
  line.precision(3);
  const Mesh_quality& quality = summary.quality;
  line << name << ": " << summary.vertices << " vertices, " << summary.quads << " quads, " << validity.components
       << " components, " << validity.boundary_loops << " boundary loops";
  console.print(line.str());
  line.str("");
  line << "scaled Jacobian min " << quality.scaled_jacobian_min << " mean " << quality.scaled_jacobian_mean
       << ", skew mean " << quality.skew_mean << " max " << quality.skew_max << " degrees";
  console.print(line.str());
  line.str("");
  const Mesh_distortion& distortion = summary.distortion;
  line << "edges of " << distortion.edge_length_percentile_1 << " to " << distortion.edge_length_percentile_99
       << " (1st to 99th percentile), median " << distortion.edge_length_median << "; distortion of areas "
       << distortion.area.mean << ", of aspects " << distortion.aspect.mean;
  console.print(line.str());
  line.str("");
  line << "irregular interior vertices:";
  for (const auto& [valence, n] : quality.irregular)
    line << ' ' << n << " of valence " << valence << ';';
  if (quality.irregular.empty())
    line << " none";
  console.print(line.str());
  if (summary.size_error) {
    line.str("");
    line << "size error mean " << summary.size_error->length.mean << " max " << summary.size_error->length.max << " on "
         << summary.size_error->length.n << " edges";
    console.print(line.str());
  }
}

} // namespace

void run_check_command(const Check_arguments& arguments)
{
  Console console(arguments.quiet);
  if (!arguments.json.empty())
    check_can_write(arguments.json);
  Size_specification specification;
  for (const std::string& size : arguments.sizes)
    specification.add(size);
  const Labelled_mesh mesh = read_mesh(arguments.mesh);
  Mesh_validity validity = check_quad_mesh(mesh);
  if (mesh.polygons.empty())
    throw Invalid_input_error(arguments.mesh + ": there are no polygons");

  Mesh_summary summary;
  Comparison_report report;
  const bool is_compared = !arguments.against.empty() && is_finite(mesh);
  if (!is_compared) {
    summary = summarize(mesh);
  } else {
    Planar_domain_options planar;
    Surface_domain_options surface;
    planar.repair = surface.repair = arguments.repair;
    const std::variant<Planar_domain, Surface_domain> against = read_domain(arguments.against, planar, surface);
    if (std::holds_alternative<Planar_domain>(against) && !is_planar(mesh))
      validity.problems.push_back("z is not constant, and " + arguments.against + " is a planar domain");
    std::visit(
        [&](const auto& domain) {
          summary = summarize(mesh, domain, specification.apply(domain));
          report = compare(mesh, domain);
        },
        against);
    console.print("against " + arguments.against + ": " + report.line);
  }

  Json json;
  json["input"] = {{"vertices", mesh.points.size()},
                   {"faces", mesh.polygons.size()},
                   {"boundary_loops", validity.boundary_loops},
                   {"euler_characteristic", validity.euler_characteristic}};
  json["valid"] = validity.is_valid();
  json["problems"] = validity.problems;
  if (is_compared)
    json["against"] = report.json;
  json["mesh"] = json_of(summary);
  json["version"] = QUADRILLE_VERSION;
  print_summary(console, arguments.mesh, validity, summary);
  if (!arguments.json.empty())
    write_file(arguments.json, json.dump(2) + "\n");
  if (!validity.is_valid())
    throw No_result_error(arguments.mesh, "not a valid quad mesh: " + validity.problems[0] +
                                              (validity.problems.size() > 1 ? " (and other problems)" : ""));
}

} // namespace Quadrille
