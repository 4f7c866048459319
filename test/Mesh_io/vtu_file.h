// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_MESH_IO_VTU_FILE_H
#define QUADRILLE_TEST_MESH_IO_VTU_FILE_H

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

/// Reads the appended arrays of a VTU file, by the documented layout.
class Vtu_file {
public:
  explicit Vtu_file(std::string content) : m_content(std::move(content)) {}

  std::string attribute(const std::string& element, const std::string& name) const
  {
    const std::size_t tag = m_content.find(element), begin = m_content.find(" " + name + "=\"", tag);
    if (tag == std::string::npos || begin > m_content.find('>', tag))
      return {};
    const std::size_t value = begin + name.size() + 3;
    return m_content.substr(value, m_content.find('"', value) - value);
  }

  template <class Number> std::vector<Number> array(const std::string& name) const
  {
    const std::string tag = " Name=\"" + name + "\"";
    const std::size_t start = m_content.find("encoding=\"raw\">\n_") + 17;
    const std::size_t offset = std::stoul(attribute(tag, "offset"));
    std::uint64_t size = 0;
    std::memcpy(&size, m_content.data() + start + offset, sizeof size);
    EXPECT_LE(start + offset + sizeof size + size, m_content.size());
    std::vector<Number> values(size / sizeof(Number));
    std::memcpy(values.data(), m_content.data() + start + offset + sizeof size, size);
    return values;
  }

private:
  std::string m_content;
};

#endif
