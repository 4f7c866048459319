// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_INTEGER_GRID_MAP_H
#define QUADRILLE_INTEGER_GRID_MAP_H

#include <Quadrille/Map_displacement.h>
#include <Quadrille/seamless_parametrization.h>

#include <vector>

namespace Quadrille {

/// Makes an integer-grid map of a seamless one: singularities, corners and feature curves come to lie on integer
/// coordinates and seams translate by integers, so that the integer isolines are the edges of a quad mesh. It is the
/// map whose Jacobians relative to the given one are nearest to `scale` times the identity, without flipped triangles
/// if untangling succeeds.
///
/// \tparam Solver model of `SparseCholeskySolver`
/// \param mesh a model of `FaceListGraph` and `HalfedgeGraph`, plane or curved: its points are not needed
/// \param seamless_uv readable property map, halfedge -> the corner's point with `x()` and `y()`, as
///   `seamless_parametrization()` writes it: exactly seamless, without flipped triangles
/// \param constrained readable property map, edge -> bool: the feature edges; boundary edges always are
/// \param displacements between singularities, corners and curves, by whole numbers: those of a quantized layout
///   (`Quad_extraction_result::displacements`), or one's own
/// \param scale units of the new map per unit of the given one (`Quad_extraction_result::scale`)
/// \param uv writable property map, halfedge -> point constructible from two doubles
/// \return as `seamless_parametrization()`; its `integration_error` is relative to the scaled map. Triangles that are
///   still flipped are data, not an error.
/// \throws Invalid_input_error if `seamless_uv` is not seamless or has flipped triangles, or an index is out of range
/// \throws No_result_error if displacements contradict each other or the curves
/// Complexity: near-linear but for one sparse Cholesky factorisation, O(n^1.5), and one for each step of untangling.
/// Sources: Bommes et al. 2013 (integer-grid maps); Garanzha et al. 2021 (untangling).
template <class Solver = Cholesky_solver, class TriangleMesh, class SeamlessUvMap, class EdgeConstrainedMap,
          class CornerUvMap>
Seamless_map<TriangleMesh> integer_grid_map(const TriangleMesh& mesh, SeamlessUvMap seamless_uv,
                                            EdgeConstrainedMap constrained,
                                            const std::vector<Map_displacement>& displacements, double scale,
                                            CornerUvMap uv, const Seamless_parametrization_options& options = {});

} // namespace Quadrille

#include <Quadrille/Seamless_parametrization/internal/integer_grid_map_impl.h>

#endif
