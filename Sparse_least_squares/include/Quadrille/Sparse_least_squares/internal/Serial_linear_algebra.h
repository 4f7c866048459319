// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_SERIAL_LINEAR_ALGEBRA_H
#define QUADRILLE_SPARSE_LEAST_SQUARES_INTERNAL_SERIAL_LINEAR_ALGEBRA_H

#include <mutex>

#if defined(__GNUC__) && defined(__ELF__)
// Weak: they are there if and only if the process has an OpenMP runtime (CHOLMOD brings one) or OpenBLAS.
extern "C" int omp_get_max_active_levels() __attribute__((weak));
extern "C" void omp_set_max_active_levels(int) __attribute__((weak));
extern "C" int openblas_get_num_threads() __attribute__((weak));
extern "C" void openblas_set_num_threads(int) __attribute__((weak));
#endif

namespace Quadrille {
namespace internal {

/// While it lives, factorisations called by this thread stay on this thread, so that sums have one order on every
/// machine.
///
/// CHOLMOD opens an OpenMP region for every few columns, whose waiting threads cost more than they do, above all when
/// several solvers run at once; OpenBLAS splits large products. Both get back what they had before: OpenMP's setting
/// belongs to this thread, OpenBLAS's to the process, so there the last object restores it.
class Serial_linear_algebra {
public:
  Serial_linear_algebra(const Serial_linear_algebra&) = delete;
  Serial_linear_algebra& operator=(const Serial_linear_algebra&) = delete;

#if defined(__GNUC__) && defined(__ELF__)
  Serial_linear_algebra()
  {
    if (omp_get_max_active_levels && omp_set_max_active_levels) {
      m_openmp_levels = omp_get_max_active_levels();
      omp_set_max_active_levels(0);
    }
    if (openblas_get_num_threads && openblas_set_num_threads) {
      Blas_users& users = blas_users();
      const std::lock_guard<std::mutex> lock(users.mutex);
      if (users.count++ == 0) {
        users.threads = openblas_get_num_threads();
        if (users.threads != 1)
          openblas_set_num_threads(1);
      }
    }
  }

  ~Serial_linear_algebra()
  {
    if (m_openmp_levels >= 0)
      omp_set_max_active_levels(m_openmp_levels);
    if (openblas_get_num_threads && openblas_set_num_threads) {
      Blas_users& users = blas_users();
      const std::lock_guard<std::mutex> lock(users.mutex);
      if (--users.count == 0 && users.threads != 1)
        openblas_set_num_threads(users.threads);
    }
  }

private:
  struct Blas_users {
    std::mutex mutex;
    int count = 0;
    int threads = 1;
  };
  static Blas_users& blas_users()
  {
    static Blas_users users;
    return users;
  }

  int m_openmp_levels = -1;
#else
  Serial_linear_algebra() {}
  ~Serial_linear_algebra() {}
#endif
};

} // namespace internal
} // namespace Quadrille

#endif
