// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_TRIANGLE_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_TRIANGLE_H

#include <Quadrille/Odeco_frame_field/internal/Space_tensor.h>

namespace Quadrille {
namespace internal {

/// Entries of the product of two quadratic forms, each given by its coefficients of xx, xy, xz, yy, yz, zz.
template <class S> [[gnu::noinline]] Space_tensor<S> product_of_forms(const Tuple<S, 6>& a, const Tuple<S, 6>& b)
{
  Space_tensor<S> t = {};
  for (int n = 0; n <= 2; ++n)
    for (int c = 0; c <= n; ++c)
      for (int k = 0; k <= 2; ++k)
        for (int d = 0; d <= k; ++d) {
          const int entry = (n + k) * (n + k + 1) / 2 + c + d;
          t[entry] += (1 / space_multiplicity[entry]) * (a[n * (n + 1) / 2 + c] * b[k * (k + 1) / 2 + d]);
        }
  return t;
}

/// The eigenvalue that tensors have along the surface's normal.
enum class Normal_value {
  mean, ///< the mean of the two in the tangent plane, so that tensors, and their energies, have no unit of length
  one   ///< 1, as in the paper
};

/// The tensors that have a unit vector, the normal, as an eigenvector, as a function of N coefficients: those of the
/// tensor's restriction to the plane across it (`Tensor_coefficients<N>`); surface, eq. (29).
template <class S, int N> struct Aligned_tensors {
  Space_tensor<S> offset;
  Tuple<Space_tensor<S>, N> basis; ///< of every coefficient the tensor

  Aligned_tensors() = default;
  /// `axes`: two unit vectors that span the plane, and the normal.
  [[gnu::noinline]] Aligned_tensors(const Tuple<Space_vector<S>, 3>& axes, Normal_value normal_value)
  {
    // x and y along the axes: r^4, (x^2 - y^2) r^2, 2 x y r^2, (x^2 - y^2)^2 - (2 x y)^2, 2 (x^2 - y^2) 2 x y.
    const Tuple<S, 6> xx = form(axes[0], axes[0]), yy = form(axes[1], axes[1]),
                      sine = scaled(S(2), form(axes[0], axes[1])), zz = form(axes[2], axes[2]);
    Tuple<S, 6> square = xx, cosine = xx;
    add_scaled(square, 1, yy);
    add_scaled(cosine, -1, yy);
    const double root_pi = std::sqrt(pi);
    offset = product_of_forms(zz, zz);
    basis[0] = scaled(S(1 / std::sqrt(2 * pi)), product_of_forms(square, square));
    if (normal_value == Normal_value::mean) {
      add_scaled(basis[0], 4 / (3 * std::sqrt(2 * pi)), offset);
      offset = {};
    }
    if constexpr (N == 5) {
      basis[1] = scaled(S(1 / root_pi), product_of_forms(cosine, square));
      basis[2] = scaled(S(1 / root_pi), product_of_forms(sine, square));
    }
    basis[N - 2] = scaled(S(1 / root_pi), product_of_forms(cosine, cosine));
    add_scaled(basis[N - 2], -1 / root_pi, product_of_forms(sine, sine));
    basis[N - 1] = scaled(S(2 / root_pi), product_of_forms(cosine, sine));
  }

  Space_tensor<S> operator()(const Tuple<S, N>& q) const
  {
    Space_tensor<S> t = offset;
    for (int i = 0; i < N; ++i)
      add_scaled(t, q[i], basis[i]);
    return t;
  }

private:
  static Tuple<S, 6> form(const Space_vector<S>& a, const Space_vector<S>& b)
  {
    return {{a[0] * b[0], a[0] * b[1] + a[1] * b[0], a[0] * b[2] + a[2] * b[0], a[1] * b[1], a[1] * b[2] + a[2] * b[1],
             a[2] * b[2]}};
  }
};

/// A field on a triangle of a surface, in axes whose third one is the triangle's normal.
template <class S, int N> struct Surface_triangle {
  Tuple<Aligned_tensors<S, N>, 3> aligned; ///< at the corners
  Tuple<Space_tensor<S>, 3> tensor;        ///< at the corners
  Tuple<Tuple<S, 3>, 2> gradient;          ///< of the three linear shape functions, along the first two axes
  S area, root_area;
  S size; ///< local triangle size, the unit of epsilon
  Tuple<S, 3> expected_log_value, target_weight;
  bool is_weakly_constrained; ///< some corner; see `Weak_target` for what follows, undefined otherwise
  Tuple<S, 3> weak_share;
  Tuple<Tuple<S, N>, 3> weak_offset;
  Tuple<Tuple<Tuple<S, N>, N>, 3> weak_projector;

  Space_tensor<S> mean(const double (&weight)[3]) const
  {
    Space_tensor<S> result = scaled(S(weight[0]), tensor[0]);
    add_scaled(result, weight[1], tensor[1]);
    add_scaled(result, weight[2], tensor[2]);
    return result;
  }
  Space_tensor<S> slope(int a) const
  {
    Space_tensor<S> result = scaled(gradient[a][0], tensor[0]);
    add_scaled(result, gradient[a][1], tensor[1]);
    add_scaled(result, gradient[a][2], tensor[2]);
    return result;
  }
  /// By how much corner k weighs in the normal part of the curl: n x the gradient of its shape function.
  Space_vector<S> rotor(int k) const { return {{-gradient[1][k], gradient[0][k], 0}}; }
  /// C_ijk = (curl of T_ijk.) . n; surface, eq. (41).
  Cubic_tensor<S> curl() const
  {
    Cubic_tensor<S> result = contract(tensor[0], rotor(0));
    add_scaled(result, 1, contract(tensor[1], rotor(1)));
    add_scaled(result, 1, contract(tensor[2], rotor(2)));
    return result;
  }
};

} // namespace internal
} // namespace Quadrille

#endif
