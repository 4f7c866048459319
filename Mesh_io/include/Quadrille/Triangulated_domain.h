// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TRIANGULATED_DOMAIN_H
#define QUADRILLE_TRIANGULATED_DOMAIN_H

#include <Quadrille/Labelled_mesh.h>

#include <CGAL/Dimension.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <string>
#include <vector>

namespace Quadrille {

/// A readable property map over a vector that is indexed by a descriptor's `idx()`.
template <class Descriptor, class Value> struct Indexed_property_map {
  using key_type = Descriptor;
  using value_type = Value;
  using reference = Value;
  using category = boost::readable_property_map_tag;

  const std::vector<Value>* values = nullptr;

  friend Value get(const Indexed_property_map& map, const Descriptor& d) { return (*map.values)[std::size_t(d.idx())]; }
};

/// Triangles with their curves, regions and the names of these: what planar domains and surfaces have in common.
///
/// The mesh is manifold, consistently oriented and has no removed elements, so descriptors are dense indices.
/// \tparam Point `Point_2` or `Point_3` of a CGAL kernel
template <class Point> struct Triangulated_domain {
  static constexpr std::size_t dimension = CGAL::Ambient_dimension<Point>::value; ///< 2 or 3

  using Kernel = typename CGAL::Kernel_traits<Point>::Kernel;
  using Mesh = CGAL::Surface_mesh<Point>;
  using vertex_descriptor = typename Mesh::Vertex_index;
  using halfedge_descriptor = typename Mesh::Halfedge_index;
  using edge_descriptor = typename Mesh::Edge_index;
  using face_descriptor = typename Mesh::Face_index;

  /// A simple path or loop of mesh edges that belongs to one curve of the input.
  struct Curve : Entity_label {
    std::vector<halfedge_descriptor> path; ///< consecutive, from the curve's first to its last point
    vertex_descriptor first, last;         ///< equal when `closed`
    bool closed = false;
    int chain = -1;
  };

  Mesh mesh;
  std::vector<Curve> curves;
  std::vector<Entity_label> regions;
  std::vector<Physical_group> groups;

  std::vector<int> edge_curve;  ///< per edge: index into `curves`, -1 if it is on none; never -1 on the border
  std::vector<int> edge_chain;  ///< per edge: the chain of its curve, -1 if it is on none
  std::vector<int> face_region; ///< per face: index into `regions`
  /// Chains are maximal sequences of curves with the same names that join smoothly (no corner, no third curve):
  /// what a mesher should keep as one feature.
  int number_of_chains = 0;

  /// Per vertex, the element size that the input file prescribes there; 0 where it prescribes none.
  std::vector<double> point_size;

  std::string source;             ///< where it came from, for messages: usually the file name
  double triangle_size = 0;       ///< largest triangle edge that was asked for; 0 for meshes taken as they are
  std::vector<std::string> notes; ///< choices made while reading that the user should know

  Indexed_property_map<edge_descriptor, int> curve_map() const { return {&edge_curve}; }
  Indexed_property_map<edge_descriptor, int> chain_map() const { return {&edge_chain}; }
  Indexed_property_map<face_descriptor, int> region_map() const { return {&face_region}; }
};

} // namespace Quadrille

#endif
