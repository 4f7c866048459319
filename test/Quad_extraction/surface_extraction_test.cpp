// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "extraction_helpers.h"
#include "glued_surfaces.h"

#include <Quadrille/Quad_extraction/internal/Quad_shape_term.h>
#include <Quadrille/check_jacobian.h>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <map>
#include <random>

using namespace quad_extraction_test;
using namespace Quadrille::internal::extraction;

namespace {

using Quads = CGAL::Surface_mesh<Extracted_in<3>::Point>;
Eigen::Vector3d position(const Quads& quads, Quads::Vertex_index v)
{
  return {quads.point(v).x(), quads.point(v).y(), quads.point(v).z()};
}

struct Quality {
  double least_sine =
      std::numeric_limits<double>::infinity(); ///< of the corners' angles, seen along the quads' normals
  double skew = 0;                             ///< mean over the quads, in degrees
};

Quality quality(const Quads& quads)
{
  Quality result;
  for (const auto f : quads.faces()) {
    std::vector<Eigen::Vector3d> p;
    for (const auto v : quads.vertices_around_face(quads.halfedge(f)))
      p.push_back(position(quads, v));
    const Eigen::Vector3d normal = (p[2] - p[0]).cross(p[3] - p[1]).normalized();
    double skew = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector3d a = (p[(i + 1) % 4] - p[i]).normalized(), b = (p[(i + 3) % 4] - p[i]).normalized();
      result.least_sine = std::min(result.least_sine, a.cross(b).dot(normal));
      skew = std::max(skew, std::abs(90 - std::acos(a.dot(b)) * 180 / std::acos(-1.0)));
    }
    result.skew += skew / double(quads.number_of_faces());
  }
  return result;
}

} // namespace

TEST(Surface_extraction, a_sphere_has_eight_irregular_vertices_and_stays_round)
{
  const Extracted_in<3> extracted = extract(sphere().build());
  EXPECT_EQ(extracted.quads.number_of_faces(), 6U * 5 * 5);
  EXPECT_TRUE(CGAL::is_closed(extracted.quads));
  EXPECT_EQ(euler_characteristic(extracted.quads), 2);
  EXPECT_EQ(extracted.result.irregular_vertices, (std::map<int, int>{{3, 8}}));
  EXPECT_TRUE(extracted.result.curve_edges.empty());
  for (const auto v : extracted.quads.vertices()) {
    const double r = position(extracted.quads, v).norm();
    EXPECT_LT(r, 1 + 1e-12);
    EXPECT_GT(r, 0.985); // of the triangles, whose edges are up to 0.25 long
  }
  EXPECT_GT(quality(extracted.quads).least_sine, 0.8); // 120 degrees at the eight vertices
}

TEST(Surface_extraction, a_torus_without_any_vertex_to_start_from_becomes_a_grid)
{
  for (const double length : {0.5, 0.52}) {
    const Extracted_in<3> extracted = extract(torus(24, 12, length).build());
    EXPECT_EQ(extracted.quads.number_of_faces(), 12U * 6);
    EXPECT_TRUE(CGAL::is_closed(extracted.quads));
    EXPECT_EQ(euler_characteristic(extracted.quads), 0);
    EXPECT_TRUE(extracted.result.irregular_vertices.empty());
    EXPECT_LT(quality(extracted.quads).skew, 12); // quads on the inner side are trapezoids
  }
}

TEST(Surface_extraction, the_edges_of_a_cube_are_chains_of_edges)
{
  Glued_rectangles_in_space domain = cube();
  domain.curve = [](int a, int b, bool) { return 8 * std::min(a, b) + std::max(a, b); };
  const Extracted_in<3> extracted = extract(domain.build());
  EXPECT_EQ(extracted.quads.number_of_faces(), 6U * 5 * 5);
  EXPECT_EQ(extracted.result.curve_edges.size(), 12U * 5);
  for (const auto& edge : extracted.result.curve_edges) {
    EXPECT_FALSE(edge.border);
    const Eigen::Vector3d p = position(extracted.quads, Quads::Vertex_index(unsigned(edge.source)));
    const Eigen::Vector3d q = position(extracted.quads, Quads::Vertex_index(unsigned(edge.target)));
    EXPECT_EQ(((p + q).array().abs() > 2 - 1e-12).count(), 2) << "the edge does not lie on an edge of the cube";
    EXPECT_NEAR((p - q).norm(), 0.4, 1e-5);
  }
  EXPECT_LT(quality(extracted.quads).skew, 1e-3);
}

TEST(Surface_extraction, a_domain_that_is_moved_into_space_has_the_planar_quads)
{
  Glued_rectangles planar = star(5);
  const Mapped_mesh flat = planar.build();
  const Eigen::Matrix3d R = Eigen::Quaterniond(0.3, -0.6, 0.5, 0.2).normalized().toRotationMatrix();
  const Extracted_in<2> expected = extract(flat);
  for (const double scale : {1.0, 1e8, 1e-8}) {
    Mapped_mesh_in<3> moved;
    moved.triangles = flat.triangles;
    moved.corner_uv = flat.corner_uv;
    moved.curve = flat.curve;
    moved.region = flat.region;
    const auto place = [&](double x, double y) -> Eigen::Vector3d {
      return scale * (R * Eigen::Vector3d(x, y, 0) + Eigen::Vector3d(3, -1, 7));
    };
    for (const Point& p : flat.points) {
      const Eigen::Vector3d q = place(p[0], p[1]);
      moved.points.push_back({q[0], q[1], q[2]});
    }
    const Extracted_in<3> extracted = extract(moved);
    ASSERT_EQ(extracted.quads.number_of_vertices(), expected.quads.number_of_vertices());
    ASSERT_EQ(extracted.quads.number_of_faces(), expected.quads.number_of_faces());
    for (const auto v : expected.quads.vertices()) {
      const Eigen::Vector3d q = place(expected.quads.point(v).x(), expected.quads.point(v).y());
      EXPECT_LT((position(extracted.quads, Quads::Vertex_index(unsigned(v.idx()))) - q).norm(), 2e-2 * scale);
    }
  }
}

TEST(Surface_extraction, does_not_depend_on_the_number_of_threads)
{
  Quadrille::Quad_extraction_options options;
  const Extracted_in<3> one = extract(sphere().build(), options);
  options.threads = 3;
  const Extracted_in<3> three = extract(sphere().build(), options);
  for (const auto v : one.quads.vertices())
    EXPECT_EQ(position(one.quads, v), position(three.quads, v));
}

TEST(Surface_projection, stays_on_its_side_of_a_thin_wall_and_of_a_curve)
{
  // A strip that is folded around an edge: up to x = 4 in the plane z = 0, and back in the plane z = 0.1.
  Glued_rectangles_in_space strip;
  for (const double y : {0., 1.})
    for (const Place p : {Place{0, y, 0}, Place{2, y, 0}, Place{4, y, 0}, Place{4, y, 0.1}, Place{0, y, 0.1}})
      strip.corners.push_back(p);
  for (int i = 0; i < 4; ++i)
    strip.cells.push_back({i, i + 1, i + 6, i + 5});
  strip.curve = [](int a, int b, bool border) { return border || (a % 5 == 1 && b % 5 == 1) ? 0 : -1; };
  const Mapped_mesh_in<3> mesh = strip.build();
  const Quadrille::internal::Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  const Seamless_map map(triangulation, mesh.corner_uv, mesh.curve, mesh.region);
  std::vector<Eigen::Vector3d> points;
  for (const Place& p : mesh.points)
    points.emplace_back(p[0], p[1], p[2]);
  const Surface_projection surface(map, points);
  const auto face_near = [&](const Eigen::Vector3d& p) {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int f = 0; f < triangulation.number_of_faces(); ++f) {
      const auto& t = triangulation.triangle(f);
      const Eigen::Vector3d center =
          (points[std::size_t(t[0])] + points[std::size_t(t[1])] + points[std::size_t(t[2])]) / 3;
      if (std::abs(center[2] - p[2]) < 1e-9 && (center - p).norm() < least) {
        least = (center - p).norm();
        best = f;
      }
    }
    return best;
  };
  const int lower = face_near({2.5, 0.5, 0});
  // Nearer to the upper sheet, but reached from the lower one.
  EXPECT_LT((surface.nearest(lower, {3.1, 0.4, 0.08}).point - Eigen::Vector3d(3.1, 0.4, 0)).norm(), 1e-12);
  // Around the fold.
  EXPECT_LT((surface.nearest(lower, {4.2, 0.4, 0.05}).point - Eigen::Vector3d(4, 0.4, 0.05)).norm(), 1e-12);
  // Not across the curve at x = 2.
  EXPECT_LT((surface.nearest(lower, {1.5, 0.4, 0.01}).point - Eigen::Vector3d(2, 0.4, 0)).norm(), 1e-12);
  EXPECT_LT(surface.normal(lower).dot(surface.normal(face_near({2.5, 0.5, 0.1}))), -0.99);
}

TEST(Quad_shape_term, jacobian_in_space_agrees_with_differences)
{
  Indexed_quads<3> quads;
  quads.points = {{0, 0, 0.1}, {1.2, 0.1, 0}, {1.3, 0.9, 0.2}, {-0.1, 1.1, -0.1}};
  quads.vertices.resize(4);
  quads.quads = {{0, 1, 2, 3}};
  quads.target = {{0.9, 1.2}};
  std::vector<Eigen::Vector3d> arc;
  for (int i = 0; i <= 10; ++i)
    arc.emplace_back(2 * std::cos(0.2 * i), 2 * std::sin(0.2 * i) - 1, 0.1 * i);
  quads.curves.emplace_back(arc, false, 0);
  quads.vertices[2].chain = 0;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-0.1, 0.1);
  Quad_frames<3> frames;
  const auto basis = [&] {
    const Eigen::Vector3d normal = Eigen::Vector3d(noise(random), noise(random), 1).normalized();
    Eigen::Matrix<double, 3, 2> result;
    result << normal.unitOrthogonal(), normal.cross(normal.unitOrthogonal());
    return result;
  };
  frames.plane.push_back(basis().transpose());
  for (int v = 0; v < 4; ++v)
    frames.tangent.push_back(basis());
  using Term = Quad_shape_term<3>;
  using Motion = Term::Motion;
  Term term(quads, frames, {Motion::free, Motion::free, Motion::on_curve, Motion::free}, 0.5, 0.7, 2);
  for (const double eps : {0.0, 0.3, 1.0})
    for (int run = 0; run < 20; ++run) {
      term.set_eps(eps);
      Eigen::VectorXd x = term.unknowns();
      EXPECT_EQ(x[0], 0);
      x[4] = 3.3; // arc length 1.65
      Term::Unknowns local = Term::Unknowns::Zero();
      for (int i = 0; i < x.size(); ++i)
        local[i] = x[i] + noise(random);
      EXPECT_LT(Quadrille::jacobian_error(term, 0, local, 1e-4), 1e-6);
    }
}
