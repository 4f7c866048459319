// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_FIND_SURFACES_H
#define QUADRILLE_MESH_IO_INTERNAL_FIND_SURFACES_H

#include <Quadrille/Mesh_io/internal/Spatial_extent.h>
#include <Quadrille/exceptions.h>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

/// The tags of Gmsh's entities of a dimension that belong to the model: those in physical groups if there are any, as
/// Gmsh itself has it when it saves, and otherwise all.
inline std::vector<int> entities_of_model(int dimension, bool* are_grouped = nullptr)
{
  gmsh::vectorpair groups, entities;
  gmsh::model::getPhysicalGroups(groups, dimension);
  std::set<int> tags;
  for (const auto& [d, group] : groups) {
    std::vector<int> members;
    gmsh::model::getEntitiesForPhysicalGroup(d, group, members);
    for (const int member : members)
      tags.insert(std::abs(member));
  }
  if (are_grouped)
    *are_grouped = !tags.empty();
  gmsh::model::getEntities(entities, dimension);
  std::vector<int> result;
  for (const auto& [d, tag] : entities)
    if (tags.empty() || tags.count(tag))
      result.push_back(tag);
  return result;
}

/// The tags of what bounds some entities, ascending.
inline std::vector<int> boundary_of(int dimension, const std::vector<int>& tags)
{
  std::set<int> result;
  for (const int tag : tags) {
    gmsh::vectorpair boundary;
    gmsh::model::getBoundary({{dimension, tag}}, boundary, false, false);
    for (const auto& [d, t] : boundary)
      result.insert(std::abs(t));
  }
  return {result.begin(), result.end()};
}

/// Curves that are embedded in a surface.
inline std::vector<int> curves_embedded_in(int surface)
{
  gmsh::vectorpair embedded;
  gmsh::model::mesh::getEmbedded(2, surface, embedded);
  std::vector<int> curves;
  for (const auto& [d, t] : embedded)
    if (d == 1)
      curves.push_back(std::abs(t));
  return curves;
}

/// All curves of some surfaces, ascending.
inline std::vector<int> curves_of(const std::vector<int>& surfaces)
{
  std::vector<int> curves = boundary_of(2, surfaces);
  for (const int surface : surfaces)
    for (const int curve : curves_embedded_in(surface))
      curves.push_back(curve);
  std::sort(curves.begin(), curves.end());
  curves.erase(std::unique(curves.begin(), curves.end()), curves.end());
  return curves;
}

/// Points x, y, z at `n` + 1 parameters of a curve; empty if it cannot be evaluated.
inline std::vector<double> sample_curve(int curve, int n)
{
  std::vector<double> low, high, parameters, xyz;
  gmsh::model::getParametrizationBounds(1, curve, low, high);
  if (low.empty() || high.empty())
    return xyz;
  for (int i = 0; i <= n; ++i)
    parameters.push_back(i == n ? high[0] : low[0] + (high[0] - low[0]) * i / n);
  gmsh::model::getValue(1, curve, parameters, xyz);
  return xyz;
}

/// The tags of the surfaces of Gmsh's current model that are to be meshed, ascending. \throws Invalid_input_error
inline std::vector<int> find_surfaces(const std::string& path)
{
  const auto fail = [&](const std::string& reason) { throw Invalid_input_error(path + ": " + reason); };
  bool are_grouped = false;
  std::vector<int> surfaces = entities_of_model(2, &are_grouped);
  const std::vector<int> volumes = entities_of_model(3);
  if (!are_grouped && !volumes.empty()) {
    surfaces = boundary_of(3, volumes);
    std::map<int, int> volume_of;
    for (const int volume : volumes)
      for (const int surface : boundary_of(3, {volume})) {
        const auto [other, is_new] = volume_of.emplace(surface, volume);
        if (!is_new)
          fail("surface " + std::to_string(surface) + " lies between the volumes " + std::to_string(other->second) +
               " and " + std::to_string(volume) +
               ", so that three surfaces meet in its curves, which is not manifold; make a physical volume of one of "
               "them, or a physical surface of the surfaces that are wanted");
      }
  }
  if (surfaces.empty())
    fail("the geometry has no surfaces");
  for (const int surface : surfaces) {
    std::string type;
    gmsh::model::getType(2, surface, type);
    if (type.find("Discrete") != std::string::npos)
      fail("surface " + std::to_string(surface) + " is a mesh, not a geometry; give the mesh file itself");
  }
  return surfaces;
}

/// Whether Gmsh's current model has no volumes, and a surface has a curve at which nothing goes on.
inline bool has_free_curves()
{
  gmsh::vectorpair volumes, surfaces;
  gmsh::model::getEntities(volumes, 3);
  gmsh::model::getEntities(surfaces, 2);
  std::map<int, int> n_uses;
  for (const auto& [dimension, tag] : surfaces) {
    gmsh::vectorpair boundary;
    gmsh::model::getBoundary({{2, tag}}, boundary, false, false);
    for (const auto& [d, curve] : boundary)
      ++n_uses[std::abs(curve)];
  }
  return volumes.empty() && std::any_of(n_uses.begin(), n_uses.end(), [](const auto& use) { return use.second == 1; });
}

/// Whether Gmsh's current model has no volumes, and its surfaces lie in a plane z = constant. True if nothing tells.
inline bool is_planar_geometry()
{
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  if (!volumes.empty())
    return false;
  Spatial_extent extent;
  const auto add = [&](const std::vector<double>& xyz) {
    for (std::size_t i = 0; i + 2 < xyz.size(); i += 3)
      extent.add({xyz[i], xyz[i + 1], xyz[i + 2]});
  };
  const std::vector<int> surfaces = entities_of_model(2);
  for (const int curve : curves_of(surfaces))
    add(sample_curve(curve, 32));
  for (const int surface : surfaces) { // a curved surface can have a plane boundary
    std::string type;
    gmsh::model::getType(2, surface, type);
    if (type.find("Plane") != std::string::npos || type.find("Discrete") != std::string::npos)
      continue;
    std::vector<double> from, to, uv, xyz;
    gmsh::model::getParametrizationBounds(2, surface, from, to);
    for (int i = 1; i < 8; ++i)
      for (int j = 1; j < 8; ++j) {
        uv.push_back(from[0] + (to[0] - from[0]) * i / 8);
        uv.push_back(from[1] + (to[1] - from[1]) * j / 8);
      }
    gmsh::model::getValue(2, surface, uv, xyz);
    add(xyz);
  }
  return extent.is_flat(1e-7); // geometry kernels represent planes by rounded rotations
}

} // namespace internal
} // namespace Quadrille

#endif
