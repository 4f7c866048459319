// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "surface_texts.h"
#include "temporary_files.h"
#include "vtu_file.h"

#include <Quadrille/Size_specification.h>
#include <Quadrille/domain_curves.h>
#include <Quadrille/read_domain.h>
#include <Quadrille/read_mesh.h>
#include <Quadrille/read_surface_domain.h>
#include <Quadrille/write_mesh.h>

#include <algorithm>
#include <cmath>

using namespace Quadrille;

namespace {

class Surfaces : public Temporary_files {
protected:
  /// Reading has to fail with a message that names the file and contains `reason`.
  void expect_error(const std::string& name, const std::string& text, const std::string& reason)
  {
    const std::string file = write(name, text);
    try {
      read_surface_domain(file);
      FAIL() << name << " was read";
    } catch (const Invalid_input_error& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(file), std::string::npos) << message;
      EXPECT_NE(message.find(reason), std::string::npos) << message;
    }
  }

  Surface_domain read(const std::string& name, const std::string& text, const Surface_domain_options& options = {})
  {
    return read_surface_domain(write(name, text), options);
  }

  /// With the triangles of the file alone.
  Surface_domain read_as_it_is(const std::string& name, const std::string& text)
  {
    Surface_domain_options options;
    options.split_chords = false;
    return read(name, text, options);
  }
};

TEST_F(Surfaces, creases_of_a_cube_are_its_edges)
{
  for (const double scale : {1.0, 1e8, 1e-8}) {
    const Surface_domain cube = read("cube.off", cube_text(3, scale));
    expect_sound(cube);
    EXPECT_EQ(euler_characteristic(cube), 2);
    EXPECT_EQ(cube.mesh.number_of_faces(), 6u * 9 * 2 + 24); // two triangles on each side lie in its corners
    EXPECT_EQ(cube.curves.size(), 12u);
    for (const Surface_domain::Curve& curve : cube.curves)
      EXPECT_EQ(curve.path.size(), 3u);
    EXPECT_TRUE(has_note(cube, "creases of more than 40 degrees are taken for them: 36 edges"));
    EXPECT_FALSE(has_note(cube, "inwards"));
    EXPECT_NEAR(enclosed_volume(cube), std::pow(3 * scale, 3), 1e-9 * std::pow(3 * scale, 3));
  }
}

TEST_F(Surfaces, polygons_are_divided_and_unused_points_left_out)
{
  const std::string quads = "OFF\n9 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n5 5 5\n"
                            "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  const Surface_domain cube = read_as_it_is("quads.off", quads);
  expect_sound(cube);
  EXPECT_EQ(cube.mesh.number_of_faces(), 12u);
  EXPECT_EQ(cube.mesh.number_of_vertices(), 8u);
  EXPECT_NEAR(enclosed_volume(cube), 1, 1e-12);
  EXPECT_TRUE(has_note(cube, "6 polygons with more than three corners were divided"));
  EXPECT_TRUE(has_note(cube, "1 point that no triangle uses was left out"));
}

TEST_F(Surfaces, crease_angle_is_an_option)
{
  Surface_domain_options options;
  options.crease_angle = 180;
  const Surface_domain smooth = read("cube.off", cube_text(2, 1), options);
  EXPECT_TRUE(smooth.curves.empty());
  EXPECT_TRUE(has_note(smooth, "creases are not looked for"));
  options.crease_angle = 91;
  EXPECT_TRUE(read("cube.off", cube_text(2, 1), options).curves.empty());
  for (const double wrong : {0.0, -1.0, 181.0, std::nan("")}) {
    options.crease_angle = wrong;
    EXPECT_THROW(read("cube.off", cube_text(2, 1), options), Invalid_argument_error);
  }
}

TEST_F(Surfaces, short_creases_with_loose_ends_are_noise)
{
  // A sheet with a ridge along its middle that fades out towards both ends.
  const auto ridge = [](double length) {
    return sheet_text(
        40, 4, [=](int i, int j) { return -0.6 * std::abs(j - 2) * std::max(0.0, 1 - std::abs(i - 20) / length); });
  };
  const Surface_domain with = read("a.off", ridge(20));
  expect_sound(with);
  EXPECT_EQ(with.curves.size(), 4u + 1);
  const Surface_domain without = read("b.off", ridge(5));
  EXPECT_EQ(without.curves.size(), 4u);
  EXPECT_TRUE(has_note(without, "edges of short ones with loose ends not"));
  Surface_domain_options options;
  options.min_crease_edges = 0;
  EXPECT_EQ(read("b.off", ridge(5), options).curves.size(), 4u + 1);
}

TEST_F(Surfaces, triangles_between_curves_get_vertices_of_their_own)
{
  for (const double scale : {1.0, 1e8, 1e-8}) {
    const Surface_domain cube = read("cube.off", cube_text(1, scale));
    expect_sound(cube);
    EXPECT_EQ(cube.mesh.number_of_vertices(), 8u + 6u); // one on each diagonal
    EXPECT_EQ(cube.mesh.number_of_faces(), 6u * 4);
    EXPECT_EQ(cube.curves.size(), 12u);
    EXPECT_NEAR(enclosed_volume(cube), std::pow(scale, 3), 1e-9 * std::pow(scale, 3));
    EXPECT_TRUE(has_note(cube, "6 vertices were added where triangles had all their corners on curves"));
  }
  const std::string tetrahedron =
      off_text({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}});
  const Surface_domain closed = read("tetrahedron.off", tetrahedron);
  expect_sound(closed);
  EXPECT_EQ(closed.mesh.number_of_faces(), 12u); // three around each centre
  EXPECT_EQ(read_as_it_is("tetrahedron.off", tetrahedron).mesh.number_of_faces(), 4u);
}

TEST_F(Surfaces, sharp_corners_are_not_halved)
{
  // A corner of 20 degrees, and beyond it a triangle that is bent upwards: all of the border is curve.
  const std::string points = "0 0 0\n1 0 0\n0.94 0.342 0\n2 0.3 0.5\n1.31 0.21 0.17\n";
  const Surface_domain needle = read("needle.off", "OFF\n5 4 0\n" + points + "3 0 1 2\n3 1 3 4\n3 3 2 4\n3 2 1 4\n");
  EXPECT_EQ(needle.mesh.number_of_faces(), 4u);
  // Without the vertex inside there would be no free one, and this is no quadrilateral by its angles.
  const Surface_domain rigid = read("rigid.off", "OFF\n5 2 0\n" + points + "3 0 1 2\n3 1 3 2\n");
  EXPECT_EQ(rigid.mesh.number_of_faces(), 4u);
}

TEST_F(Surfaces, marked_lines_are_the_features)
{
  const std::string lines = obj_of_off(cube_text(2, 1));
  const Surface_domain cube = read("cube.obj", lines + "l 1 2 3\n");
  expect_sound(cube);
  ASSERT_EQ(cube.curves.size(), 1u);
  EXPECT_EQ(cube.curves[0].path.size(), 2u);
  EXPECT_TRUE(has_note(cube, "2 edges on lines of the file"));
  expect_error("diagonal.obj", lines + "l 1 9\n", "line element 0");
  expect_error("unused.obj", lines + "v 7 7 7\nl 1 " + std::to_string(cube.mesh.number_of_vertices() + 1) + "\n",
               "is not an edge of the triangles");
}

TEST_F(Surfaces, regions_bound_each_other)
{
  const Surface_domain tent = read("tent.msh", tent_msh());
  expect_sound(tent);
  EXPECT_EQ(tent.regions.size(), 2u);
  EXPECT_TRUE(has_note(tent, "1 edges between regions"));
  const int ridge = int(std::count_if(tent.mesh.edges().begin(), tent.mesh.edges().end(), [&](auto e) {
    return !tent.mesh.is_border(e) && tent.edge_curve[std::size_t(e.idx())] >= 0;
  }));
  EXPECT_EQ(ridge, 1);
  EXPECT_EQ(curves_named(tent, "front").size(), 1u);

  Size_specification sizes;
  sizes.add("front=0.5:0.25");
  const Domain_sizes prescribed = sizes.apply(tent);
  const Surface_domain::Curve& front = tent.curves[std::size_t(curves_named(tent, "front")[0])];
  ASSERT_EQ(front.path.size(), 1u);
  const auto size = prescribed.of_edge[std::size_t(tent.mesh.edge(front.path[0]).idx())];
  EXPECT_EQ(std::min(size[0].tangential, size[1].tangential), 0.25);
  EXPECT_EQ(std::max(size[0].tangential, size[1].tangential), 0.5);
  Surface_domain copy = tent;
  EXPECT_THROW(remove_curves(copy, curves_named(copy, "front")), Invalid_argument_error);
  try {
    Size_specification wrong;
    wrong.add("back=1");
    wrong.apply(tent);
    FAIL();
  } catch (const Invalid_argument_error& error) {
    EXPECT_NE(std::string(error.what()).find("there is no curve named 'back'"), std::string::npos) << error.what();
  }
}

TEST_F(Surfaces, inward_normals_and_equal_points_are_noted)
{
  const Surface_domain cube = read("inward.off", cube_text(2, 1, true));
  EXPECT_TRUE(has_note(cube, "1 of 1 closed component point inwards"));
  EXPECT_LT(enclosed_volume(cube), 0);
  const Surface_domain touching =
      read("touching.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n1 0 0\n1 1 1\n0 2 0\n3 0 1 2\n3 3 4 5\n");
  expect_sound(touching);
  EXPECT_TRUE(has_note(touching, "1 point"));
  EXPECT_TRUE(has_note(touching, "the surface is not connected there"));
}

TEST_F(Surfaces, bad_meshes_are_refused)
{
  const std::string p = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n";
  expect_error("empty.off", "OFF\n0 0 0\n", "there are no triangles");
  expect_error("points.obj", "v 0 0 0\n", "there are no triangles");
  expect_error("nan.off", "OFF\n3 1 0\n0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n", "");
  expect_error("huge.off", "OFF\n3 1 0\n0 0 0\n1e101 0 0\n0 1 0\n3 0 1 2\n", "beyond 1e100");
  expect_error("twice.off", "OFF\n5 1 0\n" + p + "3 0 1 1\n", "uses a point twice");
  expect_error("flat.off", "OFF\n3 1 0\n0 0 0\n1 1 1\n2 2 2\n3 0 1 2\n", "corners lie on a line");
  expect_error("sliver.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0.5 0 1e-11\n3 0 1 2\n", "smallest altitude");
  EXPECT_NO_THROW(read("thin.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0.5 0 1e-9\n3 0 1 2\n"));
  EXPECT_NO_THROW(read("small.off", "OFF\n3 1 0\n0 0 0\n1e-30 0 0\n0 0 1e-30\n3 0 1 2\n"));
  expect_error("repeated.off", "OFF\n5 2 0\n" + p + "3 0 1 2\n3 1 2 0\n", "is repeated as triangle 1");
  expect_error("fan.off", "OFF\n5 3 0\n" + p + "3 0 1 2\n3 1 0 3\n3 0 1 4\n", "belongs to 3 triangles (0, 1, 2");
  expect_error("cut.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n1 0 0\n1 1 1\n0 1 0\n3 0 1 2\n3 3 4 5\n",
               "has a crack: at the edge from (1, 0, 0) to (0, 1, 0), triangles 0 and 1");
  expect_error("bow_tie.off", "OFF\n5 2 0\n" + p + "3 0 1 2\n3 0 3 4\n", "several separate fans");
  expect_error("mixed.off", "OFF\n5 2 0\n" + p + "3 0 1 2\n3 0 1 3\n", "turning around 1 of 2 triangles");
  expect_error("moebius.off", moebius_text(12), "not orientable");
  expect_error("truncated.off", "OFF\n5 2 0\n" + p + "3 0 1 2\n", "the file ends at face 1 of 2");
  expect_error("binary.off", "OFF BINARY\n123", "binary OFF");
}

TEST_F(Surfaces, surfaces_that_intersect_themselves_are_read)
{
  const Surface_domain cross = read_as_it_is(
      "cross.off", "OFF\n6 2 0\n0 0 0\n2 0 0\n0 2 0\n0.5 0.5 -1\n0.5 0.5 1\n1.5 0.5 0\n3 0 1 2\n3 3 4 5\n");
  expect_sound(cross);
  EXPECT_EQ(cross.mesh.number_of_faces(), 2u);
  EXPECT_EQ(euler_characteristic(cross), 2); // of two disks
}

TEST_F(Surfaces, planar_meshes_are_told_apart)
{
  const auto index = [&](const std::string& height) {
    return read_domain(write("s.off", "OFF\n4 2 0\n0 0 3\n1 0 3\n1 1 " + height + "\n0 1 3\n3 0 1 2\n3 0 2 3\n"))
        .index();
  };
  EXPECT_EQ(index("3"), 0u);
  EXPECT_EQ(index("3.0000000001"), 0u);
  EXPECT_EQ(index("3.00001"), 1u);
  EXPECT_EQ(read_domain(write("cube.mesh", medit_of_off(cube_text(1, 1)))).index(), 1u);
  Surface_domain_options options;
  options.triangle_size = 1;
  EXPECT_THROW(read_domain(write("cube.off", cube_text(1, 1)), {}, options), Invalid_argument_error);
}

TEST_F(Surfaces, fields_and_maps_are_written)
{
  const Surface_domain cube = read_as_it_is("cube.off", cube_text(1, 1));
  const std::size_t n = cube.mesh.number_of_faces();
  const std::vector<std::array<double, 3>> u(n, {1, 2, 2}), v(n, {0, 0, -5});
  std::vector<int> valence(cube.mesh.number_of_vertices(), 3);
  valence[0] = 4;
  write_frame_field(path("f.vtu"), cube, u, v, valence);
  const Vtu_file field(content(path("f.vtu")));
  EXPECT_EQ(field.attribute("<Piece", "NumberOfPoints"), "8");
  EXPECT_EQ(field.attribute("<Piece", "NumberOfCells"), std::to_string(12 + 12 + 7));
  const std::vector<double> vectors = field.array<double>("u"), sizes = field.array<double>("size_v");
  EXPECT_EQ(std::vector<double>(vectors.begin(), vectors.begin() + 3), (std::vector<double>{1, 2, 2}));
  EXPECT_EQ(std::count(sizes.begin(), sizes.end(), 5.0), 12);
  const std::vector<std::int32_t> dimension = field.array<std::int32_t>("dimension");
  for (const auto& [d, count] : {std::pair(2, 12), std::pair(1, 12), std::pair(0, 7)})
    EXPECT_EQ(std::count(dimension.begin(), dimension.end(), d), count);
  const std::vector<std::int32_t> singular = field.array<std::int32_t>("singular");
  EXPECT_EQ(std::count(singular.begin(), singular.end(), 1), 7);
  EXPECT_EQ(singular[0], 0);

  write_corner_map(path("m.obj"), cube,
                   std::vector<Planar_domain::Point_2>(cube.mesh.number_of_halfedges(), Planar_domain::Point_2(1, 2)));
  const Labelled_mesh map = read_mesh(path("m.obj"));
  EXPECT_EQ(map.polygons.size(), 12u);
  EXPECT_EQ(map.points.size(), 8u);
  EXPECT_THROW(write_corner_map(path("m.vtk"), cube, {}), Invalid_argument_error);
}

TEST_F(Surfaces, real_meshes)
{
  const std::filesystem::path folder = std::filesystem::path(QUADRILLE_SHARED_DATA) / "surface";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "no shared data";
  struct Case {
    const char* file;
    int euler_characteristic;
    const char* reason;
  };
  for (const Case& c : {Case{"mpz14_like/botijo.off", -8, ""}, Case{"mpz14_like/fertility_input.off", -6, ""},
                        Case{"mpz14_like/genus3.off", -4, ""}, Case{"mpz14_like/retinal_miq.obj", 2, ""},
                        Case{"directional/half-torus.obj", 0, ""}, Case{"common/suzanne.obj", 0, "is repeated as"},
                        Case{"common/teapot.obj", 0, "several separate fans"}}) {
    const std::string file = (folder / c.file).string();
    try {
      const Surface_domain domain = read_surface_domain(file);
      EXPECT_STREQ(c.reason, "") << file;
      expect_sound(domain);
      EXPECT_EQ(euler_characteristic(domain), c.euler_characteristic) << file;
    } catch (const Invalid_input_error& error) {
      EXPECT_STRNE(c.reason, "") << error.what();
      EXPECT_NE(std::string(error.what()).find(c.reason), std::string::npos) << error.what();
    }
  }
}

} // namespace
