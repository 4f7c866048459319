// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_CHECK_GEO_SCRIPT_H
#define QUADRILLE_MESH_IO_INTERNAL_CHECK_GEO_SCRIPT_H

#include <algorithm>
#include <cctype>
#include <string>

namespace Quadrille {
namespace internal {

/// A script of Gmsh without its comments and the contents of its strings. `complete` becomes false if one does not end.
inline std::string geo_skeleton(const std::string& script, bool& complete)
{
  std::string result;
  complete = true;
  for (std::size_t i = 0; i < script.size(); ++i) {
    const auto skip_to = [&](const std::string& end, std::size_t from) {
      const std::size_t found = script.find(end, from);
      complete = complete && (found != std::string::npos || end == "\n");
      i = found == std::string::npos ? script.size() : found + end.size() - 1;
    };
    if (script.compare(i, 2, "//") == 0)
      skip_to("\n", i);
    else if (script.compare(i, 2, "/*") == 0)
      skip_to("*/", i + 2);
    else if (script[i] == '"')
      skip_to("\"", i + 1);
    else
      result += script[i];
  }
  return result;
}

/// Whether a script, without space at its end, ends with Fillet{...}{...}{...} or Chamfer, which need no semicolon.
inline bool ends_with_fillet(const std::string& text)
{
  for (const std::string word : {"Fillet", "Chamfer"})
    if (const std::size_t found = text.rfind(word); found != std::string::npos) {
      const std::string rest = text.substr(found + word.size());
      if (rest.find_first_of(";=") == std::string::npos && std::count(rest.begin(), rest.end(), '}') >= 3)
        return true;
    }
  return false;
}

/// Whether a script ends after a statement. Gmsh does not mind when the last one is cut off.
inline bool is_complete_geo_script(const std::string& script)
{
  bool complete = true;
  std::string text = geo_skeleton(script, complete);
  const auto trim = [&text] {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
      text.pop_back();
  };
  trim();
  if (!complete || std::count(text.begin(), text.end(), '{') != std::count(text.begin(), text.end(), '}'))
    return false;
  for (const std::string word : {"EndFor", "EndIf", "Return"}) // these end blocks without a semicolon
    if (text.size() >= word.size() && text.compare(text.size() - word.size(), word.size(), word) == 0)
      return true;
  if (text.empty() || text.back() == ';')
    return true;
  if (text.back() != '}')
    return false;
  if (ends_with_fillet(text))
    return true;
  // A block, as in Rotate {...} { Surface{1}; }, holds statements; a list, as in Curve Loop(1) = {1, 2}, does not.
  text.pop_back();
  trim();
  return !text.empty() && (text.back() == ';' || text.back() == '{' || text.back() == '}');
}

} // namespace internal
} // namespace Quadrille

#endif
