// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_SMOOTHING_H
#define QUADRILLE_QUAD_SMOOTHING_H

#include <Quadrille/Quad_smoothing_options.h>
#include <Quadrille/exceptions.h>

namespace Quadrille {

/// Untangles and smooths a planar quad mesh: moves its vertices so that every quad comes near to a rectangle with the
/// side lengths asked for, with all corners strictly convex. Connectivity stays.
///
/// Interior vertices that are not fixed move freely. Border vertices that are not fixed slide along the border as it is
/// given, between the fixed ones (corners should be fixed). The energy is that of Garanzha et al., "Foldover-free maps
/// in 50 lines of code" (2021), with a term for right angles, minimised by Levenberg-Marquardt steps.
///
/// \param mesh model of `FaceListGraph`, all faces quads, a manifold with border.
/// \param points readable and writable, vertex -> planar point with double coordinates.
/// \param fixed readable, vertex -> bool.
/// \param targets readable, face -> pair of double: wanted lengths of `halfedge(face)` and the side opposite to it, and
///        of the two other sides; only their ratios over the whole mesh matter.
/// \return what was done; `inverted_quads` > 0 if the mesh could not be untangled.
///
/// \throws Invalid_input_error if a face is not a quad, a length is not positive, there is no quad, or faces are not
///         counterclockwise; nothing has been moved then. \throws Cancelled_error.
/// Complexity: some ten to some hundred sparse factorisations.
template <class QuadMesh, class VertexPointMap, class VertexFixedMap, class FaceTargetMap>
Quad_smoothing_report smooth_quads(const QuadMesh& mesh, VertexPointMap points, VertexFixedMap fixed,
                                   FaceTargetMap targets, const Quad_smoothing_options& options = {});

/// The same with the mean lengths of each quad's opposite sides as targets: makes quads rectangular, keeps sizes.
template <class QuadMesh, class VertexPointMap, class VertexFixedMap>
Quad_smoothing_report smooth_quads(const QuadMesh& mesh, VertexPointMap points, VertexFixedMap fixed,
                                   const Quad_smoothing_options& options = {});

} // namespace Quadrille

#include <Quadrille/Quad_extraction/internal/quad_smoothing_impl.h>

#endif
