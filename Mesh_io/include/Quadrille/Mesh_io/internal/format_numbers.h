// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_FORMAT_NUMBERS_H
#define QUADRILLE_MESH_IO_INTERNAL_FORMAT_NUMBERS_H

#include <charconv>
#include <string>
#include <type_traits>

namespace Quadrille {
namespace internal {

/// The shortest text that reads as the same number, whatever the locale.
template <class Number> void append_number(std::string& text, Number value)
{
  char buffer[40];
  const std::to_chars_result result = std::to_chars(buffer, buffer + sizeof buffer, value);
  text.append(buffer, result.ptr);
}

/// Numbers and words, separated by spaces, and the end of a line.
template <class... T> void append_line(std::string& text, const T&... values)
{
  const auto append = [&text](const auto& value) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
      append_number(text, value);
    else
      text += value;
    text += ' ';
  };
  (append(values), ...);
  if (sizeof...(values) > 0)
    text.back() = '\n';
  else
    text += '\n';
}

} // namespace internal
} // namespace Quadrille

#endif
