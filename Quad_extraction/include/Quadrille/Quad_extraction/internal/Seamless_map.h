// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_SEAMLESS_MAP_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_SEAMLESS_MAP_H

#include <Quadrille/Quad_extraction/internal/at.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>
#include <Quadrille/exceptions.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

using Uv = std::array<double, 2>;

/// Coordinate of `p` along the axis direction `d`: 0 = +u, 1 = +v, 2 = -u, 3 = -v (any integer, modulo 4).
inline double along(int d, const Uv& p)
{
  const double x = p[std::size_t(d & 1)];
  return (d & 2) ? -x : x;
}

/// R^k p, the quarter turn R (x, y) = (-y, x).
inline Uv turned(int k, const Uv& p)
{
  switch (k & 3) {
  case 0:
    return p;
  case 1:
    return {-p[1], p[0]};
  case 2:
    return {-p[0], -p[1]};
  default:
    return {p[1], -p[0]};
  }
}

/// Sign of the orientation of (a, b, c), exact.
inline int orientation_sign(const Uv& a, const Uv& b, const Uv& c)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_2;
  return static_cast<int>(CGAL::orientation(Point(a[0], a[1]), Point(b[0], b[1]), Point(c[0], c[1])));
}

/// Change of chart across an edge: (u, v)_g = R^k (u, v)_f + t.
struct Transition {
  int k = 0;
  Uv t = {0, 0};
};

/// A triangulation with an exactly seamless map: everything that tracing asks, answered without rounding.
///
/// The transitions, the right angles around vertices and the directions of edges are derived from the corner
/// coordinates alone. At a vertex the axis directions that leave it are numbered counterclockwise by *slots*: 0, 1,
/// ..., q - 1 for an interior vertex surrounded by q right angles, 0 (the leaving border edge) to q (the arriving one)
/// on the border.
class Seamless_map {
public:
  /// \param corner_uv, halfedge_curve by halfedge; \param face_region by face. The triangulation must outlive the map.
  /// \throws Invalid_input_error, No_result_error as `extract_quads`. Complexity: linear.
  Seamless_map(const Indexed_triangulation& mesh, std::vector<Uv> corner_uv, std::vector<int> halfedge_curve,
               std::vector<int> face_region)
      : m_mesh(&mesh), m_uv(std::move(corner_uv)), m_curve(std::move(halfedge_curve)), m_region(std::move(face_region)),
        m_transition(m_uv.size())
  {
    check_common_grid();
    check_orientation();
    derive_transitions();
    check_curves();
  }

  const Indexed_triangulation& mesh() const { return *m_mesh; }
  const Uv& uv(int h) const { return at(m_uv, h); }
  /// Id of the curve that the edge lies on, or -1.
  int curve(int h) const { return at(m_curve, h); }
  bool is_constrained(int h) const { return curve(h) >= 0; }
  int region(int f) const { return at(m_region, f); }
  /// From the chart of `face(h)` to that of the face across; `h` must not be on the border.
  const Transition& transition(int h) const { return at(m_transition, h); }

  /// Direction of the axis-parallel halfedge `h` in the chart of its face.
  int edge_direction(int h) const
  {
    const Uv& a = uv(h);
    const Uv& b = uv(Indexed_triangulation::next(h));
    if (a[1] == b[1])
      return b[0] > a[0] ? 0 : 2;
    return b[1] > a[1] ? 1 : 3;
  }

  /// Axis directions within the angle of corner `h`, counterclockwise, its first side included and its last excluded.
  /// Returns how many there are: 0, 1 or 2.
  int corner_axes(int h, std::array<int, 2>& axes) const
  {
    const Uv& o = uv(h);
    const Uv& a = uv(Indexed_triangulation::next(h));
    const Uv& b = uv(Indexed_triangulation::prev(h));
    int n = 0;
    for (int d = 0; d < 4; ++d) {
      const double left_of_first = along(d + 1, o) - along(d + 1, a); // sign of cross(a - o, d)
      const double right_of_last = along(d + 1, b) - along(d + 1, o); // sign of cross(d, b - o)
      const bool after_first = left_of_first > 0 || (left_of_first == 0 && along(d, a) > along(d, o));
      if (after_first && right_of_last > 0)
        axes[std::size_t(n++)] = d;
    }
    if (n == 2 && axes[0] == 0 && axes[1] == 3)
      std::swap(axes[0], axes[1]);
    return n;
  }

  /// Right angles around vertex `v`.
  int quadrants(int v) const
  {
    int n = 0;
    for_each_slot(v, [&n](int, int, int) { ++n; });
    return n;
  }

  /// Calls `f(slot, corner, direction)` for the axis directions around `v`, the arriving border edge excluded.
  template <class Function> void for_each_slot(int v, Function f) const
  {
    int slot = 0;
    std::array<int, 2> axes = {};
    const int start = mesh().outgoing(v);
    int h = start;
    do {
      const int n = corner_axes(h, axes);
      for (int i = 0; i < n; ++i)
        f(slot++, h, at(axes, i));
      h = mesh().next_around_source(h);
    } while (h >= 0 && h != start);
  }

  /// Slot of direction `d`, which lies within the (closed) angle of corner `h`.
  int slot(int h, int d) const
  {
    d &= 3;
    int found = -1;
    int n = 0;
    for_each_slot(mesh().source(h), [&](int s, int corner, int direction) {
      n = s + 1;
      if (corner == h && direction == d)
        found = s;
    });
    if (found >= 0)
      return found;
    const int last_side = Indexed_triangulation::prev(h); // the direction runs along the corner's last side
    if (mesh().is_boundary(last_side))
      return n;
    return slot(mesh().opposite(last_side), d + transition(last_side).k);
  }

private:
  static std::string name(int h, const Indexed_triangulation& mesh)
  {
    return "halfedge " + std::to_string(h) + " (triangle " + std::to_string(h / 3) + ", from vertex " +
           std::to_string(mesh.source(h)) + " to vertex " + std::to_string(mesh.target(h)) + ")";
  }

  /// All coordinates must be multiples of one power of two that leaves room for the sums of transitions.
  void check_common_grid() const
  {
    constexpr int headroom = 3;
    int lowest = std::numeric_limits<int>::max();
    int highest = std::numeric_limits<int>::min();
    for (std::size_t h = 0; h < m_uv.size(); ++h)
      for (const double x : m_uv[h]) {
        if (!std::isfinite(x))
          throw Invalid_input_error("the map is not finite at " + name(static_cast<int>(h), *m_mesh));
        if (x == 0)
          continue;
        int exponent = 0;
        constexpr int digits = std::numeric_limits<double>::digits;
        auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), digits));
        highest = std::max(highest, exponent);
        for (exponent -= digits; mantissa % 2 == 0; mantissa /= 2)
          ++exponent;
        lowest = std::min(lowest, exponent);
      }
    if (lowest < highest && highest - lowest + headroom > std::numeric_limits<double>::digits)
      throw Invalid_input_error("the map's coordinates need " + std::to_string(highest - lowest) +
                                " bits; round them to multiples of a common power of two that leaves " +
                                std::to_string(headroom) + " of 53 bits free, so that their sums are exact");
  }

  void check_orientation() const
  {
    for (int f = 0; f < mesh().number_of_faces(); ++f)
      if (orientation_sign(uv(3 * f), uv(3 * f + 1), uv(3 * f + 2)) <= 0)
        throw No_result_error("map", "triangle " + std::to_string(f) +
                                         " is flipped or degenerate in the map, so no isolines can be followed there");
  }

  void derive_transitions()
  {
    for (int h = 0; h < mesh().number_of_halfedges(); ++h) {
      const int o = mesh().opposite(h);
      if (o < 0)
        continue;
      const Uv& a = uv(h);
      const Uv& b = uv(Indexed_triangulation::next(h));
      const Uv& a_there = uv(Indexed_triangulation::next(o));
      const Uv& b_there = uv(o);
      const Uv edge_there = {b_there[0] - a_there[0], b_there[1] - a_there[1]};
      Transition& transition = at(m_transition, h);
      transition.k = -1;
      for (int k = 0; k < 4 && transition.k < 0; ++k)
        if (turned(k, {b[0] - a[0], b[1] - a[1]}) == edge_there)
          transition.k = k;
      if (transition.k < 0)
        throw Invalid_input_error("the map is not exactly seamless across " + name(h, mesh()) +
                                  ": its two sides do not differ by a quarter turn and a translation");
      const Uv turned_a = turned(transition.k, a);
      transition.t = {a_there[0] - turned_a[0], a_there[1] - turned_a[1]};
    }
  }

  void check_curves() const
  {
    for (int h = 0; h < mesh().number_of_halfedges(); ++h) {
      const int o = mesh().opposite(h);
      if (o < 0 && !is_constrained(h))
        throw Invalid_input_error("border " + name(h, mesh()) + " lies on no curve; give every border edge a curve id");
      if (o >= 0 && curve(h) != curve(o))
        throw Invalid_input_error("the two sides of " + name(h, mesh()) + " lie on different curves");
      if (o >= 0 && !is_constrained(h) && region(h / 3) != region(o / 3))
        throw Invalid_input_error("regions " + std::to_string(region(h / 3)) + " and " + std::to_string(region(o / 3)) +
                                  " meet at " + name(h, mesh()) + ", which lies on no curve");
      const Uv& a = uv(h);
      const Uv& b = uv(Indexed_triangulation::next(h));
      if (is_constrained(h) && a[0] != b[0] && a[1] != b[1])
        throw Invalid_input_error("neither u nor v is constant on " + name(h, mesh()) + ", which lies on curve " +
                                  std::to_string(curve(h)));
    }
  }

  const Indexed_triangulation* m_mesh;
  std::vector<Uv> m_uv;
  std::vector<int> m_curve;
  std::vector<int> m_region;
  std::vector<Transition> m_transition;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
