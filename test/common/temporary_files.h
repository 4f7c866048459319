// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_COMMON_TEMPORARY_FILES_H
#define QUADRILLE_TEST_COMMON_TEMPORARY_FILES_H

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

/// A fixture with a folder of its own, also beside other runs of the same test.
class Temporary_files : public ::testing::Test {
protected:
  Temporary_files()
  {
    std::string pattern = (std::filesystem::temp_directory_path() / "quadrille-test-XXXXXX").string();
    if (!::mkdtemp(pattern.data()))
      std::abort();
    m_folder = pattern;
  }
  ~Temporary_files() override { std::filesystem::remove_all(m_folder); }

  std::string path(const std::string& name) const { return (m_folder / name).string(); }

  std::string write(const std::string& name, const std::string& text) const
  {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }

  static std::string content(const std::string& file_name)
  {
    std::ifstream file(file_name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }

  std::size_t number_of_files() const
  {
    return std::size_t(std::distance(std::filesystem::directory_iterator(m_folder), {}));
  }

  std::filesystem::path m_folder;
};

#endif
