// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// From quantized layouts to integer-grid maps.

#include "extraction_helpers.h"
#include "glued_surfaces.h"

#include <Quadrille/exceptions.h>
#include <Quadrille/integer_grid_map.h>

#include <CGAL/property_map.h>
#include <boost/property_map/function_property_map.hpp>
#include <gtest/gtest.h>

#include <cmath>

using namespace quad_extraction_test;

namespace {

bool is_whole(double x) { return x == std::round(x); }

/// Extracts quads, makes the integer-grid map, and checks that it is one and what it is worth.
template <std::size_t D> void check_integer_grid(const Mapped_mesh_in<D>& mapped, std::size_t wanted_quads = 0)
{
  Mapped_surface_mesh<D> input(mapped);
  const auto& mesh = input.mesh;
  Quadrille::Quad_extraction_options options;
  options.displacements = true;
  options.smooth = false;
  options.quads = wanted_quads;
  Extracted_in<D> extracted;
  extracted.result = Quadrille::extract_quads(mesh, mesh.points(), input.uv, input.curve, input.region, extracted.quads,
                                              options, Quadrille::Greedy_quantizer());
  const std::size_t n_quads = extracted.quads.number_of_faces();

  using Edge = typename Mapped_surface_mesh<D>::Mesh::Edge_index;
  const auto is_feature = boost::make_function_property_map<Edge>([&](Edge e) { return input.curve[e] >= 0; });
  auto grid = input.add_uv_map("h:grid");
  const auto map = Quadrille::integer_grid_map(mesh, input.uv, is_feature, extracted.result.displacements,
                                               extracted.result.scale, grid);
  ASSERT_EQ(map.flipped, 0);
  EXPECT_TRUE(map.misturned_vertices.empty());

  double area = 0;
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const Point_2 p = grid[h], q = grid[mesh.next(h)], r = grid[mesh.prev(h)];
    area += 0.5 * ((q.x() - p.x()) * (r.y() - p.y()) - (r.x() - p.x()) * (q.y() - p.y()));
  }
  EXPECT_NEAR(area, double(n_quads), 1e-9 * double(n_quads));
  for (const auto& seam : map.seams)
    EXPECT_TRUE(is_whole(seam.translation[0]) && is_whole(seam.translation[1]));
  std::set<typename Mapped_surface_mesh<D>::Mesh::Vertex_index> nodes;
  for (const auto& node : extracted.result.layout.nodes)
    if (node.critical)
      nodes.emplace(unsigned(node.vertex));
  for (const auto h : mesh.halfedges()) {
    if (mesh.is_border(h))
      continue;
    const Point_2 q = grid[h];
    if (nodes.count(mesh.target(h))) {
      EXPECT_TRUE(is_whole(q.x()) && is_whole(q.y())) << q;
    }
    if (input.curve[mesh.edge(h)] >= 0) {
      const Point_2 p = grid[mesh.prev(h)];
      EXPECT_TRUE((p.x() == q.x() && is_whole(p.x())) || (p.y() == q.y() && is_whole(p.y()))) << p << " " << q;
    }
  }

  // Quads of the new map are the same ones: there is nothing left to round.
  options.quads = 0;
  Extracted_in<D> again;
  again.result = Quadrille::extract_quads(mesh, mesh.points(), grid, input.curve, input.region, again.quads, options,
                                          Quadrille::Greedy_quantizer());
  EXPECT_EQ(again.quads.number_of_faces(), n_quads);
  EXPECT_EQ(again.quads.number_of_vertices(), extracted.quads.number_of_vertices());
  EXPECT_EQ(again.result.irregular_vertices, extracted.result.irregular_vertices);
}

} // namespace

TEST(Integer_grid_map, of_stars_and_annuli)
{
  for (const int valence : {3, 5, 6}) {
    Glued_rectangles domain = star(valence);
    check_integer_grid(domain.build());
    check_integer_grid(domain.build(), 3000);
  }
  check_integer_grid(annulus(12, 3, 17.3, 1.7).build());
}

TEST(Integer_grid_map, of_random_domains)
{
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    check_integer_grid(random_domain(seed).build());
  }
}

TEST(Integer_grid_map, of_closed_surfaces)
{
  check_integer_grid(sphere().build());
  check_integer_grid(torus(24, 12, 0.52).build());
  Glued_rectangles_in_space domain = cube();
  domain.curve = [](int a, int b, bool) { return a < 4 && b < 4 ? 0 : -1; }; // one side only
  check_integer_grid(domain.build());
}

TEST(Integer_grid_map, refuses_what_is_no_map_or_path)
{
  Mapped_surface_mesh<2> input(star(5).build());
  auto grid = input.add_uv_map("h:grid");
  const auto is_feature = CGAL::Constant_property_map<Mesh::Edge_index, bool>(false);
  const auto compute = [&](const std::vector<Quadrille::Map_displacement>& displacements) {
    Quadrille::integer_grid_map(input.mesh, input.uv, is_feature, displacements, 1, grid);
  };
  EXPECT_NO_THROW(compute({}));
  EXPECT_THROW(compute({{0, 5, {}, {1, 0}}}), Quadrille::Invalid_input_error) << "not in one triangle";
  EXPECT_THROW(compute({{0, 100000, {}, {1, 0}}}), Quadrille::Invalid_input_error);
  EXPECT_THROW(compute({{0, 1, {}, {1, 0}}, {0, 1, {}, {2, 0}}}), Quadrille::No_result_error) << "contradiction";
  const Mesh::Halfedge_index h = input.mesh.halfedge(Mesh::Face_index(0));
  input.uv[h] = Point_2(input.uv[h].x() + 0.25, input.uv[h].y());
  EXPECT_THROW(compute({}), Quadrille::Invalid_input_error) << "not seamless";
}
