// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "temporary_files.h"

#include <Quadrille/exceptions.h>
#include <Quadrille/read_mesh.h>
#include <Quadrille/read_planar_domain.h>

#include <algorithm>
#include <cmath>

using namespace Quadrille;

namespace {

class Bad_input : public Temporary_files {
protected:
  /// Reading has to fail with a message that names the file and contains `reason`.
  void expect_error(const std::string& name, const std::string& text, const std::string& reason)
  {
    const std::string file = text.empty() ? path(name) : write(name, text);
    try {
      read_planar_domain(file);
      FAIL() << name << " was read";
    } catch (const Invalid_input_error& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(file), std::string::npos) << message;
      EXPECT_NE(message.find(reason), std::string::npos) << message;
    }
  }
};

const std::string points = "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};\n";
const std::string off_square = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

TEST_F(Bad_input, files)
{
  expect_error("missing.geo", "", "no such file");
  expect_error("missing.msh", "", "no such file");
  write("empty.geo", "");
  expect_error("empty.geo", "", "empty");
  std::filesystem::create_directory(path("folder.geo"));
  expect_error("folder.geo", "", "folder");
  expect_error("domain.xyz", "anything", "unknown format");
  expect_error("garbage.geo", "%&/;\n", "syntax error");
  expect_error("truncated.geo", points + "Line(1) = {1, ", "truncated");
  expect_error("no_surface.geo", points, "no surfaces");
  expect_error("garbage.step", "solid", "not a STEP file");
  expect_error("truncated.step", "ISO-10303-21;\nHEADER;\n", "cannot be read");
  expect_error("garbage.brep", "something else", "not an Open CASCADE");
  expect_error("garbage.iges", "something else", "not an IGES");
  expect_error("garbage.msh", "$Nodes\n1 2 3", "not a Gmsh mesh");
  expect_error("truncated.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n", "truncated");
  expect_error("truncated.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n", "ends at vertex 2");
  expect_error("counts.off", "OFF\n2000000000 5 0\n", "more than the file has room for");
  expect_error("garbage.off", "PNG", "does not begin with OFF");
  expect_error("index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 3\n", "does not exist");
  expect_error("index.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n", "line 3");
  expect_error("garbage.vtk", "hello", "vtk DataFile");
  expect_error("truncated.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n0 0",
               "expected");
  expect_error("no_faces.obj", "v 0 0 0\n", "no triangles");
}

TEST_F(Bad_input, outlines)
{
  expect_error("open.geo",
               points + "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4};\n"
                        "Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};\n",
               "is open at point");
  expect_error("bow_tie.geo",
               points + "Line(1) = {1, 3}; Line(2) = {3, 2}; Line(3) = {2, 4}; Line(4) = {4, 1};\n"
                        "Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};\n",
               "curves 1 and 3 cross");
  expect_error("tent.geo",
               points + "Point(5) = {0.5, 0.5, 1};\n"
                        "Line(1) = {1, 2}; Line(2) = {2, 5}; Line(3) = {5, 1}; Curve Loop(1) = {1 : 3};\n"
                        "Plane Surface(1) = {1};\n",
               "z is not constant");
  expect_error("ball.geo", "SetFactory(\"OpenCASCADE\"); Sphere(1) = {0, 0, 0, 1};\n", "volumes");
  expect_error("zero.geo",
               points + "Point(5) = {1, 0, 0}; Line(1) = {1, 2}; Line(2) = {2, 5}; Line(3) = {5, 3};\n"
                        "Line(4) = {3, 1}; Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};\n",
               "has no length");
  expect_error("exit.geo", "Exit;\n", "ended abnormally");
}

TEST_F(Bad_input, outlines_that_touch_themselves)
{
  const std::string square = points + "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n";
  const std::string two_loops = "Curve Loop(1) = {1 : 4}; Curve Loop(2) = {5 : 7}; Plane Surface(1) = {1, 2};\n";
  const std::string inner = "Point(6) = {0.4, 0.2, 0}; Point(7) = {0.2, 0.4, 0};\n";
  expect_error("touching_hole.geo",
               square + inner + "Line(5) = {1, 6}; Line(6) = {6, 7}; Line(7) = {7, 1};\n" + two_loops,
               "touches itself in point 1");
  expect_error("duplicate_point.geo",
               square + inner + "Point(5) = {0, 0, 0}; Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 5};\n" +
                   two_loops,
               "points 1 and 5 have the same coordinates");
  expect_error("hole_on_side.geo",
               square + inner + "Point(5) = {0.5, 0, 0}; Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 5};\n" +
                   two_loops,
               "curves 1 and 5 cross, touch");
  expect_error("gap_without_width.geo",
               points + "Point(5) = {0.5, 0, 0}; Point(6) = {0.5, 0.5, 0}; Point(7) = {0.5, 0.5, 0};\n"
                        "Point(8) = {0.5, 0, 0}; Line(1) = {1, 5}; Line(2) = {5, 6}; Line(3) = {6, 8};\n"
                        "Line(4) = {8, 2}; Line(5) = {2, 3}; Line(6) = {3, 4}; Line(7) = {4, 1};\n"
                        "Curve Loop(1) = {1 : 7}; Plane Surface(1) = {1};\n",
               "points 5 and 8 have the same coordinates");
  expect_error("overlapping_sides.geo",
               square +
                   "Point(5) = {0.2, 0, 0}; Point(6) = {0.8, 0, 0}; Point(7) = {0.5, 0.5, 0};\n"
                   "Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 5};\n" +
                   two_loops,
               "curves 1 and 5 overlap");
  expect_error("spike.geo",
               points + "Line(1) = {1, 2}; Point(5) = {2, 0, 0}; Line(2) = {2, 5}; Line(3) = {5, 1};\n"
                        "Curve Loop(1) = {1 : 3}; Plane Surface(1) = {1};\n",
               "overlap");
  expect_error("two_circles.geo",
               "r = 1;\nPoint(1) = {0, 0, 0}; Point(2) = {r, 0, 0}; Point(3) = {-r, 0, 0}; Point(4) = {2, 0, 0};\n"
               "Point(5) = {3, 0, 0}; Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 2}; Circle(3) = {2, 4, 5};\n"
               "Circle(4) = {5, 4, 2}; Curve Loop(1) = {1, 2}; Curve Loop(2) = {3, 4}; Plane Surface(1) = {1};\n"
               "Plane Surface(2) = {2};\n",
               "touches itself in point 2");
}

TEST_F(Bad_input, features_that_leave_the_domain)
{
  const std::string square = points + "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
                                      "Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};\n";
  expect_error("crossing.geo",
               square + "Point(5) = {0.5, 0.5, 0}; Point(6) = {1.5, 0.5, 0}; Line(5) = {5, 6};\n"
                        "Curve{5} In Surface{1};\n",
               "curves 2 and 5 cross");
  expect_error("outside.geo",
               square + "Point(5) = {1.5, 0.5, 0}; Point(6) = {1.6, 0.7, 0}; Line(5) = {5, 6};\n"
                        "Curve{5} In Surface{1};\n",
               "curve 5 leaves surface 1");
  expect_error("from_a_corner.geo", square + "Point(5) = {1.5, 0.5, 0}; Line(5) = {2, 5}; Curve{5} In Surface{1};\n",
               "curve 5 leaves surface 1");
  const std::string slit = square + "Point(5) = {0.5, 0.5, 0}; Line(5) = {2, 5}; Curve{5} In Surface{1};\n";
  EXPECT_EQ(read_planar_domain(write("slit.geo", slit)).curves.size(), 5u); // within, although it starts on the border
}

TEST_F(Bad_input, an_endless_script_is_stopped)
{
  const std::string file = write("loop.geo", "i = 0;\nFor k In {0 : 1e15}\n i = k;\nEndFor\n");
  Planar_domain_options options;
  options.time_limit_seconds = 0.5;
  EXPECT_THROW(read_planar_domain(file, options), Invalid_input_error);
}

TEST_F(Bad_input, triangles)
{
  expect_error("surface.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 1\n0 1 0\n3 0 1 2\n3 0 2 3\n", "z varies");
  expect_error("nan.off", "OFF\n3 1 0\n0 0 0\n1 nan 0\n1 1 0\n3 0 1 2\n", "not a finite number");
  expect_error("inf.off", "OFF\n3 1 0\n0 0 0\n1 inf 0\n1 1 0\n3 0 1 2\n", "not a finite number");
  expect_error("quad.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", "has 4 corners");
  expect_error("twice.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 2\n", "uses a point twice");
  expect_error("flat.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n3 0 1 2\n3 0 2 3\n", "triangle 0");
  expect_error("inverted.off",
               "OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.5 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 0 3 4\n", "triangle 3");
  expect_error("fan.off", "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 2 0\n0 3 0\n3 0 1 2\n3 0 1 3\n3 0 1 4\n", "non-manifold");
  expect_error("touching.off", "OFF\n5 2 0\n0 0 0\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n3 0 1 2\n3 0 3 4\n", "non-manifold");
  expect_error("parts.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n5 5 0\n6 5 0\n5 6 0\n3 0 1 2\n3 3 4 5\n", "disconnected");
  expect_error("soup.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n1 1 0\n0 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 3 4 5\n",
               "same coordinates");
  // A strip that winds around the origin by more than a full turn: every triangle is fine, the whole is not.
  std::string spiral = "OFF\n22 20 0\n";
  for (int i = 0; i <= 10; ++i) {
    const double a = 0.7 * i;
    spiral += std::to_string(std::cos(a)) + " " + std::to_string(std::sin(a)) + " 0\n";
    spiral += std::to_string(2 * std::cos(a)) + " " + std::to_string(2 * std::sin(a)) + " 0\n";
  }
  for (int i = 0; i < 20; ++i)
    spiral += "3 " + std::to_string(i) +
              (i % 2 == 0 ? " " + std::to_string(i + 1) + " " + std::to_string(i + 2)
                          : " " + std::to_string(i + 2) + " " + std::to_string(i + 1)) +
              "\n";
  expect_error("spiral.off", spiral, "intersects itself");
}

TEST_F(Bad_input, good_meshes_are_read)
{
  EXPECT_EQ(read_planar_domain(write("square.off", off_square)).mesh.number_of_faces(), 4u); // a chord is split
  // Clockwise as a whole, with an isolated point.
  const Planar_domain domain =
      read_planar_domain(write("back.off", "OFF\n5 2 0\n9 9 9\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 3 2 1\n3 4 3 1\n"));
  EXPECT_EQ(domain.mesh.number_of_vertices(), 5u);
  EXPECT_EQ(domain.notes.size(), 2u); // the order, and the chord
}

/// Nothing in a folder of hostile files may do worse than an error.
TEST(Hostile_files, give_errors_or_domains)
{
  const std::filesystem::path folder = std::filesystem::path(QUADRILLE_SHARED_DATA) / "hostile";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << folder << " is not there";
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  for (const std::string& file : files)
    for (const bool is_domain : {true, false}) {
      try {
        if (is_domain)
          read_planar_domain(file);
        else
          read_mesh(file);
      } catch (const Invalid_input_error& error) {
        EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
      }
    }
}

} // namespace
