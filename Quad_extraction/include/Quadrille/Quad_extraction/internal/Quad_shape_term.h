// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUAD_SHAPE_TERM_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUAD_SHAPE_TERM_H

#include <Quadrille/Quad_extraction/internal/Quad_ground.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// From one vertex of a curve to the next one; a vertex -1 is an end of the curve.
struct Curve_step {
  int source = -1;
  int target = -1;
  double offset =
      0; ///< arc length of the curve's end or turn, to be added to that of the target minus that of the source
  double length = 1; ///< what is wanted
};

/// The untangling energy of quads with rectangular target shapes, as a `LeastSquaresTerm` with one element per quad and
/// one per step on a curve.
///
/// For each corner of a quad, J is the linear map that takes the target's corner to the actual one, det its
/// determinant and chi = (det + sqrt(eps^2 + det^2)) / 2 its regularised value. Garanzha et al., "Foldover-free maps in
/// 50 lines of code" (2021), minimise (|J|^2 + theta (1 + det^2)) / chi. Since |J|^2 = (J00 - J11)^2 + (J01 + J10)^2 +
/// 2 det and 1 + det^2 = (1 - det)^2 + 2 det, that is, up to 2 (1 + theta) det / chi (constant for eps = 0, and
/// dropping it penalises inverted corners more), the sum of squares of (J00 - J11, J01 + J10, sqrt(theta) (1 - det)) /
/// sqrt(chi): residuals that vanish for the target shape, so that Gauss-Newton steps converge fast. A fourth one,
/// sqrt(omega) (column 0 . column 1 of J) / chi, asks for right angles more than for the targets' aspect ratios.
///
/// A step of length d times the wanted one has the residual (1 - d) / sqrt(chi(d)): quads alone would let vertices that
/// are not yet in place pass each other, or leave the curve at its ends, and not find back.
///
/// Unknowns: two coordinates of a free vertex, the arc length of a vertex on a curve, none of a fixed one; all in units
/// of a given length. In space the two coordinates are those of the displacement in the vertex's tangents, and quads
/// are seen in their planes (`Quad_frames`).
template <int D> class Quad_shape_term {
public:
  static constexpr int max_residuals = 16;
  static constexpr int max_unknowns = 8;
  using Unknowns = Eigen::Matrix<double, max_unknowns, 1>;
  using Residuals = Eigen::Matrix<double, max_residuals, 1>;
  using Jacobian = Eigen::Matrix<double, max_residuals, max_unknowns>;
  using Point = Eigen::Matrix<double, D, 1>;
  using Point_in_plane = Eigen::Vector2d;

  enum class Motion : char { fixed, on_curve, free };

  /// \pre `quads` and `frames` outlive the term; `motion` by vertex. Its points are the positions of fixed vertices,
  /// and in space those from which the others are displaced. Of `steps`, those between vertices that slide count.
  Quad_shape_term(const Indexed_quads<D>& quads, const Quad_frames<D>& frames, std::vector<Motion> motion, double unit,
                  double theta, double omega, const std::vector<Curve_step>& steps = {})
      : m_quads(&quads), m_frames(&frames), m_motion(std::move(motion)), m_first(m_motion.size(), -1), m_unit(unit),
        m_sqrt_theta(std::sqrt(theta)), m_sqrt_omega(std::sqrt(omega))
  {
    std::copy_if(steps.begin(), steps.end(), std::back_inserter(m_steps),
                 [this](const Curve_step& step) { return slides(step.source) || slides(step.target); });
    for (std::size_t v = 0; v < m_motion.size(); ++v)
      if (m_motion[v] != Motion::fixed) {
        m_first[v] = m_n_unknowns;
        m_n_unknowns += m_motion[v] == Motion::free ? 2 : 1;
      }
  }

  int number_of_unknowns() const { return m_n_unknowns; }
  /// Their numbers by vertex, without the fixed ones.
  std::vector<int> unknowns_of_vertices() const
  {
    std::vector<int> numbers;
    for (const Motion motion : m_motion)
      if (motion != Motion::fixed)
        numbers.push_back(motion == Motion::free ? 2 : 1);
    return numbers;
  }
  /// eps = 0: the energy is infinite where a corner is not positive.
  void set_eps(double eps) { m_eps = eps; }
  double eps() const { return m_eps; }

  Eigen::VectorXd unknowns() const
  {
    Eigen::VectorXd x(m_n_unknowns);
    for (int v = 0; v < size_of(m_motion); ++v) {
      if (at(m_motion, v) == Motion::free)
        x.segment<2>(at(m_first, v)) = unknowns_of_free(v);
      else if (at(m_motion, v) == Motion::on_curve)
        x[at(m_first, v)] = at(m_quads->vertices, v).position / m_unit;
    }
    return x;
  }

  /// Writes positions (of vertices on curves: those on the smooth curve) and arc lengths back into a mesh.
  void store(const Eigen::VectorXd& x, Indexed_quads<D>& quads) const
  {
    for (int v = 0; v < size_of(m_motion); ++v) {
      if (at(m_motion, v) == Motion::free) {
        at(quads.points, v) = free_point(v, x.segment<2>(at(m_first, v))) * m_unit;
      } else if (at(m_motion, v) == Motion::on_curve) {
        at(quads.vertices, v).position = x[at(m_first, v)] * m_unit;
        at(quads.points, v) = on_curve(v, x[at(m_first, v)]).first * m_unit;
      }
    }
  }

  /// The least determinant of the corners of quad `q`.
  double min_determinant(std::size_t q, const Eigen::VectorXd& x) const
  {
    std::array<Point_in_plane, 4> p;
    for (std::size_t i = 0; i < 4; ++i) {
      const int v = m_quads->quads[q][i];
      const int first = at(m_first, v);
      p[i] = in_plane(q, at(m_motion, v) == Motion::free       ? free_point(v, x.segment<2>(first))
                         : at(m_motion, v) == Motion::on_curve ? on_curve(v, x[first]).first
                                                               : Point(at(m_quads->points, v) / m_unit));
    }
    double least = corner(q, 0, p).determinant();
    for (std::size_t i = 1; i < 4; ++i)
      least = std::min(least, corner(q, i, p).determinant());
    return least;
  }

  /// The least determinant of all corners.
  double min_determinant(const Eigen::VectorXd& x) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t q = 0; q < m_quads->quads.size(); ++q)
      least = std::min(least, min_determinant(q, x));
    return least;
  }

  /// The quads, then the steps.
  std::size_t number_of_elements() const { return m_quads->quads.size() + m_steps.size(); }

  int element_unknowns(std::size_t q, std::array<int, max_unknowns>& index) const
  {
    int n = 0;
    if (q >= m_quads->quads.size()) {
      for (const int v : step_ends(q))
        if (slides(v))
          index[std::size_t(n++)] = at(m_first, v);
      return n;
    }
    for (const int v : m_quads->quads[q])
      for (int d = 0; d < dimension(v); ++d)
        index[std::size_t(n++)] = at(m_first, v) + d;
    return n;
  }

  bool evaluate(std::size_t q, const Unknowns& x, Residuals& r, Jacobian* jacobian) const
  {
    if (q >= m_quads->quads.size())
      return evaluate_step(q, x, r, jacobian);
    std::array<Point_in_plane, 4> p;
    std::array<Point_in_plane, 4> tangent = {};
    std::array<int, 4> column = {};
    int n = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const int v = m_quads->quads[q][i];
      column[i] = n;
      if (at(m_motion, v) == Motion::free) {
        p[i] = in_plane(q, free_point(v, x.template segment<2>(n)));
      } else if (at(m_motion, v) == Motion::on_curve) {
        const auto [point, direction] = on_curve(v, x[n]);
        p[i] = in_plane(q, point);
        tangent[i] = in_plane(q, direction);
      } else {
        p[i] = in_plane(q, at(m_quads->points, v) / m_unit);
      }
      n += dimension(v);
    }
    if (jacobian)
      jacobian->setZero();
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Matrix2d J = corner(q, i, p);
      const double det = J.determinant();
      const double root = std::sqrt(m_eps * m_eps + det * det);
      if (m_eps == 0 && !(det > 0))
        return false;
      const double chi = regularised(det, root);
      const double scale = 0.5 / std::sqrt(chi); // four corners share a quad's weight
      const double angle_scale = 0.5 * m_sqrt_omega / chi;
      const Eigen::Vector4d residual(scale * (J(0, 0) - J(1, 1)), scale * (J(0, 1) + J(1, 0)),
                                     scale * m_sqrt_theta * (1 - det), angle_scale * J.col(0).dot(J.col(1)));
      const int row = 4 * static_cast<int>(i);
      r.template segment<4>(row) = residual;
      if (!jacobian)
        continue;
      // d(chi) / d(det) = chi / root, and the residuals are proportional to chi^(-1/2), the last one to 1 / chi.
      const Eigen::Vector4d chi_rate = residual.cwiseProduct(Eigen::Vector4d(0.5, 0.5, 0.5, 1)) / root;
      const auto add = [&](std::size_t corner_index, const Eigen::Matrix<double, 4, 2>& derivative) {
        const int v = m_quads->quads[q][corner_index];
        if (at(m_motion, v) == Motion::free)
          jacobian->template block<4, 2>(row, column[corner_index]) += by_unknowns(q, v, derivative);
        else if (at(m_motion, v) == Motion::on_curve)
          jacobian->template block<4, 1>(row, column[corner_index]) += derivative * tangent[corner_index];
      };
      const std::array<double, 2> lengths = sides(q, i);
      Eigen::Matrix<double, 4, 2> by_next; // derivative by the other end of the side that leaves the corner
      by_next << scale, 0, 0, scale, -scale * m_sqrt_theta * J(1, 1), scale * m_sqrt_theta * J(0, 1),
          angle_scale * J(0, 1), angle_scale * J(1, 1);
      by_next -= chi_rate * Eigen::RowVector2d(J(1, 1), -J(0, 1));
      by_next /= lengths[0];
      Eigen::Matrix<double, 4, 2> by_previous;
      by_previous << 0, -scale, scale, 0, scale * m_sqrt_theta * J(1, 0), -scale * m_sqrt_theta * J(0, 0),
          angle_scale * J(0, 0), angle_scale * J(1, 0);
      by_previous -= chi_rate * Eigen::RowVector2d(-J(1, 0), J(0, 0));
      by_previous /= lengths[1];
      add((i + 1) % 4, by_next);
      add((i + 3) % 4, by_previous);
      add(i, -by_next - by_previous);
    }
    return true;
  }

private:
  Eigen::Vector2d unknowns_of_free(int v) const
  {
    if constexpr (D == 2)
      return at(m_quads->points, v) / m_unit;
    else
      return Eigen::Vector2d::Zero();
  }

  /// In units.
  Point free_point(int v, const Eigen::Vector2d& x) const
  {
    if constexpr (D == 2)
      return x;
    else
      return at(m_quads->points, v) / m_unit + at(m_frames->tangent, v) * x;
  }

  Point_in_plane in_plane([[maybe_unused]] std::size_t q, const Point& p) const
  {
    if constexpr (D == 2)
      return p;
    else
      return m_frames->plane[q] * p;
  }

  /// From derivatives by the position in the quad's plane to those by the unknowns of free vertex `v`.
  Eigen::Matrix<double, 4, 2> by_unknowns([[maybe_unused]] std::size_t q, [[maybe_unused]] int v,
                                          const Eigen::Matrix<double, 4, 2>& by_position) const
  {
    if constexpr (D == 2)
      return by_position;
    else
      return by_position * (m_frames->plane[q] * at(m_frames->tangent, v));
  }

  /// chi, for root = sqrt(eps^2 + det^2).
  double regularised(double det, double root) const
  {
    return det > 0 ? (det + root) / 2 : m_eps * m_eps / (2 * (root - det));
  }

  bool slides(int v) const { return v >= 0 && at(m_motion, v) == Motion::on_curve; }

  std::array<int, 2> step_ends(std::size_t element) const
  {
    const Curve_step& step = m_steps[element - m_quads->quads.size()];
    return {step.source, step.target};
  }

  bool evaluate_step(std::size_t element, const Unknowns& x, Residuals& r, Jacobian* jacobian) const
  {
    const Curve_step& step = m_steps[element - m_quads->quads.size()];
    int n = 0;
    const auto position = [&](int v) {
      return slides(v) ? x[n++] : v >= 0 ? at(m_quads->vertices, v).position / m_unit : 0;
    };
    const double start = position(step.source);
    const double length = step.length / m_unit;
    const double d = (position(step.target) - start + step.offset / m_unit) / length;
    const double root = std::sqrt(m_eps * m_eps + d * d);
    if (m_eps == 0 && !(d > 0))
      return false;
    const double scale = 1 / std::sqrt(regularised(d, root));
    r.setZero();
    r[0] = scale * (1 - d);
    if (!jacobian)
      return true;
    jacobian->setZero();
    const double rate = -(scale + 0.5 * r[0] / root) / length;
    n = 0;
    if (slides(step.source))
      (*jacobian)(0, n++) = -rate;
    if (slides(step.target))
      (*jacobian)(0, n) = rate;
    return true;
  }

  int dimension(int v) const
  {
    return at(m_motion, v) == Motion::free ? 2 : at(m_motion, v) == Motion::on_curve ? 1 : 0;
  }

  std::pair<Point, Point> on_curve(int v, double position) const
  {
    auto [point, tangent] = at(m_quads->curves, at(m_quads->vertices, v).chain).smooth(position * m_unit);
    return {point / m_unit, tangent};
  }

  /// Target lengths, in units, of the side that leaves corner `i` and of the one that arrives there.
  std::array<double, 2> sides(std::size_t q, std::size_t i) const
  {
    const std::array<double, 2>& target = m_quads->target[q];
    return {target[i % 2] / m_unit, target[1 - i % 2] / m_unit};
  }

  Eigen::Matrix2d corner(std::size_t q, std::size_t i, const std::array<Point_in_plane, 4>& p) const
  {
    const std::array<double, 2> lengths = sides(q, i);
    Eigen::Matrix2d J;
    J.col(0) = (p[(i + 1) % 4] - p[i]) / lengths[0];
    J.col(1) = (p[(i + 3) % 4] - p[i]) / lengths[1];
    return J;
  }

  const Indexed_quads<D>* m_quads;
  const Quad_frames<D>* m_frames;
  std::vector<Curve_step> m_steps;
  std::vector<Motion> m_motion;
  std::vector<int> m_first; ///< by vertex: its first unknown
  int m_n_unknowns = 0;
  double m_unit;
  double m_sqrt_theta;
  double m_sqrt_omega;
  double m_eps = 0;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
