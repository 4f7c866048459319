// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_OUTPUT_FILES_H
#define QUADRILLE_TOOLS_OUTPUT_FILES_H

#include <set>
#include <string>
#include <vector>

namespace Quadrille {

/// Finds out at once, not after the computation, that a file cannot be written. Empty names are none.
/// \throws Invalid_argument_error if a name is among `inputs` or there twice; Output_error
void check_output_files(const std::vector<std::string>& paths, std::set<std::string> inputs);

/// \throws Invalid_argument_error if `path` is not empty and does not end in `ending`.
void check_ending(const std::string& path, const std::string& ending);

} // namespace Quadrille

#endif
