// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_CHECK_FIELD_ARGUMENTS_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_CHECK_FIELD_ARGUMENTS_H

#include <Quadrille/Odeco_field_options.h>
#include <Quadrille/Odeco_frame_field/internal/vertex_restrictions.h>
#include <Quadrille/exceptions.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

inline void check_prescribed_sizes(const std::vector<Constrained_halfedge>& edges, bool isotropic)
{
  for (const Constrained_halfedge& edge : edges)
    for (const Frame_size& size : edge.size) {
      for (const double value : {size.normal, size.tangential})
        if (!(value >= 0) || !std::isfinite(value))
          throw Invalid_argument_error("an edge has the prescribed size " + std::to_string(value) +
                                       "; sizes must be positive and finite (0 leaves a size free)");
      if (size.normal == size.tangential)
        continue;
      if (!edge.aligned)
        throw Invalid_argument_error("an edge that frames need not align with has different sizes across and along it; "
                                     "prescribe one size, or align the frames");
      if (isotropic && size.normal > 0 && size.tangential > 0)
        throw Invalid_argument_error("an edge has the prescribed sizes " + std::to_string(size.normal) +
                                     " across and " + std::to_string(size.tangential) +
                                     " along it; isotropic frames have one size, so make them equal or the field "
                                     "anisotropic");
    }
}

inline void check_target_sizes(const std::vector<double>& sizes, double weight)
{
  for (const double size : sizes)
    if (!(size >= 0) || !std::isfinite(size))
      throw Invalid_argument_error("a vertex has the target size " + std::to_string(size) +
                                   "; sizes must be positive and finite (0 for no target)");
  if (!(weight >= 0))
    throw Invalid_argument_error("the weight of target sizes must not be negative");
}

inline void check_schedule(const Melt_and_freeze_schedule& schedule, int starts, int threads)
{
  if (starts < 0 || threads < 0)
    throw Invalid_argument_error("the numbers of starts and of threads must not be negative");
  if (!(schedule.smooth_epsilon > 0) || !(schedule.final_epsilon > 0) || schedule.coarse_triangles < 1 ||
      schedule.relax_triangles < 1 || !(schedule.melt_epsilon >= schedule.final_epsilon) ||
      !(schedule.freeze_ratio > 1) || !(schedule.noise >= 0))
    throw Invalid_argument_error("the melt-and-freeze schedule needs positive epsilons that do not increase, a ratio "
                                 "above 1, a noise that is not negative and a positive number of triangles");
}

/// The place of the start with the lowest cost; the smooth one only if no other is valid.
/// \throws No_result_error if none is valid
inline int best_start(const std::vector<Field_start>& starts)
{
  const Field_start* best = nullptr;
  const auto is_better = [&](const Field_start& start) {
    return !best || best->kind == Field_start::Kind::smooth || start.cost < best->cost;
  };
  for (const Field_start& start : starts)
    if (start.valid && is_better(start))
      best = &start;
  if (!best)
    throw No_result_error("field", "no start led to a frame field with positive sizes everywhere; prescribe sizes "
                                   "that change more slowly, or use smaller triangles");
  return int(best - starts.data());
}

} // namespace internal
} // namespace Quadrille

#endif
