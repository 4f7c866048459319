// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_CHECK_COMMAND_H
#define QUADRILLE_TOOLS_CHECK_COMMAND_H

#include "command_line.h"

namespace Quadrille {

/// `quadrille check`: validity and quality of a quad mesh.
/// \throws No_result_error ("mesh") if the mesh is not valid, and as the readers and writers do.
void run_check_command(const Check_arguments& arguments);

} // namespace Quadrille

#endif
