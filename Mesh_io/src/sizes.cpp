// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Mesh_io/internal/estimate_quads_impl.h>
#include <Quadrille/Mesh_io/internal/read_metric_impl.h>
#include <Quadrille/Mesh_io/internal/read_size_field.h>
