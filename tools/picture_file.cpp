// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "picture_file.h"

#include <Quadrille/write_file.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace Quadrille {

namespace {

const char* const converter = "rsvg-convert";

bool has_converter()
{
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((folder + "/" + converter).c_str(), X_OK) == 0)
      return true;
  return false;
}

/// Runs the converter without a shell; true if it succeeded.
bool convert(const std::string& svg, const std::string& png)
{
  std::string arguments[] = {converter, "-o", png, svg};
  char* argv[] = {arguments[0].data(), arguments[1].data(), arguments[2].data(), arguments[3].data(), nullptr};
  pid_t child = 0;
  if (::posix_spawnp(&child, converter, nullptr, nullptr, argv, environ) != 0)
    return false;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR)
      return false;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

} // namespace

void check_picture_name(const std::string& path)
{
  const std::filesystem::path extension = std::filesystem::path(path).extension();
  if (extension != ".svg" && extension != ".png")
    throw Invalid_argument_error(path + ": pictures are .svg or .png files");
  if (extension == ".png" && !has_converter())
    throw Invalid_argument_error(path + ": PNG pictures are made by the program rsvg-convert, which is not installed "
                                        "(Debian package librsvg2-bin); give a name that ends in .svg");
}

void write_picture_file(const std::string& path, const std::string& picture)
{
  if (std::filesystem::path(path).extension() != ".png")
    return write_file(path, picture);
  const std::string png = temporary_name_for(path), svg = png + ".svg";
  write_file(svg, picture);
  const bool converted = convert(svg, png);
  std::error_code code;
  std::filesystem::remove(svg, code);
  if (converted)
    std::filesystem::rename(png, path, code);
  if (!converted || code) {
    std::filesystem::remove(png, code);
    throw Output_error(path + ": the picture could not be converted to PNG");
  }
}

} // namespace Quadrille
