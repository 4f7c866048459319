// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "temporary_files.h"

#include <Quadrille/Curve_projector.h>
#include <Quadrille/exceptions.h>
#include <Quadrille/read_planar_domain.h>

#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

using namespace Quadrille;

namespace {

std::string square(double side, const std::string& rest = "")
{
  std::ostringstream text;
  text.precision(17);
  text << "s = " << side << ";\n"
       << "Point(1) = {0, 0, 0, 0.05 * s}; Point(2) = {s, 0, 0, 0.05 * s};\n"
       << "Point(3) = {s, s, 0, 0.1 * s}; Point(4) = {0, s, 0};\n"
       << "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
       << "Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};\n"
       << "Physical Curve(\"bottom\", 7) = {1}; Physical Curve(\"sides\") = {2, 4}; Physical Curve(12) = {3};\n"
       << "Physical Surface(\"plate\") = {1};\n"
       << rest;
  return text.str();
}

std::string circle(const std::string& center, double x, double y, double radius, int first)
{
  std::ostringstream text;
  text.precision(17);
  const int p = first;
  text << "Point(" << p << ") = {" << x << ", " << y << ", 0};\n";
  const double dx[] = {radius, 0, -radius, 0}, dy[] = {0, radius, 0, -radius};
  for (int i = 0; i < 4; ++i)
    text << "Point(" << p + 1 + i << ") = {" << x + dx[i] << ", " << y + dy[i] << ", 0};\n";
  for (int i = 0; i < 4; ++i)
    text << "Circle(" << p + i << ") = {" << p + 1 + i << ", " << p << ", " << p + 1 + (i + 1) % 4 << "};\n";
  text << "Curve Loop(" << center << ") = {" << p << " : " << p + 3 << "};\n";
  return text.str();
}

double smallest_angle(const Planar_domain& domain)
{
  double smallest = 10;
  for (const auto h : domain.mesh.halfedges()) {
    if (domain.mesh.is_border(h))
      continue;
    const auto& p = domain.mesh.point(domain.mesh.target(h));
    const auto u = domain.mesh.point(domain.mesh.source(h)) - p;
    const auto v = domain.mesh.point(domain.mesh.target(domain.mesh.next(h))) - p;
    smallest = std::min(smallest, std::abs(std::atan2(u.x() * v.y() - u.y() * v.x(), u * v)));
  }
  return smallest * 180 / 3.14159265358979;
}

/// What every domain has to fulfil.
void expect_consistent(const Planar_domain& domain)
{
  const auto& mesh = domain.mesh;
  ASSERT_EQ(domain.edge_curve.size(), mesh.number_of_edges());
  ASSERT_EQ(domain.edge_chain.size(), mesh.number_of_edges());
  ASSERT_EQ(domain.face_region.size(), mesh.number_of_faces());
  std::size_t n_on_paths = 0, n_on_curves = 0;
  for (const auto e : mesh.edges()) {
    EXPECT_TRUE(!mesh.is_border(e) || domain.edge_curve[e.idx()] >= 0);
    n_on_curves += domain.edge_curve[e.idx()] >= 0;
  }
  for (std::size_t c = 0; c < domain.curves.size(); ++c) {
    const Planar_domain::Curve& curve = domain.curves[c];
    EXPECT_EQ(mesh.source(curve.path.front()), curve.first);
    EXPECT_EQ(mesh.target(curve.path.back()), curve.last);
    for (std::size_t i = 0; i < curve.path.size(); ++i) {
      ++n_on_paths;
      EXPECT_EQ(domain.edge_curve[mesh.edge(curve.path[i]).idx()], int(c));
      EXPECT_EQ(domain.edge_chain[mesh.edge(curve.path[i]).idx()], curve.chain);
      if (i > 0) {
        EXPECT_EQ(mesh.source(curve.path[i]), mesh.target(curve.path[i - 1]));
      }
    }
  }
  EXPECT_EQ(n_on_paths, n_on_curves);
  for (const int region : domain.face_region)
    EXPECT_TRUE(region >= 0 && region < int(domain.regions.size()));
}

using Read_geometry = Temporary_files;

TEST_F(Read_geometry, square_keeps_names_tags_and_point_sizes)
{
  const Planar_domain domain = read_planar_domain(write("square.geo", square(20)));
  expect_consistent(domain);
  EXPECT_GE(domain.mesh.number_of_faces(), 2000u);
  EXPECT_LE(domain.mesh.number_of_faces(), 2500u);
  EXPECT_GT(smallest_angle(domain), 25);
  ASSERT_EQ(domain.curves.size(), 4u);
  EXPECT_EQ(domain.number_of_chains, 4);
  EXPECT_EQ(domain.curves[0].tag, 1);
  EXPECT_EQ(domain.curves[0].names, std::vector<std::string>{"bottom"});
  EXPECT_EQ(domain.curves[2].names, std::vector<std::string>{"12"});
  EXPECT_EQ(domain.regions.at(0).names, std::vector<std::string>{"plate"});
  const auto bottom = std::find_if(domain.groups.begin(), domain.groups.end(),
                                   [](const Physical_group& group) { return group.name == "bottom"; });
  ASSERT_NE(bottom, domain.groups.end());
  EXPECT_EQ(bottom->tag, 7);
  EXPECT_EQ(domain.mesh.point(domain.curves[0].first), Planar_domain::Point_2(0, 0));
  EXPECT_EQ(domain.mesh.point(domain.curves[0].last), Planar_domain::Point_2(20, 0));
  EXPECT_DOUBLE_EQ(domain.point_size[domain.curves[0].first.idx()], 1);
  EXPECT_DOUBLE_EQ(domain.point_size[domain.curves[2].first.idx()], 2);
  EXPECT_EQ(domain.point_size[domain.curves[2].last.idx()], 0); // point 4 has none
}

TEST_F(Read_geometry, corners_have_at_least_two_triangles)
{
  const Planar_domain domain = read_planar_domain(write("square.geo", square(1)));
  for (const Planar_domain::Curve& curve : domain.curves)
    EXPECT_GE(domain.mesh.degree(curve.first), 3u); // edges; triangles are one less
}

TEST_F(Read_geometry, same_triangles_at_every_scale)
{
  const Planar_domain unit = read_planar_domain(write("unit.geo", square(1)));
  for (const double scale : {1e8, 1e-8}) {
    const Planar_domain scaled = read_planar_domain(write("scaled.geo", square(scale)));
    ASSERT_EQ(scaled.mesh.number_of_vertices(), unit.mesh.number_of_vertices());
    ASSERT_EQ(scaled.mesh.number_of_faces(), unit.mesh.number_of_faces());
    EXPECT_EQ(scaled.number_of_chains, unit.number_of_chains);
    for (const auto v : unit.mesh.vertices()) {
      EXPECT_NEAR(scaled.mesh.point(v).x(), scale * unit.mesh.point(v).x(), 1e-6 * scale);
      EXPECT_NEAR(scaled.mesh.point(v).y(), scale * unit.mesh.point(v).y(), 1e-6 * scale);
    }
  }
}

TEST_F(Read_geometry, same_triangles_for_a_rotated_domain)
{
  const std::string text =
      "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};\n"
      "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1 : 4};\n" +
      circle("2", 0.4, 0.6, 0.15, 100) + "Plane Surface(2) = {1, 2};\n";
  const Planar_domain straight = read_planar_domain(write("straight.geo", text));
  const Planar_domain turned =
      read_planar_domain(write("turned.geo", text + "Rotate {{0, 0, 1}, {0, 0, 0}, 0.3} { Surface{2}; }\n"));
  ASSERT_EQ(turned.mesh.number_of_vertices(), straight.mesh.number_of_vertices());
  const double c = std::cos(0.3), s = std::sin(0.3);
  for (const auto v : straight.mesh.vertices()) {
    const auto &p = straight.mesh.point(v), &q = turned.mesh.point(v);
    EXPECT_NEAR(q.x(), c * p.x() - s * p.y(), 1e-7);
    EXPECT_NEAR(q.y(), s * p.x() + c * p.y(), 1e-7);
  }
}

TEST_F(Read_geometry, every_run_and_process_gives_the_same)
{
  const std::string file = write("square.geo", square(3));
  Planar_domain_options here;
  here.isolate_geometry_kernel = false;
  const Planar_domain a = read_planar_domain(file), b = read_planar_domain(file), c = read_planar_domain(file, here);
  for (const Planar_domain* other : {&b, &c}) {
    ASSERT_EQ(a.mesh.number_of_vertices(), other->mesh.number_of_vertices());
    for (const auto v : a.mesh.vertices())
      EXPECT_EQ(a.mesh.point(v), other->mesh.point(v));
  }
}

TEST_F(Read_geometry, size_settings_of_the_file_do_not_matter)
{
  const Planar_domain plain = read_planar_domain(write("plain.geo", square(1)));
  const Planar_domain set = read_planar_domain(
      write("set.geo", square(1, "Transfinite Curve {1 : 4} = 3; Transfinite Surface {1}; Recombine Surface {1};\n"
                                 "Mesh.CharacteristicLengthFactor = 50; Mesh.Algorithm = 8; Mesh.ElementOrder = 2;\n"
                                 "Mesh.CharacteristicLengthMin = 0.3; Field[1] = MathEval; Field[1].F = \"0.4\";\n"
                                 "Background Field = 1;\n")));
  EXPECT_EQ(plain.mesh.number_of_faces(), set.mesh.number_of_faces());
}

TEST_F(Read_geometry, triangle_size_is_respected)
{
  Planar_domain_options options;
  options.triangle_size = 0.2;
  options.refine_locally = false;
  const Planar_domain domain = read_planar_domain(write("square.geo", square(1)), options);
  EXPECT_EQ(domain.triangle_size, 0.2);
  EXPECT_EQ(domain.curves[0].path.size(), 5u);
  options.triangle_size = -1;
  EXPECT_THROW(read_planar_domain(path("square.geo"), options), Invalid_argument_error);
}

TEST_F(Read_geometry, arcs_of_a_disk_form_one_chain_on_the_true_circle)
{
  const Planar_domain domain =
      read_planar_domain(write("disk.geo", circle("1", 3, 4, 2, 1) + "Plane Surface(1) = {1};\n"));
  expect_consistent(domain);
  EXPECT_EQ(domain.curves.size(), 4u);
  EXPECT_EQ(domain.number_of_chains, 1);
  const Curve_projector project(domain);
  for (const Planar_domain::Curve& curve : domain.curves)
    for (const auto h : curve.path) {
      const auto& p = domain.mesh.point(domain.mesh.source(h));
      const auto& q = domain.mesh.point(domain.mesh.target(h));
      EXPECT_NEAR(std::hypot(p.x() - 3, p.y() - 4), 2, 1e-12);
      const auto x = project(curve.chain, p + 0.3 * (q - p));
      EXPECT_NEAR(std::hypot(x.x() - 3, x.y() - 4), 2, 1e-7);
    }
}

std::string arc_with_radii(double first, double last)
{
  std::ostringstream text;
  text << "Point(1) = {0, 0, 0}; Point(2) = {" << first << ", 0, 0}; Point(3) = {0, " << last << ", 0};\n"
       << "Line(1) = {1, 2}; Circle(2) = {2, 1, 3}; Line(3) = {3, 1};\n"
       << "Curve Loop(1) = {1 : 3}; Plane Surface(1) = {1};\n";
  return text.str();
}

TEST_F(Read_geometry, arcs_that_nearly_end_at_their_points_are_bent_to_end_there)
{
  const Planar_domain domain = read_planar_domain(write("arc.geo", arc_with_radii(1, 1.004)));
  ASSERT_EQ(domain.notes.size(), 1u);
  EXPECT_NE(domain.notes[0].find("curve 2 misses its end points"), std::string::npos) << domain.notes[0];
  double last_radius = 1;
  for (const auto& curve : domain.curves)
    if (curve.tag == 2)
      for (const auto h : curve.path) { // from one radius to the other without a jump
        const auto& p = domain.mesh.point(domain.mesh.target(h));
        const double radius = std::hypot(p.x(), p.y());
        EXPECT_LT(std::abs(radius - last_radius), 0.002);
        last_radius = radius;
      }
  EXPECT_NEAR(last_radius, 1.004, 1e-12);
  EXPECT_TRUE(read_planar_domain(write("exact.geo", arc_with_radii(1, 1))).notes.empty());
  try {
    read_planar_domain(write("bad.geo", arc_with_radii(1, 1.1)));
    FAIL();
  } catch (const Invalid_input_error& error) {
    EXPECT_NE(std::string(error.what()).find("curve 2 misses its end points by 0.1"), std::string::npos)
        << error.what();
  }
}

TEST_F(Read_geometry, straight_lines_far_from_the_origin_are_straight)
{
  const std::string geometry =
      "x = 4.04e7; y = 3.56e6;\n"
      "Point(1) = {x, y, 0}; Point(2) = {x + 900, y + 320, 0}; Point(3) = {x + 410, y + 870, 0};\n"
      "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1};\n"
      "Curve Loop(1) = {1 : 3}; Plane Surface(1) = {1};\n";
  const Planar_domain domain = read_planar_domain(write("triangle.geo", geometry));
  for (const auto& curve : domain.curves) {
    const auto direction = domain.mesh.point(curve.last) - domain.mesh.point(curve.first);
    const double length = std::sqrt(direction.squared_length());
    for (const auto h : curve.path) {
      const auto e = domain.mesh.edge(h);
      const std::array<double, 4>& tangent = domain.edge_tangents[e.idx()];
      for (const int i : {0, 2})
        EXPECT_NEAR(std::abs(tangent[std::size_t(i)] * direction.y() - tangent[std::size_t(i) + 1] * direction.x()) /
                        length,
                    0, 1e-12);
    }
  }
}

TEST_F(Read_geometry, narrow_gaps_and_small_holes_are_refined)
{
  const std::string hole = circle("2", 0.5, 0.05, 0.04, 100); // 0.01 from the bottom
  const Planar_domain domain = read_planar_domain(
      write("gap.geo", "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};\n"
                       "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
                       "Curve Loop(1) = {1 : 4};\n" +
                           hole + "Plane Surface(1) = {1, 2};\n"));
  expect_consistent(domain);
  std::size_t n_around = 0;
  for (const Planar_domain::Curve& curve : domain.curves)
    n_around += curve.tag >= 100 ? curve.path.size() : 0;
  EXPECT_GE(n_around, 24u);
  // Vertices strictly inside the gap's narrowest part.
  int n_inside = 0;
  for (const auto v : domain.mesh.vertices()) {
    const auto& p = domain.mesh.point(v);
    n_inside += !domain.mesh.is_border(v) && std::abs(p.x() - 0.5) < 0.004 && p.y() < 0.011;
  }
  EXPECT_GE(n_inside, 3);
  EXPECT_GT(smallest_angle(domain), 20);
}

TEST_F(Read_geometry, regions_and_embedded_curves)
{
  const Planar_domain domain = read_planar_domain(write(
      "regions.geo",
      square(1, "Point(5) = {2, 0, 0}; Point(6) = {2, 1, 0}; Line(5) = {2, 5}; Line(6) = {5, 6}; Line(7) = {6, 3};\n"
                "Curve Loop(2) = {5, 6, 7, -2}; Plane Surface(2) = {2}; Physical Surface(\"other\") = {2};\n"
                "Point(8) = {0.3, 0.5, 0}; Point(9) = {0.7, 0.5, 0}; Line(9) = {8, 9}; Curve {9} In Surface {1};\n")));
  expect_consistent(domain);
  EXPECT_EQ(domain.regions.size(), 2u);
  EXPECT_EQ(std::set<int>(domain.face_region.begin(), domain.face_region.end()).size(), 2u);
  int n_inside = 0;
  for (const Planar_domain::Curve& curve : domain.curves)
    if (curve.tag == 2 || curve.tag == 9) {
      ++n_inside;
      for (const auto h : curve.path)
        EXPECT_FALSE(domain.mesh.is_border(domain.mesh.edge(h)));
    }
  EXPECT_EQ(n_inside, 2);
}

TEST_F(Read_geometry, boundary_representation_of_open_cascade)
{
  const Planar_domain domain = read_planar_domain(
      write("occ.geo", "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 4, 2}; Disk(2) = {2, 1, 0, 0.5};\n"
                       "BooleanDifference(3) = {Surface{1}; Delete;}{Surface{2}; Delete;};\n"));
  expect_consistent(domain);
  EXPECT_EQ(domain.curves.size(), 5u);
  EXPECT_EQ(std::count_if(domain.curves.begin(), domain.curves.end(),
                          [](const Planar_domain::Curve& curve) { return curve.closed; }),
            1);
}

} // namespace
