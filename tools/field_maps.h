// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_FIELD_MAPS_H
#define QUADRILLE_TOOLS_FIELD_MAPS_H

#include <Quadrille/Frame_edge_constraints.h>
#include <Quadrille/Planar_domain.h>
#include <Quadrille/Surface_domain.h>
#include <Quadrille/Surface_tangent_traits.h>
#include <Quadrille/exceptions.h>
#include <Quadrille/seamless_parametrization.h>

#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace Quadrille {

/// Values in the order of a mesh's faces, edges or halfedges.
template <class Value> auto vector_map(std::vector<Value>& values)
{
  return boost::make_iterator_property_map(values.begin(), boost::identity_property_map());
}

template <class Domain> struct Is_on_curve {
  using key_type = typename Domain::edge_descriptor;
  using value_type = bool;
  using reference = bool;
  using category = boost::readable_property_map_tag;
  const Domain* domain;
  friend bool get(const Is_on_curve& map, const key_type& e) { return map.domain->edge_curve[e.idx()] >= 0; }
};

inline auto tangent_traits(const Surface_domain& domain)
{
  using Mesh = Surface_domain::Mesh;
  return Surface_tangent_traits<Mesh, Mesh::Property_map<Surface_domain::vertex_descriptor, Surface_domain::Point_3>>(
      domain.mesh, domain.mesh.points());
}

/// Of maps that are folded; more than that of any other.
constexpr double cost_of_folded_map = 1e3;

/// A candidate without a locally injective map is worse than every other, by how much of it is folded.
template <class Mesh> double cost_of_map(const Seamless_map<Mesh>& map)
{
  const std::size_t n_folded = std::size_t(map.flipped) + map.misturned_vertices.size();
  return n_folded == 0 ? map.integration_error : cost_of_folded_map + double(n_folded);
}

/// What a start made: its field, and the map of that unless there is none.
template <class Mesh> struct Field_candidate {
  std::vector<Gradient_pair> gradients;
  std::optional<Seamless_map<Mesh>> map;
  std::vector<Planar_domain::Point_2> corner_uv;
};

/// The maps of a field's starts, which they are judged by; each has its candidate, so that many can be judged at a
/// time.
template <class Mesh> class Start_maps {
public:
  std::vector<Field_candidate<Mesh>> candidates;

  /// \param n_melted starts; there are a smooth and a relaxed one, too
  explicit Start_maps(int n_melted) : candidates(2 + std::size_t(n_melted > 0 ? n_melted : 0)) {}

  /// The cost of a start's map, which `integrate(gradients, corner_uv)` makes; infinite if there is none.
  template <class Integrate> Field_evaluator::Cost cost(const Integrate& integrate)
  {
    return [this, integrate](std::size_t start, const std::vector<Gradient_pair>& gradients) -> double {
      Field_candidate<Mesh>& candidate = candidates[start];
      candidate.gradients = gradients;
      try {
        candidate.map = integrate(gradients, candidate.corner_uv);
        return cost_of_map(*candidate.map);
      } catch (const No_result_error&) {
        return std::numeric_limits<double>::infinity();
      }
    };
  }

  /// Negative if the smooth field has no map.
  double smooth_integration_error() const { return candidates[0].map ? candidates[0].map->integration_error : -1; }
};

} // namespace Quadrille

#endif
