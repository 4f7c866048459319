// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_SMOOTHING_OPTIONS_H
#define QUADRILLE_QUAD_SMOOTHING_OPTIONS_H

#include <Quadrille/Progress_observer.h>

namespace Quadrille {

/// How quads are untangled and smoothed.
struct Quad_smoothing_options {
  double size_weight = 0.3;        ///< theta: weight of the quads' sizes against their shapes, > 0
  double angle_weight = 3;         ///< omega: weight of right angles against aspect ratios, >= 0
  int max_iterations = 60;         ///< Levenberg-Marquardt steps once all corners are positive
  double relative_decrease = 1e-5; ///< stop when a step lowers the energy by less than this fraction of it
  int surface_rounds = 12;         ///< on surfaces: times that vertices are put back after steps in tangent planes
  int surface_iterations = 6;      ///< steps between; `max_iterations` is for the plane
  int untangling_rounds = 40;      ///< reductions of the regularisation while there are inverted corners
  int untangling_iterations = 10;  ///< steps per reduction
  int max_untangling_rings = 12;   ///< so far from inverted quads vertices may move to make room for them
  int threads = 1;                 ///< 0: all cores; the result does not depend on it
  const Progress_observer* observer = nullptr;
};

/// What a smoothing did.
struct Quad_smoothing_report {
  int iterations = 0;            ///< steps with all corners positive
  int untangling_iterations = 0; ///< steps before
  double energy = 0;             ///< sum over the quads of the mean corner energy; 0 if all have their target shapes
  int unprojected_vertices =
      0;                  ///< vertices that the projector would have moved into an inverted quad; left on the polyline
  int inverted_quads = 0; ///< with a corner that is not strictly convex
  double seconds = 0;
};

} // namespace Quadrille

#endif
