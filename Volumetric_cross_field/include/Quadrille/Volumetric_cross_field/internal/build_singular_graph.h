// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_BUILD_SINGULAR_GRAPH_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_BUILD_SINGULAR_GRAPH_H

#include <Quadrille/Singular_graph.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/Volumetric_cross_field/internal/singular_face_paths.h>

namespace Quadrille {
namespace internal {

/// The graph of raw paths; see `Singular_graph_builder`.
Singular_graph build_singular_graph(const Singular_face_paths& paths, const Singular_graph_options& options);

} // namespace internal
} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Volumetric_cross_field/internal/Singular_graph_builder.h>
#endif

#endif
