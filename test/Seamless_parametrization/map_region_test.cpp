// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "map_test_tools.h"

#include <Quadrille/Seamless_parametrization/internal/Map_region.h>
#include <Quadrille/Seamless_parametrization/internal/Reduced_elements.h>

#include <gtest/gtest.h>

namespace {

using namespace Quadrille;
using namespace Quadrille::test;
using internal::Map_region;

struct Smooth_map {
  Smooth_map()
      : mesh(plate_with_holes_mesh(0.1)), triangulation(mesh.points.size(), mesh.triangles),
        map(compute_map(mesh, smooth_cross_field(mesh, 0.1))),
        space(internal::Seamless_constraints(triangulation, map.topology, map.cut)())
  {
  }

  Planar_mesh mesh;
  Indexed_triangulation triangulation;
  Seamless_map_data map;
  internal::Seamless_space space;
};

TEST(Map_region, grows_by_rings_of_faces_that_share_a_vertex)
{
  const Smooth_map smooth;
  const int seed = int(smooth.mesh.triangles.size() / 2);
  std::vector<char> reached(smooth.mesh.triangles.size(), 0);
  reached[std::size_t(seed)] = 1;
  for (int rings = 0; rings < 4; ++rings) {
    EXPECT_EQ(internal::faces_around(smooth.triangulation, {seed}, rings), reached) << rings;
    std::vector<char> next = reached;
    for (std::size_t f = 0; f < reached.size(); ++f)
      for (std::size_t g = 0; g < reached.size(); ++g)
        for (const int v : smooth.mesh.triangles[f])
          if (reached[f] && std::count(smooth.mesh.triangles[g].begin(), smooth.mesh.triangles[g].end(), v) > 0)
            next[g] = 1;
    reached = next;
  }
}

TEST(Map_region, clusters_hang_together_by_vertices)
{
  const Planar_mesh mesh = disk_mesh(4); // the first six faces are around vertex 0
  const Indexed_triangulation triangulation(mesh.points.size(), mesh.triangles);
  const int last = int(mesh.triangles.size()) - 1;
  EXPECT_EQ(internal::largest_cluster(triangulation, {}), 0U);
  EXPECT_EQ(internal::largest_cluster(triangulation, {0, last}), 1U);
  EXPECT_EQ(internal::largest_cluster(triangulation, {0, 1, 3, last - 1, last}), 3U);
}

TEST(Map_region, its_parameters_move_its_faces_and_no_others)
{
  const Smooth_map smooth;
  const std::vector<int> seeds{10, int(smooth.mesh.triangles.size()) - 10};
  const Map_region region = internal::map_region(smooth.triangulation, smooth.space, seeds, 3);
  ASSERT_FALSE(region.parameters.empty());
  std::mt19937 generator(1);
  Eigen::VectorXd y(smooth.space.number_of_parameters);
  for (double& value : y)
    value = double(generator()) / 4294967295.0;
  internal::Reduced_elements everywhere(smooth.space);
  std::vector<internal::Corner_vector> before;
  for (std::size_t f = 0; f < smooth.mesh.triangles.size(); ++f)
    before.push_back(everywhere.corners(f, y));
  internal::Reduced_elements inside(smooth.space, region, y);
  ASSERT_EQ(inside.number_of_parameters(), Eigen::Index(region.parameters.size()));
  Eigen::VectorXd local(inside.number_of_parameters());
  for (double& value : local)
    value = 2.0 + double(generator()) / 4294967295.0;
  y(region.parameters) = local;
  std::size_t place = 0;
  for (std::size_t f = 0; f < before.size(); ++f) {
    const internal::Corner_vector after = everywhere.corners(f, y);
    if (place == region.faces.size() || region.faces[place] != int(f)) {
      EXPECT_EQ(after, before[f]) << f;
      continue;
    }
    EXPECT_LT((inside.corners(place, local) - after).lpNorm<Eigen::Infinity>(), 1e-12) << f;
    ++place;
  }
}

TEST(Map_region, of_all_faces_is_the_whole_map)
{
  const Smooth_map smooth;
  const Map_region region = internal::map_region(smooth.triangulation, smooth.space, {0}, 1000);
  const Map_region whole = internal::whole_map(smooth.space);
  EXPECT_EQ(region.faces, whole.faces);
  EXPECT_EQ(region.parameters, whole.parameters);
}

TEST(Map_region, what_is_far_from_folds_stays_where_it_was)
{
  const Planar_mesh mesh = rectangle_mesh(60, 60);
  std::vector<Gradient_pair> frames = sample(mesh, [](auto) { return frame(0.0, 0.1); });
  std::mt19937 generator(1);
  for (std::size_t f = 0; f < frames.size(); ++f) // sizes that no map has fold a few triangles
    if ((mesh.centroid(f) - Eigen::Vector2d(0.3, 0.4)).norm() < 0.04)
      frames[f] = frame(0.6 * double(generator()) / 4294967295.0 - 0.3, generator() % 2 == 0 ? 0.02 : 0.2);
  Seamless_parametrization_options options;
  options.untangle = false;
  const Seamless_map_data raw = compute_map(mesh, frames, {}, options);
  ASSERT_GT(raw.n_invalid(), 0U); // otherwise this tests nothing
  ASSERT_TRUE(singularities(mesh, raw).empty());
  const Seamless_map_data map = compute_map(mesh, frames);
  EXPECT_EQ(map.n_invalid(), 0U);
  EXPECT_GT(map.untangling_rounds, 0);
  std::size_t n_moved = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i)
      if (map.uv[3 * f + i] != raw.uv[3 * f + i]) {
        ++n_moved;
        EXPECT_LT((mesh.centroid(f) - Eigen::Vector2d(0.3, 0.4)).norm(), 0.3);
      }
  EXPECT_GT(n_moved, 0U);
}

} // namespace
