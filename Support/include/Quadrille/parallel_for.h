// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_PARALLEL_FOR_H
#define QUADRILLE_PARALLEL_FOR_H

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace Quadrille {

/// Calls `body(i)` for every `i` in [0, n) on at most `threads` threads (0: all cores).
///
/// The order of the calls is unspecified, so `body(i)` may write only to what belongs to `i`: then the result does not
/// depend on the number of threads. Ranges below `grain` run on the calling thread.
template <class Body> void parallel_for(std::size_t n, int threads, const Body& body, std::size_t grain = 512)
{
  if (threads == 1 || n <= grain) {
    for (std::size_t i = 0; i < n; ++i)
      body(i);
    return;
  }
  // More threads than cores would only make TBB print a warning.
  const int cores = tbb::this_task_arena::max_concurrency();
  tbb::task_arena arena(threads > 0 ? std::min(threads, cores) : cores);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain), [&](const tbb::blocked_range<std::size_t>& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i)
        body(i);
    });
  });
}

} // namespace Quadrille

#endif
