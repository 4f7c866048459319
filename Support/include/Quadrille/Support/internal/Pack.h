// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SUPPORT_INTERNAL_PACK_H
#define QUADRILLE_SUPPORT_INTERNAL_PACK_H

#include <cmath>
#include <type_traits>

namespace Quadrille {
namespace internal {

#if defined(__AVX__) || defined(QUADRILLE_AVX) // see QuadrilleExecutables.cmake
inline namespace wide {                        // code for other processors must not be mixed with this

/// Four numbers that are computed with at once, so that formulas written for a scalar type do four elements in the
/// vector registers. It computes each number as `double` does. A vector type of GCC and Clang.
class Pack {
  using Vector = double __attribute__((vector_size(32)));

public:
  static constexpr int size = 4;

  Pack() = default;
  Pack(double s) : m_values{s, s, s, s} {}
  Pack(double a, double b, double c, double d) : m_values{a, b, c, d} {}

  double lane(int i) const { return m_values[i]; }

  [[gnu::always_inline]] friend inline Pack operator+(const Pack& a, const Pack& b)
  {
    return Pack(a.m_values + b.m_values);
  }
  [[gnu::always_inline]] friend inline Pack operator-(const Pack& a, const Pack& b)
  {
    return Pack(a.m_values - b.m_values);
  }
  [[gnu::always_inline]] friend inline Pack operator*(const Pack& a, const Pack& b)
  {
    return Pack(a.m_values * b.m_values);
  }
  [[gnu::always_inline]] friend inline Pack operator/(const Pack& a, const Pack& b)
  {
    return Pack(a.m_values / b.m_values);
  }
  [[gnu::always_inline]] friend inline Pack operator-(const Pack& a) { return Pack(-a.m_values); }
  [[gnu::always_inline]] Pack& operator+=(const Pack& b)
  {
    m_values += b.m_values;
    return *this;
  }

private:
  explicit Pack(Vector values) : m_values(values) {}

  Vector m_values;
};

} // namespace wide
#else
/// As above, in halves that fit the registers of every 64-bit processor.
class Pack {
  using Half = double __attribute__((vector_size(16)));

public:
  static constexpr int size = 4;

  Pack() = default;
  Pack(double s) : m_low{s, s}, m_high{s, s} {}
  Pack(double a, double b, double c, double d) : m_low{a, b}, m_high{c, d} {}

  double lane(int i) const { return i < 2 ? m_low[i] : m_high[i - 2]; }

  [[gnu::always_inline]] friend inline Pack operator+(const Pack& a, const Pack& b)
  {
    return {a.m_low + b.m_low, a.m_high + b.m_high};
  }
  [[gnu::always_inline]] friend inline Pack operator-(const Pack& a, const Pack& b)
  {
    return {a.m_low - b.m_low, a.m_high - b.m_high};
  }
  [[gnu::always_inline]] friend inline Pack operator*(const Pack& a, const Pack& b)
  {
    return {a.m_low * b.m_low, a.m_high * b.m_high};
  }
  [[gnu::always_inline]] friend inline Pack operator/(const Pack& a, const Pack& b)
  {
    return {a.m_low / b.m_low, a.m_high / b.m_high};
  }
  [[gnu::always_inline]] friend inline Pack operator-(const Pack& a) { return {-a.m_low, -a.m_high}; }
  [[gnu::always_inline]] Pack& operator+=(const Pack& b)
  {
    m_low += b.m_low;
    m_high += b.m_high;
    return *this;
  }

private:
  Pack(Half low, Half high) : m_low(low), m_high(high) {}

  Half m_low, m_high;
};
#endif

/// A scalar, or a pack, of `value(lane)`.
template <class S, class Value> [[gnu::always_inline]] inline S from_lanes(const Value& value)
{
  if constexpr (std::is_same_v<S, Pack>)
    return {value(0), value(1), value(2), value(3)};
  else
    return value(0);
}

inline double logarithm(double x) { return std::log(x); }
inline Pack logarithm(const Pack& x)
{
  return from_lanes<Pack>([&](int i) { return std::log(x.lane(i)); });
}
inline double exponential(double x) { return std::exp(x); }
inline Pack exponential(const Pack& x)
{
  return from_lanes<Pack>([&](int i) { return std::exp(x.lane(i)); });
}
inline double square_root(double x) { return std::sqrt(x); }
inline Pack square_root(const Pack& x)
{
  return from_lanes<Pack>([&](int i) { return std::sqrt(x.lane(i)); });
}

inline bool all_positive(double x) { return x > 0; }
inline bool all_positive(const Pack& x) { return x.lane(0) > 0 && x.lane(1) > 0 && x.lane(2) > 0 && x.lane(3) > 0; }

} // namespace internal
} // namespace Quadrille

#endif
