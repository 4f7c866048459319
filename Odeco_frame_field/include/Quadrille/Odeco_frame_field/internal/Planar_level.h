// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_PLANAR_LEVEL_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_PLANAR_LEVEL_H

#include <Quadrille/Odeco_frame_field/internal/Field_hierarchy.h>
#include <Quadrille/Odeco_frame_field/internal/Field_prolongation.h>
#include <Quadrille/Odeco_frame_field/internal/Field_solver.h>

#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// A coarser copy of a planar field.
template <int N> struct Planar_level {
  using Mesh = Constrained_mesh;
  using Elements = Field_elements<N>;
  using Solver = Field_solver<N>;
  static constexpr bool relaxes_from_coarse = false;

  Planar_level(const Constrained_mesh& finer, const Field_elements<N>& finer_elements, std::size_t n_faces)
      : mesh(coarsen_with_local_sizes(finer, n_faces, fine_vertex, coarse_vertex)),
        elements(restricted_elements(finer_elements)), to_finer(mesh.mesh, mesh.points, finer.points, coarse_vertex)
  {
  }

  std::vector<int> fine_vertex, coarse_vertex;
  Constrained_mesh mesh;
  Field_elements<N> elements;
  Field_prolongation to_finer;

private:
  /// What holds at a vertex of the finer mesh holds at the same vertex here.
  Field_elements<N> restricted_elements(const Field_elements<N>& finer) const
  {
    std::vector<Vertex_restriction<N>> restrictions;
    std::vector<double> log_sizes;
    for (const int v : fine_vertex) {
      restrictions.push_back(finer.restriction(std::size_t(v)));
      log_sizes.push_back(finer.expected_log_value(std::size_t(v)));
    }
    return Field_elements<N>(mesh.mesh, mesh.points, local_triangle_sizes(mesh.mesh, mesh.points),
                             std::move(restrictions), std::move(log_sizes), finer.targets().at(fine_vertex));
  }
};

} // namespace internal
} // namespace Quadrille

#endif
