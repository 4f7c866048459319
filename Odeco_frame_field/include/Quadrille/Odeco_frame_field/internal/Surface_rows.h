// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_ROWS_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_ROWS_H

#include <Quadrille/Odeco_frame_field/internal/Surface_triangle.h>

namespace Quadrille {
namespace internal {

// What an energy's residuals on one triangle of a surface (one per lane of `S`) turn into, as in Residual_rows.h for
// the plane. Derivatives are handed over by the tensor at a point, which is the mean of those at the corners with some
// weights, by its slopes, or by its curl.
//
// The larger functions are kept out of line: inlined into every term they would take compilers minutes and gigabytes,
// and run no faster.

/// Keeps the residuals.
template <class S, int N, int rows> class Surface_value_rows {
public:
  static constexpr bool with_derivatives = false, takes_sums = false;

  explicit Surface_value_rows(const Surface_triangle<S, N>&) {}
  const Tuple<S, rows>& values() const { return m_values; }

  template <int count> void skip()
  {
    for (int i = 0; i < count; ++i)
      m_values[m_next++] = S(0);
  }
  void add(const S& value) { m_values[m_next++] = value; }

private:
  Tuple<S, rows> m_values;
  int m_next = 0;
};

/// From derivatives by tensors to derivatives by the coefficients of the corners.
template <class S, int N> class Corner_derivatives {
public:
  [[gnu::noinline]] explicit Corner_derivatives(const Surface_triangle<S, N>& triangle) : m_triangle(triangle)
  {
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < N; ++j)
        m_curl[k][j] = contract(triangle.aligned[k].basis[j], triangle.rotor(k));
  }

  [[gnu::noinline]] Tuple<S, 3 * N> of_mean(const double (&weight)[3], const Space_tensor<S>& by_tensor) const
  {
    Tuple<S, 3 * N> row;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < N; ++j)
        row[k * N + j] = weight[k] * dot(by_tensor, m_triangle.aligned[k].basis[j]);
    return row;
  }
  [[gnu::noinline]] void add_curl(const Cubic_tensor<S>& by_curl, Tuple<S, 3 * N>& row) const
  {
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < N; ++j)
        row[k * N + j] += dot(by_curl, m_curl[k][j]);
  }
  [[gnu::noinline]] void add_slope(int axis, const Space_tensor<S>& by_slope, Tuple<S, 3 * N>& row) const
  {
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < N; ++j)
        row[k * N + j] += m_triangle.gradient[axis][k] * dot(by_slope, m_triangle.aligned[k].basis[j]);
  }

private:
  const Surface_triangle<S, N>& m_triangle;
  Tuple<Tuple<Cubic_tensor<S>, N>, 3> m_curl;
};

/// Keeps the residuals and their derivatives by the corners' coefficients.
template <class S, int N, int rows> class Surface_jacobian_rows {
public:
  static constexpr bool with_derivatives = true, takes_sums = false;

  explicit Surface_jacobian_rows(const Surface_triangle<S, N>& triangle) : m_corners(triangle) {}
  const Tuple<S, rows>& values() const { return m_values; }
  const Tuple<Tuple<S, 3 * N>, rows>& derivatives() const { return m_derivatives; }

  template <int count> void skip()
  {
    for (int i = 0; i < count; ++i) {
      m_derivatives[m_next] = {};
      m_values[m_next++] = S(0);
    }
  }
  void add(const S& value, const double (&weight)[3], const Space_tensor<S>& by_tensor)
  {
    keep(value, m_corners.of_mean(weight, by_tensor));
  }
  void add_with_curl(const S& value, const double (&weight)[3], const Space_tensor<S>& by_tensor,
                     const Cubic_tensor<S>& by_curl)
  {
    Tuple<S, 3 * N> row = m_corners.of_mean(weight, by_tensor);
    m_corners.add_curl(by_curl, row);
    keep(value, row);
  }
  void add_with_slope(const S& value, const double (&weight)[3], const Space_tensor<S>& by_tensor, int axis,
                      const Space_tensor<S>& by_slope)
  {
    Tuple<S, 3 * N> row = m_corners.of_mean(weight, by_tensor);
    m_corners.add_slope(axis, by_slope, row);
    keep(value, row);
  }

private:
  [[gnu::noinline]] void keep(const S& value, const Tuple<S, 3 * N>& row)
  {
    m_derivatives[m_next] = row;
    m_values[m_next++] = value;
  }

  Corner_derivatives<S, N> m_corners;
  Tuple<S, rows> m_values;
  Tuple<Tuple<S, 3 * N>, rows> m_derivatives;
  int m_next = 0;
};

/// Adds up the energy, half the squared norm of the residuals, and its derivatives, without a Jacobian.
template <class S, int N> class Surface_gradient_rows {
public:
  static constexpr bool with_derivatives = true, takes_sums = true, with_matrix = false;

  explicit Surface_gradient_rows(const Surface_triangle<S, N>& triangle) : m_triangle(triangle) {}

  S energy() const { return 0.5 * m_twice_energy; }
  /// By the coefficients of the corners.
  [[gnu::noinline]] Tuple<S, 3 * N> gradient() const
  {
    Tuple<S, 3 * N> result;
    for (int k = 0; k < 3; ++k) {
      Space_tensor<S> by_corner = m_by_corner[k];
      for (int a = 0; a < 2; ++a)
        add_scaled(by_corner, m_triangle.gradient[a][k], m_by_slope[a]);
      const Space_vector<S> rotor = m_triangle.rotor(k);
      for (int c = 0; c < 10; ++c)
        for (int s = 0; s < 2; ++s) // rotors are tangential
          by_corner[with_index(c, s)] += rotor[s] * m_by_curl[c];
      for (int j = 0; j < N; ++j)
        result[k * N + j] = dot(by_corner, m_triangle.aligned[k].basis[j]);
    }
    return result;
  }

  template <int count> void skip() {}
  [[gnu::noinline]] void add(const S& value, const double (&weight)[3], const Space_tensor<S>& by_tensor)
  {
    m_twice_energy += value * value;
    for (int k = 0; k < 3; ++k)
      add_scaled(m_by_corner[k], weight[k] * value, by_tensor);
  }
  /// Rows of the mean tensor, by the sum of their squares, and half its derivatives.
  [[gnu::noinline]] void add_sums(const S& squares, const double (&weight)[3], const Space_tensor<S>& half_gradient)
  {
    m_twice_energy += squares;
    for (int k = 0; k < 3; ++k)
      add_scaled(m_by_corner[k], weight[k], half_gradient);
  }
  void add_with_curl(const S& value, const double (&weight)[3], const Space_tensor<S>& by_tensor,
                     const Cubic_tensor<S>& by_curl)
  {
    add(value, weight, by_tensor);
    add_scaled(m_by_curl, value, by_curl);
  }
  void add_with_slope(const S& value, const double (&weight)[3], const Space_tensor<S>& by_tensor, int axis,
                      const Space_tensor<S>& by_slope)
  {
    add(value, weight, by_tensor);
    add_scaled(m_by_slope[axis], value, by_slope);
  }

private:
  const Surface_triangle<S, N>& m_triangle;
  S m_twice_energy = 0;
  Tuple<Space_tensor<S>, 3> m_by_corner = {};
  Tuple<Space_tensor<S>, 2> m_by_slope = {};
  Cubic_tensor<S> m_by_curl = {};
};

/// Adds up the energy, its derivatives, and the Gauss-Newton matrix J^T J.
template <class S, int N> class Surface_normal_rows {
public:
  static constexpr bool with_derivatives = true, takes_sums = true, with_matrix = true;
  using Matrix = Tuple<Tuple<S, 3 * N>, 3 * N>;

  explicit Surface_normal_rows(const Surface_triangle<S, N>& triangle) : m_triangle(triangle), m_corners(triangle) {}

  S energy() const { return 0.5 * m_twice_energy; }
  Tuple<S, 3 * N> gradient() const { return m_gradient; }
  /// Its lower triangle.
  [[gnu::noinline]] Matrix matrix() const
  {
    Matrix result = m_matrix;
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l <= k; ++l)
        add_block(k, l, result);
    return result;
  }

  template <int count> void skip() {}
  void add(const S& value, const double (&weight)[3], const Space_tensor<S>& by_tensor)
  {
    keep(value, m_corners.of_mean(weight, by_tensor));
  }
  /// Rows of the mean tensor, by the sum of their squares, half its derivatives, and J^T J (its entries i >= j, row by
  /// row).
  [[gnu::noinline]] void add_sums(const S& squares, const double (&weight)[3], const Space_tensor<S>& half_gradient,
                                  const Tuple<S, 120>& gram)
  {
    m_twice_energy += squares;
    add_scaled(m_gradient, 1, m_corners.of_mean(weight, half_gradient));
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l <= k; ++l)
        add_scaled(m_gram[block(k, l)], weight[k] * weight[l], gram);
  }
  void add_with_curl(const S& value, const double (&weight)[3], const Space_tensor<S>& by_tensor,
                     const Cubic_tensor<S>& by_curl)
  {
    Tuple<S, 3 * N> row = m_corners.of_mean(weight, by_tensor);
    m_corners.add_curl(by_curl, row);
    keep(value, row);
  }
  void add_with_slope(const S& value, const double (&weight)[3], const Space_tensor<S>& by_tensor, int axis,
                      const Space_tensor<S>& by_slope)
  {
    Tuple<S, 3 * N> row = m_corners.of_mean(weight, by_tensor);
    m_corners.add_slope(axis, by_slope, row);
    keep(value, row);
  }

private:
  static constexpr int block(int k, int l) { return k * (k + 1) / 2 + l; } ///< \pre k >= l

  /// From the tensors of corners k and l to their coefficients.
  [[gnu::noinline]] void add_block(int k, int l, Matrix& result) const
  {
    const Tuple<S, 120>& gram = m_gram[block(k, l)];
    for (int j = 0; j < N; ++j) {
      const Space_tensor<S>& b = m_triangle.aligned[l].basis[j];
      Space_tensor<S> image = {};
      for (int r = 0, n = 0; r < 15; ++r, ++n) {
        S sum = image[r];
        for (int c = 0; c < r; ++c, ++n) {
          sum += gram[n] * b[c];
          image[c] += gram[n] * b[r];
        }
        image[r] = sum + gram[n] * b[r];
      }
      for (int i = k == l ? j : 0; i < N; ++i)
        result[k * N + i][l * N + j] += dot(m_triangle.aligned[k].basis[i], image);
    }
  }

  [[gnu::noinline]] void keep(const S& value, const Tuple<S, 3 * N>& row)
  {
    m_twice_energy += value * value;
    add_scaled(m_gradient, value, row);
    for (int i = 0; i < 3 * N; ++i)
      for (int j = 0; j <= i; ++j)
        m_matrix[i][j] += row[i] * row[j];
  }

  const Surface_triangle<S, N>& m_triangle;
  Corner_derivatives<S, N> m_corners;
  S m_twice_energy = 0;
  Tuple<S, 3 * N> m_gradient = {};
  Matrix m_matrix = {};
  Tuple<Tuple<S, 120>, 6> m_gram = {}; ///< by tensors, of pairs of corners
};

} // namespace internal
} // namespace Quadrille

#endif
