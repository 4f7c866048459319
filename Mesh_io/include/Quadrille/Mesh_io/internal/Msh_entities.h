// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_MSH_ENTITIES_H
#define QUADRILLE_MESH_IO_INTERNAL_MSH_ENTITIES_H

#include <Quadrille/Labelled_mesh.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// The model that Gmsh expects behind a mesh: points, curves and surfaces, with what lies on each.
struct Msh_entities {
  struct Entity {
    std::vector<int> physical_tags;
    std::vector<int> points;   ///< of the mesh that are classified on it
    std::vector<int> elements; ///< lines or polygons
    std::set<int> boundary;    ///< tags, one dimension lower
    std::array<double, 3> low{}, high{};
    bool has_box = false;
  };
  std::map<int, int> corner_points;                ///< tag -> point of the mesh
  std::array<std::map<int, Entity>, 3> entities;   ///< by dimension (1, 2) and tag
  std::map<std::pair<int, std::string>, int> tags; ///< of physical groups, by dimension and name

  explicit Msh_entities(const Labelled_mesh& mesh)
  {
    for (const Physical_group& group : mesh.groups)
      tags[{group.dimension, group.name}] = group.tag;
    const std::vector<int> curve_tags = add_labels(1, mesh.curves);
    const std::vector<int> region_tags = add_labels(2, mesh.regions);
    const auto tag_of = [](const std::vector<int>& tags_of_labels, int label) {
      return tags_of_labels[label < 0 ? tags_of_labels.size() - 1 : std::size_t(label)];
    };

    std::vector<int> curve_at(mesh.points.size(), 0), n_lines(mesh.points.size(), 0);
    std::vector<char> is_corner(mesh.points.size(), 0);
    std::map<std::pair<int, int>, int> curve_of_edge;
    for (std::size_t l = 0; l < mesh.lines.size(); ++l) {
      const int tag = tag_of(curve_tags, mesh.line_curve[l]);
      entities[1][tag].elements.push_back(int(l));
      curve_of_edge[std::minmax(mesh.lines[l][0], mesh.lines[l][1])] = tag;
      for (const int p : mesh.lines[l]) {
        is_corner[std::size_t(p)] |= curve_at[std::size_t(p)] != 0 && curve_at[std::size_t(p)] != tag;
        curve_at[std::size_t(p)] = tag;
        ++n_lines[std::size_t(p)];
      }
    }
    std::vector<int> region_at(mesh.points.size(), 0);
    for (std::size_t f = 0; f < mesh.polygons.size(); ++f) {
      const std::vector<int>& polygon = mesh.polygons[f];
      const int tag = tag_of(region_tags, mesh.polygon_region[f]);
      entities[2][tag].elements.push_back(int(f));
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        region_at[std::size_t(polygon[i])] = tag;
        const auto curve = curve_of_edge.find(std::minmax(polygon[i], polygon[(i + 1) % polygon.size()]));
        if (curve != curve_of_edge.end())
          entities[2][tag].boundary.insert(curve->second);
      }
    }
    int n_corners = 0;
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
      if (n_lines[p] != 0 && (is_corner[p] || n_lines[p] != 2))
        corner_points[++n_corners] = int(p);
      else if (curve_at[p] != 0)
        entities[1][curve_at[p]].points.push_back(int(p));
      else
        entities[2][region_at[p] != 0 ? region_at[p] : region_tags.back()].points.push_back(int(p));
    }
    add_corners_to_curves(mesh, curve_tags);
    remove_unused();
    measure(mesh);
  }

private:
  /// Tags per label, and one more for what has no label.
  std::vector<int> add_labels(std::size_t dimension, const std::vector<Entity_label>& labels)
  {
    std::vector<int> result;
    int largest = 0;
    for (const Entity_label& label : labels) {
      std::vector<int>& physical = entities[dimension][label.tag].physical_tags;
      for (const std::string& name : label.names) {
        const int tag = physical_tag(int(dimension), name);
        if (std::find(physical.begin(), physical.end(), tag) == physical.end())
          physical.push_back(tag);
      }
      result.push_back(label.tag);
      largest = std::max(largest, label.tag);
    }
    result.push_back(largest + 1);
    return result;
  }

  int physical_tag(int dimension, const std::string& name)
  {
    const auto known = tags.find({dimension, name});
    if (known != tags.end())
      return known->second;
    int largest = 0;
    for (const auto& [key, tag] : tags)
      largest = std::max(largest, tag);
    return tags[{dimension, name}] = largest + 1;
  }

  void add_corners_to_curves(const Labelled_mesh& mesh, const std::vector<int>& curve_tags)
  {
    std::map<int, int> tag_of_point;
    for (const auto& [tag, p] : corner_points)
      tag_of_point[p] = tag;
    for (std::size_t l = 0; l < mesh.lines.size(); ++l)
      for (const int p : mesh.lines[l])
        if (const auto corner = tag_of_point.find(p); corner != tag_of_point.end())
          entities[1][curve_tags[mesh.line_curve[l] < 0 ? curve_tags.size() - 1 : std::size_t(mesh.line_curve[l])]]
              .boundary.insert(corner->second);
  }

  void remove_unused()
  {
    for (std::map<int, Entity>& of_dimension : entities)
      for (auto entity = of_dimension.begin(); entity != of_dimension.end();)
        entity = entity->second.elements.empty() && entity->second.points.empty() ? of_dimension.erase(entity)
                                                                                  : std::next(entity);
  }

  void measure(const Labelled_mesh& mesh)
  {
    const auto include = [&](Entity& entity, int p) {
      const std::array<double, 3>& x = mesh.points[std::size_t(p)];
      for (std::size_t k = 0; k < 3; ++k) {
        entity.low[k] = entity.has_box ? std::min(entity.low[k], x[k]) : x[k];
        entity.high[k] = entity.has_box ? std::max(entity.high[k], x[k]) : x[k];
      }
      entity.has_box = true;
    };
    for (auto& [tag, entity] : entities[1])
      for (const int l : entity.elements)
        for (const int p : mesh.lines[std::size_t(l)])
          include(entity, p);
    for (auto& [tag, entity] : entities[2])
      for (const int f : entity.elements)
        for (const int p : mesh.polygons[std::size_t(f)])
          include(entity, p);
  }
};

} // namespace internal
} // namespace Quadrille

#endif
