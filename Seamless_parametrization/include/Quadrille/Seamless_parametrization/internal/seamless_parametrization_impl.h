// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_SEAMLESS_PARAMETRIZATION_IMPL_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_SEAMLESS_PARAMETRIZATION_IMPL_H

#include <Quadrille/Seamless_parametrization/internal/Face_graph_adaptor.h>
#include <Quadrille/Seamless_parametrization/internal/Seamless_map_solver.h>

#include <boost/property_map/property_map.hpp>

#include <chrono>
#include <cstddef>
#include <utility>

namespace Quadrille {
namespace internal {

/// Tells a map in the mesh's own descriptors. (Names are qualified because other packages' internals use them too.)
template <class TriangleMesh> class Seamless_map_translator {
public:
  Seamless_map_translator(const Mesh_index<TriangleMesh>& index, const Seamless_map_data& data)
      : m_index(index), m_data(data), m_triangulation(index.triangulation)
  {
  }

  Quadrille::Seamless_map<TriangleMesh> operator()() const
  {
    Quadrille::Seamless_map<TriangleMesh> map;
    translate_figures(map);
    translate_vertices(map);
    translate_seams(map);
    for (const int f : m_data.flipped_faces)
      map.flipped_faces.push_back(m_index.face_of[std::size_t(f)]);
    for (const int f : m_data.flat_faces)
      map.flat_faces.push_back(m_index.face_of[std::size_t(f)]);
    return map;
  }

private:
  void translate_figures(Quadrille::Seamless_map<TriangleMesh>& map) const
  {
    map.integration_error = m_data.integration_error;
    map.integration_residual = m_data.integration_residual;
    map.seam_residual_max = m_data.seam_residual_max;
    map.flipped = int(m_data.flipped_faces.size());
    map.flipped_before_untangling = m_data.flipped_before_untangling;
    map.untangling_rounds = m_data.untangling_rounds;
    map.moved_singularities = m_data.moved_singularities;
  }

  void translate_vertices(Quadrille::Seamless_map<TriangleMesh>& map) const
  {
    int quarters = 0;
    for (int v = 0; v < m_triangulation.number_of_vertices(); ++v) {
      const int index = m_data.topology.quarter_index(m_triangulation, v);
      quarters += index;
      if (index == 0 || m_triangulation.is_boundary_vertex(v))
        continue;
      ++map.singularities[4 - index];
      map.singular_vertices.emplace_back(m_index.vertex_of[std::size_t(v)], 4 - index);
    }
    map.index_sum = quarters / 4.0;
    for (const Frame_topology::Sector& sector : m_data.topology.sectors)
      if (sector.constrained && sector.quadrants != 2)
        map.corners.push_back({m_index.vertex_of[std::size_t(sector.vertex)],
                               m_index.halfedge_of[std::size_t(sector.first_corner)], sector.quadrants});
    for (const int v : m_data.topology.repaired_vertices)
      map.repaired_vertices.push_back(m_index.vertex_of[std::size_t(v)]);
    for (const int v : m_data.misturned_vertices)
      map.misturned_vertices.push_back(m_index.vertex_of[std::size_t(v)]);
  }

  void translate_seams(Quadrille::Seamless_map<TriangleMesh>& map) const
  {
    for (const Cut_graph::Path& path : m_data.cut.paths) {
      typename Quadrille::Seamless_map<TriangleMesh>::Seam seam;
      for (const int h : path.halfedges)
        seam.halfedges.push_back(m_index.halfedge_of[std::size_t(h)]);
      seam.matching = path.matching;
      const int h = path.halfedges.front();
      const int other_corner = Indexed_triangulation::next(m_triangulation.opposite(h)); // at the same vertex
      const Eigen::Vector2d translation =
          m_data.uv[std::size_t(other_corner)] - rotate_quarters(m_data.uv[std::size_t(h)], path.matching);
      seam.translation = {translation.x(), translation.y()};
      map.seams.push_back(std::move(seam));
    }
  }

  const Mesh_index<TriangleMesh>& m_index;
  const Seamless_map_data& m_data;
  const Indexed_triangulation& m_triangulation;
};

/// Writes a map to the mesh's corners; the rest in its descriptors.
template <class TriangleMesh, class CornerUvMap>
Quadrille::Seamless_map<TriangleMesh> finish_map(const Mesh_index<TriangleMesh>& index, const Seamless_map_data& data,
                                                 CornerUvMap uv)
{
  using Uv = typename boost::property_traits<CornerUvMap>::value_type;
  for (int h = 0; h < index.triangulation.number_of_halfedges(); ++h) {
    const Eigen::Vector2d& value = data.uv[std::size_t(Indexed_triangulation::next(h))];
    put(uv, index.halfedge_of[std::size_t(h)], Uv(value.x(), value.y()));
  }
  return Seamless_map_translator<TriangleMesh>(index, data)();
}

} // namespace internal

template <class Solver, class TriangleMesh, class Traits, class FaceGradientMap, class EdgeConstrainedMap,
          class CornerUvMap>
Seamless_map<TriangleMesh> seamless_parametrization_with_traits(const TriangleMesh& mesh, const Traits& traits,
                                                                FaceGradientMap gradients,
                                                                EdgeConstrainedMap constrained, CornerUvMap uv,
                                                                const Seamless_parametrization_options& options)
{
  const auto start = std::chrono::steady_clock::now();
  internal::Face_graph_adaptor<TriangleMesh> input(mesh, traits, gradients, constrained);
  const internal::Seamless_map_solver<Solver> solver(input.index.triangulation, std::move(input.geometry),
                                                     std::move(input.constrained));
  Seamless_map<TriangleMesh> map = internal::finish_map(input.index, solver(input.gradients, options), uv);
  map.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return map;
}

template <class Solver, class TriangleMesh, class VertexPointMap, class FaceGradientMap, class EdgeConstrainedMap,
          class CornerUvMap>
Seamless_map<TriangleMesh> seamless_parametrization(const TriangleMesh& mesh, VertexPointMap points,
                                                    FaceGradientMap gradients, EdgeConstrainedMap constrained,
                                                    CornerUvMap uv, const Seamless_parametrization_options& options)
{
  return seamless_parametrization_with_traits<Solver>(
      mesh, Planar_tangent_traits<TriangleMesh, VertexPointMap>(mesh, points), gradients, constrained, uv, options);
}

} // namespace Quadrille

#endif
