// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The command `check` on quad meshes of surfaces.

#include "program_runner.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Json = nlohmann::json;

/// n x n squares on each of the first sides of [-1, 1]^3, normals outwards; corners count from 1.
std::string cube_in_obj(int n, std::size_t n_sides, bool in_triangles, double scale = 1)
{
  std::ostringstream points, polygons;
  points.precision(17);
  int n_points = 0;
  std::map<std::array<int, 3>, int> index;
  for (std::size_t s = 0; s < n_sides; ++s)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const auto corner = [&](int a, int b) {
          std::array<int, 3> at;
          at[s / 2] = s % 2 == 0 ? 0 : n;
          at[(s / 2 + 1) % 3] = s % 2 == 0 ? b : a;
          at[(s / 2 + 2) % 3] = s % 2 == 0 ? a : b;
          const auto [place, is_new] = index.emplace(at, n_points + 1);
          if (is_new) {
            ++n_points;
            points << 'v';
            for (const int k : at)
              points << ' ' << scale * (2.0 * k / n - 1);
            points << '\n';
          }
          return place->second;
        };
        const int a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
        if (in_triangles)
          polygons << "f " << a << ' ' << b << ' ' << c << "\nf " << a << ' ' << c << ' ' << d << '\n';
        else
          polygons << "f " << a << ' ' << b << ' ' << c << ' ' << d << '\n';
      }
  return points.str() + polygons.str();
}

class Check_surface : public Quadrille_test::Program_runner {
protected:
  Json check(const std::string& mesh, std::vector<std::string> more)
  {
    more.insert(more.begin(), {"check", mesh, "--json", path("check.json")});
    EXPECT_EQ(run(more), 0) << m_error;
    return Json::parse(content(path("check.json")));
  }
};

TEST_F(Check_surface, finds_a_cube_on_itself)
{
  const std::string mesh = write("quads.obj", cube_in_obj(4, 6, false));
  const std::string triangles = write("triangles.obj", cube_in_obj(4, 6, true));
  const Json all = check(mesh, {"--against", triangles});
  EXPECT_EQ(all["valid"], true);
  EXPECT_EQ(all["input"]["euler_characteristic"], 2);
  EXPECT_EQ(all["mesh"]["irregular"], (Json{{"3", 8}}));
  const std::set<std::string> keys = {"hausdorff",        "hausdorff_relative",   "to_surface_max",
                                      "from_surface_max", "feature_distance_max", "feature_distance_max_relative",
                                      "flipped_quads",    "area_change_relative"};
  std::set<std::string> found;
  for (const auto& [key, value] : all["against"].items()) {
    found.insert(key);
    EXPECT_NEAR(value, 0, 1e-12) << key;
  }
  EXPECT_EQ(found, keys);
  EXPECT_NE(m_output.find("features within"), std::string::npos) << m_output;
}

TEST_F(Check_surface, measures_how_far_a_larger_cube_is_away)
{
  const std::string mesh = write("quads.obj", cube_in_obj(4, 6, false, 1.1));
  const Json against = check(mesh, {"--against", write("triangles.obj", cube_in_obj(5, 6, true))})["against"];
  EXPECT_NEAR(against["to_surface_max"], 0.1 * std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(against["from_surface_max"], 0.1, 1e-9);
  EXPECT_NEAR(against["hausdorff_relative"], 0.05, 1e-9);
  EXPECT_NEAR(against["feature_distance_max"], 0.1 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(against["area_change_relative"], 0.21, 1e-9);
}

TEST_F(Check_surface, measures_sizes_on_the_border)
{
  const std::string mesh = write("quads.obj", cube_in_obj(4, 5, false));
  const std::string triangles = write("triangles.obj", cube_in_obj(2, 5, true));
  EXPECT_NEAR(check(mesh, {"--against", triangles, "--size", "0.5"})["mesh"]["size_error"]["max"], 0, 1e-12);
  EXPECT_NEAR(check(mesh, {"--against", triangles, "--size", "1"})["mesh"]["size_error"]["mean"], std::log(2.0), 1e-12);
}

TEST_F(Check_surface, refuses_a_surface_where_the_domain_is_planar)
{
  const std::string mesh = write("quads.obj", cube_in_obj(2, 6, false));
  const std::string square = write("square.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n");
  EXPECT_EQ(run({"check", mesh, "--against", square}), 4);
  EXPECT_NE(m_error.find("planar domain"), std::string::npos) << m_error;
}

TEST_F(Check_surface, refuses_coordinates_that_are_no_numbers)
{
  const std::string mesh = write("quads.obj", cube_in_obj(2, 6, false));
  const std::string nan = write("nan.obj", cube_in_obj(1, 5, false) + "v 0 nan 0\nf 1 2 9 3\n");
  EXPECT_EQ(run({"check", nan, "--against", mesh}), 4);
  EXPECT_NE(m_error.find("vertex 8 has a coordinate that is not a finite number"), std::string::npos) << m_error;
}

} // namespace
