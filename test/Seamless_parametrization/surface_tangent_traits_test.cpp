// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "map_test_tools.h"

#include <Quadrille/Surface_tangent_traits.h>
#include <Quadrille/frame_field_topology.h>
#include <Quadrille/seamless_parametrization.h>

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

namespace {

using namespace Quadrille;
using namespace Quadrille::test;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vector = Kernel::Vector_2;
using Point = Kernel::Point_2;
using Gradients_in_space = std::array<Eigen::Vector3d, 2>;

/// A surface with its traits and the property maps that the functions read and write.
struct Surface {
  using Traits = Surface_tangent_traits<Mesh, Mesh::Property_map<Mesh::Vertex_index, Mesh::Point>>;

  explicit Surface(const Surface_mesh_arrays& arrays, double scale = 1.0) : traits(mesh, mesh.points())
  {
    for (const Eigen::Vector3d& p : arrays.points)
      mesh.add_vertex(Mesh::Point(scale * p.x(), scale * p.y(), scale * p.z()));
    const auto vertex = [](int v) { return Mesh::Vertex_index(Mesh::size_type(v)); };
    for (const auto& [a, b, c] : arrays.triangles)
      mesh.add_face(vertex(a), vertex(b), vertex(c));
    gradients = mesh.add_property_map<Mesh::Face_index, std::pair<Vector, Vector>>("f:gradients").first;
    constrained = mesh.add_property_map<Mesh::Edge_index, bool>("e:constrained", false).first;
    uv = mesh.add_property_map<Mesh::Halfedge_index, Point>("h:uv").first;
    matching = mesh.add_property_map<Mesh::Halfedge_index, int>("h:matching", -1).first;
  }

  Eigen::Vector3d position(Mesh::Vertex_index v) const
  {
    const Mesh::Point& p = mesh.point(v);
    return {p.x(), p.y(), p.z()};
  }
  /// Gradients in space, as a function of the centroid and the normal of a face.
  void set(const std::function<Gradients_in_space(const Eigen::Vector3d&, const Eigen::Vector3d&)>& field)
  {
    for (const Mesh::Face_index f : mesh.faces()) {
      Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
      for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f)))
        centroid += position(v) / 3.0;
      const Eigen::Matrix<double, 3, 2> basis = traits.basis(f);
      const Gradients_in_space pair = field(centroid, basis.col(0).cross(basis.col(1)));
      const Eigen::Vector2d du = traits.coordinates(f, pair[0]), dv = traits.coordinates(f, pair[1]);
      gradients[f] = {Vector(du.x(), du.y()), Vector(dv.x(), dv.y())};
    }
  }
  Seamless_map<Mesh> compute()
  {
    return seamless_parametrization_with_traits(mesh, traits, gradients, constrained, uv);
  }
  Frame_field_topology<Mesh> topology()
  {
    return frame_field_topology_with_traits(mesh, traits, gradients, constrained, matching);
  }
  double squared_length_in_map(Mesh::Halfedge_index h) const { return (uv[h] - uv[mesh.prev(h)]).squared_length(); }

  Mesh mesh;
  Traits traits;
  Mesh::Property_map<Mesh::Face_index, std::pair<Vector, Vector>> gradients;
  Mesh::Property_map<Mesh::Edge_index, bool> constrained;
  Mesh::Property_map<Mesh::Halfedge_index, Point> uv;
  Mesh::Property_map<Mesh::Halfedge_index, int> matching;
};

/// A grid of n x m cells on a surface, periodic in the first parameter and, if asked for, in the second.
Surface_mesh_arrays grid_surface(int n, int m, bool closed, const std::function<Eigen::Vector3d(double, double)>& point)
{
  Surface_mesh_arrays arrays;
  const int rows = closed ? m : m + 1;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < n; ++i)
      arrays.points.push_back(point(double(i) / n, double(j) / m));
  const auto at = [&](int i, int j) { return (j % rows) * n + i % n; };
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      arrays.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      arrays.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return arrays;
}

Surface_mesh_arrays cylinder(int n, int m)
{
  return grid_surface(n, m, false, [](double s, double t) {
    return Eigen::Vector3d(std::cos(2 * pi * s), std::sin(2 * pi * s), 1.5 * t);
  });
}

Surface_mesh_arrays torus(int n, int m)
{
  return grid_surface(n, m, true, [](double s, double t) {
    const double r = 2 + std::cos(2 * pi * t);
    return Eigen::Vector3d(r * std::cos(2 * pi * s), r * std::sin(2 * pi * s), std::sin(2 * pi * t));
  });
}

/// Unit gradients along and across the parallels of a surface of revolution about the third axis.
Gradients_in_space parallels(const Eigen::Vector3d& centroid, const Eigen::Vector3d& normal)
{
  const Eigen::Vector3d along = Eigen::Vector3d::UnitZ().cross(centroid);
  const Eigen::Vector3d u = (along - normal * normal.dot(along)).normalized();
  return {u, normal.cross(u)};
}

/// Unit gradients along the coordinate axes, on the faces of a box.
Gradients_in_space along_axes(const Eigen::Vector3d&, const Eigen::Vector3d& normal)
{
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const Eigen::Vector3d u = Eigen::Vector3d::Unit((axis + 1) % 3);
  return {u, normal.cross(u)};
}

Surface_mesh_arrays moved(const Planar_mesh& planar, const Eigen::Matrix3d& R, const Eigen::Vector3d& t)
{
  Surface_mesh_arrays arrays;
  for (const Eigen::Vector2d& p : planar.points)
    arrays.points.emplace_back(R * Eigen::Vector3d(p.x(), p.y(), 0) + t);
  arrays.triangles = planar.triangles;
  return arrays;
}

const Eigen::Matrix3d some_rotation = Eigen::Quaterniond(0.3, -0.6, 0.5, 0.2).normalized().toRotationMatrix();

} // namespace

TEST(Surface_tangent_traits, bases_are_orthonormal_and_turn_as_unfolded)
{
  for (const double scale : {1.0, 1e8, 1e-8}) {
    Surface surface(cube_surface(3, true), scale);
    const Mesh& mesh = surface.mesh;
    for (const Mesh::Face_index f : mesh.faces()) {
      const Eigen::Matrix<double, 3, 2> basis = surface.traits.basis(f);
      EXPECT_LT((basis.transpose() * basis - Eigen::Matrix2d::Identity()).norm(), 1e-14);
      const Eigen::Vector3d outwards = surface.position(mesh.target(mesh.halfedge(f)));
      EXPECT_GT(basis.col(0).cross(basis.col(1)).dot(outwards), 0.5 * scale);
      Eigen::Vector2d sum = Eigen::Vector2d::Zero();
      for (const Mesh::Halfedge_index h : mesh.halfedges_around_face(mesh.halfedge(f))) {
        const auto [x, y] = surface.traits.edge_vector(h);
        const Eigen::Vector3d edge = surface.position(mesh.target(h)) - surface.position(mesh.source(h));
        EXPECT_LT((basis * Eigen::Vector2d(x, y) - edge).norm(), 1e-14 * scale);
        sum += Eigen::Vector2d(x, y);
        EXPECT_EQ(surface.traits.transport_angle(h), -surface.traits.transport_angle(mesh.opposite(h)));
        // The edge's own direction on both sides.
        const double angle = std::atan2(y, x) + surface.traits.transport_angle(h);
        const auto [a, b] = surface.traits.edge_vector(mesh.opposite(h));
        EXPECT_LT((Eigen::Vector2d(a, b) + edge.norm() * Eigen::Vector2d(std::cos(angle), std::sin(angle))).norm(),
                  1e-14 * scale);
      }
      EXPECT_LT(sum.norm(), 1e-14 * scale);
    }
  }
}

TEST(Surface_tangent_traits, planar_domain_in_space_has_the_same_map)
{
  const Planar_mesh planar = plate_with_holes_mesh(0.2);
  const std::vector<Gradient_pair> frames = perturbed(smooth_cross_field(planar, 0.2), 0.1, 1);
  Planar_surface_mesh mesh = to_surface_mesh(planar);
  const auto gradients =
      mesh.add_property_map<Planar_surface_mesh::Face_index, std::pair<Vector, Vector>>("f:gradients").first;
  const auto constrained = mesh.add_property_map<Planar_surface_mesh::Edge_index, bool>("e:constrained", false).first;
  const auto uv = mesh.add_property_map<Planar_surface_mesh::Halfedge_index, Point>("h:uv").first;
  Surface surface(moved(planar, some_rotation, {3, -1, 2}));
  for (const Mesh::Face_index f : surface.mesh.faces()) {
    const auto& [du, dv] = frames[std::size_t(f)];
    gradients[f] = {Vector(du.x(), du.y()), Vector(dv.x(), dv.y())};
    const Eigen::Vector2d a = surface.traits.coordinates(f, some_rotation.leftCols<2>() * du),
                          b = surface.traits.coordinates(f, some_rotation.leftCols<2>() * dv);
    surface.gradients[f] = {Vector(a.x(), a.y()), Vector(b.x(), b.y())};
  }
  const auto expected = seamless_parametrization(mesh, mesh.points(), gradients, constrained, uv);
  const auto map = surface.compute();
  EXPECT_EQ(map.singular_vertices, expected.singular_vertices);
  EXPECT_FALSE(map.singular_vertices.empty());
  EXPECT_EQ(map.seam_residual_max, 0.0);
  EXPECT_NEAR(map.integration_error, expected.integration_error, 1e-9 * expected.integration_error);
  for (const Mesh::Halfedge_index h : surface.mesh.halfedges()) {
    if (surface.mesh.is_border(h))
      continue;
    const double length = (uv[h] - uv[mesh.prev(h)]).squared_length(); // the same for every way to cut
    EXPECT_NEAR(surface.squared_length_in_map(h), length, 1e-8 * length);
  }
}

TEST(Surface_tangent_traits, cylinder_unrolls)
{
  for (const double scale : {1.0, 1e8, 1e-8}) {
    constexpr int n = 24;
    Surface surface(cylinder(n, 7), scale);
    surface.set(parallels);
    const auto map = surface.compute();
    EXPECT_LT(map.integration_error, 1e-20);
    EXPECT_EQ(map.seam_residual_max, 0.0);
    EXPECT_EQ(map.flipped, 0);
    EXPECT_EQ(map.index_sum, 0.0);
    EXPECT_TRUE(map.singular_vertices.empty() && map.corners.empty());
    for (const Mesh::Halfedge_index h : surface.mesh.halfedges()) {
      if (surface.mesh.is_border(h))
        continue;
      const Eigen::Vector3d edge = surface.position(surface.mesh.target(h)) - surface.position(surface.mesh.source(h));
      EXPECT_NEAR(surface.squared_length_in_map(h), edge.squaredNorm(), 1e-10 * scale * scale);
    }
    double around = 0.0; // the seam from boundary to boundary jumps by the length of the polygon
    for (const auto& seam : map.seams)
      around = std::max(around, std::hypot(seam.translation[0], seam.translation[1]));
    EXPECT_NEAR(around, scale * 2 * n * std::sin(pi / n), 1e-9 * scale);
  }
}

TEST(Surface_tangent_traits, cube_has_eight_corners)
{
  Surface surface(cube_surface(6, false));
  surface.set(along_axes);
  const auto map = surface.compute();
  EXPECT_EQ(map.singularities, (std::map<int, int>{{3, 8}}));
  for (const auto& [v, valence] : map.singular_vertices)
    EXPECT_EQ(surface.position(v).cwiseAbs(), Eigen::Vector3d::Constant(0.5));
  EXPECT_EQ(map.index_sum, 2.0);
  EXPECT_LT(map.integration_error, 1e-20);
  EXPECT_EQ(map.seam_residual_max, 0.0);
  EXPECT_EQ(map.flipped, 0);
  const auto topology = surface.topology();
  EXPECT_EQ(topology.singular_vertices.size(), 8u);
  EXPECT_EQ(topology.quarter_index_sum, 8);
}

TEST(Surface_tangent_traits, torus_has_no_singularity)
{
  Surface surface(torus(40, 20));
  surface.set(parallels);
  const auto map = surface.compute();
  EXPECT_TRUE(map.singular_vertices.empty());
  EXPECT_EQ(map.index_sum, 0.0);
  EXPECT_EQ(map.seam_residual_max, 0.0);
  EXPECT_EQ(map.flipped, 0);
  EXPECT_FALSE(map.seams.empty());
  // du = d(angle) and dv of length 1 / r integrate: the conformal map of the torus. Only the facets are not exact.
  double previous = 1.0;
  for (const int n : {20, 40, 80}) {
    Surface conformal(torus(n, n));
    conformal.set([](const Eigen::Vector3d& centroid, const Eigen::Vector3d& normal) {
      const Gradients_in_space units = parallels(centroid, normal);
      const double r = centroid.head<2>().norm();
      return Gradients_in_space{units[0] / r, units[1] / r};
    });
    const double error = std::sqrt(conformal.compute().integration_error);
    EXPECT_LT(error, 0.6 * previous); // of first order at least
    previous = error;
  }
}

// Whatever the frames are.
TEST(Surface_tangent_traits, indices_add_up_to_the_euler_characteristic)
{
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  const std::pair<Surface_mesh_arrays, int> surfaces[] = {{cube_surface(5, true), 2},
                                                          {cube_surface(4, false), 2},
                                                          {torus(12, 9), 0},
                                                          {cylinder(9, 4), 0},
                                                          {moved(rectangle_mesh(6, 5), some_rotation, {1, 2, 3}), 1}};
  for (const auto& [arrays, characteristic] : surfaces) {
    Surface surface(arrays);
    surface.set([&](const Eigen::Vector3d&, const Eigen::Vector3d& n) {
      const Eigen::Vector3d any(normal(generator), normal(generator), normal(generator));
      const Eigen::Vector3d u = n.cross(any);
      return Gradients_in_space{u, n.cross(u)};
    });
    const auto topology = surface.topology();
    EXPECT_EQ(topology.quarter_index_sum, 4 * characteristic);
    EXPECT_FALSE(topology.singular_vertices.empty());
    for (const Mesh::Halfedge_index h : surface.mesh.halfedges())
      EXPECT_EQ((surface.matching[h] + surface.matching[surface.mesh.opposite(h)]) % 4, 0);
  }
}

TEST(Surface_tangent_traits, degenerate_triangles_are_named)
{
  Surface_mesh_arrays arrays = cube_surface(2, false);
  arrays.points[std::size_t(arrays.triangles[3][0])] =
      0.5 * (arrays.points[std::size_t(arrays.triangles[3][1])] + arrays.points[std::size_t(arrays.triangles[3][2])]);
  Surface flat(arrays);
  try {
    flat.traits.basis(Mesh::Face_index(3));
    FAIL();
  } catch (const Invalid_input_error& error) {
    EXPECT_NE(std::string(error.what())
                  .find("the triangle with the corners (-0.5, 0.5, -0.25), (-0.5, 0.5, 0) and (-0.5, 0.5, -0.5)"),
              std::string::npos)
        << error.what();
  }
  EXPECT_THROW(flat.traits.edge_vector(flat.mesh.halfedge(Mesh::Face_index(3))), Invalid_input_error);
  arrays.points[std::size_t(arrays.triangles[3][0])] = {0, 0, std::numeric_limits<double>::quiet_NaN()};
  Surface not_finite(arrays);
  EXPECT_THROW(not_finite.traits.basis(Mesh::Face_index(3)), Invalid_input_error);
}
