// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_TRIANGLE_VALUES_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_TRIANGLE_VALUES_H

#include <Quadrille/Odeco_frame_field/internal/Tensor_coefficients.h>

namespace Quadrille {
namespace internal {

/// A field on one triangle (S: `double`) or on several next to each other (`Pack`): all that its residuals depend on.
template <class S, int N> struct Triangle_values {
  Tuple<Tuple<S, N>, 3> coefficients; ///< at the corners
  Tuple<Tuple<S, 3>, 2> gradient;     ///< of the three linear shape functions, along x and y
  S root_area;                        ///< square root of the area
  S size;                             ///< local triangle size, the unit of epsilon
  Tuple<S, 3> expected_log_value, target_weight;
  Tuple<Tuple<Tuple<S, 4>, 3>, 3> metric_residual; ///< per corner; see `Vertex_targets`

  /// Mean of the coefficients at the corners.
  Tuple<S, N> mean(const double (&weight)[3]) const
  {
    Tuple<S, N> result = scaled(S(weight[0]), coefficients[0]);
    add_scaled(result, weight[1], coefficients[1]);
    add_scaled(result, weight[2], coefficients[2]);
    return result;
  }
  /// Of the coefficients, along axis `a`.
  Tuple<S, N> slope(int a) const
  {
    Tuple<S, N> result = scaled(gradient[a][0], coefficients[0]);
    add_scaled(result, gradient[a][1], coefficients[1]);
    add_scaled(result, gradient[a][2], coefficients[2]);
    return result;
  }
};

} // namespace internal
} // namespace Quadrille

#endif
