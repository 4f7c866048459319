// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SINGULAR_GRAPH_H
#define QUADRILLE_SINGULAR_GRAPH_H

#include <Quadrille/Metric_connection.h>
#include <Quadrille/Metric_field.h>

#include <Eigen/Core>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace Quadrille {

/// The curves around which a field of crosses turns, of which those inside become the irregular edges of a hexahedral
/// mesh, as curves through the tetrahedra.
struct Singular_graph {
  enum class Valence {
    three,
    five,
    six,     ///< a half turn: two of valence 5 in one
    two,     ///< a half turn the other way
    mixed,   ///< valence 3 here and 5 there (a 3-5 or zipper arc)
    compound ///< a turn by 120 degrees or about a diagonal, which is no turn about an axis of the cross
  };

  static constexpr int at_boundary = -1;

  /// A curve between two nodes or ends on the boundary; or closed.
  struct Arc {
    Valence valence;
    bool is_loop = false;
    int from = at_boundary, to = at_boundary; ///< nodes; for loops without meaning
    std::vector<Eigen::Vector3d> points;      ///< smoothed; the last of a loop is not the first again
    std::vector<int> tetrahedra;              ///< that it passes, in order
    /// Per point: the frame's axis against the curve's tangent, negative for valence 3: -1 or 1 where they are
    /// parallel, about 0 where the axis is across the curve. 0 everywhere on compound arcs.
    std::vector<double> alignment;
    double length = 0;
  };

  /// Where more than two arcs meet.
  struct Node {
    Eigen::Vector3d point;
    std::vector<int> arcs; ///< one that begins and ends here is listed twice
  };

  /// Why a hexahedral mesh cannot have this graph.
  struct Obstacle {
    int arc = -1, node = -1; ///< one of them
    std::string reason;
  };

  std::vector<Arc> arcs;
  std::vector<Node> nodes;
  std::vector<Obstacle> obstacles;
  std::size_t loops = 0, boundary_ends = 0; ///< counts
  /// Loops, and arcs from boundary to boundary, that were left out since the mesh does not resolve them.
  std::size_t unresolved_arcs = 0;
  double seconds = 0;

  /// Whether nothing that is known stands against it: the conditions are necessary, not sufficient.
  bool is_hex_meshable() const { return obstacles.empty(); }
  /// How many nodes have which degree.
  std::map<int, std::size_t> nodes_by_degree() const;
  std::size_t number_of_arcs(Valence valence) const;
};

struct Singular_graph_options {
  int threads = 0;          ///< 0: all cores; the result does not depend on it
  int smoothing_steps = 20; ///< of the curves' points towards the means of their neighbours
  /// In lengths of edges: shorter arcs between nodes are less than what the mesh resolves, and the nodes that they join
  /// are one node. Compound arcs up to three times as long are: in them nodes of degree 4 split into two of degree 3.
  double resolution = 1;
};

/// The singular graph of a field of frames at the vertices of a mesh.
///
/// A face is singular where the matchings of the frames around it do not cancel; curves lead from tetrahedron to
/// tetrahedron through singular faces, and meet in tetrahedra with three or four of them. A tetrahedron never has
/// exactly one, which is asserted. The valence is told by the sense in which the frames turn about the curve.
/// \pre as for `volumetric_cross_field()`. Time is linear in the size.
template <class TetrahedralMesh>
Singular_graph singular_graph(const TetrahedralMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                              const Singular_graph_options& options = {});

/// The same for a field under a metric.
template <class TetrahedralMesh>
Singular_graph singular_graph(const TetrahedralMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                              const Metric_field& metric, const Metric_connection& connection,
                              const Singular_graph_options& options = {});

} // namespace Quadrille

#include <Quadrille/Volumetric_cross_field/internal/Singular_graph_impl.h>

#endif
