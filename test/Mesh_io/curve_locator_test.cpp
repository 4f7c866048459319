// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Nearest places on curves and triangles.

#include "quad_test_meshes.h"

#include <Quadrille/Curve_locator.h>
#include <Quadrille/Planar_domain.h>
#include <Quadrille/Surface_domain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>

using namespace Quadrille;

namespace {

TEST(Nearest_tree, knows_degenerate_triangles)
{
  using internal::Space_kernel;
  for (const double scale : {1.0, -1.0, 1e8, 1e-8}) {
    const auto point = [&](double x, double y, double z) {
      return Space_kernel::Point_3(scale * x, scale * y, scale * z);
    };
    const internal::Nearest_tree<Space_kernel::Triangle_3> tree(
        {{point(0, 0, 0), point(1, 1, 1), point(3, 3, 3)}, {point(9, 9, 9), point(9, 9, 9), point(9, 9, 9)}});
    EXPECT_NEAR(tree.nearest(point(3, 1, 2)).distance / std::abs(scale), std::sqrt(2.0), 1e-12);
    EXPECT_EQ(tree.nearest(point(3, 1, 2)).index, 0u);
    EXPECT_NEAR(tree.nearest(point(8, 9, 9)).distance / std::abs(scale), 1, 1e-12);
    EXPECT_EQ(tree.nearest(point(8, 9, 9)).index, 1u);
  }
}

/// The locator against a search among all edges.
template <class Domain> void expect_nearest(const Domain& domain)
{
  using Point = typename Domain::Mesh::Point;
  const Curve_locator locator(domain);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1.5, 1.5);
  for (int i = 0; i < 300; ++i) {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    Point p;
    if constexpr (Domain::dimension == 2)
      p = Point(x, y);
    else
      p = Point(x, y, z);
    const int chain = i % (domain.number_of_chains + 1) - 1;
    double least = std::numeric_limits<double>::infinity();
    for (const auto e : domain.mesh.edges()) {
      const int c = domain.edge_chain[std::size_t(e.idx())];
      if (c < 0 || (chain >= 0 && c != chain))
        continue;
      const auto h = domain.mesh.halfedge(e);
      const Point a = domain.mesh.point(domain.mesh.source(h)), b = domain.mesh.point(domain.mesh.target(h));
      const double t = std::clamp((p - a) * (b - a) / (b - a).squared_length(), 0.0, 1.0);
      least = std::min(least, std::sqrt((p - a - t * (b - a)).squared_length()));
    }
    const auto place = locator.nearest(p, chain);
    EXPECT_NEAR(place.distance, least, 1e-12);
    const auto h = domain.mesh.halfedge(place.edge);
    const Point a = domain.mesh.point(domain.mesh.source(h)), b = domain.mesh.point(domain.mesh.target(h));
    EXPECT_NEAR(std::sqrt((p - a - place.parameter * (b - a)).squared_length()), least, 1e-12);
    if (chain >= 0) {
      EXPECT_EQ(domain.edge_chain[std::size_t(place.edge.idx())], chain);
    }
  }
}

TEST(Curve_locator, finds_the_nearest_place_in_the_plane_and_in_space)
{
  expect_nearest(make_surface_domain(cube_of_quads(3), "cube"));
  // Four triangles of a square with a curve on one diagonal.
  Labelled_mesh square =
      quads({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 0}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  square.lines = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {4, 2}};
  square.line_curve = {0, 1, 2, 3, 4, 4};
  square.curves = {{1, {}}, {2, {}}, {3, {}}, {4, {}}, {5, {}}};
  expect_nearest(make_planar_domain(square, "square"));
}

TEST(Curve_locator, of_a_surface_without_curves_finds_nothing)
{
  const Surface_domain domain = make_surface_domain(sphere_of_quads(8), "sphere");
  const auto place = Curve_locator(domain).nearest({1, 2, 3});
  EXPECT_EQ(place.distance, std::numeric_limits<double>::infinity());
  EXPECT_EQ(place.edge, Surface_domain::Mesh::null_edge());
}

} // namespace
