// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_PARSE_OVM_H
#define QUADRILLE_MESH_IO_INTERNAL_PARSE_OVM_H

#include <Quadrille/Mesh_io/internal/Text_scanner.h>
#include <Quadrille/Mesh_io/internal/Volume_content.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// OpenVolumeMesh files, text, whose polyhedra are tetrahedra. Half-edge and half-face 2 i is edge or face i as it is
/// given, 2 i + 1 the same from the other side. Of the properties, AlgoHex's feature edges are read.
class Ovm_parser {
public:
  Ovm_parser(std::string_view text, const std::string& path) : m_scanner(text, path) {}

  /// \throws Invalid_input_error
  Tetrahedral_mesh parse()
  {
    const std::string header = lower(m_scanner.first_word_of_line());
    const std::string kind = lower(m_scanner.word_on_line());
    if (header != "ovm" || kind != "ascii")
      m_scanner.fail("the file does not begin with 'OVM ASCII'; binary files are not read");
    m_scanner.rest_of_line();
    read_vertices();
    read_edges();
    read_faces();
    read_polyhedra();
    read_properties();
    return std::move(m_mesh);
  }

private:
  static std::string lower(std::string_view word)
  {
    std::string result(word);
    std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return result;
  }

  std::size_t begin_section(const std::string& name, std::size_t bytes_each)
  {
    if (lower(m_scanner.first_word_of_line()) != lower(name))
      m_scanner.fail("the section " + name + " is expected here");
    m_scanner.rest_of_line();
    const std::size_t n = m_scanner.count(m_scanner.first_word_of_line(), "the number of " + lower(name), bytes_each);
    m_scanner.rest_of_line();
    return n;
  }

  int index(std::string_view word, std::string_view what, std::size_t end) const
  {
    const int i = m_scanner.number<int>(word, what);
    if (i < 0 || std::size_t(i) >= end)
      m_scanner.fail(std::string(what) + " is " + std::to_string(i) + ", and there are " + std::to_string(end));
    return i;
  }

  void read_vertices()
  {
    m_mesh.points.resize(begin_section("Vertices", 6));
    for (std::array<double, 3>& p : m_mesh.points) {
      p[0] = m_scanner.finite_number(m_scanner.first_word_of_line(), "a coordinate");
      p[1] = m_scanner.finite_number(m_scanner.word_on_line(), "a coordinate");
      p[2] = m_scanner.finite_number(m_scanner.word_on_line(), "a coordinate");
      m_scanner.rest_of_line();
    }
  }

  void read_edges()
  {
    m_edges.resize(begin_section("Edges", 4));
    for (std::array<int, 2>& e : m_edges) {
      e[0] = index(m_scanner.first_word_of_line(), "the number of a vertex", m_mesh.points.size());
      e[1] = index(m_scanner.word_on_line(), "the number of a vertex", m_mesh.points.size());
      m_scanner.rest_of_line();
    }
  }

  /// The corners of a face are those where its half-edges begin.
  void read_faces()
  {
    m_faces.resize(begin_section("Faces", 8));
    for (std::array<int, 3>& face : m_faces) {
      const int n = m_scanner.number<int>(m_scanner.first_word_of_line(), "a number of half-edges");
      if (n != 3)
        m_scanner.fail("a face has " + std::to_string(n) + " edges; only tetrahedra are read, with triangles as faces");
      std::array<int, 3> end{};
      for (std::size_t i = 0; i < 3; ++i) {
        const int h = index(m_scanner.word_on_line(), "the number of a half-edge", 2 * m_edges.size());
        const std::array<int, 2>& edge = m_edges[std::size_t(h / 2)];
        face[i] = edge[std::size_t(h % 2)];
        end[i] = edge[std::size_t(1 - h % 2)];
      }
      for (std::size_t i = 0; i < 3; ++i)
        if (end[i] != face[(i + 1) % 3])
          m_scanner.fail("the edges of this face do not follow each other");
      m_scanner.rest_of_line();
    }
  }

  void read_polyhedra()
  {
    m_mesh.tetrahedra.resize(begin_section("Polyhedra", 10));
    for (std::array<int, 4>& t : m_mesh.tetrahedra) {
      const int n = m_scanner.number<int>(m_scanner.first_word_of_line(), "a number of half-faces");
      if (n != 4)
        m_scanner.fail("a polyhedron has " + std::to_string(n) + " faces; only tetrahedra are read");
      std::array<std::array<int, 3>, 4> faces;
      for (std::array<int, 3>& face : faces) {
        face =
            m_faces[std::size_t(index(m_scanner.word_on_line(), "the number of a half-face", 2 * m_faces.size()) / 2)];
        std::sort(face.begin(), face.end());
      }
      t = corners(faces);
      m_scanner.rest_of_line();
    }
  }

  /// \pre the corners of each face are sorted
  std::array<int, 4> corners(std::array<std::array<int, 3>, 4> faces) const
  {
    std::array<int, 4> t = {faces[0][0], faces[0][1], faces[0][2], -1};
    for (const int v : faces[1])
      if (!std::binary_search(faces[0].begin(), faces[0].end(), v))
        t[3] = v;
    std::array<int, 4> sorted = t;
    std::sort(sorted.begin(), sorted.end());
    std::array<std::array<int, 3>, 4> expected = {{{sorted[0], sorted[1], sorted[2]},
                                                   {sorted[0], sorted[1], sorted[3]},
                                                   {sorted[0], sorted[2], sorted[3]},
                                                   {sorted[1], sorted[2], sorted[3]}}};
    std::sort(faces.begin(), faces.end());
    if (faces != expected || sorted[0] < 0)
      m_scanner.fail("the faces of this polyhedron do not bound a tetrahedron");
    return t;
  }

  /// Per property a line with the kind of elements, the type and the name in quotes, then a line per element.
  void read_properties()
  {
    while (true) {
      const std::string kind = lower(m_scanner.first_word_of_line());
      if (kind.empty())
        return;
      const bool is_feature_edges =
          m_scanner.rest_of_line().find("\"AlgoHex::FeatureEdges\"") != std::string_view::npos && kind == "eprop";
      for (std::size_t e = 0; is_feature_edges && e < m_edges.size(); ++e) {
        if (m_scanner.number<int>(m_scanner.first_word_of_line(), "a mark of an edge") != 0)
          m_mesh.feature_edges.push_back(m_edges[e]);
        m_scanner.rest_of_line();
      }
    }
  }

  Text_scanner m_scanner;
  Tetrahedral_mesh m_mesh;
  std::vector<std::array<int, 2>> m_edges;
  std::vector<std::array<int, 3>> m_faces; ///< their corners
};

} // namespace internal
} // namespace Quadrille

#endif
