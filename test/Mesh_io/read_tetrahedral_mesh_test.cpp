// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "temporary_files.h"
#include "tetrahedral_mesh_texts.h"
#include "tetrahedral_test_meshes.h"

#include <Quadrille/exceptions.h>
#include <Quadrille/read_tetrahedral_mesh.h>

#include <gmsh.h>

#include <map>

using namespace Quadrille;

namespace {

/// Every other tetrahedron has its corners in the other order.
Tetrahedral_mesh of_both_orientations(Tetrahedral_mesh mesh)
{
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); t += 2)
    std::swap(mesh.tetrahedra[t][0], mesh.tetrahedra[t][1]);
  return mesh;
}

class Read_tetrahedral_mesh : public Temporary_files {
protected:
  /// All files of a mesh, by name. Those of TetGen come as two or three.
  std::map<std::string, std::string> all_files(const Tetrahedral_mesh& mesh) const
  {
    const Tetrahedral_mesh_texts texts(of_both_orientations(mesh));
    std::map<std::string, std::string> files = {
        {"a.mesh", texts.medit()}, {"a.vtk", texts.vtk()},     {"b.vtk", texts.vtk_5()}, {"c.vtk", texts.vtk_binary()},
        {"a.ovm", texts.ovm()},    {"a.msh", texts.msh_2_2()}, {"a.ele", texts.ele(0)},  {"b.node", texts.node(1)}};
    write("a.node", texts.node(0));
    write("a.edge", texts.edge(0));
    write("b.ele", texts.ele(1));
    write("b.edge", texts.edge(1));
    return files;
  }

  /// Reading has to fail with a message that names the file and contains `reason`.
  void expect_error(const std::string& name, const std::string& text, const std::string& reason) const
  {
    const std::string file = text.empty() ? path(name) : write(name, text);
    try {
      read_tetrahedral_mesh(file);
      ADD_FAILURE() << name << " was read";
    } catch (const Invalid_input_error& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(m_folder.string()), std::string::npos) << message;
      EXPECT_NE(message.find(reason), std::string::npos) << message;
    }
  }
};

void expect_consistent(const Tetrahedral_mesh& mesh)
{
  for (const std::array<int, 4>& t : mesh.tetrahedra)
    for (const int v : t)
      ASSERT_TRUE(v >= 0 && std::size_t(v) < mesh.points.size());
  for (const std::array<int, 2>& e : mesh.feature_edges)
    for (const int v : e)
      ASSERT_TRUE(v >= 0 && std::size_t(v) < mesh.points.size());
}

TEST_F(Read_tetrahedral_mesh, all_formats_give_the_same_mesh)
{
  for (const double scale : {1.0, 1e8 / 3, 1e-8 / 3}) {
    const Tetrahedral_mesh mesh = cube_of_tetrahedra(2, scale);
    for (const auto& [name, text] : all_files(mesh)) {
      const Tetrahedral_mesh copy = read_tetrahedral_mesh(write(name, text));
      EXPECT_EQ(copy.points, mesh.points) << name;
      EXPECT_EQ(as_set(copy.tetrahedra), as_set(mesh.tetrahedra)) << name;
      EXPECT_EQ(copy.tetrahedra.size(), mesh.tetrahedra.size()) << name;
      EXPECT_EQ(copy.feature_edges.size(), mesh.feature_edges.size()) << name;
      EXPECT_EQ(as_set(copy.feature_edges), as_set(mesh.feature_edges)) << name;
      for (const std::array<int, 4>& t : copy.tetrahedra)
        EXPECT_GT(volume(copy, t), 0) << name;
    }
  }
}

TEST_F(Read_tetrahedral_mesh, either_file_of_tetgen_is_enough)
{
  const Tetrahedral_mesh mesh = cube_of_tetrahedra(1);
  const Tetrahedral_mesh_texts texts(mesh);
  write("m.1.node", texts.node(1));
  write("m.1.ele", texts.ele(1));
  EXPECT_EQ(read_tetrahedral_mesh(path("m.1.node")).tetrahedra.size(), 6u);
  EXPECT_EQ(read_tetrahedral_mesh(path("m.1.ele")).feature_edges.size(), 0u); // there is no .edge file
  write("alone.node", texts.node(1));
  expect_error("alone.node", "", "alone.ele");
}

TEST_F(Read_tetrahedral_mesh, unused_vertices_stay_and_loose_feature_edges_go)
{
  Tetrahedral_mesh mesh = cube_of_tetrahedra(1);
  const std::size_t n = mesh.feature_edges.size();
  mesh.points.push_back({7, 7, 7});
  mesh.feature_edges.push_back({1, 6}); // a diagonal of the cube that no tetrahedron has
  mesh.feature_edges.push_back({0, 8});
  mesh.feature_edges.push_back({mesh.feature_edges[0][1], mesh.feature_edges[0][0]});
  const Tetrahedral_mesh_texts texts(mesh);
  for (const std::string& file : {write("a.mesh", texts.medit()), write("a.vtk", texts.vtk())}) {
    const Tetrahedral_mesh copy = read_tetrahedral_mesh(file);
    EXPECT_EQ(copy.points, mesh.points);
    EXPECT_EQ(copy.feature_edges.size(), n);
  }
  const Tetrahedral_mesh copy = read_tetrahedral_mesh(write("a.msh", texts.msh_2_2()));
  EXPECT_EQ(copy.points.size(), 8u);
  EXPECT_EQ(copy.feature_edges.size(), n);
}

TEST_F(Read_tetrahedral_mesh, elements_of_second_order_give_their_corners)
{
  const std::string points = "0 0 0\n0.5 0 0\n1 0 0\n0 0.5 0\n0.5 0.5 0\n0 1 0\n0 0 0.5\n0.5 0 0.5\n0 0.5 0.5\n0 0 1\n";
  const std::string vtk = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 10 double\n" +
                          points + "CELLS 2 15\n10 0 2 5 9 1 4 3 6 7 8\n3 0 2 1\nCELL_TYPES 2\n24 21\n";
  std::string node = "10 3 0 0\n";
  std::size_t begin = 0;
  for (int i = 0; i < 10; ++i) {
    const std::size_t end = points.find('\n', begin) + 1;
    node += std::to_string(i) + " " + points.substr(begin, end - begin);
    begin = end;
  }
  write("a.node", node);
  write("a.edge", "2 1\n0 0 2 1 5\n1 2 5 4 0\n");
  const std::vector<std::array<double, 3>> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const std::string& file : {write("a.vtk", vtk), write("a.ele", "1 10 0\n0 0 2 5 9 1 4 3 6 7 8\n")}) {
    const Tetrahedral_mesh mesh = read_tetrahedral_mesh(file);
    EXPECT_EQ(mesh.points, corners);
    EXPECT_EQ(mesh.tetrahedra, (std::vector<std::array<int, 4>>{{0, 1, 2, 3}}));
    EXPECT_EQ(mesh.feature_edges, (std::vector<std::array<int, 2>>{{0, 1}}));
  }
}

TEST_F(Read_tetrahedral_mesh, files_of_gmsh)
{
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
  gmsh::model::occ::addLine(gmsh::model::occ::addPoint(5, 5, 5), gmsh::model::occ::addPoint(6, 5, 5));
  gmsh::model::occ::synchronize();
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.3);
  std::vector<std::string> files;
  gmsh::model::mesh::generate(3);
  for (const int order : {1, 2}) {
    gmsh::model::mesh::setOrder(order);
    for (const double version : {2.2, 4.1})
      for (const int binary : {0, 1}) {
        gmsh::option::setNumber("Mesh.MshFileVersion", version);
        gmsh::option::setNumber("Mesh.Binary", binary);
        files.push_back(path("box" + std::to_string(files.size()) + ".msh"));
        gmsh::write(files.back());
      }
  }
  gmsh::finalize();
  const Tetrahedral_mesh first = read_tetrahedral_mesh(files.front());
  EXPECT_NEAR(volume(first), 1, 1e-12);
  double length = 0;
  for (const auto& e : first.feature_edges)
    length += (first.point(std::size_t(e[0])) - first.point(std::size_t(e[1]))).norm();
  EXPECT_NEAR(length, 12, 1e-12);
  std::vector<char> used(first.points.size(), 0);
  for (const auto& t : first.tetrahedra)
    for (const int v : t)
      used[std::size_t(v)] = 1;
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
  for (const std::string& file : files) {
    const Tetrahedral_mesh mesh = read_tetrahedral_mesh(file);
    ASSERT_EQ(mesh.points.size(), first.points.size()) << file;
    for (std::size_t v = 0; v < first.points.size(); ++v)
      EXPECT_LT((mesh.point(v) - first.point(v)).norm(), 1e-14) << file; // Gmsh writes 16 digits
    EXPECT_EQ(as_set(mesh.tetrahedra), as_set(first.tetrahedra)) << file;
    EXPECT_EQ(as_set(mesh.feature_edges), as_set(first.feature_edges)) << file;
  }
}

TEST_F(Read_tetrahedral_mesh, errors_name_the_place_and_the_reason)
{
  const std::string medit = "MeshVersionFormatted 1\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";
  const std::string node = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
  const std::string vtk = "# vtk DataFile Version 2.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n";
  const std::string ovm = "OVM ASCII\nVertices\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  expect_error("missing.mesh", "", "no such file");
  expect_error("a.xyz", "x", "unknown format");
  expect_error("a.meshb", "x", "save the mesh as text");
  expect_error("a.ovmb", "x", "save the mesh as text");
  expect_error("a.mesh", "solid\n", "MeshVersionFormatted");
  expect_error("a.mesh", "MeshVersionFormatted 1\nDimension 2\n", "the dimension is 2");
  expect_error("a.mesh", "MeshVersionFormatted 1\nDimension 3\nVertices\n2\n0 0 0 0\n1 0\n", "the file ends");
  expect_error("a.mesh", medit, "only 4 points");
  expect_error("a.mesh", medit + "Triangles\n1\n1 2 3 0\n", "only 1 polygons of a surface; a closed surface can be");
  expect_error("a.mesh", medit + "Hexahedra\n1\n1 2 3 4 1 2 3 4 0\n", "1 cells of kind Hexahedra");
  expect_error("a.mesh", medit + "Tetrahedra\n1\n1 2 3 5 0\n", "tetrahedron 1 uses vertex 5, which does not exist");
  expect_error("a.mesh", medit + "Tetrahedra\n1\n1 2 3 0 0\n", "line 11: vertex numbers begin at 1");
  expect_error("a.mesh", medit + "Tetrahedra\n1\n1 2 3 -2147483648 0\n", "begin at 1");
  expect_error("a.mesh", medit + "Tetrahedra\n1\n1 2 3 4294967297 0\n", "out of range");
  expect_error("a.mesh", medit + "Tetrahedra\n1\n1 2 3 4\nEnd\n", "reference number");
  expect_error("a.mesh", medit + "Tetrahedra\n1\n1 2 x 4 0\n", "line 11: 'x' is not a vertex number");
  expect_error("a.mesh", medit + "Tetrahedra\n900000000\n1 2 3 4 0\n", "more than the file has room for");
  expect_error("a.mesh", medit + "Tetrahedra\n-1\n", "negative");
  expect_error("a.mesh", medit + medit.substr(medit.find("Vertices")), "a second section Vertices");
  expect_error("a.mesh", medit + "17 18\n", "where the name of a section is expected");
  expect_error("a.mesh", "MeshVersionFormatted 1\nDimension 3\nVertices\n1\n0 nan 0 0\n", "not a finite number");
  expect_error("a.mesh", "MeshVersionFormatted 1\nDimension 3\nVertices\n1\n0 inf 0 0\n", "line 5");

  write("a.node", node);
  expect_error("a.ele", "1 4 0\n1 1 2 3 5\n", "point 5 does not exist; they are numbered from 1 to 4");
  expect_error("a.ele", "1 4 0\n1 0 2 3 4\n", "point 0 does not exist");
  expect_error("a.ele", "2 4 0\n1 1 2 3 4\n", "the file ends");
  expect_error("a.ele", "1 3 0\n1 1 2 3\n", "elements have 3 nodes");
  expect_error("a.ele", "1 4 0\n1 1 2 3\n", "a.ele, line 2");
  write("b.ele", "1 4 0\n1 1 2 3 4\n");
  expect_error("b.node", "4 2 0 0\n1 0 0\n2 1 0\n3 0 1\n4 1 1\n", "the dimension is 2");
  expect_error("b.node", "4 3 0 0\n1 0 0 0\n2 1 0 0\n4 0 1 0\n3 0 0 1\n", "line 4: point 4 is out of order");
  expect_error("b.node", "4 3 0 0\n5 0 0 0\n6 1 0 0\n7 0 1 0\n8 0 0 1\n", "out of order");
  expect_error("b.node", "4 3 0 0\n1 0 0 inf\n2 1 0 0\n3 0 1 0\n4 0 0 1\n", "not a finite number");

  expect_error("a.vtk", vtk + "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 4\nCELL_TYPES 1\n10\n",
               "cell 0 uses point 4, which does not exist");
  expect_error("a.vtk", vtk + "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n10\n",
               "a tetrahedron with 3 corners");
  expect_error("a.vtk",
               vtk + "POINTS 5 double\n0 0 0 1 0 0 0 1 0 0 0 1 1 1 1\nCELLS 1 6\n5 0 1 2 3 4\nCELL_TYPES 1\n14\n",
               "of VTK type pyramid");
  expect_error("a.vtk", vtk + "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 nan\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n",
               "point 3 has a coordinate that is not a finite number");
  expect_error("a.vtk", vtk + "POINTS 3 double\n0 0 0 1 0 0 0 1 0\nCELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n",
               "only 1 polygons");

  expect_error("a.ovm", "OVM BINARY\n", "binary files are not read");
  expect_error("a.ovm", ovm + "Faces\n", "section Edges is expected");
  expect_error("a.ovm", ovm + "Edges\n1\n0 4\n", "the number of a vertex is 4, and there are 4");
  const std::string edges = "Edges\n6\n0 1\n1 2\n2 0\n0 3\n1 3\n2 3\n";
  const std::string faces = "Faces\n4\n3 0 2 4\n3 6 9 1\n3 8 11 3\n3 10 7 5\n";
  expect_error("a.ovm", ovm + edges + "Faces\n1\n3 0 2 2\n", "do not follow each other");
  expect_error("a.ovm", ovm + edges + "Faces\n1\n4 0 2 4 6\n", "a face has 4 edges");
  expect_error("a.ovm", ovm + edges + faces + "Polyhedra\n1\n5 0 2 4 6 6\n", "a polyhedron has 5 faces");
  expect_error("a.ovm", ovm + edges + faces + "Polyhedra\n1\n4 0 2 4 4\n", "do not bound a tetrahedron");
  EXPECT_EQ(read_tetrahedral_mesh(write("a.ovm", ovm + edges + faces + "Polyhedra\n1\n4 0 2 4 6\n")).tetrahedra.size(),
            1u);

  expect_error("a.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4000000000 1 4\n$EndNodes\n$EndElements\n",
               "more than the file has room for");
  const std::string msh = Tetrahedral_mesh_texts(cube_of_tetrahedra(1)).msh_2_2();
  expect_error("a.msh", msh.substr(0, msh.size() / 2), "truncated");
}

/// A file that was cut off gives an error or, where only what does not matter is missing, a mesh; never a crash.
TEST_F(Read_tetrahedral_mesh, truncated_files)
{
  const Tetrahedral_mesh mesh = cube_of_tetrahedra(1);
  for (const auto& [name, text] : all_files(mesh)) {
    const bool is_msh = name == "a.msh"; // each takes a process
    std::size_t n_errors = 0, n = 0;
    for (std::size_t length = 0; length < text.size(); length += is_msh ? 29 : 1, ++n) {
      write(name, text.substr(0, length));
      try {
        expect_consistent(read_tetrahedral_mesh(path(name)));
      } catch (const Invalid_input_error& error) {
        EXPECT_NE(std::string(error.what()).find(m_folder.string()), std::string::npos) << error.what();
        ++n_errors;
      }
    }
    EXPECT_GT(n_errors, n / 2) << name;
  }
}

/// Each number in turn becomes a huge or a negative one.
TEST_F(Read_tetrahedral_mesh, damaged_numbers)
{
  const Tetrahedral_mesh mesh = cube_of_tetrahedra(1);
  for (const auto& [name, text] : all_files(mesh)) {
    int n = 0;
    for (std::size_t i = 1; i < text.size(); ++i) {
      if (!std::isdigit(static_cast<unsigned char>(text[i])) || !std::isspace(static_cast<unsigned char>(text[i - 1])))
        continue;
      const std::size_t end = std::min(text.find_first_of(" \n", i), text.size());
      for (const std::string number : {"2147483647", "-1", "99999999999999999999", "1e999"}) {
        if (name == "a.msh" && ++n % 9 != 0) // each takes a process
          continue;
        std::string damaged = text;
        write(name, damaged.replace(i, end - i, number));
        try {
          expect_consistent(read_tetrahedral_mesh(path(name)));
        } catch (const Invalid_input_error& error) {
          EXPECT_NE(std::string(error.what()).find(m_folder.string()), std::string::npos) << error.what();
        }
      }
    }
  }
}

/// Real files, with the numbers of vertices and tetrahedra that independent programs find.
TEST(Read_shared_tetrahedral_meshes, have_the_expected_counts)
{
  const std::filesystem::path folder = std::filesystem::path(QUADRILLE_SHARED_DATA) / "tet";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << folder << " is not there";
  struct Expected {
    std::string name;
    std::size_t n_vertices, n_tetrahedra, n_feature_edges;
  };
  for (const Expected& expected :
       {Expected{"algohex/cylinder.ovm", 2275, 9764, 0}, Expected{"arff/prism.node", 11902, 57321, 0},
        Expected{"arff/prism.ele", 11902, 57321, 0}, Expected{"arff/sphere_r0.10.mesh", 3501, 18135, 0},
        Expected{"gmds/cube_minus_sphere_14857.vtk", 2859, 14857, 0}, Expected{"gmds/cube_tet.vtk", 360, 1120, 72},
        Expected{"gmds/tet_in_box.mesh", 29, 61, 0}, Expected{"libigl/octopus-low.mesh", 452, 1140, 0},
        Expected{"mambo/B1_tet.vtk", 2658, 9872, 0}, Expected{"mambo/B41.vtk", 3887, 13841, 782},
        Expected{"mambo/B80.vtk", 749, 2832, 102}, Expected{"mint/cylinder_400.mesh", 578, 1888, 0},
        Expected{"mouette/p01.mesh", 584, 2568, 0}, Expected{"robustPolycube/NY_2.mesh", 847, 1986, 0}}) {
    const std::string file = (folder / expected.name).string();
    const Tetrahedral_mesh mesh = read_tetrahedral_mesh(file);
    EXPECT_EQ(mesh.points.size(), expected.n_vertices) << file;
    EXPECT_EQ(mesh.tetrahedra.size(), expected.n_tetrahedra) << file;
    EXPECT_EQ(mesh.feature_edges.size(), expected.n_feature_edges) << file;
    for (const std::array<int, 4>& t : mesh.tetrahedra)
      EXPECT_GE(volume(mesh, t), 0) << file;
  }
  EXPECT_THROW(read_tetrahedral_mesh((folder / "cinolib/ellipsoid.mesh").string()), Invalid_input_error);
}

} // namespace
