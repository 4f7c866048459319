// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_READ_MSH_H
#define QUADRILLE_MESH_IO_INTERNAL_READ_MSH_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Mesh_io/internal/Gmsh_session.h>
#include <Quadrille/Mesh_io/internal/Text_scanner.h>
#include <Quadrille/Mesh_io/internal/files.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace Quadrille {
namespace internal {

/// Checks what Gmsh does not: it takes a file without the header for a script, fills up what a truncated one lacks, and
/// allocates whatever numbers of nodes and elements the file claims to have.
inline void check_msh_text(const std::string& path)
{
  const std::string text = read_whole_file(path);
  const auto fail = [&](const std::string& reason) { throw Invalid_input_error(path + ": " + reason); };
  if (text.rfind("$MeshFormat", 0) != 0 && text.rfind("$Comments", 0) != 0)
    fail("this is not a Gmsh mesh (it does not begin with $MeshFormat)");
  for (const char* end : {"$EndNodes", "$EndElements"})
    if (text.find(end) == std::string::npos)
      fail(std::string("the file is truncated: there is no ") + end);
  Text_scanner format(std::string_view(text).substr(std::min(text.find("$MeshFormat"), text.size())), path);
  format.word();
  const double version = format.number<double>("the version of the format");
  const bool binary = format.number<int>("the type of the file") != 0;
  for (const std::string section : {"$Nodes", "$Elements"}) {
    const std::size_t begin = text.find(section);
    if (begin == std::string::npos)
      fail("there is no section " + section);
    Text_scanner scanner(std::string_view(text).substr(begin + section.size()), path);
    const auto check = [&](unsigned long long n) {
      if (n > text.size())
        fail(section + " begins with the number " + std::to_string(n) +
             ", more than the file has room for: it is truncated or damaged");
    };
    if (binary && version >= 4) {
      scanner.rest_of_line();
      for (int i = 0; i < 2; ++i) { // blocks, and then nodes or elements
        std::uint64_t n = 0;
        std::memcpy(&n, scanner.bytes(sizeof n, "section " + section), sizeof n);
        check(n);
      }
    } else {
      for (int i = 0; i < (version >= 4 ? 2 : 1); ++i)
        check(scanner.number<std::uint64_t>("a count"));
    }
  }
}

/// Makes the mesh of a file Gmsh's current model. \throws Invalid_input_error
inline void open_msh(const std::string& path, const Gmsh_session& session)
{
  check_msh_text(path);
  gmsh::open(path);
  const std::string error = session.first_error();
  if (!error.empty())
    throw Invalid_input_error(path + ": the mesh cannot be read: " + error);
}

/// Gmsh MSH files of all versions: first-order lines, triangles and quadrangles with entities and physical groups.
class Msh_reader {
public:
  explicit Msh_reader(const std::string& path) : m_path(path) {}

  Labelled_mesh read()
  {
    const Gmsh_session session;
    Gmsh_session::call(m_path, [&] {
      open_msh(m_path, session);
      add_points();
      const Gmsh_groups groups;
      m_mesh.groups = groups.groups;
      add_elements(1, groups);
      add_elements(2, groups);
    });
    return std::move(m_mesh);
  }

private:
  [[noreturn]] void fail(const std::string& reason) const { throw Invalid_input_error(m_path + ": " + reason); }

  void add_points()
  {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters);
    std::map<std::size_t, std::array<double, 3>> sorted;
    for (std::size_t i = 0; i < tags.size(); ++i)
      sorted[tags[i]] = {coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]};
    for (const auto& [tag, point] : sorted) {
      m_index[tag] = int(m_mesh.points.size());
      m_mesh.points.push_back(point);
    }
  }

  void add_elements(int dimension, const Gmsh_groups& groups)
  {
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, dimension);
    for (const auto& [d, tag] : entities) {
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> elements, nodes;
      gmsh::model::mesh::getElements(types, elements, nodes, dimension, tag);
      if (types.empty())
        continue;
      const auto names = groups.names.find({dimension, tag});
      std::vector<Entity_label>& labels = dimension == 1 ? m_mesh.curves : m_mesh.regions;
      labels.push_back({tag, names == groups.names.end() ? std::vector<std::string>() : names->second});
      for (std::size_t k = 0; k < types.size(); ++k)
        add_block(types[k], elements[k], nodes[k], int(labels.size()) - 1);
    }
  }

  void add_block(int type, const std::vector<std::size_t>& elements, const std::vector<std::size_t>& nodes, int label)
  {
    const std::size_t n_corners = type == 1 ? 2 : type == 2 ? 3 : type == 3 ? 4 : 0;
    if (n_corners == 0)
      fail("element " + std::to_string(elements[0]) + " has Gmsh type " + std::to_string(type) +
           "; only first-order lines, triangles and quadrangles are read");
    for (std::size_t e = 0; e < elements.size(); ++e) {
      std::vector<int> corners;
      for (std::size_t i = 0; i < n_corners; ++i) {
        const auto found = m_index.find(nodes[n_corners * e + i]);
        if (found == m_index.end())
          fail("element " + std::to_string(elements[e]) + " uses a node that does not exist");
        corners.push_back(found->second);
      }
      if (type == 1) {
        m_mesh.lines.push_back({corners[0], corners[1]});
        m_mesh.line_curve.push_back(label);
      } else {
        m_mesh.polygons.push_back(std::move(corners));
        m_mesh.polygon_region.push_back(label);
      }
    }
  }

  const std::string& m_path;
  Labelled_mesh m_mesh;
  std::map<std::size_t, int> m_index; ///< of points by node tag
};

} // namespace internal
} // namespace Quadrille

#endif
