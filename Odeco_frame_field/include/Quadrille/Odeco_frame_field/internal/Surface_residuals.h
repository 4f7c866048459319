// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_RESIDUALS_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_RESIDUALS_H

#include <Quadrille/Odeco_frame_field/internal/Field_residuals.h>
#include <Quadrille/Odeco_frame_field/internal/Surface_rows.h>

namespace Quadrille {
namespace internal {

/// The tensor at a quadrature point, with what is often needed of it.
template <class S> struct Surface_point {
  Space_tensor<S> tensor;
  Space_matrix<S> second_order; ///< its second-order part M
  Inverse_matrix<S> inverse;    ///< of M
  S area;                       ///< det M in the tangent plane: of the gradients; 1 / (A of the elements)

  template <int N>
  Surface_point(const Surface_triangle<S, N>& triangle, const double (&weight)[3])
      : tensor(triangle.mean(weight)), second_order(second_order_part(tensor)), inverse(second_order),
        area(second_order[0] * second_order[3] - second_order[1] * second_order[1])
  {
  }

  /// All gradients of the frame have positive lengths, as far as M tells.
  bool is_positive() const { return inverse.is_positive; }
  /// The derivatives of log(area) by the tensor.
  Space_tensor<S> log_area_derivatives() const
  {
    const S scale = 1 / area, a = scale * second_order[3], b = -2 * (scale * second_order[1]),
            c = scale * second_order[0];
    return {{a, b, 0, a + c, 0, a, b, 0, b, 0, c, 0, c, 0, 0}};
  }
};

/// The residuals that the energies of a field on a surface are made of, with three-point quadrature, in terms of
/// tensors whose eigenvalues are the lengths of gradients. Half the squared norm of the rows is a triangle's energy.
///
/// Every function hands its rows to `rows` (Surface_rows.h). `S` is `double` or `Pack`.
template <int N> struct Surface_residuals {
  static constexpr int points = 3;
  static constexpr int curl_rows = 3 * points;
  static constexpr int odeco_rows = odeco_quadrics_count * points;
  static constexpr int smoothness_rows = 2 * 15;
  static constexpr const auto& weights = Field_residuals<N>::weights;

  /// The normalised curl energy; surface, eqs. (45), (46): w_i = T_ijkl C_jkl, r = M^-2 w.
  template <class S, class Rows>
  [[gnu::noinline]] static void curl(const Surface_triangle<S, N>& triangle, const Tuple<Surface_point<S>, points>& at,
                                     Rows& rows)
  {
    const Cubic_tensor<S> curl = triangle.curl();
    Cubic_tensor<S> weighted_curl;
    for (int c = 0; c < 10; ++c)
      weighted_curl[c] = cubic_multiplicity[c] * curl[c];
    const S factor = std::sqrt(2. / points) * triangle.root_area;
    for (int p = 0; p < points; ++p) {
      const Space_tensor<S>& t = at[p].tensor;
      const Space_matrix<S>& inverse = at[p].inverse.inverse;
      Space_vector<S> w = {};
      for (int c = 0; c < 10; ++c)
        for (int i = 0; i < 3; ++i)
          w[i] += weighted_curl[c] * t[with_index(c, i)];
      const Space_vector<S> y = product(inverse, w), r = product(inverse, y);
      if constexpr (Rows::with_derivatives) {
        // dr = M^-2 (dw - dM y) - M^-1 dM r
        Tuple<Space_tensor<S>, 3> by_w = {}, by_m = {};
        for (int c = 0; c < 10; ++c)
          for (int i = 0; i < 3; ++i)
            by_w[i][with_index(c, i)] += weighted_curl[c];
        add_second_order_derivative(y, S(-1), by_w);
        add_second_order_derivative(r, S(-1), by_m);
        const Tuple<Space_tensor<S>, 3> inner = row_product(inverse, by_w);
        for (int i = 0; i < 3; ++i)
          add_scaled(by_m[i], 1, inner[i]);
        const Tuple<Space_tensor<S>, 3> by_tensor = row_product(inverse, by_m);
        const Space_matrix<S> square = squared(inverse);
        for (int i = 0; i < 3; ++i) {
          Cubic_tensor<S> by_curl;
          for (int c = 0; c < 10; ++c) {
            S sum = square[matrix_place[i][0]] * t[with_index(c, 0)];
            for (int m = 1; m < 3; ++m)
              sum += square[matrix_place[i][m]] * t[with_index(c, m)];
            by_curl[c] = factor * cubic_multiplicity[c] * sum;
          }
          rows.add_with_curl(factor * r[i], weights[p], scaled(factor, by_tensor[i]), by_curl);
        }
      } else {
        for (int i = 0; i < 3; ++i)
          rows.add(factor * r[i]);
      }
    }
  }

  /// The odeco penalty times `factor` squared, with c(T) over the area. The paper's c(T / |T|), eq. (52), lets a field
  /// lower it by shrinking in the tangent plane until only the normal's part is left.
  template <class S, class Rows>
  [[gnu::noinline]] static void odeco_by_area(const Tuple<Surface_point<S>, points>& at, const S& factor, Rows& rows)
  {
    for (int p = 0; p < points; ++p)
      odeco(at[p].tensor, planar_scale * factor / at[p].area, at[p].log_area_derivatives(), weights[p], rows);
  }

  /// The odeco penalty of surface, eq. (52), times `factor` squared.
  template <class S, class Rows>
  [[gnu::noinline]] static void odeco_by_norm(const Tuple<Surface_point<S>, points>& at, const S& factor, Rows& rows)
  {
    for (int p = 0; p < points; ++p) {
      Space_tensor<S> weighted = at[p].tensor;
      for (int e = 0; e < 15; ++e)
        weighted[e] = space_multiplicity[e] * weighted[e];
      const S inverse_square = 1 / dot(weighted, at[p].tensor);
      odeco(at[p].tensor, factor * inverse_square, scaled(2 * inverse_square, weighted), weights[p], rows);
    }
  }

private:
  /// In the plane, on isotropic frames, the penalty is then that of planar-2, so that epsilons mean the same.
  static constexpr double planar_scale = 3.35410196624968454 * pi;

  /// The rows scale c(T), where d log(1 / scale) = `by_log` . dT.
  template <class S, class Rows>
  static void odeco(const Space_tensor<S>& t, const S& scale, const Space_tensor<S>& by_log, const double (&weight)[3],
                    Rows& rows)
  {
    if constexpr (Rows::takes_sums) {
      const Odeco_sums<S> sums(t, Rows::with_matrix);
      const S square = scale * scale;
      Space_tensor<S> gradient = scaled(square, sums.half_gradient);
      add_scaled(gradient, -square * sums.squared_norm, by_log);
      if constexpr (Rows::with_matrix) {
        // J = scale (dc - c by_log^T)
        Tuple<S, 120> gram;
        for (int i = 0, n = 0; i < 15; ++i) {
          const S a = sums.squared_norm * by_log[i] - sums.half_gradient[i];
          for (int j = 0; j <= i; ++j, ++n)
            gram[n] = square * (sums.gram[n] + a * by_log[j] - by_log[i] * sums.half_gradient[j]);
        }
        rows.add_sums(square * sums.squared_norm, weight, gradient, gram);
      } else {
        rows.add_sums(square * sums.squared_norm, weight, gradient);
      }
    } else {
      Tuple<S, odeco_quadrics_count> value;
      if constexpr (Rows::with_derivatives) {
        Tuple<Space_tensor<S>, odeco_quadrics_count> by_tensor;
        odeco_residuals(t, value, &by_tensor);
        for (int r = 0; r < odeco_quadrics_count; ++r) {
          Space_tensor<S> row = scaled(scale, by_tensor[r]);
          add_scaled(row, -scale * value[r], by_log);
          rows.add(scale * value[r], weight, row);
        }
      } else {
        odeco_residuals<S>(t, value, nullptr);
        for (int r = 0; r < odeco_quadrics_count; ++r)
          rows.add(scale * value[r]);
      }
    }
  }

  template <class S> static Space_matrix<S> squared(const Space_matrix<S>& m)
  {
    const Tuple<S, 3> a = {{m[0], m[1], m[2]}}, b = {{m[1], m[3], m[4]}}, c = {{m[2], m[4], m[5]}};
    return {{dot(a, a), dot(a, b), dot(a, c), dot(b, b), dot(b, c), dot(c, c)}};
  }
  template <class S>
  [[gnu::noinline]] static Tuple<Space_tensor<S>, 3> row_product(const Space_matrix<S>& m,
                                                                 const Tuple<Space_tensor<S>, 3>& rows)
  {
    Tuple<Space_tensor<S>, 3> result;
    for (int i = 0; i < 3; ++i) {
      result[i] = scaled(m[matrix_place[i][0]], rows[0]);
      add_scaled(result[i], m[matrix_place[i][1]], rows[1]);
      add_scaled(result[i], m[matrix_place[i][2]], rows[2]);
    }
    return result;
  }
};

} // namespace internal
} // namespace Quadrille

#endif
