// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "surface_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace {

using namespace Quadrille;

int count(const std::string& text, const std::string& part)
{
  int n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++n;
  return n;
}

/// The strokes of the path with a given colour.
int strokes(const std::string& picture, const std::string& color)
{
  const std::size_t at = picture.find("stroke=\"" + color);
  return at == std::string::npos ? 0 : count(picture.substr(at, picture.find("/>", at) - at), "M");
}

/// A cube with its edges as features; all eight corners are singular.
Surface_drawing cube()
{
  Surface_drawing drawing;
  for (int v = 0; v < 8; ++v)
    drawing.points.push_back({double(v & 1), double(v >> 1 & 1), double(v >> 2)});
  drawing.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  for (int v = 0; v < 8; ++v) {
    for (const int bit : {1, 2, 4})
      if ((v & bit) == 0)
        drawing.feature_edges.push_back({v, v | bit});
    drawing.singular_vertices.emplace_back(v, 3);
  }
  return drawing;
}

TEST(Surface_picture, closed_surfaces_show_their_front)
{
  const std::string picture = surface_picture(cube());
  EXPECT_EQ(count(picture, "Z\"/>"), 6);
  EXPECT_EQ(strokes(picture, "#000"), 9);
  EXPECT_EQ(count(picture, "<circle"), 7);
  EXPECT_EQ(count(picture, "#d22"), 7);
}

TEST(Surface_picture, open_ones_show_both_sides)
{
  Surface_drawing drawing = cube();
  drawing.triangles.erase(drawing.triangles.begin() + 2, drawing.triangles.begin() + 4); // the top
  drawing.toward_viewer = {0.3, -0.4, 1.0}; // into the box, down to its bottom
  const std::string picture = surface_picture(drawing);
  EXPECT_EQ(count(picture, "Z\"/>"), 10);
  EXPECT_EQ(strokes(picture, "#000"), 12);
}

TEST(Surface_picture, lines_and_crosses)
{
  Surface_drawing drawing;
  drawing.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  drawing.triangles = {{0, 1, 2}, {0, 2, 3}};
  drawing.isoline_spacing = 0.25;
  for (const auto& t : drawing.triangles) {
    drawing.uv.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& p = drawing.points[std::size_t(t[k])];
      drawing.uv.back()[k] = {p[0], 2 * p[1]};
    }
    drawing.frames.push_back({Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()});
  }
  const std::string picture = surface_picture(drawing);
  EXPECT_EQ(strokes(picture, "#c60"), 3 * 2 + 2); // in both triangles, and on the sides
  EXPECT_EQ(strokes(picture, "#083"), 7 * 2 + 2);
  EXPECT_EQ(count(picture, "stroke-width=\"1.3\""), 1); // equal sizes have one colour
  drawing.frames[0][0] *= 3;
  drawing.frames[1][1].setZero(); // without a frame
  EXPECT_EQ(count(surface_picture(drawing), "stroke-width=\"1.3\""), 1);
  drawing.frames[1][1] = 0.1 * Eigen::Vector3d::UnitY();
  EXPECT_EQ(count(surface_picture(drawing), "stroke-width=\"1.3\""), 2);
  drawing.frames[0][0].setConstant(std::nan(""));
  EXPECT_EQ(count(surface_picture(drawing), "nan"), 0);
}

} // namespace
