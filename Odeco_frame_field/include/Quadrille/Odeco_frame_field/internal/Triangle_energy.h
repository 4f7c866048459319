// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_TRIANGLE_ENERGY_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_TRIANGLE_ENERGY_H

#include <Quadrille/Element_least_squares.h>
#include <Quadrille/Support/internal/Pack.h>
#include <Quadrille/Support/internal/Tuple.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace Quadrille {
namespace internal {

/// Makes a `LeastSquaresTerm` of an energy of a field. `Elements` are those of a planar field (`Field_elements`) or of
/// one on a surface (`Surface_elements`). `Energy` derives from it and has
///
///     template <class S, class Rows> bool add_rows(const Elements::Triangle<S>& triangle, Rows& rows) const;
///
/// which hands over `rows_per_triangle` rows, or returns `false` outside the energy's domain.
template <class Energy, class Elements, int rows_per_triangle> class Triangle_energy {
  static constexpr int N = Elements::number_of_coefficients;

public:
  using Field = Elements;
  static constexpr int max_unknowns = Elements::max_unknowns;
  static constexpr int max_residuals = rows_per_triangle;
  static constexpr int batch_size = Pack::size;
  using Unknowns = typename Elements::Unknowns;
  using Residuals = Eigen::Matrix<double, max_residuals, 1>;
  using Jacobian = Eigen::Matrix<double, max_residuals, max_unknowns>;
  using Contribution = Element_contribution<max_unknowns>;

  std::size_t number_of_elements() const { return m_elements->number_of_elements(); }
  int element_unknowns(std::size_t e, std::array<int, std::size_t(max_unknowns)>& index) const
  {
    return m_elements->element_unknowns(e, index);
  }

  bool evaluate(std::size_t e, const Unknowns& x, Residuals& r, Jacobian* J) const;
  bool evaluate_batch(std::size_t first, int count, const Unknowns* x, Detail detail, Contribution* results) const;

protected:
  explicit Triangle_energy(const Elements& elements) : m_elements(&elements) {}

  const Elements& elements() const { return *m_elements; }

private:
  const Energy& energy() const { return static_cast<const Energy&>(*this); }

  template <class Rows> void keep_gradients(std::size_t first, int count, const Rows& rows, Contribution* results) const
  {
    const Pack energies = rows.energy();
    const Tuple<Pack, max_unknowns> gradients = rows.gradient();
    for (int i = 0; i < count; ++i) {
      results[i].energy = energies.lane(i);
      for (int j = 0; j < max_unknowns; ++j)
        results[i].gradient[j] = gradients[j].lane(i);
      if (!m_elements->is_free(first + std::size_t(i))) {
        const Eigen::Matrix<double, 1, max_unknowns> by_coefficients = results[i].gradient.transpose();
        Eigen::Matrix<double, 1, max_unknowns> by_unknowns;
        m_elements->restrict_columns(first + std::size_t(i), by_coefficients, by_unknowns);
        results[i].gradient = by_unknowns.transpose();
      }
    }
  }

  void keep_matrix(std::size_t e, int lane, const typename Elements::template Normal_rows<Pack>::Matrix& matrix,
                   Contribution& result) const
  {
    for (int j = 0; j < max_unknowns; ++j)
      for (int i = j; i < max_unknowns; ++i)
        result.matrix(i, j) = matrix[i][j].lane(lane);
    if (m_elements->is_free(e))
      return;
    using Matrix = typename Contribution::Matrix;
    const Matrix full = result.matrix.template selfadjointView<Eigen::Lower>();
    Matrix half;
    m_elements->restrict_columns(e, full, half);
    const Matrix transposed = half.transpose();
    m_elements->restrict_columns(e, transposed, result.matrix);
  }

  const Elements* m_elements;
};

// Defined outside of the class, so that they can be compiled separately.

template <class Energy, class Elements, int rows_per_triangle>
bool Triangle_energy<Energy, Elements, rows_per_triangle>::evaluate(std::size_t e, const Unknowns& x, Residuals& r,
                                                                    Jacobian* J) const
{
  typename Elements::template Triangle<double> triangle;
  m_elements->load(e, 1, &x, triangle);
  if (!J) {
    typename Elements::template Value_rows<double, max_residuals> rows(triangle);
    if (!energy().add_rows(triangle, rows))
      return false;
    r = Eigen::Map<const Residuals>(rows.values().values);
    return true;
  }
  typename Elements::template Jacobian_rows<double, max_residuals> rows(triangle);
  if (!energy().add_rows(triangle, rows))
    return false;
  r = Eigen::Map<const Residuals>(rows.values().values);
  Jacobian by_coefficients;
  for (int i = 0; i < max_residuals; ++i)
    by_coefficients.row(i) = Eigen::Map<const Unknowns>(rows.derivatives()[i].values).transpose();
  m_elements->restrict_columns(e, by_coefficients, *J);
  return true;
}

template <class Energy, class Elements, int rows_per_triangle>
bool Triangle_energy<Energy, Elements, rows_per_triangle>::evaluate_batch(std::size_t first, int count,
                                                                          const Unknowns* x, Detail detail,
                                                                          Contribution* results) const
{
  typename Elements::template Triangle<Pack> triangle;
  m_elements->load(first, count, x, triangle);
  if (detail == Detail::energy) {
    typename Elements::template Value_rows<Pack, max_residuals> rows(triangle);
    if (!energy().add_rows(triangle, rows))
      return false;
    const Pack twice_energy = dot(rows.values(), rows.values());
    for (int i = 0; i < count; ++i)
      results[i].energy = 0.5 * twice_energy.lane(i);
    return true;
  }
  if (detail == Detail::gradient) {
    typename Elements::template Gradient_rows<Pack> rows(triangle);
    if (!energy().add_rows(triangle, rows))
      return false;
    keep_gradients(first, count, rows, results);
    return true;
  }
  typename Elements::template Normal_rows<Pack> rows(triangle);
  if (!energy().add_rows(triangle, rows))
    return false;
  keep_gradients(first, count, rows, results);
  const auto& matrix = rows.matrix();
  for (int i = 0; i < count; ++i)
    keep_matrix(first + std::size_t(i), i, matrix, results[i]);
  return true;
}

} // namespace internal
} // namespace Quadrille

#endif
