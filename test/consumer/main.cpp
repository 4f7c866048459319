// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/exceptions.h>
#include <Quadrille/parallel_for.h>

#include <vector>

int main()
{
  std::vector<int> squares(1000);
  Quadrille::parallel_for(squares.size(), 2, [&](std::size_t i) { squares[i] = int(i * i); });
  try {
    throw Quadrille::No_result_error("map", "nothing to do");
  } catch (const Quadrille::Error&) {
    return squares[31] == 961 ? 0 : 1;
  }
}
