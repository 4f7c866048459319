// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "tetrahedral_test_meshes.h"

#include <Quadrille/Metric_connection.h>
#include <Quadrille/Singular_graph.h>
#include <Quadrille/average_crosses.h>
#include <Quadrille/check_tetrahedral_mesh.h>
#include <Quadrille/cross_field_indicators.h>
#include <Quadrille/volumetric_cross_field.h>

#include <gtest/gtest.h>

using namespace Quadrille;

namespace {

/// A model of TetrahedralMesh that can do what the concept says and nothing else.
class Tetrahedral_mesh_archetype {
public:
  /// A number of a vertex: nothing but convertible.
  class Number {
  public:
    explicit Number(int value) : m_value(value) {}
    operator int() const { return m_value; }

  private:
    int m_value;
  };

  /// A place: nothing but convertible.
  class Place {
  public:
    explicit Place(const Eigen::Vector3d& p) : m_p(p) {}
    operator Eigen::Vector3d() const { return m_p; }

  private:
    Eigen::Vector3d m_p;
  };

  class Corners {
  public:
    explicit Corners(const std::array<int, 4>& corners) : m_corners(corners) {}
    Number operator[](std::size_t i) const { return Number(m_corners[i]); }

  private:
    std::array<int, 4> m_corners;
  };

  explicit Tetrahedral_mesh_archetype(const Tetrahedral_mesh& mesh) : m_mesh(mesh) {}
  Tetrahedral_mesh_archetype(const Tetrahedral_mesh_archetype&) = delete;
  Tetrahedral_mesh_archetype& operator=(const Tetrahedral_mesh_archetype&) = delete;

  std::size_t number_of_vertices() const { return m_mesh.number_of_vertices(); }
  std::size_t number_of_tetrahedra() const { return m_mesh.number_of_tetrahedra(); }
  Place point(std::size_t v) const { return Place(m_mesh.point(v)); }
  Corners tetrahedron(std::size_t t) const { return Corners(m_mesh.tetrahedron(t)); }

private:
  const Tetrahedral_mesh& m_mesh;
};

template <class Mesh> std::vector<Eigen::Matrix3d> frames_on(const Mesh& mesh)
{
  check_tetrahedral_mesh(mesh);
  return volumetric_cross_field(mesh, align_with_boundary(mesh)).frames;
}

/// Under sizes that grow with x.
template <class Mesh> std::vector<Eigen::Matrix3d> frames_under_metric(const Mesh& mesh)
{
  const Metric_field metric = Metric_field::sampled(
      mesh, [](const Eigen::Vector3d& p) -> Eigen::Matrix3d { return std::exp(-p[0]) * Eigen::Matrix3d::Identity(); });
  const Metric_connection connection(mesh, metric);
  const Vertex_alignments alignments = align_with_boundary(mesh, {}, {}, &metric);
  const std::vector<Eigen::Matrix3d> frames = volumetric_cross_field(mesh, alignments, metric, connection).frames;
  EXPECT_TRUE(singular_graph(mesh, frames, metric, connection).is_hex_meshable());
  EXPECT_EQ(crosses_of_tetrahedra(mesh, frames, connection).eta.size(), mesh.number_of_tetrahedra());
  return frames;
}

} // namespace

TEST(Concept, every_algorithm_needs_no_more_than_the_concept)
{
  const Tetrahedral_mesh mesh = prism_of_tetrahedra(polygon_of_triangles(regular_polygon(5), 4), 3, 1);
  const Tetrahedral_mesh_archetype archetype(mesh);
  const std::vector<Eigen::Matrix3d> frames = frames_on(archetype);
  EXPECT_EQ(frames, frames_on(mesh));
  EXPECT_EQ(frames_under_metric(archetype), frames_under_metric(mesh));
  EXPECT_EQ(average_crosses(archetype, align_with_boundary(archetype)).frames,
            average_crosses(mesh, align_with_boundary(mesh)).frames);
  const Singular_graph graph = singular_graph(archetype, frames), expected = singular_graph(mesh, frames);
  ASSERT_EQ(expected.arcs.size(), 1u);
  ASSERT_EQ(graph.arcs.size(), 1u);
  EXPECT_EQ(graph.arcs[0].tetrahedra, expected.arcs[0].tetrahedra);
  EXPECT_EQ(graph.arcs[0].points, expected.arcs[0].points);
}
