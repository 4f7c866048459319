// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_PARSE_VTK_H
#define QUADRILLE_MESH_IO_INTERNAL_PARSE_VTK_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Mesh_io/internal/Text_scanner.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Points, and cells one after the other: cell c has the points `corners[begin[c]], ..., corners[begin[c + 1] - 1]`.
struct Vtk_data {
  std::vector<std::array<double, 3>> points;
  std::vector<int> corners;
  std::vector<std::size_t> begin{0};
  std::vector<int> types; ///< per cell, as VTK numbers them

  std::size_t number_of_corners(std::size_t c) const { return begin[c + 1] - begin[c]; }
  const int* corners_of(std::size_t c) const { return corners.data() + begin[c]; }
};

/// Legacy VTK files, text and binary, versions 1 to 5: polygonal data and unstructured grids. Attributes are skipped.
class Vtk_parser {
public:
  Vtk_parser(const std::string& text, const std::string& path) : m_scanner(text, path) {}

  /// \throws Invalid_input_error, also if a cell uses a point that does not exist
  Vtk_data parse()
  {
    if (m_scanner.rest_of_line().rfind("# vtk DataFile", 0) != 0)
      m_scanner.fail("the file does not begin with '# vtk DataFile Version'");
    m_scanner.rest_of_line(); // title
    const std::string kind = upper(m_scanner.word());
    if (kind != "ASCII" && kind != "BINARY")
      m_scanner.fail("'" + kind.substr(0, 40) + "' stands where ASCII or BINARY is expected");
    m_binary = kind == "BINARY";
    if (upper(m_scanner.word()) != "DATASET")
      m_scanner.fail("DATASET is missing");
    const std::string dataset = upper(m_scanner.word());
    if (dataset != "UNSTRUCTURED_GRID" && dataset != "POLYDATA")
      m_scanner.fail("data set '" + dataset.substr(0, 40) + "' is not read; only UNSTRUCTURED_GRID and POLYDATA are");
    while (read_section()) {
    }
    const std::size_t n_cells = m_data.begin.size() - 1;
    if (n_cells != m_data.types.size())
      m_scanner.fail("there are " + std::to_string(n_cells) + " cells but " + std::to_string(m_data.types.size()) +
                     " cell types: the file is truncated or damaged");
    for (std::size_t c = 0; c < n_cells; ++c)
      for (std::size_t i = m_data.begin[c]; i < m_data.begin[c + 1]; ++i)
        if (m_data.corners[i] < 0 || std::size_t(m_data.corners[i]) >= m_data.points.size())
          m_scanner.fail("cell " + std::to_string(c) + " uses point " + std::to_string(m_data.corners[i]) +
                         ", which does not exist");
    return std::move(m_data);
  }

  [[noreturn]] void fail(const std::string& reason) const { m_scanner.fail(reason); }

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
    if (keyword.empty() || keyword == "POINT_DATA" || keyword == "CELL_DATA")
      return false;
    if (keyword == "POINTS")
      read_points();
    else if (keyword == "CELLS")
      read_lists();
    else if (keyword == "CELL_TYPES")
      m_data.types = read_integers(m_scanner.count("the number of cell types", 1), "int");
    else if (keyword == "POLYGONS")
      read_lists(7);
    else if (keyword == "LINES")
      read_lists(4);
    else if (keyword == "VERTICES")
      read_lists(2);
    else if (keyword == "TRIANGLE_STRIPS")
      m_scanner.fail("triangle strips are not read; write triangles");
    else if (keyword == "METADATA")
      skip_metadata();
    else if (keyword == "FIELD")
      skip_fields();
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

  /// Numbers about the data set as a whole (its time, for instance), which may stand before everything else.
  void skip_fields()
  {
    m_scanner.word();
    const std::size_t n_arrays = m_scanner.count("the number of arrays", 1);
    for (std::size_t a = 0; a < n_arrays; ++a) {
      m_scanner.word();
      const std::size_t n_components = m_scanner.count("a number of components", 1);
      const std::size_t n_tuples = m_scanner.count("a number of values", 1);
      const std::string type = upper(m_scanner.word());
      if (n_components > 0 && n_tuples > m_scanner.remaining() / n_components + 1)
        m_scanner.fail("the file ends within a field");
      const std::size_t n = n_components * n_tuples;
      if (!m_binary) {
        for (std::size_t i = 0; i < n; ++i)
          m_scanner.word();
        continue;
      }
      m_scanner.rest_of_line();
      m_scanner.bytes(n * size_of(type), "field");
    }
  }

  std::size_t size_of(const std::string& type) const
  {
    static constexpr std::pair<std::string_view, std::size_t> sizes[] = {
        {"CHAR", 1},  {"UNSIGNED_CHAR", 1}, {"SHORT", 2},        {"UNSIGNED_SHORT", 2},
        {"INT", 4},   {"UNSIGNED_INT", 4},  {"LONG", 8},         {"UNSIGNED_LONG", 8},
        {"FLOAT", 4}, {"DOUBLE", 8},        {"VTKTYPEINT64", 8}, {"VTKIDTYPE", 4}};
    for (const auto& [name, size] : sizes)
      if (name == type)
        return size;
    m_scanner.fail("a field of type '" + type.substr(0, 40) + "' is not read");
  }

  void read_points()
  {
    const std::size_t n = m_scanner.count("the number of points", 3);
    if (!m_data.points.empty())
      m_scanner.fail("there are two sections of points");
    const std::string type = upper(m_scanner.word());
    m_data.points.resize(n);
    if (!m_binary) {
      for (std::array<double, 3>& p : m_data.points)
        for (double& x : p)
          x = m_scanner.number<double>("a coordinate");
    } else {
      m_scanner.rest_of_line();
      if (type == "DOUBLE")
        read_binary_points<double>();
      else if (type == "FLOAT")
        read_binary_points<float>();
      else
        m_scanner.fail("points of type '" + type.substr(0, 40) + "' are not read");
    }
  }

  template <class Stored> void read_binary_points()
  {
    const std::size_t n = m_data.points.size();
    const char* bytes = m_scanner.bytes(3 * n * sizeof(Stored), "binary data");
    for (std::size_t i = 0; i < 3 * n; ++i)
      m_data.points[i / 3][i % 3] = double(big_endian<Stored>(bytes + i * sizeof(Stored)));
  }

  /// The lists of CELLS, POLYGONS, ...: each with its length in front, or from version 5 on as offsets and one array.
  /// They are all of the given type, or of types that another section tells.
  void read_lists(int type = -1)
  {
    const std::size_t n = m_scanner.count("a number of cells", 1);
    const std::size_t size = m_scanner.count("a number of integers", 1);
    const Text_scanner before = m_scanner;
    m_scanner.rest_of_line();
    const std::size_t first_cell = m_data.begin.size() - 1, first_corner = m_data.corners.size();
    if (upper(m_scanner.word()) == "OFFSETS") {
      const std::vector<int> offsets = read_integers(n, upper(m_scanner.word()));
      if (upper(m_scanner.word()) != "CONNECTIVITY")
        m_scanner.fail("CONNECTIVITY is missing");
      append_corners(read_integers(size, upper(m_scanner.word())));
      for (std::size_t i = 0; i < offsets.size(); ++i) {
        if (offsets[i] < (i == 0 ? 0 : offsets[i - 1]) || (i == 0 && offsets[i] != 0) ||
            std::size_t(offsets[i]) > m_data.corners.size() - first_corner)
          m_scanner.fail("the offsets of the cells are damaged");
        if (i > 0)
          m_data.begin.push_back(first_corner + std::size_t(offsets[i]));
      }
    } else {
      m_scanner = before;
      append_lists(read_integers(size, "int"), n);
    }
    if (type >= 0)
      m_data.types.resize(m_data.types.size() + (m_data.begin.size() - 1 - first_cell), type);
  }

  void append_corners(std::vector<int> corners)
  {
    if (m_data.corners.empty())
      m_data.corners = std::move(corners);
    else
      m_data.corners.insert(m_data.corners.end(), corners.begin(), corners.end());
  }

  void append_lists(std::vector<int> all, std::size_t n)
  {
    std::size_t end = 0; // what is kept moves to the front
    const std::size_t first_corner = m_data.corners.size();
    m_data.begin.reserve(m_data.begin.size() + std::min(n, all.size()));
    for (std::size_t i = 0, c = 0; c < n; ++c) {
      if (i >= all.size() || all[i] < 0 || std::size_t(all[i]) >= all.size() - i)
        m_scanner.fail("the list of cells is damaged at cell " + std::to_string(c));
      const std::size_t length = std::size_t(all[i]);
      std::copy(all.begin() + std::ptrdiff_t(i) + 1, all.begin() + std::ptrdiff_t(i + 1 + length),
                all.begin() + std::ptrdiff_t(end));
      end += length;
      i += length + 1;
      m_data.begin.push_back(first_corner + end);
    }
    all.resize(end);
    append_corners(std::move(all));
  }

  std::vector<int> read_integers(std::size_t n, const std::string& type)
  {
    std::vector<int> values(n);
    if (!m_binary) {
      for (int& value : values)
        value = m_scanner.number<int>("an integer");
      return values;
    }
    m_scanner.rest_of_line();
    if (type == "VTKTYPEINT64")
      read_binary_integers<std::int64_t>(values);
    else
      read_binary_integers<std::int32_t>(values);
    return values;
  }

  template <class Stored> void read_binary_integers(std::vector<int>& values)
  {
    const char* bytes = m_scanner.bytes(values.size() * sizeof(Stored), "binary data");
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::int64_t value = big_endian<Stored>(bytes + i * sizeof(Stored));
      if (value < 0 || value > std::numeric_limits<int>::max())
        m_scanner.fail("the integer " + std::to_string(value) + " is out of range: the file is damaged");
      values[i] = int(value);
    }
  }

  /// Legacy VTK files are big-endian.
  template <class Stored> static Stored big_endian(const char* bytes)
  {
    char reversed[sizeof(Stored)];
    std::reverse_copy(bytes, bytes + sizeof(Stored), reversed);
    Stored value;
    std::memcpy(&value, reversed, sizeof value);
    return value;
  }

  Text_scanner m_scanner;
  bool m_binary = false;
  Vtk_data m_data;
};

/// \throws Invalid_input_error if the cell has another number of corners than its type, or is no line and no polygon.
inline void add_vtk_cell(Labelled_mesh& mesh, const Vtk_data& data, std::size_t c, const std::string& path)
{
  const std::size_t n = data.number_of_corners(c);
  const int *corners = data.corners_of(c), type = data.types[c];
  switch (type) {
  case 1: // vertices
  case 2:
    return;
  case 3: // lines
  case 4:
    for (std::size_t i = 1; i < n; ++i)
      mesh.lines.push_back({corners[i - 1], corners[i]});
    return;
  case 5: // triangle, polygon, quadrangle
  case 7:
  case 9:
    if (n < 3 || (type == 5 && n != 3) || (type == 9 && n != 4))
      throw Invalid_input_error(path + ": cell " + std::to_string(c) + " has " + std::to_string(n) + " corners");
    mesh.polygons.emplace_back(corners, corners + n);
    return;
  default:
    throw Invalid_input_error(path + ": cell " + std::to_string(c) + " has VTK type " + std::to_string(type) +
                              "; only straight lines, triangles, quadrangles and polygons are read");
  }
}

/// Polygons and lines. \throws Invalid_input_error
inline Labelled_mesh vtk_polygons(Vtk_data data, const std::string& path)
{
  Labelled_mesh mesh;
  mesh.points = std::move(data.points);
  for (std::size_t c = 0; c < data.types.size(); ++c)
    add_vtk_cell(mesh, data, c, path);
  mesh.line_curve.assign(mesh.lines.size(), -1);
  mesh.polygon_region.assign(mesh.polygons.size(), -1);
  return mesh;
}

} // namespace internal
} // namespace Quadrille

#endif
