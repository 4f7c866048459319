// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_READ_MSH_VOLUME_H
#define QUADRILLE_MESH_IO_INTERNAL_READ_MSH_VOLUME_H

#include <Quadrille/Mesh_io/internal/Gmsh_session.h>
#include <Quadrille/Mesh_io/internal/Volume_content.h>
#include <Quadrille/Mesh_io/internal/read_msh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// The tetrahedra and lines of the current model of Gmsh, of any order: their corners. Only nodes of tetrahedra are
/// kept, in the order of their tags.
class Gmsh_volume {
public:
  explicit Gmsh_volume(const std::string& subject) : m_subject(subject) {}

  /// Whether the model has elements of dimension 3.
  static bool exists()
  {
    std::vector<int> types;
    gmsh::model::mesh::getElementTypes(types, 3);
    return !types.empty();
  }

  /// \param volumes, curves the tags of those whose tetrahedra are wanted and whose lines are features; -1 means all
  Tetrahedral_mesh get(const std::vector<int>& volumes, const std::vector<int>& curves)
  {
    const std::vector<std::size_t> corners = find_vertices(volumes);
    add_points();
    m_mesh.tetrahedra.resize(corners.size() / 4);
    for (std::size_t i = 0; i < corners.size(); ++i)
      m_mesh.tetrahedra[i / 4][i % 4] = index(corners[i]);
    for (const int curve : curves)
      add_lines(curve);
    orient_tetrahedra(m_mesh);
    select_feature_edges(m_mesh);
    return std::move(m_mesh);
  }

  /// The tags of all nodes of tetrahedra, ascending.
  std::vector<std::size_t> node_tags()
  {
    find_vertices({-1});
    return m_tags;
  }

private:
  [[noreturn]] void fail(const std::string& reason) const { throw Invalid_input_error(m_subject + ": " + reason); }

  /// Sets the tags of the vertices, and returns the tags of the tetrahedra's corners.
  std::vector<std::size_t> find_vertices(const std::vector<int>& volumes)
  {
    std::vector<std::size_t> corners;
    for (const int volume : volumes)
      add_tetrahedra(volume, corners);
    m_tags = corners;
    std::sort(m_tags.begin(), m_tags.end());
    m_tags.erase(std::unique(m_tags.begin(), m_tags.end()), m_tags.end());
    return corners;
  }

  struct Element_type {
    std::string name;
    std::size_t n_nodes = 0, n_corners = 0;
  };

  static Element_type properties(int type)
  {
    Element_type result;
    int dimension = 0, order = 0, n_nodes = 0, n_corners = 0;
    std::vector<double> coordinates;
    gmsh::model::mesh::getElementProperties(type, result.name, dimension, order, n_nodes, coordinates, n_corners);
    result.n_nodes = std::size_t(n_nodes);
    result.n_corners = std::size_t(n_corners);
    return result;
  }

  void add_tetrahedra(int volume, std::vector<std::size_t>& corners) const
  {
    std::vector<int> types;
    gmsh::model::mesh::getElementTypes(types, 3, volume);
    for (const int type : types) {
      const Element_type element = properties(type);
      std::vector<std::size_t> tags, nodes;
      gmsh::model::mesh::getElementsByType(type, tags, nodes, volume);
      if (element.n_corners != 4)
        fail("element " + std::to_string(tags.empty() ? 0 : tags[0]) + " is of type '" + element.name +
             "'; of cells of dimension 3 only tetrahedra are read");
      if (element.n_nodes == 4 && corners.empty()) {
        corners = std::move(nodes);
        continue;
      }
      for (std::size_t i = 0; i < nodes.size(); i += element.n_nodes)
        corners.insert(corners.end(), nodes.begin() + std::ptrdiff_t(i), nodes.begin() + std::ptrdiff_t(i) + 4);
    }
  }

  void add_points()
  {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
    m_mesh.points.resize(m_tags.size());
    std::vector<char> is_known(m_tags.size(), 0);
    for (std::size_t i = 0; i < tags.size(); ++i) {
      const int v = index(tags[i]);
      if (v < 0)
        continue;
      is_known[std::size_t(v)] = 1;
      for (std::size_t k = 0; k < 3; ++k) {
        m_mesh.points[std::size_t(v)][k] = coordinates[3 * i + k];
        if (!std::isfinite(coordinates[3 * i + k]))
          fail("node " + std::to_string(tags[i]) + " has a coordinate that is not a finite number");
      }
    }
    const auto missing = std::find(is_known.begin(), is_known.end(), 0);
    if (missing != is_known.end())
      fail("node " + std::to_string(m_tags[std::size_t(missing - is_known.begin())]) +
           " does not exist, and a tetrahedron uses it");
  }

  void add_lines(int curve)
  {
    std::vector<int> types;
    gmsh::model::mesh::getElementTypes(types, 1, curve);
    for (const int type : types) {
      const std::size_t n_nodes = properties(type).n_nodes;
      std::vector<std::size_t> tags, nodes;
      gmsh::model::mesh::getElementsByType(type, tags, nodes, curve);
      for (std::size_t i = 0; i + 1 < nodes.size(); i += n_nodes) {
        const int a = index(nodes[i]), b = index(nodes[i + 1]);
        if (a >= 0 && b >= 0)
          m_mesh.feature_edges.push_back({a, b});
      }
    }
  }

  /// Of the vertex with this tag; -1 if no tetrahedron has it.
  int index(std::size_t tag) const
  {
    // Tags are nearly always 1, 2, 3, ...
    const std::size_t guess = tag - m_tags.front();
    if (guess < m_tags.size() && m_tags[guess] == tag)
      return int(guess);
    const auto found = std::lower_bound(m_tags.begin(), m_tags.end(), tag);
    return found != m_tags.end() && *found == tag ? int(found - m_tags.begin()) : -1;
  }

  const std::string& m_subject;
  std::vector<std::size_t> m_tags; ///< of the vertices, ascending
  Tetrahedral_mesh m_mesh;
};

/// A MSH file. Runs in the child process. \throws Invalid_input_error
inline Volume_content read_msh_volume(const std::string& path)
{
  Volume_content content;
  {
    const Gmsh_session session;
    Gmsh_session::call(path, [&] {
      open_msh(path, session);
      if (Gmsh_volume::exists())
        content.volume = Gmsh_volume(path).get({-1}, {-1});
    });
  }
  if (content.volume.tetrahedra.empty())
    content.surface = Msh_reader(path).read();
  return content;
}

} // namespace internal
} // namespace Quadrille

#endif
