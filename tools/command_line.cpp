// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "command_line.h"

#include <Quadrille/exceptions.h>

#include <boost/program_options.hpp>

#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

namespace Quadrille {

namespace {

namespace po = boost::program_options;
using Strings = std::vector<std::string>;

const char* const main_help =
    R"(quadrille: quadrilateral meshes with prescribed element sizes, and cross fields in volumes

  quadrille quad IN -o OUT [options]   mesh a planar domain or a surface
  quadrille cross IN -o OUT [options]  the smoothest cross field of a volume, and its singular curves
  quadrille check MESH [options]       validity and quality of a quad mesh
  quadrille COMMAND --help             options of a command
  quadrille --version

Exit codes: 0 done, 2 unusable arguments, 3 unusable input, 4 no valid result.
)";

const char* const quad_help =
    R"(quadrille quad IN -o OUT [options]

Meshes the planar domain or the surface in space IN (.geo .step .stp .brep .iges, of a solid its boundary; triangles in
.msh .obj .off .vtk .ply .stl) with quads and writes them to OUT (.msh .vtk .vtu .obj). Sizes are lengths in the unit of
IN. Default sizes: those at the points of a .geo file, or else the diagonal of the bounding box / 40 and less at small
holes and other round outlines.

For a surface, OUT may be left out: then its frame field and seamless map are all that is computed.
)";

const char* const cross_help =
    R"(quadrille cross IN -o OUT [options]

Computes the smoothest field of crosses in a volume that is aligned with its boundary, and the graph of its singular
curves. IN is a tetrahedral mesh (.msh .mesh .vtk .node .ele .ovm), or a closed surface (.off .obj .ply .stl, or .msh
.vtk .mesh with triangles) or geometry (.step .stp .brep .iges .geo), which is filled with tetrahedra. OUT is .vtu (the
mesh with frames, harmonics and eta), .fra or .ff3 (frames per tetrahedron for other programs), or .mesh .msh .vtk (the
mesh alone).
)";

const char* const check_help =
    R"(quadrille check MESH [options]

Checks that MESH (.msh .vtk .obj .off) is a valid mesh of quads, in a plane z = constant or of a surface in space, and
measures its quality. Exit code 4 if it is not.
)";

po::options_description quad_options()
{
  po::options_description options("Options", 100);
  options.add_options()("output,o", po::value<Strings>()->value_name("OUT"),
                        "the mesh to write; repeatable, for several formats");
  options.add_options()("size", po::value<Strings>()->value_name("SIZE"),
                        "element size, repeatable: S everywhere, NAME=S on a physical group or curve tag, "
                        "NAME=A:B linear along it, NAME=NxT normal x tangential, NAME=free");
  options.add_options()("unaligned", po::value<Strings>()->value_name("NAME"),
                        "a physical group or curve tag inside that elements need not follow, repeatable; sizes "
                        "prescribed there still hold");
  options.add_options()("weak", po::value<Strings>()->value_name("NAME"),
                        "on surfaces: a physical group or curve tag inside whose direction and sizes are weighed "
                        "against integrability instead of imposed, repeatable");
  options.add_options()(
      "size-field", po::value<Strings>()->value_name("F"),
      "sizes wanted inside: a Gmsh view of sizes or metrics (.pos .msh), or lines 'x y size [radius]' "
      "or 'x y size size angle [radius]' (.txt .csv); on surfaces, views of sizes or lines 'x y z size [radius]'");
  options.add_options()("size-field-weight", po::value<Strings>()->value_name("W"),
                        "how much they matter against integrability (default 10)");
  options.add_options()("impose-size-field", "fix these sizes instead of attracting to them");
  options.add_options()("triangle-size", po::value<Strings>()->value_name("H"),
                        "largest edge of the background triangulation (default: chosen and printed)");
  options.add_options()("quads", po::value<Strings>()->value_name("N"),
                        "number of quads in all, met within 5 % unless details or --count ask for more: sizes are "
                        "multiplied by a common factor");
  options.add_options()("max-quads", po::value<Strings>()->value_name("N"),
                        "refuse sizes that ask for more quads (default 1000000)");
  options.add_options()("isotropic", "square elements (the default in the plane)");
  options.add_options()("anisotropic", "rectangular elements: sizes across and along curves may differ (the default on "
                                       "surfaces)");
  options.add_options()("preset", po::value<Strings>()->value_name("isometric|area|angle|sizing"),
                        "surfaces: keep areas and angles of elements, one of them, or only sizes prescribed on curves "
                        "(default isometric, or sizing where --size or the file prescribe different sizes)");
  options.add_options()("crease-angle", po::value<Strings>()->value_name("DEG"),
                        "surfaces in files that mark no curves: edges that bend by more are features (default 40)");
  options.add_options()("repair",
                        "mesh files: close cracks, drop degenerate and repeated triangles and orient the others "
                        "consistently first; what was done is printed");
  options.add_options()("smooth", "mesh the smooth field instead of an integrable one, for comparisons");
  options.add_options()(
      "solver", po::value<Strings>()->value_name("lm|lbfgs|lbfgs-kappa"),
      "Levenberg-Marquardt with melting and freezing (default), or the papers' L-BFGS, for comparisons");
  options.add_options()("starts", po::value<Strings>()->value_name("N"),
                        "number of starts of the field (default 8, fewer on many triangles)");
  options.add_options()("seed", po::value<Strings>()->value_name("K"), "seed of the starts (default 1)");
  options.add_options()("threads", po::value<Strings>()->value_name("T"), "threads (default 0: all cores)");
  options.add_options()("layout", po::value<Strings>()->value_name("t-mesh|base-complex"),
                        "separatrices stop where they meet earlier ones (default), or go on to their natural ends");
  options.add_options()("quantizer", po::value<Strings>()->value_name("optimal|greedy"),
                        Optimal_quantizer::is_available() ? "how lengths are made integer (default optimal)"
                                                          : "how lengths are made integer (this build: greedy only)");
  options.add_options()("count", po::value<Strings>()->value_name("NAME=N"),
                        "exactly N elements on a physical group or curve tag, repeatable");
  options.add_options()("field", po::value<Strings>()->value_name("F.vtu"), "write the frame field");
  options.add_options()("map", po::value<Strings>()->value_name("F.obj"),
                        "write the integer-grid map, whose integer isolines are the edges of the quads before they "
                        "are smoothed, as texture coordinates of the triangles");
  options.add_options()("seamless-map", po::value<Strings>()->value_name("F.obj"),
                        "write the seamless map, which lengths are not integer in yet, in the same way");
  options.add_options()("picture", po::value<Strings>()->value_name("F.svg|F.png"), "draw field, map, layout and mesh");
  options.add_options()("json", po::value<Strings>()->value_name("F.json"), "write the summary");
  options.add_options()("quiet", "print errors only");
  options.add_options()("help,h", "this text");
  return options;
}

po::options_description cross_options()
{
  po::options_description options("Options", 100);
  options.add_options()("output,o", po::value<Strings>()->value_name("OUT"),
                        "what to write; repeatable, for several formats");
  options.add_options()("graph", po::value<Strings>()->value_name("F.vtu"), "write the singular curves as lines");
  options.add_options()("metric", po::value<Strings>()->value_name("F"),
                        "sizes or metrics at the vertices of IN (.sol .txt .msh): crosses are compared by parallel "
                        "transport under them");
  options.add_options()("crease-angle", po::value<Strings>()->value_name("DEG"),
                        "edges where the boundary bends by more are creases (default 40; marked edges 10)");
  options.add_options()("tet-size", po::value<Strings>()->value_name("H"),
                        "length of edges where IN is filled with tetrahedra (default: chosen and printed)");
  options.add_options()("threads", po::value<Strings>()->value_name("T"), "threads (default 0: all cores)");
  options.add_options()("seed", po::value<Strings>()->value_name("K"),
                        "start from random crosses instead of the harmonic extension (default 0)");
  options.add_options()("picture", po::value<Strings>()->value_name("F.svg|F.png"), "draw the singular curves");
  options.add_options()("json", po::value<Strings>()->value_name("F.json"), "write the summary");
  options.add_options()("quiet", "print errors only");
  options.add_options()("help,h", "this text");
  return options;
}

po::options_description check_options()
{
  po::options_description options("Options", 100);
  options.add_options()("against", po::value<Strings>()->value_name("IN"),
                        "the planar domain or surface that the mesh should be of, as for quadrille quad: compares "
                        "borders and areas, of surfaces also distances, features and normals; and sizes on its curves");
  options.add_options()("size", po::value<Strings>()->value_name("SIZE"),
                        "prescribed sizes, as for quadrille quad; needs --against");
  options.add_options()("repair", "repair the mesh IN first, as for quadrille quad");
  options.add_options()("json", po::value<Strings>()->value_name("F.json"), "write the summary");
  options.add_options()("quiet", "print errors only");
  options.add_options()("help,h", "this text");
  return options;
}

/// The options of one command, with what Boost leaves to do: one value each unless repeatable.
class Parsed_options {
public:
  Parsed_options(const po::options_description& options, const Strings& arguments)
  {
    po::options_description all = options;
    all.add_options()("input-file", po::value<Strings>());
    po::positional_options_description positional;
    positional.add("input-file", -1);
    using namespace po::command_line_style;
    po::store(po::command_line_parser(arguments)
                  .options(all)
                  .positional(positional)
                  .style(unix_style & ~allow_guessing)
                  .run(),
              m_values);
  }

  bool has(const std::string& name) const { return m_values.count(name) != 0; }

  Strings all(const std::string& name) const { return has(name) ? m_values[name].as<Strings>() : Strings(); }

  /// The only value, or `otherwise`.
  std::string one(const std::string& name, const std::string& otherwise = {}) const
  {
    const Strings values = all(name);
    if (values.size() > 1)
      throw Invalid_argument_error("option --" + name + " is given " + std::to_string(values.size()) + " times");
    if (values.size() == 1 && values[0].empty())
      throw Invalid_argument_error("option --" + name + " has an empty value");
    return values.empty() ? otherwise : values[0];
  }

  template <class Number> Number number(const std::string& name, Number otherwise, Number least) const
  {
    if (!has(name))
      return otherwise;
    const std::string text = one(name);
    Number value{};
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size() || !(value >= least) || !std::isfinite(double(value)))
      throw Invalid_argument_error("option --" + name + ": '" + text + "' is not a valid number");
    return value;
  }

  std::string input(const std::string& what) const
  {
    const Strings inputs = all("input-file");
    if (inputs.empty())
      throw Invalid_argument_error("no " + what + " is given");
    if (inputs.size() > 1)
      throw Invalid_argument_error("one " + what + " is expected, but there is also '" + inputs[1] + "'");
    return inputs[0];
  }

private:
  po::variables_map m_values;
};

std::optional<double> crease_angle(const Parsed_options& options)
{
  if (!options.has("crease-angle"))
    return std::nullopt;
  const double angle = options.number("crease-angle", 0.0, 0.0);
  if (angle > 180)
    throw Invalid_argument_error("option --crease-angle: angles are at most 180 degrees");
  return angle;
}

Quad_arguments quad_arguments(const Parsed_options& options)
{
  Quad_arguments result;
  result.input = options.input("input file");
  result.outputs = options.all("output");
  result.field = options.one("field");
  result.map = options.one("map");
  result.seamless_map = options.one("seamless-map");
  if (!result.map.empty() && result.outputs.empty())
    throw Invalid_argument_error("option --map: there is no integer-grid map without quads; add -o OUT, or ask for "
                                 "the --seamless-map");
  result.picture = options.one("picture");
  result.json = options.one("json");
  result.sizes = options.all("size");
  result.unaligned = options.all("unaligned");
  result.weak = options.all("weak");
  result.size_field = options.one("size-field");
  result.size_field_weight = options.number("size-field-weight", result.size_field_weight, 0.0);
  result.impose_size_field = options.has("impose-size-field");
  if (result.size_field.empty() && (options.has("size-field-weight") || result.impose_size_field))
    throw Invalid_argument_error("options --size-field-weight and --impose-size-field need --size-field");
  result.triangle_size = options.number("triangle-size", 0.0, 0.0);
  if (options.has("triangle-size") && result.triangle_size == 0)
    throw Invalid_argument_error("option --triangle-size: the size must be positive");
  result.quads = options.number<std::size_t>("quads", 0, 0);
  if (options.has("quads") && result.quads == 0)
    throw Invalid_argument_error("option --quads: the number must be positive");
  result.max_quads = options.number<std::size_t>("max-quads", result.max_quads, 1);
  if (result.quads > result.max_quads)
    throw Invalid_argument_error("option --quads asks for more than the limit, " + std::to_string(result.max_quads) +
                                 "; raise it with --max-quads");
  const std::string solver = options.one("solver", "lm");
  const std::map<std::string, Field_solver_kind> solvers = {{"lm", Field_solver_kind::levenberg_marquardt},
                                                            {"lbfgs", Field_solver_kind::lbfgs},
                                                            {"lbfgs-kappa", Field_solver_kind::lbfgs_kappa}};
  const auto known_solver = solvers.find(solver);
  if (known_solver == solvers.end())
    throw Invalid_argument_error("option --solver: '" + solver + "' is none of lm, lbfgs, lbfgs-kappa");
  result.solver = known_solver->second;
  result.isotropic = options.has("isotropic");
  result.anisotropic = options.has("anisotropic");
  if (result.anisotropic && result.isotropic)
    throw Invalid_argument_error("options --isotropic and --anisotropic exclude each other");
  if (options.has("preset")) {
    const std::string preset = options.one("preset");
    const std::map<std::string, Surface_field_weights> presets = {{"sizing", Surface_field_weights::sizing()},
                                                                  {"angle", Surface_field_weights::angle_preserving()},
                                                                  {"area", Surface_field_weights::area_preserving()},
                                                                  {"isometric", Surface_field_weights::isometric()}};
    const auto known = presets.find(preset);
    if (known == presets.end())
      throw Invalid_argument_error("option --preset: '" + preset + "' is none of isometric, area, angle, sizing");
    result.preset = known->second;
  }
  result.crease_angle = crease_angle(options);
  result.repair = options.has("repair");
  result.smooth = options.has("smooth");
  if (options.has("quantizer")) {
    const std::string quantizer = options.one("quantizer");
    if (quantizer != "greedy" && quantizer != "optimal")
      throw Invalid_argument_error("option --quantizer: '" + quantizer + "' is neither greedy nor optimal");
    if (quantizer == "optimal" && !Optimal_quantizer::is_available())
      throw Invalid_argument_error("option --quantizer: 'optimal' needs the solver CBC, which is not built in");
    result.quantizer = quantizer == "optimal" ? Quantizer_kind::optimal : Quantizer_kind::greedy;
  }
  const std::string layout = options.one("layout", "t-mesh");
  if (layout != "t-mesh" && layout != "base-complex")
    throw Invalid_argument_error("option --layout: '" + layout + "' is neither t-mesh nor base-complex");
  if (layout == "base-complex")
    result.layout = Layout_kind::base_complex;
  for (const std::string& count : options.all("count"))
    result.counts.push_back(parse_count(count));
  if (options.has("starts"))
    result.starts = options.number("starts", 0, 0);
  result.seed = options.number<std::uint64_t>("seed", result.seed, 0);
  result.threads = options.number("threads", 0, 0);
  result.quiet = options.has("quiet");
  return result;
}

Cross_arguments cross_arguments(const Parsed_options& options)
{
  Cross_arguments result;
  result.input = options.input("input file");
  result.outputs = options.all("output");
  if (result.outputs.empty())
    throw Invalid_argument_error("no output file is given; use -o OUT");
  result.graph = options.one("graph");
  result.picture = options.one("picture");
  result.json = options.one("json");
  result.metric = options.one("metric");
  result.crease_angle = crease_angle(options);
  result.tetrahedron_size = options.number("tet-size", 0.0, 0.0);
  if (options.has("tet-size") && result.tetrahedron_size == 0)
    throw Invalid_argument_error("option --tet-size: the size must be positive");
  result.seed = options.number<std::uint64_t>("seed", result.seed, 0);
  result.threads = options.number("threads", 0, 0);
  result.quiet = options.has("quiet");
  return result;
}

Check_arguments check_arguments(const Parsed_options& options)
{
  Check_arguments result;
  result.mesh = options.input("mesh");
  result.against = options.one("against");
  result.json = options.one("json");
  result.sizes = options.all("size");
  result.repair = options.has("repair");
  if (result.repair && result.against.empty())
    throw Invalid_argument_error("option --repair needs --against, whose mesh is repaired; MESH is checked as it is");
  if (!result.sizes.empty() && result.against.empty())
    throw Invalid_argument_error("option --size needs --against, the domain whose curves it names");
  result.quiet = options.has("quiet");
  return result;
}

std::string help_text(const char* introduction, const po::options_description& options)
{
  std::ostringstream text;
  text << introduction << '\n' << options;
  return text.str();
}

} // namespace

Command_line parse_command_line(const std::vector<std::string>& arguments)
{
  Command_line result;
  if (arguments.empty())
    throw Invalid_argument_error("no command is given; try quadrille --help");
  const std::string& command = arguments[0];
  if (command == "--help" || command == "-h" || command == "help") {
    result.text = main_help;
    return result;
  }
  if (command == "--version") {
    result.text = "quadrille " QUADRILLE_VERSION "\n";
    return result;
  }
  try {
    const Strings rest(arguments.begin() + 1, arguments.end());
    const auto parse = [&](const char* introduction, const po::options_description& description, const auto& take) {
      const Parsed_options options(description, rest);
      if (options.has("help"))
        result.text = help_text(introduction, description);
      else
        take(options);
    };
    if (command == "quad")
      parse(quad_help, quad_options(), [&](const Parsed_options& options) { result.quad = quad_arguments(options); });
    else if (command == "cross")
      parse(cross_help, cross_options(),
            [&](const Parsed_options& options) { result.cross = cross_arguments(options); });
    else if (command == "check")
      parse(check_help, check_options(),
            [&](const Parsed_options& options) { result.check = check_arguments(options); });
    else
      throw Invalid_argument_error("'" + command +
                                   "' is no command; 'quad', 'cross' and 'check' are (try quadrille --help)");
  } catch (const po::error& error) {
    throw Invalid_argument_error(std::string(error.what()) + " (try quadrille " + command + " --help)");
  }
  return result;
}

} // namespace Quadrille
