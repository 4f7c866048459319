// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "program_runner.h"

#include <nlohmann/json.hpp>

#include <Quadrille/Optimal_quantizer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

namespace {

namespace fs = std::filesystem;

class Program : public Quadrille_test::Program_runner {
protected:
  void expect_failure(const std::vector<std::string>& arguments, int code, const std::string& word)
  {
    EXPECT_EQ(run(arguments), code) << m_error;
    EXPECT_EQ(m_error.rfind("quadrille: error: ", 0), 0u) << m_error;
    EXPECT_NE(m_error.find(word), std::string::npos) << m_error;
    EXPECT_TRUE(fs::is_empty(path("out"))) << "something was left behind";
  }

  std::string square(double side = 4)
  {
    const std::string s = std::to_string(side);
    return write("square.geo", "s = " + s +
                                   "; Point(1) = {0, 0, 0}; Point(2) = {s, 0, 0}; Point(3) = {s, s, 0};\n"
                                   "Point(4) = {0, s, 0}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4};\n"
                                   "Line(4) = {4, 1}; Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};\n"
                                   "Physical Curve(\"bottom\", 5) = {1}; Physical Surface(\"plate\", 6) = {1};\n");
  }
};

TEST_F(Program, help_and_version)
{
  EXPECT_EQ(run({"--version"}), 0);
  EXPECT_EQ(m_output.rfind("quadrille ", 0), 0u);
  EXPECT_EQ(run({"--help"}), 0);
  EXPECT_NE(m_output.find("Exit codes"), std::string::npos);
  for (const char* command : {"quad", "check"}) {
    EXPECT_EQ(run({command, "--help"}), 0);
    EXPECT_NE(m_output.find("--json"), std::string::npos);
  }
}

TEST_F(Program, meshes_a_gap_far_narrower_than_the_elements)
{
  // A disc in a cup. As few elements as the sizes ask for have sides that cut off the gap.
  const std::string in = write("gap.geo", R"(s = 3;
Point(1) = {-4, -4, 0, s}; Point(2) = {4, -4, 0, s}; Point(3) = {4, 4, 0, s}; Point(4) = {-4, 4, 0, s};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Point(5) = {0, 0, 0, s}; Point(6) = {1, 0, 0, s}; Point(7) = {-1, 0, 0, s};
Circle(5) = {6, 5, 7}; Circle(6) = {7, 5, 6};
Point(8) = {1.05, 0, 0, s}; Point(9) = {1.6, 0, 0, s}; Point(10) = {-1.05, 0, 0, s}; Point(11) = {-1.6, 0, 0, s};
Point(12) = {0, -1.05, 0, s}; Point(13) = {0, -1.6, 0, s};
Circle(7) = {8, 5, 12}; Circle(8) = {12, 5, 10}; Line(9) = {10, 11};
Circle(10) = {11, 5, 13}; Circle(11) = {13, 5, 9}; Line(12) = {9, 8};
Curve Loop(1) = {1:4}; Curve Loop(2) = {5, 6}; Curve Loop(3) = {7:12};
Plane Surface(1) = {1, 2, 3};
)");
  ASSERT_EQ(run({"quad", in, "-o", path("out/gap.msh"), "--starts", "1"}), 0) << m_error;
  EXPECT_EQ(run({"check", path("out/gap.msh"), "--against", in}), 0) << m_output << m_error;
}

TEST_F(Program, tells_when_details_need_more_quads_than_sizes_ask_for)
{
  // Four holes of 0.02, all of their corners are vertices of the mesh.
  std::string text = "Point(1)={0,0,0}; Point(2)={1,0,0}; Point(3)={1,1,0}; Point(4)={0,1,0};\n"
                     "Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,1}; Curve Loop(1)={1:4};\n";
  const auto add_hole = [&text](int n, const std::string& x, const std::string& y) {
    const auto id = [n](int i) { return std::to_string(4 * n + 1 + i % 4); };
    for (int i = 0; i < 4; ++i)
      text +=
          "Point(" + id(i) + ")={" + x + (i == 1 || i == 2 ? "+0.02" : "") + "," + y + (i > 1 ? "+0.02" : "") + ",0}; ";
    for (int i = 0; i < 4; ++i)
      text += "Line(" + id(i) + ")={" + id(i) + "," + id(i + 1) + "}; ";
    text += "Curve Loop(" + std::to_string(n + 1) + ")={" + id(0) + ":" + id(3) + "};\n";
  };
  add_hole(1, "0.29", "0.29");
  add_hole(2, "0.32", "0.69");
  add_hole(3, "0.69", "0.34");
  add_hole(4, "0.72", "0.74");
  const std::string geo = write("holes.geo", text + "Plane Surface(1)={1:5};\n");
  const std::string mesh = path("out/holes.msh");
  ASSERT_EQ(run({"quad", geo, "-o", mesh, "--size", "0.5", "--starts", "2"}), 0) << m_error;
  EXPECT_NE((m_error + m_output).find("smaller than the elements need"), std::string::npos);
  ASSERT_EQ(run({"quad", geo, "-o", mesh, "--size", "0.05", "--starts", "2"}), 0) << m_error;
  EXPECT_EQ((m_error + m_output).find("smaller than the elements need"), std::string::npos);
}

TEST_F(Program, unusable_arguments)
{
  const std::string in = square(), out = path("out/a.msh");
  expect_failure({}, 2, "no command");
  expect_failure({"mesh"}, 2, "mesh");
  expect_failure({"quad"}, 2, "no input file");
  expect_failure({"quad", in}, 2, "no output file");
  expect_failure({"quad", in, in, "-o", out}, 2, "one input file");
  expect_failure({"quad", in, "-o"}, 2, "output");
  expect_failure({"quad", in, "-o", out, "--sizes", "1"}, 2, "sizes");
  expect_failure({"quad", in, "-o", out, "--triangle", "1"}, 2, "triangle");
  expect_failure({"quad", in, "-o", out, "--anisotropic", "--isotropic"}, 2, "exclude");
  expect_failure({"quad", in, "-o", out, "--order", "2"}, 2, "order");
  expect_failure({"quad", in, "-o", out, "-o", out}, 2, "named twice");
  expect_failure({"quad", in, "-o", path("out/a.stl")}, 2, "unknown output format");
  expect_failure({"quad", in, "-o", out, "--starts", "some"}, 2, "starts");
  expect_failure({"quad", in, "-o", out, "--starts", "-1"}, 2, "starts");
  expect_failure({"quad", in, "-o", out, "--threads", "1.5"}, 2, "threads");
  expect_failure({"quad", in, "-o", out, "--triangle-size", "0"}, 2, "triangle-size");
  expect_failure({"quad", in, "-o", out, "--triangle-size", "nan"}, 2, "triangle-size");
  expect_failure({"quad", in, "-o", out, "--solver", "newton"}, 2, "newton");
  expect_failure({"quad", in, "-o", out, "--quantizer", "best"}, 2, "best");
  expect_failure({"quad", in, "-o", out, "--size", "0"}, 2, "positive");
  expect_failure({"quad", in, "-o", out, "--size", "-1"}, 2, "size");
  expect_failure({"quad", in, "-o", out, "--size", "nan"}, 2, "nan");
  expect_failure({"quad", in, "-o", out, "--size", "free"}, 2, "all sizes are free");
  expect_failure({"quad", in, "-o", out, "--unaligned", "lid"}, 2, "bottom");
  expect_failure({"quad", in, "-o", out, "--unaligned", "bottom"}, 2, "border");
  expect_failure({"quad", in, "-o", out, "--size", "lid=1"}, 2, "bottom");
  expect_failure({"quad", in, "-o", out, "--size", "bottom=1x2"}, 2, "anisotropic");
  expect_failure({"quad", in, "-o", out, "--size", "bottom=1", "--size", "bottom=2"}, 2, "contradict");
  expect_failure({"quad", in, "-o", out, "--size", "1e-5"}, 2, "--max-quads");
  expect_failure({"quad", in, "-o", out, "--size", "0.01", "--max-quads", "100"}, 2, "100;");
  expect_failure({"quad", in, "-o", out, "--max-quads", "0"}, 2, "--max-quads");
  expect_failure({"quad", in, "-o", out, "--field", path("out/f.txt")}, 2, ".vtu");
  expect_failure({"quad", in, "-o", out, "--picture", path("out/f.gif")}, 2, ".svg");
  expect_failure({"quad", in, "-o", out, "--json", out}, 2, "twice");
  expect_failure({"quad", in, "-o", path("nowhere/a.msh")}, 2, "does not exist");
  expect_failure({"quad", in, "-o", path("out")}, 2, "unknown output format");
  expect_failure({"check"}, 2, "no mesh");
  expect_failure({"check", in, "--size", "1"}, 2, "--against");
}

TEST_F(Program, output_folder_that_is_not_writable)
{
  const std::string in = square();
  if (fs::exists("/proc/self"))
    expect_failure({"quad", in, "-o", "/proc/quadrille.msh"}, 2, "writable");
  if (::geteuid() == 0)
    GTEST_SKIP() << "root may write to its own folders whatever their permissions";
  fs::permissions(path("out"), fs::perms::owner_read | fs::perms::owner_exec);
  expect_failure({"quad", in, "-o", path("out/a.msh")}, 2, "writable");
}

TEST_F(Program, unusable_input)
{
  const std::string out = path("out/a.msh"), json = path("out/a.json");
  const auto expect_unusable = [&](const std::string& in, const std::string& word) {
    expect_failure({"quad", in, "-o", out, "--json", json, "--quiet"}, 3, word);
    EXPECT_NE(m_error.find(in), std::string::npos) << m_error;
  };
  expect_unusable(path("missing.geo"), "no such file");
  expect_unusable(write("empty.geo", ""), "empty");
  expect_unusable(write("truncated.geo", content(square()).substr(0, content(square()).size() - 20)), "truncated");
  expect_unusable(write("square.xyz", "1"), "unknown format");
  expect_unusable(write("open.geo", "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {0, 1, 0};\n"
                                    "Line(1) = {1, 2}; Line(2) = {2, 3}; Curve Loop(1) = {1, 2};\n"
                                    "Plane Surface(1) = {1};\n"),
                  "open");
  EXPECT_EQ(run({"check", path("missing.msh")}), 3);
}

/// Extents of u and v in an OBJ file.
std::array<double, 2> texture_extents(const std::string& text)
{
  std::array<double, 4> box{1e300, -1e300, 1e300, -1e300};
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("vt ", 0) == 0) {
      std::istringstream values(line.substr(3));
      for (std::size_t c = 0; c < 2; ++c) {
        double x = 0;
        values >> x;
        box[2 * c] = std::min(box[2 * c], x);
        box[2 * c + 1] = std::max(box[2 * c + 1], x);
      }
    }
  return {box[1] - box[0], box[3] - box[2]};
}

TEST_F(Program, meshes_a_square_and_checks_it)
{
  const std::string in = square(), out = path("out/a.msh"), json = path("out/a.json");
  ASSERT_EQ(run({"quad", in, "-o", out, "--size", "0.5", "--json", json, "--field", path("out/f.vtu"), "--map",
                 path("out/m.obj"), "--picture", path("out/p.svg"), "--starts", "1", "--triangle-size", "0.4"}),
            0)
      << m_error;
  EXPECT_EQ(m_error, ""); // no progress on what is not a terminal
  const nlohmann::json summary = nlohmann::json::parse(content(json));
  EXPECT_EQ(summary["mesh"]["quads"], 64);
  EXPECT_EQ(summary["mesh"]["vertices"], 81);
  EXPECT_GT(summary["mesh"]["scaled_jacobian"]["min"], 0.99);
  EXPECT_LT(summary["mesh"]["size_error"]["max"], 0.05);
  EXPECT_EQ(summary["map"]["seam_residual_max"], 0);
  EXPECT_EQ(summary["field"]["index_sum"], 1);
  EXPECT_EQ(summary["input"]["euler_characteristic"], 1);
  for (const char* key :
       {"input", "field", "map", "layout", "quantization", "mesh", "seconds", "threads", "seed", "version"})
    EXPECT_TRUE(summary.contains(key)) << key;
  // The relaxed and the melted field are the same one here, so one of them is meshed.
  ASSERT_EQ(summary["field"]["candidates"].size(), 3u);
  int n_meshed = 0;
  for (const nlohmann::json& candidate : summary["field"]["candidates"])
    n_meshed += candidate.contains("mesh_score");
  EXPECT_EQ(n_meshed, 1);
  const std::string mesh = content(out);
  EXPECT_NE(mesh.find("1 5 \"bottom\""), std::string::npos);
  EXPECT_NE(mesh.find("2 6 \"plate\""), std::string::npos);
  EXPECT_EQ(content(path("out/p.svg")).rfind("<svg", 0), 0u);
  EXPECT_EQ(summary["map"]["integer_grid"]["flipped"], 0);
  EXPECT_EQ(texture_extents(content(path("out/m.obj"))), (std::array<double, 2>{8, 8})); // 64 quads
  EXPECT_EQ(std::distance(fs::directory_iterator(path("out")), {}), 5);                  // and no temporary files

  EXPECT_EQ(run({"check", out, "--against", in, "--size", "0.5", "--json", path("c.json")}), 0) << m_error;
  const nlohmann::json check = nlohmann::json::parse(content(path("c.json")));
  EXPECT_EQ(check["valid"], true);
  EXPECT_LT(check["against"]["border_distance_max_relative"], 1e-12);
  EXPECT_EQ(check["mesh"]["size_error"]["max"], summary["mesh"]["size_error"]["max"]);

  // The same file again, by another number of threads and quietly.
  ASSERT_EQ(run({"quad", in, "-o", path("b.msh"), "--size", "0.5", "--starts", "1", "--triangle-size", "0.4",
                 "--threads", "1", "--quiet"}),
            0);
  EXPECT_EQ(m_output, "");
  EXPECT_EQ(content(path("b.msh")), mesh);
}

TEST_F(Program, meshes_the_smooth_field_on_request)
{
  const std::string in = square(), json = path("a.json");
  ASSERT_EQ(run({"quad", in, "-o", path("a.msh"), "--smooth", "--size", "0.5", "--size", "3=1", "--size", "2=0.5:1",
                 "--size", "4=1:0.5", "--json", json}),
            0)
      << m_error;
  const nlohmann::json summary = nlohmann::json::parse(content(json));
  EXPECT_EQ(summary["field"]["chosen"]["kind"], "smooth");
  EXPECT_EQ(summary["map"]["integration_error"], summary["map"]["smooth_integration_error"]);
  EXPECT_TRUE(summary["field"]["singularities"].empty());
}

TEST_F(Program, numbers_of_elements_on_curves_are_met)
{
  const std::string in = square(), json = path("a.json");
  for (const char* layout : {"t-mesh", "base-complex"})
    for (const char* quantizer : {"greedy", "optimal"}) {
      if (std::string(quantizer) == "optimal" && !Quadrille::Optimal_quantizer::is_available())
        continue;
      const std::string out = path(std::string(layout) + quantizer + ".msh");
      ASSERT_EQ(
          run({"quad",    in,       "-o", out,        "--size", "0.5",         "--starts", "1",       "--triangle-size",
               "0.4",     "--json", json, "--layout", layout,   "--quantizer", quantizer,  "--count", "bottom=11",
               "--count", "2=7"}),
          0)
          << m_error;
      const nlohmann::json summary = nlohmann::json::parse(content(json));
      EXPECT_EQ(summary["mesh"]["quads"], 77);
      EXPECT_EQ(summary["layout"]["kind"], layout);
      EXPECT_EQ(summary["quantization"]["method"], quantizer);
      EXPECT_GT(summary["quantization"]["deviation"], 0.1); // 11 instead of 8
      if (Quadrille::Optimal_quantizer::is_available()) {
        EXPECT_LT(summary["quantization"]["optimality_gap"], 1e-2);
      }
    }
  expect_failure({"quad", in, "-o", path("out/a.msh"), "--count", "bottom=0"}, 2, "'bottom=0' is not NAME=N");
  expect_failure({"quad", in, "-o", path("out/a.msh"), "--count", "bottom"}, 2, "is not NAME=N");
  expect_failure({"quad", in, "-o", path("out/a.msh"), "--count", "roof=3"}, 2, "no curve named 'roof'");
  expect_failure({"quad", in, "-o", path("out/a.msh"), "--count", "1=3", "--count", "bottom=3"}, 2, "in common");
  expect_failure({"quad", in, "-o", path("out/a.msh"), "--layout", "brick"}, 2, "'brick'");
  expect_failure({"quad", in, "-o", path("out/a.msh"), "--quantizer", "best"}, 2, "'best'");
  if (Quadrille::Optimal_quantizer::is_available())
    expect_failure({"quad", in, "-o", path("out/a.msh"), "--starts", "1", "--triangle-size", "0.4", "--count", "1=9",
                    "--count", "3=8"},
                   4, "9 on '1', 8 on '3'");
}

TEST_F(Program, has_as_many_quads_as_wanted)
{
  const std::string in = square(), json = path("a.json");
  for (const int wanted : {150, 2000}) {
    ASSERT_EQ(run({"quad",
                   in,
                   "-o",
                   path("a.msh"),
                   "--size",
                   "0.5",
                   "--size",
                   "bottom=0.25",
                   "--size",
                   "2=0.25:0.5",
                   "--size",
                   "4=0.5:0.25",
                   "--quads",
                   std::to_string(wanted),
                   "--starts",
                   "1",
                   "--triangle-size",
                   "0.3",
                   "--json",
                   json}),
              0)
        << m_error;
    const nlohmann::json summary = nlohmann::json::parse(content(json));
    EXPECT_NEAR(summary["mesh"]["quads"], wanted, 0.05 * wanted);
    EXPECT_LT(summary["mesh"]["size_error"]["mean"], 0.2); // of the sizes after scaling
  }
}

TEST_F(Program, a_run_without_result_reports_the_stages_that_succeeded)
{
  // One triangle: three right angles do not add up to a disk, and there is no vertex inside for a singularity.
  const std::string in = write("one.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(run({"quad", in, "-o", path("out/a.msh"), "--json", path("a.json")}), 4);
  EXPECT_EQ(m_error.rfind("quadrille: error: map: ", 0), 0u) << m_error;
  const nlohmann::json summary = nlohmann::json::parse(content(path("a.json")));
  EXPECT_TRUE(summary.contains("input"));
  EXPECT_TRUE(summary.contains("field"));
  EXPECT_FALSE(summary.contains("mesh"));
  EXPECT_EQ(summary["error"]["stage"], "map");
  EXPECT_TRUE(fs::is_empty(path("out")));
}

TEST_F(Program, check_rejects_invalid_meshes)
{
  const std::string twisted = write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3 4\n");
  EXPECT_EQ(run({"check", twisted}), 4);
  EXPECT_NE(m_error.find("inverted"), std::string::npos) << m_error;
  EXPECT_EQ(run({"check", write("e.obj", "v 0 0 0\n")}), 3);
}

TEST_F(Program, an_interrupt_leaves_no_files)
{
  const std::string in = square();
  const pid_t child =
      start({"quad", in, "-o", path("out/a.msh"), "--size", "0.02", "--starts", "50", "--triangle-size", "0.05"});
  // It tells the number of triangles before it computes the field, which takes long.
  for (int i = 0; i < 3000 && content(path("stderr")).empty() && content(path("stdout")).empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  ::kill(child, SIGINT);
  EXPECT_EQ(wait_for(child), 130);
  EXPECT_TRUE(fs::is_empty(path("out")));
}

} // namespace
