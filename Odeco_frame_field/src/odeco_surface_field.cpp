// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Odeco_frame_field/internal/solve_surface_field_impl.h>
