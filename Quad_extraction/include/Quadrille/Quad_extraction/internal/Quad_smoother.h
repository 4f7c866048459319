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
#include <limits>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Untangles and smooths an `Indexed_quads` mesh.
///
/// In space vertices move in tangent planes, and are put back onto the surface after some steps: so there are several
/// rounds of what is done once in the plane.
template <int D> class Quad_smoother {
public:
  using Point = Eigen::Matrix<double, D, 1>;
  using Motion = typename Quad_shape_term<D>::Motion;

  /// The arguments must outlive the object.
  Quad_smoother(Indexed_quads<D>& quads, const Quad_ground<D>& ground, const Quad_smoothing_options& options)
      : m_quads(quads), m_ground(ground), m_options(options)
  {
    m_ground.put_back(quads);
    double sum = 0;
    for (const auto& target : quads.target)
      sum += target[0] + target[1];
    m_unit = std::exp2(std::round(std::log2(sum / (2 * double(quads.target.size())))));
    find_steps();
  }

  /// Vertices on curves slide; then they are put on the polylines (where `project(curve, point)` takes them, if the
  /// quads stay valid), and the others adapt. Quads that cannot be untangled are left where the attempt ended.
  template <class Projector> Quad_smoothing_report run(const Projector& project)
  {
    m_frames = m_ground.frames(m_quads);
    fit_targets_to_area();
    if (!optimize(motions(true)))
      return m_report; // with vertices that cannot even slide it would be harder
    const std::vector<Point> smooth = m_quads.points;
    for (int v = 0; v < size_of(m_quads.vertices); ++v)
      if (at(m_quads.vertices, v).chain >= 0)
        at(m_quads.points, v) =
            at(m_quads.curves, at(m_quads.vertices, v).chain).point(at(m_quads.vertices, v).position);
    project_onto_curves(project);
    if (is_changed(smooth))
      optimize(motions(false));
    return m_report;
  }

private:
  using Term = Quad_shape_term<D>;

  /// The steps between neighbours on each curve. Wanted are the lengths that they have, but no very short ones.
  void find_steps()
  {
    constexpr double least = 0.1; // of the mean one
    std::vector<std::vector<int>> on_curve(m_quads.curves.size());
    for (int v = 0; v < size_of(m_quads.vertices); ++v)
      if (at(m_quads.vertices, v).chain >= 0)
        at(on_curve, at(m_quads.vertices, v).chain).push_back(v);
    for (int c = 0; c < size_of(on_curve); ++c) {
      std::vector<int>& order = at(on_curve, c);
      if (order.empty())
        continue;
      const auto position = [this](int v) { return at(m_quads.vertices, v).position; };
      std::stable_sort(order.begin(), order.end(), [&](int v, int w) { return position(v) < position(w); });
      const Polyline_curve<D>& curve = at(m_quads.curves, c);
      const double mean = curve.length() / double(order.size() + (curve.is_closed() ? 0 : 1));
      const auto add = [&](int source, int target, double offset) {
        const double length = (target < 0 ? 0 : position(target)) - (source < 0 ? 0 : position(source)) + offset;
        m_steps.push_back({source, target, offset, std::max(length, least * mean)});
      };
      for (std::size_t i = 1; i < order.size(); ++i)
        add(order[i - 1], order[i], 0);
      if (curve.is_closed()) {
        if (order.size() > 1)
          add(order.back(), order.front(), curve.length());
        continue;
      }
      add(-1, order.front(), 0);
      add(order.back(), -1, curve.length());
    }
  }

  std::vector<Motion> motions(bool slide) const
  {
    std::vector<Motion> motion;
    for (const typename Indexed_quads<D>::Vertex& vertex : m_quads.vertices)
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
      if (m_ground.is_inverted(m_quads, q))
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
      actual += 0.5 * signed_area(q, diagonal, other);
    }
    if (!(actual > 0))
      throw Invalid_input_error("the quads to be smoothed are not oriented counterclockwise");
    const double factor = std::sqrt(actual / wanted);
    for (auto& target : m_quads.target)
      target = {factor * target[0], factor * target[1]};
  }

  /// Of the parallelogram with these sides, seen in the plane of quad `q`.
  double signed_area([[maybe_unused]] std::size_t q, const Point& a, const Point& b) const
  {
    Eigen::Matrix2d sides;
    if constexpr (D == 2)
      sides << a, b;
    else
      sides << m_frames.plane[q] * a, m_frames.plane[q] * b;
    return sides.determinant();
  }

  /// Returns false if there are quads that cannot be untangled.
  bool optimize(const std::vector<Motion>& motion)
  {
    if constexpr (D == 2) {
      return optimize_in_frames(motion, m_options.max_iterations);
    } else {
      bool is_valid = false;
      for (int round = 0; round < m_options.surface_rounds; ++round) {
        const std::vector<Point> before = m_quads.points;
        is_valid = optimize_in_frames(motion, m_options.surface_iterations);
        m_ground.put_back(m_quads);
        m_frames = m_ground.frames(m_quads);
        if (!is_changed(before))
          break;
      }
      return is_valid;
    }
  }

  bool optimize_in_frames(const std::vector<Motion>& motion, int max_iterations)
  {
    if (!untangle(motion))
      return false;
    Term term(m_quads, m_frames, motion, m_unit, m_options.size_weight, m_options.angle_weight);
    if (term.number_of_unknowns() == 0)
      return true;
    Eigen::VectorXd x = term.unknowns();
    Element_least_squares<Term> problem(term, std::size_t(term.number_of_unknowns()), m_options.threads);
    Levenberg_marquardt_options options = minimizer_options();
    options.groups = term.unknowns_of_vertices();
    options.relative_decrease = m_options.relative_decrease;
    options.max_iterations = max_iterations;
    const Minimization_report report = minimize_levenberg_marquardt(problem, x, options);
    m_report.iterations += report.iterations;
    m_report.energy = report.energy;
    term.store(x, m_quads);
    return report.status != Minimization_status::outside_domain;
  }

  Levenberg_marquardt_options minimizer_options() const
  {
    Levenberg_marquardt_options options;
    options.observer = m_options.observer;
    options.stage = "mesh";
    return options;
  }

  /// Makes all corners positive, if need be, by moving only vertices near inverted quads: there the few inverted quads
  /// dominate the energy. Places that are apart are untangled one by one; where that does not help, a larger
  /// neighbourhood is tried, going on from where the last attempt ended. Returns false if that does not help, either.
  bool untangle(const std::vector<Motion>& motion)
  {
    constexpr int first_rings = 3;
    constexpr int growth = 4;
    const Term all(m_quads, m_frames, motion, m_unit, 1, 0);
    all.store(all.unknowns(), m_quads); // sliding vertices onto the smooth curves
    for (int rings = first_rings;; rings *= growth) {
      const std::vector<std::vector<int>> places = places_around_inverted(motion, rings);
      bool done = true;
      for (const std::vector<int>& place : places) {
        Indexed_quads<D> local = m_quads;
        local.quads.clear();
        local.target.clear();
        Quad_frames<D> frames = m_frames;
        if constexpr (D == 3)
          frames.plane.clear();
        for (const int q : place) {
          local.quads.push_back(at(m_quads.quads, q));
          local.target.push_back(at(m_quads.target, q));
          if constexpr (D == 3)
            frames.plane.push_back(at(m_frames.plane, q));
        }
        done = untangle(local, frames, motion_inside(local, motion)) && done;
      }
      if (done || rings * growth > m_options.max_untangling_rings)
        return done;
    }
  }

  /// The quads within `rings` rings around those with corners that are not positive, by connected sets.
  std::vector<std::vector<int>> places_around_inverted(const std::vector<Motion>& motion, int rings) const
  {
    const Term term(m_quads, m_frames, motion, m_unit, 1, 0);
    const Eigen::VectorXd x = term.unknowns();
    std::vector<int> inverted;
    for (int q = 0; q < size_of(m_quads.quads); ++q)
      if (!(term.min_determinant(std::size_t(q), x) > 0))
        inverted.push_back(q);
    std::vector<std::vector<int>> places;
    if (inverted.empty())
      return places;
    std::vector<std::vector<int>> quads_at(m_quads.vertices.size());
    for (int q = 0; q < size_of(m_quads.quads); ++q)
      for (const int v : at(m_quads.quads, q))
        at(quads_at, v).push_back(q);
    // Breadth first, `may_visit` once per quad; returns what was visited.
    const auto spread = [&](std::vector<int> found, int max_rings, const auto& may_visit) {
      std::size_t begin = 0;
      for (int ring = 0; ring < max_rings && begin < found.size(); ++ring) {
        const std::size_t end = found.size();
        for (; begin < end; ++begin)
          for (const int v : at(m_quads.quads, found[begin]))
            for (const int q : at(quads_at, v))
              if (may_visit(q))
                found.push_back(q);
      }
      return found;
    };
    std::vector<char> selected(m_quads.quads.size(), 0);
    for (const int q : inverted)
      at(selected, q) = 1;
    spread(inverted, rings, [&selected](int q) { return std::exchange(at(selected, q), char(1)) == 0; });
    for (const int q : inverted)
      if (std::exchange(at(selected, q), char(0)) != 0) {
        places.push_back(spread({q}, std::numeric_limits<int>::max(),
                                [&selected](int other) { return std::exchange(at(selected, other), char(0)) != 0; }));
        std::sort(places.back().begin(), places.back().end());
      }
    return places;
  }

  /// Vertices that have quads outside `local` are kept.
  std::vector<Motion> motion_inside(const Indexed_quads<D>& local, std::vector<Motion> motion) const
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

  /// Lowers eps by the rule of Garanzha et al. (2021, Section 3) until all corners of `local` are positive. Gives up
  /// when the least determinant has not come nearer to 0 for a while: then something is in the way that no motion of
  /// these vertices removes. (It creeps towards 0 in vain as well, because eps does; the number of rounds ends that.)
  /// Then vertices stay where they were unless fewer quads are inverted: what is not in the way should not suffer.
  bool untangle(const Indexed_quads<D>& local, const Quad_frames<D>& frames, const std::vector<Motion>& motion)
  {
    Term term(local, frames, motion, m_unit, m_options.size_weight, m_options.angle_weight, m_steps);
    if (term.number_of_unknowns() == 0)
      return false;
    Eigen::VectorXd x = term.unknowns();
    const int n_inverted = number_of_inverted(term, local, x);
    // Threads take longer to start than small places to evaluate.
    constexpr std::size_t small = 8192;
    const int threads = local.quads.size() < small ? 1 : m_options.threads;
    Element_least_squares<Term> problem(term, std::size_t(term.number_of_unknowns()), threads);
    Levenberg_marquardt_options options = minimizer_options();
    options.max_iterations = m_options.untangling_iterations;
    options.relative_decrease = 1e-4;
    options.groups = term.unknowns_of_vertices();
    // At least so much of eps goes in a round; more than the 0.1 of the source, since each round is solved well.
    constexpr double least_decrease = 0.3;
    constexpr double noticeable = 0.9;
    constexpr int patience = 12;
    double eps = 1;
    double best = -std::numeric_limits<double>::infinity();
    int stalled = 0;
    for (int i = 0; i < m_options.untangling_rounds && stalled < patience; ++i) {
      term.set_eps(eps);
      const Minimization_report report = minimize_levenberg_marquardt(problem, x, options);
      m_report.untangling_iterations += report.iterations;
      const double least = term.min_determinant(x);
      if (least > 0) {
        term.store(x, m_quads);
        return true;
      }
      stalled = least > noticeable * best ? 0 : stalled + 1;
      best = std::max(best, least);
      const double decrease = std::max(1 - report.energy / report.initial_energy, least_decrease);
      const double root = std::sqrt(least * least + eps * eps);
      eps *= 1 - decrease * root / (std::abs(least) + root);
    }
    if (number_of_inverted(term, local, x) < n_inverted)
      term.store(x, m_quads);
    return false;
  }

  static int number_of_inverted(const Term& term, const Indexed_quads<D>& quads, const Eigen::VectorXd& x)
  {
    int n = 0;
    for (std::size_t q = 0; q < quads.quads.size(); ++q)
      n += term.min_determinant(q, x) > 0 ? 0 : 1;
    return n;
  }

  /// Moves vertices one after another, each only if its quads keep positive corners; none if the border then meets
  /// itself.
  template <class Projector> void project_onto_curves(const Projector& project)
  {
    const std::vector<Point> on_polylines = m_quads.points;
    int n_moved = 0;
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
                                     [this](int q) { return !m_ground.is_inverted(m_quads, q); });
      if (!after.allFinite() || !valid) {
        at(m_quads.points, v) = before;
        ++m_report.unprojected_vertices;
      } else {
        ++n_moved;
      }
    }
    if (n_moved == 0 || Quad_checks<D>(m_quads).conflicting_border_edges().empty())
      return;
    m_quads.points = on_polylines;
    m_report.unprojected_vertices += n_moved;
  }

  Indexed_quads<D>& m_quads;
  const Quad_ground<D>& m_ground;
  Quad_frames<D> m_frames;
  Quad_smoothing_options m_options;
  double m_unit = 1;
  std::vector<Curve_step> m_steps;
  Quad_smoothing_report m_report;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
