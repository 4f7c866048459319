// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_SVG_PICTURE_H
#define QUADRILLE_TOOLS_SVG_PICTURE_H

#include "Quad_pipeline.h"

#include <string>

namespace Quadrille {

/// A picture of a run as SVG text: panels of the frame field with its singular vertices (red: valence 3, blue: valence
/// 5, violet: others), the isolines of the map, the layout and the quads, as far as the run got.
std::string svg_picture(const Planar_domain& domain, const Quad_pipeline_result& result);

} // namespace Quadrille

#endif
