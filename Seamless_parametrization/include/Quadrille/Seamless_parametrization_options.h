// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_OPTIONS_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_OPTIONS_H

namespace Quadrille {

/// Options of `seamless_parametrization`.
struct Seamless_parametrization_options {
  bool untangle = true;           ///< unfold flipped triangles, if there are any
  int max_untangling_rounds = 80; ///< each is a few Levenberg-Marquardt steps with one regularisation
  bool repair_corners = true;     ///< move a quadrant to corners that the frames leave without one; else throw
  int threads = 1;                ///< 0: all cores. The result does not depend on it
};

} // namespace Quadrille

#endif
