// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The command `quad` on surfaces: fields, maps, summaries, bad input.

#include "program_runner.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <utility>
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
  ASSERT_EQ(run({"quad", sphere, "--size", "0.2", "--starts", "1", "--field", path("f.vtu"), "--seamless-map",
                 path("m.obj"), "--picture", path("p.svg"), "--json", path("summary.json")}),
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

TEST_F(Surface, cube_becomes_squares_with_its_edges_as_curves)
{
  const std::string cube = write("cube.off", cube_in_off(8, false));
  ASSERT_EQ(run({"quad", cube, "--size", "0.25", "--starts", "0", "-o", path("quads.msh"), "-o", path("quads.obj"),
                 "--picture", path("p.svg"), "--json", path("summary.json")}),
            0)
      << m_error;
  const Json all = summary();
  EXPECT_EQ(all["mesh"]["quads"], 6 * 64);
  EXPECT_EQ(all["mesh"]["irregular"], (Json{{"3", 8}}));
  EXPECT_LT(all["mesh"]["skew_degrees"]["max"], 1e-3);
  EXPECT_LT(all["mesh"]["size_error"]["max"], 1e-5);
  ASSERT_EQ(run({"check", path("quads.msh"), "--against", cube, "--json", path("summary.json")}), 0) << m_error;
  EXPECT_LT(summary()["against"]["hausdorff_relative"], 1e-12);
  EXPECT_LT(summary()["against"]["feature_distance_max_relative"], 1e-12);
  EXPECT_EQ(summary()["against"]["flipped_quads"], 0);
}

TEST_F(Surface, meshes_with_cracks_are_repaired_on_request)
{
  // Every triangle of the cube has points of its own, and every third one is turned over.
  std::istringstream cube(cube_in_off(6, false));
  std::string word;
  std::size_t n_points = 0, n_triangles = 0;
  cube >> word >> n_points >> n_triangles >> word;
  std::vector<std::array<std::string, 3>> points(n_points);
  for (auto& p : points)
    cube >> p[0] >> p[1] >> p[2];
  std::ostringstream soup;
  for (std::size_t f = 0; f < n_triangles; ++f) {
    std::array<std::size_t, 3> t{};
    cube >> word >> t[0] >> t[1] >> t[2];
    for (const std::size_t v : t)
      soup << "v " << points[v][0] << ' ' << points[v][1] << ' ' << points[v][2] << '\n';
  }
  for (std::size_t f = 0; f < n_triangles; ++f)
    soup << "f " << 3 * f + 1 << ' ' << 3 * f + (f % 3 == 0 ? 3 : 2) << ' ' << 3 * f + (f % 3 == 0 ? 2 : 3) << '\n';
  const std::string file = write("soup.obj", soup.str()), whole = write("cube.off", cube_in_off(6, false));
  EXPECT_EQ(run({"quad", file, "-o", path("quads.obj"), "--starts", "1"}), 3);
  EXPECT_NE(m_error.find("the surface has a crack: at the edge from"), std::string::npos) << m_error;
  EXPECT_TRUE(content(path("quads.obj")).empty());
  EXPECT_EQ(run({"quad", file, "-o", path("quads.obj"), "--size", "0.5", "--starts", "1", "--repair"}), 0) << m_error;
  EXPECT_NE(m_output.find("repaired: "), std::string::npos) << m_output;
  EXPECT_EQ(run({"check", path("quads.obj"), "--against", whole, "--json", path("summary.json")}), 0) << m_error;
  EXPECT_EQ(summary()["mesh"]["quads"], 96);
  EXPECT_LT(summary()["against"]["hausdorff_relative"], 1e-9);
  EXPECT_NEAR(summary()["mesh"]["edge_length"]["percentile_99"], 0.5, 1e-3);
  EXPECT_EQ(run({"check", path("quads.obj"), "--against", file}), 3);
  EXPECT_EQ(run({"check", path("quads.obj"), "--against", file, "--repair"}), 0) << m_error;
  EXPECT_EQ(run({"check", path("quads.obj"), "--repair"}), 2);
  EXPECT_EQ(run({"quad", QUADRILLE_EXAMPLE_DATA "/box_transition.geo", "-o", path("q.obj"), "--repair"}), 2);
}

TEST_F(Surface, has_as_many_quads_as_wanted)
{
  const std::string cube = write("cube.off", cube_in_off(6, false));
  for (const int wanted : {600, 2400}) {
    ASSERT_EQ(run({"quad", cube, "--quads", std::to_string(wanted), "--starts", "0", "-o", path("q.msh"), "--json",
                   path("summary.json")}),
              0)
        << m_error;
    EXPECT_EQ(summary()["mesh"]["quads"], wanted);
    EXPECT_LT(summary()["mesh"]["size_error"]["max"], 1e-3); // sizes are scaled, too
  }
  EXPECT_EQ(run({"quad", cube, "--quads", "0", "-o", path("q.msh")}), 2);
  EXPECT_EQ(run({"quad", cube, "--quads", "2000000", "-o", path("q.msh")}), 2);
}

TEST_F(Surface, a_tetrahedron_of_four_triangles_becomes_three_blocks_on_each_side)
{
  const std::string tetrahedron =
      write("t.off", "OFF\n4 4 0\n1 1 1\n1 -1 -1\n-1 1 -1\n-1 -1 1\n3 0 1 2\n3 0 2 3\n3 0 3 1\n3 1 3 2\n");
  ASSERT_EQ(run({"quad", tetrahedron, "--size", "0.5", "-o", path("q.msh"), "--json", path("summary.json")}), 0)
      << m_error;
  EXPECT_EQ(summary()["mesh"]["irregular"], (Json{{"3", 8}})); // four corners, four centres
  EXPECT_GT(summary()["mesh"]["scaled_jacobian"]["min"], 0.5);
  ASSERT_EQ(run({"check", path("q.msh"), "--against", tetrahedron, "--json", path("summary.json")}), 0) << m_error;
  EXPECT_LT(summary()["against"]["hausdorff_relative"], 1e-12);
}

TEST_F(Surface, quads_of_a_sphere_lie_on_it)
{
  const std::string sphere = write("sphere.off", cube_in_off(16, true));
  ASSERT_EQ(
      run({"quad", sphere, "--size", "0.2", "--starts", "0", "-o", path("q.msh"), "--json", path("summary.json")}), 0)
      << m_error;
  EXPECT_EQ(summary()["mesh"]["irregular"], (Json{{"3", 8}}));
  EXPECT_GT(summary()["mesh"]["scaled_jacobian"]["min"], 0.8);
  // 7.2 elements between two singularities would have the size on average; whole numbers are at most one off.
  EXPECT_GT(double(summary()["mesh"]["quads"]), 6 * 6.2 * 6.2);
  EXPECT_LT(double(summary()["mesh"]["quads"]), 6 * 8.2 * 8.2);
  ASSERT_EQ(run({"check", path("q.msh"), "--against", sphere, "--json", path("summary.json")}), 0) << m_error;
  EXPECT_EQ(summary()["input"]["euler_characteristic"], 2);
  EXPECT_LT(summary()["against"]["hausdorff_relative"], 0.005); // chords of 0.2 of a circle are 0.005 below it
}

TEST_F(Surface, counts_on_the_curves_of_a_part_are_met_and_groups_are_kept)
{
  const std::string part = QUADRILLE_EXAMPLE_DATA "/box_transition.geo";
  ASSERT_EQ(run({"quad", part, "--size", "0.4", "--count", "small=48", "--triangle-size", "0.2", "--starts", "0", "-o",
                 path("q.msh"), "-o", path("q.obj")}),
            0)
      << m_error;
  EXPECT_NE(content(path("q.msh")).find("\"small\""), std::string::npos);
  std::istringstream mesh(content(path("q.obj")));
  std::vector<std::array<double, 3>> points;
  std::set<std::set<int>> edges; // of the left side's boundary
  const auto is_on_side = [&](int a, int b, std::size_t axis, double at) {
    return points[std::size_t(a - 1)][axis] == at && points[std::size_t(b - 1)][axis] == at;
  };
  for (std::string word; mesh >> word;)
    if (word == "v") {
      points.emplace_back();
      mesh >> points.back()[0] >> points.back()[1] >> points.back()[2];
    } else if (word == "f") {
      std::array<int, 4> quad{};
      for (int& v : quad)
        mesh >> v;
      for (std::size_t i = 0; i < 4; ++i)
        for (const auto& [axis, at] : {std::pair(1, 0.0), std::pair(1, 2.0), std::pair(2, 0.0), std::pair(2, 1.0)})
          if (is_on_side(quad[i], quad[(i + 1) % 4], 0, 0) &&
              is_on_side(quad[i], quad[(i + 1) % 4], std::size_t(axis), at))
            edges.insert({quad[i], quad[(i + 1) % 4]});
    }
  EXPECT_EQ(edges.size(), 48U);
  EXPECT_EQ(run({"quad", part, "--count", "no_such_curve=3", "-o", path("q.msh")}), 2);
  EXPECT_NE(m_error.find("no_such_curve"), std::string::npos) << m_error;
}

TEST_F(Surface, refuses_what_is_not_done_on_surfaces)
{
  const std::string cube = write("cube.off", cube_in_off(2, false));
  EXPECT_EQ(run({"quad", cube, "--impose-size-field", "--field", path("f.vtu")}), 2);
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
