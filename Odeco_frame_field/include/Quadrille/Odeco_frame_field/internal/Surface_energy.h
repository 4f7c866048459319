// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_ENERGY_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_ENERGY_H

#include <Quadrille/Odeco_field_options.h>
#include <Quadrille/Odeco_frame_field/internal/Surface_elements.h>
#include <Quadrille/Odeco_frame_field/internal/Surface_residuals.h>
#include <Quadrille/Odeco_frame_field/internal/Triangle_energy.h>
#include <Quadrille/Symmetric_tensor_3.h>

namespace Quadrille {
namespace internal {

/// How much the terms of surface, eq. (55) weigh beside the curl.
struct Surface_weights {
  /// The paper's own terms: c(T / |T|) and eq. (54) as they are, all but the curl divided by the area of the triangle,
  /// so that their sums grow with the number of triangles. Otherwise c(T) / det M over epsilon squared, eq. (54) over
  /// det M, and means over the surface.
  bool as_in_paper = false;
  double odeco = 1;  ///< as in the paper: kappa; otherwise epsilon, in units of the triangles' sizes
  double area = 0;   ///< of log(A0 det M)^2
  double angle = 0;  ///< of the distance from isotropy
  double target = 0; ///< of log(size / target)^2, half its mean where there are targets
  double weak = 0;   ///< of half the mean along weakly constrained edges of the squared distance from what they ask for
};

/// What a tensor's coefficient j in spherical harmonics is of its entries, times a factor.
template <class S> Space_tensor<S> harmonic_row(int j, const S& factor)
{
  const Eigen::Matrix<double, 15, 15>& harmonics = Symmetric_tensor_3::harmonics_of_entries();
  Space_tensor<S> row;
  for (int e = 0; e < 15; ++e)
    row[e] = factor * harmonics(j, e);
  return row;
}

/// The rows of a `Surface_energy` in their order.
template <int N> struct Surface_energy_rows {
  static constexpr int points = 3;
  static constexpr int first_odeco = 3 * points, first_size = first_odeco + odeco_quadrics_count * points,
                       first_angle = first_size + points, first_smooth = first_angle + 2 * points,
                       first_weak = first_smooth + 2 * 15, count = first_weak + 3 * N;
};

/// The energies of a field on a surface, with three-point quadrature. Half the squared norm of the residuals is the
/// energy.
template <int N>
class Surface_energy : public Triangle_energy<Surface_energy<N>, Surface_elements<N>, Surface_energy_rows<N>::count> {
  using Pieces = Surface_residuals<N>;
  using Base = Triangle_energy<Surface_energy<N>, Surface_elements<N>, Surface_energy_rows<N>::count>;

public:
  static constexpr int first_odeco = Surface_energy_rows<N>::first_odeco,
                       first_size = Surface_energy_rows<N>::first_size;
  /// Measured on five models: with ten times less, integration errors are the same and fields take twice as long.
  static constexpr double final_decrease = 1e-3;

  Surface_energy(const Surface_elements<N>& elements, const Surface_weights& weights)
      : Base(elements), m_weights(weights)
  {
  }

  const Surface_weights& weights() const { return m_weights; }
  /// The paper's terms have none.
  void set_relative_epsilon(double epsilon)
  {
    if (!m_weights.as_in_paper)
      m_weights.odeco = epsilon;
  }
  /// What leads a melted field: adds the schedule's attractions to the expected sizes (half the mean over the surface
  /// of the squared logarithm of values against the expected ones), and to smooth fields (the Dirichlet energy over the
  /// area). Integrability alone would let pairs of singularities be that no size needs.
  void attract(const Melt_and_freeze_schedule& schedule)
  {
    m_size_attraction = schedule.size_attraction;
    m_smooth_attraction = schedule.smooth_attraction;
  }
  void stop_attracting() { m_size_attraction = m_smooth_attraction = 0; }

  template <class S, class Rows> bool add_rows(const Surface_triangle<S, N>& triangle, Rows& rows) const
  {
    const auto& weights = Pieces::weights;
    const Tuple<Surface_point<S>, Pieces::points> at = {
        {{triangle, weights[0]}, {triangle, weights[1]}, {triangle, weights[2]}}};
    for (int p = 0; p < Pieces::points; ++p)
      if (!at[p].is_positive())
        return false;
    Pieces::curl(triangle, at, rows);
    if (m_weights.as_in_paper)
      Pieces::odeco_by_norm(at, S(std::sqrt(m_weights.odeco / Pieces::points)), rows);
    else
      Pieces::odeco_by_area(at, std::sqrt(2. / Pieces::points) / m_weights.odeco * triangle.root_area / triangle.size,
                            rows);
    add_area(triangle, at, rows);
    add_angle(triangle, at, rows);
    add_smoothness(triangle, rows);
    add_weak_constraints(triangle, rows);
    return true;
  }

private:
  template <class S, class Rows>
  [[gnu::noinline]] void add_area(const Surface_triangle<S, N>& triangle,
                                  const Tuple<Surface_point<S>, Pieces::points>& at, Rows& rows) const
  {
    const auto& elements = this->elements();
    const double target_density =
        elements.has_targets() ? m_weights.target / (Pieces::points * elements.target_area()) : 0.;
    // log(A0 det M) is twice the logarithm of values, and the paper has no half before its integrals.
    const double own = m_weights.as_in_paper ? 0 : 8 * m_weights.area;
    const double density = (m_size_attraction + own) / (Pieces::points * elements.total_area());
    if (density == 0 && target_density == 0 && m_weights.area == 0) {
      rows.template skip<Pieces::points>();
      return;
    }
    for (int p = 0; p < Pieces::points; ++p) {
      const auto& weight = Pieces::weights[p];
      S expected = 0, target = 0;
      for (int k = 0; k < 3; ++k) {
        expected += weight[k] * triangle.expected_log_value[k];
        target += weight[k] * triangle.target_weight[k];
      }
      S square = triangle.area * (density + target_density * target);
      if (m_weights.as_in_paper)
        square += 4. / Pieces::points * m_weights.area;
      const S factor = square_root(square);
      const S value = factor * (0.5 * logarithm(at[p].area) - expected);
      if constexpr (Rows::with_derivatives)
        rows.add(value, weight, scaled(0.5 * factor, at[p].log_area_derivatives()));
      else
        rows.add(value);
    }
  }

  /// surface, eq. (54), as far as it is about the tangent plane: the part of degree 2 of the tensor's restriction.
  template <class S, class Rows>
  [[gnu::noinline]] void add_angle(const Surface_triangle<S, N>& triangle,
                                   const Tuple<Surface_point<S>, Pieces::points>& at, Rows& rows) const
  {
    if (m_weights.angle == 0) {
      rows.template skip<2 * Pieces::points>();
      return;
    }
    // On the sphere (x^2 - y^2)(x^2 + y^2) has the norm root(pi 256 / 315).
    const double norm = std::sqrt(pi * 256 / 315 * m_weights.angle);
    const S factor = m_weights.as_in_paper
                         ? S(norm / std::sqrt(Pieces::points))
                         : norm * std::sqrt(2 / (Pieces::points * this->elements().total_area())) * triangle.root_area;
    for (int p = 0; p < Pieces::points; ++p) {
      const Space_tensor<S>& t = at[p].tensor;
      const S scale = m_weights.as_in_paper ? factor : factor / square_root(at[p].area);
      const S value[2] = {scale * (0.5 * (t[0] - t[10])), scale * (t[1] + t[6])};
      if constexpr (Rows::with_derivatives) {
        Tuple<Space_tensor<S>, 2> by_tensor = {};
        by_tensor[0][0] = 0.5 * scale;
        by_tensor[0][10] = -0.5 * scale;
        by_tensor[1][1] = by_tensor[1][6] = scale;
        if (!m_weights.as_in_paper)
          for (int i = 0; i < 2; ++i)
            add_scaled(by_tensor[i], -0.5 * value[i], at[p].log_area_derivatives());
        for (int i = 0; i < 2; ++i)
          rows.add(value[i], Pieces::weights[p], by_tensor[i]);
      } else {
        rows.add(value[0]);
        rows.add(value[1]);
      }
    }
  }

  /// At the centroid. \pre Areas are positive at the quadrature points.
  template <class S, class Rows> void add_smoothness(const Surface_triangle<S, N>& triangle, Rows& rows) const
  {
    if (m_smooth_attraction == 0) {
      rows.template skip<2 * 15>();
      return;
    }
    const Surface_point<S> center(triangle, Field_residuals<N>::centroid_weights);
    const S factor = triangle.root_area * square_root(m_smooth_attraction / center.area);
    for (int a = 0; a < 2; ++a) {
      const Space_tensor<S> slope = triangle.slope(a);
      for (int j = 0; j < 15; ++j) {
        const Space_tensor<S> row = harmonic_row(j, factor);
        const S value = dot(row, slope);
        if constexpr (Rows::with_derivatives)
          rows.add_with_slope(value, Field_residuals<N>::centroid_weights,
                              scaled(-0.5 * value, center.log_area_derivatives()), a, row);
        else
          rows.add(value);
      }
    }
  }

  /// At the corners. The coefficients are products with dual tensors; those that belong to different coefficients are
  /// orthogonal.
  template <class S, class Rows>
  [[gnu::noinline]] void add_weak_constraints(const Surface_triangle<S, N>& triangle, Rows& rows) const
  {
    if (m_weights.weak == 0 || !triangle.is_weakly_constrained) {
      rows.template skip<3 * N>();
      return;
    }
    for (int k = 0; k < 3; ++k) {
      Tuple<Space_tensor<S>, N> dual;
      for (int i = 0; i < N; ++i) {
        const Space_tensor<S>& basis = triangle.aligned[k].basis[i];
        for (int e = 0; e < 15; ++e)
          dual[i][e] = space_multiplicity[e] * basis[e];
        dual[i] = scaled(1 / dot(dual[i], basis), dual[i]);
      }
      const S factor =
          square_root(m_weights.weak * triangle.weak_share[k]) / exponential(triangle.expected_log_value[k]);
      const double corner[3] = {k == 0 ? 1. : 0., k == 1 ? 1. : 0., k == 2 ? 1. : 0.};
      for (int i = 0; i < N; ++i) {
        Space_tensor<S> row = scaled(triangle.weak_projector[k][i][0], dual[0]);
        for (int j = 1; j < N; ++j)
          add_scaled(row, triangle.weak_projector[k][i][j], dual[j]);
        row = scaled(factor, row);
        const S value = dot(row, triangle.tensor[k]) - factor * triangle.weak_offset[k][i];
        if constexpr (Rows::with_derivatives)
          rows.add(value, corner, row);
        else
          rows.add(value);
      }
    }
  }

  Surface_weights m_weights;
  double m_size_attraction = 0, m_smooth_attraction = 0;
};

constexpr int surface_smoothness_rows = 2 * 15 + 3 * odeco_quadrics_count;

/// surface, eq. (57): the Dirichlet energy of the coefficients in spherical harmonics and the odeco penalty of eq.
/// (52).
template <int N>
class Surface_smoothness : public Triangle_energy<Surface_smoothness<N>, Surface_elements<N>, surface_smoothness_rows> {
  using Pieces = Surface_residuals<N>;
  using Base = Triangle_energy<Surface_smoothness<N>, Surface_elements<N>, surface_smoothness_rows>;

public:
  explicit Surface_smoothness(const Surface_elements<N>& elements, double odeco_weight)
      : Base(elements), m_odeco_weight(odeco_weight)
  {
  }

  void set_odeco_weight(double weight) { m_odeco_weight = weight; }

  template <class S, class Rows> bool add_rows(const Surface_triangle<S, N>& triangle, Rows& rows) const
  {
    const auto& weights = Pieces::weights;
    const Tuple<Surface_point<S>, Pieces::points> at = {
        {{triangle, weights[0]}, {triangle, weights[1]}, {triangle, weights[2]}}};
    for (int a = 0; a < 2; ++a) {
      const Space_tensor<S> slope = triangle.slope(a);
      for (int j = 0; j < 15; ++j) {
        const Space_tensor<S> row = harmonic_row(j, triangle.root_area);
        if constexpr (Rows::with_derivatives)
          rows.add_with_slope(dot(row, slope), Field_residuals<N>::centroid_weights, {}, a, row);
        else
          rows.add(dot(row, slope));
      }
    }
    Pieces::odeco_by_norm(at, S(std::sqrt(m_odeco_weight / Pieces::points)), rows);
    return true;
  }

private:
  double m_odeco_weight;
};

#ifdef QUADRILLE_SEPARATE_COMPILATION
extern template class Triangle_energy<Surface_energy<3>, Surface_elements<3>, Surface_energy_rows<3>::count>;
extern template class Triangle_energy<Surface_smoothness<3>, Surface_elements<3>, surface_smoothness_rows>;
extern template class Triangle_energy<Surface_energy<5>, Surface_elements<5>, Surface_energy_rows<5>::count>;
extern template class Triangle_energy<Surface_smoothness<5>, Surface_elements<5>, surface_smoothness_rows>;
#endif

} // namespace internal
} // namespace Quadrille

#endif
