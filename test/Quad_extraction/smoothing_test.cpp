// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "extraction_helpers.h"

#include <Quadrille/check_jacobian.h>
#include <Quadrille/quad_smoothing.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

using namespace quad_extraction_test;
using namespace Quadrille::internal::extraction;

namespace {

const Quad_frames<2> plane;

/// A grid of n x n quads of the unit square, each inner vertex moved by up to `noise` cells.
Mesh noisy_grid(int n, double noise, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-noise / n, noise / n);
  Mesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const bool inner = i > 0 && i < n && j > 0 && j < n;
      const double dx = shift(random), dy = shift(random);
      mesh.add_vertex(Point_2(double(i) / n + (inner ? dx : 0), double(j) / n + (inner ? dy : 0)));
    }
  const auto vertex = [n](int i, int j) { return Mesh::Vertex_index(unsigned(j * (n + 1) + i)); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      mesh.add_face(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
  return mesh;
}

auto corners_fixed(Mesh& mesh)
{
  auto fixed = mesh.add_property_map<Mesh::Vertex_index, bool>("v:fixed", false).first;
  for (const auto v : mesh.vertices())
    fixed[v] = mesh.is_border(v) && mesh.degree(v) == 2;
  return fixed;
}

} // namespace

TEST(Quad_shape_term, jacobian_agrees_with_differences)
{
  Indexed_quads<2> quads;
  quads.points = {{0, 0}, {1.2, 0.1}, {1.3, 0.9}, {-0.1, 1.1}};
  quads.vertices.resize(4);
  quads.quads = {{0, 1, 2, 3}};
  quads.target = {{0.9, 1.2}};
  std::vector<Eigen::Vector2d> arc;
  for (int i = 0; i <= 10; ++i)
    arc.emplace_back(2 * std::cos(0.2 * i), 2 * std::sin(0.2 * i) - 1);
  quads.curves.emplace_back(arc, false, 0);
  quads.vertices[2].chain = 0;
  using Motion = Quad_shape_term<2>::Motion;
  Quad_shape_term<2> term(quads, plane, {Motion::free, Motion::free, Motion::on_curve, Motion::free}, 0.5, 0.7, 2);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-0.1, 0.1);
  for (const double eps : {0.0, 0.3, 1.0})
    for (int run = 0; run < 20; ++run) {
      term.set_eps(eps);
      Eigen::VectorXd x = term.unknowns();
      x[4] = 3.3; // arc length 1.65
      Quad_shape_term<2>::Unknowns local = Quad_shape_term<2>::Unknowns::Zero();
      for (int i = 0; i < x.size(); ++i)
        local[i] = x[i] + noise(random);
      if (eps > 0 && run % 2)
        std::swap(local[0], local[2]); // inverted corners
      EXPECT_LT(Quadrille::jacobian_error(term, 0, local, 1e-4), 1e-6);
    }
}

TEST(Quad_shape_term, jacobian_of_steps_agrees_with_differences)
{
  Indexed_quads<2> quads;
  quads.points = {{0, 0}, {1, 0}, {2, 0}, {3, 0}};
  quads.vertices.resize(4);
  quads.curves.emplace_back(std::vector<Eigen::Vector2d>{{0, 0}, {4, 0}}, false, 0);
  for (int v = 0; v < 4; ++v) {
    quads.vertices[std::size_t(v)].chain = 0;
    quads.vertices[std::size_t(v)].position = v;
  }
  using Motion = Quad_shape_term<2>::Motion;
  const std::vector<Curve_step> steps = {
      {-1, 1, 0, 0.7}, {1, 2, 0, 1.1}, {2, 3, 0, 0.9}, {2, -1, 4, 1.9}, {-1, 0, 0, 1}};
  Quad_shape_term<2> term(quads, plane, {Motion::fixed, Motion::on_curve, Motion::on_curve, Motion::fixed}, 0.5, 0.7, 2,
                          steps);
  ASSERT_EQ(term.number_of_elements(), 4u); // the last step has no end that slides
  std::array<int, Quad_shape_term<2>::max_unknowns> index;
  EXPECT_EQ(term.element_unknowns(0, index), 1);
  EXPECT_EQ(term.element_unknowns(1, index), 2);
  Quad_shape_term<2>::Residuals r;
  for (const double eps : {0.0, 0.1, 1.0})
    for (std::size_t e = 0; e < 4; ++e) {
      term.set_eps(eps);
      const int n = term.element_unknowns(e, index);
      Quad_shape_term<2>::Unknowns local = Quad_shape_term<2>::Unknowns::Zero();
      for (int i = 0; i < n; ++i)
        local[i] = term.unknowns()[index[std::size_t(i)]] + 0.1 * i;
      EXPECT_LT(Quadrille::jacobian_error(term, e, local, 1e-4), 1e-6);
      if (e != 1)
        continue;
      std::swap(local[0], local[1]); // the wrong way round
      EXPECT_EQ(term.evaluate(e, local, r, nullptr), eps > 0);
      if (eps > 0) {
        EXPECT_LT(Quadrille::jacobian_error(term, e, local, 1e-4), 1e-6);
      }
    }
}

TEST(Quad_shape_term, vanishes_for_the_target_alone)
{
  Indexed_quads<2> quads;
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(2.0, 0.0), std::pair(2.0, 3.0), std::pair(0.0, 3.0)})
    quads.points.emplace_back(5 + c * x - s * y, 7 + s * x + c * y);
  quads.vertices.resize(4);
  quads.quads = {{0, 1, 2, 3}};
  quads.target = {{2, 3}};
  Quad_shape_term<2> term(quads, plane, std::vector<Quad_shape_term<2>::Motion>(4, Quad_shape_term<2>::Motion::free), 1,
                          1, 1);
  const Quad_shape_term<2>::Unknowns x = term.unknowns();
  Quad_shape_term<2>::Residuals r;
  ASSERT_TRUE(term.evaluate(0, x, r, nullptr));
  EXPECT_LT(r.norm(), 1e-14);
  Quad_shape_term<2>::Unknowns sheared = x;
  sheared[4] += 0.5;
  ASSERT_TRUE(term.evaluate(0, sheared, r, nullptr));
  EXPECT_GT(r.norm(), 0.05);
  sheared[4] -= 100;
  EXPECT_FALSE(term.evaluate(0, sheared, r, nullptr)); // inverted
}

TEST(Polyline_curve, smooth_curve_is_fourth_order_on_a_circle)
{
  const auto error = [](int n, bool closed) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i <= n; ++i) {
      const double angle = (closed ? 2 * std::acos(-1.0) : 1.0) * i / n;
      points.emplace_back(std::cos(angle), std::sin(angle));
    }
    const Polyline_curve<2> curve(points, closed, 0);
    double largest = 0;
    for (int i = 0; i <= 1000; ++i) {
      const auto [p, tangent] = curve.smooth(curve.length() * i / 1000);
      largest = std::max(largest, std::abs(p.norm() - 1));
      const double h = 1e-6 * curve.length();
      const double t = curve.length() * (i + 0.5) / 1001;
      const Eigen::Vector2d difference = (curve.smooth(t + h).first - curve.smooth(t - h).first) / (2 * h);
      EXPECT_LT((difference - curve.smooth(t).second).norm(), 1e-3);
    }
    return largest;
  };
  EXPECT_LT(error(40, true), error(20, true) / 12);
  EXPECT_LT(error(40, true), 1e-4);
  EXPECT_LT(error(20, false), error(10, false) / 5);
}

TEST(Polyline_curve, keeps_kinks)
{
  const Polyline_curve<2> curve({{0, 0}, {1, 0}, {1, 1}}, false, 0);
  EXPECT_NEAR((curve.smooth(0.5).first - Eigen::Vector2d(0.5, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((curve.smooth(1.0).first - Eigen::Vector2d(1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((curve.smooth(1.7).first - Eigen::Vector2d(1, 0.7)).norm(), 0, 1e-15);
}

TEST(Smooth_quads, recovers_the_uniform_grid)
{
  Mesh mesh = noisy_grid(8, 1.5, 5); // neighbours change places
  ASSERT_FALSE(has_convex_quads(mesh));
  const auto fixed = corners_fixed(mesh);
  auto targets = mesh.add_property_map<Mesh::Face_index, std::pair<double, double>>("f:target", {1, 1}).first;
  Quadrille::Quad_smoothing_options options;
  options.relative_decrease = 1e-12;
  const auto report = Quadrille::smooth_quads(mesh, mesh.points(), fixed, targets, options);
  EXPECT_TRUE(has_convex_quads(mesh));
  EXPECT_EQ(report.inverted_quads, 0);
  EXPECT_GT(report.untangling_iterations, 0);
  for (const auto v : mesh.vertices()) {
    EXPECT_NEAR(mesh.point(v).x(), double(v.idx() % 9) / 8, 1e-5);
    EXPECT_NEAR(mesh.point(v).y(), double(v.idx() / 9) / 8, 1e-5);
  }
}

TEST(Smooth_quads, gives_up_what_cannot_be_untangled_while_another_part_is_good)
{
  Mesh mesh = noisy_grid(6, 0, 1);
  const unsigned n = unsigned(mesh.number_of_vertices());
  // A second part, with two neighbours that are fixed in each other's places.
  const Mesh other = noisy_grid(6, 0, 1);
  for (const auto v : other.vertices())
    mesh.add_vertex(other.point(v) + Mesh::Point::R::Vector_2(3, 0));
  for (const auto f : other.faces()) {
    std::vector<Mesh::Vertex_index> corners;
    for (const auto v : other.vertices_around_face(other.halfedge(f)))
      corners.emplace_back(n + unsigned(v));
    mesh.add_face(corners);
  }
  auto fixed = corners_fixed(mesh);
  const Mesh::Vertex_index a(n + 24), b(n + 25);
  std::swap(mesh.point(a), mesh.point(b));
  fixed[a] = fixed[b] = true;
  for (const auto f : mesh.faces_around_target(mesh.halfedge(a)))
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      fixed[v] = true; // so that nothing can make room
  const auto report = Quadrille::smooth_quads(mesh, mesh.points(), fixed);
  EXPECT_GT(report.inverted_quads, 0);
  for (unsigned v = 0; v < n; ++v) {
    EXPECT_NEAR(mesh.point(Mesh::Vertex_index(v)).x(), double(v % 7) / 6, 1e-9);
    EXPECT_NEAR(mesh.point(Mesh::Vertex_index(v)).y(), double(v / 7) / 6, 1e-9);
  }
}

TEST(Smooth_quads, border_vertices_slide_to_the_wanted_sizes)
{
  const int n = 12;
  Mesh mesh = noisy_grid(n, 0, 1);
  const auto fixed = corners_fixed(mesh);
  auto targets = mesh.add_property_map<Mesh::Face_index, std::pair<double, double>>("f:target").first;
  double total = 0;
  for (int i = 0; i < n; ++i)
    total += std::pow(1.2, i);
  for (const auto f : mesh.faces())
    targets[f] = {std::pow(1.2, int(f.idx()) % n) / total, 1.0 / n};
  // halfedge(f) may be any side: hand the lengths over accordingly.
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    if (std::abs(mesh.point(mesh.source(h)).x() - mesh.point(mesh.target(h)).x()) < 1e-9)
      std::swap(targets[f].first, targets[f].second);
  }
  Quadrille::Quad_smoothing_options options;
  options.relative_decrease = 1e-12;
  Quadrille::smooth_quads(mesh, mesh.points(), fixed, targets, options);
  double x = 0;
  for (int i = 0; i <= n; ++i) {
    EXPECT_NEAR(mesh.point(Mesh::Vertex_index(unsigned(i))).x(), x, 1e-4);
    EXPECT_EQ(mesh.point(Mesh::Vertex_index(unsigned(i))).y(), 0);
    x += std::pow(1.2, i) / total;
  }
}

TEST(Smooth_quads, keeps_fixed_vertices_and_a_good_mesh)
{
  Mesh mesh = noisy_grid(5, 0.3, 2);
  auto fixed = corners_fixed(mesh);
  const Mesh::Vertex_index inner(14);
  fixed[inner] = true;
  const Point_2 before = mesh.point(inner);
  const auto report = Quadrille::smooth_quads(mesh, mesh.points(), fixed);
  EXPECT_EQ(mesh.point(inner), before);
  EXPECT_EQ(report.inverted_quads, 0);
  EXPECT_TRUE(has_convex_quads(mesh));
}

TEST(Smooth_quads, closed_border_without_fixed_vertices)
{
  // One ring of quads between two circles.
  const int n = 24;
  const double pi = std::acos(-1.0);
  Mesh mesh;
  for (const double radius : {1.0, 1.3})
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * pi * (i + 0.3 * std::sin(5.0 * i)) / n;
      mesh.add_vertex(Point_2(radius * std::cos(angle), radius * std::sin(angle)));
    }
  for (int i = 0; i < n; ++i) {
    const auto vertex = [](int k) { return Mesh::Vertex_index(unsigned(k)); };
    mesh.add_face(vertex(i), vertex(n + i), vertex(n + (i + 1) % n), vertex((i + 1) % n));
  }
  const auto fixed = mesh.add_property_map<Mesh::Vertex_index, bool>("v:fixed", false).first;
  auto targets = mesh.add_property_map<Mesh::Face_index, std::pair<double, double>>("f:target", {1, 1}).first;
  Quadrille::smooth_quads(mesh, mesh.points(), fixed, targets);
  EXPECT_TRUE(has_convex_quads(mesh));
  double least = 10, largest = 0;
  for (int i = 0; i < n; ++i) {
    const double length = std::sqrt(CGAL::squared_distance(mesh.point(Mesh::Vertex_index(unsigned(i))),
                                                           mesh.point(Mesh::Vertex_index(unsigned((i + 1) % n)))));
    least = std::min(least, length);
    largest = std::max(largest, length);
  }
  EXPECT_LT(largest / least, 1.15);
}

TEST(Smooth_quads, rejects_bad_input)
{
  Mesh empty;
  const auto none = corners_fixed(empty);
  EXPECT_THROW(Quadrille::smooth_quads(empty, empty.points(), none), Quadrille::Invalid_input_error);

  Mesh mesh = noisy_grid(2, 0, 1);
  const auto fixed = corners_fixed(mesh);
  auto targets = mesh.add_property_map<Mesh::Face_index, std::pair<double, double>>("f:target", {1, 0}).first;
  EXPECT_THROW(Quadrille::smooth_quads(mesh, mesh.points(), fixed, targets), Quadrille::Invalid_input_error);

  Mesh clockwise = noisy_grid(2, 0, 1);
  for (const auto v : clockwise.vertices())
    clockwise.point(v) = Point_2(-clockwise.point(v).x(), clockwise.point(v).y());
  EXPECT_THROW(Quadrille::smooth_quads(clockwise, clockwise.points(), corners_fixed(clockwise)),
               Quadrille::Invalid_input_error);

  Mesh triangle;
  triangle.add_face(triangle.add_vertex(Point_2(0, 0)), triangle.add_vertex(Point_2(1, 0)),
                    triangle.add_vertex(Point_2(0, 1)));
  const auto free = triangle.add_property_map<Mesh::Vertex_index, bool>("v:fixed", false).first;
  EXPECT_THROW(Quadrille::smooth_quads(triangle, triangle.points(), free), Quadrille::Invalid_input_error);
}
