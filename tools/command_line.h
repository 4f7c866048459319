// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_COMMAND_LINE_H
#define QUADRILLE_TOOLS_COMMAND_LINE_H

#include "count_option.h"
#include "quantizer_option.h"

#include <Quadrille/Odeco_field_options.h>
#include <Quadrille/Quad_extraction_options.h>
#include <Quadrille/Surface_field_options.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace Quadrille {

/// What the user asked `quadrille quad` for.
struct Quad_arguments {
  std::string input;
  std::vector<std::string> outputs;                    ///< the mesh in one or more formats
  std::string field, map, seamless_map, picture, json; ///< further files to write; empty: none
  std::vector<std::string> sizes;
  double triangle_size = 0;           ///< 0: chosen from the domain
  std::vector<std::string> unaligned; ///< names of curves that elements need not follow
  std::vector<std::string> weak;      ///< names of curves that elements of surfaces follow weakly
  std::string size_field;             ///< file with sizes inside; empty: none
  double size_field_weight = Odeco_field_options().target_size_weight;
  bool impose_size_field = false;
  std::size_t quads = 0;                       ///< wanted in all, by scaling the sizes; 0: as the sizes are
  std::size_t max_quads = 1000000;             ///< sizes that ask for more are refused
  bool isotropic = false, anisotropic = false; ///< neither: isotropic in the plane, anisotropic on surfaces
  std::optional<Surface_field_weights> preset; ///< of surfaces; otherwise chosen by what is prescribed
  std::optional<double> crease_angle;          ///< of surfaces, in degrees
  bool repair = false;                         ///< the mesh in `input`
  bool smooth = false;                         ///< mesh the smooth field
  Quantizer_kind quantizer = default_quantizer();
  Layout_kind layout = Quad_extraction_options().layout;
  std::vector<Count_request> counts;
  Field_solver_kind solver = Field_solver_kind::levenberg_marquardt;
  std::optional<int> starts; ///< of the field; otherwise chosen by the number of triangles
  std::uint64_t seed = Odeco_field_options().seed;
  int threads = 0; ///< 0: all cores
  bool quiet = false;
};

/// What the user asked `quadrille check` for.
struct Check_arguments {
  std::string mesh, against, json;
  std::vector<std::string> sizes;
  bool repair = false; ///< the mesh in `against`
  bool quiet = false;
};

/// What the user asked `quadrille cross` for.
struct Cross_arguments {
  std::string input;
  std::vector<std::string> outputs;   ///< the field in one or more formats
  std::string graph, picture, json;   ///< further files to write; empty: none
  std::string metric;                 ///< file with a metric; empty: the Euclidean one
  std::optional<double> crease_angle; ///< in degrees
  double tetrahedron_size = 0;        ///< of fillings; 0: chosen
  std::uint64_t seed = 0;
  int threads = 0; ///< 0: all cores
  bool quiet = false;
};

/// A command line that has been understood: one of the commands, or a text to print.
struct Command_line {
  std::optional<Quad_arguments> quad;
  std::optional<Cross_arguments> cross;
  std::optional<Check_arguments> check;
  std::string text; ///< of --help or --version
};

/// \throws Invalid_argument_error for unknown commands and options, and missing, repeated or unusable values.
Command_line parse_command_line(const std::vector<std::string>& arguments);

} // namespace Quadrille

#endif
