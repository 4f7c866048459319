// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_PIPELINE_OUTPUT_H
#define QUADRILLE_TOOLS_PIPELINE_OUTPUT_H

#include "Quad_pipeline.h"

#include <array>
#include <vector>

namespace Quadrille {

/// The quads of a finished run with the labels of the domain's curves and regions.
/// \pre `result.extraction` is there.
/// The frames of a run's field in the form that writers take: per face the two frame vectors (their lengths are the
/// sizes), per vertex its valence in the map.
struct Frames {
  std::vector<std::array<double, 2>> u, v;
  std::vector<int> valence;
};
Frames frames_of(const Planar_domain& domain, const Quad_pipeline_result& result);

} // namespace Quadrille

#endif
