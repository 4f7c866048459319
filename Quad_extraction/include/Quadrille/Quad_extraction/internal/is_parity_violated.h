// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_IS_PARITY_VIOLATED_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_IS_PARITY_VIOLATED_H

#include <Quadrille/Quad_extraction/internal/Integer_program.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Do the program's equations between integers contradict each other modulo 2? Branching would never find that out,
/// because lengths are not bounded. By elimination with sparse rows.
inline bool is_parity_violated(const Integer_program& program)
{
  const auto is_odd = [](double x) { return std::fmod(std::abs(x), 2.0) == 1.0; };
  const int one = static_cast<int>(program.columns.size()); // stands for the right-hand side
  std::map<int, std::vector<int>> rows;                     // by first odd column: the odd columns, sorted
  for (const Integer_program::Row& row : program.rows) {
    const bool is_equation =
        row.low == row.high && std::all_of(row.entries.begin(), row.entries.end(), [&](const auto& entry) {
          return program.columns[std::size_t(entry.first)].integer;
        });
    if (!is_equation)
      continue;
    std::vector<int> odd;
    for (const auto& [column, coefficient] : row.entries)
      if (is_odd(coefficient))
        odd.push_back(column);
    std::sort(odd.begin(), odd.end());
    if (is_odd(row.low))
      odd.push_back(one);
    while (!odd.empty() && odd.front() != one) {
      const auto [place, is_new] = rows.emplace(odd.front(), odd);
      if (is_new)
        break;
      std::vector<int> sum;
      std::set_symmetric_difference(odd.begin(), odd.end(), place->second.begin(), place->second.end(),
                                    std::back_inserter(sum));
      odd = std::move(sum);
    }
    if (!odd.empty() && odd.front() == one)
      return true;
  }
  return false;
}

} // namespace internal::extraction
} // namespace Quadrille

#endif
