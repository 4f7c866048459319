// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_WRITE_FILE_H
#define QUADRILLE_WRITE_FILE_H

#include <Quadrille/exceptions.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#endif

namespace Quadrille {

/// A name beside `path` for what will become `path`: in the same folder, so that renaming is atomic.
inline std::string temporary_name_for(const std::string& path)
{
  const std::filesystem::path file(path);
#if defined(__unix__) || defined(__APPLE__)
  const std::string process = std::to_string(::getpid());
#else
  const std::string process = "0";
#endif
  // Keeps the extension: programs that write it may look at it.
  return (file.parent_path() / ("." + file.stem().string() + "-" + process + file.extension().string())).string();
}

/// \throws Output_error naming `path` if no file can be written there. Leaves nothing behind.
inline void check_can_write(const std::string& path)
{
  std::error_code code;
  if (std::filesystem::is_directory(path, code))
    throw Output_error(path + ": this is a folder, not a file");
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, code))
    throw Output_error(path + ": the folder " + folder.string() + " does not exist");
  const std::string temporary = temporary_name_for(path);
  if (!std::ofstream(temporary, std::ios::binary | std::ios::trunc))
    throw Output_error(path + ": no file can be made in its folder; is it writable?");
  std::filesystem::remove(temporary, code);
}

/// Lets `write(stream)` write the content of the file `path`, which appears completely, or not at all.
///
/// \throws Output_error naming `path` if its folder does not exist or is not writable, or the disk is full; and what
/// `write` throws. What was at `path` before is untouched then.
template <class Write> void write_file_by(const std::string& path, const Write& write)
{
  check_can_write(path);
  const std::string temporary = temporary_name_for(path);
  const auto remove = [&] {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
  };
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  try {
    write(file);
  } catch (...) {
    file.close();
    remove();
    throw;
  }
  file.close();
  if (!file) {
    remove();
    throw Output_error(path + ": the file cannot be written completely; is the disk full?");
  }
  std::error_code code;
  std::filesystem::rename(temporary, path, code);
  if (code) {
    remove();
    throw Output_error(path + ": the file cannot be put in its place: " + code.message());
  }
}

/// Writes `content` to `path`, as `write_file_by()`.
inline void write_file(const std::string& path, const std::string& content)
{
  write_file_by(path, [&](std::ostream& file) { file.write(content.data(), std::streamsize(content.size())); });
}

} // namespace Quadrille

#endif
