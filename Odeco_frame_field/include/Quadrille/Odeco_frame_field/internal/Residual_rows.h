// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_RESIDUAL_ROWS_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_RESIDUAL_ROWS_H

#include <Quadrille/Odeco_frame_field/internal/Triangle_values.h>

namespace Quadrille {
namespace internal {

// What an energy's residuals on one linear triangle (one per lane of `S`) turn into. `Field_residuals` hands them over
// in groups of rows, in the order of their numbers. A group depends on the coefficients at a point, which are the mean
// of the corners' with some weights, and maybe on their slopes along x and y; its derivatives are by these, and what
// follows for the coefficients of the corners is left to the classes below.

/// Keeps the residuals.
template <class S, int N, int rows> class Value_rows {
public:
  static constexpr bool with_derivatives = false;

  explicit Value_rows(const Triangle_values<S, N>&) {}
  const Tuple<S, rows>& values() const { return m_values; }

  template <int count> void skip()
  {
    for (int i = 0; i < count; ++i)
      m_values[m_next++] = S(0);
  }
  template <int count> void add(const Tuple<S, count>& value)
  {
    for (int i = 0; i < count; ++i)
      m_values[m_next++] = value[i];
  }

private:
  Tuple<S, rows> m_values;
  int m_next = 0;
};

/// Keeps the residuals and their derivatives by the corners' coefficients.
template <class S, int N, int rows> class Jacobian_rows {
public:
  static constexpr bool with_derivatives = true;

  explicit Jacobian_rows(const Triangle_values<S, N>& triangle) : m_triangle(triangle) {}
  const Tuple<S, rows>& values() const { return m_values; }
  const Tuple<Tuple<S, 3 * N>, rows>& derivatives() const { return m_derivatives; }

  template <int count> void skip()
  {
    for (int i = 0; i < count; ++i) {
      m_derivatives[m_next] = {};
      m_values[m_next++] = S(0);
    }
  }
  template <int count>
  void add(const Tuple<S, count>& value, const double (&weight)[3], const Tuple<Tuple<S, N>, count>& by_value)
  {
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < N; ++j)
          m_derivatives[m_next][k * N + j] = weight[k] * by_value[i][j];
      m_values[m_next++] = value[i];
    }
  }
  template <int count>
  void add(const Tuple<S, count>& value, const double (&weight)[3], const Tuple<Tuple<S, N>, count>& by_value,
           const Tuple<Tuple<S, N>, count>& by_x_slope, const Tuple<Tuple<S, N>, count>& by_y_slope)
  {
    const auto& gradient = m_triangle.gradient;
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < N; ++j)
          m_derivatives[m_next][k * N + j] =
              weight[k] * by_value[i][j] + gradient[0][k] * by_x_slope[i][j] + gradient[1][k] * by_y_slope[i][j];
      m_values[m_next++] = value[i];
    }
  }

private:
  const Triangle_values<S, N>& m_triangle;
  Tuple<S, rows> m_values;
  Tuple<Tuple<S, 3 * N>, rows> m_derivatives;
  int m_next = 0;
};

/// Adds up the energy, half the squared norm of the residuals, and its derivatives, without a Jacobian.
template <class S, int N> class Gradient_rows {
public:
  static constexpr bool with_derivatives = true;

  explicit Gradient_rows(const Triangle_values<S, N>& triangle) : m_triangle(triangle) {}

  S energy() const { return 0.5 * m_twice_energy; }
  /// By the coefficients of the corners.
  Tuple<S, 3 * N> gradient() const
  {
    Tuple<S, 3 * N> result;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < N; ++j)
        result[k * N + j] = m_by_corner[k][j] + m_triangle.gradient[0][k] * m_by_x_slope[j] +
                            m_triangle.gradient[1][k] * m_by_y_slope[j];
    return result;
  }

  template <int count> void skip() {}
  template <int count>
  void add(const Tuple<S, count>& value, const double (&weight)[3], const Tuple<Tuple<S, N>, count>& by_value)
  {
    m_twice_energy += dot(value, value);
    Tuple<S, N> by_point = scaled(value[0], by_value[0]);
    for (int i = 1; i < count; ++i)
      add_scaled(by_point, value[i], by_value[i]);
    for (int k = 0; k < 3; ++k)
      add_scaled(m_by_corner[k], weight[k], by_point);
  }
  template <int count>
  void add(const Tuple<S, count>& value, const double (&weight)[3], const Tuple<Tuple<S, N>, count>& by_value,
           const Tuple<Tuple<S, N>, count>& by_x_slope, const Tuple<Tuple<S, N>, count>& by_y_slope)
  {
    add(value, weight, by_value);
    for (int i = 0; i < count; ++i) {
      add_scaled(m_by_x_slope, value[i], by_x_slope[i]);
      add_scaled(m_by_y_slope, value[i], by_y_slope[i]);
    }
  }

private:
  const Triangle_values<S, N>& m_triangle;
  S m_twice_energy = 0;
  Tuple<Tuple<S, N>, 3> m_by_corner = {};
  Tuple<S, N> m_by_x_slope = {}, m_by_y_slope = {};
};

/// Adds up the energy, its derivatives, and the Gauss-Newton matrix J^T J.
template <class S, int N> class Normal_rows {
public:
  static constexpr bool with_derivatives = true;
  using Matrix = Tuple<Tuple<S, 3 * N>, 3 * N>;

  explicit Normal_rows(const Triangle_values<S, N>& triangle) : m_triangle(triangle), m_gradient(triangle) {}

  S energy() const { return m_gradient.energy(); }
  Tuple<S, 3 * N> gradient() const { return m_gradient.gradient(); }
  /// Its lower triangle.
  const Matrix& matrix() const { return m_matrix; }

  template <int count> void skip() {}
  template <int count>
  void add(const Tuple<S, count>& value, const double (&weight)[3], const Tuple<Tuple<S, N>, count>& by_value)
  {
    m_gradient.add(value, weight, by_value);
    Tuple<Tuple<S, N>, N> square;
    for (int i = 0; i < N; ++i)
      for (int j = 0; j <= i; ++j) {
        square[i][j] = by_value[0][i] * by_value[0][j];
        for (int r = 1; r < count; ++r)
          square[i][j] += by_value[r][i] * by_value[r][j];
        square[j][i] = square[i][j];
      }
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l <= k; ++l)
        for (int i = 0; i < N; ++i)
          for (int j = 0; j < (k == l ? i + 1 : N); ++j)
            m_matrix[k * N + i][l * N + j] += weight[k] * weight[l] * square[i][j];
  }
  template <int count>
  void add(const Tuple<S, count>& value, const double (&weight)[3], const Tuple<Tuple<S, N>, count>& by_value,
           const Tuple<Tuple<S, N>, count>& by_x_slope, const Tuple<Tuple<S, N>, count>& by_y_slope)
  {
    m_gradient.add(value, weight, by_value, by_x_slope, by_y_slope);
    const auto& gradient = m_triangle.gradient;
    for (int r = 0; r < count; ++r) {
      Tuple<S, 3 * N> row;
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < N; ++j)
          row[k * N + j] =
              weight[k] * by_value[r][j] + gradient[0][k] * by_x_slope[r][j] + gradient[1][k] * by_y_slope[r][j];
      for (int i = 0; i < 3 * N; ++i)
        for (int j = 0; j <= i; ++j)
          m_matrix[i][j] += row[i] * row[j];
    }
  }

private:
  const Triangle_values<S, N>& m_triangle;
  Gradient_rows<S, N> m_gradient;
  Matrix m_matrix = {};
};

} // namespace internal
} // namespace Quadrille

#endif
