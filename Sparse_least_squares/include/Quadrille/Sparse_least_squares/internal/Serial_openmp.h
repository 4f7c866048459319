// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_SERIAL_OPENMP_H
#define QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_SERIAL_OPENMP_H

#if defined(__GNUC__) && defined(__ELF__)
// Weak: they are there if and only if something in the process, such as CHOLMOD, brought an OpenMP runtime.
extern "C" int omp_get_max_active_levels() __attribute__((weak));
extern "C" void omp_set_max_active_levels(int) __attribute__((weak));
#endif

namespace Quadrille {
namespace internal {

/// While it lives, OpenMP regions entered by this thread run on this thread alone. CHOLMOD opens one for every few
/// columns, whose waiting threads cost more than they do, above all when several solvers run at once.
class Serial_openmp {
public:
  Serial_openmp(const Serial_openmp&) = delete;
  Serial_openmp& operator=(const Serial_openmp&) = delete;
#if defined(__GNUC__) && defined(__ELF__)
  Serial_openmp()
  {
    if (omp_get_max_active_levels && omp_set_max_active_levels) {
      m_levels = omp_get_max_active_levels();
      omp_set_max_active_levels(0);
    }
  }
  ~Serial_openmp()
  {
    if (m_levels >= 0)
      omp_set_max_active_levels(m_levels);
  }

private:
  int m_levels = -1;
#else
  Serial_openmp() {}
  ~Serial_openmp() {}
#endif
};

} // namespace internal
} // namespace Quadrille

#endif
