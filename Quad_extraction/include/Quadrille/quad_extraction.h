// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_H
#define QUADRILLE_QUAD_EXTRACTION_H

#include <Quadrille/Default_quantizer.h>
#include <Quadrille/Quad_extraction_options.h>
#include <Quadrille/exceptions.h>

namespace Quadrille {

/// Default model of `CurveProjector`: curves are the polylines of the triangulation's edges.
struct No_curve_projector {
  template <class Point> Point operator()(int /*curve*/, const Point& p) const { return p; }
};

/// Extracts a conforming quad mesh from an exactly seamless map of a triangulation in the plane or in space, one quad
/// per unit square.
///
/// Separatrices of the map are traced without rounding and cut the domain into quadrilateral patches
/// (`options.layout` says which part of them); `quantizer` gives their arcs integer lengths; what gets length 0 is
/// collapsed, the remaining patches are filled with grids, which are smoothed towards the shapes that the map
/// prescribes. Method: Couplet, Chemin and Remacle, "Size-Controlled Quadrilateral Meshing using Integrable Odeco
/// Fields", Section 7.2; smoothing: Garanzha et al., "Foldover-free maps in 50 lines of code" (2021).
///
/// The quad mesh has the topology of the domain; its interior irregular vertices are the singularities of the map with
/// their valences; all its corners are strictly convex (in space: seen along the normals of their quads); its border
/// edges lie on the domain's border and the feature curves of the domain are chains of its edges (vertices on the
/// curves, corners on corners).
///
/// \param mesh model of `FaceListGraph`, all faces triangles, a manifold, with border in the plane.
/// \param points readable, vertex -> point with double coordinates: `x()`, `y()`, and in space `z()`. The quads' points
///        have as many coordinates.
/// \param corner_uv readable, halfedge h -> map coordinates (`x()`, `y()`) of the corner at `target(h)` in `face(h)`:
///        concept `SeamlessCornerMap`. All coordinates are multiples of a power of two that leaves some bits free.
/// \param edge_curves readable, edge -> int: the curve that the edge lies on, -1 for none. Border edges lie on one;
///        edges between different regions and other edges to be kept do as well. u or v is constant along each.
/// \param face_regions readable, face -> int: copied to the quads.
/// \param[out] quads model of `MutableFaceGraph` with an internal vertex point map; the quads are added to it.
/// \param quantizer model of `Quantizer`.
/// \param project model of `CurveProjector`: `Point project(int curve, Point p)` takes a point of the polyline to the
///        true curve.
///
/// \throws Invalid_input_error if the map is not exactly seamless, or not aligned with a curve (naming the halfedge:
///         halfedge 3 f + i leaves corner i of the f-th face), or an edge lacks a curve.
/// \throws Invalid_argument_error for unusable `options.counts`, see `Length_constraints`.
/// \throws No_result_error "map" for a flipped triangle or too few right angles in a corner, "layout" for a separatrix
/// that does not end, "quantization" if
///         the mesh would be too large or requested counts are impossible, "mesh" if the quads cannot be made valid;
///         nothing is added to `quads` then.
///
/// Complexity: tracing is linear in the number of triangles that the separatrices cross, the rest about linear in the
/// number of patches and quads, times the cost of the sparse factorisations (practically n log n).
template <class TriangleMesh, class VertexPointMap, class CornerUvMap, class EdgeCurveMap, class FaceRegionMap,
          class QuadMesh, class Quantizer = Default_quantizer, class CurveProjector = No_curve_projector>
Quad_extraction_result extract_quads(const TriangleMesh& mesh, VertexPointMap points, CornerUvMap corner_uv,
                                     EdgeCurveMap edge_curves, FaceRegionMap face_regions, QuadMesh& quads,
                                     const Quad_extraction_options& options = {}, const Quantizer& quantizer = {},
                                     const CurveProjector& project = {});

} // namespace Quadrille

#include <Quadrille/Quad_extraction/internal/extract_quads_impl.h>

#endif
