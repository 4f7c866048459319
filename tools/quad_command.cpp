// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "quad_command.h"

#include "Console.h"
#include "Quad_pipeline.h"
#include "domain_constraints.h"
#include "json_summary.h"
#include "output_files.h"
#include "picture_file.h"
#include "pipeline_output.h"
#include "surface_run.h"
#include "svg_picture.h"

#include <Quadrille/Mesh_quality.h>
#include <Quadrille/Size_specification.h>
#include <Quadrille/estimate_quads.h>
#include <Quadrille/read_domain.h>
#include <Quadrille/read_size_field.h>
#include <Quadrille/write_file.h>
#include <Quadrille/write_mesh.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <variant>

namespace Quadrille {

namespace {

using Json = nlohmann::ordered_json;

void check_outputs(const Quad_arguments& arguments)
{
  for (const std::string& output : arguments.outputs)
    mesh_file_format(output);
  if (!arguments.picture.empty())
    check_picture_name(arguments.picture);
  check_ending(arguments.field, ".vtu");
  check_ending(arguments.map, ".obj");
  std::vector<std::string> paths = arguments.outputs;
  paths.insert(paths.end(), {arguments.field, arguments.map, arguments.picture, arguments.json});
  check_output_files(paths, {arguments.input});
}

Size_specification sizes_of(const Quad_arguments& arguments)
{
  Size_specification specification;
  for (const std::string& size : arguments.sizes)
    specification.add(size);
  return specification;
}

std::variant<Planar_domain, Surface_domain> read(const Quad_arguments& arguments)
{
  Planar_domain_options planar;
  planar.triangle_size = arguments.triangle_size;
  for (const auto& [name, size] : sizes_of(arguments).thin_curves())
    planar.curve_triangle_size[name] = 1.5 * size; // the field is linear in each triangle
  Surface_domain_options surface;
  surface.triangle_size = arguments.triangle_size;
  surface.crease_angle = arguments.crease_angle.value_or(surface.crease_angle);
  return read_domain(arguments.input, planar, surface);
}

/// One run of the program on a planar domain: the state that its steps hand on.
class Quad_run {
public:
  Quad_run(const Quad_arguments& arguments, Planar_domain domain, std::chrono::steady_clock::time_point start)
      : m_arguments(arguments), m_console(arguments.quiet), m_start(start), m_domain(std::move(domain))
  {
  }

  void run()
  {
    prepare();
    try {
      compute();
    } catch (const Error& error) {
      const auto* no_result = dynamic_cast<const No_result_error*>(&error);
      m_summary["error"] = {{"stage", no_result ? no_result->stage() : "run"}, {"message", error.what()}};
      write_summary();
      throw;
    }
    write();
    write_summary();
    report();
  }

private:
  void prepare()
  {
    for (const auto& [option, is_given] : {std::pair("--preset", m_arguments.preset.has_value()),
                                           std::pair("--crease-angle", m_arguments.crease_angle.has_value())})
      if (is_given)
        throw Invalid_argument_error(std::string("option ") + option + " is for surfaces, and " + m_arguments.input +
                                     " is a planar domain");
    if (m_arguments.outputs.empty())
      throw Invalid_argument_error("no output file is given; use -o OUT");
    const Size_specification specification = sizes_of(m_arguments);
    if (const std::string item = specification.anisotropic_item(); !item.empty() && !m_arguments.anisotropic)
      throw Invalid_argument_error("size '" + item +
                                   "': different sizes across and along a curve need anisotropic frames; add "
                                   "--anisotropic or give equal sizes");
    m_sizes = specification.apply(m_domain);
    remove_unaligned_curves(m_domain, m_arguments.unaligned);
    check_number_of_quads();
    m_counts = split_off_counted_curves(m_arguments.counts, m_domain);
    if (!m_arguments.size_field.empty())
      m_size_field = read_size_field(m_arguments.size_field, m_domain);
    else if (std::all_of(m_sizes.of_edge.begin(), m_sizes.of_edge.end(),
                         [](const auto& ends) { return ends[0].is_free() && ends[1].is_free(); }))
      throw Invalid_argument_error(
          "all sizes are free, so elements of any size would do; prescribe one on some curve, or "
          "inside with --size-field");
    if (!m_size_field.metric.empty() && !m_arguments.anisotropic)
      throw Invalid_argument_error(m_arguments.size_field + ": metrics, and places with two sizes, need anisotropic " +
                                   "frames; add --anisotropic or give one size at each place");
    std::ostringstream line;
    line << m_arguments.input << ": " << m_domain.mesh.number_of_faces() << " triangles";
    if (m_domain.triangle_size > 0)
      line << (m_arguments.triangle_size > 0 ? ", largest edge " : ", largest edge (chosen) ")
           << m_domain.triangle_size;
    m_console.print(line.str());
    for (const auto* notes : {&m_domain.notes, &m_sizes.notes})
      for (const std::string& note : *notes)
        m_console.print(note);
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

  void compute()
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
    options.quantizer = m_arguments.quantizer;
    options.extraction.max_quads = 4 * m_arguments.max_quads; // the estimate may be off by a factor
    options.observer = &m_console.observer();
    run_quad_pipeline(m_domain, constraints_of(m_domain, m_sizes), options, m_result);
    const auto start = std::chrono::steady_clock::now();
    m_mesh = labelled_quads(m_domain, m_result);
    const Mesh_validity validity = check_quad_mesh(m_mesh);
    if (!validity.is_valid())
      throw No_result_error("mesh", validity.problems[0]);
    m_mesh_summary = summarize(m_mesh, &m_domain, &m_sizes);
    m_check_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  void write()
  {
    for (const std::string& output : m_arguments.outputs)
      write_mesh(output, m_mesh);
    const Planar_domain& domain = m_result.refined_domain ? *m_result.refined_domain : m_domain;
    if (!m_arguments.field.empty()) {
      const Frames frames = frames_of(domain, m_result);
      write_frame_field(m_arguments.field, domain, frames.u, frames.v, frames.valence);
    }
    if (!m_arguments.map.empty())
      write_corner_map(m_arguments.map, domain, m_result.corner_uv);
    if (!m_arguments.picture.empty())
      write_picture_file(m_arguments.picture, svg_picture(domain, m_result));
  }

  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count(); }

  void write_summary()
  {
    if (m_arguments.json.empty())
      return;
    Json json;
    json["input"] = json_of(m_domain);
    add_stages(m_result, m_arguments.solver, json);
    if (m_mesh_summary) {
      json["mesh"] = json_of(*m_mesh_summary);
      json["mesh"]["seconds"] = m_result.extraction->mesh_seconds + m_check_seconds;
    }
    json.update(m_summary);
    json["seconds"] = seconds();
    json["threads"] = m_arguments.threads > 0 ? m_arguments.threads : int(std::thread::hardware_concurrency());
    json["seed"] = m_arguments.seed;
    json["version"] = QUADRILLE_VERSION;
    write_file(m_arguments.json, json.dump(2) + "\n");
  }

  void report()
  {
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

  const Quad_arguments& m_arguments;
  Console m_console;
  std::chrono::steady_clock::time_point m_start;
  Planar_domain m_domain;
  Domain_sizes m_sizes;
  std::vector<Curve_count> m_counts;
  Size_field m_size_field;
  Quad_pipeline_result m_result;
  Labelled_mesh m_mesh;
  std::optional<Mesh_summary> m_mesh_summary;
  double m_check_seconds = 0;
  Json m_summary = Json::object();
};

} // namespace

void run_quad_command(const Quad_arguments& arguments)
{
  const auto start = std::chrono::steady_clock::now();
  check_outputs(arguments);
  std::variant<Planar_domain, Surface_domain> domain = read(arguments);
  if (auto* planar = std::get_if<Planar_domain>(&domain))
    Quad_run(arguments, std::move(*planar), start).run();
  else
    run_on_surface(arguments, std::move(std::get<Surface_domain>(domain)), start);
}

} // namespace Quadrille
