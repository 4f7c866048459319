// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUAD_SMOOTHER_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUAD_SMOOTHER_H

#include <Quadrille/Element_least_squares.h>
#include <Quadrille/Quad_extraction/internal/Quad_checks.h>
#include <Quadrille/Quad_extraction/internal/Quad_shape_term.h>
#include <Quadrille/Quad_smoothing_options.h>
#include <Quadrille/minimize_least_squares.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Untangles and smooths an `Indexed_quads` mesh.
class Quad_smoother {
public:
  using Point = Indexed_quads::Point;
  using Motion = Quad_shape_term::Motion;

  Quad_smoother(Indexed_quads& quads, const Quad_smoothing_options& options) : m_quads(quads), m_options(options)
  {
    double sum = 0;
    for (const auto& target : quads.target)
      sum += target[0] + target[1];
    m_unit = std::exp2(std::round(std::log2(sum / (2 * double(quads.target.size())))));
  }

  /// Vertices on curves slide; then they are put on the polylines (where `project(curve, point)` takes them, if the
  /// quads stay valid), and the others adapt.
  template <class Projector> Quad_smoothing_report run(const Projector& project)
  {
    fit_targets_to_area();
    optimize(motions(true), m_options.max_iterations);
    const std::vector<Point> smooth = m_quads.points;
    for (int v = 0; v < size_of(m_quads.vertices); ++v)
      if (at(m_quads.vertices, v).chain >= 0)
        at(m_quads.points, v) =
            at(m_quads.curves, at(m_quads.vertices, v).chain).point(at(m_quads.vertices, v).position);
    project_onto_curves(project);
    if (is_changed(smooth))
      optimize(motions(false), m_options.max_iterations);
    return m_report;
  }

private:
  std::vector<Motion> motions(bool slide) const
  {
    std::vector<Motion> motion;
    for (const Indexed_quads::Vertex& vertex : m_quads.vertices)
      motion.push_back(!vertex.constrained          ? Motion::free
                       : vertex.chain >= 0 && slide ? Motion::on_curve
                                                    : Motion::fixed);
    return motion;
  }

  /// Have vertices moved by more than a small part of the quads' sizes, or quads become inverted?
  bool is_changed(const std::vector<Point>& before) const
  {
    constexpr double small = 1e-3;
    for (int q = 0; q < size_of(m_quads.quads); ++q) {
      const std::array<double, 2>& target = at(m_quads.target, q);
      for (const int v : at(m_quads.quads, q))
        if ((at(m_quads.points, v) - at(before, v)).norm() > small * std::min(target[0], target[1]))
          return true;
      if (!is_convex(m_quads.points, at(m_quads.quads, q)))
        return true;
    }
    return false;
  }

  /// Only the ratios of the targets are given by the map once the counts are fixed.
  void fit_targets_to_area()
  {
    double wanted = 0;
    double actual = 0;
    for (std::size_t q = 0; q < m_quads.quads.size(); ++q) {
      wanted += m_quads.target[q][0] * m_quads.target[q][1];
      const auto& quad = m_quads.quads[q];
      const Point diagonal = at(m_quads.points, quad[2]) - at(m_quads.points, quad[0]);
      const Point other = at(m_quads.points, quad[3]) - at(m_quads.points, quad[1]);
      actual += 0.5 * (diagonal.x() * other.y() - diagonal.y() * other.x());
    }
    if (!(actual > 0))
      throw Invalid_input_error("the quads to be smoothed are not oriented counterclockwise");
    const double factor = std::sqrt(actual / wanted);
    for (auto& target : m_quads.target)
      target = {factor * target[0], factor * target[1]};
  }

  void optimize(const std::vector<Motion>& motion, int max_iterations)
  {
    if (!untangle(motion))
      return;
    Quad_shape_term term(m_quads, motion, m_unit, m_options.size_weight, m_options.angle_weight);
    if (term.number_of_unknowns() == 0)
      return;
    Eigen::VectorXd x = term.unknowns();
    Element_least_squares<Quad_shape_term> problem(term, std::size_t(term.number_of_unknowns()), m_options.threads);
    Levenberg_marquardt_options options = minimizer_options();
    options.relative_decrease = m_options.relative_decrease;
    options.max_iterations = max_iterations;
    const Minimization_report report = minimize_levenberg_marquardt(problem, x, options);
    m_report.iterations += report.iterations;
    m_report.energy = report.energy;
    term.store(x, m_quads);
  }

  Levenberg_marquardt_options minimizer_options() const
  {
    Levenberg_marquardt_options options;
    options.observer = m_options.observer;
    options.stage = "mesh";
    return options;
  }

  /// Makes all corners positive, if need be, by moving only vertices near inverted quads, in growing neighbourhoods:
  /// there the few inverted quads dominate the energy. Returns false, and moves nothing, if that does not help.
  bool untangle(const std::vector<Motion>& motion)
  {
    for (int rings = 3;; rings *= 2) {
      Indexed_quads local = m_quads;
      const bool everything = select_around_inverted(motion, rings, local);
      if (local.quads.empty() || untangle(local, motion_inside(local, motion)))
        return true;
      if (everything)
        return false;
    }
  }

  /// Leaves the quads within `rings` rings around those with corners that are not positive. Returns whether this is
  /// all.
  bool select_around_inverted(const std::vector<Motion>& motion, int rings, Indexed_quads& local) const
  {
    const Quad_shape_term term(m_quads, motion, m_unit, 1, 0);
    const Eigen::VectorXd x = term.unknowns();
    std::vector<char> selected(m_quads.quads.size(), 0);
    for (std::size_t q = 0; q < selected.size(); ++q)
      selected[q] = term.min_determinant(q, x) > 0 ? 0 : 1;
    for (int ring = 0; ring < rings; ++ring) {
      std::vector<char> touched(m_quads.vertices.size(), 0);
      for (std::size_t q = 0; q < selected.size(); ++q)
        if (selected[q])
          for (const int v : m_quads.quads[q])
            at(touched, v) = 1;
      for (std::size_t q = 0; q < selected.size(); ++q)
        for (const int v : m_quads.quads[q])
          selected[q] = selected[q] || at(touched, v) ? 1 : 0;
    }
    local.quads.clear();
    local.target.clear();
    for (std::size_t q = 0; q < selected.size(); ++q)
      if (selected[q]) {
        local.quads.push_back(m_quads.quads[q]);
        local.target.push_back(m_quads.target[q]);
      }
    return local.quads.size() == m_quads.quads.size();
  }

  /// Vertices that have quads outside `local` are kept.
  std::vector<Motion> motion_inside(const Indexed_quads& local, std::vector<Motion> motion) const
  {
    std::vector<int> quads_elsewhere(motion.size(), 0);
    for (const auto& quad : m_quads.quads)
      for (const int v : quad)
        ++at(quads_elsewhere, v);
    for (const auto& quad : local.quads)
      for (const int v : quad)
        --at(quads_elsewhere, v);
    for (std::size_t v = 0; v < motion.size(); ++v)
      if (quads_elsewhere[v] > 0)
        motion[v] = Motion::fixed;
    return motion;
  }

  /// Lowers eps by the rule of Garanzha et al. (2021, Section 3) until all corners of `local` are positive.
  bool untangle(const Indexed_quads& local, const std::vector<Motion>& motion)
  {
    Quad_shape_term term(local, motion, m_unit, m_options.size_weight, m_options.angle_weight);
    if (term.number_of_unknowns() == 0)
      return false;
    Eigen::VectorXd x = term.unknowns();
    Element_least_squares<Quad_shape_term> problem(term, std::size_t(term.number_of_unknowns()), m_options.threads);
    Levenberg_marquardt_options options = minimizer_options();
    options.max_iterations = m_options.untangling_iterations;
    options.relative_decrease = 1e-4;
    double eps = 1;
    for (int i = 0; i < m_options.untangling_rounds; ++i) {
      term.set_eps(eps);
      const Minimization_report report = minimize_levenberg_marquardt(problem, x, options);
      m_report.untangling_iterations += report.iterations;
      const double least = term.min_determinant(x);
      if (least > 0) {
        term.store(x, m_quads);
        return true;
      }
      const double decrease = std::max(1 - report.energy / report.initial_energy, 0.1);
      const double root = std::sqrt(least * least + eps * eps);
      eps *= 1 - decrease * root / (std::abs(least) + root);
    }
    return false;
  }

  /// Moves vertices one after another, each only if its quads keep positive corners.
  template <class Projector> void project_onto_curves(const Projector& project)
  {
    std::vector<std::vector<int>> quads_of(m_quads.vertices.size());
    for (int q = 0; q < size_of(m_quads.quads); ++q)
      for (const int v : at(m_quads.quads, q))
        if (at(m_quads.vertices, v).chain >= 0)
          at(quads_of, v).push_back(q);
    for (int v = 0; v < size_of(m_quads.vertices); ++v) {
      if (at(m_quads.vertices, v).chain < 0)
        continue;
      const Point before = at(m_quads.points, v);
      const Point after = project(at(m_quads.curves, at(m_quads.vertices, v).chain).curve(), before);
      if (after == before)
        continue;
      at(m_quads.points, v) = after;
      const bool valid = std::all_of(at(quads_of, v).begin(), at(quads_of, v).end(),
                                     [this](int q) { return is_convex(m_quads.points, at(m_quads.quads, q)); });
      if (!after.allFinite() || !valid) {
        at(m_quads.points, v) = before;
        ++m_report.unprojected_vertices;
      }
    }
  }

  Indexed_quads& m_quads;
  Quad_smoothing_options m_options;
  double m_unit = 1;
  Quad_smoothing_report m_report;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
