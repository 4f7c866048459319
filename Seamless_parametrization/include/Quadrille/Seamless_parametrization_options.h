// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_OPTIONS_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_OPTIONS_H

namespace Quadrille {

/// Options of `seamless_parametrization`.
struct Seamless_parametrization_options {
  bool untangle = true; ///< unfold flipped triangles, if there are any
  /// Each is a few Levenberg-Marquardt steps with one regularisation. Counted anew for each of three growing
  /// neighbourhoods of what is folded, and for the whole map
  int max_untangling_rounds = 80;
  /// Change matchings near boundary and feature vertices where the frames turn by no quadrant (which otherwise throws),
  /// or by a number that the angle of the domain contradicts (by more than 75 degrees, 108 at ends of feature lines).
  bool repair_corners = true;
  /// Move singularities of five quadrants and more to where a map with these sizes has them, if it is not valid
  /// otherwise (it turns around them by four quadrants less, and twice around a regular vertex nearby).
  bool move_singularities = true;
  int threads = 1; ///< 0: all cores. The result does not depend on it
};

} // namespace Quadrille

#endif
