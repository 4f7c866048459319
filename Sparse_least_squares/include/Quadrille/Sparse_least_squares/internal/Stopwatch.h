// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_STOPWATCH_H
#define QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_STOPWATCH_H

#include <chrono>

namespace Quadrille {
namespace internal {

class Stopwatch {
public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count(); }

private:
  std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
};

} // namespace internal
} // namespace Quadrille

#endif
