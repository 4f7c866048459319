// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Lines inside the domain that are closed, cross, end in a T or separate regions; sizes and metrics inside.

#include "program_runner.h"

#include <Quadrille/read_mesh.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace Quadrille;

using Features = Quadrille_test::Program_runner;

/// A square of side 10 with an interface between two regions, a line across it, one that ends on it, and a circle.
const char* const geometry = R"(
Point(1) = {0, 0, 0}; Point(2) = {10, 0, 0}; Point(3) = {10, 10, 0}; Point(4) = {0, 10, 0};
Point(5) = {0, 4, 0}; Point(6) = {3, 4.3, 0}; Point(7) = {6.5, 4.5, 0}; Point(8) = {10, 4, 0};
Point(9) = {3, 1.5, 0}; Point(10) = {2.6, 7, 0}; Point(11) = {6.8, 8, 0};
Point(12) = {7, 2, 0}; Point(13) = {7.9, 2, 0}; Point(14) = {7, 2.9, 0}; Point(15) = {6.1, 2, 0};
Point(16) = {7, 1.1, 0};
Line(1) = {1, 2}; Line(2) = {2, 8}; Line(3) = {8, 3}; Line(4) = {3, 4}; Line(5) = {4, 5}; Line(6) = {5, 1};
Line(7) = {5, 6}; Line(8) = {6, 7}; Line(9) = {7, 8};
Line(10) = {9, 6}; Line(11) = {6, 10}; Line(12) = {7, 11};
Circle(13) = {13, 12, 14}; Circle(14) = {14, 12, 15}; Circle(15) = {15, 12, 16}; Circle(16) = {16, 12, 13};
Curve Loop(1) = {1, 2, -9, -8, -7, 6}; Plane Surface(1) = {1};
Curve Loop(2) = {7, 8, 9, 3, 4, 5}; Plane Surface(2) = {2};
Curve{10, 13, 14, 15, 16} In Surface{1};
Curve{11, 12} In Surface{2};
Physical Curve("border") = {1 : 6}; Physical Curve("interface") = {7, 8, 9};
Physical Curve("cross") = {10, 11}; Physical Curve("tee") = {12}; Physical Curve("loop") = {13 : 16};
Physical Surface("lower") = {1}; Physical Surface("upper") = {2};
)";

/// Sum of the lengths of a physical group's lines.
double group_length(const Labelled_mesh& mesh, const std::string& name)
{
  double length = 0;
  for (std::size_t i = 0; i < mesh.lines.size(); ++i) {
    const auto& names = mesh.curves[std::size_t(mesh.line_curve[i])].names;
    const auto &p = mesh.points[std::size_t(mesh.lines[i][0])], &q = mesh.points[std::size_t(mesh.lines[i][1])];
    if (std::count(names.begin(), names.end(), name))
      length += std::hypot(q[0] - p[0], q[1] - p[1]);
  }
  return length;
}

double region_area(const Labelled_mesh& mesh, const std::string& name)
{
  double area = 0;
  for (std::size_t f = 0; f < mesh.polygons.size(); ++f) {
    const auto& names = mesh.regions[std::size_t(mesh.polygon_region[f])].names;
    for (std::size_t i = 0; i < 4 && std::count(names.begin(), names.end(), name); ++i) {
      const auto &p = mesh.points[std::size_t(mesh.polygons[f][i])],
                 &q = mesh.points[std::size_t(mesh.polygons[f][(i + 1) % 4])];
      area += 0.5 * (p[0] * q[1] - p[1] * q[0]);
    }
  }
  return area;
}

TEST_F(Features, are_followed_by_isotropic_and_anisotropic_elements)
{
  const std::string in = write("lines.geo", geometry);
  const std::vector<std::string> requests[] = {
      {"--size", "0.5"},
      {"--anisotropic", "--size", "border=0.5", "--size", "interface=0.2x0.6", "--size", "cross=0.25x0.6", "--size",
       "tee=0.3x0.6", "--size", "loop=0.15x0.5"},
      {"--anisotropic", "--size", "border=free", "--size", "interface=0.2xfree", "--size", "cross=0.5", "--size",
       "tee=freex0.4", "--size", "loop=0.3"}};
  const double interface = std::hypot(3, 0.3) + std::hypot(3.5, 0.2) + std::hypot(3.5, 0.5);
  for (const std::vector<std::string>& request : requests) {
    std::vector<std::string> arguments = {"quad", in, "-o", path("mesh.msh"), "--starts", "2"};
    arguments.insert(arguments.end(), request.begin(), request.end());
    ASSERT_EQ(run(arguments), 0) << m_error;
    ASSERT_EQ(run({"check", path("mesh.msh"), "--against", in}), 0) << m_error;
    // Elements that cut a corner of a line would make it shorter.
    const Labelled_mesh mesh = read_mesh(path("mesh.msh"));
    EXPECT_NEAR(group_length(mesh, "interface"), interface, 1e-9);
    EXPECT_NEAR(group_length(mesh, "cross"), 2.8 + std::hypot(0.4, 2.7), 1e-9);
    EXPECT_NEAR(group_length(mesh, "tee"), std::hypot(0.3, 3.5), 1e-9);
    EXPECT_NEAR(group_length(mesh, "loop"), 1.8 * CGAL_PI, 0.3); // its chords
    EXPECT_NEAR(region_area(mesh, "lower"), 0.5 * (3 * 8.3 + 3.5 * 8.8 + 3.5 * 8.5), 1e-9);
    EXPECT_NEAR(region_area(mesh, "lower") + region_area(mesh, "upper"), 100, 1e-9);
  }
}

TEST_F(Features, need_not_be_followed)
{
  const std::string in = write("lines.geo", geometry), json = path("summary.json");
  const std::vector<std::string> arguments = {"quad",        in,   "-o",          path("mesh.msh"), "--starts", "2",
                                              "--unaligned", "12", "--unaligned", "loop",           "--size",   "0.5"};
  ASSERT_EQ(run(arguments), 0) << m_error;
  const Labelled_mesh mesh = read_mesh(path("mesh.msh"));
  EXPECT_EQ(group_length(mesh, "tee"), 0);
  EXPECT_EQ(group_length(mesh, "loop"), 0);
  EXPECT_GT(group_length(mesh, "cross"), 5);
  for (const char* name : {"interface", "border", "nothing"})
    EXPECT_EQ(run({"quad", in, "-o", path("out/a.msh"), "--unaligned", name}), 2) << name;

  // Sizes along the loop are met although no element follows it: there are far more of them there.
  std::vector<std::string> smaller = arguments;
  smaller.insert(smaller.end(), {"--size", "loop=0.1"});
  ASSERT_EQ(run(smaller), 0) << m_error;
  const auto number_near_loop = [&](const Labelled_mesh& quads) {
    return std::count_if(quads.points.begin(), quads.points.end(),
                         [](const auto& p) { return std::abs(std::hypot(p[0] - 7, p[1] - 2) - 0.9) < 0.3; });
  };
  EXPECT_GT(number_near_loop(read_mesh(path("mesh.msh"))), 6 * number_near_loop(mesh));
}

TEST_F(Features, metrics_turn_and_stretch_elements_inside)
{
  const std::string in = write("square.geo", "Point(1) = {0, 0, 0, 0.5}; Point(2) = {10, 0, 0, 0.5};\n"
                                             "Point(3) = {10, 10, 0, 0.5}; Point(4) = {0, 10, 0, 0.5};\n"
                                             "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
                                             "Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};\n");
  const std::string metric = write("metric.txt", "5 5 0.1 0.5 30 2.5\n");
  EXPECT_EQ(run({"quad", in, "-o", path("out/a.msh"), "--size-field", metric}), 2);
  EXPECT_NE(m_error.find("--anisotropic"), std::string::npos) << m_error;
  ASSERT_EQ(run({"quad", in, "-o", path("mesh.msh"), "--size-field", metric, "--anisotropic", "--starts", "4"}), 0)
      << m_error;
  // Quads near the centre in the frame of the metric: sides 0.1 and 0.5 along its axes.
  const Labelled_mesh mesh = read_mesh(path("mesh.msh"));
  const double c = std::cos(CGAL_PI / 6), s = std::sin(CGAL_PI / 6);
  double log_aspect = 0, deviation = 0;
  int n = 0;
  for (const std::vector<int>& quad : mesh.polygons) {
    const auto& a = mesh.points[std::size_t(quad[0])];
    if (std::hypot(a[0] - 5, a[1] - 5) > 1)
      continue;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto &p = mesh.points[std::size_t(quad[i])], &q = mesh.points[std::size_t(quad[(i + 1) % 4])];
      const double x = std::abs(c * (q[0] - p[0]) + s * (q[1] - p[1])),
                   y = std::abs(c * (q[1] - p[1]) - s * (q[0] - p[0]));
      log_aspect += (y > x ? 1 : -1) * std::log(std::hypot(x, y));
      deviation += std::atan2(std::min(x, y), std::max(x, y));
      ++n;
    }
  }
  ASSERT_GT(n, 40);
  EXPECT_NEAR(2 * log_aspect / n, std::log(5.0), 0.5);
  EXPECT_LT(deviation / n, 10 * CGAL_PI / 180);
}

} // namespace
