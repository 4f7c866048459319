// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_RESTRICTIONS_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_RESTRICTIONS_H

#include <Quadrille/Odeco_frame_field/internal/Surface_elements.h>
#include <Quadrille/Odeco_frame_field/internal/vertex_restrictions.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>

#include <array>
#include <cmath>
#include <complex>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// What constrained edges ask of the nodes of a surface.
struct Surface_constraints {
  Surface_nodes nodes;
  std::vector<Vertex_constraint> of_node; ///< angles in the node's tangent plane; "sizes" are lengths of gradients
  /// The vectors of a node's frame, 2 per node, are numbered 2 v and 2 v + 1. Along a feature curve both sides have the
  /// same length, so vectors come in classes with one length each; here every vector's class.
  std::vector<int> class_of;
  std::vector<Vertex_constraint::Vector_size> of_class;
  /// What weakly constrained edges ask for, and half the length of those around the node; empty if there are none.
  std::vector<Vertex_constraint> weak_of_node;
  std::vector<double> weak_length;
};

/// Splits vertices between feature curves, and collects what the curves ask for.
class Surface_constraint_collector {
public:
  Surface_constraint_collector(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector3d>& points,
                               const std::vector<Constrained_halfedge>& edges)
      : m_mesh(mesh), m_points(points), m_edges(edges), m_is_feature(std::size_t(mesh.number_of_halfedges()), 0)
  {
    for (const Constrained_halfedge& edge : edges)
      if (edge.aligned && !edge.is_weak) {
        m_is_feature[std::size_t(edge.halfedge)] = 1;
        if (const int other = mesh.opposite(edge.halfedge); other >= 0)
          m_is_feature[std::size_t(other)] = 1;
      }
  }

  Surface_constraints collect()
  {
    make_nodes();
    m_result.of_node.resize(m_result.nodes.vertex.size());
    m_result.class_of.resize(2 * m_result.of_node.size());
    std::iota(m_result.class_of.begin(), m_result.class_of.end(), 0);
    collect_constraints(false, m_result.of_node);
    if (std::any_of(m_edges.begin(), m_edges.end(), [](const Constrained_halfedge& edge) { return edge.is_weak; })) {
      m_result.weak_of_node.resize(m_result.of_node.size());
      m_result.weak_length.resize(m_result.of_node.size(), 0);
      collect_constraints(true, m_result.weak_of_node);
      for (const Constrained_halfedge& edge : m_edges)
        if (edge.is_weak)
          for_each_side(edge, [this](int node, int halfedge, std::size_t) {
            m_result.weak_length[std::size_t(node)] += 0.5 * edge_vector(halfedge).norm();
          });
    }
    join_vectors();
    return std::move(m_result);
  }

private:
  void collect_constraints(bool weak, std::vector<Vertex_constraint>& of_node) const
  {
    for (const Constrained_halfedge& edge : m_edges)
      if (edge.aligned && edge.is_weak == weak)
        for_each_side(edge, [&](int node, int halfedge, std::size_t) {
          const std::complex<double> square = squared_direction(node, halfedge);
          of_node[std::size_t(node)].alignment += square * square;
          ++of_node[std::size_t(node)].n_aligned;
        });
    for (const Constrained_halfedge& edge : m_edges)
      if (edge.is_weak == weak)
        for_each_side(edge, [&](int node, int halfedge, std::size_t end) {
          Vertex_constraint& constraint = of_node[std::size_t(node)];
          const std::size_t along = edge.aligned ? vector_along(constraint, node, halfedge) : 0;
          if (edge.size[end].tangential > 0)
            constraint.size[along].add(1 / edge.size[end].tangential);
          if (edge.size[end].normal > 0)
            constraint.size[1 - along].add(1 / edge.size[end].normal);
        });
  }

  /// One node for every fan of triangles around a vertex between features.
  void make_nodes()
  {
    Surface_nodes& nodes = m_result.nodes;
    nodes.corners.assign(std::size_t(m_mesh.number_of_faces()), {-1, -1, -1});
    for (int v = 0; v < m_mesh.number_of_vertices(); ++v) {
      if (m_mesh.outgoing(v) < 0)
        continue;
      const int start = start_of_fan(m_mesh.outgoing(v));
      int h = start;
      do {
        if (h == start || m_is_feature[std::size_t(h)]) {
          if (!nodes.vertex.empty() && nodes.vertex.back() == v)
            finish_axes();
          nodes.vertex.push_back(v);
          nodes.axes.push_back(Eigen::Matrix3d::Zero());
          nodes.axes.back().col(0) = edge_vector(h);
        }
        nodes.corners[std::size_t(h / 3)][std::size_t(h % 3)] = int(nodes.vertex.size()) - 1;
        const Eigen::Vector3d a = edge_vector(h), b = -edge_vector(Indexed_triangulation::prev(h));
        const Eigen::Vector3d normal = a.cross(b);
        nodes.axes.back().col(2) += std::atan2(normal.norm(), a.dot(b)) * normal.normalized();
        h = m_mesh.next_around_source(h);
      } while (h >= 0 && h != start);
      finish_axes();
    }
  }

  /// Counterclockwise the fan begins at a feature, if there is one.
  int start_of_fan(int outgoing) const
  {
    int h = outgoing;
    do {
      if (m_is_feature[std::size_t(h)] || m_mesh.is_boundary(h))
        return h;
      h = m_mesh.next_around_source(h);
    } while (h >= 0 && h != outgoing);
    return outgoing;
  }

  /// From the fan's first edge and the weighted sum of normals.
  void finish_axes()
  {
    Eigen::Matrix3d& axes = m_result.nodes.axes.back();
    const double turned = 1e-6; // of the normals' weights, which are angles
    if (!(axes.col(2).norm() > turned))
      throw Invalid_input_error("vertex " + std::to_string(m_result.nodes.vertex.back()) +
                                " has no normal: the triangles around it are folded onto each other; constrain the "
                                "edges of the fold, or remove it");
    axes.col(2).normalize();
    Eigen::Vector3d along = axes.col(0) - axes.col(2).dot(axes.col(0)) * axes.col(2);
    if (!(along.norm() > turned * axes.col(0).norm()))
      along = axes.col(2).unitOrthogonal();
    axes.col(0) = along.normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
  }

  Eigen::Vector3d edge_vector(int h) const
  {
    return m_points[std::size_t(m_mesh.target(h))] - m_points[std::size_t(m_mesh.source(h))];
  }

  /// Calls `visit(node, halfedge, end)` for the nodes of both ends of an edge on both sides; `end` is 0 at the source
  /// of the edge as it was given, 1 at its target. The halfedge is one along the edge.
  template <class Visit> void for_each_side(const Constrained_halfedge& edge, const Visit& visit) const
  {
    const int other = m_mesh.opposite(edge.halfedge);
    for (const int h : {edge.halfedge, other}) {
      if (h < 0)
        continue;
      const std::size_t source_end = h == edge.halfedge ? 0 : 1;
      const int at_source = corner_node(h), at_target = corner_node(Indexed_triangulation::next(h));
      visit(at_source, h, source_end);
      visit(at_target, h, 1 - source_end);
      if (!edge.aligned || edge.is_weak)
        break; // both sides have the same nodes
    }
  }
  int corner_node(int h) const { return m_result.nodes.corners[std::size_t(h / 3)][std::size_t(h % 3)]; }

  std::complex<double> squared_direction(int node, int halfedge) const
  {
    const Eigen::Matrix3d& axes = m_result.nodes.axes[std::size_t(node)];
    const Eigen::Vector3d d = edge_vector(halfedge);
    const std::complex<double> direction(axes.col(0).dot(d), axes.col(1).dot(d));
    const double norm = std::abs(direction);
    return norm > 0 ? direction * direction / (norm * norm) : std::complex<double>(1);
  }

  /// The vector of the node's frame that is nearer to the edge.
  std::size_t vector_along(const Vertex_constraint& constraint, int node, int halfedge) const
  {
    if (!constraint.has_direction())
      return 0;
    return std::real(squared_direction(node, halfedge) * std::polar(1.0, -2 * constraint.angle())) > 0 ? 0 : 1;
  }

  /// Vectors along a curve have the same length on both of its sides, and where the surface is smooth those across too.
  void join_vectors()
  {
    const double smooth = 0.8660254037844386; // 30 degrees
    for (const Constrained_halfedge& edge : m_edges) {
      const int other = m_mesh.opposite(edge.halfedge);
      if (!edge.aligned || edge.is_weak || other < 0)
        continue;
      const int pairs[2][2] = {{corner_node(edge.halfedge), corner_node(Indexed_triangulation::next(other))},
                               {corner_node(Indexed_triangulation::next(edge.halfedge)), corner_node(other)}};
      for (const auto& [a, b] : pairs) {
        const Vertex_constraint &at_a = m_result.of_node[std::size_t(a)], &at_b = m_result.of_node[std::size_t(b)];
        if (!at_a.has_direction() || !at_b.has_direction())
          continue;
        const std::size_t i = vector_along(at_a, a, edge.halfedge), j = vector_along(at_b, b, edge.halfedge);
        join(2 * a + int(i), 2 * b + int(j));
        if (m_result.nodes.axes[std::size_t(a)].col(2).dot(m_result.nodes.axes[std::size_t(b)].col(2)) > smooth)
          join(2 * a + 1 - int(i), 2 * b + 1 - int(j));
      }
    }
    m_result.of_class.resize(m_result.class_of.size());
    for (std::size_t i = 0; i < m_result.class_of.size(); ++i) {
      m_result.class_of[i] = root(int(i));
      m_result.of_class[std::size_t(m_result.class_of[i])].add(m_result.of_node[i / 2].size[i % 2]);
    }
  }
  int root(int i)
  {
    while (m_result.class_of[std::size_t(i)] != i)
      i = m_result.class_of[std::size_t(i)] = m_result.class_of[std::size_t(m_result.class_of[std::size_t(i)])];
    return i;
  }
  void join(int i, int j)
  {
    const int a = root(i), b = root(j);
    m_result.class_of[std::size_t(std::max(a, b))] = std::min(a, b);
  }

  const Indexed_triangulation& m_mesh;
  const std::vector<Eigen::Vector3d>& m_points;
  const std::vector<Constrained_halfedge>& m_edges;
  std::vector<char> m_is_feature; ///< halfedges
  Surface_constraints m_result;
};

/// The unknowns of a field under these constraints. Both vectors of an isotropic frame are of one class.
template <int N> Restricted_unknowns<N> restrict_surface(const Surface_constraints& constraints)
{
  const std::size_t n = constraints.of_node.size();
  std::vector<int> class_of = constraints.class_of;
  std::vector<Vertex_constraint::Vector_size> sizes = constraints.of_class;
  if constexpr (N == 3) { // joined here, along whole curves
    const auto root = [&](int i) {
      while (class_of[std::size_t(i)] != i)
        i = class_of[std::size_t(i)];
      return i;
    };
    for (std::size_t v = 0; v < n; ++v) {
      const int a = root(int(2 * v)), b = root(int(2 * v + 1));
      if (a != b) {
        class_of[std::size_t(std::max(a, b))] = std::min(a, b);
        sizes[std::size_t(std::min(a, b))].add(sizes[std::size_t(std::max(a, b))]);
      }
    }
    for (std::size_t i = 0; i < class_of.size(); ++i)
      class_of[i] = root(int(i));
  }
  std::vector<Vertex_restriction<N>> restrictions(n);
  std::vector<typename Restricted_unknowns<N>::Index> index(n);
  std::vector<int> unknown_of(class_of.size(), -1);
  int count = 0;
  for (std::size_t v = 0; v < n; ++v) {
    const Vertex_constraint& constraint = constraints.of_node[v];
    Vertex_restriction<N>& restriction = restrictions[v];
    if (!constraint.has_direction()) {
      if (constraint.has_size() && !constraint.is_free_corner())
        restriction = undirected_restriction<N>(constraint.mean_size());
      for (int i = 0; i < restriction.dimension; ++i)
        index[v][std::size_t(i)] = count++;
      continue;
    }
    restriction.is_free = false;
    restriction.basis.setZero();
    restriction.dimension = 0;
    int last = -1;
    for (std::size_t k = 0; k < 2; ++k) {
      Orthogonal_frame_2 frame = constrained_unit_frame(constraint);
      (k == 0 ? frame.size_v : frame.size_u) = 0;
      const auto power = Tensor_coefficients<N>::from_harmonics(odeco_harmonics(frame));
      const int c = class_of[2 * v + k];
      if (sizes[std::size_t(c)].is_consistent()) {
        restriction.offset += sizes[std::size_t(c)].value() * power;
      } else if (c == last) {
        restriction.basis.col(0) += power;
      } else {
        last = c;
        if (unknown_of[std::size_t(c)] < 0)
          unknown_of[std::size_t(c)] = count++;
        index[v][std::size_t(restriction.dimension)] = unknown_of[std::size_t(c)];
        restriction.basis.col(restriction.dimension++) = power;
      }
    }
  }
  return Restricted_unknowns<N>(std::move(restrictions), std::move(index), count);
}

/// What a node's coefficients should be, as an affine space; the node's own constraint alone, so lengths are not
/// shared.
template <int N> Vertex_restriction<N> weak_restriction(const Vertex_constraint& constraint)
{
  if (!constraint.has_direction())
    return constraint.has_size() && !constraint.is_free_corner() ? undirected_restriction<N>(constraint.mean_size())
                                                                 : Vertex_restriction<N>();
  Vertex_restriction<N> restriction;
  restriction.is_free = false;
  restriction.basis.setZero();
  restriction.dimension = 0;
  const auto add = [&](bool first, bool second, const Vertex_constraint::Vector_size& size) {
    Orthogonal_frame_2 frame = constrained_unit_frame(constraint);
    frame.size_u = first ? 1 : 0;
    frame.size_v = second ? 1 : 0;
    const auto power = Tensor_coefficients<N>::from_harmonics(odeco_harmonics(frame));
    if (size.is_consistent())
      restriction.offset += size.value() * power;
    else
      restriction.basis.col(restriction.dimension++) = power;
  };
  if constexpr (N == 3) {
    Vertex_constraint::Vector_size both = constraint.size[0];
    both.add(constraint.size[1]);
    add(true, true, both);
  } else {
    add(true, false, constraint.size[0]);
    add(false, true, constraint.size[1]);
  }
  return restriction;
}

/// The weak constraints of nodes as residuals, P (q - o) for the affine space o + B s and P = I - B B^+.
template <int N> std::vector<Weak_target<N>> weak_targets(const Surface_constraints& constraints)
{
  const double total = std::accumulate(constraints.weak_length.begin(), constraints.weak_length.end(), 0.);
  std::vector<Weak_target<N>> targets(constraints.weak_of_node.size());
  for (std::size_t v = 0; v < targets.size(); ++v) {
    if (constraints.weak_length[v] == 0)
      continue;
    const Vertex_restriction<N> restriction = weak_restriction<N>(constraints.weak_of_node[v]);
    if (restriction.is_free)
      continue;
    const Eigen::MatrixXd basis = restriction.basis.leftCols(restriction.dimension);
    targets[v].projector.setIdentity();
    if (restriction.dimension > 0)
      targets[v].projector -= basis * (basis.transpose() * basis).ldlt().solve(basis.transpose());
    targets[v].offset = targets[v].projector * restriction.offset;
    targets[v].share = constraints.weak_length[v] / total;
  }
  return targets;
}

/// As `restrict_surface`, for the octahedral fields of surface, eq. (57): all lengths are 1. They also follow weakly
/// constrained edges.
template <int N> Restricted_unknowns<N> restrict_to_octahedral(const Surface_constraints& constraints)
{
  std::vector<Vertex_restriction<N>> restrictions(constraints.of_node.size());
  for (std::size_t v = 0; v < restrictions.size(); ++v) {
    restrictions[v] = undirected_restriction<N>(1);
    const bool is_strong = constraints.of_node[v].has_direction() || constraints.weak_of_node.empty();
    const Vertex_constraint& constraint = is_strong ? constraints.of_node[v] : constraints.weak_of_node[v];
    if (constraint.has_direction()) {
      restrictions[v].dimension = 0;
      restrictions[v].offset =
          Tensor_coefficients<N>::from_harmonics(odeco_harmonics(constrained_unit_frame(constraint)));
    }
  }
  return Restricted_unknowns<N>(std::move(restrictions));
}

} // namespace internal
} // namespace Quadrille

#endif
