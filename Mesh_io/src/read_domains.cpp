// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Mesh_io/internal/make_planar_domain.h>
#include <Quadrille/Mesh_io/internal/make_surface_domain.h>
#include <Quadrille/Mesh_io/internal/read_domain_impl.h>
#include <Quadrille/Mesh_io/internal/read_mesh_impl.h>
#include <Quadrille/Mesh_io/internal/read_planar_domain.h>
#include <Quadrille/Mesh_io/internal/read_surface_domain_impl.h>
