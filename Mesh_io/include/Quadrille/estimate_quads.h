// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ESTIMATE_QUADS_H
#define QUADRILLE_ESTIMATE_QUADS_H

#include <Quadrille/Planar_domain.h>
#include <Quadrille/Size_specification.h>

namespace Quadrille {

/// About how many quads the sizes ask for, before anything is computed: between the curves, the logarithms of sizes are
/// interpolated harmonically, as they are in a field without singularities.
///
/// \return 0 if no sizes are prescribed. Complexity: O(n^1.5) (conjugate gradients).
double estimate_number_of_quads(const Planar_domain& domain, const Domain_sizes& sizes);

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/estimate_quads_impl.h>
#endif

#endif
