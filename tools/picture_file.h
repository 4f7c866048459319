// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_PICTURE_FILE_H
#define QUADRILLE_TOOLS_PICTURE_FILE_H

#include <string>

namespace Quadrille {

/// \throws Invalid_argument_error if `path` ends neither in .svg nor in .png, or in .png and there is no rsvg-convert.
void check_picture_name(const std::string& path);

/// Writes `picture`, an SVG text, to `path`; PNG is made by rsvg-convert. \throws Output_error
void write_picture_file(const std::string& path, const std::string& picture);

} // namespace Quadrille

#endif
