// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "temporary_files.h"
#include "tetrahedral_mesh_texts.h"
#include "tetrahedral_test_meshes.h"

#include <Quadrille/fill_with_tetrahedra.h>
#include <Quadrille/read_mesh.h>
#include <Quadrille/read_tetrahedral_mesh.h>
#include <Quadrille/write_mesh.h>

#include <map>
#include <sstream>

using namespace Quadrille;

namespace {

/// Adds a cube with its lower corner at (low, low, low), as quadrangles or triangles.
void add_cube(Labelled_mesh& mesh, double low, double side, bool of_triangles)
{
  const int first = int(mesh.points.size());
  for (int i = 0; i < 8; ++i)
    mesh.points.push_back({low + side * (i % 2), low + side * (i / 2 % 2), low + side * (i / 4)});
  for (const std::array<int, 4>& q :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    const auto corner = [&](std::size_t i) { return first + q[i]; };
    if (of_triangles) {
      mesh.polygons.push_back({corner(0), corner(1), corner(2)});
      mesh.polygons.push_back({corner(0), corner(2), corner(3)});
    } else {
      mesh.polygons.push_back({corner(0), corner(1), corner(2), corner(3)});
    }
  }
  mesh.polygon_region.assign(mesh.polygons.size(), -1);
}

Labelled_mesh cube(double low = 0, double side = 1, bool of_triangles = true)
{
  Labelled_mesh mesh;
  add_cube(mesh, low, side, of_triangles);
  return mesh;
}

std::string off_text(const Labelled_mesh& mesh)
{
  std::ostringstream text;
  text.precision(17);
  text << "OFF\n" << mesh.points.size() << " " << mesh.polygons.size() << " 0\n";
  for (const auto& p : mesh.points)
    text << p[0] << " " << p[1] << " " << p[2] << "\n";
  for (const auto& polygon : mesh.polygons) {
    text << polygon.size();
    for (const int v : polygon)
      text << " " << v;
    text << "\n";
  }
  return text.str();
}

/// Triangles that belong to one tetrahedron.
std::set<std::array<int, 3>> boundary(const Tetrahedral_mesh& mesh)
{
  std::map<std::array<int, 3>, int> count;
  for (const std::array<int, 4>& t : mesh.tetrahedra)
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<int, 3> face = {t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4]};
      std::sort(face.begin(), face.end());
      ++count[face];
    }
  std::set<std::array<int, 3>> result;
  for (const auto& [face, n] : count) {
    EXPECT_LE(n, 2);
    if (n == 1)
      result.insert(face);
  }
  return result;
}

double length_of_features(const Tetrahedral_mesh& mesh)
{
  double sum = 0;
  for (const auto& e : mesh.feature_edges)
    sum += (mesh.point(std::size_t(e[0])) - mesh.point(std::size_t(e[1]))).norm();
  return sum;
}

double mean_edge_length(const Tetrahedral_mesh& mesh)
{
  std::set<std::array<int, 2>> edges;
  for (const auto& t : mesh.tetrahedra)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j)
        edges.insert({std::min(t[i], t[j]), std::max(t[i], t[j])});
  double sum = 0;
  for (const auto& e : edges)
    sum += (mesh.point(std::size_t(e[0])) - mesh.point(std::size_t(e[1]))).norm();
  return sum / double(edges.size());
}

void expect_positive(const Tetrahedral_mesh& mesh)
{
  for (const auto& t : mesh.tetrahedra)
    EXPECT_GT(volume(mesh, t), 0);
}

class Fill : public Temporary_files {
protected:
  void expect_error(const std::string& file, const std::string& reason, const Filling_options& options = {}) const
  {
    try {
      fill_with_tetrahedra(file, options);
      ADD_FAILURE() << file << " was filled";
    } catch (const Invalid_input_error& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(file), std::string::npos) << message;
      EXPECT_NE(message.find(reason), std::string::npos) << message;
    }
  }

  static Filling_options size(double h)
  {
    Filling_options options;
    options.tetrahedron_size = h;
    return options;
  }
};

using Fill_geometry = Fill;

#if defined(__SANITIZE_ADDRESS__) || !defined(QUADRILLE_WITH_TETGEN)
// Address sanitizer does not allow what keeps TetGen and Gmsh apart.
constexpr bool has_tetgen = false;
#else
constexpr bool has_tetgen = true;
#endif

class Fill_surface : public Fill {
protected:
  void SetUp() override
  {
    if (!has_tetgen)
      GTEST_SKIP() << "without TetGen";
  }
};

TEST_F(Fill_surface, keeps_the_triangles)
{
  for (const double side : {1.0, 1e8, 1e-8, 1e-70}) {
    const Labelled_mesh surface = cube(-side / 3, side);
    const Tetrahedral_mesh mesh = fill_with_tetrahedra(write("a.off", off_text(surface)));
    expect_positive(mesh);
    EXPECT_NEAR(volume(mesh) / (side * side * side), 1, 1e-12);
    EXPECT_TRUE(std::equal(surface.points.begin(), surface.points.end(), mesh.points.begin()));
    std::vector<std::array<int, 3>> triangles;
    for (const auto& polygon : surface.polygons)
      triangles.push_back({polygon[0], polygon[1], polygon[2]});
    EXPECT_EQ(boundary(mesh), as_set(triangles));
  }
}

TEST_F(Fill_surface, to_a_given_size)
{
  for (const double side : {1.0, 1e8, 1e-8, 1e-70}) {
    const Tetrahedral_mesh mesh = fill_with_tetrahedra(write("a.off", off_text(cube(0, side))), size(0.1 * side));
    expect_positive(mesh);
    EXPECT_NEAR(volume(mesh) / (side * side * side), 1, 1e-12);
    EXPECT_NEAR(mean_edge_length(mesh) / (0.1 * side), 1, 0.2);
    for (const auto& face : boundary(mesh)) { // on the cube still
      bool on_side = false;
      for (std::size_t k = 0; k < 3; ++k)
        for (const double x : {0.0, side})
          on_side |= mesh.points[std::size_t(face[0])][k] == x && mesh.points[std::size_t(face[1])][k] == x &&
                     mesh.points[std::size_t(face[2])][k] == x;
      EXPECT_TRUE(on_side);
    }
  }
}

TEST_F(Fill_surface, whatever_the_format_and_the_orientation)
{
  Labelled_mesh quadrangles = cube(0, 1, false);
  std::reverse(quadrangles.polygons[1].begin(), quadrangles.polygons[1].end());
  std::reverse(quadrangles.polygons[4].begin(), quadrangles.polygons[4].end());
  quadrangles.points.push_back({5, 5, 5}); // isolated
  write_mesh(path("a.obj"), quadrangles);
  write_mesh(path("a.vtk"), quadrangles);
  write_mesh(path("a.msh"), quadrangles);
  write("a.off", off_text(quadrangles));
  const std::string medit = "MeshVersionFormatted 1\nDimension 3\nVertices\n4\n0 0 0 0\n6 0 0 0\n0 1 0 0\n0 0 1 0\n"
                            "Triangles\n4\n1 2 3 0\n1 2 4 0\n1 3 4 0\n2 3 4 0\n";
  write("a.mesh", medit);
  std::string stl = "solid x\n";
  const Labelled_mesh triangles = cube();
  for (const auto& polygon : triangles.polygons) {
    stl += "facet normal 0 0 0\nouter loop\n";
    for (const int v : polygon)
      stl += "vertex " + std::to_string(triangles.points[std::size_t(v)][0]) + " " +
             std::to_string(triangles.points[std::size_t(v)][1]) + " " +
             std::to_string(triangles.points[std::size_t(v)][2]) + "\n";
    stl += "endloop\nendfacet\n";
  }
  write("a.stl", stl + "endsolid x\n");
  for (const char* name : {"a.obj", "a.vtk", "a.msh", "a.off", "a.mesh", "a.stl"}) {
    const Tetrahedral_mesh mesh = fill_with_tetrahedra(path(name));
    EXPECT_NEAR(volume(mesh), 1, 1e-12) << name;
    EXPECT_EQ(boundary(mesh).size(), std::string(name) == "a.mesh" ? 4u : 12u) << name;
    EXPECT_EQ(load_tetrahedral_mesh(path(name)).tetrahedra, mesh.tetrahedra) << name;
  }
}

TEST_F(Fill_surface, concave_polygons)
{
  // An L-shaped prism of height 1; its two ends are polygons with 6 corners.
  const std::string text = "OFF\n12 8 0\n0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n0 0 1\n2 0 1\n2 1 1\n1 1 1\n1 2 1\n"
                           "0 2 1\n6 0 1 2 3 4 5\n6 6 7 8 9 10 11\n4 0 1 7 6\n4 1 2 8 7\n4 2 3 9 8\n4 3 4 10 9\n"
                           "4 4 5 11 10\n4 5 0 6 11\n";
  EXPECT_NEAR(volume(fill_with_tetrahedra(write("l.off", text))), 3, 1e-12);
}

TEST_F(Fill_surface, cavities_and_parts_inside_them)
{
  Labelled_mesh surface = cube(0, 5); // a cube with a cavity, in that a cube with a cavity; and a cube beside
  add_cube(surface, 1, 3, true);
  add_cube(surface, 1.5, 2, true);
  add_cube(surface, 2, 1, true);
  add_cube(surface, 6, 2, true);
  for (const double h : {0.0, 0.8}) {
    const Tetrahedral_mesh mesh = fill_with_tetrahedra(write("a.off", off_text(surface)), size(h));
    expect_positive(mesh);
    EXPECT_NEAR(volume(mesh), 125 - 27 + 8 - 1 + 8, 1e-9);
  }
}

TEST_F(Fill_surface, lines_become_feature_edges)
{
  Labelled_mesh surface = cube();
  for (const auto& line : {std::array{0, 1}, {1, 3}, {3, 7}})
    surface.lines.push_back(line);
  surface.line_curve.assign(surface.lines.size(), -1);
  write_mesh(path("a.obj"), surface);
  const Tetrahedral_mesh kept = fill_with_tetrahedra(path("a.obj"));
  EXPECT_EQ(as_set(kept.feature_edges), as_set(surface.lines));
  const Tetrahedral_mesh divided = fill_with_tetrahedra(path("a.obj"), size(0.2));
  EXPECT_GT(divided.feature_edges.size(), 9u);
  EXPECT_NEAR(length_of_features(divided), 3, 1e-12);
}

TEST_F(Fill_surface, errors_name_the_place)
{
  Labelled_mesh open = cube();
  open.polygons.pop_back();
  expect_error(write("open.off", off_text(open)),
               "not closed: the edge from (1, 0, 0) to (1, 0, 1) belongs to 1 triangle");
  expect_error(path("open.off"), "so do 2 other edges");
  Labelled_mesh touching = cube();
  add_cube(touching, 0, 1, true);
  for (std::size_t i = 8; i < 16; ++i) { // shares an edge
    touching.points[i][0] += 1;
    touching.points[i][1] += 1;
  }
  expect_error(write("touching.off", off_text(touching)),
               "the edge from (1, 1, 0) to (1, 1, 1) belongs to 4 triangles");
  Labelled_mesh crossing = cube();
  add_cube(crossing, 0.5, 1, true);
  expect_error(write("crossing.off", off_text(crossing)), "intersects itself: polygons 2 and 16 intersect");
  Labelled_mesh twice = cube();
  add_cube(twice, 0, 2, true);
  expect_error(write("twice.off", off_text(twice)), "intersects itself");
  Labelled_mesh flat = cube();
  flat.points.push_back({0.5, 0.5, 0});
  flat.polygons[0] = {0, 2, 8};
  flat.polygons.push_back({0, 8, 3});
  flat.polygons.push_back({2, 3, 8});
  flat.polygons.push_back({0, 3, 8});
  expect_error(write("flat.off", off_text(flat)), "polygon 12 at (0, 0, 0) is degenerate");
  Labelled_mesh infinite = cube();
  infinite.points[3][1] = std::numeric_limits<double>::infinity();
  expect_error(write("infinite.off", off_text(infinite)), "point 3 has a coordinate that is not a finite number");
  expect_error(write("nothing.off", "OFF\n1 0 0\n0 0 0\n"), "no triangles");
  expect_error(write("a.off", off_text(cube())), "would be about", size(1e-5));
  Labelled_mesh turned = cube(); // the volume does not depend on orientations
  std::swap(turned.polygons[2][0], turned.polygons[2][1]);
  std::swap(turned.polygons[3][0], turned.polygons[3][1]);
  Filling_options few = size(0.1);
  few.max_tetrahedra = 5000;
  expect_error(write("turned.off", off_text(turned)), "would be about", few);
  Filling_options hurry = size(0.008);
  hurry.time_limit_seconds = 0.05;
  expect_error(path("a.off"), "TetGen did not finish within", hurry);
  expect_error(write("tets.mesh", Tetrahedral_mesh_texts(cube_of_tetrahedra(1)).medit()), "tetrahedra already, 6");
}

TEST_F(Fill, options_and_names_are_checked)
{
  for (const double h : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(fill_with_tetrahedra(path("a.off"), size(h)), Invalid_argument_error);
  expect_error(path("a.off"), "no such file");
  expect_error(path("a.step"), "no such file");
  expect_error(path("a.xyz"), "unknown format");
  EXPECT_THROW(load_tetrahedral_mesh(path("a.xyz")), Invalid_input_error);
  EXPECT_EQ(
      load_tetrahedral_mesh(write("a.mesh", Tetrahedral_mesh_texts(cube_of_tetrahedra(1)).medit())).tetrahedra.size(),
      6u);
}

#ifndef QUADRILLE_WITH_TETGEN
TEST_F(Fill, says_that_tetgen_is_missing) { expect_error(write("a.off", off_text(cube())), "needs TetGen"); }
#endif

TEST_F(Fill_geometry, curves_are_features_and_seams_are_not)
{
  const std::string occ = "SetFactory(\"OpenCASCADE\");\n";
  const double pi = std::acos(-1.0);
  const Tetrahedral_mesh box = fill_with_tetrahedra(write("box.geo", occ + "Box(1) = {0, 0, 0, 1, 2, 3};\n"));
  expect_positive(box);
  EXPECT_NEAR(volume(box), 6, 1e-9);
  EXPECT_NEAR(length_of_features(box), 24, 1e-9);
  const Tetrahedral_mesh cylinder =
      fill_with_tetrahedra(write("cylinder.geo", occ + "Cylinder(1) = {0, 0, 0, 0, 0, 4, 1};\n"), size(0.3));
  EXPECT_NEAR(volume(cylinder), 4 * pi, 0.3);
  EXPECT_NEAR(length_of_features(cylinder), 4 * pi, 0.2);
  EXPECT_NEAR(mean_edge_length(cylinder) / 0.3, 1, 0.2);
  const Tetrahedral_mesh ball = fill_with_tetrahedra(write("ball.geo", occ + "Sphere(1) = {0, 0, 0, 1};\n"));
  EXPECT_NEAR(volume(ball), 4 * pi / 3, 0.1);
  EXPECT_TRUE(ball.feature_edges.empty());
}

TEST_F(Fill_geometry, sizes_of_a_script_are_overruled)
{
  const std::string box = "Point(1) = {0, 0, 0, 0.01}; Point(2) = {1, 0, 0, 0.01}; Line(1) = {1, 2};\n"
                          "Extrude{0, 1, 0} { Curve{1}; }\nExtrude{0, 0, 1} { Surface{5}; }\n"
                          "Field[1] = MathEval; Field[1].F = \"0.01\"; Background Field = 1;\n"
                          "Mesh.ElementOrder = 2; Mesh.RecombineAll = 1; Mesh.MeshSizeFactor = 0.1;\n";
  const Tetrahedral_mesh mesh = fill_with_tetrahedra(write("box.geo", box), size(0.2));
  expect_positive(mesh);
  EXPECT_NEAR(volume(mesh), 1, 1e-9);
  EXPECT_NEAR(length_of_features(mesh), 12, 1e-9);
  EXPECT_NEAR(mean_edge_length(mesh) / 0.2, 1, 0.2);
  EXPECT_NEAR(mean_edge_length(fill_with_tetrahedra(path("box.geo"))) / (std::sqrt(3.0) / 20), 1, 0.2);
  const std::string layers = "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Line(1) = {1, 2};\n"
                             "Extrude{0, 1, 0} { Curve{1}; Layers{5}; Recombine; }\n"
                             "Extrude{0, 0, 1} { Surface{5}; Layers{5}; Recombine; }\n";
  expect_error(write("layers.geo", layers), "other cells than tetrahedra in volume 1");
}

TEST_F(Fill_geometry, only_physical_volumes_where_there_are_any)
{
  const std::string boxes = "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {3, 0, 0, 2, 1, 1};\n";
  EXPECT_NEAR(volume(fill_with_tetrahedra(write("both.geo", boxes))), 3, 1e-9);
  const Tetrahedral_mesh one = fill_with_tetrahedra(write("one.geo", boxes + "Physical Volume(\"it\") = {2};\n"));
  EXPECT_NEAR(volume(one), 2, 1e-9);
  EXPECT_NEAR(length_of_features(one), 16, 1e-9);
}

TEST_F(Fill_geometry, errors)
{
  expect_error(write("plate.geo", "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 1, 1};\n"), "no volumes");
  expect_error(write("a.step", "solid\n"), "not a STEP file");
  expect_error(write("cut.geo", "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0"), "truncated");
  const std::string box = write("box.geo", "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1};\n");
  expect_error(box, "would be about", size(1e-4));
  Filling_options hurry = size(0.02);
  hurry.time_limit_seconds = 0.1;
  expect_error(box, "did not finish within", hurry);
  // A script may end with a fillet, which needs no semicolon.
  const std::string fillet = "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1};\nFillet{1}{1}{0.2}\n";
  EXPECT_LT(volume(fill_with_tetrahedra(write("fillet.geo", fillet))), 0.999);
}

/// Files of which most are broken: filled, or refused with a message that names them.
TEST(Fill_shared_files, hostile_ones_give_errors_or_meshes)
{
  const std::filesystem::path folder = std::filesystem::path(QUADRILLE_SHARED_DATA) / "hostile";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << folder << " is not there";
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  for (const std::string& file : files) {
    try {
      expect_positive(load_tetrahedral_mesh(file));
    } catch (const Invalid_input_error& error) {
      EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
    }
  }
}

/// Real parts: each is filled, with the volume that does not depend on how.
TEST(Fill_shared_files, gives_the_volume)
{
  const std::filesystem::path folder = QUADRILLE_SHARED_DATA;
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << folder << " is not there";
  for (const auto& [name, expected] : {std::pair<std::string, double>("cad/hexme/s03o_pentagon.geo", 2.37764),
                                       {"cad/hexme/n05o_box_min_pcyls.geo", 0},
                                       {"cad/hexme/s17o_sphere.stp", 500 * std::acos(-1.0) / 3},
                                       {"cad/hexme/i10o_simp.step", 0},
                                       {"surface/loopycuts/prism_rem.obj", 4.5},
                                       {"surface/common/spot.obj", 0},
                                       {"surface/sh_cross_frame/ellipsoid.obj", 0},
                                       {"hostile/trimesh/busted.STL", 0}}) {
    const bool is_surface = name.rfind("cad", 0) != 0;
    if (is_surface && !has_tetgen)
      continue;
    const Tetrahedral_mesh mesh = fill_with_tetrahedra((folder / name).string());
    expect_positive(mesh);
    EXPECT_GT(mesh.tetrahedra.size(), 100u) << name;
    EXPECT_NEAR(expected > 0 ? volume(mesh) / expected : 1, 1, 0.02) << name;
  }
}

} // namespace
