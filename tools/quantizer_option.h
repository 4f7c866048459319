// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_QUANTIZER_OPTION_H
#define QUADRILLE_TOOLS_QUANTIZER_OPTION_H

#include <Quadrille/Greedy_quantizer.h>
#include <Quadrille/Optimal_quantizer.h>

#include <algorithm>
#include <chrono>

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
  /// `seconds`: limit of the optimal one for all calls together; each has at least four, as one without any improves
  /// nothing.
  explicit Chosen_quantizer(Quantizer_kind kind, double seconds = Optimal_quantizer::Options().time_limit)
      : m_kind(kind), m_seconds_left(seconds)
  {
  }

  Quantization operator()(const Quad_layout& layout, Length_constraints& constraints) const
  {
    if (m_kind == Quantizer_kind::greedy)
      return Greedy_quantizer()(layout, constraints);
    Optimal_quantizer::Options options;
    options.time_limit = std::max(4.0, m_seconds_left);
    const auto start = std::chrono::steady_clock::now();
    Quantization result = Optimal_quantizer(options)(layout, constraints);
    m_seconds_left -= std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }

private:
  Quantizer_kind m_kind;
  mutable double m_seconds_left;
};

} // namespace Quadrille

#endif
