// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_GREEDY_QUANTIZER_H
#define QUADRILLE_GREEDY_QUANTIZER_H

#include <Quadrille/Quad_extraction/internal/Greedy_quantization.h>
#include <Quadrille/Quad_layout.h>
#include <Quadrille/Strip_constraints.h>

#include <string>
#include <vector>

namespace Quadrille {

/// Rounds the strips' lengths to integers one after another, cheapest first, and hands the area that each rounding
/// loses or gains to the patches beside it. Model of `Quantizer`.
///
/// After Algorithm 2 of Couplet, Chemin and Remacle, "Size-Controlled Quadrilateral Meshing using Integrable Odeco
/// Fields", with three changes:
/// area is handed on to the nearest patches whose length is still open (the paper: to the direct neighbours), it does
/// not cross the domain's curves, and `Strip_constraints` forbids collapses that would damage the topology.
/// Complexity: about the number of patches times the logarithm of the number of strips; a little more if strips are
/// handed on over many fixed ones.
class Greedy_quantizer {
public:
  std::string name() const { return "greedy"; }

  /// Returns the length of each strip.
  std::vector<int> operator()(const Quad_layout& layout, Strip_constraints& constraints) const
  {
    return internal::extraction::Greedy_quantization(layout, constraints).run();
  }
};

} // namespace Quadrille

#endif
