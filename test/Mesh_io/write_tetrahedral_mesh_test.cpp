// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "temporary_files.h"
#include "tetrahedral_test_meshes.h"
#include "vtu_file.h"

#include <Quadrille/read_tetrahedral_mesh.h>
#include <Quadrille/write_file.h>
#include <Quadrille/write_tetrahedral_mesh.h>
#include <Quadrille/write_vtu.h>

#include <sstream>

using namespace Quadrille;

namespace {

using Write_tetrahedral_mesh = Temporary_files;
using Write_vtu = Temporary_files;
using Write_frames = Temporary_files;

TEST_F(Write_tetrahedral_mesh, reading_gives_the_same)
{
  for (const double scale : {1.0, 1e8 / 3, 1e-8 / 3})
    for (const bool has_features : {true, false}) {
      Tetrahedral_mesh mesh = cube_of_tetrahedra(2, scale);
      if (!has_features)
        mesh.feature_edges.clear();
      for (const char* name : {"a.mesh", "a.vtk", "a.msh"}) {
        write_tetrahedral_mesh(path(name), mesh);
        const Tetrahedral_mesh copy = read_tetrahedral_mesh(path(name));
        EXPECT_EQ(copy.points, mesh.points) << name;
        EXPECT_EQ(copy.tetrahedra, mesh.tetrahedra) << name;
        EXPECT_EQ(as_set(copy.feature_edges), as_set(mesh.feature_edges)) << name;
      }
    }
}

TEST_F(Write_tetrahedral_mesh, vtu_has_lines_and_tetrahedra)
{
  const Tetrahedral_mesh mesh = cube_of_tetrahedra(1);
  write_tetrahedral_mesh(path("a.vtu"), mesh);
  const Vtu_file file(content(path("a.vtu")));
  EXPECT_EQ(file.attribute("<Piece", "NumberOfPoints"), "8");
  EXPECT_EQ(file.attribute("<Piece", "NumberOfCells"), "18");
  std::vector<std::uint8_t> types(12, 3);
  types.resize(18, 10);
  EXPECT_EQ(file.array<std::uint8_t>("types"), types);
  const std::vector<std::int64_t> ends = file.array<std::int64_t>("offsets");
  EXPECT_EQ(ends[0], 2);
  EXPECT_EQ(ends[12], 28);
  EXPECT_EQ(ends[17], 48);
}

TEST_F(Write_tetrahedral_mesh, errors_leave_nothing)
{
  const Tetrahedral_mesh mesh = cube_of_tetrahedra(1);
  EXPECT_THROW(write_tetrahedral_mesh(path("a.xyz"), mesh), Invalid_argument_error);
  EXPECT_THROW(write_tetrahedral_mesh(path("no/such/folder.mesh"), mesh), Output_error);
  EXPECT_THROW(write_file_by(path("a.mesh"),
                             [](std::ostream& file) {
                               file << "half";
                               throw Error("on the way");
                             }),
               Error);
  EXPECT_EQ(number_of_files(), 0u);
}

TEST_F(Write_vtu, all_numbers_arrive)
{
  const Tetrahedral_mesh mesh = cube_of_tetrahedra(2, 0.1);
  const std::size_t n_points = mesh.points.size(), n_cells = mesh.tetrahedra.size();
  std::vector<double> doubles;
  std::vector<float> floats;
  std::vector<int> integers;
  for (std::size_t i = 0; i < 3 * n_points; ++i)
    doubles.push_back(std::sqrt(double(i)));
  for (std::size_t i = 0; i < 9 * n_cells; ++i)
    floats.push_back(float(i) / 7);
  for (std::size_t i = 0; i < n_cells; ++i)
    integers.push_back(-int(i));
  write_vtu(path("a.vtu"), mesh, {{{"d", 3, doubles}}, {{"a < b & \"c\"", 9, floats}, {"i", 1, integers}}});
  const Vtu_file file(content(path("a.vtu")));
  std::vector<double> coordinates;
  for (const auto& p : mesh.points)
    coordinates.insert(coordinates.end(), p.begin(), p.end());
  std::vector<int> corners;
  std::vector<std::int64_t> ends;
  for (const auto& t : mesh.tetrahedra) {
    corners.insert(corners.end(), t.begin(), t.end());
    ends.push_back(std::int64_t(corners.size()));
  }
  EXPECT_EQ(file.array<double>("Points"), coordinates);
  EXPECT_EQ(file.array<int>("connectivity"), corners);
  EXPECT_EQ(file.array<std::int64_t>("offsets"), ends);
  EXPECT_EQ(file.array<std::uint8_t>("types"), std::vector<std::uint8_t>(n_cells, 10));
  EXPECT_EQ(file.array<double>("d"), doubles);
  EXPECT_EQ(file.array<float>("a &lt; b &amp; &quot;c&quot;"), floats);
  EXPECT_EQ(file.array<int>("i"), integers);
  EXPECT_EQ(file.attribute(" Name=\"d\"", "NumberOfComponents"), "3");
  EXPECT_EQ(file.attribute("<VTKFile", "header_type"), "UInt64");
  EXPECT_NE(content(path("a.vtu")).find("<DataArray type=\"Float32\" Name=\"a "), std::string::npos);
  EXPECT_NE(content(path("a.vtu")).find("<DataArray type=\"Int32\" Name=\"i\""), std::string::npos);
}

TEST_F(Write_vtu, polylines_of_all_lengths)
{
  const std::vector<std::array<double, 3>> points(7, {1, 2, 3});
  write_vtu(path("a.vtu"), points, {{6}, {0, 1}, {2, 3, 4, 5}}, {{}, {{"kind", 1, std::vector<int>{4, 5, 6}}}});
  const Vtu_file file(content(path("a.vtu")));
  EXPECT_EQ(file.array<int>("connectivity"), (std::vector<int>{6, 0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(file.array<std::int64_t>("offsets"), (std::vector<std::int64_t>{1, 3, 7}));
  EXPECT_EQ(file.array<std::uint8_t>("types"), (std::vector<std::uint8_t>{1, 3, 4}));
  EXPECT_EQ(file.array<int>("kind"), (std::vector<int>{4, 5, 6}));
  write_vtu(path("empty.vtu"), {}, std::vector<std::vector<int>>{});
  EXPECT_EQ(Vtu_file(content(path("empty.vtu"))).attribute("<Piece", "NumberOfCells"), "0");
}

TEST_F(Write_vtu, wrong_arrays_are_refused)
{
  const Tetrahedral_mesh mesh = cube_of_tetrahedra(1);
  const std::vector<double> eight(8, 0), six(6, 0);
  EXPECT_THROW(write_vtu(path("a.vtu"), mesh, {{{"x", 1, six}}, {}}), Invalid_argument_error);
  EXPECT_THROW(write_vtu(path("a.vtu"), mesh, {{}, {{"x", 1, eight}}}), Invalid_argument_error);
  EXPECT_THROW(write_vtu(path("a.vtu"), mesh, {{{"x", 2, eight}}, {}}), Invalid_argument_error);
  EXPECT_THROW(write_vtu(path("a.vtu"), mesh, {{{"x", 0, std::vector<int>()}}, {}}), Invalid_argument_error);
  EXPECT_THROW(write_vtu(path("a.vtu"), mesh, {{{"x", 1, eight}, {"x", 1, eight}}, {}}), Invalid_argument_error);
  EXPECT_THROW(write_vtu(path("a.vtk"), mesh), Invalid_argument_error);
  EXPECT_EQ(number_of_files(), 0u);
}

/// As the other programs read them.
TEST_F(Write_frames, vectors_follow_each_other)
{
  const Tetrahedral_mesh mesh = cube_of_tetrahedra(1);
  std::vector<Eigen::Matrix3d> frames;
  for (int t = 0; t < 6; ++t) {
    frames.emplace_back();
    for (int i = 0; i < 9; ++i)
      frames.back()(i % 3, i / 3) = std::sin(9.0 * t + i) * 1e-3;
  }
  write_frames(path("a.fra"), mesh, frames);
  write_frames(path("a.ff3"), mesh, frames);
  std::istringstream fra(content(path("a.fra"))), ff3(content(path("a.ff3")));
  std::string word;
  int version = 0, n_frames = 0, n_vectors = 0, type = 0, n_rows = 0, n_columns = 0;
  fra >> word >> version >> n_frames >> n_vectors >> type;
  EXPECT_EQ(word, "FRA");
  EXPECT_EQ(version, 1);
  EXPECT_EQ(n_frames, 6);
  EXPECT_EQ(n_vectors, 3);
  ff3 >> n_columns >> n_rows;
  EXPECT_EQ(n_columns, 9);
  EXPECT_EQ(n_rows, 6);
  std::getline(ff3, word);
  for (const Eigen::Matrix3d& frame : frames) {
    ASSERT_TRUE(std::getline(ff3, word));
    std::istringstream line(word);
    for (int vector = 0; vector < 3; ++vector)
      for (int k = 0; k < 3; ++k) {
        double in_fra = 0, in_ff3 = 0;
        fra >> in_fra;
        line >> in_ff3;
        EXPECT_EQ(in_fra, frame(k, vector));
        EXPECT_EQ(in_ff3, frame(k, vector));
      }
  }
  EXPECT_FALSE(std::getline(ff3, word));
  EXPECT_THROW(write_frames(path("a.txt"), mesh, frames), Invalid_argument_error);
  frames.pop_back();
  EXPECT_THROW(write_frames(path("a.fra"), mesh, frames), Invalid_argument_error);
}

} // namespace
