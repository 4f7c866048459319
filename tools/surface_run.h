// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_SURFACE_RUN_H
#define QUADRILLE_TOOLS_SURFACE_RUN_H

#include "command_line.h"

#include <Quadrille/Surface_domain.h>

#include <chrono>

namespace Quadrille {

/// `quadrille quad` on a surface: its frame field and map. `start` is when the run began.
/// \throws Error
void run_on_surface(const Quad_arguments& arguments, Surface_domain domain,
                    std::chrono::steady_clock::time_point start);

} // namespace Quadrille

#endif
