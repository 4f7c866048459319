// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_TRACE_CROSSINGS_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_TRACE_CROSSINGS_H

#include <Quadrille/Quad_extraction/internal/Isoline_tracer.h>

#include <optional>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Two perpendicular traces meet in a triangle; the position of the crossing on each is exact.
struct Trace_crossing {
  std::array<int, 2> trace = {-1, -1};
  std::array<int, 2> step = {-1, -1};
  std::array<double, 2> position = {0, 0};
  int face = -1;
  Uv point; ///< in the chart of `face`
};

/// Sign of the orientation of a, b and the point p + e1 d1 + e2 d2 with infinitesimal e1 >> e2 > 0, where d1 and d2
/// are perpendicular axis directions (so the answer is never 0).
inline int perturbed_orientation(const Uv& a, const Uv& b, const Uv& p, int d1, int d2)
{
  const int sign = orientation_sign(a, b, p);
  if (sign != 0)
    return sign;
  for (const int d : {d1, d2}) {
    // d/de cross(b - a, e d) has the sign of the part of b - a along the direction a quarter turn clockwise of d.
    const double from = along(d + 3, a);
    const double to = along(d + 3, b);
    if (from != to)
      return to > from ? 1 : -1;
  }
  return 0;
}

/// Where step `s_1` of trace 1 and step `s_2` of trace 2 cross, if they do in this triangle (which is that of both).
///
/// Each trace is moved to its left by its own infinitesimal amount, that of trace 1 being infinitely larger; so every
/// crossing lies strictly inside one triangle, and is found once if always the earlier trace (for crossings of a trace
/// with itself the earlier step) is trace 1. Lengths of the traces are not looked at.
inline std::optional<Trace_crossing> crossing_of(const Seamless_map& map, const Isoline_step& step_1,
                                                 const Isoline_step& step_2)
{
  if ((step_1.direction + step_2.direction) % 2 == 0)
    return std::nullopt;
  const Uv part_1 = turned(step_1.direction + 1, {step_1.level, 0});
  const Uv part_2 = turned(step_2.direction + 1, {step_2.level, 0});
  Trace_crossing crossing;
  crossing.face = step_1.face;
  crossing.point = {part_1[0] + part_2[0], part_1[1] + part_2[1]};
  crossing.position = {step_1.position(crossing.point), step_2.position(crossing.point)};
  for (int h = 3 * step_1.face; h < 3 * step_1.face + 3; ++h)
    if (perturbed_orientation(map.uv(h), map.uv(Indexed_triangulation::next(h)), crossing.point, step_1.direction + 1,
                              step_2.direction + 1) <= 0)
      return std::nullopt;
  return crossing;
}

/// All crossings of the traces, each once; where a trace ends on another one included, ends at vertices excluded.
/// Complexity: the sum over the triangles of the number of pairs of traces in them.
inline std::vector<Trace_crossing> find_crossings(const Seamless_map& map, const std::vector<Trace>& traces)
{
  const int n_faces = map.mesh().number_of_faces();
  std::vector<int> first(std::size_t(n_faces) + 1, 0);
  for (const Trace& trace : traces)
    for (const Isoline_step& step : trace.steps)
      ++at(first, step.face + 1);
  for (int f = 0; f < n_faces; ++f)
    at(first, f + 1) += at(first, f);
  std::vector<std::pair<int, int>> by_face(std::size_t(first.back()));
  std::vector<int> end(first.begin(), first.end() - 1);
  for (int t = 0; t < size_of(traces); ++t)
    for (int s = 0; s < size_of(at(traces, t).steps); ++s)
      at(by_face, at(end, at(at(traces, t).steps, s).face)++) = {t, s};

  const auto is_within = [](const Trace& trace, double position) {
    return position > 0 && (position < trace.length || (position == trace.length && trace.target < 0));
  };
  std::vector<Trace_crossing> crossings;
  for (int f = 0; f < n_faces; ++f)
    for (int i = at(first, f); i < at(first, f + 1); ++i)
      for (int j = i + 1; j < at(first, f + 1); ++j) {
        const auto [t_1, s_1] = at(by_face, i);
        const auto [t_2, s_2] = at(by_face, j);
        std::optional<Trace_crossing> crossing =
            crossing_of(map, at(at(traces, t_1).steps, s_1), at(at(traces, t_2).steps, s_2));
        if (!crossing || !is_within(at(traces, t_1), crossing->position[0]) ||
            !is_within(at(traces, t_2), crossing->position[1]))
          continue;
        crossing->trace = {t_1, t_2};
        crossing->step = {s_1, s_2};
        crossings.push_back(*crossing);
      }
  return crossings;
}

} // namespace internal::extraction
} // namespace Quadrille

#endif
