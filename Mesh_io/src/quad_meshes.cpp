// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Mesh_io/internal/Mesh_quality_impl.h>
#include <Quadrille/Mesh_io/internal/compare_surfaces_impl.h>
#include <Quadrille/Mesh_io/internal/repair_mesh_impl.h>
#include <Quadrille/Mesh_io/internal/write_mesh_impl.h>
