// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_READ_MSH_H
#define QUADRILLE_MESH_IO_INTERNAL_READ_MSH_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Mesh_io/internal/Gmsh_session.h>
#include <Quadrille/Mesh_io/internal/files.h>

#include <map>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

/// Gmsh MSH files of all versions: first-order lines, triangles and quadrangles with entities and physical groups.
class Msh_reader {
public:
  explicit Msh_reader(const std::string& path) : m_path(path) {}

  Labelled_mesh read()
  {
    // Gmsh takes a file without the header for a script, and fills up what a truncated one lacks.
    const std::string text = read_whole_file(m_path);
    if (text.rfind("$MeshFormat", 0) != 0 && text.rfind("$Comments", 0) != 0)
      fail("this is not a Gmsh mesh (it does not begin with $MeshFormat)");
    for (const char* end : {"$EndNodes", "$EndElements"})
      if (text.find(end) == std::string::npos)
        fail(std::string("the file is truncated: there is no ") + end);
    const Gmsh_session session;
    Gmsh_session::call(m_path, [&] {
      gmsh::open(m_path);
      const std::string error = session.first_error();
      if (!error.empty())
        fail("the mesh cannot be read: " + error);
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
