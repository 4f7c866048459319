// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Indexed_tetrahedra.h>
#include <Quadrille/check_tetrahedral_mesh.h>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/point_generators_3.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <iterator>
#include <set>

using namespace Quadrille;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

/// The corners of the unit cube, and others inside it.
std::vector<Point> points_of_cube(int inside)
{
  std::vector<Point> points;
  for (int i = 0; i < 8; ++i)
    points.emplace_back(i % 2, i / 2 % 2, i / 4);
  CGAL::Random random(1);
  CGAL::Random_points_in_cube_3<Point> generator(0.5, random);
  for (int i = 0; i < inside; ++i, ++generator)
    points.push_back(*generator + Kernel::Vector_3(0.5, 0.5, 0.5));
  return points;
}

template <class Mesh> double volume_of(const Mesh& mesh)
{
  double sum = 0;
  for (std::size_t t = 0; t < mesh.number_of_tetrahedra(); ++t) {
    Eigen::Matrix3d edges;
    for (int i = 0; i < 3; ++i)
      edges.col(i) = mesh.point(std::size_t(mesh.tetrahedron(t)[std::size_t(i + 1)])) -
                     mesh.point(std::size_t(mesh.tetrahedron(t)[0]));
    EXPECT_GT(edges.determinant(), 0);
    sum += edges.determinant() / 6;
  }
  return sum;
}

/// Numbers and handles lead to the same corners and coordinates; nothing is there twice.
template <class Mesh, class Coordinates> void expect_consistent(const Mesh& mesh, const Coordinates& coordinates)
{
  std::set<const void*> cells, vertices;
  std::set<int> used;
  for (std::size_t t = 0; t < mesh.number_of_tetrahedra(); ++t) {
    cells.insert(&*mesh.cell_handle(t));
    for (std::size_t i = 0; i < 4; ++i) {
      const int v = mesh.tetrahedron(t)[i];
      used.insert(v);
      EXPECT_TRUE(mesh.cell_handle(t)->vertex(int(i)) == mesh.vertex_handle(std::size_t(v)));
    }
  }
  for (std::size_t v = 0; v < mesh.number_of_vertices(); ++v) {
    vertices.insert(&*mesh.vertex_handle(v));
    EXPECT_EQ(mesh.point(v), coordinates(mesh.vertex_handle(v)->point()));
  }
  EXPECT_EQ(cells.size(), mesh.number_of_tetrahedra());
  EXPECT_EQ(vertices.size(), mesh.number_of_vertices());
  EXPECT_EQ(used.size(), mesh.number_of_vertices());
}

const auto coordinates_of = [](const auto& p) {
  return Eigen::Vector3d(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
};

} // namespace

TEST(Indexed_tetrahedra_test, delaunay_triangulation)
{
  const std::vector<Point> points = points_of_cube(300);
  const CGAL::Delaunay_triangulation_3<Kernel> triangulation(points.begin(), points.end());
  const Indexed_tetrahedra mesh(triangulation);
  EXPECT_EQ(mesh.number_of_vertices(), triangulation.number_of_vertices());
  EXPECT_EQ(mesh.number_of_tetrahedra(), triangulation.number_of_finite_cells());
  EXPECT_NEAR(volume_of(mesh), 1, 1e-12);
  expect_consistent(mesh, coordinates_of);
  EXPECT_NO_THROW(check_tetrahedral_mesh(mesh));
}

TEST(Indexed_tetrahedra_test, part_of_a_triangulation)
{
  const std::vector<Point> points = points_of_cube(300);
  const CGAL::Delaunay_triangulation_3<Kernel> triangulation(points.begin(), points.end());
  using Cell = CGAL::Delaunay_triangulation_3<Kernel>::Cell_handle;
  // Those at a vertex inside, a ball.
  const auto center = triangulation.nearest_vertex(Point(0.5, 0.5, 0.5));
  std::vector<Cell> cells;
  triangulation.finite_incident_cells(center, std::back_inserter(cells));
  std::vector<CGAL::Delaunay_triangulation_3<Kernel>::Vertex_handle> neighbours;
  triangulation.finite_adjacent_vertices(center, std::back_inserter(neighbours));
  const Indexed_tetrahedra mesh(triangulation, cells);
  EXPECT_EQ(mesh.number_of_tetrahedra(), cells.size());
  EXPECT_EQ(mesh.number_of_vertices(), neighbours.size() + 1);
  for (std::size_t t = 0; t < cells.size(); ++t)
    EXPECT_TRUE(mesh.cell_handle(t) == cells[t]);
  expect_consistent(mesh, coordinates_of);
  EXPECT_NO_THROW(check_tetrahedral_mesh(mesh));
}

TEST(Indexed_tetrahedra_test, weighted_points)
{
  CGAL::Regular_triangulation_3<Kernel> triangulation;
  double weight = 0;
  for (const Point& p : points_of_cube(100))
    triangulation.insert({p, weight += 1e-4});
  const Indexed_tetrahedra mesh(triangulation);
  EXPECT_EQ(mesh.number_of_tetrahedra(), triangulation.number_of_finite_cells());
  EXPECT_NEAR(volume_of(mesh), 1, 1e-12);
  expect_consistent(mesh, coordinates_of);
}

TEST(Indexed_tetrahedra_test, mesh_complex)
{
  using Triangulation = CGAL::Mesh_triangulation_3<CGAL::Labeled_mesh_domain_3<Kernel>>::type;
  CGAL::Mesh_complex_3_in_triangulation_3<Triangulation> complex;
  for (int i = 0; i < 27; ++i)
    complex.triangulation().insert(Triangulation::Weighted_point(Point(i % 3, i / 3 % 3, i / 9)));
  // Two subdomains, each a quarter of the cube that the planes x = 1 and y = 1 divide; they have a side in common.
  for (const Triangulation::Cell_handle cell : complex.triangulation().finite_cell_handles()) {
    double x = 0, y = 0;
    for (int i = 0; i < 4; ++i) {
      x += complex.triangulation().point(cell, i).x() / 4;
      y += complex.triangulation().point(cell, i).y() / 4;
    }
    if (x < 1)
      complex.add_to_complex(cell, y < 1 ? 1 : 2);
  }
  const auto mesh = Indexed_tetrahedra<Triangulation>::of_complex(complex);
  EXPECT_EQ(mesh.number_of_tetrahedra(), complex.number_of_cells_in_complex());
  EXPECT_EQ(mesh.number_of_vertices(), 18u);
  EXPECT_NEAR(volume_of(mesh), 4, 1e-12);
  expect_consistent(mesh, coordinates_of);
  for (std::size_t t = 0; t < mesh.number_of_tetrahedra(); ++t)
    EXPECT_TRUE(complex.is_in_complex(mesh.cell_handle(t)));
  EXPECT_NO_THROW(check_tetrahedral_mesh(mesh));
}

TEST(Indexed_tetrahedra_test, exact_coordinates)
{
  using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
  CGAL::Delaunay_triangulation_3<Exact> triangulation;
  for (int i = 0; i < 8; ++i)
    triangulation.insert({Exact::FT(i % 2) / 3, Exact::FT(i / 2 % 2) / 3, Exact::FT(i / 4) / 3});
  const Indexed_tetrahedra mesh(triangulation);
  EXPECT_NEAR(volume_of(mesh), 1.0 / 27, 1e-15);
  expect_consistent(mesh, coordinates_of);
}

TEST(Indexed_tetrahedra_test, triangulations_of_lower_dimension_have_no_tetrahedra)
{
  CGAL::Delaunay_triangulation_3<Kernel> triangulation;
  for (int i = 0; i <= 5; ++i) {
    const Indexed_tetrahedra mesh(triangulation);
    EXPECT_EQ(mesh.number_of_vertices(), 0u);
    EXPECT_EQ(mesh.number_of_tetrahedra(), 0u);
    EXPECT_THROW(check_tetrahedral_mesh(mesh), Invalid_input_error);
    triangulation.insert(Point(i, i * i, 0));
  }
  EXPECT_EQ(triangulation.dimension(), 2);
}
