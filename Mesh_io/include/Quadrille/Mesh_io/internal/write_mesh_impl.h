// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_WRITE_MESH_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_WRITE_MESH_IMPL_H

#include <Quadrille/Mesh_io/internal/Msh_entities.h>
#include <Quadrille/Mesh_io/internal/files.h>
#include <Quadrille/Mesh_io/internal/format_numbers.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/write_file.h>
#include <Quadrille/write_mesh.h>

#include <map>
#include <string>

namespace Quadrille {
namespace internal {

inline int msh_polygon_type(const std::vector<int>& polygon, const std::string& path)
{
  if (polygon.size() != 3 && polygon.size() != 4)
    throw Invalid_argument_error(path + ": MSH files hold triangles and quadrangles, not polygons with " +
                                 std::to_string(polygon.size()) + " corners");
  return polygon.size() == 3 ? 2 : 3;
}

inline void append_physical_names(std::string& text, const Msh_entities& model)
{
  std::map<std::pair<int, int>, std::string> named; // by dimension and tag; Gmsh needs no names that are the tags
  for (const auto& [key, tag] : model.tags)
    if (key.second != std::to_string(tag))
      named[{key.first, tag}] = key.second;
  if (named.empty())
    return;
  append_line(text, "$PhysicalNames");
  append_line(text, named.size());
  for (const auto& [key, name] : named)
    append_line(text, key.first, key.second, '"' + name + '"');
  append_line(text, "$EndPhysicalNames");
}

inline void append_msh_entities(std::string& text, const Labelled_mesh& mesh, const Msh_entities& model)
{
  append_line(text, "$Entities");
  append_line(text, model.corner_points.size(), model.entities[1].size(), model.entities[2].size(), 0);
  for (const auto& [tag, p] : model.corner_points) {
    const std::array<double, 3>& x = mesh.points[std::size_t(p)];
    append_line(text, tag, x[0], x[1], x[2], 0);
  }
  for (const std::size_t dimension : {std::size_t(1), std::size_t(2)})
    for (const auto& [tag, entity] : model.entities[dimension]) {
      append_line(text, tag, entity.low[0], entity.low[1], entity.low[2], entity.high[0], entity.high[1],
                  entity.high[2], entity.physical_tags.size());
      text.back() = ' ';
      for (const int physical : entity.physical_tags)
        text += std::to_string(physical) + " ";
      append_line(text, entity.boundary.size());
      for (const int boundary : entity.boundary) {
        text.back() = ' ';
        append_line(text, boundary);
      }
    }
  append_line(text, "$EndEntities");
}

inline void append_msh_nodes(std::string& text, const Labelled_mesh& mesh, const Msh_entities& model)
{
  std::string blocks;
  std::size_t n_blocks = 0;
  const auto append_block = [&](int dimension, int tag, const std::vector<int>& points) {
    if (points.empty())
      return;
    ++n_blocks;
    append_line(blocks, dimension, tag, 0, points.size());
    for (const int p : points)
      append_line(blocks, p + 1);
    for (const int p : points)
      append_line(blocks, mesh.points[std::size_t(p)][0], mesh.points[std::size_t(p)][1],
                  mesh.points[std::size_t(p)][2]);
  };
  for (const auto& [tag, p] : model.corner_points)
    append_block(0, tag, {p});
  for (const std::size_t dimension : {std::size_t(1), std::size_t(2)})
    for (const auto& [tag, entity] : model.entities[dimension])
      append_block(int(dimension), tag, entity.points);
  append_line(text, "$Nodes");
  append_line(text, n_blocks, mesh.points.size(), mesh.points.empty() ? 0 : 1, mesh.points.size());
  text += blocks;
  append_line(text, "$EndNodes");
}

inline void append_msh_corners(std::string& text, const std::vector<int>& corners)
{
  for (const int p : corners) {
    append_number(text, p + 1);
    text += ' ';
  }
  text.back() = '\n';
}

inline std::string msh_4_1_text(const Labelled_mesh& mesh, const std::string& path)
{
  const Msh_entities model(mesh);
  std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  append_physical_names(text, model);
  append_msh_entities(text, mesh, model);
  append_msh_nodes(text, mesh, model);

  std::string blocks;
  std::size_t n_blocks = 0, n_elements = 0;
  const auto append_element = [&](const std::vector<int>& corners) {
    append_number(blocks, ++n_elements);
    blocks += ' ';
    append_msh_corners(blocks, corners);
  };
  for (const auto& [tag, entity] : model.entities[1]) {
    if (entity.elements.empty())
      continue;
    ++n_blocks;
    append_line(blocks, 1, tag, 1, entity.elements.size());
    for (const int l : entity.elements)
      append_element({mesh.lines[std::size_t(l)].begin(), mesh.lines[std::size_t(l)].end()});
  }
  for (const auto& [tag, entity] : model.entities[2]) {
    std::map<int, std::vector<int>> by_type;
    for (const int f : entity.elements)
      by_type[msh_polygon_type(mesh.polygons[std::size_t(f)], path)].push_back(f);
    for (const auto& [type, polygons] : by_type) {
      ++n_blocks;
      append_line(blocks, 2, tag, type, polygons.size());
      for (const int f : polygons)
        append_element(mesh.polygons[std::size_t(f)]);
    }
  }
  append_line(text, "$Elements");
  append_line(text, n_blocks, n_elements, n_elements == 0 ? 0 : 1, n_elements);
  text += blocks;
  append_line(text, "$EndElements");
  return text;
}

inline std::string msh_2_2_text(const Labelled_mesh& mesh, const std::string& path)
{
  const Msh_entities model(mesh);
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  append_physical_names(text, model);
  append_line(text, "$Nodes");
  append_line(text, mesh.points.size());
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    append_line(text, p + 1, mesh.points[p][0], mesh.points[p][1], mesh.points[p][2]);
  append_line(text, "$EndNodes");
  append_line(text, "$Elements");
  append_line(text, mesh.lines.size() + mesh.polygons.size());
  std::size_t n = 0;
  const auto append_element = [&](int type, int tag, const Msh_entities::Entity& entity,
                                  const std::vector<int>& corners) {
    append_line(text, ++n, type, 2, entity.physical_tags.empty() ? 0 : entity.physical_tags[0], tag);
    text.back() = ' ';
    append_msh_corners(text, corners);
  };
  for (const auto& [tag, entity] : model.entities[1])
    for (const int l : entity.elements)
      append_element(1, tag, entity, {mesh.lines[std::size_t(l)].begin(), mesh.lines[std::size_t(l)].end()});
  for (const auto& [tag, entity] : model.entities[2])
    for (const int f : entity.elements)
      append_element(msh_polygon_type(mesh.polygons[std::size_t(f)], path), tag, entity, mesh.polygons[std::size_t(f)]);
  append_line(text, "$EndElements");
  return text;
}

inline std::string obj_text(const Labelled_mesh& mesh)
{
  std::string text;
  for (const std::array<double, 3>& p : mesh.points)
    append_line(text, "v", p[0], p[1], p[2]);
  for (const std::array<int, 2>& line : mesh.lines)
    append_line(text, "l", line[0] + 1, line[1] + 1);
  int region = -1;
  for (std::size_t f = 0; f < mesh.polygons.size(); ++f) {
    if (mesh.polygon_region[f] != region && mesh.polygon_region[f] >= 0) {
      region = mesh.polygon_region[f];
      const Entity_label& label = mesh.regions[std::size_t(region)];
      append_line(text, "g", label.names.empty() ? std::to_string(label.tag) : label.names[0]);
    }
    text += "f ";
    append_msh_corners(text, mesh.polygons[f]);
  }
  return text;
}

inline int vtk_cell_type(const std::vector<int>& polygon)
{
  return polygon.size() == 3 ? 5 : polygon.size() == 4 ? 9 : 7;
}

/// The tag of the curve or surface of each cell, lines first.
inline std::vector<int> cell_tags(const Labelled_mesh& mesh)
{
  std::vector<int> tags;
  for (const int c : mesh.line_curve)
    tags.push_back(c < 0 ? 0 : mesh.curves[std::size_t(c)].tag);
  for (const int r : mesh.polygon_region)
    tags.push_back(r < 0 ? 0 : mesh.regions[std::size_t(r)].tag);
  return tags;
}

inline std::string vtk_text(const Labelled_mesh& mesh)
{
  std::string text = "# vtk DataFile Version 3.0\nQuadrille\nASCII\nDATASET UNSTRUCTURED_GRID\n";
  append_line(text, "POINTS", mesh.points.size(), "double");
  for (const std::array<double, 3>& p : mesh.points)
    append_line(text, p[0], p[1], p[2]);
  const std::size_t n_cells = mesh.lines.size() + mesh.polygons.size();
  std::size_t n_integers = 3 * mesh.lines.size();
  for (const std::vector<int>& polygon : mesh.polygons)
    n_integers += polygon.size() + 1;
  append_line(text, "CELLS", n_cells, n_integers);
  for (const std::array<int, 2>& line : mesh.lines)
    append_line(text, 2, line[0], line[1]);
  for (const std::vector<int>& polygon : mesh.polygons) {
    append_number(text, polygon.size());
    for (const int p : polygon) {
      text += ' ';
      append_number(text, p);
    }
    text += '\n';
  }
  append_line(text, "CELL_TYPES", n_cells);
  for (std::size_t l = 0; l < mesh.lines.size(); ++l)
    append_line(text, 3);
  for (const std::vector<int>& polygon : mesh.polygons)
    append_line(text, vtk_cell_type(polygon));
  append_line(text, "CELL_DATA", n_cells);
  append_line(text, "SCALARS entity int 1\nLOOKUP_TABLE default");
  for (const int tag : cell_tags(mesh))
    append_line(text, tag);
  return text;
}

/// The frame of a VTU file, to which arrays are added.
class Vtu_text {
public:
  Vtu_text(const std::vector<std::array<double, 3>>& points, const std::vector<std::vector<int>>& cells)
  {
    append_line(text, "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
                      "byte_order=\"LittleEndian\">\n<UnstructuredGrid>");
    append_line(text, "<Piece NumberOfPoints=\"" + std::to_string(points.size()) + "\" NumberOfCells=\"" +
                          std::to_string(cells.size()) + "\">");
    text += "<Points>\n";
    begin_array("Points", "Float64", 3);
    for (const std::array<double, 3>& p : points)
      append_line(text, p[0], p[1], p[2]);
    text += "</DataArray>\n</Points>\n<Cells>\n";
    begin_array("connectivity", "Int64", 1);
    for (const std::vector<int>& cell : cells)
      for (const int p : cell)
        append_line(text, p);
    end_array();
    begin_array("offsets", "Int64", 1);
    std::size_t offset = 0;
    for (const std::vector<int>& cell : cells)
      append_line(text, offset += cell.size());
    end_array();
    begin_array("types", "UInt8", 1);
    for (const std::vector<int>& cell : cells)
      append_line(text, cell.size() == 2 ? 3 : vtk_cell_type(cell));
    text += "</DataArray>\n</Cells>\n";
  }

  void begin_array(const std::string& name, const std::string& type, int n_components)
  {
    append_line(text, "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                          std::to_string(n_components) + "\" format=\"ascii\">");
  }
  void end_array() { text += "</DataArray>\n"; }
  std::string finish() { return std::move(text += "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n"); }

  std::string text;
};

inline std::string vtu_text(const Labelled_mesh& mesh)
{
  std::vector<std::vector<int>> cells;
  for (const std::array<int, 2>& line : mesh.lines)
    cells.emplace_back(line.begin(), line.end());
  cells.insert(cells.end(), mesh.polygons.begin(), mesh.polygons.end());
  Vtu_text file(mesh.points, cells);
  file.text += "<CellData>\n";
  file.begin_array("entity", "Int32", 1);
  for (const int tag : cell_tags(mesh))
    append_line(file.text, tag);
  file.end_array();
  file.text += "</CellData>\n";
  return file.finish();
}

} // namespace internal

QUADRILLE_INLINE Mesh_file_format mesh_file_format(const std::string& path)
{
  static const std::map<std::string, Mesh_file_format> formats = {{".msh", Mesh_file_format::msh_4_1},
                                                                  {".vtk", Mesh_file_format::vtk},
                                                                  {".vtu", Mesh_file_format::vtu},
                                                                  {".obj", Mesh_file_format::obj}};
  const std::string extension = internal::extension_of(path);
  const auto format = formats.find(extension);
  if (format == formats.end())
    throw Invalid_argument_error(path + ": unknown output format '" + extension + "'; known are .msh .vtk .vtu .obj");
  return format->second;
}

QUADRILLE_INLINE void write_mesh(const std::string& path, const Labelled_mesh& mesh, Mesh_file_format format)
{
  switch (format == Mesh_file_format::by_extension ? mesh_file_format(path) : format) {
  case Mesh_file_format::msh_2_2:
    return write_file(path, internal::msh_2_2_text(mesh, path));
  case Mesh_file_format::vtk:
    return write_file(path, internal::vtk_text(mesh));
  case Mesh_file_format::vtu:
    return write_file(path, internal::vtu_text(mesh));
  case Mesh_file_format::obj:
    return write_file(path, internal::obj_text(mesh));
  default:
    return write_file(path, internal::msh_4_1_text(mesh, path));
  }
}

} // namespace Quadrille

#endif
