// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// The command `cross`: what it writes, expected singular graphs, bad input.

#include "program_runner.h"
#include "tetrahedral_test_meshes.h"

#include <Quadrille/read_tetrahedral_mesh.h>
#include <Quadrille/write_tetrahedral_mesh.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <sstream>

namespace {

using namespace Quadrille;
using Json = nlohmann::json;

class Cross : public Quadrille_test::Program_runner {
protected:
  std::string write_mesh(const std::string& name, const Tetrahedral_mesh& mesh)
  {
    write_tetrahedral_mesh(path(name), mesh);
    return path(name);
  }

  Json summary() { return Json::parse(content(path("summary.json"))); }

  /// The summary's "graph" of a run on `in` with further arguments.
  Json graph(const std::string& in, std::vector<std::string> further = {})
  {
    std::vector<std::string> arguments = {"cross", in, "-o", path("field.vtu"), "--json", path("summary.json")};
    arguments.insert(arguments.end(), further.begin(), further.end());
    EXPECT_EQ(run(arguments), 0) << m_error;
    return summary()["graph"];
  }
};

TEST_F(Cross, summary_has_the_documented_keys)
{
  const Tetrahedral_mesh ball = ball_of_tetrahedra(12);
  const Json of_graph = graph(write_mesh("ball.mesh", ball), {"--threads", "2", "--seed", "3"});
  const Json all = summary();
  EXPECT_EQ(all["field"]["tetrahedra"], ball.number_of_tetrahedra());
  EXPECT_EQ(all["field"]["vertices"], ball.number_of_vertices());
  EXPECT_GT(all["field"]["iterations"], 0);
  EXPECT_GT(all["field"]["energy"], 0);
  EXPECT_TRUE(all["field"]["settled"]);
  EXPECT_GE(all["field"]["seconds"], 0);
  EXPECT_GT(all["peak_memory_bytes"], 1000000);
  EXPECT_GT(all["seconds"], 0);
  EXPECT_EQ(all["seed"], 3);
  EXPECT_EQ(of_graph["arcs"], 20);
  EXPECT_EQ(of_graph["loops"], 0);
  EXPECT_EQ(of_graph["boundary_ends"], 8);
  EXPECT_EQ(of_graph["nodes"], (Json{{"4", 8}}));
  EXPECT_EQ(of_graph["arc_valences"], (Json{{"3", 20}, {"5", 0}, {"mixed", 0}, {"compound", 0}}));
  EXPECT_TRUE(of_graph["hex_meshable"]);
  EXPECT_TRUE(of_graph["obstacles"].empty());
}

TEST_F(Cross, fills_surfaces_and_geometry)
{
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "address sanitizer does not allow what keeps TetGen and Gmsh apart";
#endif
  // A triangular prism as a surface, and a cylinder as geometry.
  const std::string surface = write("prism.off", "OFF\n6 8 0\n0 0 0\n2 0 0\n1 1.7 0\n0 0 2\n2 0 2\n1 1.7 2\n3 0 2 1\n"
                                                 "3 3 4 5\n3 0 1 4\n3 0 4 3\n3 1 2 5\n3 1 5 4\n3 2 0 3\n3 2 3 5\n");
  EXPECT_EQ(graph(surface, {"--tet-size", "0.25"})["arc_valences"]["3"], 1);
  const std::string cylinder =
      write("cylinder.geo", "SetFactory(\"OpenCASCADE\");\nCylinder(1) = {0, 0, 0, 0, 0, 2, 1};\n");
  const Json of_cylinder = graph(cylinder, {"--tet-size", "0.2"});
  EXPECT_EQ(of_cylinder["arcs"], 4);
  EXPECT_EQ(of_cylinder["boundary_ends"], 8);
}

TEST_F(Cross, writes_the_field_in_every_format)
{
  const Tetrahedral_mesh prism = prism_of_tetrahedra(polygon_of_triangles(regular_polygon(3), 6), 6, 1.5);
  const std::string in = write_mesh("prism.mesh", prism);
  std::vector<std::string> arguments = {"cross", in, "--graph", path("graph.vtu"), "--picture", path("graph.svg")};
  for (const char* name : {"field.vtu", "frames.fra", "frames.ff3", "copy.mesh", "copy.vtk", "copy.msh"})
    arguments.insert(arguments.end(), {"-o", path(name)});
  ASSERT_EQ(run(arguments), 0) << m_error;
  for (const char* name : {"u", "v", "w", "harmonics", "eta"})
    EXPECT_NE(content(path("field.vtu")).find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
  for (const char* name : {"alignment", "valence", "degree"})
    EXPECT_NE(content(path("graph.vtu")).find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
  EXPECT_NE(content(path("graph.svg")).find("<svg"), std::string::npos);
  for (const char* name : {"copy.mesh", "copy.vtk", "copy.msh"})
    EXPECT_EQ(read_tetrahedral_mesh(path(name)).number_of_tetrahedra(), prism.number_of_tetrahedra()) << name;
  // Frames per tetrahedron: rotations, one of whose axes is that of the prism nearly everywhere.
  std::istringstream file(content(path("frames.fra")));
  std::string word;
  std::size_t version = 0, n = 0, per_tetrahedron = 0, last = 0;
  file >> word >> version >> n >> per_tetrahedron >> last;
  EXPECT_EQ(word, "FRA");
  ASSERT_EQ(n, prism.number_of_tetrahedra());
  std::size_t upright = 0;
  for (std::size_t t = 0; t < n; ++t) {
    Eigen::Matrix3d frame;
    for (int i = 0; i < 9; ++i)
      file >> frame(i % 3, i / 3);
    EXPECT_LT((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 1e-9);
    upright += frame.row(2).cwiseAbs().maxCoeff() > 0.99 ? 1 : 0;
  }
  EXPECT_TRUE(file);
  EXPECT_GT(upright, n * 9 / 10);
}

TEST_F(Cross, crease_angle_decides_what_is_a_crease)
{
  // The sides of a prism over a regular decagon meet at 36 degrees: creases at 30, none at 60.
  Tetrahedral_mesh prism = prism_of_tetrahedra(polygon_of_triangles(regular_polygon(10), 6), 6, 1.5);
  prism.feature_edges.clear();
  const std::string in = write_mesh("prism.mesh", prism);
  ASSERT_EQ(run({"cross", in, "-o", path("field.vtu"), "--crease-angle", "30"}), 0);
  const std::string with = m_output;
  ASSERT_EQ(run({"cross", in, "-o", path("field.vtu"), "--crease-angle", "60"}), 0);
  EXPECT_NE(with, m_output);
  EXPECT_NE(m_output.find("; 0 corners"), std::string::npos) << m_output;
  EXPECT_NE(with.find("; 20 corners"), std::string::npos) << with;
}

TEST_F(Cross, a_constant_metric_stretches_the_volume)
{
  // A box in a metric that makes it a cube, and a ball in one that makes it a longer ellipsoid: the same graph.
  const Tetrahedral_mesh ball = ball_of_tetrahedra(12);
  const std::string in = write_mesh("ball.mesh", ball);
  std::string metric;
  for (std::size_t v = 0; v < ball.number_of_vertices(); ++v)
    metric += "2.25 0 0 1 0 1\n";
  const Json graph_under_metric = graph(in, {"--metric", write("metric.txt", metric)});
  const double energy = summary()["field"]["energy"];
  const std::string stretched =
      write_mesh("ellipsoid.mesh",
                 mapped(ball, [](const Eigen::Vector3d& p) { return Eigen::Vector3d(1.5 * p.x(), p.y(), p.z()); }));
  const Json graph_of_stretched = graph(stretched);
  EXPECT_NEAR(energy, double(summary()["field"]["energy"]), 0.02 * energy);
  EXPECT_EQ(graph_under_metric["boundary_ends"], graph_of_stretched["boundary_ends"]);
}

TEST_F(Cross, bad_input_is_refused_in_words)
{
  const Tetrahedral_mesh box = cube_of_tetrahedra(4);
  const std::string in = write_mesh("box.mesh", box), out = path("out/field.vtu");
  const auto expect_error = [&](int code, const std::string& words, const std::vector<std::string>& arguments) {
    EXPECT_EQ(run(arguments), code) << words;
    EXPECT_NE(m_error.find(words), std::string::npos) << m_error;
    EXPECT_TRUE(std::filesystem::is_empty(path("out"))) << words;
  };
  expect_error(2, "no output file", {"cross", in});
  expect_error(2, "unknown format '.stl'", {"cross", in, "-o", path("out/field.stl")});
  expect_error(2, "--tet-sise", {"cross", in, "-o", out, "--tet-sise", "1"});
  expect_error(2, "must be positive", {"cross", in, "-o", out, "--tet-size", "0"});
  expect_error(2, "at most 180", {"cross", in, "-o", out, "--crease-angle", "200"});
  expect_error(2, "named twice", {"cross", in, "-o", out, "--graph", out});
  expect_error(3, "no such file", {"cross", path("none.mesh"), "-o", out});
  expect_error(3, "metric.txt", {"cross", in, "-o", out, "--metric", write("metric.txt", "1\n1\n")});
  std::string indefinite;
  for (std::size_t v = 0; v < box.number_of_vertices(); ++v)
    indefinite += v == 7 ? "1 0 0 -1 0 1\n" : "1 0 0 1 0 1\n";
  expect_error(3, "vertex 7", {"cross", in, "-o", out, "--metric", write("indefinite.txt", indefinite)});
  expect_error(3, "closed", {"cross", write("open.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), "-o", out});
  Tetrahedral_mesh bad = box;
  bad.points.push_back({5, 5, 5});
  expect_error(3, "belongs to no tetrahedron", {"cross", write_mesh("isolated.mesh", bad), "-o", out});
  bad = box;
  std::swap(bad.points[0], bad.points[31]);
  expect_error(3, "tetrahedr", {"cross", write_mesh("folded.mesh", bad), "-o", out});
}

/// Files of the shared collection with the graph that they are known to have.
TEST_F(Cross, known_meshes_have_the_known_graphs)
{
  const std::filesystem::path data = std::filesystem::path(QUADRILLE_SHARED_DATA) / "tet";
  if (!std::filesystem::exists(data))
    GTEST_SKIP() << data << " is not there";
  struct Expected {
    const char* file;
    int arcs, loops, ends, nodes;
    Json valences;
  };
  for (const Expected& expected : {Expected{"hexme/s01c_cube.vtk", 0, 0, 0, 0, Json::object()},
                                   {"arff/prism.node", 1, 0, 2, 0, {{"3", 1}}},
                                   {"hexme/s03c_pentagon.vtk", 1, 0, 2, 0, {{"5", 1}}},
                                   {"hexme/s04c_tetrahedron.vtk", 4, 0, 4, 1, {{"3", 4}}},
                                   {"mint/cylinder3k.mesh", 4, 0, 8, 0, {{"3", 4}}},
                                   {"algohex/cylinder.ovm", 4, 0, 8, 0, {{"3", 4}}},
                                   {"hexme/s16c_torus.vtk", 4, 4, 0, 0, {{"3", 4}}},
                                   {"mint/notch5_0.mesh", 1, 0, 2, 0, {{"mixed", 1}}},
                                   {"arff/sphere_r0.10.mesh", 20, 0, 8, 8, {{"3", 20}}},
                                   {"arff/sphere_r0.08.mesh", 20, 0, 8, 8, {{"3", 20}}}}) {
    const Json found = graph((data / expected.file).string());
    EXPECT_EQ(found["arcs"], expected.arcs) << expected.file;
    EXPECT_EQ(found["loops"], expected.loops) << expected.file;
    EXPECT_EQ(found["boundary_ends"], expected.ends) << expected.file;
    int nodes = 0;
    for (const auto& [degree, n] : found["nodes"].items())
      nodes += int(n);
    EXPECT_EQ(nodes, expected.nodes) << expected.file;
    for (const auto& [valence, n] : found["arc_valences"].items())
      EXPECT_EQ(n, expected.valences.value(valence, 0)) << expected.file << ' ' << valence;
    EXPECT_EQ(found["hex_meshable"], !expected.valences.contains("mixed")) << expected.file;
  }
}

} // namespace
