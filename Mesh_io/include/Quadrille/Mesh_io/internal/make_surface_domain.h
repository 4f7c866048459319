// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_MAKE_SURFACE_DOMAIN_H
#define QUADRILLE_MESH_IO_INTERNAL_MAKE_SURFACE_DOMAIN_H

#include <Quadrille/Mesh_io/internal/Creases.h>
#include <Quadrille/Mesh_io/internal/Curve_tracer.h>
#include <Quadrille/Mesh_io/internal/check_surface.h>
#include <Quadrille/Mesh_io/internal/domain_faces.h>
#include <Quadrille/Mesh_io/internal/split_chords_in_space.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/Surface_domain.h>
#include <Quadrille/exceptions.h>
#include <Quadrille/repair_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

inline void check_options(const Surface_domain_options& options)
{
  if (!(options.triangle_size >= 0) || !std::isfinite(options.triangle_size))
    throw Invalid_argument_error("the triangle size must be a positive number");
  if (!(options.crease_angle > 0 && options.crease_angle <= 180))
    throw Invalid_argument_error("the crease angle must be above 0 and at most 180 degrees");
  if (!(options.edges_per_circle >= 3) || !(options.edges_per_curve >= 1) || !(options.size_gradation > 0) ||
      options.max_triangles < 1 || !(options.corner_degrees > 0 && options.corner_degrees < 180) ||
      !(options.time_limit_seconds > 0))
    throw Invalid_argument_error("an option of reading surfaces is out of range");
}

/// The boundary edges of regions inside a surface.
inline std::vector<Surface_domain::halfedge_descriptor> edges_between_regions(const Surface_domain& domain)
{
  const auto region = [&](auto h) { return domain.face_region[std::size_t(domain.mesh.face(h).idx())]; };
  std::vector<Surface_domain::halfedge_descriptor> result;
  for (const auto e : domain.mesh.edges())
    if (const auto h = domain.mesh.halfedge(e);
        !domain.mesh.is_border(e) && region(h) != region(domain.mesh.opposite(h)))
      result.push_back(h);
  return result;
}

/// The edges inside a surface that are lines of the input.
inline std::set<Surface_domain::edge_descriptor> lines_inside(const Surface_domain& domain, const Labelled_mesh& input,
                                                              const std::vector<int>& point_of_input)
{
  using Vertex = Surface_domain::vertex_descriptor;
  std::set<Surface_domain::edge_descriptor> result;
  for (const std::array<int, 2>& line : input.lines) {
    const int a = point_of_input[std::size_t(line[0])], b = point_of_input[std::size_t(line[1])];
    if (a < 0 || b < 0)
      continue;
    const auto h = domain.mesh.halfedge(Vertex(Vertex::size_type(a)), Vertex(Vertex::size_type(b)));
    if (h != Surface_domain::Mesh::null_halfedge() && !domain.mesh.is_border(domain.mesh.edge(h)))
      result.insert(domain.mesh.edge(h));
  }
  return result;
}

inline std::string in_words(const char* format, double value)
{
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// Features inside that are not lines of the input: edges between regions or, if the input marks nothing inside,
/// creases. Says in a note which.
inline std::vector<Surface_domain::halfedge_descriptor> find_unlabelled_features(const Labelled_mesh& input,
                                                                                 const std::vector<int>& point_of_input,
                                                                                 const Surface_domain_options& options,
                                                                                 Surface_domain& domain)
{
  const std::vector<Surface_domain::halfedge_descriptor> between = edges_between_regions(domain);
  const auto lines = lines_inside(domain, input, point_of_input);
  if (!lines.empty() || !between.empty()) {
    const std::size_t n_between = std::size_t(
        std::count_if(between.begin(), between.end(), [&](auto h) { return lines.count(domain.mesh.edge(h)) == 0; }));
    std::string text;
    if (!lines.empty())
      text = std::to_string(lines.size()) + " edges on lines of the file";
    if (n_between > 0)
      text +=
          (text.empty() ? "" : ", ") + std::to_string(n_between) + (text.empty() ? " edges" : "") + " between regions";
    domain.notes.push_back("features inside the surface: " + text);
    return between;
  }
  if (options.crease_angle == 180) {
    domain.notes.push_back("the file marks no features inside the surface, and creases are not looked for");
    return {};
  }
  Creases creases(domain.mesh, options.crease_angle, options.min_crease_edges);
  std::string text = "the file marks no features inside the surface; creases of more than " +
                     in_words("%.3g", options.crease_angle) + " degrees are taken for them: " +
                     (creases.edges.empty() ? "none" : std::to_string(creases.edges.size()) + " edges");
  if (creases.n_noise > 0)
    text += " (and " + std::to_string(creases.n_noise) + " edges of short ones with loose ends not)";
  domain.notes.push_back(text);
  return std::move(creases.edges);
}

/// `make_surface_domain()` with checked options.
/// \param has_all_features whether the lines of the input are all features that there are inside
inline Surface_domain make_surface(const Labelled_mesh& input, const std::string& source,
                                   const Surface_domain_options& options, bool has_all_features)
{
  Checked_surface checked = Surface_checker(input, source, !has_all_features).run();
  Surface_domain domain;
  domain.source = source;
  domain.groups = input.groups;
  domain.notes = std::move(checked.notes);
  const std::vector<int> region_of_polygon = regions_of_faces(input, domain.regions);
  for (const std::size_t f : checked.polygon)
    domain.face_region.push_back(region_of_polygon[f]);
  add_faces(checked.points, checked.triangles, source, domain.mesh);
  std::vector<Surface_domain::halfedge_descriptor> features;
  if (!has_all_features)
    features = find_unlabelled_features(input, checked.point_of_input, options, domain);
  Curve_tracer<Surface_domain::Point_3>(input, checked.point_of_input, options.corner_degrees, domain).run(features);
  if (const int n = options.split_chords ? Chord_splitter_in_space(domain).run() : 0; n > 0)
    domain.notes.push_back(std::to_string(n) + (n == 1 ? " vertex was" : " vertices were") +
                           " added where triangles had all their corners on curves");
  domain.point_size.assign(domain.mesh.number_of_vertices(), 0);
  return domain;
}

} // namespace internal

QUADRILLE_INLINE Surface_domain make_surface_domain(const Labelled_mesh& input, const std::string& source,
                                                    const Surface_domain_options& options)
{
  internal::check_options(options);
  if (!options.repair)
    return internal::make_surface(input, source, options, false);
  Mesh_repair_report report;
  Surface_domain domain = internal::make_surface(repair_mesh(input, report), source, options, false);
  domain.notes.insert(domain.notes.begin(), "repaired: " + report.text());
  return domain;
}

} // namespace Quadrille

#endif
