// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_OPTIONS_H
#define QUADRILLE_QUAD_EXTRACTION_OPTIONS_H

#include <Quadrille/Curve_count.h>
#include <Quadrille/Map_displacement.h>
#include <Quadrille/Progress_observer.h>
#include <Quadrille/Quad_layout.h>
#include <Quadrille/Quad_smoothing_options.h>
#include <Quadrille/Quantization.h>

#include <array>
#include <cstddef>
#include <map>
#include <vector>

namespace Quadrille {

struct Quad_extraction_options {
  bool smooth = true;                       ///< false: leave the quads where the map puts them; they may be inverted
  Layout_kind layout = Layout_kind::t_mesh; ///< by which isolines the domain is cut into patches
  std::vector<Curve_count> counts;          ///< numbers of elements on curves, to be met exactly
  /// Quads wanted in all: lengths are scaled by a common factor until there are as many, to 2 percent where whole
  /// numbers, `counts` and small details allow it; 0: as many as the map has units.
  std::size_t quads = 0;
  bool measure_gap = true;          ///< bound the cost of the best lengths if the quantizer does not (takes some time)
  int min_loop_edges = 4;           ///< least number of edges on every border loop and closed feature
  double kink_degrees = 50;         ///< vertices where a curve turns by more than this become vertices of the quads
  std::size_t max_quads = 20000000; ///< more are refused
  std::size_t max_trace_steps = 0;  ///< triangles that a separatrix may cross; 0: 4 times their number + 1000
  int max_refinements = 6;          ///< times that patches too coarse for the domain get more quads before giving up
  bool displacements = false;       ///< tell what makes an integer-grid map of the seamless one
  int threads = 1;                  ///< 0: all cores; the result does not depend on it
  Quad_smoothing_options smoothing; ///< its threads and observer are replaced by those here
  const Progress_observer* observer = nullptr; ///< stages "layout", "quantization", "mesh"
};

/// What an extraction made. Vertices and quads are numbered in the order in which they were added to the quad mesh;
/// `input_vertex` counts the triangulation's vertices in the order of `vertices(mesh)`.
struct Quad_extraction_result {
  struct Vertex_origin {
    int input_vertex; ///< of the triangulation: a corner, an end or a junction of curves; or -1
    int curve;        ///< that the vertex lies on (not its ends: those are input vertices), or -1
  };
  struct Curve_edge {
    int source; ///< vertices, in the curve's direction; border edges have the domain on their left
    int target;
    int curve;
    bool border; ///< false: on a feature inside the domain
  };

  std::vector<Vertex_origin> vertices;
  std::vector<Curve_edge> curve_edges; ///< every edge on the border or on a feature, once
  std::vector<int> quad_regions;

  std::map<int, int> irregular_vertices; ///< valence -> number, interior vertices of valence other than 4

  Quad_layout layout;
  std::vector<std::vector<std::array<double, 3>>> arc_polylines; ///< by arc of the layout; z = 0 in the plane
  Quantization quantization;                                     ///< integer lengths of the layout's arcs
  int refinements = 0;                                           ///< see `max_refinements`
  int collapsed_arcs = 0;                                        ///< arcs of length 0
  double scale = 1; ///< of the map's lengths, for `Quad_extraction_options::quads`
  /// Between critical nodes and curves, in numbers of elements, if asked for: what `integer_grid_map()` needs.
  std::vector<Map_displacement> displacements;
  double area_change_relative =
      0; ///< (sum of the patches' integer areas) / (sum of their map areas times `scale`^2) - 1

  Quad_smoothing_report smoothing;
  double layout_seconds = 0; ///< reading and checking the map included
  double quantization_seconds = 0;
  double mesh_seconds = 0; ///< grids, smoothing and checks
};

} // namespace Quadrille

#endif
