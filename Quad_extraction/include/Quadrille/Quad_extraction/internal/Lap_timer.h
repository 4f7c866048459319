// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_LAP_TIMER_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_LAP_TIMER_H

#include <chrono>

namespace Quadrille {
namespace internal::extraction {

/// Seconds since the last question.
class Lap_timer {
public:
  double lap()
  {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - m_start).count();
    m_start = now;
    return seconds;
  }

  /// Seconds since the last lap, which goes on.
  double passed() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count(); }

private:
  std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
