// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_SINGULAR_FACE_PATHS_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_SINGULAR_FACE_PATHS_H

#include <Quadrille/Metric_field.h>
#include <Quadrille/Volumetric_cross_field/internal/Tetrahedron_adjacency.h>
#include <Quadrille/Volumetric_cross_field/internal/connection_form.h>
#include <Quadrille/Volumetric_cross_field/internal/singular_faces.h>
#include <Quadrille/octahedral_group.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

/// The raw curves: sequences of singular faces from tetrahedron to tetrahedron.
struct Singular_face_paths {
  static constexpr int at_boundary = -1;

  struct Passage {
    Eigen::Vector3d point; ///< the face's centre
    /// The axis about which the frames turn, counterclockwise for one who looks against the path's direction; a unit
    /// vector in coordinates in which tangents are multiplied by `root`.
    Eigen::Vector3d axis;
    Eigen::Matrix3d root;
  };
  struct Path {
    Octahedral_rotation::Kind kind;           ///< the same all along
    int from = at_boundary, to = at_boundary; ///< nodes
    bool is_loop = false;
    std::vector<Passage> passages;
    std::vector<int> tetrahedra;
    double edge_length = 0; ///< the mean over the tetrahedra
  };

  std::vector<Path> paths;
  std::vector<Eigen::Vector3d> nodes; ///< centres of the tetrahedra with more than two singular faces
};

/// Follows the singular faces.
template <class Mesh> class Singular_face_tracer {
public:
  Singular_face_tracer(const Mesh& mesh, const std::vector<Eigen::Matrix3d>& frames, const Edge_matcher& matcher,
                       const Metric_field* metric)
      : m_mesh(mesh), m_frames(frames), m_matcher(matcher), m_metric(metric)
  {
  }

  /// `singular`: see `singular_faces`.
  Singular_face_paths trace(const std::vector<unsigned char>& singular)
  {
    collect(singular);
    for (auto& [t, faces] : m_faces_of)
      if (faces.size() > 2) {
        m_node_of[t] = int(m_result.nodes.size());
        m_result.nodes.push_back(points_of(m_mesh, std::size_t(t)).rowwise().mean());
      }
    m_is_visited.assign(m_faces.size(), false);
    for (const auto& [t, node] : m_node_of)
      for (const int f : m_faces_of.at(t))
        if (!m_is_visited[std::size_t(f)])
          follow(f, t);
    for (std::size_t f = 0; f < m_faces.size(); ++f)
      if (m_faces[f].sides[1] == outside && !m_is_visited[f])
        follow(int(f), outside);
    for (std::size_t f = 0; f < m_faces.size(); ++f)
      if (!m_is_visited[f])
        follow(int(f), m_faces[f].sides[0]);
    return std::move(m_result);
  }

private:
  static constexpr int outside = -1;

  struct Face {
    std::array<int, 3> vertices; ///< counterclockwise seen from outside the first side
    std::array<int, 2> sides;    ///< tetrahedra
  };

  void collect(const std::vector<unsigned char>& singular)
  {
    std::map<std::array<int, 3>, int> numbers;
    for (std::size_t t = 0; t < singular.size(); ++t) {
      if (singular[t] == 0)
        continue;
      if (std::bitset<4>(singular[t]).count() == 1)
        throw std::logic_error("tetrahedron " + std::to_string(t) + " has a single singular face");
      for (int i = 0; i < 4; ++i) {
        if ((singular[t] >> i & 1) == 0)
          continue;
        const std::array<int, 3> vertices = face_of(m_mesh, t, i);
        std::array<int, 3> sorted = vertices;
        std::sort(sorted.begin(), sorted.end());
        const auto [place, is_new] = numbers.emplace(sorted, int(m_faces.size()));
        if (is_new)
          m_faces.push_back({vertices, {int(t), outside}});
        else
          m_faces[std::size_t(place->second)].sides[1] = int(t);
        m_faces_of[int(t)].push_back(place->second);
      }
    }
  }

  /// From face `f`, coming from tetrahedron `t`.
  void follow(int f, int t)
  {
    Singular_face_paths::Path path;
    path.kind = turn(m_faces[std::size_t(f)], true).kind();
    const auto start = m_node_of.find(t);
    if (start != m_node_of.end())
      path.from = start->second;
    const int first = f;
    for (;;) {
      const Face& face = m_faces[std::size_t(f)];
      m_is_visited[std::size_t(f)] = true;
      const bool is_forward = face.sides[0] == t;
      path.passages.push_back(passage(face, is_forward));
      t = is_forward ? face.sides[1] : face.sides[0];
      if (t == outside)
        break;
      const auto node = m_node_of.find(t);
      if (node != m_node_of.end()) {
        path.to = node->second;
        break;
      }
      path.tetrahedra.push_back(t);
      const std::vector<int>& both = m_faces_of.at(t);
      f = both[0] == f ? both[1] : both[0];
      if (f == first) {
        path.is_loop = true;
        break;
      }
    }
    path.edge_length = mean_edge_length(path);
    m_result.paths.push_back(std::move(path));
  }

  double mean_edge_length(const Singular_face_paths::Path& path) const
  {
    double sum = 0;
    std::size_t count = 0;
    for (const int t : path.tetrahedra) {
      const Eigen::Matrix<double, 3, 4> points = points_of(m_mesh, std::size_t(t));
      for (const auto& edge : corners_of_edges)
        sum += (points.col(edge[0]) - points.col(edge[1])).norm();
      count += corners_of_edges.size();
    }
    return count > 0 ? sum / double(count) : 0;
  }

  /// The vertices of a face counterclockwise for one who looks against the direction.
  static std::array<int, 3> around(const Face& face, bool is_forward)
  {
    return is_forward ? face.vertices : std::array<int, 3>{face.vertices[0], face.vertices[2], face.vertices[1]};
  }

  Octahedral_rotation turn(const Face& face, bool is_forward) const
  {
    const auto [a, b, c] = around(face, is_forward);
    return m_matcher.matching(a, b) * m_matcher.matching(b, c) * m_matcher.matching(c, a);
  }

  Singular_face_paths::Passage passage(const Face& face, bool is_forward) const
  {
    const std::array<int, 3> vertices = around(face, is_forward);
    Singular_face_paths::Passage result;
    result.point.setZero();
    for (const int v : vertices)
      result.point += Eigen::Vector3d(m_mesh.point(std::size_t(v))) / 3;
    const std::size_t a = std::size_t(vertices[0]);
    result.root = m_metric ? (*m_metric)[a] : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
    const Octahedral_rotation turned = turn(face, is_forward);
    result.axis = (m_frames[a] * turned.axis().cast<double>()).normalized();
    if (turned.kind() == Octahedral_rotation::Kind::half_turn && result.axis.dot(total_turn(vertices)) > 0)
      result.axis = -result.axis;
    return result;
  }

  /// The sum of the rotation vectors from frame to frame around a face: for half turns, of which the element of the
  /// group does not tell the sense. It is the inverse of the turn that the matchings add up to.
  Eigen::Vector3d total_turn(const std::array<int, 3>& vertices) const
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      const int u = vertices[i], v = vertices[(i + 1) % 3];
      const Eigen::Matrix3d rest = m_matcher.difference(u, v) * m_matcher.matching(u, v).matrix().transpose();
      sum += m_frames[std::size_t(u)] * rotation_vector_of(rest);
    }
    return sum;
  }

  const Mesh& m_mesh;
  const std::vector<Eigen::Matrix3d>& m_frames;
  const Edge_matcher& m_matcher;
  const Metric_field* m_metric;
  std::vector<Face> m_faces;
  std::map<int, std::vector<int>> m_faces_of; ///< per tetrahedron
  std::map<int, int> m_node_of;               ///< per tetrahedron
  std::vector<bool> m_is_visited;
  Singular_face_paths m_result;
};

} // namespace internal
} // namespace Quadrille

#endif
