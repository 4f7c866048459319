// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_FILES_H
#define QUADRILLE_MESH_IO_INTERNAL_FILES_H

#include <Quadrille/exceptions.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace Quadrille {
namespace internal {

/// The extension of a file name in lower case, with its dot.
inline std::string extension_of(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

/// \throws Invalid_argument_error if the name has another extension
inline void check_extension(const std::string& path, const std::string& extension)
{
  if (extension_of(path) != extension)
    throw Invalid_argument_error(path + ": the name of this file has to end in " + extension);
}

/// \throws Invalid_input_error if `path` is not a readable, non-empty file.
inline void check_readable(const std::string& path)
{
  std::error_code code;
  const std::filesystem::file_status status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status))
    throw Invalid_input_error(path + ": there is no such file");
  if (std::filesystem::is_directory(status))
    throw Invalid_input_error(path + ": this is a folder, not a file");
  if (!std::filesystem::is_regular_file(status))
    throw Invalid_input_error(path + ": this is not a regular file");
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw Invalid_input_error(path + ": the file cannot be opened for reading");
  if (file.peek() == std::ifstream::traits_type::eof())
    throw Invalid_input_error(path + ": the file is empty");
}

/// The whole file as bytes. \throws Invalid_input_error as `check_readable()`.
inline std::string read_whole_file(const std::string& path)
{
  check_readable(path);
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  std::ifstream file(path, std::ios::binary);
  std::string text(code ? 0 : std::size_t(size), '\0');
  if (code || !file.read(text.data(), std::streamsize(text.size())))
    throw Invalid_input_error(path + ": the file cannot be read to its end");
  return text;
}

/// The first bytes of a file.
inline std::string read_beginning(const std::string& path, std::size_t n_bytes)
{
  std::string text(n_bytes, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), std::streamsize(n_bytes));
  text.resize(std::size_t(file.gcount()));
  return text;
}

} // namespace internal
} // namespace Quadrille

#endif
