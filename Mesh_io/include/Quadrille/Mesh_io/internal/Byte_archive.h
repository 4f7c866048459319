// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_BYTE_ARCHIVE_H
#define QUADRILLE_MESH_IO_INTERNAL_BYTE_ARCHIVE_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Tetrahedral_mesh.h>
#include <Quadrille/exceptions.h>

#include <array>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace Quadrille {
namespace internal {

/// Values as bytes, for passing results between two processes of the same program.
class Byte_writer {
public:
  template <class... T> void operator()(const T&... values) { (put(values), ...); }
  std::vector<char> bytes;

private:
  template <class T> void put(const T& value)
  {
    if constexpr (std::is_trivially_copyable_v<T>) {
      const char* begin = reinterpret_cast<const char*>(&value);
      bytes.insert(bytes.end(), begin, begin + sizeof(T));
    } else {
      exchange(*this, const_cast<T&>(value));
    }
  }
  template <class T> void put(const std::vector<T>& values)
  {
    put(values.size());
    if constexpr (std::is_trivially_copyable_v<T>) {
      const char* begin = reinterpret_cast<const char*>(values.data());
      bytes.insert(bytes.end(), begin, begin + values.size() * sizeof(T));
    } else {
      for (const T& value : values)
        put(value);
    }
  }
  void put(const std::string& text)
  {
    put(text.size());
    bytes.insert(bytes.end(), text.begin(), text.end());
  }
};

/// The counterpart of `Byte_writer`.
class Byte_reader {
public:
  explicit Byte_reader(const std::vector<char>& bytes) : m_bytes(bytes) {}
  template <class... T> void operator()(T&... values) { (get(values), ...); }

private:
  void check(std::size_t n, std::size_t bytes_each) const
  {
    if (n > (m_bytes.size() - m_position) / bytes_each)
      throw Error("the result of a child process is incomplete");
  }
  const char* take(std::size_t n)
  {
    check(n, 1);
    m_position += n;
    return m_bytes.data() + (m_position - n);
  }
  template <class T> void get(T& value)
  {
    if constexpr (std::is_trivially_copyable_v<T>)
      std::memcpy(&value, take(sizeof(T)), sizeof(T));
    else
      exchange(*this, value);
  }
  template <class T> void get(std::vector<T>& values)
  {
    std::size_t n = 0;
    get(n);
    values.clear();
    if constexpr (std::is_trivially_copyable_v<T>) {
      check(n, sizeof(T));
      values.resize(n);
      if (n > 0)
        std::memcpy(values.data(), take(n * sizeof(T)), n * sizeof(T));
    } else {
      for (std::size_t i = 0; i < n; ++i) {
        values.emplace_back();
        get(values.back());
      }
    }
  }
  void get(std::string& text)
  {
    std::size_t n = 0;
    get(n);
    const char* begin = take(n);
    text.assign(begin, begin + n);
  }

  const std::vector<char>& m_bytes;
  std::size_t m_position = 0;
};

template <class Archive> void exchange(Archive& archive, Physical_group& g) { archive(g.dimension, g.tag, g.name); }

template <class Archive> void exchange(Archive& archive, Entity_label& label) { archive(label.tag, label.names); }

template <class Archive> void exchange(Archive& archive, Labelled_mesh& m)
{
  archive(m.points, m.polygons, m.polygon_region, m.lines, m.line_curve, m.curves, m.regions, m.groups);
}

template <class Archive> void exchange(Archive& archive, Tetrahedral_mesh& m)
{
  archive(m.points, m.tetrahedra, m.feature_edges);
}

/// What a geometry file becomes: triangles with labels, and what the user should know about them.
struct Geometry_triangulation {
  Labelled_mesh mesh;
  std::vector<double> point_size; ///< per point, 0 where none is prescribed
  /// Per line, the curve's unit tangents at its two ends, in the line's direction: x, y, x, y.
  std::vector<std::array<double, 4>> line_tangents;
  double triangle_size = 0;
  std::vector<std::string> notes;
};

template <class Archive> void exchange(Archive& archive, Geometry_triangulation& t)
{
  archive(t.mesh, t.point_size, t.line_tangents, t.triangle_size, t.notes);
}

} // namespace internal
} // namespace Quadrille

#endif
