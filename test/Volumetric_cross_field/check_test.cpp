// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "tetrahedral_test_meshes.h"

#include <Quadrille/check_tetrahedral_mesh.h>

#include <gtest/gtest.h>

#include <limits>
#include <string>

using namespace Quadrille;

namespace {

constexpr double scales[] = {1, 1e8, 1e-8};

/// The mesh is refused at every scale in a message that contains `text`.
void expect_refused(const Tetrahedral_mesh& mesh, const std::string& text)
{
  for (const double scale : scales) {
    const Tetrahedral_mesh scaled =
        mapped(mesh, [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return scale * p; });
    try {
      check_tetrahedral_mesh(scaled);
      ADD_FAILURE() << "accepted at scale " << scale << ": " << text;
    } catch (const Invalid_input_error& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  }
}

/// Fit for a field at every scale, turned and with other numbers, with this volume, and with this Euler characteristic
/// of its boundary.
void expect_good(const Tetrahedral_mesh& mesh, double expected_volume, double accuracy, int characteristic)
{
  std::vector<int> new_number;
  for (const double scale : scales) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    const Tetrahedral_mesh moved = relabelled(mapped(mesh,
                                                     [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
                                                       return scale * (turn * p + Eigen::Vector3d(3, 2, 1));
                                                     }),
                                              1, new_number);
    EXPECT_NO_THROW(check_tetrahedral_mesh(moved));
    for (const auto& t : moved.tetrahedra)
      ASSERT_GT(volume(moved, t), 0);
    EXPECT_NEAR(volume(moved) / (scale * scale * scale), expected_volume, accuracy);
  }
  const auto faces = boundary_of(mesh);
  std::set<int> vertices;
  for (const auto& face : faces)
    vertices.insert(face.begin(), face.end());
  // Closed surfaces of triangles have 3 edges for 2 faces.
  EXPECT_EQ(int(vertices.size()) - int(faces.size()) / 2, characteristic);
}

/// Vertices of tetrahedra to come.
Tetrahedral_mesh with_points(const std::vector<std::array<double, 3>>& points)
{
  Tetrahedral_mesh mesh;
  mesh.points = points;
  return mesh;
}

/// A tetrahedron, its mirror image below, and points beside them.
Tetrahedral_mesh seven_points()
{
  return with_points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {2, 2, 2}, {3, 2, 2}});
}

/// Of seven_points() those that are used.
Tetrahedral_mesh of_seven_points(const std::vector<std::array<int, 4>>& tetrahedra)
{
  Tetrahedral_mesh mesh = seven_points();
  mesh.tetrahedra = tetrahedra;
  return part_of(mesh, [](const Eigen::Vector3d&) { return true; });
}

} // namespace

TEST(Check, good_meshes_pass)
{
  const double pi = std::acos(-1.0);
  expect_good(of_seven_points({{0, 1, 2, 3}}), 1.0 / 6, 1e-12, 2);
  expect_good(jittered(box_of_tetrahedra({3, 4, 5}, {0.3, 0.4, 0.5}), 0.01, 1), 0.06, 1e-12, 2);
  expect_good(box_of_tetrahedra({2, 4, 6}, {1, 2, 3}, true), 6, 1e-12, 2);
  expect_good(ball_of_tetrahedra(12), 4 * pi / 3, 0.1, 2);
  expect_good(prism_of_tetrahedra(polygon_of_triangles({{0, 0}, {2, 0}, {3, 2}, {0, 1}}, 3), 2, 0.5), 1.75, 1e-12, 2);
  expect_good(prism_of_tetrahedra(polygon_of_triangles(regular_polygon(5), 4), 3, 1), 2.5 * std::sin(0.4 * pi), 1e-12,
              2);
  expect_good(prism_of_tetrahedra(disk_of_triangles(6), 5, 2), 2 * pi, 0.05, 2);
  expect_good(torus_of_tetrahedra(5, 40, 3), 6 * pi * pi, 2, 0);
}

TEST(Check, components_and_cavities_pass)
{
  const Tetrahedral_mesh cube = cube_of_tetrahedra(3, 3);
  expect_good(
      both(cube,
           mapped(cube, [](const Eigen::Vector3d& p) -> Eigen::Vector3d { return p + Eigen::Vector3d(4, 0, 0); })),
      54, 1e-10, 4);
  const auto is_outside = [](const Eigen::Vector3d& p) {
    return (p - Eigen::Vector3d(1.5, 1.5, 1.5)).cwiseAbs().maxCoeff() > 0.5;
  };
  expect_good(part_of(cube, is_outside), 26, 1e-10, 4);
  // A cavity with its own filling, that is a component inside another.
  expect_good(both(part_of(cube, is_outside), mapped(cube_of_tetrahedra(1, 0.5),
                                                     [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
                                                       return p + Eigen::Vector3d(1.25, 1.25, 1.25);
                                                     })),
              26.125, 1e-10, 6);
}

TEST(Check, no_tetrahedra)
{
  expect_refused({}, "no tetrahedra");
  expect_refused(seven_points(), "no tetrahedra");
}

TEST(Check, corners_that_do_not_exist)
{
  Tetrahedral_mesh mesh = cube_of_tetrahedra(2);
  mesh.tetrahedra[30][2] = 27;
  expect_refused(mesh, "tetrahedron 30 uses vertex 27");
  mesh.tetrahedra[30][2] = -1;
  expect_refused(mesh, "tetrahedron 30 uses vertex -1");
}

TEST(Check, vertices_without_tetrahedra)
{
  Tetrahedral_mesh mesh = seven_points();
  mesh.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  expect_refused(mesh, "vertex 5 at");
}

TEST(Check, coordinates_that_are_not_finite)
{
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Tetrahedral_mesh mesh = cube_of_tetrahedra(2);
    mesh.points[13][1] = bad;
    expect_refused(mesh, "vertex 13 at");
  }
}

TEST(Check, tetrahedra_that_are_flat_or_inverted)
{
  Tetrahedral_mesh mesh = of_seven_points({{0, 1, 2, 3}, {0, 2, 1, 4}});
  std::swap(mesh.tetrahedra[1][0], mesh.tetrahedra[1][1]);
  expect_refused(mesh, "tetrahedron 1 with a corner at vertex 2 at");
  expect_refused(mesh, "is inverted");

  mesh = of_seven_points({{0, 1, 2, 3}, {0, 2, 1, 4}});
  mesh.tetrahedra[1][3] = mesh.tetrahedra[1][1];
  mesh.points.pop_back();
  expect_refused(mesh, "tetrahedron 1 with a corner at vertex 0 at");

  mesh = of_seven_points({{0, 1, 2, 3}, {0, 2, 1, 4}});
  mesh.points[4] = {0.5, 0.25, 0};
  expect_refused(mesh, "tetrahedron 1 with a corner at vertex 0 at");
  expect_refused(mesh, "is degenerate");
  // Below the smallest volume that is allowed, and above it.
  mesh.points[4][2] = -1e-13;
  expect_refused(mesh, "is degenerate");
  mesh.points[4][2] = -1e-10;
  EXPECT_NO_THROW(check_tetrahedral_mesh(mesh));
}

TEST(Check, faces_of_three_tetrahedra)
{
  Tetrahedral_mesh mesh = with_points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0.1, 0.1, 2}});
  mesh.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 1, 2, 5}};
  expect_refused(mesh, "tetrahedra 0, 1 and 2 have a face in common");
}

TEST(Check, tetrahedra_on_the_same_side)
{
  Tetrahedral_mesh mesh = with_points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.1, 2}});
  mesh.tetrahedra = {{0, 1, 2, 3}, {0, 1, 2, 4}};
  expect_refused(mesh, "tetrahedra 0 and 1 lie on the same side");
}

TEST(Check, boundaries_that_touch_themselves)
{
  Tetrahedral_mesh at_edge = with_points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}});
  at_edge.tetrahedra = {{0, 1, 2, 3}, {0, 1, 4, 5}};
  expect_refused(at_edge, "touches itself along the edge");
  expect_refused(at_edge, "vertex 0 at (0, 0, 0)");

  Tetrahedral_mesh at_vertex =
      with_points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
  at_vertex.tetrahedra = {{0, 1, 2, 3}, {0, 5, 4, 6}};
  expect_refused(at_vertex, "touches itself at vertex 0 at (0, 0, 0)");

  // Two cells of a grid that meet in an edge, and two that meet in a corner.
  const auto cells = [](const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
    return part_of(cube_of_tetrahedra(2, 2), [=](const Eigen::Vector3d& p) {
      return (p - first).cwiseAbs().maxCoeff() < 0.5 || (p - second).cwiseAbs().maxCoeff() < 0.5;
    });
  };
  expect_refused(cells({0.5, 0.5, 0.5}, {1.5, 1.5, 0.5}), "touches itself along the edge");
  expect_refused(cells({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}), "touches itself at vertex");
  EXPECT_NO_THROW(check_tetrahedral_mesh(cells({0.5, 0.5, 0.5}, {1.5, 0.5, 0.5})));
}
