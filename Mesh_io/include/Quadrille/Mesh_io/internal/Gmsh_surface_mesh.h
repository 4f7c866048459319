// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_GMSH_SURFACE_MESH_H
#define QUADRILLE_MESH_IO_INTERNAL_GMSH_SURFACE_MESH_H

#include <Quadrille/Mesh_io/internal/Byte_archive.h>
#include <Quadrille/Mesh_io/internal/Gmsh_session.h>
#include <Quadrille/Mesh_io/internal/Triangle_adjacency.h>
#include <Quadrille/Mesh_io/internal/find_surfaces.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Gmsh did not make a mesh, which another algorithm may.
class Gmsh_failure : public Invalid_input_error {
public:
  using Invalid_input_error::Invalid_input_error;
};

/// The triangles of some surfaces of Gmsh's current model, with its curves as features.
class Gmsh_surface_mesh {
public:
  using Point_3 = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

  explicit Gmsh_surface_mesh(const std::vector<int>& surfaces) : m_surfaces(surfaces)
  {
    for (const int surface : surfaces) {
      std::vector<std::size_t> elements, nodes;
      gmsh::model::mesh::getElementsByType(triangle_type, elements, nodes, surface);
      m_nodes.insert(m_nodes.end(), nodes.begin(), nodes.end());
      m_end_of_surface.push_back(m_nodes.size() / 3);
    }
    read_points();
  }

  std::size_t number_of_triangles() const { return m_triangles.size(); }

  double area() const
  {
    double sum = 0;
    for (const std::array<int, 3>& t : m_triangles)
      sum += area(t);
    return sum;
  }

  /// \param size_of_point sizes that the file prescribes at model points, by their tags
  Geometry_triangulation get(const std::map<int, double>& size_of_point)
  {
    Geometry_triangulation result;
    Labelled_mesh& mesh = result.mesh;
    const Gmsh_groups groups;
    mesh.groups = groups.groups;
    const auto label = [&](int dimension, int tag) {
      const auto names = groups.names.find({dimension, tag});
      return Entity_label{tag, names == groups.names.end() ? std::vector<std::string>() : names->second};
    };
    orient();
    for (const Point_3& p : m_points)
      mesh.points.push_back({p.x(), p.y(), p.z()});
    for (const std::array<int, 3>& t : m_triangles)
      mesh.polygons.emplace_back(t.begin(), t.end());
    for (std::size_t s = 0; s < m_surfaces.size(); ++s) {
      mesh.regions.push_back(label(2, m_surfaces[s]));
      mesh.polygon_region.resize(m_end_of_surface[s], int(s));
    }
    for (const int curve : curves_of(m_surfaces)) {
      const std::vector<std::array<int, 2>> lines = lines_of(curve);
      if (lines.empty() || !is_feature(curve, lines))
        continue;
      mesh.line_curve.resize(mesh.lines.size() + lines.size(), int(mesh.curves.size()));
      mesh.lines.insert(mesh.lines.end(), lines.begin(), lines.end());
      mesh.curves.push_back(label(1, curve));
    }
    result.point_size.assign(m_points.size(), 0);
    for (const auto& [tag, size] : size_of_point)
      if (const int v = vertex_at(tag); v >= 0)
        result.point_size[std::size_t(v)] = size;
    return result;
  }

private:
  static constexpr int line_type = 1, triangle_type = 2; ///< as Gmsh numbers them

  void read_points()
  {
    m_tags = m_nodes;
    std::sort(m_tags.begin(), m_tags.end());
    m_tags.erase(std::unique(m_tags.begin(), m_tags.end()), m_tags.end());
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
    m_points.resize(m_tags.size());
    for (std::size_t i = 0; i < tags.size(); ++i)
      if (const int v = index(tags[i]); v >= 0)
        m_points[std::size_t(v)] = Point_3(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
    for (std::size_t i = 0; i + 2 < m_nodes.size(); i += 3)
      m_triangles.push_back({index(m_nodes[i]), index(m_nodes[i + 1]), index(m_nodes[i + 2])});
  }

  /// Of the node with this tag; -1 if no triangle has it.
  int index(std::size_t tag) const
  {
    const auto found = std::lower_bound(m_tags.begin(), m_tags.end(), tag);
    return found != m_tags.end() && *found == tag ? int(found - m_tags.begin()) : -1;
  }

  int vertex_at(int point_tag) const
  {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, 0, point_tag, false, false);
    return tags.empty() ? -1 : index(tags[0]);
  }

  double area(const std::array<int, 3>& t) const
  {
    const Point_3& p = m_points[std::size_t(t[0])];
    const auto n = CGAL::cross_product(m_points[std::size_t(t[1])] - p, m_points[std::size_t(t[2])] - p);
    return std::hypot(n.x(), n.y(), n.z()) / 2;
  }

  /// Outwards where a component is closed, and towards a cavity within a volume; others as most of their area is by
  /// Gmsh. Gmsh orients the triangles of each surface as its parametrization happens to be.
  void orient()
  {
    const Triangle_adjacency adjacency(m_triangles);
    if (!adjacency.one_sided_edges().empty() || !adjacency.crowded_edges().empty())
      return; // which is not for us to report
    const std::size_t n = std::size_t(adjacency.number_of_components());
    std::vector<char> is_closed(n, 1);
    for (const Triangle_adjacency::Side& side : adjacency.border())
      is_closed[std::size_t(adjacency.component(side.triangle))] = 0;
    std::vector<double> area_as_given(n, 0), volume = enclosed_volumes(m_points, m_triangles, adjacency);
    for (std::size_t t = 0; t < m_triangles.size(); ++t)
      area_as_given[std::size_t(adjacency.component(t))] += (adjacency.is_turned(t) ? -1 : 1) * area(m_triangles[t]);
    const std::vector<char> is_cavity = find_cavities(adjacency, volume);
    for (std::size_t t = 0; t < m_triangles.size(); ++t) {
      const std::size_t c = std::size_t(adjacency.component(t));
      const bool is_wrong = is_closed[c] ? (volume[c] < 0) != (is_cavity[c] != 0) : area_as_given[c] < 0;
      if (adjacency.is_turned(t) != is_wrong)
        std::swap(m_triangles[t][1], m_triangles[t][2]);
    }
  }

  /// Of the components that bound one volume, the one with the largest volume is around all others.
  std::vector<char> find_cavities(const Triangle_adjacency& adjacency, const std::vector<double>& volume) const
  {
    std::vector<char> is_cavity(volume.size(), 0);
    gmsh::vectorpair volumes;
    gmsh::model::getEntities(volumes, 3);
    for (const auto& [dimension, tag] : volumes) {
      std::set<std::size_t> components;
      const std::vector<int> bounding = boundary_of(3, {tag});
      for (std::size_t s = 0, t = 0; s < m_surfaces.size(); t = m_end_of_surface[s++])
        if (t < m_end_of_surface[s] && std::binary_search(bounding.begin(), bounding.end(), m_surfaces[s]))
          components.insert(std::size_t(adjacency.component(t)));
      if (components.empty())
        continue;
      const std::size_t outer =
          *std::max_element(components.begin(), components.end(),
                            [&](std::size_t a, std::size_t b) { return std::abs(volume[a]) < std::abs(volume[b]); });
      for (const std::size_t c : components)
        is_cavity[c] |= c != outer;
    }
    return is_cavity;
  }

  std::vector<std::array<int, 2>> lines_of(int curve) const
  {
    std::vector<std::array<int, 2>> lines;
    std::vector<std::size_t> elements, nodes;
    gmsh::model::mesh::getElementsByType(line_type, elements, nodes, curve);
    for (std::size_t i = 0; i + 1 < nodes.size(); i += 2) {
      const int a = index(nodes[i]), b = index(nodes[i + 1]);
      if (a >= 0 && b >= 0 && a != b) // degenerate curves, as at the poles of a sphere, have lines without length
        lines.push_back({a, b});
    }
    return lines;
  }

  /// Whether a curve is embedded in a surface, on the border or between different surfaces. Others are the seams of
  /// periodic surfaces.
  bool is_feature(int curve, const std::vector<std::array<int, 2>>& lines)
  {
    if (m_surfaces_at_edge.empty())
      for (std::size_t s = 0, t = 0; s < m_surfaces.size(); ++s) {
        for (const int embedded : curves_embedded_in(m_surfaces[s]))
          m_embedded.insert(embedded);
        for (; t < m_end_of_surface[s]; ++t)
          for (std::size_t i = 0; i < 3; ++i)
            m_surfaces_at_edge[std::minmax(m_triangles[t][i], m_triangles[t][(i + 1) % 3])].push_back(int(s));
      }
    const auto at_edge = m_surfaces_at_edge.find(std::minmax(lines[0][0], lines[0][1]));
    if (m_embedded.count(curve) || at_edge == m_surfaces_at_edge.end())
      return true;
    const std::vector<int>& surfaces = at_edge->second;
    return surfaces.size() != 2 || surfaces[0] != surfaces[1];
  }

  const std::vector<int>& m_surfaces;        ///< tags
  std::vector<std::size_t> m_nodes;          ///< tags of the corners of all triangles
  std::vector<std::size_t> m_end_of_surface; ///< per surface: index after its last triangle
  std::vector<std::size_t> m_tags;           ///< of the vertices' nodes, ascending
  std::vector<Point_3> m_points;
  std::vector<std::array<int, 3>> m_triangles;
  std::map<std::pair<int, int>, std::vector<int>> m_surfaces_at_edge; ///< indices into `m_surfaces`
  std::set<int> m_embedded;                                           ///< tags of curves
};

} // namespace internal
} // namespace Quadrille

#endif
