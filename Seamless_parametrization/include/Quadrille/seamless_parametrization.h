// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_H

#include <Quadrille/Cholesky_solver.h>
#include <Quadrille/Planar_tangent_traits.h>
#include <Quadrille/Seamless_parametrization_options.h>
#include <Quadrille/exceptions.h>

#include <boost/graph/graph_traits.hpp>

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace Quadrille {

/// Figures of a computed map.
struct Seamless_parametrization_result {
  std::map<int, int> singularities; ///< valence -> number of interior vertices; valence 4 is regular and left out
  double index_sum = 0.0;           ///< over all vertices; equals the Euler characteristic, or an error is thrown
  /// 1 / (3 area) times the integral of l^2 |grad u - du|^2 + m^2 |grad v - dv|^2, with l = 1/|du| and m = 1/|dv|.
  double integration_error = 0.0;
  double integration_residual = 0.0; ///< the integral of |grad u - du|^2 + |grad v - dv|^2 (planar-2, eq. (36))
  double seam_residual_max = 0.0;    ///< always exactly 0, or an error is thrown
  int flipped = 0;                   ///< faces that are not positively oriented in (u, v); decided exactly
  int flipped_before_untangling = 0;
  int untangling_rounds = 0;
  int moved_singularities = 0; ///< times that one was moved
  double seconds = 0.0;
};

/// A computed map in the mesh's own descriptors.
template <class TriangleMesh> struct Seamless_map : Seamless_parametrization_result {
  using vertex_descriptor = typename boost::graph_traits<TriangleMesh>::vertex_descriptor;
  using halfedge_descriptor = typename boost::graph_traits<TriangleMesh>::halfedge_descriptor;
  using face_descriptor = typename boost::graph_traits<TriangleMesh>::face_descriptor;

  /// Where coordinates jump: for all points of the halfedges, (u,v) of the face beyond the halfedge is
  /// R^matching (u,v) of its own face + translation, with R (u,v) = (-v,u). Exact in doubles.
  struct Seam {
    std::vector<halfedge_descriptor> halfedges; ///< consecutive
    int matching = 0;                           ///< in {0, 1, 2, 3}
    std::array<double, 2> translation{};
  };
  /// A wedge of a vertex between two consecutive boundary or feature edges.
  struct Corner {
    vertex_descriptor vertex;
    halfedge_descriptor halfedge; ///< leaves `vertex`; bounds the wedge clockwise, so its face lies in it
    int quadrants = 0;            ///< the angle of the wedge in (u, v), divided by 90 degrees; at least 1
  };

  std::vector<std::pair<vertex_descriptor, int>> singular_vertices; ///< interior, with their valence (quadrants)
  std::vector<Corner> corners;                                      ///< wedges with other than 2 quadrants
  std::vector<Seam> seams;                                          ///< elsewhere coordinates agree across edges
  std::vector<vertex_descriptor> repaired_vertices; ///< of the boundary or features, whose quadrants were changed
  std::vector<face_descriptor> flipped_faces;       ///< what untangling could not help
  std::vector<face_descriptor> flat_faces; ///< of these: all corners on one straight boundary or feature chain, which
                                           ///< every aligned map flattens; split the chain's chords and try again
  std::vector<vertex_descriptor> misturned_vertices; ///< covered more than once by a map without flipped faces
};

/// Computes a map (u, v) of a planar mesh whose gradients are as near as possible to the given (du, dv), which is
/// seamless, aligned with all boundary and constrained edges, and exact: across every edge the coordinates agree up to
/// k quarter turns and a translation, and one coordinate is constant along each boundary or constrained edge, both bit
/// for bit in doubles. All coordinates are multiples of one power of two with at most 45 bits, so that sums of up to
/// 256 of them are exact too.
///
/// \tparam Solver model of `SparseCholeskySolver`
/// \param mesh a model of `FaceListGraph` and `HalfedgeGraph` with triangles oriented counterclockwise; any number of
///   components, holes and handles
/// \param points readable property map, vertex -> point with `x()` and `y()`
/// \param gradients readable property map, face -> pair of vectors (du, dv) with `x()` and `y()`, right-handed,
///   orthogonal or not, each face's pair known up to quarter turns
/// \param constrained readable property map, edge -> bool: feature edges to align with; boundary edges always are
/// \param uv writable property map, halfedge -> point constructible from two doubles: the value of `h` is that of the
///   corner at `target(h, mesh)` in `face(h, mesh)`
/// \return the figures, singularities, seams and what is left flipped, as data
/// \throws Invalid_input_error if the mesh is not an oriented triangle manifold, or a triangle or pair is degenerate
/// \throws No_result_error if some vertex would have no quadrant (naming it), or the indices do not add up
/// Complexity: near-linear but for one sparse Cholesky factorisation, O(n^1.5).
/// Sources: Bommes et al. 2009; Mandad and Campen 2019 (exactness); Garanzha et al. 2021 (untangling).
template <class Solver = Cholesky_solver, class TriangleMesh, class VertexPointMap, class FaceGradientMap,
          class EdgeConstrainedMap, class CornerUvMap>
Seamless_map<TriangleMesh> seamless_parametrization(const TriangleMesh& mesh, VertexPointMap points,
                                                    FaceGradientMap gradients, EdgeConstrainedMap constrained,
                                                    CornerUvMap uv,
                                                    const Seamless_parametrization_options& options = {});

/// The same on any surface: `Traits`, a model of `TangentPlaneTraits`, knows its faces' tangent bases, in which the
/// `gradients` are given.
template <class Solver = Cholesky_solver, class TriangleMesh, class Traits, class FaceGradientMap,
          class EdgeConstrainedMap, class CornerUvMap>
Seamless_map<TriangleMesh> seamless_parametrization_with_traits(const TriangleMesh& mesh, const Traits& traits,
                                                                FaceGradientMap gradients,
                                                                EdgeConstrainedMap constrained, CornerUvMap uv,
                                                                const Seamless_parametrization_options& options = {});

} // namespace Quadrille

#include <Quadrille/Seamless_parametrization/internal/seamless_parametrization_impl.h>

#endif
