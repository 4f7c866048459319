// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SUPPORT_INTERNAL_TUPLE_H
#define QUADRILLE_SUPPORT_INTERNAL_TUPLE_H

namespace Quadrille {
namespace internal {

/// N values of a scalar type (or N rows) for formulas over `Pack`, whose arithmetic Eigen's vectors would not inline.
template <class S, int N> struct Tuple {
  S values[N];

  const S& operator[](int i) const { return values[i]; }
  S& operator[](int i) { return values[i]; }
};

template <class S, int N> [[gnu::always_inline]] inline S dot(const Tuple<S, N>& a, const Tuple<S, N>& b)
{
  S sum = a[0] * b[0];
  for (int i = 1; i < N; ++i)
    sum += a[i] * b[i];
  return sum;
}

/// a += factor b
template <class S, class Factor, int N>
[[gnu::always_inline]] inline void add_scaled(Tuple<S, N>& a, const Factor& factor, const Tuple<S, N>& b)
{
  for (int i = 0; i < N; ++i)
    a[i] += factor * b[i];
}

template <class S, int N> [[gnu::always_inline]] inline Tuple<S, N> scaled(const S& factor, Tuple<S, N> a)
{
  for (int i = 0; i < N; ++i)
    a[i] = factor * a[i];
  return a;
}

} // namespace internal
} // namespace Quadrille

#endif
