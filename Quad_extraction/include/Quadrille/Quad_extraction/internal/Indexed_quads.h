// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_INDEXED_QUADS_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_INDEXED_QUADS_H

#include <Quadrille/Quad_extraction/internal/Polyline_curve.h>

#include <array>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// A quad mesh in the plane or in space as index arrays, with what smoothing and output need to know about it.
template <int D> struct Indexed_quads {
  using Point = Eigen::Matrix<double, D, 1>;

  struct Vertex {
    int input_vertex = -1; ///< the triangulation's vertex that it must stay at, or -1
    int chain = -1;        ///< the curve that it slides on, or -1
    double position = 0;   ///< arc length on that curve
    int quadrants = 4;     ///< right angles around it in the map
    int face = -1;         ///< if it is not constrained: triangle at or near it
    bool border = false;
    bool constrained = false;
  };
  struct Curve_edge {
    int source;
    int target;
    int curve;
    bool border;
  };

  std::vector<Point> points;
  std::vector<Vertex> vertices;
  std::vector<std::array<int, 4>> quads; ///< counterclockwise
  std::vector<int> region;               ///< by quad
  std::vector<int> patch;                ///< by quad: of the layout
  std::vector<int> face;                 ///< by quad: triangle at or near its centre
  /// By quad: wanted lengths of its sides 0 and 2, and of its sides 1 and 3.
  std::vector<std::array<double, 2>> target;
  std::vector<Curve_edge> curve_edges;
  std::vector<Polyline_curve<D>> curves; ///< by chain
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
