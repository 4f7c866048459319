// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/exceptions.h>
#include <Quadrille/refine_planar_domain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace Quadrille;

namespace {

/// A square of n x n cells, with a line from left to right in the middle between two regions.
Planar_domain two_regions(int n, double scale)
{
  Labelled_mesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      mesh.points.push_back({scale * i, scale * j, 0});
  const auto vertex = [&](int i, int j) { return i * (n + 1) + j; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      mesh.polygons.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.polygons.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      mesh.polygon_region.insert(mesh.polygon_region.end(), 2, j < n / 2 ? 0 : 1);
    }
  mesh.regions.resize(2);
  mesh.regions[0].tag = 1;
  mesh.regions[1].tag = 2;
  mesh.curves.resize(1);
  mesh.curves[0].tag = 7;
  for (int i = 0; i < n; ++i) {
    mesh.lines.push_back({vertex(i, n / 2), vertex(i + 1, n / 2)});
    mesh.line_curve.push_back(0);
  }
  return make_planar_domain(mesh, "two regions");
}

double area(const Planar_domain& domain, Planar_domain::face_descriptor f)
{
  const auto h = domain.mesh.halfedge(f);
  return CGAL::area(domain.mesh.point(domain.mesh.source(h)), domain.mesh.point(domain.mesh.target(h)),
                    domain.mesh.point(domain.mesh.target(domain.mesh.next(h))));
}

TEST(Refine_planar_domain, only_triangles_that_are_too_large_and_their_neighbours_are_split)
{
  for (const double scale : {1.0, 1e8, 1e-8}) {
    const Planar_domain coarse = two_regions(12, scale);
    std::vector<double> largest(coarse.mesh.number_of_faces(), std::numeric_limits<double>::infinity());
    const auto near = [&](const Planar_domain::Point_2& p) {
      return CGAL::squared_distance(p, {5.4 * scale, 4.4 * scale}) < 4 * scale * scale;
    };
    for (const auto f : coarse.mesh.faces())
      if (near(coarse.mesh.point(coarse.mesh.source(coarse.mesh.halfedge(f)))))
        largest[f.idx()] = 0.25 * area(coarse, f);
    const Refined_planar_domain refined = refine_planar_domain(coarse, largest);
    const Planar_domain& fine = refined.domain;
    ASSERT_TRUE(CGAL::is_valid_polygon_mesh(fine.mesh));
    ASSERT_EQ(fine.mesh.number_of_vertices(), coarse.mesh.number_of_vertices() + refined.parents.size());
    EXPECT_GT(refined.parents.size(), 20u);
    EXPECT_LT(refined.parents.size(), 150u);

    double areas[2] = {0, 0};
    std::size_t n_small = 0;
    for (const auto f : fine.mesh.faces()) {
      ASSERT_GT(area(fine, f), 0);
      areas[fine.face_region[f.idx()]] += area(fine, f) / (scale * scale);
      n_small += area(fine, f) < 0.13 * scale * scale;
    }
    EXPECT_NEAR(areas[0], 72, 1e-9); // the regions are those of before
    EXPECT_NEAR(areas[1], 72, 1e-9);
    EXPECT_GT(n_small, 60u);

    for (const auto v : coarse.mesh.vertices())
      EXPECT_EQ(fine.mesh.point(v), coarse.mesh.point(v));
    for (std::size_t i = 0; i < refined.parents.size(); ++i) {
      const Planar_domain::vertex_descriptor v(Planar_domain::Mesh::size_type(coarse.mesh.number_of_vertices() + i));
      const auto [a, b] = refined.parents[i];
      EXPECT_LT(std::max(a, b), v);
      EXPECT_EQ(fine.mesh.point(v), CGAL::midpoint(fine.mesh.point(a), fine.mesh.point(b)));
    }
  }
}

TEST(Refine_planar_domain, curves_keep_their_edges)
{
  const Planar_domain coarse = two_regions(10, 1);
  const Refined_planar_domain refined =
      refine_planar_domain(coarse, std::vector<double>(coarse.mesh.number_of_faces(), 0.1));
  const Planar_domain& fine = refined.domain;
  ASSERT_EQ(fine.edge_curve.size(), fine.mesh.number_of_edges());
  for (const auto e : fine.mesh.edges()) {
    const bool is_new = std::size_t(e.idx()) >= coarse.mesh.number_of_edges();
    ASSERT_EQ(fine.edge_curve[e.idx()], is_new ? -1 : coarse.edge_curve[e.idx()]);
    if (fine.edge_curve[e.idx()] >= 0) {
      EXPECT_EQ(fine.mesh.point(fine.mesh.vertex(e, 0)), coarse.mesh.point(coarse.mesh.vertex(e, 0)));
      EXPECT_EQ(fine.mesh.point(fine.mesh.vertex(e, 1)), coarse.mesh.point(coarse.mesh.vertex(e, 1)));
    }
  }
  const std::size_t n = fine.mesh.number_of_vertices();
  std::vector<char> on_curve(n, 0);
  for (const auto& curve : fine.curves)
    for (const auto h : curve.path)
      on_curve[fine.mesh.source(h).idx()] = on_curve[fine.mesh.target(h).idx()] = 1;
  for (const auto e : fine.mesh.edges())
    EXPECT_TRUE(fine.edge_curve[e.idx()] >= 0 || !on_curve[fine.mesh.vertex(e, 0).idx()] ||
                !on_curve[fine.mesh.vertex(e, 1).idx()]);
}

TEST(Refine_planar_domain, new_triangles_are_delaunay)
{
  const Planar_domain coarse = two_regions(10, 1);
  const Planar_domain fine =
      refine_planar_domain(coarse, std::vector<double>(coarse.mesh.number_of_faces(), 0.1)).domain;
  const auto& mesh = fine.mesh;
  int n_not = 0;
  for (const auto e : mesh.edges()) {
    const auto h = mesh.halfedge(e), o = mesh.opposite(h);
    if (fine.edge_curve[e.idx()] < 0)
      n_not += CGAL::side_of_oriented_circle(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                             mesh.point(mesh.target(mesh.next(h))),
                                             mesh.point(mesh.target(mesh.next(o)))) == CGAL::ON_POSITIVE_SIDE;
  }
  EXPECT_EQ(n_not, 0);
}

TEST(Refine_planar_domain, wrong_arguments_are_refused)
{
  const Planar_domain domain = two_regions(4, 1);
  EXPECT_THROW(refine_planar_domain(domain, {1, 2}), Invalid_argument_error);
  EXPECT_THROW(refine_planar_domain(domain, std::vector<double>(domain.mesh.number_of_faces(), 0)),
               Invalid_argument_error);
}

} // namespace
