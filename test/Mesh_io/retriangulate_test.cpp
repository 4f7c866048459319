// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Mesh_io/internal/retriangulate.h>
#include <Quadrille/read_planar_domain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>
#include <vector>

using namespace Quadrille::internal;

namespace {

/// A square of side 8 with a square hole of side 2 and, around that, a surface of its own of side 4; points in all of
/// them, among them some that cannot be used.
struct Nested_squares {
  std::vector<Point_2> points;
  std::vector<Numbered_segment> segments;
  std::vector<std::vector<int>> surfaces;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> regions;
  std::size_t n_good; ///< the first ones of the points

  Nested_squares()
  {
    const std::vector<std::vector<int>> bounded = {{0}, {0, 1}, {1}};
    const int half[] = {4, 2, 1};
    for (std::size_t k = 0; k < 3; ++k) {
      const int first = int(points.size()), n = 8 * half[k];
      for (int i = 0; i < n; ++i) { // one unit after the other
        const int x = i % (2 * half[k]) - half[k], side = i / (2 * half[k]);
        const std::array<Point_2, 4> p = {Point_2(x, -half[k]), Point_2(half[k], x), Point_2(-x, half[k]),
                                          Point_2(-half[k], -x)};
        points.push_back(p[std::size_t(side)]);
        segments.push_back({{first + i, first + (i + 1) % n}});
        surfaces.push_back(bounded[k]);
      }
    }
    n_good = points.size() + 5;
    for (const auto& [x, y] : {std::pair(3.0, 0.5),
                               {-3.0, 0.25},
                               {0.5, 3.0},
                               {1.5, 0.0},
                               {0.0, -1.5}, // good ones
                               {9.0, 0.0},
                               {4.0, 0.5},
                               {3.9, 0.5},
                               {3.0, 0.5},
                               {0.0, 0.0}})
      points.emplace_back(x, y);
    Retriangulation(points, segments, surfaces).collect(triangles, regions);
  }

  Point_2 corner(std::size_t t, std::size_t i) const { return points[std::size_t(triangles[t][i])]; }
};

} // namespace

TEST(Retriangulation, covers_each_surface_once)
{
  const Nested_squares squares;
  double area[] = {0, 0};
  for (std::size_t t = 0; t < squares.triangles.size(); ++t) {
    EXPECT_EQ(CGAL::orientation(squares.corner(t, 0), squares.corner(t, 1), squares.corner(t, 2)),
              CGAL::COUNTERCLOCKWISE);
    area[squares.regions[t]] += CGAL::area(squares.corner(t, 0), squares.corner(t, 1), squares.corner(t, 2));
  }
  EXPECT_DOUBLE_EQ(area[0], 64 - 16);
  EXPECT_DOUBLE_EQ(area[1], 16 - 4);
}

TEST(Retriangulation, has_the_segments_and_is_delaunay_elsewhere)
{
  const Nested_squares squares;
  std::set<std::pair<int, int>> edges;
  for (const auto& t : squares.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_TRUE(edges.emplace(t[i], t[(i + 1) % 3]).second);
  for (const Numbered_segment& segment : squares.segments)
    EXPECT_EQ(edges.count({segment.ends[0], segment.ends[1]}) + edges.count({segment.ends[1], segment.ends[0]}) > 0,
              true);
  const auto is_delaunay = [&](std::size_t t, std::size_t other) {
    const auto& b = squares.triangles[other];
    return std::none_of(b.begin(), b.end(), [&](int v) {
      return CGAL::side_of_oriented_circle(squares.corner(t, 0), squares.corner(t, 1), squares.corner(t, 2),
                                           squares.points[std::size_t(v)]) == CGAL::ON_POSITIVE_SIDE;
    });
  };
  for (std::size_t t = 0; t < squares.triangles.size(); ++t)
    for (std::size_t other = 0; other < squares.triangles.size(); ++other) {
      const auto& a = squares.triangles[t];
      const auto& b = squares.triangles[other];
      const auto n_common =
          std::count_if(b.begin(), b.end(), [&](int v) { return std::find(a.begin(), a.end(), v) != a.end(); });
      if (squares.regions[t] == squares.regions[other] && n_common == 2) {
        EXPECT_TRUE(is_delaunay(t, other)) << t << ' ' << other;
      }
    }
}

TEST(Retriangulation, leaves_out_points_outside_and_close_to_segments)
{
  const Nested_squares squares;
  std::set<int> used;
  for (const auto& t : squares.triangles)
    used.insert(t.begin(), t.end());
  EXPECT_EQ(used.size(), squares.n_good);
  EXPECT_EQ(*used.rbegin(), int(squares.n_good) - 1);
}

// None of Gmsh's methods makes triangles of it that are all good.
TEST(Retriangulation, wing_of_many_short_lines)
{
  const std::filesystem::path file = std::filesystem::path(QUADRILLE_SHARED_DATA) / "planar/gmsh_2d/wing.geo";
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << "there is no file " << file;
  const Quadrille::Planar_domain domain = Quadrille::read_planar_domain(file.string());
  double area = 0;
  for (const auto f : domain.mesh.faces()) {
    const auto h = domain.mesh.halfedge(f);
    area += CGAL::area(domain.mesh.point(domain.mesh.source(h)), domain.mesh.point(domain.mesh.target(h)),
                       domain.mesh.point(domain.mesh.target(domain.mesh.next(h))));
  }
  double enclosed = 0; // by the border
  for (const auto h : domain.mesh.halfedges())
    if (domain.mesh.is_border(h)) {
      const auto p = domain.mesh.point(domain.mesh.source(h)), q = domain.mesh.point(domain.mesh.target(h));
      enclosed -= (p.x() * q.y() - p.y() * q.x()) / 2;
    }
  EXPECT_NEAR(area, enclosed, 1e-9 * enclosed);
  EXPECT_GT(domain.curves.size(), 500u);
}
