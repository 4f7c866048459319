// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Symmetric_tensors/internal/spherical_harmonics_impl.h>
