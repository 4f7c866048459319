// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Symmetric_tensors/internal/nearest_cross_impl.h>
