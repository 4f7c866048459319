// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_INTEGER_PROGRAM_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_INTEGER_PROGRAM_H

#include <limits>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// A linear program of which some variables are integers: minimise costs between bounds of variables and rows.
struct Integer_program {
  struct Column {
    double low;
    double high;
    double cost;
    bool integer;
  };
  struct Row {
    std::vector<std::pair<int, double>> entries; ///< column (each once) and coefficient
    double low;
    double high;
  };

  std::vector<Column> columns;
  std::vector<Row> rows;

  int add_column(const Column& column)
  {
    columns.push_back(column);
    return static_cast<int>(columns.size()) - 1;
  }
};

/// Where the search for a solution ends before the best one is known.
///
/// Work is counted in nodes of the search tree times columns of the program, the root as `root_nodes` of them, and
/// `iterations_per_node` iterations of the simplex method as one more, since they tell the cost of cuts and heuristics,
/// which cannot be known beforehand. Unlike time it is the same on every machine, and so is what is found.
struct Search_limits {
  static constexpr double root_nodes = 10;
  static constexpr double iterations_per_node = 30;

  double gap = 0; ///< how much worse than the best one a solution may be, relative to its cost
  double work = std::numeric_limits<double>::infinity();
  double seconds = std::numeric_limits<double>::infinity();
};

struct Integer_solution {
  bool infeasible = false;   ///< proven to have no solution
  bool interrupted = false;  ///< by a limit
  double work = 0;           ///< see `Search_limits`
  std::vector<double> value; ///< of the best solution found, empty if there is none
  double cost = std::numeric_limits<double>::infinity();
  double lower_bound = -std::numeric_limits<double>::infinity();
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
