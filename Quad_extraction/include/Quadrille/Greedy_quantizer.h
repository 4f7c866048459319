// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_GREEDY_QUANTIZER_H
#define QUADRILLE_GREEDY_QUANTIZER_H

#include <Quadrille/Length_constraints.h>
#include <Quadrille/Quad_extraction/internal/Greedy_quantization.h>
#include <Quadrille/Quad_layout.h>
#include <Quadrille/Quantization.h>
#include <Quadrille/exceptions.h>

#include <string>
#include <vector>

namespace Quadrille {

/// Rounds the strips' widths to integers one after another, cheapest first, and hands the area that each rounding
/// loses or gains to the patches beside it. Model of `Quantizer`.
///
/// After Algorithm 2 of Couplet, Chemin and Remacle, "Size-Controlled Quadrilateral Meshing using Integrable Odeco
/// Fields", with five changes: strips may be parts of a patch, as in a T-mesh; area is handed on to the nearest patches
/// whose width is still open (the paper: to the direct neighbours); it does not cross the domain's curves; collapses
/// that would damage the topology are forbidden: when conditions turn out to be violated, the rounding is repeated; and
/// which strips have to stay for these conditions is decided beforehand (`Strip_floors`). Requested counts are met as
/// long as the strips that are fixed last leave room for it; `Optimal_quantizer` always finds lengths if there are any.
/// Complexity: about the number of patches times the logarithm of the number of strips, times the repetitions.
class Greedy_quantizer {
public:
  /// \throws No_result_error("quantization", ...) if requested counts are not met.
  Quantization operator()(const Quad_layout& layout, Length_constraints& constraints) const
  {
    Quantization result;
    result.method = "greedy";
    while (true) {
      const std::vector<int> width = internal::extraction::Greedy_quantization(layout, constraints).run();
      result.lengths.assign(layout.arcs.size(), 0);
      for (std::size_t s = 0; s < layout.strips.size(); ++s)
        for (const int a : layout.strips[s].arcs)
          result.lengths[std::size_t(a)] += width[s];
      const std::size_t known = constraints.sums().size();
      if (constraints.learn(result.lengths))
        return result;
      if (constraints.sums().size() == known)
        throw No_result_error("quantization", missed(constraints, result.lengths));
      ++result.repetitions;
    }
  }

private:
  static std::string missed(const Length_constraints& constraints, const std::vector<int>& lengths)
  {
    std::string text;
    for (const Length_constraints::Sum& sum : constraints.sums()) {
      const long long value = internal::extraction::sum_of(sum.arcs, lengths);
      if (sum.request < 0 || value == sum.least)
        continue;
      text += (text.empty() ? "" : ", ") + std::to_string(value) + " elements on " +
              internal::extraction::name_of(constraints.counts()[std::size_t(sum.request)]) + " instead of the " +
              std::to_string(sum.least) + " that are asked for";
    }
    return text.empty() ? "greedy rounding meets a dead end"
                        : "greedy rounding leads to " + text + "; the optimal quantizer may find a way";
  }
};

} // namespace Quadrille

#endif
