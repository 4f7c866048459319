// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "planar_run.h"

#include "Quad_pipeline.h"
#include "Quad_run.h"
#include "domain_constraints.h"
#include "integer_grid.h"
#include "json_summary.h"
#include "picture_file.h"
#include "pipeline_output.h"
#include "svg_picture.h"

#include <Quadrille/Mesh_quality.h>
#include <Quadrille/Size_specification.h>
#include <Quadrille/estimate_quads.h>
#include <Quadrille/read_size_field.h>
#include <Quadrille/write_mesh.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {

namespace {

/// The state that the steps of a run hand on.
class Planar_run : public Quad_run {
public:
  Planar_run(const Quad_arguments& arguments, Planar_domain domain, std::chrono::steady_clock::time_point start)
      : Quad_run(arguments, start), m_domain(std::move(domain))
  {
  }

private:
  void prepare() override
  {
    for (const auto& [option, is_given] :
         {std::pair("--weak", !m_arguments.weak.empty()), std::pair("--preset", m_arguments.preset.has_value()),
          std::pair("--crease-angle", m_arguments.crease_angle.has_value())})
      if (is_given)
        throw Invalid_argument_error(std::string("option ") + option + " is for surfaces, and " + m_arguments.input +
                                     " is a planar domain");
    if (m_arguments.outputs.empty())
      throw Invalid_argument_error("no output file is given; use -o OUT");
    const Size_specification specification = size_specification_of(m_arguments);
    if (const std::string item = specification.anisotropic_item(); !item.empty() && !m_arguments.anisotropic)
      throw Invalid_argument_error("size '" + item +
                                   "': different sizes across and along a curve need anisotropic frames; add "
                                   "--anisotropic or give equal sizes");
    const double factor = factor_for_number(
        m_arguments.quads, estimate_number_of_quads(m_domain, specification.apply(m_domain)), m_domain.notes);
    m_sizes = specification.apply(m_domain, factor);
    remove_unaligned_curves(m_domain, m_arguments.unaligned);
    check_number_of_quads();
    m_counts = split_off_counted_curves(m_arguments.counts, m_domain);
    if (!m_arguments.size_field.empty()) {
      m_size_field = read_size_field(m_arguments.size_field, m_domain);
      scale_size_field(factor);
    } else if (std::all_of(m_sizes.of_edge.begin(), m_sizes.of_edge.end(),
                           [](const auto& ends) { return ends[0].is_free() && ends[1].is_free(); })) {
      throw Invalid_argument_error(
          "all sizes are free, so elements of any size would do; prescribe one on some curve, or "
          "inside with --size-field");
    }
    if (!m_size_field.metric.empty() && !m_arguments.anisotropic)
      throw Invalid_argument_error(m_arguments.size_field + ": metrics, and places with two sizes, need anisotropic " +
                                   "frames; add --anisotropic or give one size at each place");
    std::ostringstream line;
    line << m_arguments.input << ": " << m_domain.mesh.number_of_faces() << " triangles";
    if (m_domain.triangle_size > 0)
      line << (m_arguments.triangle_size > 0 ? ", largest edge " : ", largest edge (chosen) ")
           << m_domain.triangle_size;
    m_console.print(line.str());
    print_notes(m_domain.notes);
    print_notes(m_sizes.notes);
  }

  void scale_size_field(double factor)
  {
    for (double& size : m_size_field.size)
      size *= factor;
    for (Eigen::Matrix2d& metric : m_size_field.metric)
      metric /= factor * factor;
  }

  /// A size that is too small by mistake should not cost hours and all memory.
  void check_number_of_quads() const
  {
    const double n = estimate_number_of_quads(m_domain, m_sizes);
    if (n <= double(m_arguments.max_quads))
      return;
    std::ostringstream message;
    message.precision(2);
    message << m_arguments.input << ": the sizes ask for about " << n << " quads, and the limit is "
            << m_arguments.max_quads << "; give larger sizes, or raise the limit with --max-quads";
    throw Invalid_argument_error(message.str());
  }

  void compute() override
  {
    Quad_pipeline_options options;
    options.field.isotropic = !m_arguments.anisotropic;
    options.field.integrable = !m_arguments.smooth;
    options.field.target_size = m_size_field.size;
    options.field.target_metric = m_size_field.metric;
    options.field.target_size_weight = m_arguments.size_field_weight;
    options.field.impose_target_size = m_arguments.impose_size_field;
    options.field.solver = m_arguments.solver;
    options.field.starts = m_arguments.starts.value_or(default_number_of_starts(m_domain.mesh.number_of_faces()));
    options.field.seed = m_arguments.seed;
    options.field.threads = m_arguments.threads;
    options.extraction.layout = m_arguments.layout;
    options.extraction.counts = m_counts;
    options.extraction.quads = m_arguments.quads;
    options.extraction.displacements = !m_arguments.map.empty();
    options.quantizer = m_arguments.quantizer;
    options.extraction.max_quads = 4 * m_arguments.max_quads; // the estimate may be off by a factor
    options.observer = &m_console.observer();
    run_quad_pipeline(m_domain, constraints_of(m_domain, m_sizes), options, m_result);
    const auto start = std::chrono::steady_clock::now();
    scale_sizes(m_sizes, 1 / m_result.extraction->scale);
    m_mesh_summary = summarize(m_result.mesh, m_domain, m_sizes);
    m_check_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!m_arguments.map.empty())
      m_integer_grid =
          make_integer_grid(triangulated_domain(), m_result.corner_uv, *m_result.extraction, m_arguments.threads);
  }

  void write() override
  {
    for (const std::string& output : m_arguments.outputs)
      write_mesh(output, m_result.mesh);
    const Planar_domain& domain = triangulated_domain();
    if (!m_arguments.field.empty()) {
      const Frames frames = frames_of(domain, m_result);
      write_frame_field(m_arguments.field, domain, frames.u, frames.v, frames.valence);
    }
    if (m_integer_grid)
      write_corner_map(m_arguments.map, domain, m_integer_grid->corner_uv);
    if (!m_arguments.seamless_map.empty())
      write_corner_map(m_arguments.seamless_map, domain, m_result.corner_uv);
    if (!m_arguments.picture.empty())
      write_picture_file(m_arguments.picture, svg_picture(domain, m_result));
  }

  /// The triangles on which field and map are.
  const Planar_domain& triangulated_domain() const
  {
    return m_result.refined_domain ? *m_result.refined_domain : m_domain;
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
    if (!m_result.extraction->quantization.note.empty())
      m_console.print(m_result.extraction->quantization.note);
    std::ostringstream line;
    line.precision(3);
    if (const double change = m_result.extraction->area_change_relative; change > 1) {
      line << "holes, corners and gaps smaller than the elements need " << 1 + change
           << " times as many quads as the sizes ask for";
      m_console.print(line.str());
      line.str("");
    }
    line << "integration error " << m_result.map->integration_error << " (smooth field: ";
    if (m_result.smooth_integration_error >= 0)
      line << m_result.smooth_integration_error;
    else
      line << "none";
    line << "), singularities: " << text_of_counts(m_result.map->singularities);
    m_console.print(line.str());
    line.str("");
    const Mesh_quality& quality = m_mesh_summary->quality;
    line << m_arguments.outputs.front() << ": " << m_mesh_summary->quads << " quads, scaled Jacobian min "
         << quality.scaled_jacobian_min << " mean " << quality.scaled_jacobian_mean << ", skew mean "
         << quality.skew_mean << " max " << quality.skew_max << " degrees";
    if (m_mesh_summary->size_error)
      line << ", size error mean " << m_mesh_summary->size_error->length.mean;
    line << ", " << seconds() << " s";
    m_console.print(line.str());
  }

  Planar_domain m_domain;
  Domain_sizes m_sizes;
  std::vector<Curve_count> m_counts;
  Size_field m_size_field;
  Quad_pipeline_result m_result;
  std::optional<Mesh_summary> m_mesh_summary;
  std::optional<Integer_grid> m_integer_grid;
  double m_check_seconds = 0;
};

} // namespace

void run_on_planar_domain(const Quad_arguments& arguments, Planar_domain domain,
                          std::chrono::steady_clock::time_point start)
{
  Planar_run(arguments, std::move(domain), start).run();
}

} // namespace Quadrille
