// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_ELEMENTS_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_ELEMENTS_H

#include <Quadrille/Odeco_frame_field/internal/Restricted_unknowns.h>
#include <Quadrille/Odeco_frame_field/internal/Surface_rows.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// The triangles of a surface, and which node each corner is. Nodes are vertices; between feature curves a vertex has
/// one node on each side, since normals differ there.
struct Surface_nodes {
  std::vector<std::array<int, 3>> corners; ///< nodes, per triangle
  std::vector<int> vertex;                 ///< per node
  std::vector<Eigen::Matrix3d> axes;       ///< per node: columns span the tangent plane, and the normal
};

/// What a node's coefficients q should be, weakly: projector q = offset.
template <int N> struct Weak_target {
  Eigen::Matrix<double, N, N> projector = Eigen::Matrix<double, N, N>::Zero();
  Eigen::Matrix<double, N, 1> offset = Eigen::Matrix<double, N, 1>::Zero();
  double share = 0; ///< of all weakly constrained edges, by length
};

/// The axes in which a triangle is computed: its first edge, across, its normal.
inline Eigen::Matrix3d triangle_axes(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r)
{
  Eigen::Matrix3d axes;
  axes.col(0) = (q - p).normalized();
  axes.col(2) = (q - p).cross(r - p).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

/// What the energies of a field on a surface share: as `Field_elements` in the plane, with coefficients of the tensors'
/// restrictions to the nodes' tangent planes. Values (eigenvalues) are lengths of gradients.
template <int N> class Surface_elements {
public:
  using Coefficients = typename Restricted_unknowns<N>::Coefficients;
  static constexpr int number_of_coefficients = N;
  static constexpr int max_unknowns = Restricted_unknowns<N>::max_unknowns;
  using Unknowns = typename Restricted_unknowns<N>::Unknowns;
  template <class S> using Triangle = Surface_triangle<S, N>;
  template <class S, int rows> using Value_rows = Surface_value_rows<S, N, rows>;
  template <class S, int rows> using Jacobian_rows = Surface_jacobian_rows<S, N, rows>;
  template <class S> using Gradient_rows = Surface_gradient_rows<S, N>;
  template <class S> using Normal_rows = Surface_normal_rows<S, N>;

  struct Element {
    std::array<int, 3> node;
    Eigen::Matrix3d axes;                 ///< columns; the last one is the normal
    Eigen::Matrix<double, 2, 3> gradient; ///< of the three linear shape functions, along the first two axes
    double area;
    double size; ///< local triangle size, the unit of epsilon
  };

  /// `sizes`: per triangle; `expected_log_values`, `target_weights` (or none): per node.
  Surface_elements(Surface_nodes nodes, const Indexed_triangulation& mesh, const std::vector<Eigen::Vector3d>& points,
                   const std::vector<double>& sizes, Restricted_unknowns<N> unknowns,
                   std::vector<double> expected_log_values, std::vector<double> target_weights = {},
                   Normal_value normal_value = Normal_value::mean)
      : m_normal_value(normal_value), m_nodes(std::move(nodes)), m_unknowns(std::move(unknowns)),
        m_expected_log_values(std::move(expected_log_values)), m_target_weights(std::move(target_weights))
  {
    m_elements.reserve(sizes.size());
    for (std::size_t f = 0; f < sizes.size(); ++f) {
      Element element;
      element.node = m_nodes.corners[f];
      Eigen::Vector3d p[3];
      for (std::size_t i = 0; i < 3; ++i)
        p[i] = points[std::size_t(mesh.triangle(int(f))[i])];
      element.axes = triangle_axes(p[0], p[1], p[2]);
      const double twice_area = (p[1] - p[0]).cross(p[2] - p[0]).norm();
      element.area = 0.5 * twice_area;
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d edge = element.axes.transpose() * (p[(i + 2) % 3] - p[(i + 1) % 3]);
        element.gradient.col(i) = Eigen::Vector2d(-edge.y(), edge.x()) / twice_area;
      }
      element.size = sizes[f];
      m_total_area += element.area;
      for (const int v : element.node)
        m_target_area += element.area / 3 * target_weight(std::size_t(v));
      m_is_free.push_back(m_unknowns.are_free(element.node));
      m_elements.push_back(element);
    }
  }

  std::size_t number_of_elements() const { return m_elements.size(); }
  std::size_t number_of_nodes() const { return m_unknowns.number_of_nodes(); }
  std::size_t number_of_unknowns() const { return m_unknowns.number_of_unknowns(); }
  const Element& element(std::size_t e) const { return m_elements[e]; }
  const std::array<int, 3>& corners(std::size_t e) const { return m_elements[e].node; }
  const Surface_nodes& nodes() const { return m_nodes; }
  const Restricted_unknowns<N>& unknowns() const { return m_unknowns; }
  double expected_log_value(std::size_t v) const { return m_expected_log_values[v]; }
  bool has_targets() const { return !m_target_weights.empty(); }
  double target_weight(std::size_t v) const { return has_targets() ? m_target_weights[v] : 0; }
  double total_area() const { return m_total_area; }
  /// Of the part where there are targets.
  double target_area() const { return m_target_area; }

  /// Per node, or none.
  void set_weak_targets(std::vector<Weak_target<N>> targets)
  {
    std::vector<int> n_corners(number_of_nodes(), 0);
    for (const Element& element : m_elements)
      for (const int v : element.node)
        ++n_corners[std::size_t(v)];
    for (std::size_t v = 0; v < targets.size(); ++v)
      targets[v].share /= std::max(1, n_corners[v]); // of every triangle
    m_weak_targets = std::move(targets);
  }
  bool has_weak_targets() const { return !m_weak_targets.empty(); }

  Normal_value normal_value() const { return m_normal_value; }

  int element_unknowns(std::size_t e, std::array<int, std::size_t(max_unknowns)>& index) const
  {
    return m_unknowns.element_unknowns(m_elements[e].node, index);
  }
  bool is_free(std::size_t e) const { return m_is_free[e]; }
  template <class Matrix> void restrict_columns(std::size_t e, const Matrix& by_coefficients, Matrix& by_unknowns) const
  {
    m_unknowns.restrict_columns(m_elements[e].node, by_coefficients, by_unknowns);
  }
  Coefficients coefficients(std::size_t v, const Eigen::VectorXd& x) const { return m_unknowns.coefficients(v, x); }
  void assign_coefficients(std::size_t v, const Coefficients& q, Eigen::VectorXd& x) const
  {
    m_unknowns.assign_coefficients(v, q, x);
  }

  /// The field on the elements from `first` on, as `Field_elements::load`.
  template <class S> void load(std::size_t first, int count, const Unknowns* x, Surface_triangle<S, N>& values) const
  {
    constexpr int lanes = int(sizeof(S) / sizeof(double));
    const Element* element[lanes];
    Unknowns q[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      const int i = std::min(lane, count - 1);
      const std::size_t e = first + std::size_t(i);
      element[lane] = &m_elements[e];
      q[lane] = m_is_free[e] ? x[i] : m_unknowns.corner_coefficients(m_elements[e].node, x[i]);
    }
    const auto node = [&](int lane, int k) { return std::size_t(element[lane]->node[std::size_t(k)]); };
    for (int k = 0; k < 3; ++k) {
      Eigen::Matrix3d axes[lanes];
      for (int lane = 0; lane < lanes; ++lane)
        axes[lane].noalias() = element[lane]->axes.transpose() * m_nodes.axes[node(lane, k)];
      Tuple<Space_vector<S>, 3> local;
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          local[j][i] = from_lanes<S>([&](int lane) { return axes[lane](i, j); });
      values.aligned[k] = Aligned_tensors<S, N>(local, m_normal_value);
      Tuple<S, N> coefficients;
      for (int i = 0; i < N; ++i)
        coefficients[i] = from_lanes<S>([&](int lane) { return q[lane][k * N + i]; });
      values.tensor[k] = values.aligned[k](coefficients);
      for (int a = 0; a < 2; ++a)
        values.gradient[a][k] = from_lanes<S>([&](int lane) { return element[lane]->gradient(a, k); });
      values.expected_log_value[k] = from_lanes<S>([&](int lane) { return expected_log_value(node(lane, k)); });
      values.target_weight[k] = from_lanes<S>([&](int lane) { return target_weight(node(lane, k)); });
    }
    values.is_weakly_constrained = false;
    for (int lane = 0; lane < lanes && has_weak_targets(); ++lane)
      for (int k = 0; k < 3; ++k)
        values.is_weakly_constrained = values.is_weakly_constrained || m_weak_targets[node(lane, k)].share > 0;
    for (int k = 0; k < 3 && values.is_weakly_constrained; ++k) {
      const auto target = [&](int lane) -> const Weak_target<N>& { return m_weak_targets[node(lane, k)]; };
      values.weak_share[k] = from_lanes<S>([&](int lane) { return target(lane).share; });
      for (int i = 0; i < N; ++i) {
        values.weak_offset[k][i] = from_lanes<S>([&](int lane) { return target(lane).offset[i]; });
        for (int j = 0; j < N; ++j)
          values.weak_projector[k][i][j] = from_lanes<S>([&](int lane) { return target(lane).projector(i, j); });
      }
    }
    values.area = from_lanes<S>([&](int lane) { return element[lane]->area; });
    values.root_area = square_root(values.area);
    values.size = from_lanes<S>([&](int lane) { return element[lane]->size; });
  }

private:
  Normal_value m_normal_value;
  std::vector<Element> m_elements;
  std::vector<bool> m_is_free; ///< elements
  Surface_nodes m_nodes;
  Restricted_unknowns<N> m_unknowns;
  std::vector<double> m_expected_log_values, m_target_weights;
  std::vector<Weak_target<N>> m_weak_targets; ///< shares of every triangle
  double m_total_area = 0, m_target_area = 0;
};

} // namespace internal
} // namespace Quadrille

#endif
