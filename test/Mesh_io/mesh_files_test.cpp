// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "temporary_files.h"
#include "vtu_file.h"

#include <Quadrille/read_mesh.h>
#include <Quadrille/read_planar_domain.h>
#include <Quadrille/write_file.h>
#include <Quadrille/write_mesh.h>

#include <algorithm>
#include <cmath>

using namespace Quadrille;

namespace {

/// 3 x 3 quads in two regions, four labelled sides.
Labelled_mesh block(double scale = 1)
{
  Labelled_mesh mesh;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      mesh.points.push_back({scale * (i + 0.1 * j), scale * (j / 3.0), 0});
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      mesh.polygons.push_back({4 * j + i, 4 * j + i + 1, 4 * j + i + 5, 4 * j + i + 4});
      mesh.polygon_region.push_back(j == 0 ? 0 : 1);
    }
  for (int i = 0; i < 3; ++i) {
    const std::array<std::array<int, 2>, 4> sides{
        {{i, i + 1}, {4 * i + 3, 4 * i + 7}, {15 - i, 14 - i}, {12 - 4 * i, 8 - 4 * i}}};
    for (int side = 0; side < 4; ++side) {
      mesh.lines.push_back(sides[std::size_t(side)]);
      mesh.line_curve.push_back(side);
    }
  }
  mesh.curves = {{11, {"inlet"}}, {12, {}}, {13, {"wall", "all"}}, {14, {"44"}}};
  mesh.regions = {{1, {"steel"}}, {2, {"air"}}};
  mesh.groups = {{1, 3, "inlet"}, {1, 4, "wall"}, {1, 5, "all"}, {1, 44, "44"}, {2, 1, "steel"}, {2, 2, "air"}};
  return mesh;
}

std::vector<std::string> names_of_line(const Labelled_mesh& mesh, int a, int b)
{
  for (std::size_t l = 0; l < mesh.lines.size(); ++l)
    if (std::minmax(mesh.lines[l][0], mesh.lines[l][1]) == std::minmax(a, b) && mesh.line_curve[l] >= 0)
      return mesh.curves[std::size_t(mesh.line_curve[l])].names;
  return {"no such line"};
}

using Mesh_files = Temporary_files;

TEST_F(Mesh_files, all_formats_give_back_points_and_polygons)
{
  for (const double scale : {1.0, 1e8, 1e-8})
    for (const auto& [name, format] :
         {std::pair("a.msh", Mesh_file_format::by_extension), std::pair("b.msh", Mesh_file_format::msh_2_2),
          std::pair("c.vtk", Mesh_file_format::by_extension), std::pair("d.obj", Mesh_file_format::by_extension)}) {
      const Labelled_mesh mesh = block(scale);
      write_mesh(path(name), mesh, format);
      const Labelled_mesh copy = read_mesh(path(name));
      EXPECT_EQ(copy.points, mesh.points) << name;
      EXPECT_EQ(copy.polygons, mesh.polygons) << name;
      EXPECT_EQ(copy.lines.size(), mesh.lines.size()) << name;
    }
}

TEST_F(Mesh_files, msh_keeps_entities_and_physical_groups)
{
  const Labelled_mesh mesh = block();
  write_mesh(path("a.msh"), mesh);
  const Labelled_mesh copy = read_mesh(path("a.msh"));
  EXPECT_EQ(names_of_line(copy, 0, 1), std::vector<std::string>{"inlet"});
  EXPECT_EQ(names_of_line(copy, 3, 7), std::vector<std::string>());
  EXPECT_EQ(names_of_line(copy, 15, 14), (std::vector<std::string>{"wall", "all"}));
  EXPECT_EQ(names_of_line(copy, 4, 0), std::vector<std::string>{"44"});
  for (std::size_t f = 0; f < mesh.polygons.size(); ++f)
    EXPECT_EQ(copy.regions[std::size_t(copy.polygon_region[f])].names,
              mesh.regions[std::size_t(mesh.polygon_region[f])].names);
  ASSERT_EQ(copy.groups.size(), mesh.groups.size());
  for (const Physical_group& group : mesh.groups)
    EXPECT_TRUE(std::any_of(copy.groups.begin(), copy.groups.end(), [&](const Physical_group& other) {
      return other.tag == group.tag && other.dimension == group.dimension && other.name == group.name;
    })) << group.name;
  for (const Entity_label& label : mesh.curves)
    EXPECT_TRUE(std::any_of(copy.curves.begin(), copy.curves.end(),
                            [&](const Entity_label& other) { return other.tag == label.tag; }));
}

TEST_F(Mesh_files, triangles_in_msh_become_a_domain_with_names)
{
  Labelled_mesh mesh = block();
  std::vector<std::vector<int>> triangles;
  std::vector<int> regions;
  for (std::size_t f = 0; f < mesh.polygons.size(); ++f) {
    const std::vector<int>& q = mesh.polygons[f];
    // One of the two regions clockwise, as files of Gmsh have it when a surface's normal points down.
    const bool turn = mesh.polygon_region[f] == 1;
    triangles.push_back(turn ? std::vector<int>{q[0], q[2], q[1]} : std::vector<int>{q[0], q[1], q[2]});
    triangles.push_back(turn ? std::vector<int>{q[0], q[3], q[2]} : std::vector<int>{q[0], q[2], q[3]});
    regions.insert(regions.end(), 2, mesh.polygon_region[f]);
  }
  mesh.polygons = triangles;
  mesh.polygon_region = regions;
  write_mesh(path("t.msh"), mesh);
  const Planar_domain domain = read_planar_domain(path("t.msh"));
  EXPECT_EQ(domain.mesh.number_of_faces(), 18u + 4u); // two corners are cut off by a chord, which is split
  EXPECT_EQ(domain.regions.size(), 2u);
  EXPECT_EQ(domain.curves.size(), 4u);
  EXPECT_EQ(domain.curves[0].names, std::vector<std::string>{"inlet"});
}

TEST_F(Mesh_files, borders_without_labels_are_cut_at_corners)
{
  const Planar_domain square = read_planar_domain(write("s.off", "OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.5 0\n"
                                                                 "3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n"));
  EXPECT_EQ(square.curves.size(), 4u);
  std::string disk = "OFF\n17 16 0\n0 0 0\n", faces;
  for (int i = 0; i < 16; ++i) {
    disk += std::to_string(std::cos(i * 0.39269908)) + " " + std::to_string(std::sin(i * 0.39269908)) + " 0\n";
    faces += "3 0 " + std::to_string(i + 1) + " " + std::to_string((i + 1) % 16 + 1) + "\n";
  }
  const Planar_domain round = read_planar_domain(write("d.off", disk + faces));
  ASSERT_EQ(round.curves.size(), 1u);
  EXPECT_TRUE(round.curves[0].closed);
  // A line element marks an edge inside.
  const Planar_domain marked =
      read_planar_domain(write("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nl 1 3\nf 1 2 3\nf 1 3 4\n"));
  EXPECT_EQ(marked.curves.size(), 5u);
}

TEST_F(Mesh_files, vtk_binary_and_version_5)
{
  write("v5.vtk", "# vtk DataFile Version 5.1\nx\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\n"
                  "POLYGONS 3 6\nOFFSETS vtktypeint64\n0 3 6\nCONNECTIVITY vtktypeint64\n0 1 2 0 2 3\n");
  EXPECT_EQ(read_mesh(path("v5.vtk")).polygons, (std::vector<std::vector<int>>{{0, 1, 2}, {0, 2, 3}}));
  std::string binary = "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 float\n";
  const unsigned char one[4] = {0x3f, 0x80, 0, 0}, zero[4] = {0, 0, 0, 0};
  for (const int x : {0, 0, 0, 1, 0, 0, 0, 1, 0})
    binary.append(reinterpret_cast<const char*>(x ? one : zero), 4);
  binary += "\nCELLS 1 4\n";
  for (const int i : {3, 0, 1, 2})
    binary += std::string(3, '\0') + std::string(1, static_cast<char>(i));
  binary += "\nCELL_TYPES 1\n" + std::string(3, '\0') + '\x05' + "\n";
  const Labelled_mesh mesh = read_mesh(write("b.vtk", binary));
  EXPECT_EQ(mesh.polygons, (std::vector<std::vector<int>>{{0, 1, 2}}));
  EXPECT_EQ(mesh.points[1], (std::array<double, 3>{1, 0, 0}));
}

TEST_F(Mesh_files, nothing_is_left_when_writing_fails)
{
  EXPECT_THROW(write_mesh(path("no/such/folder/a.msh"), block()), Output_error);
  EXPECT_THROW(write_mesh(path("a.xyz"), block()), Invalid_argument_error);
  std::filesystem::create_directory(path("a.msh"));
  EXPECT_THROW(write_mesh(path("a.msh"), block()), Output_error);
  Labelled_mesh pentagon = block();
  pentagon.polygons[0].push_back(5);
  EXPECT_THROW(write_mesh(path("p.msh"), pentagon), Invalid_argument_error);
  EXPECT_EQ(number_of_files(), 1u);
  write_file(path("old"), "one");
  write_file(path("old"), "two");
  EXPECT_EQ(content(path("old")), "two");
  EXPECT_EQ(number_of_files(), 2u);
}

TEST_F(Mesh_files, field_and_map_files_hold_every_face_and_corner)
{
  Planar_domain_options options;
  options.split_chords = false;
  const Planar_domain domain =
      read_planar_domain(write("s.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"), options);
  const std::vector<std::array<double, 2>> u(2, {3, 4}), v(2, {-8, 6});
  write_frame_field(path("f.vtu"), domain, u, v, {4, 3, 4, 5});
  const Vtu_file field(content(path("f.vtu")));
  EXPECT_EQ(field.attribute("<Piece", "NumberOfPoints"), "4");
  EXPECT_EQ(field.attribute("<Piece", "NumberOfCells"), "8"); // 2 triangles, 4 edges on curves, 2 singular vertices
  EXPECT_EQ(field.array<std::int32_t>("dimension"), (std::vector<std::int32_t>{2, 2, 1, 1, 1, 1, 0, 0}));
  std::vector<double> expected = {3, 4, 0, 3, 4, 0};
  expected.resize(24, 0);
  EXPECT_EQ(field.array<double>("u"), expected);
  EXPECT_EQ(field.array<double>("size_u"), (std::vector<double>{5, 5, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(field.array<double>("size_v"), (std::vector<double>{10, 10, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(field.array<std::int32_t>("valence"), (std::vector<std::int32_t>{4, 3, 4, 5}));
  EXPECT_EQ(field.array<std::int32_t>("singular"), (std::vector<std::int32_t>{0, 1, 0, 1}));
  EXPECT_THROW(write_frame_field(path("f.txt"), domain, u, v, {4, 4, 4, 4}), Invalid_argument_error);
  EXPECT_THROW(write_frame_field(path("f.vtu"), domain, u, v, {4, 4, 4}), Invalid_argument_error);

  std::vector<Planar_domain::Point_2> uv(domain.mesh.number_of_halfedges());
  for (const auto h : domain.mesh.halfedges())
    uv[h.idx()] = Planar_domain::Point_2(10 * domain.mesh.point(domain.mesh.target(h)).x(), 0);
  write_corner_map(path("m.obj"), domain, uv);
  const std::string map = content(path("m.obj"));
  EXPECT_EQ(std::count(map.begin(), map.end(), '\n'), 4 + 6 + 2);
  EXPECT_EQ(read_mesh(path("m.obj")).polygons.size(), 2u);
}

} // namespace
