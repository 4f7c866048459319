// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_FOLDED_MAP_H
#define QUADRILLE_TOOLS_FOLDED_MAP_H

#include <Quadrille/Surface_domain.h>
#include <Quadrille/seamless_parametrization.h>

#include <string>

namespace Quadrille {

/// Where a map is folded, as a reason for having no quads: how many triangles, and for the first few places their
/// coordinates, their surface, and the curves that pass within two edges.
/// \pre some triangle of the map is flipped, or some vertex covered more than once.
std::string reason_of_folded_map(const Surface_domain& domain, const Seamless_map<Surface_domain::Mesh>& map);

} // namespace Quadrille

#endif
