// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/odeco_tensors_3.h>
// After the declarations.
#include <Quadrille/Symmetric_tensors/internal/odeco_tensors_3_impl.h>
