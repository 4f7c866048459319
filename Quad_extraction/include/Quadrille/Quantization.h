// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUANTIZATION_H
#define QUADRILLE_QUANTIZATION_H

#include <limits>
#include <string>
#include <vector>

namespace Quadrille {

/// What a `Quantizer` returns: integer lengths of a layout's arcs, and how it came to them.
struct Quantization {
  std::vector<int> lengths; ///< by arc
  std::string method;
  int repetitions = 0; ///< times that it started again because something would have been merged that must stay apart
  /// No admissible lengths have a lower cost (see `deviation`); -infinity: not known.
  double lower_bound = -std::numeric_limits<double>::infinity();
  double work = 0;  ///< of a search for the best ones, as `Optimal_quantizer::Options::work_limit` counts it
  std::string note; ///< for the user, if something did not go as wanted, such as a limit; otherwise empty

  /// Set by `extract_quads`: root of the mean square of the relative length errors of all windows of 1, 2, 4, ... arcs
  /// along the layout's separatrices and curves, and the cost that quantizers minimise, of which it is made.
  double deviation = 0;
  double cost = 0;
  /// (cost - lower_bound) / cost; 0: no lengths are better; negative: not known.
  double optimality_gap = -1;
};

} // namespace Quadrille

#endif
