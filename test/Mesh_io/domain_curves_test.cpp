// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/domain_curves.h>
#include <Quadrille/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace Quadrille;

namespace {

/// The square [0, 4]^2 with a line at y = 2 (tag 5, group "middle") and one at x = 1, y > 2 (tag 6); what is below y =
/// 2 is a region of its own if that is asked for.
Planar_domain square_with_lines(bool two_regions)
{
  Labelled_mesh mesh;
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i <= 4; ++i)
      mesh.points.push_back({double(i), double(j), 0});
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const int a = 5 * j + i;
      mesh.polygons.push_back({a, a + 1, a + 6});
      mesh.polygons.push_back({a, a + 6, a + 5});
      mesh.polygon_region.insert(mesh.polygon_region.end(), 2, two_regions && j < 2 ? 1 : 0);
    }
  mesh.regions.resize(2);
  mesh.regions[0].tag = 1;
  mesh.regions[1].tag = 2;
  mesh.curves.resize(2);
  mesh.curves[0].tag = 5;
  mesh.curves[0].names = {"middle"};
  mesh.curves[1].tag = 6;
  for (int i = 0; i < 4; ++i) {
    mesh.lines.push_back({10 + i, 11 + i});
    mesh.line_curve.push_back(0);
  }
  for (int j = 2; j < 4; ++j) {
    mesh.lines.push_back({5 * j + 1, 5 * j + 6});
    mesh.line_curve.push_back(1);
  }
  return make_planar_domain(mesh, "square");
}

TEST(Domain_curves, are_found_by_group_and_by_tag)
{
  const Planar_domain domain = square_with_lines(false);
  const std::vector<int> middle = curves_named(domain, "middle");
  EXPECT_EQ(middle, curves_named(domain, "5"));
  ASSERT_FALSE(middle.empty());
  for (const int c : middle)
    EXPECT_EQ(domain.curves[std::size_t(c)].tag, 5);
  EXPECT_TRUE(curves_named(domain, "nothing").empty());
  EXPECT_NE(list_of_curve_names(domain).find("middle"), std::string::npos);
}

TEST(Domain_curves, can_be_removed_inside_a_region)
{
  const Planar_domain domain = square_with_lines(false);
  Planar_domain without = domain;
  const std::vector<int> removed = curves_named(domain, "middle");
  remove_curves(without, removed);
  EXPECT_EQ(without.curves.size(), domain.curves.size() - removed.size());
  EXPECT_TRUE(curves_named(without, "middle").empty());
  for (const auto e : domain.mesh.edges()) {
    const int before = domain.edge_curve[e.idx()], after = without.edge_curve[e.idx()];
    if (before < 0 || std::count(removed.begin(), removed.end(), before)) {
      EXPECT_EQ(after, -1);
      EXPECT_EQ(without.edge_chain[e.idx()], -1);
    } else {
      EXPECT_EQ(without.curves[std::size_t(after)].tag, domain.curves[std::size_t(before)].tag);
      EXPECT_EQ(without.edge_chain[e.idx()], domain.edge_chain[e.idx()]);
    }
  }
}

TEST(Domain_curves, of_borders_and_interfaces_stay)
{
  Planar_domain domain = square_with_lines(true);
  EXPECT_THROW(remove_curves(domain, curves_named(domain, "middle")), Invalid_argument_error);
  EXPECT_NO_THROW(remove_curves(domain, curves_named(domain, "6")));
  const auto h = *std::find_if(domain.mesh.halfedges().begin(), domain.mesh.halfedges().end(),
                               [&](auto halfedge) { return domain.mesh.is_border(halfedge); });
  EXPECT_THROW(remove_curves(domain, {domain.edge_curve[domain.mesh.edge(h).idx()]}), Invalid_argument_error);
}

} // namespace
