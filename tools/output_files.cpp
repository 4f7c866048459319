// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output_files.h"

#include <Quadrille/exceptions.h>
#include <Quadrille/write_file.h>

namespace Quadrille {

void check_output_files(const std::vector<std::string>& paths, std::set<std::string> inputs)
{
  for (const std::string& path : paths) {
    if (path.empty())
      continue;
    if (!inputs.insert(path).second)
      throw Invalid_argument_error(path + ": this file is named twice");
    check_can_write(path);
  }
}

void check_ending(const std::string& path, const std::string& ending)
{
  if (!path.empty() && (path.size() < ending.size() || path.substr(path.size() - ending.size()) != ending))
    throw Invalid_argument_error(path + ": the name of this file has to end in " + ending);
}

} // namespace Quadrille
