// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_PARSE_TETGEN_H
#define QUADRILLE_MESH_IO_INTERNAL_PARSE_TETGEN_H

#include <Quadrille/Mesh_io/internal/Text_scanner.h>
#include <Quadrille/Mesh_io/internal/Volume_content.h>
#include <Quadrille/Mesh_io/internal/files.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace Quadrille {
namespace internal {

/// TetGen's files: `.node` and `.ele`, and `.edge` where there is one. Points may be numbered from 0 or from 1.
class Tetgen_parser {
public:
  /// \param path of the .node or the .ele file
  explicit Tetgen_parser(const std::string& path)
      : m_node_path(beside(path, ".node")), m_ele_path(beside(path, ".ele")), m_edge_path(beside(path, ".edge"))
  {
    std::error_code code;
    for (const std::string& needed : {m_node_path, m_ele_path})
      if (!std::filesystem::exists(needed, code))
        throw Invalid_input_error(path + ": there is no " + needed + " beside it; TetGen's meshes are two files");
  }

  /// \throws Invalid_input_error
  Tetrahedral_mesh parse()
  {
    read_nodes();
    read_elements();
    std::error_code code;
    if (std::filesystem::exists(m_edge_path, code))
      read_edges();
    if (m_has_middle_nodes)
      remove_unused_points(m_mesh);
    return std::move(m_mesh);
  }

private:
  static std::string beside(const std::string& path, const std::string& extension)
  {
    return extension_of(path) == extension ? path : std::filesystem::path(path).replace_extension(extension).string();
  }

  /// An optional number of a header.
  static long long number_or(Text_scanner& scanner, long long otherwise, std::string_view what)
  {
    const std::string_view word = scanner.word_on_line();
    return word.empty() || word.front() == '#' ? otherwise : scanner.number<long long>(word, what);
  }

  void read_nodes()
  {
    const std::string text = read_whole_file(m_node_path);
    Text_scanner scanner(text, m_node_path);
    const std::size_t n = scanner.count(scanner.first_word_of_line(), "the number of points", 8);
    const long long dimension = number_or(scanner, 3, "the dimension");
    if (dimension != 3)
      scanner.fail("the dimension is " + std::to_string(dimension) + ", not 3");
    scanner.rest_of_line();
    m_mesh.points.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const long long number = scanner.number<long long>(scanner.first_word_of_line(), "the number of a point");
      if (i == 0)
        m_first = number;
      if ((m_first != 0 && m_first != 1) || number != m_first + static_cast<long long>(i))
        scanner.fail("point " + std::to_string(number) + " is out of order; they have to be numbered from 0 or 1 on");
      for (double& x : m_mesh.points[i])
        x = scanner.finite_number(scanner.word_on_line(), "a coordinate");
      scanner.rest_of_line(); // attributes and the marker
    }
  }

  int corner(Text_scanner& scanner)
  {
    const long long v = scanner.number<long long>(scanner.word_on_line(), "the number of a point");
    if (v < m_first || v - m_first >= static_cast<long long>(m_mesh.points.size()))
      scanner.fail("point " + std::to_string(v) + " does not exist; they are numbered from " + std::to_string(m_first) +
                   " to " + std::to_string(m_first + static_cast<long long>(m_mesh.points.size()) - 1));
    return int(v - m_first);
  }

  void read_elements()
  {
    const std::string text = read_whole_file(m_ele_path);
    Text_scanner scanner(text, m_ele_path);
    const std::size_t n = scanner.count(scanner.first_word_of_line(), "the number of tetrahedra", 10);
    const long long n_nodes = number_or(scanner, 4, "the number of nodes of a tetrahedron");
    if (n_nodes != 4 && n_nodes != 10)
      scanner.fail("elements have " + std::to_string(n_nodes) + " nodes; tetrahedra have 4 or 10");
    m_has_middle_nodes = n_nodes == 10;
    scanner.rest_of_line();
    m_mesh.tetrahedra.resize(n);
    for (std::array<int, 4>& t : m_mesh.tetrahedra) {
      scanner.number<long long>(scanner.first_word_of_line(), "the number of a tetrahedron");
      for (int& v : t)
        v = corner(scanner);
      for (long long i = 4; i < n_nodes; ++i)
        corner(scanner);
      scanner.rest_of_line(); // attributes
    }
  }

  /// All edges of the mesh, or those on segments of the input. TetGen marks the latter by a number other than zero.
  void read_edges()
  {
    const std::string text = read_whole_file(m_edge_path);
    Text_scanner scanner(text, m_edge_path);
    const std::size_t n = scanner.count(scanner.first_word_of_line(), "the number of edges", 6);
    const bool has_markers = number_or(scanner, 0, "the number of markers") != 0;
    scanner.rest_of_line();
    for (std::size_t e = 0; has_markers && e < n; ++e) {
      scanner.number<long long>(scanner.first_word_of_line(), "the number of an edge");
      const int a = corner(scanner), b = corner(scanner);
      std::string_view last; // after the node in the middle, where there is one
      for (std::string_view word = scanner.word_on_line(); !word.empty() && word.front() != '#';
           word = scanner.word_on_line())
        last = word;
      if (scanner.number<long long>(last, "a marker") != 0)
        m_mesh.feature_edges.push_back({a, b});
      scanner.rest_of_line();
    }
  }

  std::string m_node_path, m_ele_path, m_edge_path;
  long long m_first = 1; ///< number of the first point
  bool m_has_middle_nodes = false;
  Tetrahedral_mesh m_mesh;
};

} // namespace internal
} // namespace Quadrille

#endif
