// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "surface_test_meshes.h"

#include <Quadrille/Odeco_frame_field/internal/Surface_field_solver.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace Quadrille;
using namespace Quadrille::internal;
using namespace Quadrille_test;

/// The gradients of a map, orthogonal to each other, at a point of a surface.
struct Gradients_in_space {
  Eigen::Vector3d u, v;
};
using Space_field = std::function<Gradients_in_space(const Eigen::Vector3d&)>;

/// surface, eq. (46), of a field that is sampled at the vertices.
template <int N> double curl_energy(const Space_triangles& triangles, const Space_field& field)
{
  const Surface_problem problem({triangles.indexed(), triangles.points, {}}, {});
  const Surface_elements<N> elements =
      make_surface_elements<N>(problem, restrict_surface<N>(problem.constraints), Normal_value::mean);
  Eigen::VectorXd x(Eigen::Index(elements.number_of_unknowns()));
  for (std::size_t v = 0; v < elements.number_of_nodes(); ++v) {
    const Eigen::Matrix3d& axes = elements.nodes().axes[v];
    const Gradients_in_space pair = field(triangles.points[std::size_t(elements.nodes().vertex[v])]);
    Orthogonal_frame_2 frame;
    frame.direction = (axes.leftCols<2>().transpose() * pair.u).normalized();
    frame.size_u = pair.u.norm();
    frame.size_v = pair.v.norm();
    elements.assign_coefficients(v, Tensor_coefficients<N>::from_harmonics(odeco_harmonics(frame)), x);
  }
  const Surface_energy<N> energy(elements, Surface_weights());
  double sum = 0;
  for (std::size_t e = 0; e < elements.number_of_elements(); ++e) {
    std::array<int, std::size_t(3 * N)> index;
    typename Surface_energy<N>::Unknowns local = Surface_energy<N>::Unknowns::Zero();
    const int count = elements.element_unknowns(e, index);
    for (int i = 0; i < count; ++i)
      local[i] = x[index[std::size_t(i)]];
    typename Surface_energy<N>::Residuals rows;
    EXPECT_TRUE(energy.evaluate(e, local, rows, nullptr));
    sum += 0.5 * rows.head(Surface_energy<N>::first_odeco).squaredNorm();
  }
  return sum;
}

/// Of energies for triangles of n, n / 2 and n / 4: the exponents of their edges' length between neighbours.
std::vector<double> orders(const std::vector<double>& errors, const std::string& name)
{
  std::vector<double> result;
  for (std::size_t i = 1; i < errors.size(); ++i) {
    result.push_back(std::log2(errors[i - 1] / errors[i]));
    ::testing::Test::RecordProperty(name + "_order_" + std::to_string(i), std::to_string(result.back()));
  }
  return result;
}

/// That the curl energy falls with the square of the edges' length, as it does for linear tensors in the plane.
template <int N>
void expect_integrable(const std::string& name, const std::function<Space_triangles(int)>& surface,
                       const Space_field& field)
{
  std::vector<double> energies;
  for (const int refinement : {4, 8, 16})
    energies.push_back(curl_energy<N>(surface(refinement), field));
  for (const double order : orders(energies, name)) {
    EXPECT_GT(order, 1.8) << name;
  }
}

/// The unit vectors of cylindrical coordinates.
Eigen::Vector3d outwards(const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), p.y(), 0).normalized(); }
Eigen::Vector3d around(const Eigen::Vector3d& p) { return Eigen::Vector3d(-p.y(), p.x(), 0).normalized(); }

Space_triangles some_cylinder(int n) { return cylinder(12 * n, 7 * n, 1, 2); }
/// Constant frames of the developed cylinder, turned against the axis.
Space_field on_cylinder(double angle, double stretch)
{
  return [=](const Eigen::Vector3d& p) {
    const Eigen::Vector3d a = around(p), b = Eigen::Vector3d::UnitZ();
    return Gradients_in_space{std::cos(angle) * a + std::sin(angle) * b,
                              stretch * (std::cos(angle) * b - std::sin(angle) * a)};
  };
}

TEST(Known_fields, constant_frames_on_a_cylinder_have_no_curl)
{
  EXPECT_LT(curl_energy<3>(some_cylinder(1), on_cylinder(0, 1)), 1e-25); // even coarse, since it is a prism
  EXPECT_LT(curl_energy<5>(some_cylinder(1), on_cylinder(0, 2)), 1e-25);
  expect_integrable<3>("isotropic", some_cylinder, on_cylinder(two_pi / 12, 1));
  expect_integrable<5>("anisotropic", some_cylinder, on_cylinder(two_pi / 12, 2));
}

/// The cone that is 270 degrees of a plane when developed.
const double cone_slope = std::sqrt(7.0) / 3;
Space_triangles developable_cone(int n) { return cone(12 * n, 5 * n, cone_slope, 0.5, 1.5); }
Eigen::Vector3d along_cone(const Eigen::Vector3d& p)
{
  return (outwards(p) + cone_slope * Eigen::Vector3d::UnitZ()).normalized();
}

TEST(Known_fields, polar_coordinates_of_a_cone_have_no_curl)
{
  // The logarithm of the distance from the apex and the developed angle, which is conformal; and the distance itself.
  expect_integrable<3>("logarithm", developable_cone, [](const Eigen::Vector3d& p) {
    return Gradients_in_space{along_cone(p) / p.norm(), around(p) / p.norm()};
  });
  expect_integrable<5>("distance", developable_cone, [](const Eigen::Vector3d& p) {
    return Gradients_in_space{along_cone(p), around(p) / p.norm()};
  });
}

TEST(Known_fields, cartesian_coordinates_of_a_developed_cone_have_no_curl)
{
  // The two sides of the cut agree up to 90 degrees.
  const auto field = [](double stretch) {
    return [=](const Eigen::Vector3d& p) {
      const double angle = 0.75 * std::atan2(p.y(), p.x());
      return Gradients_in_space{std::cos(angle) * along_cone(p) - std::sin(angle) * around(p),
                                stretch * (std::sin(angle) * along_cone(p) + std::cos(angle) * around(p))};
    };
  };
  expect_integrable<3>("cartesian", developable_cone, field(1));
}

/// A band of the unit sphere between two parallels.
Space_triangles sphere_band(int n, double latitude)
{
  return space_grid(12 * n, 5 * n,
                    [=](double s, double t) {
                      const double b = latitude * (2 * t - 1), l = two_pi * s;
                      return Eigen::Vector3d(std::cos(b) * std::cos(l), std::cos(b) * std::sin(l), std::sin(b));
                    },
                    {true, false});
}

TEST(Known_fields, stereographic_coordinates_of_a_sphere_have_no_curl)
{
  const auto field = [](const Eigen::Vector3d& p) {
    const double scale = 1 / (1 - p.z());
    const auto tangential = [&](const Eigen::Vector3d& d) { return Eigen::Vector3d(d - d.dot(p) * p); };
    return Gradients_in_space{tangential({scale, 0, p.x() * scale * scale}),
                              tangential({0, scale, p.y() * scale * scale})};
  };
  const Gradients_in_space pair = field(Eigen::Vector3d(1, 2, -2) / 3);
  EXPECT_NEAR(pair.u.norm(), 0.6, 1e-14);
  EXPECT_NEAR(pair.v.norm(), 0.6, 1e-14);
  EXPECT_NEAR(pair.u.dot(pair.v), 0, 1e-14);
  expect_integrable<3>(
      "stereographic", [](int n) { return sphere_band(n, 0.8); }, field);
}

TEST(Known_fields, principal_directions_of_a_torus_have_no_curl)
{
  const double major = 2, minor = 1;
  const auto surface = [=](int n) { return torus(16 * n, 8 * n, major, minor); };
  const auto field = [=](bool conformal) {
    return [=](const Eigen::Vector3d& p) {
      const double r = std::hypot(p.x(), p.y());
      const Eigen::Vector3d normal = (p - major * outwards(p)) / minor;
      return Gradients_in_space{around(p) / r, normal.cross(around(p)) / (conformal ? r : 1)};
    };
  };
  expect_integrable<3>("conformal", surface, field(true));
  expect_integrable<5>("arc_length", surface, field(false));
}

TEST(Known_fields, unit_frames_along_parallels_of_a_sphere_keep_their_curl)
{
  // The curl of the unit vector along a parallel is its geodesic curvature, the tangent of the latitude b; its square
  // over the band gives 4 pi (log(sec b + tan b) - sin b).
  const double latitude = 0.8;
  const double expected = 2 * two_pi * (std::log(1 / std::cos(latitude) + std::tan(latitude)) - std::sin(latitude));
  const auto field = [](const Eigen::Vector3d& p) { return Gradients_in_space{around(p), p.cross(around(p))}; };
  std::vector<double> errors;
  for (const int refinement : {4, 8, 16})
    errors.push_back(std::abs(curl_energy<3>(sphere_band(refinement, latitude), field) - expected));
  for (const double order : orders(errors, "error"))
    EXPECT_GT(order, 1.8);
  EXPECT_LT(errors.back(), 0.02 * expected);
}

} // namespace
