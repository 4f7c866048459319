// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_FIELD_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_SURFACE_FIELD_H

#include <Quadrille/Odeco_frame_field/internal/Canonical_space_position.h>
#include <Quadrille/Odeco_frame_field/internal/Surface_field_solver.h>
#include <Quadrille/Odeco_frame_field/internal/check_field_arguments.h>
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
template <int N> class Surface_field {
public:
  using Evaluator = std::function<double(std::size_t, const Gradients&)>;

  Surface_field(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector3d>& points,
                const std::vector<Constrained_halfedge>& edges, const Surface_field_options& options,
                const Evaluator& evaluator)
      : m_options(options), m_evaluator(evaluator), m_position(canonical_position(mesh, points, edges)),
        m_problem(canonical_surface(mesh, points, edges), canonical_targets()),
        m_elements(make_surface_elements<N>(m_problem, restrict_surface<N>(m_problem.constraints),
                                            options.terms_as_in_paper ? Normal_value::one : Normal_value::mean))
  {
    for (const Vertex_constraint& constraint : m_problem.constraints.of_node)
      m_result.free_corners += constraint.is_free_corner() ? 1 : 0;
  }

  Surface_field_result solve(Gradients& gradients)
  {
    const Stopwatch stopwatch;
    const Surface_field_solver<N> analyzed(
        m_problem, m_elements, weights(),
        melt_and_freeze_schedule_for(m_options.schedule, m_elements.number_of_elements()), m_options.threads,
        m_options.observer, m_options.solver);
    compute_starts(analyzed);
    choose_start();
    const Eigen::VectorXd& x = m_fields[std::size_t(m_result.chosen)];
    gradients = gradients_of(x);
    m_result.energy = m_result.starts[std::size_t(m_result.chosen)].energy;
    m_result.terms = analyzed.energy_terms(x);
    for (std::size_t f = 0; f < m_elements.number_of_elements(); ++f) {
      const Eigen::Matrix3d axes = m_position.axes() * m_elements.element(f).axes;
      const Symmetric_tensor_3 tensor(Symmetric_tensor_3::Entries(centroid_tensor(f, x).values));
      m_result.harmonics.push_back(tensor.rotated(axes).harmonics() / m_position.original_size(1));
    }
    m_result.seconds = stopwatch.seconds();
    return m_result;
  }

private:
  using Hierarchy = Field_hierarchy<Surface_level<N>>;

  Surface_weights weights() const
  {
    Surface_weights weights;
    weights.as_in_paper = m_options.terms_as_in_paper;
    weights.area = m_options.weights.area;
    weights.angle = m_options.weights.angle;
    weights.target = m_options.target_size_weight;
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

  void compute_starts(const Surface_field_solver<N>& analyzed)
  {
    const bool melts = m_options.integrable && m_options.solver == Field_solver_kind::levenberg_marquardt &&
                       !m_options.terms_as_in_paper;
    const int n_melted = melts ? m_options.starts : 0;
    m_result.starts.resize(m_options.integrable ? 2 + std::size_t(n_melted) : 1);
    m_fields.resize(m_result.starts.size());
    compute_smooth_and_relaxed_starts(analyzed);
    if (n_melted == 0)
      return;
    const Hierarchy hierarchy(m_problem, m_elements, m_options.schedule,
                              [this](const Surface_level<N>& level, const Melt_and_freeze_schedule& schedule) {
                                return std::make_unique<Surface_field_solver<N>>(
                                    level.mesh, level.elements, weights(), schedule, m_options.threads,
                                    m_options.observer, Field_solver_kind::levenberg_marquardt);
                              });
    const int at_once = int(std::clamp<std::size_t>(triangles_at_once / m_elements.number_of_elements(), 1, 1000));
    const int start_threads = m_options.threads > 0 ? std::min(m_options.threads, at_once) : at_once;
    parallel_for(
        std::size_t(n_melted), start_threads,
        [&](std::size_t i) { compute_melted_start(i, analyzed, start_threads > 1 ? 1 : m_options.threads, hierarchy); },
        1);
  }

  void compute_smooth_and_relaxed_starts(const Surface_field_solver<N>& analyzed)
  {
    Surface_field_solver<N> solver(analyzed, m_options.threads);
    const Stopwatch smooth_watch;
    m_fields[0] = solver.smooth_field();
    Field_start start;
    start.iterations = solver.iterations();
    finish_start(0, start, solver, smooth_watch);
    if (!m_options.integrable)
      return;

    const Stopwatch relaxed_watch;
    m_fields[1] = m_fields[0];
    solver.integrate(m_fields[1]);
    start.kind = Field_start::Kind::relaxed;
    start.iterations = solver.iterations() - start.iterations;
    finish_start(1, start, solver, relaxed_watch);
  }

  void compute_melted_start(std::size_t i, const Surface_field_solver<N>& analyzed, int threads,
                            const Hierarchy& hierarchy)
  {
    const Stopwatch watch;
    Surface_field_solver<N> solver(analyzed, threads);
    Field_start start;
    start.kind = Field_start::Kind::melted;
    start.seed = m_options.seed + i;
    m_fields[i + 2] = hierarchy.empty() ? solver.melt_and_freeze(m_fields[0], start.seed)
                                        : hierarchy.melt_and_freeze(start.seed, m_elements, solver, start.iterations);
    start.iterations += solver.iterations();
    finish_start(i + 2, start, solver, watch);
  }

  void finish_start(std::size_t i, Field_start start, const Surface_field_solver<N>& solver, const Stopwatch& watch)
  {
    start.energy = solver.integrability_energy(m_fields[i]);
    const auto parts = solver.energy_parts(m_fields[i]);
    start.energy_lie = parts.lie;
    start.energy_odeco = parts.odeco;
    const Gradients gradients = std::isfinite(start.energy) ? gradients_of(m_fields[i]) : Gradients();
    start.valid = !gradients.empty();
    start.cost = std::numeric_limits<double>::infinity();
    if (start.valid) {
      start.size_deviation = size_deviation(m_fields[i]);
      start.cost = (m_evaluator ? m_evaluator(i, gradients) : start.energy) +
                   m_options.size_deviation_weight * start.size_deviation;
    }
    start.seconds = watch.seconds();
    m_result.starts[i] = start;
  }

  void choose_start()
  {
    m_result.chosen = best_start(m_result.starts);
    for (const Field_start& start : m_result.starts)
      m_result.iterations += start.iterations;
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

  /// Per face, the gradients in the triangle's axes: of the restriction of the tensor at the centroid to its plane;
  /// surface, 4.2.7. Near singularities, where tensors are not odeco, the nearest directions with the area of the
  /// tensor itself, as in the plane. Empty if a length is not positive.
  std::vector<Orthogonal_frame_2> face_frames(const Eigen::VectorXd& x) const
  {
    std::vector<Orthogonal_frame_2> frames(m_elements.number_of_elements());
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const Space_tensor<double> t = centroid_tensor(f, x);
      const Circular_harmonics q =
          Symmetric_tensor_2(Symmetric_tensor_2::Entries(t[0], t[1], t[3], t[6], t[10])).harmonics();
      frames[f] = recover_frame(q);
      const double area = frame_area(q);
      if (!(frames[f].size_u > 0) || !(frames[f].size_v > 0) || !(area > 0))
        return {};
      const double scale = std::sqrt(area / (frames[f].size_u * frames[f].size_v));
      frames[f].size_u *= scale;
      frames[f].size_v *= scale;
    }
    return frames;
  }

  double size_deviation(const Eigen::VectorXd& x) const
  {
    double sum = 0;
    const std::vector<Orthogonal_frame_2> frames = face_frames(x);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const auto& element = m_elements.element(f);
      double log_ratio = 0.5 * std::log(frames[f].size_u * frames[f].size_v);
      for (const int v : element.node)
        log_ratio -= m_elements.expected_log_value(std::size_t(v)) / 3;
      sum += element.area * log_ratio * log_ratio;
    }
    return sum / m_elements.total_area();
  }

  Gradients gradients_of(const Eigen::VectorXd& x) const
  {
    Gradients pairs;
    for (const Orthogonal_frame_2& frame : face_frames(x))
      pairs.emplace_back(frame.direction * frame.size_u / m_position.original_size(1),
                         frame.normal() * frame.size_v / m_position.original_size(1));
    return pairs;
  }

  const Surface_field_options& m_options;
  const Evaluator& m_evaluator;
  Surface_field_result m_result;
  Canonical_space_position m_position;
  Surface_problem m_problem; ///< in the canonical position
  Surface_elements<N> m_elements;
  std::vector<Eigen::VectorXd> m_fields; ///< by start
};

/// Where the surface is given: rounded coordinates would hide what is degenerate.
inline void check_surface(const Indexed_triangulation& mesh, const std::vector<Eigen::Vector3d>& points)
{
  for (std::size_t v = 0; v < points.size(); ++v)
    if (!points[v].allFinite())
      throw Invalid_input_error("vertex " + std::to_string(v) + " has a coordinate that is not a finite number");
  for (int f = 0; f < mesh.number_of_faces(); ++f) {
    const auto& t = mesh.triangle(f);
    const Eigen::Vector3d a = points[std::size_t(t[1])] - points[std::size_t(t[0])],
                          b = points[std::size_t(t[2])] - points[std::size_t(t[0])];
    const double rounding = 1e-14;
    if (!(twice_area(a, b) > rounding * std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()})))
      throw Invalid_input_error("triangle " + std::to_string(f) + " has no area; remove it, or move its corners apart");
  }
}

/// See `odeco_surface_field`.
inline Surface_field_result solve_surface_field(const Indexed_triangulation& mesh,
                                                const std::vector<Eigen::Vector3d>& points,
                                                const std::vector<Constrained_halfedge>& edges,
                                                const Surface_field_options& options,
                                                const Surface_field<5>::Evaluator& evaluator, Gradients& gradients)
{
  if (mesh.number_of_faces() == 0)
    throw Invalid_input_error("the surface has no triangles");
  check_prescribed_sizes(edges, options.isotropic);
  check_target_sizes(options.target_size, options.target_size_weight);
  check_schedule(options.schedule, options.starts, options.threads);
  if (!options.target_size.empty() && options.target_size.size() != points.size())
    throw Invalid_argument_error("there are " + std::to_string(options.target_size.size()) + " target sizes for " +
                                 std::to_string(points.size()) + " vertices");
  if (!(options.typical_size >= 0) || !std::isfinite(options.typical_size))
    throw Invalid_argument_error("the typical size must be positive and finite (0 lets it be chosen)");
  for (const double weight : {options.weights.odeco, options.weights.area, options.weights.angle})
    if (!(weight >= 0) || !std::isfinite(weight))
      throw Invalid_argument_error("the weights of energies must not be negative");
  check_surface(mesh, points);
  if (options.isotropic)
    return Surface_field<3>(mesh, points, edges, options, evaluator).solve(gradients);
  return Surface_field<5>(mesh, points, edges, options, evaluator).solve(gradients);
}

} // namespace internal
} // namespace Quadrille

#endif
