// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_BOUNDARY_ALIGNER_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_BOUNDARY_ALIGNER_H

#include <Quadrille/Metric_field.h>
#include <Quadrille/Volumetric_cross_field/internal/Tetrahedron_adjacency.h>
#include <Quadrille/cross_alignment.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <map>
#include <set>
#include <vector>

namespace Quadrille {
namespace internal {

/// See `align_with_boundary`.
template <class Mesh> class Boundary_aligner {
public:
  Boundary_aligner(const Mesh& mesh, double crease_angle, double marked_crease_angle,
                   const std::vector<std::array<int, 2>>& marked_edges, const Metric_field* metric)
      : m_mesh(mesh), m_metric(metric), m_faces(boundary_faces(mesh, Tetrahedron_adjacency(mesh)))
  {
    for (const auto& face : m_faces) {
      const Eigen::Vector3d a = mesh.point(std::size_t(face[0])), b = mesh.point(std::size_t(face[1])),
                            c = mesh.point(std::size_t(face[2]));
      m_normals.push_back((b - a).cross(c - a).normalized());
    }
    find_creases(cosine(crease_angle), cosine(marked_crease_angle), marked_edges);
  }

  void align(std::vector<int>& alignment_of, std::vector<Cross_alignment>& alignments)
  {
    const std::size_t n = m_mesh.number_of_vertices();
    alignment_of.assign(n, -1);
    const Incidence faces_of(n, [&](const auto& add) {
      for (std::size_t f = 0; f < m_faces.size(); ++f)
        for (const int v : m_faces[f])
          add(v, int(f));
    });
    for (std::size_t v = 0; v < n; ++v) {
      if (faces_of.size(v) == 0)
        continue;
      Cross_alignment alignment;
      if (align_vertex(v, std::vector<int>(faces_of.begin(v), faces_of.end(v)), alignment)) {
        alignment_of[v] = int(alignments.size());
        alignments.push_back(alignment);
      } else {
        ++m_corner_vertices;
      }
    }
  }

  std::size_t number_of_crease_vertices() const { return m_crease_vertices; }
  std::size_t number_of_corner_vertices() const { return m_corner_vertices; }

private:
  using Edge = std::array<int, 2>;

  static double radians(double degrees) { return degrees * std::acos(-1.0) / 180; }
  static double cosine(double degrees) { return std::cos(radians(degrees)); }
  static Edge sorted(int u, int v) { return {std::min(u, v), std::max(u, v)}; }

  void find_creases(double cosine_of_crease, double cosine_of_marked, const std::vector<Edge>& marked_edges)
  {
    std::set<Edge> marked;
    for (const Edge& edge : marked_edges)
      marked.insert(sorted(edge[0], edge[1]));
    std::map<Edge, std::size_t> open; // edges of which one face has been met
    for (std::size_t f = 0; f < m_faces.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i) {
        const Edge edge = sorted(m_faces[f][i], m_faces[f][(i + 1) % 3]);
        const auto [place, is_new] = open.emplace(edge, f);
        if (is_new)
          continue;
        const double product = m_normals[f].dot(m_normals[place->second]);
        open.erase(place);
        if (product < cosine_of_crease || (product <= cosine_of_marked && marked.count(edge) != 0))
          m_creases.insert(edge);
      }
  }

  /// The face's angle at `v`, by which normals are weighted: independent of how the surface is triangulated.
  double angle_at(std::size_t v, int f) const
  {
    const auto& face = m_faces[std::size_t(f)];
    for (std::size_t i = 0; i < 3; ++i)
      if (std::size_t(face[i]) == v) {
        const Eigen::Vector3d p = m_mesh.point(v);
        const Eigen::Vector3d a = Eigen::Vector3d(m_mesh.point(std::size_t(face[(i + 1) % 3]))) - p;
        const Eigen::Vector3d b = Eigen::Vector3d(m_mesh.point(std::size_t(face[(i + 2) % 3]))) - p;
        return std::atan2(a.cross(b).norm(), a.dot(b));
      }
    return 0;
  }

  /// The faces at v in groups between creases, and the far ends of the creases.
  std::vector<std::vector<int>> sectors(std::size_t v, const std::vector<int>& faces, std::vector<int>& ends) const
  {
    std::map<int, std::vector<std::size_t>> faces_with; // per neighbour in the boundary
    for (std::size_t k = 0; k < faces.size(); ++k)
      for (const int u : m_faces[std::size_t(faces[k])])
        if (std::size_t(u) != v)
          faces_with[u].push_back(k);
    std::vector<std::size_t> leader(faces.size());
    for (std::size_t k = 0; k < faces.size(); ++k)
      leader[k] = k;
    const auto find = [&](std::size_t k) {
      while (leader[k] != k)
        k = leader[k];
      return k;
    };
    for (const auto& [u, both] : faces_with) {
      if (m_creases.count(sorted(u, int(v))) != 0)
        ends.push_back(u);
      else
        leader[find(both.front())] = find(both.back());
    }
    std::map<std::size_t, std::vector<int>> groups;
    for (std::size_t k = 0; k < faces.size(); ++k)
      groups[find(k)].push_back(faces[k]);
    std::vector<std::vector<int>> result;
    for (const auto& group : groups)
      result.push_back(group.second);
    return result;
  }

  Eigen::Vector3d normal_of(std::size_t v, const std::vector<int>& faces) const
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int f : faces)
      sum += angle_at(v, f) * m_normals[std::size_t(f)];
    return sum.normalized();
  }

  /// False where the cross stays free.
  bool align_vertex(std::size_t v, const std::vector<int>& faces, Cross_alignment& alignment)
  {
    std::vector<int> ends;
    const std::vector<std::vector<int>> groups = sectors(v, faces, ends);
    if (groups.size() == 1 && ends.size() < 2) {
      const Eigen::Vector3d n = normal_of(v, faces);
      for (const int f : faces)
        if (!(n.dot(m_normals[std::size_t(f)]) > cosine(60))) // such as the tip of a cone
          return false;
      alignment = Cross_alignment::with_axis(covector(v, n));
      return true;
    }
    if (groups.size() != 2 || ends.size() != 2)
      return false;
    const Eigen::Vector3d p = m_mesh.point(v);
    const Eigen::Vector3d to_first = (Eigen::Vector3d(m_mesh.point(std::size_t(ends[0]))) - p).normalized();
    const Eigen::Vector3d to_second = (Eigen::Vector3d(m_mesh.point(std::size_t(ends[1]))) - p).normalized();
    if (!(to_first.dot(to_second) < -cosine(45)))
      return false;
    ++m_crease_vertices;
    alignment = on_crease(vector(v, to_first - to_second), covector(v, normal_of(v, groups[0])),
                          covector(v, normal_of(v, groups[1])));
    return true;
  }

  static Cross_alignment on_crease(const Eigen::Vector3d& tangent, const Eigen::Vector3d& n1, const Eigen::Vector3d& n2)
  {
    Eigen::Matrix3d frame;
    const Eigen::Vector3d x = (n1 - tangent * tangent.dot(n1)).normalized();
    frame << x, tangent.cross(x), tangent;
    const std::complex<double> second(frame.col(0).dot(n2), frame.col(1).dot(n2));
    const std::complex<double> mean = 0.5 * (1.0 + std::pow(second / std::abs(second), 4));
    if (!(std::abs(mean) > 0.25)) // the two normals are within 8 degrees of contradicting each other
      return Cross_alignment::with_axis(tangent);
    const double angle = std::arg(mean) / 4;
    const Eigen::Matrix3d R = frame * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    return Cross_alignment::with_frame(R);
  }

  Eigen::Vector3d covector(std::size_t v, const Eigen::Vector3d& n) const
  {
    return m_metric ? Eigen::Vector3d((*m_metric)[v].inverse() * n).normalized() : n;
  }
  Eigen::Vector3d vector(std::size_t v, const Eigen::Vector3d& t) const
  {
    return (m_metric ? Eigen::Vector3d((*m_metric)[v] * t) : t).normalized();
  }

  const Mesh& m_mesh;
  const Metric_field* m_metric;
  std::vector<std::array<int, 3>> m_faces;
  std::vector<Eigen::Vector3d> m_normals; ///< per face
  std::set<Edge> m_creases;
  std::size_t m_crease_vertices = 0, m_corner_vertices = 0;
};

} // namespace internal
} // namespace Quadrille

#endif
