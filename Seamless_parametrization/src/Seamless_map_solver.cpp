// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Seamless_parametrization/internal/Seamless_map_solver.h>

template class Quadrille::internal::Seamless_map_solver<Quadrille::Cholesky_solver>;
