// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_PARSE_MEDIT_H
#define QUADRILLE_MESH_IO_INTERNAL_PARSE_MEDIT_H

#include <Quadrille/Mesh_io/internal/Text_scanner.h>
#include <Quadrille/Mesh_io/internal/Volume_content.h>

#include <array>
#include <cctype>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// MEDIT meshes, text: Vertices, Edges, Triangles, Quadrilaterals and Tetrahedra; the sections may come in any order.
class Medit_parser {
public:
  Medit_parser(std::string_view text, const std::string& path) : m_scanner(text, path), m_path(path) {}

  /// Edges become features of the volume or lines of the surface. \throws Invalid_input_error
  Volume_content parse()
  {
    if (m_scanner.word_outside_comments() != "MeshVersionFormatted")
      m_scanner.fail("the file does not begin with MeshVersionFormatted: this is no MEDIT mesh in text form");
    m_scanner.number<int>(m_scanner.word_outside_comments(), "the version of the format");
    std::string_view keyword = m_scanner.word_outside_comments();
    while (!keyword.empty() && keyword != "End") {
      read_section(std::string(keyword));
      keyword = m_scanner.word_outside_comments();
    }
    if (!m_sections.count("Vertices"))
      m_scanner.fail("there is no section Vertices: the file is truncated or damaged");
    m_content.volume.points = std::move(m_points);
    check_corners(m_content.volume, m_path, 1);
    if (m_content.volume.tetrahedra.empty())
      make_surface();
    return std::move(m_content);
  }

private:
  void read_section(const std::string& keyword)
  {
    if (keyword == "Dimension") {
      const int dimension = m_scanner.number<int>(m_scanner.word_outside_comments(), "the dimension");
      if (dimension != 3)
        m_scanner.fail("the dimension is " + std::to_string(dimension) + ", not 3");
      return;
    }
    if (!m_sections.insert(keyword).second)
      m_scanner.fail("there is a second section " + keyword.substr(0, 40));
    if (keyword == "Vertices")
      read_vertices();
    else if (keyword == "Tetrahedra")
      read_elements("the number of tetrahedra", m_content.volume.tetrahedra);
    else if (keyword == "Triangles")
      read_elements("the number of triangles", m_triangles);
    else if (keyword == "Quadrilaterals")
      read_elements("the number of quadrilaterals", m_quadrilaterals);
    else if (keyword == "Edges")
      read_elements("the number of edges", m_content.volume.feature_edges);
    else
      skip_section(keyword);
  }

  void read_vertices()
  {
    m_points.resize(count("the number of vertices", 7));
    for (std::array<double, 3>& p : m_points) {
      for (double& x : p)
        x = m_scanner.finite_number(m_scanner.word_outside_comments(), "a coordinate");
      skip_reference();
    }
  }

  template <std::size_t n> void read_elements(std::string_view what, std::vector<std::array<int, n>>& elements)
  {
    elements.resize(count(what, 2 * n + 1));
    for (std::array<int, n>& corners : elements) {
      for (int& v : corners) {
        v = m_scanner.number<int>(m_scanner.word_outside_comments(), "a vertex number");
        // Vertices may come later in the file, so that too large numbers are found in the end.
        if (v < 1)
          m_scanner.fail("vertex numbers begin at 1");
        --v;
      }
      skip_reference();
    }
  }

  void skip_reference()
  {
    const std::string_view word = m_scanner.word_outside_comments();
    if (word.empty() || std::isalpha(static_cast<unsigned char>(word.front())))
      m_scanner.fail("the reference number at the end of the line is missing");
  }

  std::size_t count(std::string_view what, std::size_t bytes_each)
  {
    return m_scanner.count(m_scanner.word_outside_comments(), what, bytes_each);
  }

  /// Other sections have a count and then numbers, up to the next word.
  void skip_section(const std::string& keyword)
  {
    if (!std::isalpha(static_cast<unsigned char>(keyword.front())))
      m_scanner.fail("'" + keyword.substr(0, 40) + "' stands where the name of a section is expected");
    const std::size_t n = count("the number of " + keyword.substr(0, 40), 1);
    static const std::set<std::string> cells = {"Hexahedra", "Hexaedra",     "Prisms",      "Pentahedra", "Pyramids",
                                                "Polyhedra", "TetrahedraP2", "HexahedraQ2", "PrismsP2",   "PyramidsP2"};
    if (n > 0 && cells.count(keyword))
      m_scanner.fail("the file has " + std::to_string(n) + " cells of kind " + keyword + "; only Tetrahedra are read");
    for (;;) {
      const Text_scanner before = m_scanner;
      const std::string_view word = m_scanner.word_outside_comments();
      if (word.empty() || (std::isalpha(static_cast<unsigned char>(word.front())) && word != "nan" && word != "inf")) {
        m_scanner = before;
        return;
      }
    }
  }

  /// Triangles and lines where there are no tetrahedra.
  void make_surface()
  {
    Labelled_mesh& surface = m_content.surface;
    surface.points = std::move(m_content.volume.points);
    surface.lines = std::move(m_content.volume.feature_edges);
    m_content.volume = {};
    for (const std::array<int, 3>& t : m_triangles)
      surface.polygons.emplace_back(t.begin(), t.end());
    for (const std::array<int, 4>& q : m_quadrilaterals)
      surface.polygons.emplace_back(q.begin(), q.end());
    for (std::size_t i = 0; i < surface.polygons.size(); ++i)
      for (const int v : surface.polygons[i])
        if (std::size_t(v) >= surface.points.size())
          throw Invalid_input_error(m_path + ": polygon " + std::to_string(i + 1) + " uses vertex " +
                                    std::to_string(v + 1) + ", which does not exist (there are " +
                                    std::to_string(surface.points.size()) + ")");
    surface.polygon_region.assign(surface.polygons.size(), -1);
    surface.line_curve.assign(surface.lines.size(), -1);
  }

  Text_scanner m_scanner;
  const std::string& m_path;
  std::set<std::string> m_sections; ///< seen so far
  std::vector<std::array<double, 3>> m_points;
  std::vector<std::array<int, 3>> m_triangles;
  std::vector<std::array<int, 4>> m_quadrilaterals;
  Volume_content m_content;
};

} // namespace internal
} // namespace Quadrille

#endif
