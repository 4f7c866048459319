// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Planar_domain.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace Quadrille;

namespace {

/// A convex polygon without inner points: all inner edges are chords, from its first point.
Labelled_mesh fan(int n, double scale)
{
  Labelled_mesh mesh;
  for (int i = 0; i < n; ++i)
    mesh.points.push_back({scale * std::cos(2 * CGAL_PI * i / n), scale * std::sin(2 * CGAL_PI * i / n), 0});
  for (int i = 1; i + 1 < n; ++i)
    mesh.polygons.push_back({0, i, i + 1});
  return mesh;
}

double area(const Planar_domain& domain)
{
  double sum = 0;
  for (const auto f : domain.mesh.faces()) {
    const auto h = domain.mesh.halfedge(f);
    sum += CGAL::area(domain.mesh.point(domain.mesh.source(h)), domain.mesh.point(domain.mesh.target(h)),
                      domain.mesh.point(domain.mesh.target(domain.mesh.next(h))));
  }
  return sum;
}

TEST(Split_chords, no_inner_edge_joins_two_points_of_curves)
{
  for (const double scale : {1.0, 1e8, 1e-8}) {
    Planar_domain_options options;
    const Planar_domain domain = make_planar_domain(fan(9, scale), "fan", options);
    options.split_chords = false;
    const Planar_domain plain = make_planar_domain(fan(9, scale), "fan", options);
    EXPECT_EQ(plain.number_of_split_chords, 0);
    EXPECT_EQ(plain.mesh.number_of_faces(), 7u);
    EXPECT_EQ(domain.number_of_split_chords, 6);
    EXPECT_EQ(domain.mesh.number_of_faces(), 7u + 2u * 6u);
    EXPECT_NEAR(area(domain), area(plain), 1e-12 * area(plain));
    for (const auto v : plain.mesh.vertices())
      EXPECT_EQ(domain.mesh.point(v), plain.mesh.point(v)); // numbers are kept
    for (const auto e : domain.mesh.edges()) {
      const auto h = domain.mesh.halfedge(e);
      EXPECT_TRUE(domain.edge_curve[e.idx()] >= 0 || !domain.mesh.is_border(domain.mesh.source(h)) ||
                  !domain.mesh.is_border(domain.mesh.target(h)));
    }
  }
}

TEST(Split_chords, regions_and_feature_lines_are_kept)
{
  // A square of two triangles in two regions, with a line between them; and with that line, there is no chord.
  Labelled_mesh square;
  square.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.polygons = {{0, 1, 2}, {0, 2, 3}};
  square.polygon_region = {0, 1};
  square.regions = {{1, {"left"}}, {2, {"right"}}};
  const Planar_domain split = make_planar_domain(square, "square");
  EXPECT_EQ(split.number_of_split_chords, 1);
  ASSERT_EQ(split.face_region.size(), 4u);
  for (const auto f : split.mesh.faces()) {
    const auto h = split.mesh.halfedge(f);
    double x_minus_y = 0;
    for (const auto v : {split.mesh.source(h), split.mesh.target(h), split.mesh.target(split.mesh.next(h))})
      x_minus_y += split.mesh.point(v).x() - split.mesh.point(v).y();
    EXPECT_EQ(split.face_region[f.idx()], x_minus_y > 0 ? 0 : 1);
  }
  square.lines = {{0, 2}};
  square.line_curve = {0};
  square.curves = {{7, {"middle"}}};
  EXPECT_EQ(make_planar_domain(square, "square").number_of_split_chords, 0);
}

TEST(Split_chords, sharp_corners_stay_whole)
{
  Labelled_mesh wedge; // a corner of 11 degrees, cut off by a chord; the next chord is not at the corner
  wedge.points = {{0, 0, 0}, {1, 0, 0}, {1, 0.2, 0}, {2, 0, 0}, {2, 0.4, 0}};
  wedge.polygons = {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}};
  const Planar_domain domain = make_planar_domain(wedge, "wedge");
  EXPECT_EQ(domain.number_of_split_chords, 1);
  EXPECT_EQ(domain.mesh.number_of_faces(), 5u);
}

} // namespace
