// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "map_test_tools.h"

#include <Quadrille/frame_field_topology.h>
#include <Quadrille/seamless_parametrization.h>

#include <CGAL/property_map.h>

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace Quadrille;
using namespace Quadrille::test;
using Mesh = Planar_surface_mesh;
using Vector = Kernel::Vector_2;
using Point = Kernel::Point_2;

/// A mesh with the property maps that the function reads and writes.
struct Problem {
  Problem(const Planar_mesh& arrays, const std::vector<Gradient_pair>& frames) : mesh(to_surface_mesh(arrays))
  {
    gradients = mesh.add_property_map<Mesh::Face_index, std::pair<Vector, Vector>>("f:gradients").first;
    constrained = mesh.add_property_map<Mesh::Edge_index, bool>("e:constrained", false).first;
    uv = mesh.add_property_map<Mesh::Halfedge_index, Point>("h:uv").first;
    matching = mesh.add_property_map<Mesh::Halfedge_index, int>("h:matching", -1).first;
    for (const Mesh::Face_index f : mesh.faces()) {
      const auto& [du, dv] = frames[std::size_t(f)];
      gradients[f] = {Vector(du.x(), du.y()), Vector(dv.x(), dv.y())};
    }
  }
  Seamless_map<Mesh> compute(const Seamless_parametrization_options& options = {})
  {
    return seamless_parametrization(mesh, mesh.points(), gradients, constrained, uv, options);
  }

  Mesh mesh;
  Mesh::Property_map<Mesh::Face_index, std::pair<Vector, Vector>> gradients;
  Mesh::Property_map<Mesh::Edge_index, bool> constrained;
  Mesh::Property_map<Mesh::Halfedge_index, Point> uv;
  Mesh::Property_map<Mesh::Halfedge_index, int> matching;
};

Problem plate_problem(double noise = 0.0)
{
  const Planar_mesh mesh = plate_with_holes_mesh(0.2);
  return Problem(mesh, perturbed(smooth_cross_field(mesh, 0.2), noise, 1));
}

TEST(Seamless_parametrization, value_of_a_halfedge_belongs_to_its_target)
{
  const Planar_mesh arrays = rectangle_mesh(4, 3, 2.0, 1.5);
  Problem problem(arrays, sample(arrays, [](auto) { return frame(0.0); }));
  const Seamless_map<Mesh> map = problem.compute();
  for (const Mesh::Halfedge_index h : problem.mesh.halfedges()) {
    if (problem.mesh.is_border(h))
      continue;
    const Vector difference = problem.uv[h] - problem.mesh.point(problem.mesh.target(h));
    EXPECT_NEAR(difference.x(), 0.0, 1e-12);
    EXPECT_NEAR(difference.y(), 0.0, 1e-12);
  }
  EXPECT_TRUE(map.singularities.empty());
  EXPECT_EQ(map.index_sum, 1.0);
  EXPECT_EQ(map.corners.size(), 4u);
  for (const auto& corner : map.corners) {
    EXPECT_EQ(corner.quadrants, 1);
    EXPECT_EQ(problem.mesh.source(corner.halfedge), corner.vertex);
    EXPECT_TRUE(problem.mesh.is_border(problem.mesh.opposite(corner.halfedge)));
  }
}

TEST(Seamless_parametrization, seams_hold_with_their_translations_bit_for_bit)
{
  Problem problem = plate_problem();
  const Mesh& mesh = problem.mesh;
  const Seamless_map<Mesh> map = problem.compute();
  EXPECT_EQ(map.seam_residual_max, 0.0);
  EXPECT_EQ(map.index_sum, -2.0);
  EXPECT_EQ(map.singularities, (std::map<int, int>{{5, 12}}));
  EXPECT_EQ(map.singular_vertices.size(), 12u);
  EXPECT_EQ(map.flipped, 0);
  EXPECT_FALSE(map.seams.empty());

  std::map<Mesh::Halfedge_index, std::pair<int, Vector>> transition;
  for (const auto& seam : map.seams)
    for (const Mesh::Halfedge_index h : seam.halfedges)
      transition[h] = {seam.matching, Vector(seam.translation[0], seam.translation[1])};
  for (const Mesh::Halfedge_index h : mesh.halfedges()) {
    const Mesh::Halfedge_index opposite = mesh.opposite(h);
    if (mesh.is_border(h) || mesh.is_border(opposite) || transition.count(opposite))
      continue;
    const auto found = transition.find(h);
    const auto [k, translation] = found == transition.end() ? std::pair(0, Vector(0, 0)) : found->second;
    const auto across = [&, k = k, translation = translation](const Point& p) {
      const Eigen::Vector2d turned = internal::rotate_quarters(Eigen::Vector2d(p.x(), p.y()), k);
      return Point(turned.x(), turned.y()) + translation;
    };
    EXPECT_EQ(across(problem.uv[h]), problem.uv[mesh.prev(opposite)]); // both at target(h)
    EXPECT_EQ(across(problem.uv[mesh.prev(h)]), problem.uv[opposite]);
  }
}

TEST(Seamless_parametrization, what_stays_flipped_is_returned)
{
  Planar_mesh arrays = rectangle_mesh(4, 4);
  arrays.points.emplace_back(0.375, -0.01);
  arrays.triangles.push_back({1, int(arrays.points.size()) - 1, 2});
  Problem problem(arrays, sample(arrays, [](auto) { return frame(0.0); }));
  const Seamless_map<Mesh> map = problem.compute();
  EXPECT_EQ(map.flipped, 1);
  ASSERT_EQ(map.flipped_faces.size(), 1u);
  EXPECT_EQ(std::size_t(map.flipped_faces[0]), arrays.triangles.size() - 1);
  EXPECT_EQ(map.flat_faces, map.flipped_faces);
}

TEST(Seamless_parametrization, same_result_for_every_number_of_threads)
{
  Problem problem = plate_problem(0.6);
  problem.compute();
  const std::vector<Point> expected(problem.uv.begin(), problem.uv.end());
  for (const int threads : {2, 4, 0}) {
    Seamless_parametrization_options options;
    options.threads = threads;
    problem.compute(options);
    EXPECT_EQ(std::vector<Point>(problem.uv.begin(), problem.uv.end()), expected);
  }
}

TEST(Seamless_parametrization, rejects_unusable_input)
{
  const Planar_mesh good = rectangle_mesh(2, 2);
  const auto frames = sample(good, [](auto) { return frame(0.0); });
  Planar_mesh inverted = good;
  inverted.points[4] = {-5.0, 0.5};
  EXPECT_THROW(Problem(inverted, frames).compute(), Invalid_input_error);
  Planar_mesh flat = good;
  flat.points[4] = flat.points[0];
  EXPECT_THROW(Problem(flat, frames).compute(), Invalid_input_error);
  Planar_mesh not_finite = good;
  not_finite.points[4] = {std::numeric_limits<double>::quiet_NaN(), 0.5};
  EXPECT_THROW(Problem(not_finite, frames).compute(), Invalid_input_error);
  auto left_handed = frames;
  left_handed[2].second *= -1.0;
  EXPECT_THROW(Problem(good, left_handed).compute(), Invalid_input_error);
  EXPECT_THROW(Problem(Planar_mesh(), {}).compute(), Invalid_input_error);
}

TEST(Frame_field_topology, finds_singularities_and_corners)
{
  const Planar_mesh arrays = glued_squares_mesh(5, 6);
  Problem problem(arrays, perturbed(sample(arrays, [](const auto& p) { return power_frame(p, 5); }), 0.0, 2));
  const Frame_field_topology<Mesh> topology = frame_field_topology(
      problem.mesh, problem.mesh.points(), problem.gradients, problem.constrained, problem.matching);
  ASSERT_EQ(topology.singular_vertices.size(), 1u);
  EXPECT_EQ(topology.singular_vertices[0], std::pair(Mesh::Vertex_index(0), -1));
  EXPECT_EQ(topology.boundary_corners.size(), 5u);
  EXPECT_EQ(topology.quarter_index_sum, 4);
  for (const Mesh::Halfedge_index h : problem.mesh.halfedges()) {
    EXPECT_GE(problem.matching[h], 0);
    EXPECT_EQ((problem.matching[h] + problem.matching[problem.mesh.opposite(h)]) % 4, 0);
  }
}

/// No more than the concept `TangentPlaneTraits` and the property maps' documentation ask for.
struct Traits_archetype {
  using Halfedge = boost::graph_traits<Mesh>::halfedge_descriptor;
  std::array<double, 2> edge_vector(Halfedge h) const { return vectors.at(h); }
  double transport_angle(Halfedge) const { return 0.0; }
  std::map<Halfedge, std::array<double, 2>> vectors;
};
struct Vector_archetype {
  double x() const { return first; }
  double y() const { return second; }
  double first, second;
};
struct Constant_gradients {
  using key_type = boost::graph_traits<Mesh>::face_descriptor;
  using value_type = std::pair<Vector_archetype, Vector_archetype>;
  using reference = value_type;
  using category = boost::readable_property_map_tag;
  friend value_type get(const Constant_gradients&, key_type) { return {{1.0, 0.0}, {0.0, 1.0}}; }
};
struct Uv_archetype {
  Uv_archetype(double u, double v) : sum(u + v) {}
  double sum;
};
struct Uv_map_archetype {
  using key_type = boost::graph_traits<Mesh>::halfedge_descriptor;
  using value_type = Uv_archetype;
  using reference = void;
  using category = boost::writable_property_map_tag;
  friend void put(const Uv_map_archetype& map, key_type, const Uv_archetype& value) { *map.total += value.sum; }
  double* total;
};

TEST(Concepts, archetypes_suffice)
{
  const Mesh mesh = to_surface_mesh(rectangle_mesh(1, 1));
  Traits_archetype traits;
  for (const Mesh::Halfedge_index h : mesh.halfedges()) {
    const Vector vector = mesh.point(mesh.target(h)) - mesh.point(mesh.source(h));
    traits.vectors[h] = {vector.x(), vector.y()};
  }
  double total = 0.0;
  const auto map = seamless_parametrization_with_traits(mesh, traits, Constant_gradients(),
                                                        CGAL::Constant_property_map<Mesh::Edge_index, bool>(false),
                                                        Uv_map_archetype{&total});
  EXPECT_EQ(map.flipped, 0);
  EXPECT_NEAR(total, 6.0, 1e-12); // six corners with mean coordinates (1/2, 1/2)
}

/// Eigen's factorisation behind the concept `SparseCholeskySolver`.
struct Other_solver {
  void analyze(const Eigen::SparseMatrix<double>& lower) { solver.analyzePattern(lower); }
  bool factorize(const Eigen::SparseMatrix<double>& lower)
  {
    solver.factorize(lower);
    return solver.info() == Eigen::Success;
  }
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const { x = solver.solve(b); }
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
};

TEST(Concepts, any_sparse_cholesky_solver)
{
  Problem problem = plate_problem(0.5);
  const Seamless_map<Mesh> map = problem.compute();
  const Seamless_map<Mesh> other = seamless_parametrization<Other_solver>(
      problem.mesh, problem.mesh.points(), problem.gradients, problem.constrained, problem.uv);
  EXPECT_EQ(other.singularities, map.singularities);
  EXPECT_EQ(other.seam_residual_max, 0.0);
  EXPECT_NEAR(other.integration_error, map.integration_error, 1e-6);
}

} // namespace
