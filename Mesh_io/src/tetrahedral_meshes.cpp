// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Mesh_io/internal/fill_with_tetrahedra_impl.h>
#include <Quadrille/Mesh_io/internal/read_tetrahedral_mesh_impl.h>
#include <Quadrille/Mesh_io/internal/write_tetrahedral_mesh_impl.h>
