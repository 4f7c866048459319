// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_QUANTIZER_OPTION_H
#define QUADRILLE_TOOLS_QUANTIZER_OPTION_H

#include <Quadrille/Greedy_quantizer.h>
#include <Quadrille/Optimal_quantizer.h>

namespace Quadrille {

/// `--quantizer`.
enum class Quantizer_kind { greedy, optimal };

/// The optimal one where it is built in.
inline Quantizer_kind default_quantizer()
{
  return Optimal_quantizer::is_available() ? Quantizer_kind::optimal : Quantizer_kind::greedy;
}

/// A `Quantizer` that is chosen at run time.
class Chosen_quantizer {
public:
  /// `options`: of the optimal one.
  explicit Chosen_quantizer(Quantizer_kind kind, const Optimal_quantizer::Options& options = {})
      : m_kind(kind), m_options(options)
  {
  }

  Quantization operator()(const Quad_layout& layout, Length_constraints& constraints) const
  {
    if (m_kind == Quantizer_kind::greedy)
      return Greedy_quantizer()(layout, constraints);
    return Optimal_quantizer(m_options)(layout, constraints);
  }

private:
  Quantizer_kind m_kind;
  Optimal_quantizer::Options m_options;
};

} // namespace Quadrille

#endif
