// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_REDUCED_ELEMENTS_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_REDUCED_ELEMENTS_H

#include <Quadrille/Seamless_parametrization/internal/Map_region.h>
#include <Quadrille/Seamless_parametrization/internal/Seamless_constraints.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace Quadrille {
namespace internal {

/// Coordinates of a triangle's corners: (u0, v0, u1, v1, u2, v2).
using Corner_vector = Eigen::Matrix<double, 6, 1>;
using Corner_matrix = Eigen::Matrix<double, 6, 6>;

/// Assembles functions of the triangles' corner coordinates x = C y in the free parameters y: gradients C^T g and
/// Gauss-Newton matrices C^T H C. Most triangles have six parameters, those along seams have more, without a limit.
/// The pattern and the places of all contributions in it are computed once, in O(n log n).
class Reduced_elements {
public:
  using Matrix = Eigen::SparseMatrix<double>;

  explicit Reduced_elements(const Seamless_space& space) : Reduced_elements(space, whole_map(space), Eigen::VectorXd())
  {
  }

  /// Of the faces of `region`, by their places in it, as functions of its parameters; the others keep their values.
  Reduced_elements(const Seamless_space& space, const Map_region& region, const Eigen::VectorXd& values)
      : m_n_parameters(int(region.parameters.size()))
  {
    collect_terms(space, region, values);
    build_pattern();
  }

  int number_of_parameters() const { return m_n_parameters; }
  std::size_t number_of_faces() const { return m_first_place.size() - 1; }
  const Matrix& matrix() const { return m_matrix; } ///< lower triangle
  const Eigen::VectorXd& gradient() const { return m_gradient; }

  Corner_vector corners(std::size_t f, const Eigen::VectorXd& y) const
  {
    Corner_vector x;
    for (std::size_t r = 0; r < 6; ++r) {
      double sum = m_constants[6 * f + r];
      for (std::size_t t = m_first_term[6 * f + r]; t < m_first_term[6 * f + r + 1]; ++t)
        sum += m_terms[t].coefficient * y[m_terms[t].parameter];
      x[Eigen::Index(r)] = sum;
    }
    return x;
  }

  void set_zero()
  {
    m_gradient.setZero();
    std::fill(m_matrix.valuePtr(), m_matrix.valuePtr() + m_matrix.nonZeros(), 0.0);
  }

  void add(std::size_t f, const Corner_vector& gradient, const Corner_matrix& matrix)
  {
    const Term* const begin = m_terms.data() + m_first_term[6 * f];
    const Term* const end = m_terms.data() + m_first_term[6 * f + 6];
    const int* place = m_places.data() + m_first_place[f];
    for (const Term* i = begin; i != end; ++i) {
      m_gradient[i->parameter] += i->coefficient * gradient[i->row];
      for (const Term* j = begin; j != end; ++j)
        if (j->parameter <= i->parameter)
          m_matrix.valuePtr()[*place++] += i->coefficient * matrix(i->row, j->row) * j->coefficient;
    }
  }

private:
  struct Term {
    int row; ///< 0..5
    int parameter;
    double coefficient;
  };

  void collect_terms(const Seamless_space& space, const Map_region& region, const Eigen::VectorXd& values)
  {
    std::vector<int> place(std::size_t(space.number_of_parameters), -1);
    for (std::size_t i = 0; i < region.parameters.size(); ++i)
      place[std::size_t(region.parameters[i])] = int(i);
    m_first_term.push_back(0);
    for (const int f : region.faces)
      for (int r = 0; r < 6; ++r) {
        const int row = 2 * space.copy_of_corner[std::size_t(3 * f + r / 2)] + r % 2;
        double constant = space.constant(row);
        for (const Seamless_space::Entry* e = space.begin(row); e != space.end(row); ++e) {
          const double coefficient = double(e->coefficient) / double(space.denominator);
          if (const int parameter = place[std::size_t(e->parameter)]; parameter >= 0)
            m_terms.push_back({r, parameter, coefficient});
          else
            constant += coefficient * values[e->parameter];
        }
        m_constants.push_back(constant);
        m_first_term.push_back(m_terms.size());
      }
  }

  template <class Visit> void visit_pairs(std::size_t f, const Visit& visit) const
  {
    for (std::size_t i = m_first_term[6 * f]; i < m_first_term[6 * f + 6]; ++i)
      for (std::size_t j = m_first_term[6 * f]; j < m_first_term[6 * f + 6]; ++j)
        if (m_terms[j].parameter <= m_terms[i].parameter)
          visit(m_terms[j].parameter, m_terms[i].parameter);
  }

  void build_pattern()
  {
    const std::size_t n_faces = (m_first_term.size() - 1) / 6;
    std::vector<std::vector<int>> rows_of{std::size_t(m_n_parameters)};
    for (int i = 0; i < m_n_parameters; ++i)
      rows_of[std::size_t(i)].push_back(i); // the diagonal comes first in its column
    m_first_place.assign(n_faces + 1, 0);
    for (std::size_t f = 0; f < n_faces; ++f) {
      std::size_t count = 0;
      visit_pairs(f, [&](int column, int row) {
        rows_of[std::size_t(column)].push_back(row);
        ++count;
      });
      m_first_place[f + 1] = m_first_place[f] + count;
    }
    std::size_t non_zeros = 0;
    for (std::vector<int>& rows : rows_of) {
      std::sort(rows.begin(), rows.end());
      rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
      non_zeros += rows.size();
    }
    m_matrix.resize(m_n_parameters, m_n_parameters);
    m_matrix.resizeNonZeros(Eigen::Index(non_zeros));
    int* const outer = m_matrix.outerIndexPtr();
    int* const inner = m_matrix.innerIndexPtr();
    outer[0] = 0;
    for (std::size_t column = 0; column < rows_of.size(); ++column) {
      std::copy(rows_of[column].begin(), rows_of[column].end(), inner + outer[column]);
      outer[column + 1] = outer[column] + int(rows_of[column].size());
    }
    m_places.reserve(m_first_place.back());
    for (std::size_t f = 0; f < n_faces; ++f)
      visit_pairs(f, [&](int column, int row) {
        m_places.push_back(int(std::lower_bound(inner + outer[column], inner + outer[column + 1], row) - inner));
      });
    m_gradient.resize(m_n_parameters);
    set_zero();
  }

  int m_n_parameters;
  std::vector<Term> m_terms;
  std::vector<double> m_constants;        ///< by 6 face + row
  std::vector<std::size_t> m_first_term;  ///< by 6 face + row, and the end
  std::vector<std::size_t> m_first_place; ///< by face, and the end
  std::vector<int> m_places;              ///< in the order of `visit_pairs`
  Matrix m_matrix;
  Eigen::VectorXd m_gradient;
};

} // namespace internal
} // namespace Quadrille

#endif
