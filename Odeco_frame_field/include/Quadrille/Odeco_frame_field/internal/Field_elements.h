// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_ELEMENTS_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_ELEMENTS_H

#include <Quadrille/Odeco_frame_field/internal/Metric_residual.h>
#include <Quadrille/Odeco_frame_field/internal/Residual_rows.h>
#include <Quadrille/Odeco_frame_field/internal/Restricted_unknowns.h>
#include <Quadrille/Odeco_frame_field/internal/Triangle_values.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace Quadrille {
namespace internal {

/// What is wanted at vertices without being prescribed. Empty vectors: nowhere.
struct Vertex_targets {
  std::vector<double> weight;          ///< how much the expected size is a target of the user's, 0 to 1
  std::vector<Metric_residual> metric; ///< zero where there is no metric

  Vertex_targets at(const std::vector<int>& vertices) const
  {
    Vertex_targets result;
    for (const int v : vertices) {
      if (!weight.empty())
        result.weight.push_back(weight[std::size_t(v)]);
      if (!metric.empty())
        result.metric.push_back(metric[std::size_t(v)]);
    }
    return result;
  }
};

/// What the field's energies share: triangles with their shape gradients, and the vertices' restrictions.
template <int N> class Field_elements {
public:
  using Coefficients = typename Restricted_unknowns<N>::Coefficients;
  static constexpr int number_of_coefficients = N;
  static constexpr int max_unknowns = Restricted_unknowns<N>::max_unknowns;
  using Unknowns = typename Restricted_unknowns<N>::Unknowns;
  /// What `Triangle_energy` evaluates residuals with.
  template <class S> using Triangle = Triangle_values<S, N>;
  template <class S, int rows> using Value_rows = internal::Value_rows<S, N, rows>;
  template <class S, int rows> using Jacobian_rows = internal::Jacobian_rows<S, N, rows>;
  template <class S> using Gradient_rows = internal::Gradient_rows<S, N>;
  template <class S> using Normal_rows = internal::Normal_rows<S, N>;

  struct Element {
    std::array<int, 3> vertex;
    Eigen::Matrix<double, 2, 3> gradient; ///< of the three linear shape functions
    double area;
    double root_area;
    double size; ///< local triangle size, the unit of epsilon
  };

  /// `sizes`: per face the length that multiplies the relative epsilon. Per vertex: `expected_log_values`, `targets`.
  Field_elements(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector2d>& points,
                 const std::vector<double>& sizes, std::vector<Vertex_restriction<N>> restrictions,
                 std::vector<double> expected_log_values, Vertex_targets targets = {})
      : m_unknowns(std::move(restrictions)), m_expected_log_values(std::move(expected_log_values)),
        m_targets(std::move(targets))
  {
    m_elements.reserve(std::size_t(mesh.number_of_faces()));
    for (int f = 0; f < mesh.number_of_faces(); ++f) {
      Element element;
      element.vertex = mesh.triangle(f);
      Eigen::Vector2d p[3];
      for (std::size_t i = 0; i < 3; ++i)
        p[i] = points[std::size_t(element.vertex[i])];
      const Eigen::Vector2d a = p[1] - p[0], b = p[2] - p[0];
      const double twice_area = a.x() * b.y() - a.y() * b.x();
      element.area = 0.5 * twice_area;
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector2d edge = p[(i + 2) % 3] - p[(i + 1) % 3];
        element.gradient.col(i) = Eigen::Vector2d(-edge.y(), edge.x()) / twice_area;
      }
      element.root_area = std::sqrt(element.area);
      element.size = sizes[std::size_t(f)];
      m_total_area += element.area;
      m_elements.push_back(element);
    }
    for (const Element& element : m_elements)
      m_is_free.push_back(m_unknowns.are_free(element.vertex));
    if (has_targets())
      for (const Element& element : m_elements)
        for (const int v : element.vertex)
          m_target_area += element.area / 3 * target_weight(std::size_t(v));
  }

  std::size_t number_of_elements() const { return m_elements.size(); }
  std::size_t number_of_nodes() const { return m_unknowns.number_of_nodes(); }
  std::size_t number_of_unknowns() const { return m_unknowns.number_of_unknowns(); }
  const Element& element(std::size_t e) const { return m_elements[e]; }
  const std::array<int, 3>& corners(std::size_t e) const { return m_elements[e].vertex; }
  const Vertex_restriction<N>& restriction(std::size_t v) const { return m_unknowns.restriction(v); }
  double expected_log_value(std::size_t v) const { return m_expected_log_values[v]; }
  const Vertex_targets& targets() const { return m_targets; }
  bool has_targets() const { return !m_targets.weight.empty(); }
  double target_weight(std::size_t v) const { return has_targets() ? m_targets.weight[v] : 0; }
  double total_area() const { return m_total_area; }
  /// Of the part where there are targets.
  double target_area() const { return m_target_area; }
  int first_unknown(std::size_t v) const { return m_unknowns.index(v)[0]; }

  int element_unknowns(std::size_t e, std::array<int, std::size_t(max_unknowns)>& index) const
  {
    return m_unknowns.element_unknowns(m_elements[e].vertex, index);
  }

  /// No vertex of the element is restricted.
  bool is_free(std::size_t e) const { return m_is_free[e]; }

  /// The field on the elements from `first` on, as many as `S` has lanes, with their unknowns `x`. Lanes from `count`
  /// on repeat the last element.
  template <class S> void load(std::size_t first, int count, const Unknowns* x, Triangle_values<S, N>& values) const
  {
    constexpr int lanes = int(sizeof(S) / sizeof(double));
    const Element* element[lanes];
    Unknowns q[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      const int i = std::min(lane, count - 1);
      element[lane] = &m_elements[first + std::size_t(i)];
      q[lane] = m_is_free[first + std::size_t(i)] ? x[i] : m_unknowns.corner_coefficients(element[lane]->vertex, x[i]);
    }
    const auto vertex = [&](int lane, int k) { return std::size_t(element[lane]->vertex[std::size_t(k)]); };
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < N; ++i)
        values.coefficients[k][i] = from_lanes<S>([&](int lane) { return q[lane][k * N + i]; });
      for (int a = 0; a < 2; ++a)
        values.gradient[a][k] = from_lanes<S>([&](int lane) { return element[lane]->gradient(a, k); });
      values.expected_log_value[k] = from_lanes<S>([&](int lane) { return expected_log_value(vertex(lane, k)); });
      values.target_weight[k] = from_lanes<S>([&](int lane) { return target_weight(vertex(lane, k)); });
      if (!m_targets.metric.empty())
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 4; ++j)
            values.metric_residual[k][i][j] =
                from_lanes<S>([&](int lane) { return m_targets.metric[vertex(lane, k)](i, j); });
    }
    values.root_area = from_lanes<S>([&](int lane) { return element[lane]->root_area; });
    values.size = from_lanes<S>([&](int lane) { return element[lane]->size; });
  }

  /// Derivatives by the unknowns from those by the coefficients of the corners (columns k N ... k N + N - 1).
  template <class Matrix> void restrict_columns(std::size_t e, const Matrix& by_coefficients, Matrix& by_unknowns) const
  {
    m_unknowns.restrict_columns(m_elements[e].vertex, by_coefficients, by_unknowns);
  }

  Coefficients coefficients(std::size_t v, const Eigen::VectorXd& x) const { return m_unknowns.coefficients(v, x); }
  /// The unknowns whose coefficients are nearest to the given ones.
  void assign_coefficients(std::size_t v, const Coefficients& q, Eigen::VectorXd& x) const
  {
    m_unknowns.assign_coefficients(v, q, x);
  }

private:
  std::vector<Element> m_elements;
  std::vector<bool> m_is_free; ///< elements
  Restricted_unknowns<N> m_unknowns;
  std::vector<double> m_expected_log_values;
  Vertex_targets m_targets;
  double m_total_area = 0, m_target_area = 0;
};

} // namespace internal
} // namespace Quadrille

#endif
