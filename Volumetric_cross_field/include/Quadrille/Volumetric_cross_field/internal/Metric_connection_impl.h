// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_METRIC_CONNECTION_IMPL_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_METRIC_CONNECTION_IMPL_H

#include <array>
#include <cmath>

namespace Quadrille {
namespace internal {

/// The recursion of `Linear_root::transport` along an edge `x`, on which A is linear from `at_begin` to `at_end`.
class Edge_transport {
public:
  Edge_transport(const Eigen::Vector3d& x, const Eigen::Matrix3d& at_begin, const Eigen::Matrix3d& at_end,
                 const Eigen::Matrix3d& curl, double tolerance)
      : m_x(x), m_begin(at_begin), m_end(at_end), m_curl(curl), m_tolerance(tolerance)
  {
  }

  Eigen::Matrix3d run()
  {
    const Eigen::Vector3d first = speed(0), last = speed(1);
    return divide(0, 1, first, last, turn(0, 1, first, last), 0);
  }
  int samples() const { return m_samples; }

private:
  static constexpr int max_depth = 20; // where rounding ends all progress

  /// W x.
  Eigen::Vector3d speed(double t)
  {
    ++m_samples;
    return connection_form((1 - t) * m_begin + t * m_end, m_curl) * m_x;
  }

  static Eigen::Matrix3d turn(double s, double t, const Eigen::Vector3d& at_s, const Eigen::Vector3d& at_t)
  {
    return rotation_of(-0.5 * (t - s) * (at_s + at_t));
  }

  Eigen::Matrix3d divide(double s, double t, const Eigen::Vector3d& at_s, const Eigen::Vector3d& at_t,
                         const Eigen::Matrix3d& whole, int depth)
  {
    const double middle = 0.5 * (s + t);
    const Eigen::Vector3d at_middle = speed(middle);
    const Eigen::Matrix3d first = turn(s, middle, at_s, at_middle), second = turn(middle, t, at_middle, at_t);
    const Eigen::Matrix3d halves = second * first;
    if (depth == max_depth || (whole - halves).norm() <= m_tolerance * (t - s))
      return halves;
    return divide(middle, t, at_middle, at_t, second, depth + 1) * divide(s, middle, at_s, at_middle, first, depth + 1);
  }

  const Eigen::Vector3d m_x;
  const Eigen::Matrix3d &m_begin, &m_end, &m_curl;
  double m_tolerance;
  int m_samples = 0;
};

} // namespace internal

inline Linear_root::Linear_root(const Eigen::Matrix<double, 3, 4>& points, const std::array<Eigen::Matrix3d, 4>& roots)
    : m_points(points), m_roots(roots), m_curl(Eigen::Matrix3d::Zero())
{
  const Eigen::Matrix<double, 3, 4> gradients = internal::gradients_of_corners(points);
  for (int corner = 0; corner < 4; ++corner)
    for (int row = 0; row < 3; ++row)
      m_curl.row(row) += gradients.col(corner).cross(roots[std::size_t(corner)].row(row).transpose()).transpose();
}

inline Eigen::Matrix3d Linear_root::transport(std::size_t a, std::size_t b, double tolerance, int* samples) const
{
  const Eigen::Vector3d x = m_points.col(Eigen::Index(b)) - m_points.col(Eigen::Index(a));
  internal::Edge_transport edge(x, m_roots[a], m_roots[b], m_curl, tolerance);
  const Eigen::Matrix3d result = edge.run();
  if (samples)
    *samples = edge.samples();
  return result;
}

template <class TetrahedralMesh>
Metric_connection::Metric_connection(const TetrahedralMesh& mesh, const Metric_field& metric, double tolerance,
                                     int threads)
{
  const std::size_t n = mesh.number_of_vertices();
  const internal::Incidence tetrahedra = internal::tetrahedra_of_vertices(mesh);
  struct Turn {
    int high;
    double volume;
    Eigen::Vector3d vector;
  };
  std::vector<std::vector<Turn>> turns(n);
  parallel_for(n, threads, [&](std::size_t v) {
    for (const int* t = tetrahedra.begin(v); t != tetrahedra.end(v); ++t) {
      const std::array<int, 4> corners = internal::corners_of(mesh, std::size_t(*t));
      const Eigen::Matrix<double, 3, 4> points = internal::points_of(mesh, std::size_t(*t));
      std::array<Eigen::Matrix3d, 4> roots;
      for (std::size_t i = 0; i < 4; ++i)
        roots[i] = metric[std::size_t(corners[i])];
      const Linear_root root(points, roots);
      Eigen::Matrix3d edges;
      for (int i = 0; i < 3; ++i)
        edges.col(i) = points.col(i + 1) - points.col(0);
      const std::size_t at = std::size_t(std::find(corners.begin(), corners.end(), int(v)) - corners.begin());
      for (std::size_t i = 0; i < 4; ++i)
        if (corners[i] > int(v))
          turns[v].push_back(
              {corners[i], edges.determinant(), internal::rotation_vector_of(root.transport(at, i, tolerance))});
    }
    std::stable_sort(turns[v].begin(), turns[v].end(), [](const Turn& a, const Turn& b) { return a.high < b.high; });
  });
  m_first.assign(1, 0);
  for (const std::vector<Turn>& of_vertex : turns) {
    for (std::size_t i = 0; i < of_vertex.size();) {
      double volume = 0;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      const int high = of_vertex[i].high;
      for (; i < of_vertex.size() && of_vertex[i].high == high; ++i) {
        volume += of_vertex[i].volume;
        sum += of_vertex[i].volume * of_vertex[i].vector;
      }
      m_high.push_back(high);
      m_turn.push_back(sum / volume);
    }
    m_first.push_back(m_high.size());
  }
}

} // namespace Quadrille

#endif
