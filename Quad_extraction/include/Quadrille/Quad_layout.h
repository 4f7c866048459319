// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_LAYOUT_H
#define QUADRILLE_QUAD_LAYOUT_H

#include <array>
#include <cstddef>
#include <vector>

namespace Quadrille {

/// Which isolines cut a domain into patches.
enum class Layout_kind {
  base_complex, ///< separatrices run to their natural ends; every side of a patch is one arc
  t_mesh        ///< separatrices grow at one speed and stop where they meet another one or a curve; see `Quad_layout`
};

/// A decomposition of a triangulated domain into quadrilateral patches by isolines of a seamless map, the curves of
/// the domain included: what a quantizer assigns integer lengths to, and what quads are made of.
///
/// All indices are plain integers. *Half-arc* `2 a` is arc `a` from its source to its target and `2 a + 1` the same
/// reversed; a patch lies on the left of its half-arcs. Lengths are differences of map coordinates (one unit is one
/// quad), exact in doubles: opposite sides of a patch have equal lengths. In a T-mesh a side may consist of several
/// arcs: where a separatrix ends on it from the other side, there is a node within it.
struct Quad_layout {
  /// A point in a triangle: (1 - b1 - b2) p0 + b1 p1 + b2 p2 for the triangle's corners p0, p1, p2.
  struct Mesh_point {
    int face = -1;
    double b1 = 0;
    double b2 = 0;
  };

  struct Node {
    Mesh_point point;
    int vertex = -1;          ///< of the triangulation, or -1
    int quadrants = 4;        ///< right angles around it: the valence of an interior node
    bool border = false;      ///< on the border of the domain
    bool constrained = false; ///< on the border or on a feature curve
    bool critical = false;    ///< singularity, corner, end or junction of curves: never merged with another one
  };

  /// Where half-arc `2 a` passes, and the chart in which its part up to the next point is an isoline.
  struct Arc_point {
    Mesh_point point;
    double position = 0; ///< map length from the source
    int face = -1;       ///< triangle of the part that starts here; for a curve, the one on the left
    int halfedge = -1;   ///< of the triangulation, along a curve; -1 for a separatrix
    int direction = 0;   ///< of the isoline in that triangle's chart: 0 = +u, 1 = +v, 2 = -u, 3 = -v
    double level = 0;    ///< its constant coordinate, taken along direction + 1
    double offset = 0;   ///< position minus the coordinate along the direction
  };

  struct Arc {
    int source = -1; ///< node
    int target = -1; ///< node
    double length = 0;
    int curve = -1; ///< id of the domain's curve that it lies on, or -1
    bool border = false;
    std::vector<Arc_point> points; ///< from source to target, both included
  };

  struct Patch {
    std::array<std::vector<int>, 4> sides; ///< half-arcs, counterclockwise
    int region = 0;
  };

  /// A band of constant width across patches, from the border to the border or closed. All arcs' lengths are sums of
  /// the widths of the strips that cross them; so any integer widths give lengths that agree on opposite sides. In a
  /// base complex every arc is crossed by one strip, and strips are what one can choose independently.
  struct Strip {
    double length = 0;
    std::vector<int> arcs;                   ///< that it crosses, one as often as it does (at most twice)
    std::vector<std::array<int, 2>> patches; ///< patch and 0 or 1: it runs between the sides `i` and `i + 2`
  };

  Layout_kind kind = Layout_kind::base_complex;
  std::vector<Node> nodes;
  std::vector<Arc> arcs;
  std::vector<Patch> patches;
  std::vector<Strip> strips;
  std::vector<int> left_patch;                ///< by half-arc, -1 outside the domain
  std::vector<std::vector<int>> separatrices; ///< their half-arcs in order, each arc without a curve in exactly one
  /// Chains of half-arcs along the domain's curves between critical nodes, each arc with a curve in exactly one.
  /// A closed chain (source node of the first = target node of the last) of a loop without critical nodes is marked.
  struct Curve_chain {
    std::vector<int> half_arcs;
    bool loop = false; ///< closed and without a critical node
  };
  std::vector<Curve_chain> chains;

  int source(int half_arc) const
  {
    const Arc& arc = arcs[std::size_t(half_arc / 2)];
    return half_arc % 2 ? arc.target : arc.source;
  }
  int target(int half_arc) const { return source(half_arc ^ 1); }
  const Arc& arc_of(int half_arc) const { return arcs[std::size_t(half_arc / 2)]; }
};

} // namespace Quadrille

#endif
