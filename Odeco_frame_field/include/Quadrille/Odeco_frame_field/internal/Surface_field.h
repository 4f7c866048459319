// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_FIELD_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_FIELD_H

#include <Quadrille/Odeco_frame_field/internal/Canonical_space_position.h>
#include <Quadrille/Odeco_frame_field/internal/Field_run.h>
#include <Quadrille/Odeco_frame_field/internal/Surface_field_solver.h>
#include <Quadrille/Surface_field_options.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// How many equal triangles the paper's weights are meant for: about those of its models.
constexpr double triangles_of_paper_weights = 30000;

/// One run of `odeco_surface_field` on index arrays; N coefficients per node (3: isotropic frames).
template <int N> class Surface_field : public Field_run<Surface_field<N>, Surface_level<N>> {
  using Base = Field_run<Surface_field<N>, Surface_level<N>>;

public:
  Surface_field(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector3d>& points,
                const std::vector<Constrained_halfedge>& edges, const Surface_field_options& options,
                const Field_evaluator& evaluator)
      : Base(options, evaluator), m_options(options), m_position(canonical_position(mesh, points, edges)),
        m_problem(canonical_surface(mesh, points, edges), canonical_targets()),
        m_elements(make_surface_elements<N>(m_problem, restrict_surface<N>(m_problem.constraints),
                                            options.terms_as_in_paper ? Normal_value::one : Normal_value::mean))
  {
    for (const Vertex_constraint& constraint : m_problem.constraints.of_node)
      m_result.free_corners += constraint.is_free_corner() ? 1 : 0;
  }

  const Surface_problem& problem() const { return m_problem; }
  const Surface_elements<N>& elements() const { return m_elements; }
  /// Of the terms of the energy that is minimised.
  Surface_weights weights() const
  {
    Surface_weights weights;
    weights.as_in_paper = m_options.terms_as_in_paper;
    weights.area = m_options.weights.area;
    weights.angle = m_options.weights.angle;
    weights.target = m_options.target_size_weight;
    weights.weak = m_options.weak_weight;
    if (weights.as_in_paper) {
      weights.odeco = m_options.weights.odeco;
    } else {
      weights.odeco = m_options.schedule.final_epsilon;
      weights.area *= triangles_of_paper_weights / 2;
      weights.angle *= triangles_of_paper_weights / 2;
      // Where sizes are free nothing else holds them.
      const double hold = 0.03;
      weights.area = std::max(weights.area, hold);
    }
    return weights;
  }

  Surface_field_result solve(Gradients& gradients)
  {
    const Stopwatch stopwatch;
    const std::unique_ptr<Surface_field_solver<N>> analyzed = make_solver(
        m_problem, m_elements, melt_and_freeze_schedule_for(m_options.schedule, m_elements.number_of_elements()),
        m_options.solver);
    this->compute_starts(m_problem, m_elements, *analyzed, m_options.terms_as_in_paper ? 0 : m_options.starts);
    m_result.seconds = stopwatch.seconds();
    const Eigen::VectorXd& x = this->choose_start(m_result, gradients);
    m_result.terms = analyzed->energy_terms(x);
    for (std::size_t f = 0; f < m_elements.number_of_elements(); ++f) {
      const Eigen::Matrix3d axes = m_position.axes() * m_elements.element(f).axes;
      const Symmetric_tensor_3 tensor(Symmetric_tensor_3::Entries(centroid_tensor(f, x).values));
      m_result.harmonics.push_back(tensor.rotated(axes).harmonics() / m_position.original_size(1));
    }
    return m_result;
  }

private:
  friend Base;

  std::unique_ptr<Surface_field_solver<N>> make_solver(const Surface_problem& problem,
                                                       const Surface_elements<N>& elements,
                                                       const Melt_and_freeze_schedule& schedule,
                                                       Field_solver_kind kind) const
  {
    return std::make_unique<Surface_field_solver<N>>(problem, elements, weights(), schedule, m_options.threads,
                                                     m_options.observer, kind);
  }
  std::unique_ptr<Surface_field_solver<N>> make_level_solver(const Surface_level<N>& level,
                                                             const Melt_and_freeze_schedule& schedule) const
  {
    return make_solver(level.mesh, level.elements, schedule, Field_solver_kind::levenberg_marquardt);
  }

  /// Unit of length: the surface; unit of sizes: the geometric mean of the prescribed ones.
  Canonical_space_position canonical_position(const Indexed_triangulation& mesh,
                                              const std::vector<Eigen::Vector3d>& points,
                                              const std::vector<Constrained_halfedge>& edges)
  {
    double area = 0;
    for (int f = 0; f < mesh.number_of_faces(); ++f) {
      const auto& t = mesh.triangle(f);
      const Eigen::Vector3d a = points[std::size_t(t[1])] - points[std::size_t(t[0])],
                            b = points[std::size_t(t[2])] - points[std::size_t(t[0])];
      area += 0.5 * twice_area(a, b);
    }
    constexpr double default_quads = 1000;
    m_result.typical_size = m_options.typical_size > 0 ? m_options.typical_size : std::sqrt(area / default_quads);
    double log_size = 0;
    int n_sizes = 0;
    const auto count = [&](double size) {
      if (size > 0) {
        log_size += std::log(size);
        ++n_sizes;
      }
    };
    for (const Constrained_halfedge& edge : edges)
      for (const Frame_size& size : edge.size) {
        count(size.normal);
        count(size.tangential);
      }
    if (n_sizes == 0)
      std::for_each(m_options.target_size.begin(), m_options.target_size.end(), count);
    const auto& t = mesh.triangle(0);
    return {points, triangle_axes(points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])]),
            n_sizes > 0 ? std::exp(log_size / n_sizes) : m_result.typical_size};
  }

  Constrained_surface canonical_surface(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector3d>& points,
                                        std::vector<Constrained_halfedge> edges) const
  {
    std::vector<Eigen::Vector3d> canonical_points;
    for (const Eigen::Vector3d& p : points)
      canonical_points.push_back(m_position.point(p));
    for (Constrained_halfedge& edge : edges)
      for (Frame_size& size : edge.size)
        size = {m_position.size(size.normal), m_position.size(size.tangential)};
    return {mesh, std::move(canonical_points), std::move(edges)};
  }

  std::vector<double> canonical_targets() const
  {
    std::vector<double> targets = m_options.target_size;
    for (double& size : targets)
      size = m_position.size(size);
    return targets;
  }

  Space_tensor<double> centroid_tensor(std::size_t f, const Eigen::VectorXd& x) const
  {
    std::array<int, std::size_t(Surface_elements<N>::max_unknowns)> index;
    typename Surface_elements<N>::Unknowns local = Surface_elements<N>::Unknowns::Zero();
    const int count = m_elements.element_unknowns(f, index);
    for (int i = 0; i < count; ++i)
      local[i] = x[index[std::size_t(i)]];
    Surface_triangle<double, N> triangle;
    m_elements.load(f, 1, &local, triangle);
    return triangle.mean(Field_residuals<N>::centroid_weights);
  }

  /// Per face, of the restriction of the tensor at the centroid to the triangle's plane; surface, 4.2.7. Near
  /// singularities, where tensors are not odeco, the nearest directions with the area of the tensor itself, as in the
  /// plane.
  std::vector<Orthogonal_frame_2> face_frames(const Eigen::VectorXd& x) const
  {
    std::vector<Orthogonal_frame_2> frames(m_elements.number_of_elements());
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const Space_tensor<double> t = centroid_tensor(f, x);
      const Symmetric_tensor_2 restricted(Symmetric_tensor_2::Entries(t[0], t[1], t[3], t[6], t[10]));
      if (!recover_frame_of_area(restricted.harmonics(), frames[f]))
        return {};
    }
    return frames;
  }

  Gradients::value_type gradients_of(const Orthogonal_frame_2& frame) const
  {
    return {frame.direction * frame.size_u / m_position.original_size(1),
            frame.normal() * frame.size_v / m_position.original_size(1)};
  }

  const Surface_field_options& m_options;
  Surface_field_result m_result;
  Canonical_space_position m_position;
  Surface_problem m_problem; ///< in the canonical position
  Surface_elements<N> m_elements;
};

} // namespace internal
} // namespace Quadrille

#endif
