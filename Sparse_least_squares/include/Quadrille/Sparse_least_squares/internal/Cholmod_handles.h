// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_CHOLMOD_HANDLES_H
#define QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_CHOLMOD_HANDLES_H

#include <Quadrille/exceptions.h>

#include <cholmod.h>

#include <cstddef>
#include <memory>
#include <string>

namespace Quadrille {
namespace internal {

struct Cholmod_common : cholmod_common {
  Cholmod_common()
  {
    cholmod_start(this);
    print = 0; // an indefinite matrix is a normal answer, no reason to write on standard output
    quick_return_if_not_posdef = 1;
  }
  Cholmod_common(const Cholmod_common&) = delete;
  Cholmod_common& operator=(const Cholmod_common&) = delete;
  ~Cholmod_common() { cholmod_finish(this); }
};

struct Free_cholmod_object {
  void operator()(cholmod_factor* factor) const
  {
    Cholmod_common common;
    cholmod_free_factor(&factor, &common);
  }
  void operator()(cholmod_dense* dense) const
  {
    Cholmod_common common;
    cholmod_free_dense(&dense, &common);
  }
};
using Cholmod_factor = std::unique_ptr<cholmod_factor, Free_cholmod_object>;

/// CHOLMOD's view of a sorted lower triangle. Without `values` it is a pattern.
inline cholmod_sparse lower_triangle(std::size_t n, const int* outer, const int* inner, const double* values)
{
  cholmod_sparse a{};
  a.nrow = a.ncol = n;
  a.nzmax = std::size_t(outer[n]);
  // CHOLMOD's functions for factorisations only read them.
  a.p = const_cast<int*>(outer);
  a.i = const_cast<int*>(inner);
  a.x = const_cast<double*>(values);
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = 1;
  a.packed = 1;
  return a;
}

inline void check_analysis(const Cholmod_factor& factor, std::size_t n)
{
  if (!factor)
    throw Error("CHOLMOD cannot analyse a matrix with " + std::to_string(n) +
                " rows; most likely there is too little memory");
}

} // namespace internal
} // namespace Quadrille

#endif
