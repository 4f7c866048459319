// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The command `quad` on surfaces: fields, maps, summaries, bad input.

#include "program_runner.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Json = nlohmann::json;

/// The six sides of a cube in n x n squares each, bent onto the unit sphere if wanted, as OFF.
std::string cube_in_off(int n, bool bent)
{
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<int, 3>> triangles;
  const auto vertex = [&](std::array<int, 3> at) { // of the n + 1 grid points along every axis
    std::array<double, 3> p = {2.0 * at[0] / n - 1, 2.0 * at[1] / n - 1, 2.0 * at[2] / n - 1};
    if (bent) {
      const double norm = std::hypot(p[0], p[1], p[2]);
      for (double& x : p)
        x /= norm;
    }
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i] == p)
        return int(i);
    points.push_back(p);
    return int(points.size()) - 1;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int a, int b) {
            std::array<int, 3> at{};
            at[axis] = side;
            at[(axis + 1) % 3] = a;
            at[(axis + 2) % 3] = b;
            return vertex(at);
          };
          const int p = corner(i, j), q = corner(i + 1, j), r = corner(i + 1, j + 1), s = corner(i, j + 1);
          if (side == n) {
            triangles.push_back({p, q, r});
            triangles.push_back({p, r, s});
          } else {
            triangles.push_back({p, r, q});
            triangles.push_back({p, s, r});
          }
        }
  std::ostringstream text;
  text.precision(17);
  text << "OFF\n" << points.size() << ' ' << triangles.size() << " 0\n";
  for (const auto& p : points)
    text << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  for (const auto& t : triangles)
    text << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return text.str();
}

class Surface : public Quadrille_test::Program_runner {
protected:
  Json summary() { return Json::parse(content(path("summary.json"))); }
};

TEST_F(Surface, sphere_gets_field_map_picture_and_summary)
{
  const std::string sphere = write("sphere.off", cube_in_off(8, true));
  ASSERT_EQ(run({"quad", sphere, "--size", "0.2", "--starts", "1", "--field", path("f.vtu"), "--map", path("m.obj"),
                 "--picture", path("p.svg"), "--json", path("summary.json")}),
            0)
      << m_error;
  const Json all = summary();
  EXPECT_EQ(all["input"]["euler_characteristic"], 2);
  EXPECT_EQ(all["input"]["boundary_loops"], 0);
  EXPECT_EQ(all["field"]["index_sum"], 2.0);
  EXPECT_EQ(all["field"]["singularities"], (Json{{"3", 8}}));
  EXPECT_GT(all["field"]["energy_terms"]["curl"], 0);
  EXPECT_NEAR(double(all["field"]["typical_size"]), 0.2, 1e-12);
  EXPECT_EQ(all["map"]["flipped"], 0);
  EXPECT_EQ(all["map"]["seam_residual_max"], 0.0);
  EXPECT_LT(all["map"]["integration_error"], 0.02);
  EXPECT_NE(content(path("f.vtu")).find("size_u"), std::string::npos);
  EXPECT_NE(content(path("m.obj")).find("vt "), std::string::npos);
  EXPECT_NE(content(path("p.svg")).find("</svg>"), std::string::npos);
}

TEST_F(Surface, cube_is_a_grid)
{
  const std::string cube = write("cube.off", cube_in_off(8, false));
  ASSERT_EQ(run({"quad", cube, "--size", "0.25", "--starts", "1", "--json", path("summary.json")}), 0) << m_error;
  const Json all = summary();
  EXPECT_EQ(all["field"]["singularities"], (Json{{"3", 8}}));
  EXPECT_EQ(all["map"]["flipped"], 0);
  EXPECT_LT(all["map"]["integration_error"], 1e-12);
  EXPECT_LT(all["map"]["size_error"]["max"], 1e-6);
}

TEST_F(Surface, curves_can_be_followed_weakly)
{
  const std::string cube = write("cube.off", cube_in_off(8, false));
  ASSERT_EQ(run({"quad", cube, "--size", "0.25", "--size", "1=0.2", "--weak", "1", "--starts", "1", "--json",
                 path("summary.json")}),
            0)
      << m_error;
  Json all = summary();
  EXPECT_EQ(all["field"]["index_sum"], 2.0);
  EXPECT_GT(all["field"]["energy_terms"]["weak"],
            1e-6); // twelve curves cannot have these sizes and angles of 90 degrees
  EXPECT_EQ(run({"quad", cube, "--weak", "no_such_curve", "--json", path("summary.json")}), 2);
  EXPECT_NE(m_error.find("--weak"), std::string::npos) << m_error;
}

TEST_F(Surface, geometry_with_a_size_transition_gets_pairs_of_singularities)
{
  ASSERT_EQ(run({"quad", QUADRILLE_EXAMPLE_DATA "/box_transition.geo", "--size", "rest=0.4", "--size", "small=0.2",
                 "--preset", "angle", "--triangle-size", "0.2", "--starts", "2", "--json", path("summary.json")}),
            0)
      << m_error;
  const Json all = summary();
  EXPECT_EQ(all["field"]["index_sum"], 2.0);
  ASSERT_TRUE(all["field"]["singularities"].contains("5"));
  EXPECT_EQ(int(all["field"]["singularities"]["3"]) - int(all["field"]["singularities"]["5"]), 8);
  EXPECT_LT(all["map"]["size_error"]["mean"], 0.1);
}

TEST_F(Surface, refuses_what_is_not_done_on_surfaces)
{
  const std::string cube = write("cube.off", cube_in_off(2, false));
  EXPECT_EQ(run({"quad", cube, "-o", path("quads.msh")}), 2);
  EXPECT_NE(m_error.find("surface"), std::string::npos) << m_error;
  EXPECT_EQ(run({"quad", cube, "--count", "1=3", "--field", path("f.vtu")}), 2);
  EXPECT_EQ(run({"quad", cube, "--preset", "volume", "--field", path("f.vtu")}), 2);
  EXPECT_EQ(run({"quad", QUADRILLE_EXAMPLE_DATA "/square_1_2.geo", "--preset", "area", "-o", path("q.msh")}), 2);
  EXPECT_NE(m_error.find("--preset"), std::string::npos) << m_error;
}

TEST_F(Surface, names_what_is_wrong_with_the_input)
{
  const std::string three_triangles =
      write("fan.off", "OFF\n5 3 0\n0 0 0\n0 0 1\n1 0 0\n0 1 0\n-1 -1 0\n3 0 1 2\n3 0 1 3\n3 1 0 4\n");
  EXPECT_EQ(run({"quad", three_triangles, "--field", path("f.vtu")}), 3);
  EXPECT_NE(m_error.find("fan.off"), std::string::npos) << m_error;
  EXPECT_TRUE(content(path("f.vtu")).empty());
}

} // namespace
