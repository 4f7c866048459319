// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "surface_test_meshes.h"

#include <Quadrille/Odeco_frame_field/internal/surface_restrictions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <string>

namespace {

using namespace Quadrille;
using namespace Quadrille::internal;
using namespace Quadrille_test;

/// A surface with aligned edges where `is_feature` holds for their ends.
struct Surface {
  using Edge_predicate = std::function<bool(const Eigen::Vector3d&, const Eigen::Vector3d&)>;
  using Sizes = std::function<Frame_size(const Eigen::Vector3d&)>;

  Surface(Space_triangles arrays, const Edge_predicate& is_feature, const Sizes& size = {})
      : triangles(std::move(arrays)), mesh(triangles.indexed())
  {
    for (int h = 0; h < mesh.number_of_halfedges(); ++h) {
      const Eigen::Vector3d &p = point(mesh.source(h)), &q = point(mesh.target(h));
      if (mesh.opposite(h) > h || !is_feature(p, q))
        continue;
      std::array<Frame_size, 2> sizes;
      if (size)
        sizes = {size(p), size(q)};
      edges.push_back({h, true, sizes});
    }
    collect();
  }
  void collect() { constraints = Surface_constraint_collector(mesh, triangles.points, edges).collect(); }

  const Eigen::Vector3d& point(int v) const { return triangles.points[std::size_t(v)]; }
  const Eigen::Vector3d& point_of_node(std::size_t node) const { return point(constraints.nodes.vertex[node]); }
  std::size_t node_at(int halfedge) const
  {
    return std::size_t(constraints.nodes.corners[std::size_t(halfedge / 3)][std::size_t(halfedge % 3)]);
  }
  int vertex_at(const Eigen::Vector3d& p) const
  {
    const auto place = std::find_if(triangles.points.begin(), triangles.points.end(),
                                    [&](const Eigen::Vector3d& q) { return (p - q).norm() < 1e-9; });
    EXPECT_NE(place, triangles.points.end());
    return int(place - triangles.points.begin());
  }
  int number_of_nodes(int v) const
  {
    return int(std::count(constraints.nodes.vertex.begin(), constraints.nodes.vertex.end(), v));
  }
  int number_of_nodes(const Eigen::Vector3d& p) const { return number_of_nodes(vertex_at(p)); }

  Space_triangles triangles;
  Indexed_triangulation mesh;
  std::vector<Constrained_halfedge> edges;
  Surface_constraints constraints;
};

/// Whether p and q are on a common edge of [0, 1]^3.
bool on_edge_of_cube(const Eigen::Vector3d& p, const Eigen::Vector3d& q)
{
  int n = 0;
  for (int i = 0; i < 3; ++i)
    n += p[i] == q[i] && (p[i] == 0 || p[i] == 1) ? 1 : 0;
  return n >= 2;
}

/// [0, 4]^2 in the third coordinate plane.
Space_triangles plate()
{
  return space_grid(4, 4, [](double s, double t) { return Eigen::Vector3d(4 * s, 4 * t, 0); });
}
/// On the line y = 2 up to some x.
Surface::Edge_predicate up_to(double x)
{
  return [x](const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    return p.y() == 2 && q.y() == 2 && std::max(p.x(), q.x()) <= x;
  };
}

/// The eigenvalue of a node's frame along a direction of space, provided the frame has a vector there.
template <int N>
double value_along(const Surface& surface, const Restricted_unknowns<N>& unknowns, std::size_t node,
                   const Eigen::VectorXd& x, const Eigen::Vector3d& direction)
{
  const Eigen::Vector2d d = (surface.constraints.nodes.axes[node].leftCols<2>().transpose() * direction).normalized();
  const Symmetric_tensor_2 tensor =
      Symmetric_tensor_2::from_harmonics(Tensor_coefficients<N>::harmonics(unknowns.coefficients(node, x)));
  EXPECT_LT((tensor.contract_thrice(d) - tensor(d) * d).norm(), 1e-12 * std::abs(tensor(d)));
  return tensor(d);
}

template <int N> Eigen::VectorXd some_unknowns(const Restricted_unknowns<N>& unknowns)
{
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> uniform(1, 3);
  return Eigen::VectorXd::NullaryExpr(Eigen::Index(unknowns.number_of_unknowns()), [&] { return uniform(engine); });
}

TEST(Surface_nodes, there_is_one_in_every_sector_between_features)
{
  const Surface box(cube(4), on_edge_of_cube);
  for (int v = 0; v < box.mesh.number_of_vertices(); ++v) {
    int sides = 0; // of the cube that the vertex is on
    for (int i = 0; i < 3; ++i)
      sides += box.point(v)[i] == 0 || box.point(v)[i] == 1 ? 1 : 0;
    EXPECT_EQ(box.number_of_nodes(v), sides);
  }
  const Surface without_features(cube(4), [](const auto&, const auto&) { return false; });
  EXPECT_EQ(without_features.constraints.nodes.vertex.size(), without_features.triangles.points.size());

  const Surface dead_end(plate(), up_to(3));
  EXPECT_EQ(dead_end.number_of_nodes({0, 2, 0}), 2);
  EXPECT_EQ(dead_end.number_of_nodes({2, 2, 0}), 2);
  EXPECT_EQ(dead_end.number_of_nodes({3, 2, 0}), 1);
  EXPECT_EQ(dead_end.number_of_nodes({4, 2, 0}), 1);
  const Surface framed(plate(), [](const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    return (p.x() == q.x() && std::abs(p.x() - 2) == 2) || (p.y() == q.y() && std::abs(p.y() - 2) == 2);
  });
  EXPECT_EQ(framed.constraints.nodes.vertex.size(), framed.triangles.points.size());
}

TEST(Surface_nodes, have_the_axes_of_their_sector)
{
  const Surface box(cube(4), on_edge_of_cube);
  for (int f = 0; f < box.mesh.number_of_faces(); ++f)
    for (int i = 0; i < 3; ++i) {
      const Eigen::Matrix3d& axes = box.constraints.nodes.axes[box.node_at(3 * f + i)];
      EXPECT_LT((axes.col(2) - box.triangles.doubled_normal(std::size_t(f)).normalized()).norm(), 1e-15);
      EXPECT_LT((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), 1e-14);
      EXPECT_GT(axes.determinant(), 0);
    }
  double last_error = 1;
  for (const int n : {8, 16, 32}) {
    const Surface ring(torus(2 * n, n, 2, 1), [](const auto&, const auto&) { return false; });
    double error = 0;
    for (std::size_t node = 0; node < ring.constraints.nodes.vertex.size(); ++node) {
      const Eigen::Vector3d& p = ring.point_of_node(node);
      const Eigen::Vector3d normal = p - 2 * Eigen::Vector3d(p.x(), p.y(), 0).normalized();
      error = std::max(error, (ring.constraints.nodes.axes[node].col(2) - normal).norm());
    }
    EXPECT_LT(error, 0.3 * last_error);
    last_error = error;
  }
}

/// Calls `visit(node on one side, node on the other, p, q)` for both ends p of the features' edges pq inside.
template <class Visit> void for_both_sides(const Surface& surface, const Visit& visit)
{
  int n = 0;
  for (const Constrained_halfedge& edge : surface.edges) {
    const int other = surface.mesh.opposite(edge.halfedge);
    if (other < 0)
      continue;
    const Eigen::Vector3d &p = surface.point(surface.mesh.source(edge.halfedge)),
                          &q = surface.point(surface.mesh.target(edge.halfedge));
    visit(surface.node_at(edge.halfedge), surface.node_at(Indexed_triangulation::next(other)), p, q);
    visit(surface.node_at(Indexed_triangulation::next(edge.halfedge)), surface.node_at(other), q, p);
    ++n;
  }
  EXPECT_GT(n, 0);
}

template <int N> void expect_shared_lengths_on_cube()
{
  const Surface box(cube(4), on_edge_of_cube);
  const Restricted_unknowns<N> unknowns = restrict_surface<N>(box.constraints);
  const Eigen::VectorXd x = some_unknowns(unknowns);
  bool differ_across = false;
  for_both_sides(box, [&](std::size_t a, std::size_t b, const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    EXPECT_NE(a, b);
    const double length = value_along(box, unknowns, a, x, q - p);
    EXPECT_GT(length, 0.9);
    EXPECT_NEAR(value_along(box, unknowns, b, x, q - p), length, 1e-13 * length);
    const Eigen::Vector3d across_a = box.constraints.nodes.axes[a].col(2).cross(q - p),
                          across_b = box.constraints.nodes.axes[b].col(2).cross(q - p);
    differ_across = differ_across || std::abs(value_along(box, unknowns, a, x, across_a) -
                                              value_along(box, unknowns, b, x, across_b)) > 0.1;
  });
  EXPECT_EQ(differ_across, N == 5); // isotropic frames have the same length across as along
  // Of every edge's inner vertices N == 5 ? 3 : 1 lengths, of every corner as many, of every other one N coefficients.
  EXPECT_EQ(unknowns.number_of_unknowns(), std::size_t((12 * 3 + 8) * (N == 5 ? 3 : 1) + 6 * 9 * N));
}

TEST(Surface_restrictions, lengths_along_a_feature_are_the_same_on_both_sides)
{
  expect_shared_lengths_on_cube<3>();
  expect_shared_lengths_on_cube<5>();
}

TEST(Surface_restrictions, lengths_across_a_feature_are_the_same_where_the_surface_is_smooth)
{
  for (const double degrees : {0.0, 20.0, 40.0}) {
    const double slope = std::tan(degrees * two_pi / 360);
    const Surface roof(
        space_grid(4, 4,
                   [=](double s, double t) { return Eigen::Vector3d(4 * s, 4 * t, slope * std::max(0.0, 4 * t - 2)); }),
        up_to(4));
    const Restricted_unknowns<5> unknowns = restrict_surface<5>(roof.constraints);
    const Eigen::VectorXd x = some_unknowns(unknowns);
    for_both_sides(roof, [&](std::size_t a, std::size_t b, const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
      const Eigen::Vector3d across_a = roof.constraints.nodes.axes[a].col(2).cross(q - p),
                            across_b = roof.constraints.nodes.axes[b].col(2).cross(q - p);
      const double difference =
          value_along(roof, unknowns, a, x, across_a) - value_along(roof, unknowns, b, x, across_b);
      if (degrees < 30)
        EXPECT_NEAR(difference, 0, 1e-12);
      else
        EXPECT_GT(std::abs(difference), 1e-3);
      EXPECT_NEAR(value_along(roof, unknowns, a, x, q - p), value_along(roof, unknowns, b, x, q - p), 1e-12);
    });
  }
}

TEST(Surface_restrictions, prescribed_sizes_come_out_at_the_nodes)
{
  // Along and across differ; the sizes along the cube's edges change with the position, across them they do not, so
  // that the three edges of a corner, which ask for both, are consistent.
  const auto along = [](const Eigen::Vector3d& p) { return 0.2 * (1 + 0.1 * p.sum()); };
  {
    const Surface roof(
        space_grid(4, 4, [](double s, double t) { return Eigen::Vector3d(s, 4 * t, std::abs(4 * t - 2)); }), up_to(1),
        [&](const Eigen::Vector3d& p) { return Frame_size(0.1, along(p)); });
    const Restricted_unknowns<5> unknowns = restrict_surface<5>(roof.constraints);
    const Eigen::VectorXd x = some_unknowns(unknowns);
    for_both_sides(roof, [&](std::size_t a, std::size_t b, const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
      for (const std::size_t node : {a, b}) {
        EXPECT_EQ(unknowns.restriction(node).dimension, 0);
        EXPECT_NEAR(value_along(roof, unknowns, node, x, q - p) * along(p), 1, 1e-12);
        EXPECT_NEAR(value_along(roof, unknowns, node, x, roof.constraints.nodes.axes[node].col(2).cross(q - p)), 10,
                    1e-11);
      }
    });
  }
  const Surface box(cube(4), on_edge_of_cube, [&](const Eigen::Vector3d& p) { return Frame_size(along(p)); });
  const Restricted_unknowns<3> unknowns = restrict_surface<3>(box.constraints);
  const Eigen::VectorXd x = some_unknowns(unknowns);
  for_both_sides(box, [&](std::size_t a, std::size_t b, const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    for (const std::size_t node : {a, b}) {
      EXPECT_EQ(unknowns.restriction(node).dimension, 0);
      EXPECT_NEAR(value_along(box, unknowns, node, x, q - p) * along(p), 1, 1e-12);
    }
  });
}

TEST(Surface_restrictions, contradicting_sizes_leave_their_vector_free)
{
  Surface plane(plate(), up_to(4), [](const Eigen::Vector3d&) { return Frame_size(0, 0.5); });
  // The size jumps at x = 2, by more than 1.5 the second time.
  for (const double ratio : {1.4, 1.6}) {
    for (Constrained_halfedge& edge : plane.edges) {
      const double x =
          0.5 * (plane.point(plane.mesh.source(edge.halfedge)) + plane.point(plane.mesh.target(edge.halfedge))).x();
      edge.size.fill(Frame_size(0, x < 2 ? 0.5 : 0.5 * ratio));
    }
    plane.collect();
    const Restricted_unknowns<5> unknowns = restrict_surface<5>(plane.constraints);
    const Eigen::VectorXd x = some_unknowns(unknowns);
    for (std::size_t node = 0; node < unknowns.number_of_nodes(); ++node) {
      const Eigen::Vector3d& p = plane.point_of_node(node);
      if (p.y() != 2)
        continue;
      const bool is_free = p.x() == 2 && ratio > 1.5;
      EXPECT_EQ(unknowns.restriction(node).dimension, is_free ? 2 : 1);
      if (!is_free) {
        const double size = p.x() < 2 ? 0.5 : p.x() > 2 ? 0.5 * ratio : 0.5 * std::sqrt(ratio);
        EXPECT_NEAR(value_along(plane, unknowns, node, x, Eigen::Vector3d::UnitX()) * size, 1, 1e-12);
      }
    }
  }
}

TEST(Surface_restrictions, octahedral_fields_have_lengths_of_one)
{
  const Surface box(cube(4), on_edge_of_cube, [](const Eigen::Vector3d&) { return Frame_size(0.1); });
  const Restricted_unknowns<5> unknowns = restrict_to_octahedral<5>(box.constraints);
  const Eigen::VectorXd x = some_unknowns(unknowns);
  const Circular_harmonics unit = odeco_harmonics({});
  for (std::size_t node = 0; node < unknowns.number_of_nodes(); ++node) {
    const bool on_edge = box.number_of_nodes(box.constraints.nodes.vertex[node]) > 1;
    EXPECT_EQ(unknowns.restriction(node).dimension, on_edge ? 0 : 2);
    const auto q = unknowns.coefficients(node, x);
    EXPECT_NEAR(q[0], unit[0], 1e-15);
    EXPECT_EQ(q.segment<2>(1).norm(), 0);
    if (on_edge) {
      EXPECT_NEAR(q.tail<2>().norm(), unit.tail<2>().norm(), 1e-14);
      for (int i = 0; i < 3; ++i)
        if (const Eigen::Vector3d d = Eigen::Vector3d::Unit(i);
            std::abs(box.constraints.nodes.axes[node].col(2).dot(d)) < 0.5) {
          EXPECT_NEAR(value_along(box, unknowns, node, x, d), 1, 1e-13);
        }
    }
  }
}

TEST(Surface_restrictions, edges_without_alignment_fix_the_area_only)
{
  Surface plane(plate(), up_to(4), [](const Eigen::Vector3d&) { return Frame_size(0.5); });
  for (Constrained_halfedge& edge : plane.edges)
    edge.aligned = false;
  plane.collect();
  EXPECT_EQ(plane.constraints.nodes.vertex.size(), plane.triangles.points.size());
  const Restricted_unknowns<5> unknowns = restrict_surface<5>(plane.constraints);
  const Eigen::VectorXd x = some_unknowns(unknowns);
  for (std::size_t node = 0; node < unknowns.number_of_nodes(); ++node) {
    const bool is_constrained = plane.point_of_node(node).y() == 2;
    EXPECT_EQ(unknowns.restriction(node).dimension, is_constrained ? 2 : 5);
    if (is_constrained) {
      EXPECT_NEAR(frame_area(unknowns.coefficients(node, x)), 4, 1e-12);
    }
  }
}

TEST(Surface_restrictions, a_folded_vertex_is_named)
{
  // Around vertex 4 two triangles lie on the two next to them, and beyond their edges there is nothing.
  Space_triangles folded;
  folded.points = {{1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 0}};
  folded.faces = {{4, 0, 1}, {4, 1, 2}, {4, 2, 3}, {4, 3, 0}};
  const auto nowhere = [](const auto&, const auto&) { return false; };
  try {
    Surface(folded, nowhere);
    ADD_FAILURE() << "no error";
  } catch (const Invalid_input_error& error) {
    EXPECT_NE(std::string(error.what()).find("vertex 4 "), std::string::npos) << error.what();
  }
  // With the folds as features it has a normal on each side.
  const Surface features(
      folded, [](const Eigen::Vector3d& p, const Eigen::Vector3d& q) { return p.norm() == 0 || q.norm() == 0; });
  EXPECT_EQ(features.number_of_nodes(4), 4);
  folded.points[1] = {0, 1, 0.1}; // a little open
  folded.points[2] = {2, 0.1, 0.1};
  EXPECT_NO_THROW(Surface(folded, nowhere));
}

} // namespace
