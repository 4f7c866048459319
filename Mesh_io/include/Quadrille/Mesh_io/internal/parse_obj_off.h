// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_PARSE_OBJ_OFF_H
#define QUADRILLE_MESH_IO_INTERNAL_PARSE_OBJ_OFF_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Mesh_io/internal/Text_scanner.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

namespace Quadrille {
namespace internal {

inline std::array<double, 3> scan_point(Text_scanner& scanner)
{
  std::array<double, 3> point;
  for (double& x : point)
    x = scanner.number<double>(scanner.word_on_line(), "a coordinate");
  return point;
}

/// Wavefront OBJ: vertices, faces and lines; texture coordinates, normals, groups and materials are skipped.
inline Labelled_mesh parse_obj(std::string text, const std::string& path)
{
  for (std::size_t i = text.find('\\'); i != std::string::npos; i = text.find('\\', i + 1)) {
    const std::size_t end = text.find_first_not_of("\r", i + 1);
    if (end != std::string::npos && text[end] == '\n') // a line goes on
      std::fill(text.begin() + std::ptrdiff_t(i), text.begin() + std::ptrdiff_t(end) + 1, ' ');
  }
  Labelled_mesh mesh;
  Text_scanner scanner(text, path);
  const auto vertex = [&](std::string_view word) {
    const long index = scanner.number<long>(word.substr(0, word.find('/')), "a vertex number");
    const long n = long(mesh.points.size());
    const long vertex = index < 0 ? n + index : index - 1;
    if (vertex < 0 || vertex >= n)
      scanner.fail("vertex " + std::to_string(index) + " does not exist (there are " + std::to_string(n) +
                   " before this line)");
    return int(vertex);
  };
  while (!scanner.at_end()) {
    const std::string_view keyword = scanner.word_on_line();
    if (keyword == "v") {
      mesh.points.push_back(scan_point(scanner));
    } else if (keyword == "f" || keyword == "l") {
      std::vector<int> corners;
      for (std::string_view word = scanner.word_on_line(); !word.empty() && word.front() != '#';
           word = scanner.word_on_line())
        corners.push_back(vertex(word));
      if (keyword == "l") {
        for (std::size_t i = 1; i < corners.size(); ++i)
          mesh.lines.push_back({corners[i - 1], corners[i]});
      } else if (corners.size() < 3) {
        scanner.fail("a face needs at least 3 vertices");
      } else {
        mesh.polygons.push_back(std::move(corners));
      }
    } else if (!keyword.empty() && keyword.front() != '#' && !std::isalpha(static_cast<unsigned char>(keyword[0]))) {
      scanner.fail("'" + std::string(keyword.substr(0, 40)) +
                   "' is no OBJ keyword: this is not an OBJ file, or damaged");
    }
    scanner.rest_of_line();
  }
  mesh.line_curve.assign(mesh.lines.size(), -1);
  mesh.polygon_region.assign(mesh.polygons.size(), -1);
  return mesh;
}

/// Object File Format, text; colours and other extras at the ends of lines are skipped.
inline Labelled_mesh parse_off(const std::string& text, const std::string& path)
{
  Text_scanner scanner(text, path);
  std::string_view word = scanner.first_word_of_line();
  if (word != "OFF" && word != "COFF")
    scanner.fail("the file does not begin with OFF");
  word = scanner.word_on_line();
  if (word == "BINARY")
    scanner.fail("binary OFF files are not read, since their byte order is not told; save the mesh as text");
  if (word.empty() || word.front() == '#') {
    scanner.rest_of_line();
    word = scanner.first_word_of_line();
  }
  const long long n_points = scanner.number<long long>(word, "the number of vertices");
  const std::size_t n_faces = scanner.count("the number of faces", 2);
  if (n_points < 0 || std::size_t(n_points) > scanner.remaining())
    scanner.fail("the number of vertices is " + std::to_string(n_points) +
                 ", more than the file has room for: it is truncated or damaged");
  scanner.rest_of_line();

  Labelled_mesh mesh;
  for (long long v = 0; v < n_points; ++v) {
    word = scanner.first_word_of_line();
    if (word.empty())
      scanner.fail("the file ends at vertex " + std::to_string(v) + " of " + std::to_string(n_points));
    const double x = scanner.number<double>(word, "a coordinate");
    const double y = scanner.number<double>(scanner.word_on_line(), "a coordinate");
    mesh.points.push_back({x, y, scanner.number<double>(scanner.word_on_line(), "a coordinate")});
    scanner.rest_of_line();
  }
  for (std::size_t f = 0; f < n_faces; ++f) {
    word = scanner.first_word_of_line();
    if (word.empty())
      scanner.fail("the file ends at face " + std::to_string(f) + " of " + std::to_string(n_faces));
    const long n = scanner.number<long>(word, "a number of corners");
    if (n < 3)
      scanner.fail("face " + std::to_string(f) + " has " + std::to_string(n) + " corners");
    std::vector<int> corners;
    for (long i = 0; i < n; ++i) {
      const long v = scanner.number<long>(scanner.word_on_line(), "a vertex number");
      if (v < 0 || v >= n_points)
        scanner.fail("face " + std::to_string(f) + " uses vertex " + std::to_string(v) + ", which does not exist");
      corners.push_back(int(v));
    }
    mesh.polygons.push_back(std::move(corners));
    scanner.rest_of_line();
  }
  mesh.polygon_region.assign(mesh.polygons.size(), -1);
  return mesh;
}

} // namespace internal
} // namespace Quadrille

#endif
