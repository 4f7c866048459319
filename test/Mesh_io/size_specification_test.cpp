// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Size_specification.h>
#include <Quadrille/estimate_quads.h>
#include <Quadrille/exceptions.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace Quadrille;

namespace {

/// A strip of n x 1 unit squares in triangles: bottom in two curves (1, 2), right 3, top 4, left unlabelled.
Planar_domain strip(int n)
{
  Labelled_mesh mesh;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.points.push_back({double(i), double(j), 0});
  for (int i = 0; i < n; ++i) {
    mesh.polygons.push_back({i, i + 1, n + 2 + i});
    mesh.polygons.push_back({i, n + 2 + i, n + 1 + i});
    mesh.lines.push_back({i, i + 1});
    mesh.line_curve.push_back(i < n / 2 ? 0 : 1);
    mesh.lines.push_back({n + 2 + i, n + 1 + i});
    mesh.line_curve.push_back(3);
  }
  mesh.lines.push_back({n, 2 * n + 1});
  mesh.line_curve.push_back(2);
  mesh.curves = {{1, {"bottom"}}, {2, {"bottom"}}, {3, {"right"}}, {4, {"top"}}};
  return make_planar_domain(mesh, "strip");
}

using Pair = std::array<double, 2>;

/// Across and along the edge around (x, y), at its two ends.
std::array<Pair, 2> frame_sizes_at(const Planar_domain& domain, const Domain_sizes& sizes, double x, double y)
{
  for (const Planar_domain::Curve& curve : domain.curves)
    for (const auto h : curve.path) {
      const auto& p = domain.mesh.point(domain.mesh.source(h));
      const auto& q = domain.mesh.point(domain.mesh.target(h));
      if (std::abs(0.5 * (p.x() + q.x()) - x) + std::abs(0.5 * (p.y() + q.y()) - y) > 1e-9)
        continue;
      const Planar_domain::edge_descriptor e(domain.mesh.edge(h).idx()); // as in edges(mesh)
      std::array<Frame_size, 2> size = sizes.of_edge[e.idx()];
      if (domain.mesh.halfedge(e) != h)
        std::swap(size[0], size[1]);
      return {Pair{size[0].normal, size[0].tangential}, Pair{size[1].normal, size[1].tangential}};
    }
  return {Pair{-1, -1}, Pair{-1, -1}};
}

/// The same where across and along are equal.
Pair sizes_at(const Planar_domain& domain, const Domain_sizes& sizes, double x, double y)
{
  const std::array<Pair, 2> ends = frame_sizes_at(domain, sizes, x, y);
  EXPECT_EQ(ends[0][0], ends[0][1]);
  EXPECT_EQ(ends[1][0], ends[1][1]);
  return {ends[0][1], ends[1][1]};
}

Domain_sizes apply(const Planar_domain& domain, const std::vector<std::string>& items)
{
  Size_specification specification;
  for (const std::string& item : items)
    specification.add(item);
  return specification.apply(domain);
}

TEST(Size_specification, constant_and_named_sizes)
{
  const Planar_domain domain = strip(4);
  const Domain_sizes sizes = apply(domain, {"2", "top=0.5", "3=1x1"});
  EXPECT_EQ(sizes_at(domain, sizes, 0.5, 0), (Pair{2, 2}));
  EXPECT_EQ(sizes_at(domain, sizes, 0.5, 1), (Pair{0.5, 0.5}));
  EXPECT_EQ(sizes_at(domain, sizes, 4, 0.5), (Pair{1, 1}));
  EXPECT_EQ(sizes_at(domain, sizes, 0, 0.5), (Pair{2, 2}));
  for (const std::vector<std::string>& items :
       {std::vector<std::string>{"top=3", "4=5"}, std::vector<std::string>{"4=5", "top=3"}}) {
    const Domain_sizes tag_wins = apply(domain, items);
    EXPECT_EQ(sizes_at(domain, tag_wins, 0.5, 1), (Pair{5, 5}));
    EXPECT_EQ(sizes_at(domain, tag_wins, 0.5, 0), (Pair{0, 0})); // free
  }
}

TEST(Size_specification, contradictions_are_refused)
{
  Planar_domain named = strip(4);
  named.curves[3].names.push_back("outlet"); // the top, which has tag 4
  const Planar_domain& domain = named;
  const auto expect_contradiction = [&](const std::vector<std::string>& items, const std::string& word) {
    try {
      apply(domain, items);
      ADD_FAILURE() << items[0] << " " << items[1];
    } catch (const Invalid_argument_error& error) {
      EXPECT_NE(std::string(error.what()).find("contradict"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  expect_contradiction({"1", "2"}, "every curve");
  expect_contradiction({"top=1", "top=2"}, "curve 4 of strip");
  expect_contradiction({"top=1", "outlet=2"}, "'top=1' and 'outlet=2'");
  expect_contradiction({"4=1:2", "4=2:1"}, "curve 4");
  expect_contradiction({"top=1x2", "outlet=2x1"}, "curve 4");
  EXPECT_NO_THROW(apply(domain, {"1", "1", "top=2", "outlet=2", "4=3"}));
}

TEST(Size_specification, number_of_quads_is_estimated)
{
  const Planar_domain domain = strip(40);
  EXPECT_NEAR(estimate_number_of_quads(domain, apply(domain, {"0.1"})), 4000, 0.1);
  EXPECT_NEAR(estimate_number_of_quads(domain, apply(domain, {"0.5", "bottom=0.2x0.5", "top=0.2x0.5"})), 400, 8);
  EXPECT_EQ(estimate_number_of_quads(domain, apply(domain, {"top=free"})), 0);
  // From 1 to 4 along the strip: the integral of 1 / h^2 is 40 / (1 * 4) = 10.
  const double n = estimate_number_of_quads(domain, apply(domain, {"bottom=1:4", "top=4:1"}));
  EXPECT_GT(n, 8);
  EXPECT_LT(n, 13);
}

TEST(Size_specification, estimate_grows_with_the_distance_from_small_sizes)
{
  // Sizes proportional to the radius, from 0.001 to 1, have log sizes that are harmonic: 2 pi log(1000) / 0.1^2
  // elements of a tenth of the radius. The sizes of the nearest curves alone would ask for ten thousand times as many.
  Labelled_mesh mesh;
  const int n_rings = 60, n_around = 40;
  for (int i = 0; i <= n_rings; ++i)
    for (int j = 0; j < n_around; ++j) {
      const double r = std::pow(10, -3.0 * (n_rings - i) / n_rings), t = 2 * CGAL_PI * j / n_around;
      mesh.points.push_back({r * std::cos(t), r * std::sin(t), 0});
    }
  for (int i = 0; i < n_rings; ++i)
    for (int j = 0; j < n_around; ++j) {
      const int a = i * n_around + j, b = i * n_around + (j + 1) % n_around;
      mesh.polygons.push_back({a, a + n_around, b + n_around});
      mesh.polygons.push_back({a, b + n_around, b});
    }
  const Planar_domain domain = make_planar_domain(mesh, "annulus");
  Domain_sizes sizes;
  sizes.of_edge.resize(domain.mesh.number_of_edges());
  for (const auto e : domain.mesh.edges())
    if (domain.edge_curve[e.idx()] >= 0)
      for (const int end : {0, 1}) {
        const auto& p = domain.mesh.point(domain.mesh.vertex(e, unsigned(end)));
        sizes.of_edge[e.idx()][std::size_t(end)] = Frame_size(0.1 * std::hypot(p.x(), p.y()));
      }
  const double expected = 2 * CGAL_PI * std::log(1000.0) / 0.01;
  EXPECT_NEAR(estimate_number_of_quads(domain, sizes), expected, 0.05 * expected);
}

TEST(Size_specification, linear_sizes_run_along_the_joined_curves)
{
  const Planar_domain domain = strip(4);
  const Domain_sizes sizes = apply(domain, {"bottom=1:3"});
  for (int i = 0; i < 4; ++i) {
    const Pair size = sizes_at(domain, sizes, i + 0.5, 0);
    EXPECT_DOUBLE_EQ(size[0], 1 + 0.5 * i);
    EXPECT_DOUBLE_EQ(size[1], 1.5 + 0.5 * i);
  }
  // The top runs from right to left.
  EXPECT_EQ(sizes_at(domain, apply(domain, {"top=1:5"}), 3.5, 1), (Pair{1, 2}));
}

TEST(Size_specification, sizes_across_and_along)
{
  const Planar_domain domain = strip(4);
  const Domain_sizes sizes = apply(domain, {"bottom=0.5x1:1x3", "right=0.1xfree", "top=free", "3=freex2"});
  EXPECT_EQ(frame_sizes_at(domain, sizes, 0.5, 0), (std::array<Pair, 2>{Pair{0.5, 1}, Pair{0.625, 1.5}}));
  EXPECT_EQ(frame_sizes_at(domain, sizes, 3.5, 1), (std::array<Pair, 2>{Pair{0, 0}, Pair{0, 0}}));
  EXPECT_EQ(frame_sizes_at(domain, sizes, 4, 0.5), (std::array<Pair, 2>{Pair{0, 2}, Pair{0, 2}}));

  for (const char* item : {"1", "top=2x2", "top=1:2", "top=free", "top=0.1xfree"}) {
    Size_specification specification;
    specification.add(item);
    EXPECT_EQ(specification.anisotropic_item(), "") << item;
  }
  Size_specification specification;
  specification.add("top=1:2");
  specification.add("right=1x1:2x3");
  EXPECT_EQ(specification.anisotropic_item(), "right=1x1:2x3");
}

TEST(Size_specification, defaults)
{
  Planar_domain domain = strip(4);
  const Domain_sizes by_box = apply(domain, {});
  EXPECT_DOUBLE_EQ(sizes_at(domain, by_box, 0.5, 0)[0], std::sqrt(17.0) / 40);
  EXPECT_EQ(by_box.notes.size(), 1u);
  EXPECT_TRUE(by_box.by_default);
  for (const auto v : domain.mesh.vertices())
    domain.point_size[v.idx()] = 1 + domain.mesh.point(v).x();
  const Domain_sizes by_points = apply(domain, {"top=7"});
  EXPECT_FALSE(by_points.by_default);
  EXPECT_EQ(sizes_at(domain, by_points, 1.5, 0), (Pair{2, 3}));
  EXPECT_EQ(sizes_at(domain, by_points, 1.5, 1), (Pair{7, 7}));
}

TEST(Size_specification, unusable_items)
{
  const Planar_domain domain = strip(4);
  for (const char* item : {"0", "-1", "nan", "inf", "", "abc", "top=", "=3", "top=1:", "top=1:0", "top=1x", "1:2",
                           "1x2x3", "top=1x2x3", "top=1x2:free", "top=1:2:3", "1e400", "0x10"})
    EXPECT_THROW(apply(domain, {item}), Invalid_argument_error) << item;
  try {
    apply(domain, {"lid=1"});
    FAIL();
  } catch (const Invalid_argument_error& error) {
    const std::string message = error.what();
    for (const char* word : {"lid", "strip", "bottom", "right", "top", "4"})
      EXPECT_NE(message.find(word), std::string::npos) << message;
  }
  Labelled_mesh triangle;
  triangle.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.polygons = {{0, 1, 2}};
  triangle.lines = {{0, 1}, {1, 2}, {2, 0}};
  triangle.line_curve = {0, 0, 0};
  triangle.curves = {{1, {"loop"}}};
  const Planar_domain closed = make_planar_domain(triangle, "triangle");
  EXPECT_THROW(apply(closed, {"loop=1:2"}), Invalid_argument_error);
  EXPECT_NO_THROW(apply(closed, {"loop=2:2"}));
}

} // namespace
