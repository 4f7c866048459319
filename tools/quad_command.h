// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_QUAD_COMMAND_H
#define QUADRILLE_TOOLS_QUAD_COMMAND_H

#include "command_line.h"

namespace Quadrille {

/// `quadrille quad`: reads a domain, meshes it, writes what was asked for.
/// \throws the packages' exceptions; the JSON summary of the stages that succeeded has been written then, too.
void run_quad_command(const Quad_arguments& arguments);

} // namespace Quadrille

#endif
