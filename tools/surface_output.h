// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_SURFACE_OUTPUT_H
#define QUADRILLE_TOOLS_SURFACE_OUTPUT_H

#include "Surface_pipeline.h"
#include "surface_picture.h"

#include <array>
#include <vector>

namespace Quadrille {

/// Per face a vector of the frame in space: the gradient over its squared length.
std::array<std::vector<std::array<double, 3>>, 2> frame_vectors(const Surface_domain& domain,
                                                                const std::vector<Gradient_pair>& gradients);

/// What there is to see of a run, as far as it got: the frames, the isolines of the map, or the quads.
Surface_drawing surface_drawing(const Surface_domain& domain, const Surface_pipeline_result& result);

} // namespace Quadrille

#endif
