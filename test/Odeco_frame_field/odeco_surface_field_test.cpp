// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "surface_test_meshes.h"

#include <Quadrille/Surface_tangent_traits.h>
#include <Quadrille/frame_field_topology.h>
#include <Quadrille/odeco_surface_field.h>

#include <CGAL/boost/graph/properties.h>
#include <boost/property_map/vector_property_map.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace Quadrille;
using namespace Quadrille_test;
using internal::Indexed_triangulation;

struct Field {
  Surface_field_result result;
  std::vector<Gradient_pair> gradients;
  std::vector<std::pair<Eigen::Vector3d, int>> singularities; ///< place and quarter index
  int index_sum = 0;
};

/// Where frames align, and the sizes there; nowhere by default.
struct Features {
  std::function<bool(const Space_triangles&, const Indexed_triangulation&, int)> is_feature;
  std::function<double(const Eigen::Vector3d&)> size = [](const Eigen::Vector3d&) { return 0; };
};

Field surface_field(const Space_triangles& triangles, const Surface_field_options& options,
                    const Features& features = {}, const Field_evaluator& evaluator = {})
{
  const Space_mesh mesh = triangles.surface_mesh();
  const internal::Mesh_index<Space_mesh> index(mesh);
  std::vector<Edge_frame_constraint> constraints(mesh.number_of_edges());
  std::vector<char> is_constrained(mesh.number_of_edges(), 0);
  for (std::size_t h = 0; features.is_feature && h < index.halfedge_of.size(); ++h) {
    const auto halfedge = index.halfedge_of[h];
    if (!features.is_feature(triangles, index.triangulation, int(h)))
      continue;
    const auto edge = mesh.edge(halfedge);
    const auto size = [&](Space_mesh::Vertex_index v) { return features.size(triangles.points[v]); };
    const auto along = mesh.halfedge(edge);
    constraints[edge] = {true, true, size(mesh.source(along)), size(mesh.target(along))};
    is_constrained[edge] = 1;
  }
  const auto map = [](auto& values) {
    return boost::make_iterator_property_map(values.begin(), boost::identity_property_map());
  };
  Field field;
  field.gradients.resize(mesh.number_of_faces());
  field.result = odeco_surface_field(mesh, mesh.points(), map(constraints), map(field.gradients), options, evaluator);

  const Surface_tangent_traits<Space_mesh, Space_mesh::Property_map<Space_mesh::Vertex_index, Space_mesh::Point>>
      traits(mesh, mesh.points());
  std::vector<int> matching(mesh.number_of_halfedges());
  const auto topology =
      frame_field_topology_with_traits(mesh, traits, map(field.gradients), map(is_constrained), map(matching));
  for (const auto& [v, quarters] : topology.singular_vertices)
    field.singularities.emplace_back(triangles.points[v], quarters);
  field.index_sum = topology.quarter_index_sum;
  return field;
}

Surface_field_options quick(int starts)
{
  Surface_field_options options;
  options.starts = starts;
  options.threads = 1;
  return options;
}
/// Chooses the last start, which is a melted one, if there is any.
double last_start(std::size_t start, const std::vector<Gradient_pair>&) { return -1e6 * double(start); }

Features creases(std::function<double(const Eigen::Vector3d&)> size) { return {is_crease, std::move(size)}; }

TEST(Odeco_surface_field, a_sphere_has_eight_singularities_of_valence_3)
{
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Surface_field_options options = quick(1);
    options.seed = seed;
    const Field field = surface_field(icosphere(7), options, {}, last_start);
    EXPECT_EQ(field.result.starts[std::size_t(field.result.chosen)].kind, Field_start::Kind::melted);
    EXPECT_EQ(field.index_sum, 8);
    ASSERT_EQ(field.singularities.size(), 8u);
    // They are near the corners of a cube, seen from whose centre the others are at these angles. A square antiprism,
    // where equal charges would go, has no opposite corners.
    const double half_turn = two_pi / 2, side = std::acos(1. / 3);
    const double expected[7] = {side, side, side, half_turn - side, half_turn - side, half_turn - side, half_turn};
    for (const auto& [place, quarters] : field.singularities) {
      EXPECT_EQ(quarters, 1);
      std::vector<double> angles;
      for (const auto& other : field.singularities)
        if (other.first != place)
          angles.push_back(std::atan2(place.cross(other.first).norm(), place.dot(other.first)));
      ASSERT_EQ(angles.size(), 7u);
      std::sort(angles.begin(), angles.end());
      for (std::size_t i = 0; i < 7; ++i)
        EXPECT_NEAR(angles[i], expected[i], two_pi / 24);
    }
  }
}

/// Without creases, all three axes different.
Space_triangles ellipsoid(int n)
{
  Space_triangles triangles = icosphere(n);
  for (Eigen::Vector3d& p : triangles.points)
    p = p.cwiseProduct(Eigen::Vector3d(1, 1.3, 1.8));
  return triangles;
}

TEST(Odeco_surface_field, minimises_the_sum_of_its_terms)
{
  for (const bool as_in_paper : {true, false})
    for (const Surface_field_weights weights :
         {Surface_field_weights::area_preserving(), Surface_field_weights::angle_preserving()}) {
      Surface_field_options options = quick(0);
      options.terms_as_in_paper = as_in_paper;
      options.weights = weights;
      const Surface_field_result result = surface_field(ellipsoid(6), options).result;
      const Surface_energy_terms& terms = result.terms;
      const double sum = terms.curl + terms.odeco + terms.sizes + terms.angles + terms.weak;
      EXPECT_GT(terms.odeco, 0);
      EXPECT_NEAR(result.energy, sum, 1e-9 * sum);
    }
}

TEST(Odeco_surface_field, relaxed_fields_that_come_from_coarse_triangles_are_not_worse)
{
  double energy[2];
  for (const bool coarse : {false, true}) {
    Surface_field_options options = quick(0);
    options.schedule.relax_triangles = coarse ? 150 : 1000000;
    const Field field = surface_field(ellipsoid(8), options);
    EXPECT_EQ(field.result.starts[std::size_t(field.result.chosen)].kind, Field_start::Kind::relaxed);
    EXPECT_EQ(field.index_sum, 8);
    energy[coarse ? 1 : 0] = field.result.energy;
  }
  EXPECT_LT(energy[1], 1.02 * energy[0]);
}

TEST(Odeco_surface_field, a_torus_needs_no_singularity)
{
  const Field field = surface_field(torus(24, 12, 2, 1), quick(0));
  EXPECT_EQ(field.singularities.size(), 0u);
  EXPECT_EQ(field.index_sum, 0);
}

TEST(Odeco_surface_field, a_cube_has_its_singularities_at_its_corners_only)
{
  const Field field = surface_field(cube(6), quick(1), creases([](const Eigen::Vector3d&) { return 0.2; }));
  EXPECT_EQ(field.index_sum, 8);
  ASSERT_EQ(field.singularities.size(), 8u);
  for (const auto& [place, quarters] : field.singularities) {
    EXPECT_EQ(quarters, 1);
    for (int i = 0; i < 3; ++i)
      EXPECT_TRUE(place[i] == 0 || place[i] == 1);
  }
  EXPECT_LT(field.result.energy, 1e-10);
  for (const auto& [du, dv] : field.gradients) {
    EXPECT_NEAR(du.norm(), 5, 1e-5);
    EXPECT_NEAR(dv.norm(), 5, 1e-5);
  }
}

TEST(Odeco_surface_field, sizes_change_between_the_features_of_a_cube)
{
  // They grow upwards; at the faces next to creases they are met.
  const auto size = [](const Eigen::Vector3d& p) { return 0.1 * (1 + 0.5 * p.z()); };
  const Space_triangles triangles = cube(8);
  const Field field = surface_field(triangles, quick(1), creases(size));
  for (std::size_t f = 0; f < triangles.faces.size(); ++f) {
    const auto& t = triangles.faces[f];
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d &p = triangles.points[std::size_t(t[std::size_t(i)])],
                            &q = triangles.points[std::size_t(t[std::size_t((i + 1) % 3)])];
      const bool on_crease = ((p - q).array() == 0).count() == 2 &&
                             ((p.array() == 0 || p.array() == 1) && p.array() == q.array()).count() == 2;
      if (!on_crease)
        continue;
      const auto& [du, dv] = field.gradients[f];
      const double expected = 1 / size(0.5 * (p + q));
      EXPECT_NEAR(std::sqrt(du.norm() * dv.norm()), expected, 0.1 * expected);
    }
  }
}

TEST(Odeco_surface_field, a_rectangle_in_space_has_the_constant_field)
{
  const Space_triangles lifted =
      moved(space_grid(8, 6, [](double s, double t) { return Eigen::Vector3d(4 * s, 3 * t, 0); }), some_rotation, 1,
            {1, 2, 3});
  const Features boundary{[](const auto&, const Indexed_triangulation& mesh, int h) { return mesh.is_boundary(h); },
                          [](const Eigen::Vector3d&) { return 0.5; }};
  const Field field = surface_field(lifted, quick(1), boundary);
  EXPECT_LT(field.result.energy, 1e-12);
  EXPECT_EQ(field.index_sum, 4);
  for (const auto& [du, dv] : field.gradients) {
    EXPECT_NEAR(du.norm(), 2, 1e-6);
    EXPECT_NEAR(dv.norm(), 2, 1e-6);
    EXPECT_NEAR(du.dot(dv), 0, 1e-6);
  }
}

TEST(Odeco_surface_field, moves_turns_and_scales_with_the_surface)
{
  const Space_triangles triangles = cube(6);
  const auto size = [](const Eigen::Vector3d& p) { return 0.1 * (1 + p.z()); };
  const Field plain = surface_field(triangles, quick(1), creases(size), last_start);
  ASSERT_EQ(plain.result.chosen, 2);
  const Field free = surface_field(torus(16, 8, 2, 1), quick(1), {}, last_start);
  for (const double scale : {1e8, 1e-8}) {
    const Space_triangles there = moved(triangles, some_rotation, scale, scale * Eigen::Vector3d(3, -2, 1));
    const auto size_there = [&](const Eigen::Vector3d& p) {
      return scale * size(some_rotation.transpose() * (p / scale - Eigen::Vector3d(3, -2, 1)));
    };
    const Field field = surface_field(there, quick(1), creases(size_there), last_start);
    const Field free_field = surface_field(moved(torus(16, 8, 2, 1), some_rotation, scale), quick(1), {}, last_start);
    for (const auto& [expected, found] : {std::pair(&plain, &field), std::pair(&free, &free_field)})
      for (std::size_t f = 0; f < expected->gradients.size(); ++f) {
        const auto& [du, dv] = expected->gradients[f];
        EXPECT_LT((scale * found->gradients[f].first - du).norm(), 1e-5 * du.norm());
        EXPECT_LT((scale * found->gradients[f].second - dv).norm(), 1e-5 * dv.norm());
      }
  }
}

TEST(Odeco_surface_field, is_the_same_for_every_number_of_threads)
{
  Surface_field_options options = quick(3);
  options.schedule.coarse_triangles = 200; // with a hierarchy
  const Space_triangles triangles = icosphere(5);
  const Field one = surface_field(triangles, options, {}, last_start);
  for (const int threads : {2, 5}) {
    options.threads = threads;
    const Field other = surface_field(triangles, options, {}, last_start);
    EXPECT_EQ(one.gradients, other.gradients);
    for (std::size_t i = 0; i < one.result.starts.size(); ++i)
      EXPECT_EQ(one.result.starts[i].energy, other.result.starts[i].energy);
  }
}

/// The same surface with its vertices and faces in another order.
Space_triangles relabelled(const Space_triangles& mesh, unsigned seed)
{
  std::mt19937 engine(seed);
  const auto shuffled = [&](std::size_t n) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t(0));
    for (std::size_t i = n; i > 1; --i)
      std::swap(order[i - 1], order[engine() % i]);
    return order;
  };
  const std::vector<std::size_t> place = shuffled(mesh.points.size());
  Space_triangles result = mesh;
  for (std::size_t v = 0; v < place.size(); ++v)
    result.points[place[v]] = mesh.points[v];
  const std::vector<std::size_t> face_place = shuffled(mesh.faces.size());
  for (std::size_t f = 0; f < face_place.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i)
      result.faces[face_place[f]][(i + f) % 3] = int(place[std::size_t(mesh.faces[f][i])]);
  return result;
}

TEST(Odeco_surface_field, does_not_depend_on_the_order_of_vertices_and_faces)
{
  const auto size = [](const Eigen::Vector3d& p) { return 0.1 * (1 + 0.5 * p.z()); };
  const Field field = surface_field(cube(6), quick(0), creases(size));
  for (const unsigned seed : {1u, 2u}) {
    const Field other = surface_field(relabelled(cube(6), seed), quick(0), creases(size));
    // As exactly as the minimisations go, whose last steps still save one part in 10^4 or 10^5.
    EXPECT_NEAR(other.result.energy, field.result.energy, 1e-5 * field.result.energy);
  }
}

/// A square in a plane, its border strongly aligned and of size 0.1, and its middle line weakly, with a size of its
/// own.
Field square_with_weak_line(double size, double weight)
{
  const Space_triangles square = space_grid(16, 16, [](double s, double t) { return Eigen::Vector3d(s, 0, t); });
  const Space_mesh mesh = square.surface_mesh();
  std::vector<Edge_frame_constraint> constraints(mesh.number_of_edges());
  for (const auto e : mesh.edges()) {
    const Eigen::Vector3d &p = square.points[mesh.vertex(e, 0)], &q = square.points[mesh.vertex(e, 1)];
    if (mesh.is_border(e))
      constraints[e] = {true, true, 0.1, 0.1};
    else if (p.x() == 0.5 && q.x() == 0.5)
      constraints[e] = {true, true, size, size, true};
  }
  const auto map = [](auto& values) {
    return boost::make_iterator_property_map(values.begin(), boost::identity_property_map());
  };
  Field field;
  field.gradients.resize(mesh.number_of_faces());
  Surface_field_options options = quick(0);
  options.weak_weight = weight;
  field.result = odeco_surface_field(mesh, mesh.points(), map(constraints), map(field.gradients), options);
  return field;
}

TEST(Odeco_surface_field, weak_constraints_are_met_as_far_as_nothing_is_against_them)
{
  // Where they agree with the rest they cost nothing, and change nothing.
  for (const auto& [u, v] : square_with_weak_line(0.1, 10).gradients) {
    EXPECT_NEAR(u.norm(), 10, 1e-6);
    EXPECT_NEAR(v.norm(), 10, 1e-6);
  }
  // Where they do not, they are met the better the larger their weight is.
  double last = HUGE_VAL;
  for (const double weight : {1., 10., 100.}) {
    const double energy = square_with_weak_line(0.08, weight).result.terms.weak / weight;
    EXPECT_LT(energy, 0.8 * last);
    EXPECT_GT(energy, 0);
    last = energy;
  }
}

/// Mean of |log(size / target)| over the faces of a square in space, without any constraint, whose target sizes grow
/// like exp(x): isotropic frames that turn by y have them exactly.
double error_of_conformal_sizes(int n, bool isotropic)
{
  const Space_triangles square =
      moved(space_grid(n, n, [](double s, double t) { return Eigen::Vector3d(s, t, 0); }), some_rotation);
  const auto target = [](const Eigen::Vector3d& p) { return 0.1 * std::exp((some_rotation.transpose() * p).x()); };
  Surface_field_options options = quick(0);
  options.isotropic = isotropic;
  for (const Eigen::Vector3d& p : square.points)
    options.target_size.push_back(target(p));
  const Field field = surface_field(square, options);
  double sum = 0;
  for (std::size_t f = 0; f < square.faces.size(); ++f) {
    const auto& t = square.faces[f];
    const Eigen::Vector3d center =
        (square.points[std::size_t(t[0])] + square.points[std::size_t(t[1])] + square.points[std::size_t(t[2])]) / 3;
    const auto& [du, dv] = field.gradients[f];
    sum += std::abs(std::log(std::sqrt(du.norm() * dv.norm()) * target(center)));
  }
  return sum / double(square.faces.size());
}

TEST(Odeco_surface_field, meets_target_sizes_that_are_integrable)
{
  for (const bool isotropic : {true, false}) {
    const double coarse = error_of_conformal_sizes(6, isotropic), fine = error_of_conformal_sizes(12, isotropic);
    EXPECT_LT(coarse, 0.04);
    EXPECT_LT(fine, 0.5 * coarse);
  }
}

TEST(Odeco_surface_field, takes_the_start_that_the_evaluator_chooses)
{
  const std::vector<double> costs = {0, 3, 1, 2, 2.8};
  Surface_field_options options = quick(3);
  options.size_deviation_weight = 0;
  const Space_triangles triangles = torus(12, 6, 2, 1);
  const auto cost = [&](std::size_t start, const auto&) { return costs[start]; };
  EXPECT_EQ(surface_field(triangles, options, {}, Field_evaluator(cost)).result.chosen, 2);
  std::vector<double> seen;
  const auto choose = [&](const std::vector<Field_start>& starts) {
    for (const Field_start& start : starts)
      seen.push_back(start.cost);
    return std::size_t(3);
  };
  const Field field = surface_field(triangles, options, {}, Field_evaluator(cost, choose));
  EXPECT_EQ(seen, costs);
  EXPECT_EQ(field.result.chosen, 3);
  EXPECT_EQ(field.result.energy, field.result.starts[3].energy);
}

TEST(Odeco_surface_field, takes_the_smooth_start_only_where_no_other_is_valid)
{
  Surface_field_options options = quick(1);
  const Field_evaluator evaluator([](std::size_t start, const auto&) { return start == 0 ? 0.0 : 1e9; });
  EXPECT_NE(surface_field(torus(12, 6, 2, 1), options, {}, evaluator).result.chosen, 0);
}

TEST(Odeco_surface_field, components_have_their_own_fields)
{
  const Field field = surface_field(united(torus(16, 8, 2, 1), moved(cube(3), some_rotation, 0.5, {9, 0, 0})), quick(0),
                                    creases([](const auto&) { return 0.1; }));
  EXPECT_EQ(field.index_sum, 8);
  ASSERT_EQ(field.singularities.size(), 8u);
  for (const auto& [place, quarters] : field.singularities) {
    EXPECT_GT(place.x(), 5);
    EXPECT_EQ(quarters, 1);
  }
}

template <class Error>
void expect_error(const Space_triangles& triangles, const Surface_field_options& options, const Features& features,
                  const std::string& text)
{
  try {
    surface_field(triangles, options, features);
    ADD_FAILURE() << "no error with " << text;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}

TEST(Odeco_surface_field, rejects_what_it_cannot_use)
{
  const Space_triangles good = cube(2);
  expect_error<Invalid_input_error>({}, quick(0), {}, "no triangles");
  for (const std::size_t f : {0u, 30u}) {
    Space_triangles degenerate = icosphere(3);
    const std::array<int, 3> t = degenerate.faces[f];
    degenerate.points[std::size_t(t[1])] =
        0.5 * (degenerate.points[std::size_t(t[0])] + degenerate.points[std::size_t(t[2])]);
    expect_error<Invalid_input_error>(degenerate, quick(0), {}, "triangle " + std::to_string(f) + " ");
  }
  Space_triangles not_a_number = good;
  not_a_number.points[3].y() = std::numeric_limits<double>::quiet_NaN();
  expect_error<Invalid_input_error>(not_a_number, quick(0), {}, "vertex 3 ");
  Surface_field_options options = quick(0);
  options.target_size.assign(good.points.size() - 1, 1);
  expect_error<Invalid_argument_error>(good, options, {}, std::to_string(good.points.size()) + " vertices");
  options.target_size.assign(good.points.size(), -1);
  expect_error<Invalid_argument_error>(good, options, {}, "target size -1");
  expect_error<Invalid_argument_error>(good, quick(0), creases([](const auto&) { return -2.; }), "size -2");
  expect_error<Invalid_argument_error>(good, quick(-1), {}, "starts");
  options = quick(0);
  options.typical_size = -1;
  expect_error<Invalid_argument_error>(good, options, {}, "typical size");
  options = quick(0);
  options.weights.area = -1;
  expect_error<Invalid_argument_error>(good, options, {}, "weights");
}

} // namespace
