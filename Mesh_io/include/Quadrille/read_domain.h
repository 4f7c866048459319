// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_READ_DOMAIN_H
#define QUADRILLE_READ_DOMAIN_H

#include <Quadrille/Planar_domain.h>
#include <Quadrille/Surface_domain.h>
#include <Quadrille/exceptions.h>

#include <string>
#include <variant>

namespace Quadrille {

/// Whether all points that polygons use lie in a plane z = constant, up to rounding; also if there are none.
/// Complexity: linear.
bool is_planar(const Labelled_mesh& mesh);

/// Reads a planar domain or a surface, whichever the file holds.
///
/// Planar are meshes with `is_planar()`, and geometry without volumes whose surfaces lie in a plane z = constant. The
/// file is read once. Of the options, those for what is found are used, and the isolation and time limit of
/// `surface_options`.
/// \throws Invalid_input_error, Invalid_argument_error as `read_planar_domain()` and `read_surface_domain()`.
std::variant<Planar_domain, Surface_domain> read_domain(const std::string& path,
                                                        const Planar_domain_options& planar_options = {},
                                                        const Surface_domain_options& surface_options = {});

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/read_domain_impl.h>
#endif

#endif
