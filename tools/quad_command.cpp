// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "quad_command.h"

#include "domain_constraints.h"
#include "output_files.h"
#include "picture_file.h"
#include "planar_run.h"
#include "surface_run.h"

#include <Quadrille/read_domain.h>
#include <Quadrille/write_mesh.h>

#include <chrono>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace Quadrille {

namespace {

void check_outputs(const Quad_arguments& arguments)
{
  for (const std::string& output : arguments.outputs)
    mesh_file_format(output);
  if (!arguments.picture.empty())
    check_picture_name(arguments.picture);
  check_ending(arguments.field, ".vtu");
  check_ending(arguments.map, ".obj");
  check_ending(arguments.seamless_map, ".obj");
  std::vector<std::string> paths = arguments.outputs;
  paths.insert(paths.end(),
               {arguments.field, arguments.map, arguments.seamless_map, arguments.picture, arguments.json});
  check_output_files(paths, {arguments.input});
}

std::variant<Planar_domain, Surface_domain> read(const Quad_arguments& arguments)
{
  Planar_domain_options planar;
  planar.triangle_size = arguments.triangle_size;
  for (const auto& [name, size] : size_specification_of(arguments).thin_curves())
    planar.curve_triangle_size[name] = 1.5 * size; // the field is linear in each triangle
  Surface_domain_options surface;
  surface.triangle_size = arguments.triangle_size;
  planar.repair = surface.repair = arguments.repair;
  surface.crease_angle = arguments.crease_angle.value_or(surface.crease_angle);
  return read_domain(arguments.input, planar, surface);
}

} // namespace

void run_quad_command(const Quad_arguments& arguments)
{
  const auto start = std::chrono::steady_clock::now();
  check_outputs(arguments);
  std::variant<Planar_domain, Surface_domain> domain = read(arguments);
  if (auto* planar = std::get_if<Planar_domain>(&domain))
    run_on_planar_domain(arguments, std::move(*planar), start);
  else
    run_on_surface(arguments, std::move(std::get<Surface_domain>(domain)), start);
}

} // namespace Quadrille
