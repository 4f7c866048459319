// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_TRACE_CROSSINGS_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_TRACE_CROSSINGS_H

#include <Quadrille/Quad_extraction/internal/Isoline_tracer.h>

#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Two perpendicular traces meet in a triangle; the position of the crossing on each is exact.
struct Trace_crossing {
  std::array<int, 2> trace;
  std::array<int, 2> step;
  std::array<double, 2> position;
  int face;
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

/// All crossings of the traces, each once.
///
/// Each trace is moved to its left by its own infinitesimal amount, those of earlier traces being infinitely larger;
/// so every crossing lies strictly inside one triangle and none is missed or met twice.
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

  std::vector<Trace_crossing> crossings;
  for (int f = 0; f < n_faces; ++f)
    for (int i = at(first, f); i < at(first, f + 1); ++i)
      for (int j = i + 1; j < at(first, f + 1); ++j) {
        const Trace& trace_1 = at(traces, at(by_face, i).first);
        const Trace& trace_2 = at(traces, at(by_face, j).first);
        const Isoline_step& step_1 = at(trace_1.steps, at(by_face, i).second);
        const Isoline_step& step_2 = at(trace_2.steps, at(by_face, j).second);
        if ((step_1.direction + step_2.direction) % 2 == 0)
          continue;
        const Uv part_1 = turned(step_1.direction + 1, {step_1.level, 0});
        const Uv part_2 = turned(step_2.direction + 1, {step_2.level, 0});
        const Uv point = {part_1[0] + part_2[0], part_1[1] + part_2[1]};
        const double position_1 = step_1.position(point);
        const double position_2 = step_2.position(point);
        if (position_1 <= 0 || position_1 >= trace_1.length || position_2 <= 0 || position_2 >= trace_2.length)
          continue;
        bool inside = true;
        for (int h = 3 * f; h < 3 * f + 3 && inside; ++h)
          inside = perturbed_orientation(map.uv(h), map.uv(Indexed_triangulation::next(h)), point, step_1.direction + 1,
                                         step_2.direction + 1) > 0;
        if (inside)
          crossings.push_back({{at(by_face, i).first, at(by_face, j).first},
                               {at(by_face, i).second, at(by_face, j).second},
                               {position_1, position_2},
                               f,
                               point});
      }
  return crossings;
}

} // namespace internal::extraction
} // namespace Quadrille

#endif
