// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_INTEGER_GRID_H
#define QUADRILLE_TOOLS_INTEGER_GRID_H

#include "field_maps.h"

#include <Quadrille/Quad_extraction_options.h>
#include <Quadrille/integer_grid_map.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {

/// The integer-grid map whose isolines are the edges of the quads, before these are smoothed.
struct Integer_grid {
  std::vector<Planar_domain::Point_2> corner_uv; ///< per halfedge: of the corner at its target
  std::size_t flipped = 0;                       ///< triangles
  double seconds = 0;
};

/// \pre `extraction` was made of `seamless_uv`, with its displacements.
template <class Domain>
Integer_grid make_integer_grid(const Domain& domain, std::vector<Planar_domain::Point_2> seamless_uv,
                               const Quad_extraction_result& extraction, int threads)
{
  Integer_grid grid;
  grid.corner_uv.assign(seamless_uv.size(), Planar_domain::Point_2(0, 0));
  Seamless_parametrization_options options;
  options.threads = threads;
  const auto map = integer_grid_map(domain.mesh, vector_map(seamless_uv), Is_on_curve<Domain>{&domain},
                                    extraction.displacements, extraction.scale, vector_map(grid.corner_uv), options);
  grid.flipped = map.flipped_faces.size();
  grid.seconds = map.seconds;
  return grid;
}

/// For a map with flipped triangles.
inline std::string note_on_integer_grid(const std::string& path, const Integer_grid& grid)
{
  return path + ": " + std::to_string(grid.flipped) +
         " triangles of the integer-grid map are flipped; smaller triangles help";
}

} // namespace Quadrille

#endif
