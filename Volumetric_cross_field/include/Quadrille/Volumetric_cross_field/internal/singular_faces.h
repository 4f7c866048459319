// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_SINGULAR_FACES_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_SINGULAR_FACES_H

#include <Quadrille/Metric_connection.h>
#include <Quadrille/Volumetric_cross_field/internal/Tetrahedron_adjacency.h>
#include <Quadrille/octahedral_group.h>
#include <Quadrille/parallel_for.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace Quadrille {
namespace internal {

/// How the frames at the ends of an edge compare.
class Edge_matcher {
public:
  Edge_matcher(const std::vector<Eigen::Matrix3d>& frames, const Metric_connection& connection)
      : m_frames(frames), m_connection(connection)
  {
  }

  /// The rotation from the frame at u to that at v, in the frame at u.
  Eigen::Matrix3d difference(int u, int v) const
  {
    const Eigen::Matrix3d& at_u = m_frames[std::size_t(u)];
    Eigen::Matrix3d at_v = m_frames[std::size_t(v)];
    if (!m_connection.is_identity())
      at_v = (m_connection(v, u) * at_v).eval();
    return at_u.transpose() * at_v;
  }

  /// Which axes correspond: the nearest element of the octahedral group. The matching from v to u is the inverse.
  Octahedral_rotation matching(int u, int v) const
  {
    // From the smaller number to the larger, so that all tetrahedra agree where several elements are as near.
    return u < v ? Octahedral_rotation::nearest(difference(u, v))
                 : Octahedral_rotation::nearest(difference(v, u)).inverse();
  }

private:
  const std::vector<Eigen::Matrix3d>& m_frames;
  const Metric_connection& m_connection;
};

/// Per tetrahedron the set of its singular faces, as bits: those around which the matchings of the edges are not the
/// identity. Never exactly one, since the product around all four faces is the identity.
template <class Mesh>
std::vector<unsigned char> singular_faces(const Mesh& mesh, const Edge_matcher& matcher, int threads)
{
  std::vector<unsigned char> result(mesh.number_of_tetrahedra());
  parallel_for(result.size(), threads, [&](std::size_t t) {
    const std::array<int, 4> corners = corners_of(mesh, t);
    std::array<std::array<Octahedral_rotation, 4>, 4> matching;
    for (const auto& edge : corners_of_edges) {
      const std::size_t a = std::size_t(edge[0]), b = std::size_t(edge[1]);
      matching[a][b] = matcher.matching(corners[a], corners[b]);
      matching[b][a] = matching[a][b].inverse();
    }
    unsigned char faces = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& [a, b, c] = corners_of_faces[i];
      const Octahedral_rotation turn = matching[std::size_t(a)][std::size_t(b)] *
                                       matching[std::size_t(b)][std::size_t(c)] *
                                       matching[std::size_t(c)][std::size_t(a)];
      if (turn.number() != 0)
        faces = static_cast<unsigned char>(faces | (1 << i));
    }
    result[t] = faces;
  });
  return result;
}

} // namespace internal
} // namespace Quadrille

#endif
