// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_POINT_SIZES_H
#define QUADRILLE_MESH_IO_INTERNAL_POINT_SIZES_H

#include <gmsh.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <system_error>

namespace Quadrille {
namespace internal {

/// A folder of our own for temporary files, removed with everything in it.
class Temporary_folder {
public:
  Temporary_folder()
  {
    std::string pattern = (std::filesystem::temp_directory_path() / "quadrille-XXXXXX").string();
    if (::mkdtemp(pattern.data()))
      m_path = pattern;
  }
  ~Temporary_folder()
  {
    std::error_code ignored;
    if (!m_path.empty())
      std::filesystem::remove_all(m_path, ignored);
  }
  Temporary_folder(const Temporary_folder&) = delete;
  Temporary_folder& operator=(const Temporary_folder&) = delete;
  /// Empty when no folder could be made.
  const std::filesystem::path& path() const { return m_path; }

private:
  std::filesystem::path m_path;
};

/// Forgets the size fields of the current Gmsh model: Gmsh 4.8 crashes when it writes some of them. It does not tell
/// their tags, so all that are usual are tried.
inline void remove_size_fields()
{
  for (int tag = 1; tag <= 1000; ++tag)
    try {
      gmsh::model::mesh::field::remove(tag);
    } catch (...) { // of several types in different versions; there is no such field
      continue;
    }
}

/// The element sizes that the points of the current Gmsh model (built-in kernel) carry, by point tag.
///
/// Gmsh 4.8 has no call that returns them, but it writes them: `cl__1 = 0.5; Point(1) = {x, y, z, cl__1};`.
inline std::map<int, double> read_point_sizes()
{
  constexpr double no_size = 1e21; // Gmsh's default for a point without one is 1e22
  std::map<int, double> sizes;
  const Temporary_folder folder;
  if (folder.path().empty())
    return sizes;
  remove_size_fields();
  const std::string file_name = (folder.path() / "model.geo_unrolled").string();
  gmsh::write(file_name);
  std::ifstream file(file_name);
  std::map<std::string, double> variables;
  for (std::string line; std::getline(file, line);) {
    const std::size_t equals = line.find(" = ");
    if (equals == std::string::npos)
      continue;
    if (line.rfind("cl__", 0) == 0)
      variables[line.substr(0, equals)] = std::strtod(line.c_str() + equals + 3, nullptr);
    const std::size_t comma = line.rfind(", ");
    if (line.rfind("Point(", 0) != 0 || std::count(line.begin(), line.end(), ',') != 3)
      continue;
    const std::string value = line.substr(comma + 2, line.find('}') - comma - 2);
    const auto variable = variables.find(value);
    const double size = variable != variables.end() ? variable->second : std::strtod(value.c_str(), nullptr);
    if (size > 0 && size < no_size)
      sizes[std::atoi(line.c_str() + 6)] = size;
  }
  return sizes;
}

} // namespace internal
} // namespace Quadrille

#endif
