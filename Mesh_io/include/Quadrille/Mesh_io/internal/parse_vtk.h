// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_PARSE_VTK_H
#define QUADRILLE_MESH_IO_INTERNAL_PARSE_VTK_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Mesh_io/internal/Text_scanner.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace Quadrille {
namespace internal {

/// Legacy VTK files, text and binary, versions 1 to 5: polygonal data and unstructured grids. Attributes are skipped.
class Vtk_parser {
public:
  Vtk_parser(const std::string& text, const std::string& path) : m_scanner(text, path) {}

  Labelled_mesh parse()
  {
    if (m_scanner.rest_of_line().rfind("# vtk DataFile", 0) != 0)
      m_scanner.fail("the file does not begin with '# vtk DataFile Version'");
    m_scanner.rest_of_line(); // title
    const std::string kind = upper(m_scanner.word());
    if (kind != "ASCII" && kind != "BINARY")
      m_scanner.fail("'" + kind + "' stands where ASCII or BINARY is expected");
    m_binary = kind == "BINARY";
    if (upper(m_scanner.word()) != "DATASET")
      m_scanner.fail("DATASET is missing");
    const std::string dataset = upper(m_scanner.word());
    if (dataset != "UNSTRUCTURED_GRID" && dataset != "POLYDATA")
      m_scanner.fail("data set '" + dataset + "' is not read; only UNSTRUCTURED_GRID and POLYDATA are");
    while (read_section()) {
    }
    if (m_cells.size() != m_types.size())
      m_scanner.fail("there are " + std::to_string(m_cells.size()) + " cells but " + std::to_string(m_types.size()) +
                     " cell types: the file is truncated or damaged");
    for (std::size_t c = 0; c < m_cells.size(); ++c)
      add_cell(c, m_types[c], m_cells[c]);
    m_mesh.line_curve.assign(m_mesh.lines.size(), -1);
    m_mesh.polygon_region.assign(m_mesh.polygons.size(), -1);
    return std::move(m_mesh);
  }

private:
  static std::string upper(std::string_view word)
  {
    std::string result(word);
    std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    return result;
  }

  bool read_section()
  {
    const std::string keyword = upper(m_scanner.word());
    if (keyword.empty() || keyword == "POINT_DATA" || keyword == "CELL_DATA" || keyword == "FIELD")
      return false;
    if (keyword == "POINTS")
      read_points();
    else if (keyword == "CELLS")
      m_cells = read_lists();
    else if (keyword == "CELL_TYPES")
      m_types = read_integers(m_scanner.count("the number of cell types", 1), "int");
    else if (keyword == "POLYGONS")
      append(read_lists(), 7);
    else if (keyword == "LINES")
      append(read_lists(), 4);
    else if (keyword == "VERTICES")
      read_lists();
    else if (keyword == "TRIANGLE_STRIPS")
      m_scanner.fail("triangle strips are not read; write triangles");
    else if (keyword == "METADATA")
      skip_metadata();
    else
      m_scanner.fail("unknown section '" + keyword.substr(0, 40) + "'");
    return true;
  }

  void skip_metadata()
  {
    m_scanner.rest_of_line();
    while (!m_scanner.at_end() && !m_scanner.rest_of_line().empty()) {
    }
  }

  void append(std::vector<std::vector<std::int64_t>> lists, std::int64_t type)
  {
    for (auto& list : lists) {
      m_cells.push_back(std::move(list));
      m_types.push_back(type);
    }
  }

  void read_points()
  {
    const std::size_t n = m_scanner.count("the number of points", 3);
    const std::string type = upper(m_scanner.word());
    std::vector<double> x;
    if (!m_binary) {
      for (std::size_t i = 0; i < 3 * n; ++i)
        x.push_back(m_scanner.number<double>("a coordinate"));
    } else {
      m_scanner.rest_of_line();
      if (type == "DOUBLE")
        x = read_binary<double, double>(3 * n);
      else if (type == "FLOAT")
        x = read_binary<float, double>(3 * n);
      else
        m_scanner.fail("points of type '" + type + "' are not read");
    }
    for (std::size_t i = 0; i < n; ++i)
      m_mesh.points.push_back({x[3 * i], x[3 * i + 1], x[3 * i + 2]});
  }

  /// The lists of CELLS, POLYGONS, ...: each with its length in front, or from version 5 on as offsets and one array.
  std::vector<std::vector<std::int64_t>> read_lists()
  {
    const std::size_t n = m_scanner.count("a number of cells", 1);
    const std::size_t size = m_scanner.count("a number of integers", 1);
    std::vector<std::vector<std::int64_t>> lists;
    m_scanner.rest_of_line();
    const Text_scanner before = m_scanner;
    if (upper(m_scanner.word()) == "OFFSETS") {
      const std::vector<std::int64_t> offsets = read_integers(n, upper(m_scanner.word()));
      if (upper(m_scanner.word()) != "CONNECTIVITY")
        m_scanner.fail("CONNECTIVITY is missing");
      const std::vector<std::int64_t> all = read_integers(size, upper(m_scanner.word()));
      for (std::size_t i = 1; i < offsets.size(); ++i) {
        if (offsets[i - 1] < 0 || offsets[i] < offsets[i - 1] || std::size_t(offsets[i]) > all.size())
          m_scanner.fail("the offsets of the cells are damaged");
        lists.emplace_back(all.begin() + offsets[i - 1], all.begin() + offsets[i]);
      }
      return lists;
    }
    m_scanner = before;
    const std::vector<std::int64_t> all = m_binary ? read_binary<std::int32_t, std::int64_t>(size) : read_text(size);
    for (std::size_t i = 0; lists.size() < n;) {
      if (i >= all.size() || all[i] < 0 || std::size_t(all[i]) >= all.size() - i)
        m_scanner.fail("the list of cells is damaged at cell " + std::to_string(lists.size()));
      lists.emplace_back(all.begin() + std::ptrdiff_t(i) + 1, all.begin() + std::ptrdiff_t(i) + 1 + all[i]);
      i += std::size_t(all[i]) + 1;
    }
    return lists;
  }

  std::vector<std::int64_t> read_integers(std::size_t n, const std::string& type)
  {
    if (!m_binary)
      return read_text(n);
    m_scanner.rest_of_line();
    return type == "VTKTYPEINT64" ? read_binary<std::int64_t, std::int64_t>(n)
                                  : read_binary<std::int32_t, std::int64_t>(n);
  }

  std::vector<std::int64_t> read_text(std::size_t n)
  {
    std::vector<std::int64_t> values;
    for (std::size_t i = 0; i < n; ++i)
      values.push_back(m_scanner.number<std::int64_t>("an integer"));
    return values;
  }

  /// Legacy VTK files are big-endian.
  template <class Stored, class Value> std::vector<Value> read_binary(std::size_t n)
  {
    const char* bytes = m_scanner.bytes(n * sizeof(Stored), "binary data");
    std::vector<Value> values(n);
    for (std::size_t i = 0; i < n; ++i) {
      char reversed[sizeof(Stored)];
      std::reverse_copy(bytes + i * sizeof(Stored), bytes + (i + 1) * sizeof(Stored), reversed);
      Stored value;
      std::memcpy(&value, reversed, sizeof value);
      values[i] = Value(value);
    }
    return values;
  }

  void add_cell(std::size_t c, std::int64_t type, const std::vector<std::int64_t>& corners)
  {
    std::vector<int> polygon;
    for (const std::int64_t v : corners) {
      if (v < 0 || v >= std::int64_t(m_mesh.points.size()))
        m_scanner.fail("cell " + std::to_string(c) + " uses point " + std::to_string(v) + ", which does not exist");
      polygon.push_back(int(v));
    }
    switch (type) {
    case 1: // vertices
    case 2:
      return;
    case 3: // lines
    case 4:
      for (std::size_t i = 1; i < polygon.size(); ++i)
        m_mesh.lines.push_back({polygon[i - 1], polygon[i]});
      return;
    case 5: // triangle, polygon, quadrangle
    case 7:
    case 9:
      if (polygon.size() < 3 || (type == 5 && polygon.size() != 3) || (type == 9 && polygon.size() != 4))
        m_scanner.fail("cell " + std::to_string(c) + " has " + std::to_string(polygon.size()) + " corners");
      m_mesh.polygons.push_back(std::move(polygon));
      return;
    default:
      m_scanner.fail("cell " + std::to_string(c) + " has VTK type " + std::to_string(type) +
                     "; only straight lines, triangles, quadrangles and polygons are read");
    }
  }

  Text_scanner m_scanner;
  bool m_binary = false;
  Labelled_mesh m_mesh;
  std::vector<std::vector<std::int64_t>> m_cells;
  std::vector<std::int64_t> m_types;
};

inline Labelled_mesh parse_vtk(const std::string& text, const std::string& path)
{
  return Vtk_parser(text, path).parse();
}

} // namespace internal
} // namespace Quadrille

#endif
