// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_TEXT_SCANNER_H
#define QUADRILLE_MESH_IO_INTERNAL_TEXT_SCANNER_H

#include <Quadrille/exceptions.h>

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <system_error>

namespace Quadrille {
namespace internal {

/// Words and numbers of a text with the line where they stand, for messages. Independent of the locale.
class Text_scanner {
public:
  Text_scanner(std::string_view text, const std::string& path) : m_text(text), m_path(&path) {}

  [[noreturn]] void fail(const std::string& reason) const
  {
    std::string message = *m_path + ", line " + std::to_string(m_line) + ": " + reason;
    for (char& c : message) // reasons quote the file, which may be anything
      if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126)
        c = '?';
    throw Invalid_input_error(message);
  }

  bool at_end() const { return m_position >= m_text.size(); }
  std::size_t remaining() const { return m_text.size() - m_position; }
  std::size_t line() const { return m_line; }

  /// The next word on any line; empty at the end of the text.
  std::string_view word()
  {
    skip_space(true);
    return take_word();
  }

  /// The next word on this line; empty at the line's end.
  std::string_view word_on_line()
  {
    skip_space(false);
    return take_word();
  }

  /// The next word that is not in a comment, which begins with # and ends with the line; empty at the end of the text.
  std::string_view word_outside_comments()
  {
    std::string_view next = word();
    while (!next.empty() && next.front() == '#') {
      rest_of_line();
      next = word();
    }
    return next;
  }

  /// The first word of the next line that is neither blank nor a comment; empty at the end of the text.
  /// \pre a line begins here.
  std::string_view first_word_of_line()
  {
    while (!at_end()) {
      const std::string_view first = word_on_line();
      if (!first.empty() && first.front() != '#')
        return first;
      rest_of_line();
    }
    return {};
  }

  /// The rest of this line, without its end; goes on to the next line.
  std::string_view rest_of_line()
  {
    const std::size_t begin = m_position;
    std::size_t end = m_text.find('\n', begin);
    end = end == std::string_view::npos ? m_text.size() : end;
    m_position = end;
    if (m_position < m_text.size()) {
      ++m_position;
      ++m_line;
    }
    std::string_view line = m_text.substr(begin, end - begin);
    if (!line.empty() && line.back() == '\r')
      line.remove_suffix(1);
    return line;
  }

  /// Raw bytes. \throws Invalid_input_error if there are fewer.
  const char* bytes(std::size_t n, std::string_view what)
  {
    if (n > remaining())
      fail("the file ends within the " + std::string(what));
    m_position += n;
    return m_text.data() + (m_position - n);
  }

  template <class Number> Number number(std::string_view word, std::string_view what) const
  {
    if (word.empty())
      fail("the file ends, or the line does, where " + std::string(what) + " is expected");
    Number value{};
    const char* begin = word.data() + (word.front() == '+' ? 1 : 0);
    const auto [end, code] = std::from_chars(begin, word.data() + word.size(), value);
    if (code == std::errc::result_out_of_range)
      fail("'" + std::string(word.substr(0, 40)) + "' is out of range for " + std::string(what));
    if (code != std::errc() || end != word.data() + word.size())
      fail("'" + std::string(word.substr(0, 40)) + "' is not " + std::string(what));
    return value;
  }

  template <class Number> Number number(std::string_view what) { return number<Number>(word(), what); }

  /// A coordinate or another number that has to be finite.
  double finite_number(std::string_view word, std::string_view what) const
  {
    const double value = number<double>(word, what);
    if (!std::isfinite(value))
      fail("'" + std::string(word.substr(0, 40)) + "' is not a finite number");
    return value;
  }

  /// A count of things that take at least `bytes_each` bytes of text each.
  std::size_t count(std::string_view word, std::string_view what, std::size_t bytes_each) const
  {
    const long long n = number<long long>(word, what);
    if (n < 0)
      fail(std::string(what) + " is negative");
    if (std::size_t(n) > remaining() / bytes_each + 1)
      fail(std::string(what) + " is " + std::to_string(n) +
           ", more than the file has room for: it is truncated or damaged");
    return std::size_t(n);
  }
  std::size_t count(std::string_view what, std::size_t bytes_each) { return count(word(), what, bytes_each); }

private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

  void skip_space(bool over_lines)
  {
    for (; m_position < m_text.size(); ++m_position) {
      const char c = m_text[m_position];
      if (c == '\n' && over_lines)
        ++m_line;
      else if (!is_blank(c))
        return;
    }
  }

  std::string_view take_word()
  {
    const std::size_t begin = m_position;
    while (m_position < m_text.size() && !is_blank(m_text[m_position]) && m_text[m_position] != '\n')
      ++m_position;
    return m_text.substr(begin, m_position - begin);
  }

  std::string_view m_text;
  const std::string* m_path;
  std::size_t m_position = 0;
  std::size_t m_line = 1;
};

} // namespace internal
} // namespace Quadrille

#endif
