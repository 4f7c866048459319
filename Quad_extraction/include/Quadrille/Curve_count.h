// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_CURVE_COUNT_H
#define QUADRILLE_CURVE_COUNT_H

#include <string>
#include <vector>

namespace Quadrille {

/// A number of elements asked for: on the given curves together there shall be exactly `count` edges.
struct Curve_count {
  std::vector<int> curves; ///< ids
  int count = 0;
  std::string name; ///< for messages; empty: the ids
};

} // namespace Quadrille

#endif
