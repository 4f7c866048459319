// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "surface_texts.h"
#include "temporary_files.h"

#include <Quadrille/domain_curves.h>
#include <Quadrille/read_domain.h>
#include <Quadrille/read_surface_domain.h>

#include <algorithm>
#include <cmath>

using namespace Quadrille;

namespace {

const double pi = std::acos(-1.0);

class Surface_geometry : public Temporary_files {
protected:
  Surface_geometry() { m_options.triangle_size = 0.25; }

  Surface_domain read(const std::string& text, const std::string& name = "a.geo") const
  {
    return read_surface_domain(write(name, text), m_options);
  }

  void expect_error(const std::string& text, const std::string& reason)
  {
    try {
      read(text);
      FAIL() << "the geometry was read, instead of: " << reason;
    } catch (const Invalid_input_error& error) {
      EXPECT_NE(std::string(error.what()).find(path("a.geo")), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  }

  Surface_domain_options m_options;
};

const std::string occ = "SetFactory(\"OpenCASCADE\");\n";

TEST_F(Surface_geometry, box_has_its_curves_and_points_outwards)
{
  const Surface_domain box = read(occ + "Box(1) = {0, 0, 0, 1, 2, 3}; Physical Curve(\"rim\") = {1 : 4};\n");
  expect_sound(box);
  EXPECT_EQ(euler_characteristic(box), 2);
  EXPECT_EQ(box.curves.size(), 12u);
  EXPECT_EQ(box.regions.size(), 6u);
  EXPECT_EQ(curves_named(box, "rim").size(), 4u);
  EXPECT_NEAR(enclosed_volume(box), 6, 1e-9);
  EXPECT_EQ(box.triangle_size, 0.25);
  for (const auto e : box.mesh.edges())
    EXPECT_LT(
        std::sqrt(CGAL::squared_distance(box.mesh.point(box.mesh.vertex(e, 0)), box.mesh.point(box.mesh.vertex(e, 1)))),
        0.5);
}

TEST_F(Surface_geometry, seams_and_poles_are_no_features)
{
  const Surface_domain ball = read(occ + "Sphere(1) = {0, 0, 0, 1};\n");
  expect_sound(ball);
  EXPECT_TRUE(ball.curves.empty());
  EXPECT_EQ(euler_characteristic(ball), 2);
  EXPECT_NEAR(enclosed_volume(ball), 4 * pi / 3, 0.1);
  const Surface_domain torus = read(occ + "Torus(1) = {0, 0, 0, 2, 0.5};\n");
  expect_sound(torus);
  EXPECT_TRUE(torus.curves.empty());
  EXPECT_EQ(euler_characteristic(torus), 0);
  const Surface_domain cylinder = read(occ + "Cylinder(1) = {0, 0, 0, 0, 0, 2, 1};\n");
  expect_sound(cylinder);
  ASSERT_EQ(cylinder.curves.size(), 2u);
  EXPECT_TRUE(cylinder.curves[0].closed && cylinder.curves[1].closed);
}

TEST_F(Surface_geometry, physical_surfaces_are_all_that_belongs)
{
  const Surface_domain tube = read(occ + "Cylinder(1) = {0, 0, 0, 0, 0, 2, 1}; Physical Surface(\"wall\") = {1};\n");
  expect_sound(tube);
  EXPECT_EQ(euler_characteristic(tube), 0);
  EXPECT_EQ(tube.regions.size(), 1u);
  EXPECT_EQ(tube.regions[0].names, std::vector<std::string>{"wall"});
  EXPECT_EQ(tube.curves.size(), 2u);
}

TEST_F(Surface_geometry, cavities_point_out_of_the_material)
{
  const Surface_domain shell = read(occ + "Sphere(1) = {0, 0, 0, 2}; Sphere(2) = {0, 0, 0, 1};\n"
                                          "BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n");
  expect_sound(shell);
  EXPECT_EQ(euler_characteristic(shell), 4);
  EXPECT_NEAR(enclosed_volume(shell), 4 * pi / 3 * 7, 1);
  EXPECT_TRUE(has_note(shell, "1 of 2 closed components point inwards"));
}

TEST_F(Surface_geometry, surfaces_between_volumes_are_refused)
{
  const std::string two = occ + "Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {1, 0, 0, 1, 1, 1}; Coherence;\n";
  expect_error(two, "lies between the volumes 1 and 2");
  const Surface_domain one = read(two + "Physical Volume(1) = {2};\n");
  EXPECT_EQ(euler_characteristic(one), 2);
  EXPECT_NEAR(enclosed_volume(one), 1, 1e-9);
  expect_error(two + "Physical Surface(1) = {Surface{:}};\n", "not manifold");
}

TEST_F(Surface_geometry, moebius_strips_are_not_orientable)
{
  m_options.refine_locally = false; // which takes Gmsh long on such surfaces
  // Quarter turns around the z axis, each with an eighth of a full turn about the strip's own axis.
  std::string text;
  for (int i = 0; i < 4; ++i)
    for (const double s : {-0.4, 0.4}) {
      const double a = pi / 2 * i, r = 1 + s * std::cos(a / 2);
      text += "Point(" + std::to_string(2 * i + (s > 0 ? 2 : 1)) + ") = {" + std::to_string(r * std::cos(a)) + ", " +
              std::to_string(r * std::sin(a)) + ", " + std::to_string(s * std::sin(a / 2)) + "};\n";
    }
  text += "Line(1) = {1, 2}; Line(2) = {3, 4}; Line(3) = {5, 6}; Line(4) = {7, 8};\n"
          "Line(11) = {1, 3}; Line(12) = {3, 5}; Line(13) = {5, 7}; Line(14) = {7, 2};\n"
          "Line(21) = {2, 4}; Line(22) = {4, 6}; Line(23) = {6, 8}; Line(24) = {8, 1};\n";
  for (int i = 1; i < 4; ++i) {
    const std::string n = std::to_string(i), next = std::to_string(i + 1);
    text += "Curve Loop(" + n + ") = {" + n + ", 2" + n + ", -" + next + ", -1" + n + "}; Surface(" + n + ") = {" + n +
            "};\n";
  }
  const std::string open = text;
  text += "Curve Loop(4) = {4, 24, 1, -14}; Surface(4) = {4};\n";
  expect_error(text, "not orientable");
  EXPECT_EQ(euler_characteristic(read(open)), 1);
}

TEST_F(Surface_geometry, bad_geometry_is_refused)
{
  expect_error("Point(1) = {0, 0, 0};\n", "no surfaces");
  expect_error(occ + "Box(1) = {0, 0, 0, 1, 1,", "truncated");
  expect_error("Exit;\n", "ended abnormally");
  EXPECT_THROW(read_surface_domain(path("missing.step")), Invalid_input_error);
  m_options.max_triangles = 0;
  EXPECT_THROW(read(occ + "Box(1) = {0, 0, 0, 1, 1, 1};\n"), Invalid_argument_error);
}

TEST_F(Surface_geometry, default_size_gives_about_ten_thousand_triangles_and_details_more)
{
  m_options.triangle_size = 0;
  const Surface_domain plain = read(occ + "Box(1) = {0, 0, 0, 10, 10, 10};\n");
  EXPECT_NEAR(double(plain.mesh.number_of_faces()), 11000, 2500);
  const Surface_domain drilled = read(occ + "Box(1) = {0, 0, 0, 10, 10, 10}; Cylinder(2) = {5, 5, -1, 0, 0, 12, 0.2};\n"
                                            "BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n");
  expect_sound(drilled);
  EXPECT_EQ(euler_characteristic(drilled), 0);
  std::vector<std::size_t> edges_of_circles;
  for (const Surface_domain::Curve& curve : drilled.curves)
    if (curve.closed)
      edges_of_circles.push_back(curve.path.size());
  ASSERT_EQ(edges_of_circles.size(), 2u);
  for (const std::size_t n : edges_of_circles)
    EXPECT_GE(n, 20u);
  m_options.refine_locally = false;
  EXPECT_LT(read(content(path("a.geo"))).mesh.number_of_faces(), drilled.mesh.number_of_faces());
}

TEST_F(Surface_geometry, sizes_at_points_are_kept_but_do_not_size_triangles)
{
  const auto tent = [](const std::string& size) {
    return "Point(1) = {0, 0, 0, " + size + "}; Point(2) = {4, 0, 0, " + size + "}; Point(3) = {0, 4, 0}; " +
           "Point(4) = {0, 0, 4};\nLine(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1}; Line(4) = {2, 4}; " +
           "Line(5) = {4, 1};\nCurve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1}; Curve Loop(2) = {1, 4, 5}; " +
           "Plane Surface(2) = {2};\n";
  };
  const Surface_domain coarse = read(tent("9")), fine = read(tent("0.01"));
  EXPECT_EQ(coarse.mesh.number_of_faces(), fine.mesh.number_of_faces());
  EXPECT_EQ(std::count(fine.point_size.begin(), fine.point_size.end(), 0.01), 2);
  EXPECT_EQ(std::count(coarse.point_size.begin(), coarse.point_size.end(), 9.0), 2);
  EXPECT_EQ(fine.curves.size(), 5u);
}

TEST_F(Surface_geometry, reading_is_repeatable_and_planar_geometry_is_told_apart)
{
  const std::string file = write("c.geo", occ + "Cone(1) = {0, 0, 0, 0, 0, 1, 1, 0.3};\n");
  const Surface_domain a = read_surface_domain(file, m_options), b = read_surface_domain(file, m_options);
  ASSERT_EQ(a.mesh.number_of_vertices(), b.mesh.number_of_vertices());
  for (const auto v : a.mesh.vertices())
    EXPECT_EQ(a.mesh.point(v), b.mesh.point(v));
  EXPECT_EQ(read_domain(file, {}, m_options).index(), 1u);
  const std::string corners = "Point(1) = {0, 0, 1}; Point(2) = {1, 0, 1}; Point(3) = {1, 1, ",
                    rest = "}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1};\n"
                           "Curve Loop(1) = {1 : 3}; Plane Surface(1) = {1};\n";
  EXPECT_EQ(read_domain(write("flat.geo", corners + "1" + rest)).index(), 0u);
  EXPECT_EQ(read_domain(write("tilted.geo", corners + "2" + rest), {}, m_options).index(), 1u);
  const Surface_domain flat = read_surface_domain(path("flat.geo"), m_options);
  expect_sound(flat);
  EXPECT_EQ(euler_characteristic(flat), 1);
}

} // namespace
