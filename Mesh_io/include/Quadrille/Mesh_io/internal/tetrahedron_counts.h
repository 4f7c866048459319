// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_TETRAHEDRON_COUNTS_H
#define QUADRILLE_MESH_IO_INTERNAL_TETRAHEDRON_COUNTS_H

#include <Quadrille/exceptions.h>
#include <Quadrille/fill_with_tetrahedra.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace Quadrille {
namespace internal {

/// Edges inside, where nobody asks for a length. \param diagonal of the bounding box
inline double default_tetrahedron_size(double diagonal) { return diagonal / 20; }

/// Of a regular tetrahedron.
inline double tetrahedron_volume(double edge_length)
{
  return edge_length * edge_length * edge_length / (6 * std::sqrt(2.0));
}

/// \throws Invalid_input_error if the tetrahedra would be too many
inline void check_number_of_tetrahedra(double volume, double edge_length, const Filling_options& options,
                                       const std::string& path)
{
  const double n = volume / tetrahedron_volume(edge_length);
  if (n <= double(options.max_tetrahedra))
    return;
  char text[200];
  std::snprintf(text, sizeof text,
                ": tetrahedra with edges of length %.3g would be about %.2g; at most %.2g are made "
                "(Filling_options::max_tetrahedra)",
                edge_length, n, double(options.max_tetrahedra));
  throw Invalid_input_error(path + text);
}

} // namespace internal
} // namespace Quadrille

#endif
