// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "temporary_files.h"
#include "tetrahedral_mesh_texts.h"
#include "tetrahedral_test_meshes.h"

#include <Quadrille/exceptions.h>
#include <Quadrille/read_metric.h>
#include <Quadrille/read_tetrahedral_mesh.h>

using namespace Quadrille;

namespace {

const std::string sol = "MeshVersionFormatted 2\n# comment\nDimension\n3\n\nSolAtVertices\n";

Eigen::Matrix3d sample()
{
  Eigen::Matrix3d metric;
  metric << 11, 12, 13, 12, 22, 23, 13, 23, 33;
  return metric;
}

class Read_metric : public Temporary_files {
protected:
  void expect_error(const std::string& name, const std::string& text, std::size_t n, const std::string& reason) const
  {
    const std::string file = text.empty() ? path(name) : write(name, text);
    try {
      read_metric(file, n);
      ADD_FAILURE() << text << " was read";
    } catch (const Invalid_input_error& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(file), std::string::npos) << message;
      EXPECT_NE(message.find(reason), std::string::npos) << message;
    }
  }

  /// A mesh as Gmsh writes it, with nodes that no tetrahedron has, and data at all nodes, `entries` of the tag of each.
  template <class Entries> std::string msh(int n_components, const Entries& entries) const
  {
    Tetrahedral_mesh mesh = cube_of_tetrahedra(1);
    mesh.points.insert(mesh.points.begin(), {9, 9, 9});
    for (auto& t : mesh.tetrahedra)
      for (int& v : t)
        ++v;
    mesh.feature_edges.clear();
    std::string text = Tetrahedral_mesh_texts(mesh).msh_2_2();
    text += "$NodeData\n1\n\"size\"\n1\n0.0\n3\n0\n" + std::to_string(n_components) + "\n9\n";
    for (int tag = 9; tag >= 1; --tag)
      text += std::to_string(tag) + " " + entries(tag) + "\n";
    return text + "$EndNodeData\n";
  }
};

TEST_F(Read_metric, symmetric_matrices)
{
  for (const double factor : {1.0, 1e16, 1e-16}) {
    const Eigen::Matrix3d expected = factor * sample();
    std::ostringstream medit, text;
    medit.precision(17);
    text.precision(17);
    medit << sol << "2\n1 3\n";
    for (int v = 0; v < 2; ++v) {
      for (const auto& [i, j] : {std::pair(0, 0), {0, 1}, {1, 1}, {0, 2}, {1, 2}, {2, 2}})
        medit << expected(i, j) << " ";
      medit << "\n";
      for (const auto& [i, j] : {std::pair(0, 0), {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}})
        text << expected(i, j) << " ";
      text << " # of a vertex\n\n";
    }
    medit << "End\n";
    for (const std::string& file : {write("a.sol", medit.str()), write("a.txt", text.str())}) {
      const std::vector<Eigen::Matrix3d> metrics = read_metric(file, 2);
      ASSERT_EQ(metrics.size(), 2u);
      EXPECT_EQ(metrics[0], expected) << file;
      EXPECT_EQ(metrics[1], expected) << file;
    }
  }
}

TEST_F(Read_metric, sizes)
{
  for (const std::string& file :
       {write("a.sol", sol + "3\n1 1\n0.5\n2\n4\nEnd\n"), write("a.txt", "# sizes\n0.5\n2\n\n4 # the last\n")}) {
    const std::vector<Eigen::Matrix3d> metrics = read_metric(file, 3);
    ASSERT_EQ(metrics.size(), 3u);
    EXPECT_EQ(metrics[0], Eigen::Matrix3d(4 * Eigen::Matrix3d::Identity()));
    EXPECT_EQ(metrics[2], Eigen::Matrix3d(0.0625 * Eigen::Matrix3d::Identity()));
  }
  // A size and a matrix may stand for different vertices.
  const std::vector<Eigen::Matrix3d> mixed = read_metric(write("b.txt", "1\n11 12 13 22 23 33\n"), 2);
  EXPECT_EQ(mixed[1], sample());
}

TEST_F(Read_metric, node_data_follow_the_vertices)
{
  const std::string sizes = write("a.msh", msh(1, [](int tag) { return std::to_string(tag); }));
  const std::size_t n = read_tetrahedral_mesh(sizes).points.size();
  ASSERT_EQ(n, 8u);
  const std::vector<Eigen::Matrix3d> metrics = read_metric(sizes, n);
  for (std::size_t v = 0; v < n; ++v) // node 1 is no vertex
    EXPECT_DOUBLE_EQ(metrics[v](1, 1), 1 / double((v + 2) * (v + 2)));
  const std::string tensors = write("b.msh", msh(9, [](int tag) {
                                      const std::string x = std::to_string(tag);
                                      return x + "1 12 13 12 " + x + "2 23 13 23 " + x + "3";
                                    }));
  const std::vector<Eigen::Matrix3d> matrices = read_metric(tensors, n);
  for (std::size_t v = 0; v < n; ++v)
    EXPECT_EQ(matrices[v](0, 0), 10 * double(v + 2) + 1);
  EXPECT_EQ(matrices[0](0, 2), 13);
  EXPECT_EQ(matrices[0](2, 1), 23);
}

TEST_F(Read_metric, errors_name_the_place)
{
  expect_error("missing.sol", "", 1, "no such file");
  EXPECT_THROW(read_metric(path("a.xyz"), 1), Invalid_argument_error);
  expect_error("a.sol", sol + "3\n1 1\n1\n1\n1\nEnd\n", 4, "for 3 vertices, and the mesh has 4");
  expect_error("a.sol", sol + "3\n1 2\n1\n1\n1\nEnd\n", 3, "line 8: the solution is of type 2");
  expect_error("a.sol", sol + "3\n2 1 1\n1 1 1\n1 1 1\n", 3, "one solution per vertex");
  expect_error("a.sol", sol + "3\n1 1\n1\n1\n", 3, "the file ends");
  expect_error("a.sol", sol + "3\n1 1\n1\n0\n1\nEnd\n", 3, "line 10: the size is 0;");
  expect_error("a.sol", sol + "3\n1 1\n1\n-2.5\n1\nEnd\n", 3, "the size is -2.5;");
  expect_error("a.sol", sol + "3\n1 1\n1\n1e-200\n1\nEnd\n", 3, "the size is 1e-200;");
  expect_error("a.sol", sol + "3\n1 1\n1\nnan\n1\nEnd\n", 3, "line 10: 'nan' is not a finite number");
  expect_error("a.sol", sol + "9000000000\n1 1\n1\n", 3, "more than the file has room for");
  expect_error("a.sol", "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n1\n1 1\n1\n", 1, "dimension is not 3");
  expect_error("a.sol", "MeshVersionFormatted 2\nDimension 3\n", 1, "no section SolAtVertices");
  expect_error("a.sol", "1 2 3\n", 1, "MeshVersionFormatted");
  expect_error("a.txt", "1\n1 2\n", 2, "line 2: a line has a size, or the entries");
  expect_error("a.txt", "1\n0\n", 2, "line 2: the size is 0");
  expect_error("a.txt", "1\n1 0 0 inf 0 1\n", 2, "line 2: 'inf' is not a finite number");
  expect_error("a.txt", "1\nx\n", 2, "line 2: 'x' is not a size");
  expect_error("a.txt", "1\n1\n1\n", 2, "for 3 vertices, and the mesh has 2");
  expect_error("a.msh", msh(1, [](int tag) { return std::to_string(tag - 5); }), 8, "node 2: the size is -3;");
  expect_error("a.msh", msh(3, [](int) { return std::string("1 0 0"); }), 8, "have 3 components");
  expect_error("a.msh", msh(9, [](int) { return std::string("1 2 0 0 1 0 0 0 1"); }), 8, "node 2: the metric is not");
  expect_error("a.msh", Tetrahedral_mesh_texts(cube_of_tetrahedra(1)).msh_2_2(), 8, "no node data");
}

TEST_F(Read_metric, truncated_files)
{
  const std::string text = sol + "3\n1 3\n1 0 1 0 0 1\n2 0 2 0 0 2\n3 0 3 0 0 3\nEnd\n";
  const std::string msh_text = msh(1, [](int tag) { return std::to_string(tag); });
  for (const auto& [name, whole, step, n] :
       {std::tuple("a.sol", text, 1, 3), std::tuple("a.txt", std::string("1 0 0 1 0 1\n2\n3\n"), 1, 3),
        std::tuple("a.msh", msh_text, 31, 8)})
    for (std::size_t length = 0; length < whole.size(); length += std::size_t(step)) {
      write(name, whole.substr(0, length));
      try {
        EXPECT_EQ(read_metric(path(name), std::size_t(n)).size(), std::size_t(n));
      } catch (const Invalid_input_error& error) {
        EXPECT_NE(std::string(error.what()).find(path(name)), std::string::npos) << error.what();
      }
    }
}

} // namespace
