// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The cases in examples/data from file to mesh, by the program, with fewer starts than its default to save time.

#include "temporary_files.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace {

/// Runs the program in a folder of its own for every test, removed at its end.
class Invariance : public Temporary_files {
protected:
  static std::string data(const std::string& name) { return QUADRILLE_EXAMPLE_DATA "/" + name + ".geo"; }

  /// The exit code of the program with these arguments.
  int run(const std::string& arguments) const
  {
    const std::string command =
        std::string("\"" QUADRILLE_PROGRAM "\" ") + arguments + " --quiet 2>\"" + path("stderr") + "\"";
    const int status = std::system(command.c_str());
    if (status != 0)
      ADD_FAILURE() << command << "\n" << content(path("stderr"));
    return status;
  }

  nlohmann::json summary() const { return nlohmann::json::parse(content(path("summary.json"))); }
};

class Cases : public Invariance, public testing::WithParamInterface<const char*> {};

struct Quads {
  std::vector<std::array<double, 2>> points;
  std::vector<std::string> faces;
};

Quads read_obj(const std::string& path)
{
  Quads quads;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      quads.points.emplace_back();
      words >> quads.points.back()[0] >> quads.points.back()[1];
    } else if (kind == "f") {
      quads.faces.push_back(line);
    }
  }
  return quads;
}

TEST_P(Cases, give_valid_meshes_with_the_singularities_of_the_field)
{
  const std::string in = "\"" + data(GetParam()) + "\"", mesh = "\"" + path("mesh.msh") + "\"";
  ASSERT_EQ(run("quad " + in + " -o " + mesh + " --json \"" + path("summary.json") + "\" --starts 3"), 0);
  ASSERT_EQ(run("check " + mesh + " --against " + in), 0);
  const nlohmann::json json = summary();
  EXPECT_EQ(json["field"]["index_sum"], json["input"]["euler_characteristic"]);
  EXPECT_EQ(json["map"]["seam_residual_max"], 0);
  EXPECT_EQ(json["map"]["flipped"], 0);
  EXPECT_EQ(json["mesh"]["irregular"], json["field"]["singularities"]);
  EXPECT_GT(json["mesh"]["scaled_jacobian"]["min"], 0);
  // The best start of three must integrate at least as well as the smooth field does.
  const double error = json["map"]["integration_error"], smooth_error = json["map"]["smooth_integration_error"];
  EXPECT_LE(error, smooth_error + 1e-12);
  // Every physical group of the geometry is in the mesh.
  const std::string text = content(path("mesh.msh")), geometry = content(data(GetParam()));
  const std::regex group("Physical (Curve|Surface)\\(\"([^\"]*)\"\\)");
  int n_groups = 0;
  for (std::sregex_iterator i(geometry.begin(), geometry.end(), group), end; i != end; ++i, ++n_groups)
    EXPECT_NE(text.find("\"" + (*i)[2].str() + "\""), std::string::npos) << (*i)[2];
  EXPECT_GE(n_groups, 2);
}

INSTANTIATE_TEST_SUITE_P(Data, Cases,
                         testing::Values("square_1_2", "square_1_10", "disk", "annulus", "tilted_squares", "nautilus",
                                         "three_component_wing", "rotor_stator", "plate_with_holes", "l_shape"),
                         [](const auto& info) { return std::string(info.param); });

struct Published_error {
  const char* name;
  const char* geometry;
  const char* options;
  double error; ///< figures 13 and 14 of planar-2
};

class Published_errors : public Invariance, public testing::WithParamInterface<Published_error> {};

TEST_P(Published_errors, are_not_exceeded)
{
  const Published_error& published = GetParam();
  ASSERT_EQ(run("quad \"" + data(published.geometry) + "\" -o \"" + path("mesh.msh") + "\" --json \"" +
                path("summary.json") + "\" " + published.options),
            0);
  const nlohmann::json json = summary();
  EXPECT_LE(json["map"]["integration_error"], published.error);
  EXPECT_GT(json["field"]["triangles"], json["input"]["faces"]); // those around singularities were refined
}

INSTANTIATE_TEST_SUITE_P(Planar_2, Published_errors,
                         testing::Values(Published_error{"square_1_2", "square_1_2", "", 7.96e-4},
                                         Published_error{"square_1_10", "square_1_10", "", 3.31e-3},
                                         Published_error{"square_ends_anisotropic", "square_1_2",
                                                         "--anisotropic --size left=free --size right=free", 3.90e-4},
                                         Published_error{"tilted", "tilted_squares", "--triangle-size 2.35", 3.85e-3},
                                         Published_error{"tilted_anisotropic", "tilted_squares",
                                                         "--triangle-size 2.35 --anisotropic", 2.67e-3},
                                         Published_error{"annulus", "annulus", "--triangle-size 2.04", 1.40e-2}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_F(Invariance, files_are_identical_for_every_number_of_threads)
{
  for (const int threads : {1, 2, 4}) {
    const std::string n = std::to_string(threads);
    ASSERT_EQ(run("quad \"" + data("square_1_10") + "\" -o \"" + path(n + ".msh") + "\" -o \"" + path(n + ".vtk") +
                  "\" --field \"" + path(n + ".vtu") + "\" --starts 4 --threads " + n),
              0);
    for (const char* ending : {".msh", ".vtk", ".vtu"})
      EXPECT_EQ(content(path("1" + std::string(ending))), content(path(n + ending))) << n << ending;
  }
  EXPECT_FALSE(content(path("1.msh")).empty());
}

TEST_F(Invariance, mesh_scales_and_turns_with_the_domain)
{
  ASSERT_EQ(run("quad \"" + data("square_1_2") + "\" -o \"" + path("plain.obj") + "\" --starts 2"), 0);
  const Quads plain = read_obj(path("plain.obj"));
  ASSERT_FALSE(plain.points.empty());
  const std::regex point("\\{([-+.0-9]+), ([-+.0-9]+), 0, ([.0-9]+)\\}");
  struct Motion {
    double scale, angle;
  };
  for (const Motion motion : {Motion{1e8, 0}, Motion{1e-8, 0}, Motion{1, 0.3}}) {
    const double c = std::cos(motion.angle), s = std::sin(motion.angle);
    const std::string geometry = content(data("square_1_2"));
    std::ostringstream moved;
    moved.precision(17);
    std::string::const_iterator rest = geometry.begin();
    int n_points = 0;
    for (std::sregex_iterator i(geometry.begin(), geometry.end(), point), end; i != end; ++i, ++n_points) {
      const double x = std::stod((*i)[1]), y = std::stod((*i)[2]), size = std::stod((*i)[3]);
      moved << std::string(rest, (*i)[0].first) << "{" << motion.scale * (c * x - s * y) << ", "
            << motion.scale * (s * x + c * y) << ", 0, " << motion.scale * size << "}";
      rest = (*i)[0].second;
    }
    ASSERT_EQ(n_points, 4);
    moved << std::string(rest, geometry.end());
    std::ofstream(path("moved.geo")) << moved.str();
    ASSERT_EQ(run("quad \"" + path("moved.geo") + "\" -o \"" + path("moved.obj") + "\" --starts 2"), 0);
    const Quads quads = read_obj(path("moved.obj"));
    ASSERT_EQ(quads.faces, plain.faces);
    for (std::size_t v = 0; v < plain.points.size(); ++v) {
      const auto [x, y] = plain.points[v];
      EXPECT_NEAR(quads.points[v][0] / motion.scale, c * x - s * y, 1e-5);
      EXPECT_NEAR(quads.points[v][1] / motion.scale, s * x + c * y, 1e-5);
    }
  }
}

} // namespace
