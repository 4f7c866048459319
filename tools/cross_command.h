// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_CROSS_COMMAND_H
#define QUADRILLE_TOOLS_CROSS_COMMAND_H

#include "command_line.h"

namespace Quadrille {

/// `quadrille cross`: reads or fills a volume, computes its cross field and the singular graph, writes what was asked
/// for. \throws the packages' exceptions
void run_cross_command(const Cross_arguments& arguments);

} // namespace Quadrille

#endif
