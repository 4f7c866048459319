// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Volumetric_cross_field/internal/Multilevel_field_solver.h>
#include <Quadrille/Volumetric_cross_field/internal/Singular_graph_builder.h>
