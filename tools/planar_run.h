// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_PLANAR_RUN_H
#define QUADRILLE_TOOLS_PLANAR_RUN_H

#include "command_line.h"

#include <Quadrille/Planar_domain.h>

#include <chrono>

namespace Quadrille {

/// `quadrille quad` on a planar domain, to the mesh. `start` is when the run began.
/// \throws Error
void run_on_planar_domain(const Quad_arguments& arguments, Planar_domain domain,
                          std::chrono::steady_clock::time_point start);

} // namespace Quadrille

#endif
