// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Writes random polygons with holes and element sizes as .geo files, for run_planar_domains.py:
//   write_random_polygons FOLDER COUNT [FIRST_SEED]

#include "random_polygons.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

int main(int argc, char** argv)
{
  if (argc < 3) {
    std::cerr << "usage: " << argv[0] << " FOLDER COUNT [FIRST_SEED]\n";
    return 2;
  }
  const std::filesystem::path folder(argv[1]);
  std::filesystem::create_directories(folder);
  const long count = std::atol(argv[2]), first = argc > 3 ? std::atol(argv[3]) : 1;
  for (long seed = first; seed < first + count; ++seed) {
    const std::string digits = std::to_string(seed);
    const std::string padding(digits.size() < 5 ? 5 - digits.size() : 0, '0');
    std::ofstream file(folder / ("polygon_" + padding + digits + ".geo"));
    file << Quadrille::test::Random_polygon(std::uint32_t(seed)).geo();
    if (!file.flush()) {
      std::cerr << "cannot write to " << folder << '\n';
      return 1;
    }
  }
  return 0;
}
