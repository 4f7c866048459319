// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SUPPORT_INTERNAL_PARALLEL_SUM_H
#define QUADRILLE_SUPPORT_INTERNAL_PARALLEL_SUM_H

#include <Quadrille/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace Quadrille {
namespace internal {

/// The sum of `term(i)` over i in [0, n): added up within blocks of fixed size first, so that rounding and therefore
/// the result is the same for every number of threads. `term` may also write what belongs to `i`.
template <class Term> double parallel_sum(std::size_t n, int threads, const Term& term)
{
  constexpr std::size_t block = 2048;
  std::vector<double> partial((n + block - 1) / block);
  parallel_for(
      partial.size(), threads,
      [&](std::size_t b) {
        double sum = 0;
        for (std::size_t i = b * block; i < std::min(n, (b + 1) * block); ++i)
          sum += term(i);
        partial[b] = sum;
      },
      1);
  double sum = 0;
  for (const double part : partial)
    sum += part;
  return sum;
}

} // namespace internal
} // namespace Quadrille

#endif
