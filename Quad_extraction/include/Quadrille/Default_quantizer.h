// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_DEFAULT_QUANTIZER_H
#define QUADRILLE_DEFAULT_QUANTIZER_H

#include <Quadrille/Greedy_quantizer.h>
#include <Quadrille/Optimal_quantizer.h>

#include <type_traits>

namespace Quadrille {

/// The optimal quantizer where a solver is built in, otherwise the greedy one.
using Default_quantizer = std::conditional_t<Optimal_quantizer::is_available(), Optimal_quantizer, Greedy_quantizer>;

} // namespace Quadrille

#endif
