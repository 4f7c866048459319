// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "temporary_files.h"

#include <Quadrille/exceptions.h>
#include <Quadrille/read_size_field.h>
#include <Quadrille/read_surface_domain.h>

#include <gtest/gtest.h>

namespace {

using namespace Quadrille;

/// The grid of (n + 1)^2 vertices on [0, 1]^2.
Planar_domain unit_square(int n)
{
  Labelled_mesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.points.push_back({double(i) / n, double(j) / n, 0});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      mesh.polygons.push_back({a, a + 1, a + n + 2});
      mesh.polygons.push_back({a, a + n + 2, a + n + 1});
    }
  return make_planar_domain(mesh, "unit square");
}

class Size_field_files : public Temporary_files {
protected:
  Size_field read(const std::string& name, const std::string& text)
  {
    return read_size_field(write(name, text), m_domain);
  }
  std::vector<double> sizes(const std::string& name, const std::string& text)
  {
    const Size_field field = read(name, text);
    EXPECT_TRUE(field.metric.empty());
    return field.size;
  }
  void expect_failure(const std::string& name, const std::string& text, const std::string& word)
  {
    try {
      sizes(name, text);
      FAIL() << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }

  Planar_domain m_domain = unit_square(10);
};

TEST_F(Size_field_files, places_count_within_their_radius)
{
  const std::vector<double> field = sizes("a.csv", "# x, y, size, radius\n0.2, 0.2, 0.05, 0.15\n\n0.8 0.8\t0.1\n");
  for (const auto v : m_domain.mesh.vertices()) {
    const auto& p = m_domain.mesh.point(v);
    const double first = std::hypot(p.x() - 0.2, p.y() - 0.2), second = std::hypot(p.x() - 0.8, p.y() - 0.8);
    if (std::abs(first - 0.15) < 1e-6 || std::abs(second - 0.2) < 1e-6)
      continue; // rounding decides
    EXPECT_EQ(field[v.idx()], first < 0.15 ? 0.05 : second < 0.2 ? 0.1 : 0);
  }
}

TEST_F(Size_field_files, small_places_count_for_the_nearest_vertex)
{
  const std::vector<double> field = sizes("a.txt", "0.52 0.49 0.001");
  for (const auto v : m_domain.mesh.vertices()) {
    const auto& p = m_domain.mesh.point(v);
    EXPECT_EQ(field[v.idx()], std::hypot(p.x() - 0.5, p.y() - 0.5) < 1e-9 ? 0.001 : 0);
  }
}

TEST_F(Size_field_files, views_are_interpolated)
{
  // Linear over the lower right triangle of the square, nothing elsewhere.
  const std::vector<double> field = sizes("a.pos", "View \"size\" {\nST(0, 0, 0, 1, 0, 0, 1, 1, 0){1, 2, 4};\n};\n");
  for (const auto v : m_domain.mesh.vertices()) {
    const auto& p = m_domain.mesh.point(v);
    if (std::abs(p.x() - p.y()) < 1e-9)
      continue;
    EXPECT_NEAR(field[v.idx()], p.y() < p.x() ? 1 + p.x() + 2 * p.y() : 0, 1e-9);
  }
  // Node data on a mesh of their own.
  const std::vector<double> nodes = sizes("a.msh", R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
4
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
$EndNodes
$Elements
2
1 2 2 1 1 1 2 3
2 2 2 1 1 1 3 4
$EndElements
$NodeData
1
"size"
1
0
3
0
1
4
1 0.1
2 0.3
3 0.5
4 0.3
$EndNodeData
)");
  for (const auto v : m_domain.mesh.vertices()) {
    const auto& p = m_domain.mesh.point(v);
    EXPECT_NEAR(nodes[v.idx()], 0.1 + 0.2 * (p.x() + p.y()), 1e-9);
  }
}

TEST_F(Size_field_files, places_may_have_two_sizes)
{
  const Size_field field = read("a.txt", "0.2 0.2 0.1 0.02 30 0.15\n0.8 0.8 0.05 0.15\n");
  ASSERT_EQ(field.metric.size(), m_domain.mesh.number_of_vertices());
  const double c = std::cos(CGAL_PI / 6), s = std::sin(CGAL_PI / 6);
  const Eigen::Vector2d along(0.1 * c, 0.1 * s), across(-0.02 * s, 0.02 * c);
  int n_metrics = 0, n_sizes = 0;
  for (const auto v : m_domain.mesh.vertices()) {
    const Eigen::Matrix2d& metric = field.metric[v.idx()];
    n_sizes += field.size[v.idx()] > 0;
    if (metric.isZero(0))
      continue;
    ++n_metrics;
    EXPECT_EQ(field.size[v.idx()], 0);
    EXPECT_NEAR(along.dot(metric * along), 1, 1e-12);
    EXPECT_NEAR(across.dot(metric * across), 1, 1e-12);
    EXPECT_NEAR(along.dot(metric * across), 0, 1e-12);
  }
  EXPECT_EQ(n_metrics, 9);
  EXPECT_EQ(n_sizes, 9);
}

TEST_F(Size_field_files, views_of_tensors_are_metrics)
{
  const Size_field field =
      read("a.pos", "View \"metric\" {\nTT(0, 0, 0, 2, 0, 0, 0, 2, 0)"
                    "{100, 10, 0, 10, 25, 0, 0, 0, 1, 300, 10, 0, 10, 25, 0, 0, 0, 1, 100, 10, 0, 10, 25, 0, 0, 0, 1};"
                    "\n};\n");
  EXPECT_TRUE(field.size.empty());
  ASSERT_EQ(field.metric.size(), m_domain.mesh.number_of_vertices());
  for (const auto v : m_domain.mesh.vertices()) {
    Eigen::Matrix2d expected;
    expected << 100 + 100 * m_domain.mesh.point(v).x(), 10, 10, 25;
    EXPECT_LT((field.metric[v.idx()] - expected).norm(), 1e-9);
  }
}

TEST_F(Size_field_files, unusable_files_are_errors)
{
  expect_failure("a.txt", "0 0 1\n0 0\n", "line 2");
  expect_failure("b.txt", "0 0 -1\n", "positive");
  expect_failure("c.txt", "0 0 1 0\n", "positive");
  expect_failure("d.txt", "0 0 nan\n", "column 5");
  expect_failure("e.txt", "0 0 1x\n", "column 5");
  expect_failure("l.txt", "0 0 1 0 45\n", "positive");
  expect_failure("m.txt", "0 0 1 1 45 1 1\n", "7 numbers");
  expect_failure("n.pos",
                 "View \"metric\" {\nTT(0, 0, 0, 2, 0, 0, 0, 2, 0){1, 2, 0, 2, 1, 0, 0, 0, 1, 1, 2, 0, 2, 1, 0, 0, 0, "
                 "1, 1, 2, 0, 2, 1, 0, 0, 0, 1};\n};\n",
                 "positive definite");
  expect_failure("f.txt", "# nothing\n", "no size");
  expect_failure("g.txt", "", "empty");
  expect_failure("h.dat", "0 0 1\n", ".csv");
  expect_failure("i.pos", "View \"size\" {\nST(0, 0, 0, 1, 0, 0, 1, 1, 0){1, -2, 4};\n};\n", "positive");
  expect_failure("j.pos", "View \"size\" {\nST(5, 5, 0, 6, 5, 0, 6, 6, 0){1, 2, 4};\n};\n", "anywhere inside");
  expect_failure("k.pos", "Point(1) = {0, 0, 0};\n", "no node data");
  EXPECT_THROW(read_size_field(path("none.txt"), m_domain), Invalid_input_error);
}

/// Of the unit sphere, by latitude and longitude.
Surface_domain sphere(int n)
{
  Labelled_mesh mesh;
  const double pi = std::acos(-1.);
  mesh.points.push_back({0, 0, -1});
  for (int j = 1; j < n; ++j)
    for (int i = 0; i < 2 * n; ++i) {
      const double latitude = pi * (double(j) / n - 0.5), longitude = pi * i / n;
      mesh.points.push_back(
          {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude), std::sin(latitude)});
    }
  mesh.points.push_back({0, 0, 1});
  const auto at = [&](int j, int i) {
    return j == 0 ? 0 : j == n ? int(mesh.points.size()) - 1 : 1 + (j - 1) * 2 * n + i % (2 * n);
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < 2 * n; ++i) {
      if (j > 0)
        mesh.polygons.push_back({at(j, i), at(j, i + 1), at(j + 1, i)});
      if (j + 1 < n)
        mesh.polygons.push_back({at(j, i + 1), at(j + 1, i + 1), at(j + 1, i)});
    }
  return make_surface_domain(mesh, "sphere");
}

TEST_F(Size_field_files, places_on_surfaces_count_within_their_radius_in_space)
{
  const Surface_domain domain = sphere(16);
  const std::vector<double> size =
      read_size_field(write("a.txt", "0 0 1 0.05 0.5 # the north pole\n0 0 -1 0.1\n3, 0, 0, 0.2, 0.01\n"), domain);
  int n_nearest = 0;
  for (const auto v : domain.mesh.vertices()) {
    const auto& p = domain.mesh.point(v);
    const double north = std::hypot(p.x(), p.y(), p.z() - 1), south = std::hypot(p.x(), p.y(), p.z() + 1);
    if (size[v.idx()] == 0.2) {
      EXPECT_GT(p.x(), 0.999);
      ++n_nearest;
    } else if (std::abs(north - 0.5) > 1e-6 && std::abs(south - 0.2) > 1e-6) {
      EXPECT_EQ(size[v.idx()], north < 0.5 ? 0.05 : south < 0.2 ? 0.1 : 0);
    }
  }
  EXPECT_EQ(n_nearest, 1);
}

TEST_F(Size_field_files, places_on_surfaces_have_three_coordinates)
{
  const Surface_domain domain = sphere(4);
  for (const char* text : {"0 0 1", "0 0 1 0.1 0.2 30", "0 0 1 -0.1"})
    EXPECT_THROW(read_size_field(write("a.txt", text), domain), Invalid_input_error) << text;
}

TEST_F(Size_field_files, views_are_interpolated_on_surfaces)
{
  // The size x + 2 y + 3 z + 10 on the triangles of an octahedron.
  std::string view = "View \"sizes\" {\n";
  for (const double x : {-1., 1.})
    for (const double y : {-1., 1.})
      for (const double z : {-1., 1.})
        view += "ST(" + std::to_string(x) + ",0,0,0," + std::to_string(y) + ",0,0,0," + std::to_string(z) + "){" +
                std::to_string(x + 10) + "," + std::to_string(2 * y + 10) + "," + std::to_string(3 * z + 10) + "};\n";
  Labelled_mesh mesh;
  mesh.points = {{1, 0, 0}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0, 0, 1}};
  mesh.polygons = {{0, 1, 2}, {0, 2, 3}};
  Surface_domain_options options;
  options.split_chords = false; // the vertices are the points of the mesh
  const std::vector<double> size =
      read_size_field(write("a.pos", view + "};\n"), make_surface_domain(mesh, "part of an octahedron", options));
  ASSERT_EQ(size.size(), mesh.points.size());
  for (std::size_t v = 0; v < size.size(); ++v)
    EXPECT_NEAR(size[v], mesh.points[v][0] + 2 * mesh.points[v][1] + 3 * mesh.points[v][2] + 10, 1e-9);
}

} // namespace
