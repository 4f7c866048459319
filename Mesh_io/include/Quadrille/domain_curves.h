// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_DOMAIN_CURVES_H
#define QUADRILLE_DOMAIN_CURVES_H

#include <Quadrille/Planar_domain.h>
#include <Quadrille/Triangulated_domain.h>
#include <Quadrille/exceptions.h>

#include <string>
#include <vector>

namespace Quadrille {

/// The curves that a user's name stands for, as indices into `domain.curves`: those of a physical group, or else the
/// one with this tag; none if there is no such name. Complexity: O(number of curves).
template <class Point> std::vector<int> curves_named(const Triangulated_domain<Point>& domain, const std::string& name);

/// The names that `curves_named()` knows, for error messages: all groups, and the first tags.
template <class Point> std::string list_of_curve_names(const Triangulated_domain<Point>& domain);

/// Takes curves out of a domain, so that elements need not follow them. Its triangles keep the edges along them, so
/// sizes can still be prescribed there; indices of the curves that are left change.
/// \throws Invalid_argument_error if one of the curves is on the border or between two regions, where elements have to
/// follow it. Complexity: O(number of edges).
template <class Point> void remove_curves(Triangulated_domain<Point>& domain, const std::vector<int>& curves);

} // namespace Quadrille

#include <Quadrille/Mesh_io/internal/domain_curves_impl.h>

#endif
