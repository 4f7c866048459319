// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "surface_run.h"

#include "Quad_run.h"
#include "Surface_pipeline.h"
#include "count_option.h"
#include "domain_constraints.h"
#include "integer_grid.h"
#include "json_summary.h"
#include "picture_file.h"
#include "surface_output.h"
#include "surface_picture.h"

#include <Quadrille/Size_specification.h>
#include <Quadrille/read_size_field.h>
#include <Quadrille/write_mesh.h>

#include <CGAL/Polygon_mesh_processing/measure.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {

namespace {

/// The state that the steps of a run hand on.
class Surface_run : public Quad_run {
public:
  Surface_run(const Quad_arguments& arguments, Surface_domain domain, std::chrono::steady_clock::time_point start)
      : Quad_run(arguments, start), m_domain(std::move(domain))
  {
  }

private:
  /// Options of what is not done on surfaces are no mistakes that one should overlook.
  void check_options() const
  {
    const std::pair<const char*, bool> given[] = {
        {"--impose-size-field", m_arguments.impose_size_field},
        {"--solver lbfgs-kappa", m_arguments.solver == Field_solver_kind::lbfgs_kappa}};
    for (const auto& [option, is_given] : given)
      if (is_given)
        throw Invalid_argument_error(std::string("option ") + option + " is for planar domains, and " +
                                     m_arguments.input + " is a surface");
  }

  void prepare() override
  {
    check_options();
    const Size_specification specification = size_specification_of(m_arguments);
    if (const std::string item = specification.anisotropic_item(); !item.empty() && m_arguments.isotropic)
      throw Invalid_argument_error("size '" + item +
                                   "': different sizes across and along a curve need anisotropic frames; leave out "
                                   "--isotropic or give equal sizes");
    m_typical_size = specification.typical_size(m_domain);
    if (!m_arguments.size_field.empty())
      m_target_size = read_size_field(m_arguments.size_field, m_domain);
    const double factor = scale_sizes_for_number();
    m_sizes = specification.apply(m_domain, factor);
    remove_unaligned_curves(m_domain, m_arguments.unaligned);
    m_counts = split_off_counted_curves(m_arguments.counts, m_domain);
    m_is_weak = remove_weak_curves(m_domain, m_arguments.weak);
    std::ostringstream line;
    line << m_arguments.input << ": a surface of " << m_domain.mesh.number_of_faces() << " triangles, "
         << m_domain.curves.size() << " curves";
    m_console.print(line.str());
    print_notes(m_domain.notes);
    print_notes(m_sizes.notes);
  }

  /// \return the factor
  double scale_sizes_for_number()
  {
    double area = 0;
    for (const auto f : m_domain.mesh.faces())
      area += CGAL::Polygon_mesh_processing::face_area(f, m_domain.mesh);
    const double factor =
        factor_for_number(m_arguments.quads, area / (m_typical_size * m_typical_size), m_domain.notes);
    m_typical_size *= factor;
    for (double& size : m_target_size)
      size *= factor;
    return factor;
  }

  /// Whether somebody wants them: then the field should not prefer the typical one anywhere.
  bool has_different_sizes() const
  {
    if (m_sizes.by_default)
      return !m_target_size.empty();
    double least = std::numeric_limits<double>::infinity(), largest = 0;
    for (const auto& ends : m_sizes.of_edge)
      for (const Frame_size& size : ends)
        for (const double s : {size.normal, size.tangential})
          if (s > 0) {
            least = std::min(least, s);
            largest = std::max(largest, s);
          }
    return !m_target_size.empty() || largest > 1.001 * least;
  }

  void compute() override
  {
    Surface_pipeline_options options;
    options.field.isotropic = m_arguments.isotropic;
    options.field.integrable = !m_arguments.smooth;
    options.field.weights = m_arguments.preset.value_or(has_different_sizes() ? Surface_field_weights::sizing()
                                                                              : Surface_field_weights::isometric());
    options.field.typical_size = m_typical_size;
    options.field.target_size = m_target_size;
    options.field.target_size_weight = m_arguments.size_field_weight;
    options.field.solver = m_arguments.solver;
    options.field.terms_as_in_paper = m_arguments.solver == Field_solver_kind::lbfgs;
    options.field.starts =
        m_arguments.starts.value_or(default_number_of_surface_starts(m_domain.mesh.number_of_faces()));
    options.field.seed = m_arguments.seed;
    options.field.threads = m_arguments.threads;
    options.field.observer = &m_console.observer();
    options.make_quads = !m_arguments.outputs.empty();
    options.extraction.layout = m_arguments.layout;
    options.extraction.counts = m_counts;
    options.extraction.quads = m_arguments.quads;
    options.extraction.displacements = !m_arguments.map.empty();
    options.extraction.threads = m_arguments.threads;
    options.extraction.max_quads = 4 * m_arguments.max_quads; // sizes are met approximately
    options.extraction.observer = &m_console.observer();
    options.quantizer = m_arguments.quantizer;
    run_surface_pipeline(m_domain, constraints_of(m_domain, m_sizes, m_is_weak), options, m_result);
    m_result.size_error = measure_map_sizes(m_domain, m_sizes, m_result.corner_uv);
    if (!m_result.extraction)
      return;
    const auto start = std::chrono::steady_clock::now();
    scale_sizes(m_sizes, 1 / m_result.extraction->scale);
    m_mesh_summary = summarize(m_result.mesh, m_domain, m_sizes);
    m_check_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!m_arguments.map.empty())
      m_integer_grid = make_integer_grid(m_domain, m_result.corner_uv, *m_result.extraction, m_arguments.threads);
  }

  void write_field_and_picture() const
  {
    const auto [u, v] = frame_vectors(m_domain, m_result.gradients);
    if (!m_arguments.field.empty()) {
      std::vector<int> valence(m_domain.mesh.number_of_vertices(), 4);
      for (const auto& [vertex, n] : m_result.singular_vertices)
        valence[std::size_t(vertex.idx())] = n;
      write_frame_field(m_arguments.field, m_domain, u, v, valence);
    }
    if (!m_arguments.picture.empty())
      write_picture_file(m_arguments.picture, surface_picture(surface_drawing(m_domain, m_result)));
  }

  void write() override
  {
    for (const std::string& output : m_arguments.outputs)
      write_mesh(output, m_result.mesh);
    write_field_and_picture();
    if (m_integer_grid)
      write_corner_map(m_arguments.map, m_domain, m_integer_grid->corner_uv);
    if (!m_arguments.seamless_map.empty())
      write_corner_map(m_arguments.seamless_map, m_domain, m_result.corner_uv);
  }

  void write_what_there_is() override
  {
    if (!m_result.singular_vertices.empty() || m_result.quarter_index_sum != 0) // the field is complete
      write_field_and_picture();
  }

  Json summary() const override
  {
    Json json;
    json["input"] = json_of(m_domain);
    add_stages(m_result, m_arguments.solver, json);
    if (m_mesh_summary) {
      json["mesh"] = json_of(*m_mesh_summary);
      json["mesh"]["seconds"] = m_result.extraction->mesh_seconds + m_check_seconds;
    }
    if (m_integer_grid)
      json["map"]["integer_grid"] = {{"flipped", m_integer_grid->flipped}, {"seconds", m_integer_grid->seconds}};
    return json;
  }

  void report() override
  {
    if (m_integer_grid && m_integer_grid->flipped > 0)
      m_console.print(note_on_integer_grid(m_arguments.map, *m_integer_grid));
    std::map<int, int> counts;
    for (const auto& [vertex, valence] : m_result.singular_vertices)
      ++counts[valence];
    std::ostringstream line;
    line.precision(3);
    line << "singularities: " << text_of_counts(counts) << "; index sum " << 0.25 * m_result.quarter_index_sum;
    if (m_result.map) {
      line << ", integration error " << m_result.map->integration_error << " (smooth field: ";
      if (m_result.smooth_integration_error >= 0)
        line << m_result.smooth_integration_error;
      else
        line << "none";
      line << ")";
      if (m_result.size_error)
        line << ", size error on curves mean " << m_result.size_error->mean << " max " << m_result.size_error->max;
      if (const std::size_t n = m_result.map->flipped_faces.size(); n > 0)
        line << ", " << n << " triangles of the map are flipped";
    }
    line << ", " << seconds() << " s";
    m_console.print(line.str());
    if (m_mesh_summary)
      report_mesh();
  }

  void report_mesh()
  {
    if (!m_result.extraction->quantization.note.empty())
      m_console.print(m_result.extraction->quantization.note);
    std::ostringstream line;
    line.precision(3);
    const Mesh_quality& quality = m_mesh_summary->quality;
    line << m_arguments.outputs.front() << ": " << m_mesh_summary->quads << " quads, scaled Jacobian min "
         << quality.scaled_jacobian_min << " mean " << quality.scaled_jacobian_mean << ", skew mean "
         << quality.skew_mean << " max " << quality.skew_max << " degrees";
    if (m_mesh_summary->size_error && m_mesh_summary->size_error->length.n > 0)
      line << ", size error mean " << m_mesh_summary->size_error->length.mean;
    m_console.print(line.str());
  }

  Surface_domain m_domain;
  Domain_sizes m_sizes;
  double m_typical_size = 0;
  std::vector<double> m_target_size;
  std::vector<char> m_is_weak; ///< edges
  std::vector<Curve_count> m_counts;
  Surface_pipeline_result m_result;
  std::optional<Mesh_summary> m_mesh_summary;
  std::optional<Integer_grid> m_integer_grid;
  double m_check_seconds = 0;
};

} // namespace

void run_on_surface(const Quad_arguments& arguments, Surface_domain domain, std::chrono::steady_clock::time_point start)
{
  Surface_run(arguments, std::move(domain), start).run();
}

} // namespace Quadrille
