// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_WRITE_VTU_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_WRITE_VTU_IMPL_H

#include <Quadrille/Mesh_io/internal/files.h>
#include <Quadrille/exceptions.h>
#include <Quadrille/write_file.h>
#include <Quadrille/write_vtu.h>

#include <cstdint>
#include <limits>
#include <ostream>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// The cells of a VTU file: pieces of memory with the corners, and per cell where they end and of what type it is.
struct Vtu_cells {
  std::vector<std::pair<const int*, std::size_t>> corners;
  std::vector<std::int64_t> ends;
  std::vector<std::uint8_t> types; ///< as VTK numbers them

  template <std::size_t n> void add(const std::vector<std::array<int, n>>& cells, std::uint8_t type)
  {
    std::int64_t end = ends.empty() ? 0 : ends.back();
    corners.emplace_back(cells.empty() ? nullptr : cells.front().data(), n * cells.size());
    ends.reserve(ends.size() + cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c)
      ends.push_back(end += std::int64_t(n));
    types.resize(types.size() + cells.size(), type);
  }
};

inline std::string escape_xml(const std::string& text)
{
  std::string result;
  for (const char c : text)
    switch (c) {
    case '&':
      result += "&amp;";
      break;
    case '<':
      result += "&lt;";
      break;
    case '>':
      result += "&gt;";
      break;
    case '"':
      result += "&quot;";
      break;
    default:
      result += c;
    }
  return result;
}

template <class Number> std::string vtk_type_of()
{
  const std::string kind = std::is_floating_point_v<Number> ? "Float" : std::is_signed_v<Number> ? "Int" : "UInt";
  return kind + std::to_string(8 * sizeof(Number));
}

inline bool is_little_endian()
{
  const std::uint16_t one = 1;
  return *reinterpret_cast<const std::uint8_t*>(&one) == 1;
}

/// A VTU file with its numbers after the XML, as they are in memory.
class Vtu_writer {
public:
  Vtu_writer(const std::vector<std::array<double, 3>>& points, const Vtu_cells& cells, const Vtu_data& data,
             const std::string& path)
      : m_path(path)
  {
    m_xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"" +
            std::string(is_little_endian() ? "LittleEndian" : "BigEndian") +
            "\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" + std::to_string(points.size()) +
            "\" NumberOfCells=\"" + std::to_string(cells.types.size()) + "\">\n<PointData>\n";
    add_arrays(data.at_points, points.size(), "points");
    m_xml += "</PointData>\n<CellData>\n";
    add_arrays(data.at_cells, cells.types.size(), "cells");
    m_xml += "</CellData>\n<Points>\n";
    add("Points", 3, "Float64", {{points.data(), points.size() * sizeof(points[0])}});
    m_xml += "</Points>\n<Cells>\n";
    std::vector<Piece> corners;
    for (const auto& [begin, n] : cells.corners)
      corners.push_back({begin, n * sizeof(int)});
    add("connectivity", 1, "Int32", corners);
    add("offsets", 1, "Int64", {{cells.ends.data(), cells.ends.size() * sizeof(cells.ends[0])}});
    add("types", 1, "UInt8", {{cells.types.data(), cells.types.size()}});
    m_xml += "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  }

  void write(std::ostream& file) const
  {
    file.write(m_xml.data(), std::streamsize(m_xml.size()));
    for (const std::vector<Piece>& block : m_blocks) {
      const std::uint64_t size = size_of(block);
      file.write(reinterpret_cast<const char*>(&size), sizeof size);
      for (const Piece& piece : block)
        file.write(static_cast<const char*>(piece.first), std::streamsize(piece.second));
    }
    file << "\n</AppendedData>\n</VTKFile>\n";
  }

private:
  using Piece = std::pair<const void*, std::size_t>; ///< memory and its number of bytes

  static std::uint64_t size_of(const std::vector<Piece>& block)
  {
    std::uint64_t size = 0;
    for (const Piece& piece : block)
      size += piece.second;
    return size;
  }

  void add_arrays(const std::vector<Vtu_array>& arrays, std::size_t n, const std::string& what)
  {
    std::set<std::string> names;
    for (const Vtu_array& array : arrays) {
      if (!names.insert(array.name).second)
        throw Invalid_argument_error(m_path + ": there are two arrays '" + array.name + "' at the " + what);
      std::visit(
          [&](const auto& values) {
            if (array.components < 1 || values.size() != n * std::size_t(array.components))
              throw Invalid_argument_error(
                  m_path + ": the array '" + array.name + "' has " + std::to_string(values.size()) + " values, not " +
                  std::to_string(array.components) + " for each of " + std::to_string(n) + " " + what);
            using Number = typename std::decay_t<decltype(values)>::value_type;
            add(array.name, array.components, vtk_type_of<Number>(), {{values.data(), values.size() * sizeof(Number)}});
          },
          array.values);
    }
  }

  void add(const std::string& name, int components, const std::string& type, std::vector<Piece> block)
  {
    m_xml += "<DataArray type=\"" + type + "\" Name=\"" + escape_xml(name) + "\"";
    if (components != 1) // some programs make columns of arrays for which they read 1 here
      m_xml += " NumberOfComponents=\"" + std::to_string(components) + "\"";
    m_xml += " format=\"appended\" offset=\"" + std::to_string(m_offset) + "\"/>\n";
    m_offset += sizeof(std::uint64_t) + size_of(block);
    m_blocks.push_back(std::move(block));
  }

  const std::string& m_path;
  std::string m_xml;
  std::vector<std::vector<Piece>> m_blocks;
  std::uint64_t m_offset = 0;
};

inline void write_vtu_file(const std::string& path, const std::vector<std::array<double, 3>>& points,
                           const Vtu_cells& cells, const Vtu_data& data)
{
  check_extension(path, ".vtu");
  const Vtu_writer writer(points, cells, data, path);
  write_file_by(path, [&](std::ostream& file) { writer.write(file); });
}

constexpr std::uint8_t vtk_vertex = 1, vtk_line = 3, vtk_polyline = 4, vtk_triangle = 5, vtk_tetrahedron = 10;

} // namespace internal

inline void write_vtu(const std::string& path, const Tetrahedral_mesh& mesh, const Vtu_data& data)
{
  internal::Vtu_cells cells;
  cells.add(mesh.tetrahedra, internal::vtk_tetrahedron);
  internal::write_vtu_file(path, mesh.points, cells, data);
}

inline void write_vtu(const std::string& path, const std::vector<std::array<double, 3>>& points,
                      const std::vector<std::vector<int>>& polylines, const Vtu_data& data)
{
  internal::Vtu_cells cells;
  std::int64_t end = 0;
  for (const std::vector<int>& polyline : polylines) {
    cells.corners.emplace_back(polyline.data(), polyline.size());
    cells.ends.push_back(end += std::int64_t(polyline.size()));
    cells.types.push_back(polyline.size() == 1   ? internal::vtk_vertex
                          : polyline.size() == 2 ? internal::vtk_line
                                                 : internal::vtk_polyline);
  }
  internal::write_vtu_file(path, points, cells, data);
}

} // namespace Quadrille

#endif
