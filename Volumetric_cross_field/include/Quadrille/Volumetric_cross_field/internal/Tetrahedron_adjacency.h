// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_TETRAHEDRON_ADJACENCY_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_TETRAHEDRON_ADJACENCY_H

#include <Quadrille/exceptions.h>
#include <Quadrille/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// The corners of the face opposite to corner i of a tetrahedron, counterclockwise seen from outside.
constexpr std::array<std::array<int, 3>, 4> corners_of_faces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
/// The corners of its edges.
constexpr std::array<std::array<int, 2>, 6> corners_of_edges = {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

template <class Mesh> std::array<int, 4> corners_of(const Mesh& mesh, std::size_t t)
{
  const auto& corners = mesh.tetrahedron(t);
  return {int(corners[0]), int(corners[1]), int(corners[2]), int(corners[3])};
}

template <class Mesh> std::array<int, 3> face_of(const Mesh& mesh, std::size_t t, int i)
{
  const std::array<int, 4> corners = corners_of(mesh, t);
  const auto& face = corners_of_faces[std::size_t(i)];
  return {corners[std::size_t(face[0])], corners[std::size_t(face[1])], corners[std::size_t(face[2])]};
}

/// The lists of what is incident to each of n things, all in one array.
class Incidence {
public:
  /// `for_each(add)` calls add(thing, item) for all pairs, twice in the same order; items come out in that order.
  template <class For_each> Incidence(std::size_t n, const For_each& for_each) : m_first(n + 1, 0)
  {
    for_each([&](int thing, int) { ++m_first[std::size_t(thing) + 1]; });
    for (std::size_t i = 0; i < n; ++i)
      m_first[i + 1] += m_first[i];
    m_items.resize(m_first[n]);
    std::vector<std::size_t> end(m_first.begin(), m_first.end() - 1);
    for_each([&](int thing, int item) { m_items[end[std::size_t(thing)]++] = item; });
  }

  const int* begin(std::size_t thing) const { return m_items.data() + m_first[thing]; }
  const int* end(std::size_t thing) const { return m_items.data() + m_first[thing + 1]; }
  std::size_t size(std::size_t thing) const { return m_first[thing + 1] - m_first[thing]; }

private:
  std::vector<std::size_t> m_first;
  std::vector<int> m_items;
};

/// The tetrahedra at each vertex.
template <class Mesh> Incidence tetrahedra_of_vertices(const Mesh& mesh)
{
  return Incidence(mesh.number_of_vertices(), [&](const auto& add) {
    for (std::size_t t = 0; t < mesh.number_of_tetrahedra(); ++t)
      for (const int v : corners_of(mesh, t))
        add(v, int(t));
  });
}

/// Which tetrahedra share faces.
///
/// \throws Invalid_input_error naming the tetrahedra where more than two share a face, or two on the same side of it.
class Tetrahedron_adjacency {
public:
  static constexpr int outside = -1;

  template <class Mesh>
  explicit Tetrahedron_adjacency(const Mesh& mesh, int threads = 1)
      : m_neighbours(mesh.number_of_tetrahedra(), {outside, outside, outside, outside})
  {
    // Each face belongs to its vertex with the smallest number.
    const Incidence faces(mesh.number_of_vertices(), [&](const auto& add) {
      for (std::size_t t = 0; t < mesh.number_of_tetrahedra(); ++t)
        for (int i = 0; i < 4; ++i) {
          const std::array<int, 3> face = face_of(mesh, t, i);
          add(*std::min_element(face.begin(), face.end()), int(4 * t) + i);
        }
    });
    try {
      parallel_for(mesh.number_of_vertices(), threads, [&](std::size_t v) { match(mesh, faces, v); });
    } catch (const Invalid_input_error&) {
      // Whatever thread was the first to find something, the report is about the first place.
      for (std::size_t v = 0; v < mesh.number_of_vertices(); ++v)
        match(mesh, faces, v);
      throw;
    }
  }

  /// The tetrahedron beyond the face opposite to corner i of t, or `outside`.
  int neighbour(std::size_t t, int i) const { return m_neighbours[t][std::size_t(i)]; }

private:
  struct Face {
    std::array<int, 2> others; ///< the vertices but the first, sorted
    bool is_turned;            ///< whether sorting turned the face
    int number;                ///< 4 t + i
  };

  template <class Mesh> void match(const Mesh& mesh, const Incidence& incident, std::size_t v)
  {
    std::vector<Face> faces;
    for (const int* number = incident.begin(v); number != incident.end(v); ++number) {
      const std::array<int, 3> face = face_of(mesh, std::size_t(*number / 4), *number % 4);
      const std::size_t at = std::size_t(std::find(face.begin(), face.end(), int(v)) - face.begin());
      const int p = face[(at + 1) % 3], q = face[(at + 2) % 3];
      faces.push_back({{std::min(p, q), std::max(p, q)}, p > q, *number});
    }
    std::sort(faces.begin(), faces.end(), [](const Face& f, const Face& g) {
      return std::make_pair(f.others, f.number) < std::make_pair(g.others, g.number);
    });
    for (std::size_t i = 0; i + 1 < faces.size(); ++i) {
      if (faces[i].others != faces[i + 1].others)
        continue;
      if (i + 2 < faces.size() && faces[i + 2].others == faces[i].others)
        throw Invalid_input_error("tetrahedra " + name(faces[i]) + ", " + name(faces[i + 1]) + " and " +
                                  name(faces[i + 2]) +
                                  " have a face in common: the mesh is not manifold. Remove what overlaps");
      if (faces[i].is_turned == faces[i + 1].is_turned)
        throw Invalid_input_error("tetrahedra " + name(faces[i]) + " and " + name(faces[i + 1]) +
                                  " lie on the same side of the face that they share: one of them is inverted, or they "
                                  "overlap. Mesh the volume again");
      set(faces[i].number, faces[i + 1].number / 4);
      set(faces[i + 1].number, faces[i].number / 4);
      ++i;
    }
  }

  static std::string name(const Face& face) { return std::to_string(face.number / 4); }
  void set(int number, int neighbour) { m_neighbours[std::size_t(number / 4)][std::size_t(number % 4)] = neighbour; }

  std::vector<std::array<int, 4>> m_neighbours;
};

/// The faces without a neighbour, as vertices counterclockwise seen from outside.
template <class Mesh>
std::vector<std::array<int, 3>> boundary_faces(const Mesh& mesh, const Tetrahedron_adjacency& adjacency)
{
  std::vector<std::array<int, 3>> result;
  for (std::size_t t = 0; t < mesh.number_of_tetrahedra(); ++t)
    for (int i = 0; i < 4; ++i)
      if (adjacency.neighbour(t, i) == Tetrahedron_adjacency::outside)
        result.push_back(face_of(mesh, t, i));
  return result;
}

} // namespace internal
} // namespace Quadrille

#endif
