// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "field_test_meshes.h"

#include <Quadrille/odeco_frame_field.h>

#include <CGAL/boost/graph/properties.h>
#include <boost/property_map/vector_property_map.hpp>
#include <gtest/gtest.h>

#include <optional>

namespace {

using namespace Quadrille;
using namespace Quadrille_test;

Eigen::Vector2d position(const Mesh& mesh, Mesh::Vertex_index v) { return {mesh.point(v).x(), mesh.point(v).y()}; }

struct Field {
  Odeco_field_result result;
  std::vector<Gradient_pair> gradients;
};

/// Size of the edge with unit tangent `t`, at the point `p`; nothing where the edge is not constrained.
using Edge_size =
    std::function<std::optional<Frame_size>(Mesh::Edge_index, const Eigen::Vector2d& p, const Eigen::Vector2d& t)>;

Field anisotropic_field(const Mesh& mesh, const Edge_size& size, int starts, bool isotropic = false)
{
  std::vector<Edge_frame_constraint> constraints(mesh.number_of_edges());
  for (const Mesh::Edge_index e : mesh.edges()) {
    const Eigen::Vector2d p = position(mesh, mesh.source(mesh.halfedge(e)));
    const Eigen::Vector2d q = position(mesh, mesh.target(mesh.halfedge(e)));
    const Eigen::Vector2d t = (q - p).normalized();
    if (const auto at_source = size(e, p, t))
      constraints[e] = {true, true, *at_source, *size(e, q, t)};
  }
  Field field;
  field.gradients.resize(mesh.number_of_faces());
  Odeco_field_options options;
  options.isotropic = isotropic;
  options.starts = starts;
  options.threads = 1;
  field.result = odeco_frame_field(
      mesh, mesh.points(), boost::make_iterator_property_map(constraints.begin(), boost::identity_property_map()),
      boost::make_iterator_property_map(field.gradients.begin(), boost::identity_property_map()), options);
  return field;
}

TEST(Anisotropic_field, finds_the_constant_field_of_a_rectangle)
{
  // Elements twice as long in x as in y: what is tangential at the bottom is normal on the sides.
  const Mesh mesh = square(8, 3).surface_mesh();
  const Field field = anisotropic_field(
      mesh,
      [&](Mesh::Edge_index e, const auto&, const Eigen::Vector2d& t) -> std::optional<Frame_size> {
        if (!mesh.is_border(e))
          return std::nullopt;
        return std::abs(t.x()) > 0.5 ? Frame_size(0.5, 1) : Frame_size(1, 0.5);
      },
      1);
  EXPECT_LT(field.result.energy, 1e-12);
  for (const auto& [du, dv] : field.gradients) {
    EXPECT_NEAR(std::abs(du.x()) + std::abs(dv.x()), 1, 1e-6);
    EXPECT_NEAR(std::abs(du.y()) + std::abs(dv.y()), 2, 1e-6);
  }
}

TEST(Anisotropic_field, finds_the_polar_field_of_an_annulus_sector)
{
  // Radial size constant, size around proportional to the radius: the polar coordinates are the map. The logarithm of
  // the area is harmonic, so that the sizes expected between the curves agree with it.
  double last_energy = 1e300;
  for (const int n : {8, 16, 32}) {
    const Mesh mesh = grid(n, n, [](double s, double t) {
                        const double r = 1 + s, angle = 1.5 * (1 - t);
                        return Eigen::Vector2d(r * std::sin(angle), r * std::cos(angle));
                      }).surface_mesh();
    const Field field = anisotropic_field(
        mesh,
        [&](Mesh::Edge_index e, const Eigen::Vector2d& p, const Eigen::Vector2d& t) -> std::optional<Frame_size> {
          if (!mesh.is_border(e))
            return std::nullopt;
          const bool radial = std::abs(t.dot(p.normalized())) > 0.7;
          return radial ? Frame_size(0.2 * p.norm(), 0.1) : Frame_size(0.1, 0.2 * p.norm());
        },
        0);
    EXPECT_LT(field.result.energy, last_energy / 3);
    last_energy = field.result.energy;
    for (const Mesh::Face_index f : mesh.faces()) {
      Eigen::Vector2d center = Eigen::Vector2d::Zero();
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        center += position(mesh, v) / 3;
      const auto& [du, dv] = field.gradients[f];
      const bool u_is_radial = std::abs(du.normalized().dot(center.normalized())) > 0.7;
      EXPECT_NEAR((u_is_radial ? du : dv).norm() * 0.1, 1, 0.8 / n);
      EXPECT_NEAR((u_is_radial ? dv : du).norm() * 0.2 * center.norm(), 1, 0.8 / n);
    }
  }
}

TEST(Anisotropic_field, keeps_what_curves_inside_prescribe)
{
  // The boundary of a disk and a circle inside it (ring 4 of 8).
  const Mesh mesh = disk(8).surface_mesh();
  const auto radius = [&](Mesh::Vertex_index v) { return position(mesh, v).norm(); };
  const auto is_on_circle = [&](Mesh::Edge_index e) {
    const Mesh::Halfedge_index h = mesh.halfedge(e);
    return std::abs(radius(mesh.source(h)) - 0.5) < 1e-9 && std::abs(radius(mesh.target(h)) - 0.5) < 1e-9;
  };
  const Field field = anisotropic_field(
      mesh,
      [&](Mesh::Edge_index e, const auto&, const auto&) -> std::optional<Frame_size> {
        if (mesh.is_border(e))
          return Frame_size(0.05, 0.2);
        return is_on_circle(e) ? std::optional<Frame_size>(Frame_size(0, 0.1)) : std::nullopt;
      },
      1);
  int n_on_circle = 0;
  for (const Mesh::Vertex_index v : mesh.vertices()) {
    const bool on_circle = std::abs(radius(v) - 0.5) < 1e-9;
    if (!mesh.is_border(v) && !on_circle)
      continue;
    n_on_circle += on_circle ? 1 : 0;
    const Orthogonal_frame_2 frame = nearest_odeco_frame(field.result.harmonics[v]);
    const double radial = std::abs(frame.direction.dot(position(mesh, v).normalized()));
    EXPECT_NEAR(std::min(radial, 1 - radial), 0, 1e-6);
    const auto [across, along] =
        radial > 0.5 ? std::pair(frame.size_u, frame.size_v) : std::pair(frame.size_v, frame.size_u);
    EXPECT_NEAR(along, on_circle ? 0.1 : 0.2, 1e-8);
    if (on_circle) {
      EXPECT_GT(across, 0.0);
    } else {
      EXPECT_NEAR(across, 0.05, 1e-8);
    }
  }
  EXPECT_EQ(n_on_circle, 24);
}

TEST(Anisotropic_field, leaves_sizes_free_at_corners_that_contradict_themselves)
{
  // Thin along every side of a square: in a corner both vectors are asked to be thin and long.
  const Mesh mesh = square(10, 1).surface_mesh();
  const Field field = anisotropic_field(
      mesh,
      [&](Mesh::Edge_index e, const auto&, const auto&) {
        return mesh.is_border(e) ? std::optional<Frame_size>(Frame_size(0.02, 0.2)) : std::nullopt;
      },
      1);
  EXPECT_EQ(field.result.free_corners, 0);
  for (const Mesh::Vertex_index v : mesh.vertices()) {
    const Eigen::Vector2d p = position(mesh, v);
    if (!mesh.is_border(v))
      continue;
    const Orthogonal_frame_2 frame = nearest_odeco_frame(field.result.harmonics[v]);
    const bool u_is_horizontal = std::abs(frame.direction.x()) > 0.7;
    const double horizontal = u_is_horizontal ? frame.size_u : frame.size_v;
    const bool on_side = p.x() == 0 || p.x() == 1, on_base = p.y() == 0 || p.y() == 1;
    if (!(on_side && on_base)) {
      EXPECT_NEAR(horizontal, on_base ? 0.2 : 0.02, 1e-8);
    }
  }
}

TEST(Anisotropic_field, restrictions_contain_just_the_tensors_that_the_constraint_allows)
{
  // An edge in direction 0.3 and every way to give its two sizes: tensors of frames with these sizes fulfil q = o + B s
  // for some s, others do not.
  Triangles triangle;
  triangle.points = {{0, 0}, {std::cos(0.3), std::sin(0.3)}, {-1, 2}};
  triangle.faces = {{0, 1, 2}};
  const internal::Indexed_triangulation mesh = triangle.indexed();
  const auto distance = [&](const Frame_size& asked, double angle, double normal, double tangential) {
    const auto constraints = internal::collect_vertex_constraints(mesh, triangle.points, {{0, true, {asked, asked}}});
    internal::Vertex_restriction<5> restriction;
    restrict_vertex(constraints[0], restriction);
    const Circular_harmonics q =
        odeco_harmonics({{std::cos(angle), std::sin(angle)}, tangential, normal}) - restriction.offset;
    const Eigen::MatrixXd basis = restriction.basis.leftCols(restriction.dimension);
    if (restriction.dimension == 0)
      return q.norm();
    return (q - basis * basis.colPivHouseholderQr().solve(q)).norm();
  };
  ASSERT_EQ(mesh.source(0), 0);
  for (const double n : {0.0, 0.7})
    for (const double t : {0.0, 1.9}) {
      const Frame_size asked(n, t);
      EXPECT_NEAR(distance(asked, 0.3, n > 0 ? n : 3, t > 0 ? t : 0.4), 0, 1e-12);
      EXPECT_NEAR(distance(asked, 0.3 + std::acos(-1.0), n > 0 ? n : 0.1, t > 0 ? t : 5), 0, 1e-12);
      EXPECT_GT(distance(asked, 0.4, n > 0 ? n : 3, t > 0 ? t : 0.4), 1e-3);
      if (n > 0) {
        EXPECT_GT(distance(asked, 0.3, 1.1 * n, 1.9), 1e-3);
      }
      if (t > 0) {
        EXPECT_GT(distance(asked, 0.3, 0.7, 1.1 * t), 1e-3);
      }
    }
}

TEST(Anisotropic_field, rejects_sizes_that_no_such_field_has)
{
  const Mesh mesh = square(3, 1).surface_mesh();
  const Edge_size flat = [&](Mesh::Edge_index e, const auto&, const auto&) {
    return mesh.is_border(e) ? std::optional<Frame_size>(Frame_size(0.1, 0.2)) : std::nullopt;
  };
  EXPECT_THROW(anisotropic_field(mesh, flat, 0, true), Invalid_argument_error);
  std::vector<Edge_frame_constraint> unaligned(mesh.number_of_edges(), {true, false, {0.1, 0.2}, {0.1, 0.2}});
  std::vector<Gradient_pair> gradients(mesh.number_of_faces());
  Odeco_field_options options;
  options.isotropic = false;
  EXPECT_THROW(odeco_frame_field(mesh, mesh.points(),
                                 boost::make_iterator_property_map(unaligned.begin(), boost::identity_property_map()),
                                 boost::make_iterator_property_map(gradients.begin(), boost::identity_property_map()),
                                 options),
               Invalid_argument_error);
}

} // namespace
