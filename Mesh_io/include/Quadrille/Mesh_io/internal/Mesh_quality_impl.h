// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_MESH_QUALITY_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_MESH_QUALITY_IMPL_H

#include <Quadrille/Curve_locator.h>
#include <Quadrille/Mesh_io/internal/check_triangles.h>
#include <Quadrille/Mesh_io/internal/format_place.h>
#include <Quadrille/Mesh_quality.h>
#include <Quadrille/Support/internal/segment_intersections.h>
#include <Quadrille/Support/internal/separate_compilation.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace Quadrille {
namespace internal {

class Quad_mesh_checker {
public:
  explicit Quad_mesh_checker(const Labelled_mesh& mesh) : m_mesh(mesh) {}

  Mesh_validity run()
  {
    if (m_mesh.polygons.empty())
      m_result.problems.push_back("there are no polygons");
    if (m_mesh.polygons.empty() || !check_coordinates())
      return std::move(m_result);
    count_edges();
    check_polygons();
    check_edges();
    check_vertices();
    check_border();
    return std::move(m_result);
  }

private:
  void problem(std::size_t& count, const std::string& sentence)
  {
    if (count++ == 0)
      m_result.problems.push_back(sentence);
  }

  std::string vertex_text(int v) const
  {
    return "vertex " + std::to_string(v) + " at " +
           format_place(m_points[std::size_t(v)].x(), m_points[std::size_t(v)].y());
  }

  bool check_coordinates()
  {
    m_is_used.assign(m_mesh.points.size(), 0);
    for (const std::vector<int>& polygon : m_mesh.polygons)
      for (const int v : polygon)
        m_is_used[std::size_t(v)] = 1;
    double low = 0, high = 0;
    bool first = true;
    CGAL::Bbox_2 box;
    for (std::size_t v = 0; v < m_mesh.points.size(); ++v) {
      const std::array<double, 3>& p = m_mesh.points[v];
      const bool is_finite = std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
      m_points.push_back(is_finite ? Segment_kernel::Point_2(p[0], p[1]) : Segment_kernel::Point_2(0, 0));
      if (!m_is_used[v]) {
        ++m_result.isolated_vertices;
        continue;
      }
      if (!is_finite) {
        m_result.problems.push_back("vertex " + std::to_string(v) + " has a coordinate that is not a finite number");
        return false;
      }
      low = first ? p[2] : std::min(low, p[2]);
      high = first ? p[2] : std::max(high, p[2]);
      first = false;
      box += m_points.back().bbox();
    }
    if (high - low > Triangle_checker::planarity_tolerance * std::max(box.xmax() - box.xmin(), box.ymax() - box.ymin()))
      m_result.problems.push_back("z is not constant; only planar meshes are checked");
    return high - low <=
           Triangle_checker::planarity_tolerance * std::max(box.xmax() - box.xmin(), box.ymax() - box.ymin());
  }

  void count_edges()
  {
    for (std::size_t f = 0; f < m_mesh.polygons.size(); ++f) {
      const std::vector<int>& polygon = m_mesh.polygons[f];
      for (std::size_t i = 0; i < polygon.size(); ++i)
        ++m_uses[{polygon[i], polygon[(i + 1) % polygon.size()]}];
    }
  }

  void check_polygons()
  {
    std::size_t n_clockwise = 0, n_counterclockwise = 0;
    const auto turn = [&](const std::vector<int>& polygon, std::size_t i) {
      const std::size_t n = polygon.size();
      return CGAL::orientation(m_points[std::size_t(polygon[(i + n - 1) % n])], m_points[std::size_t(polygon[i])],
                               m_points[std::size_t(polygon[(i + 1) % n])]);
    };
    for (const std::vector<int>& polygon : m_mesh.polygons)
      for (std::size_t i = 0; i < polygon.size(); ++i)
        ++(turn(polygon, i) == CGAL::CLOCKWISE ? n_clockwise : n_counterclockwise);
    m_result.clockwise = n_counterclockwise == 0;
    const CGAL::Orientation wanted = m_result.clockwise ? CGAL::CLOCKWISE : CGAL::COUNTERCLOCKWISE;
    for (std::size_t f = 0; f < m_mesh.polygons.size(); ++f) {
      const std::vector<int>& polygon = m_mesh.polygons[f];
      const std::string name = "polygon " + std::to_string(f);
      if (polygon.size() != 4)
        problem(m_result.non_quads, name + " has " + std::to_string(polygon.size()) + " corners, not 4");
      if (std::set<int>(polygon.begin(), polygon.end()).size() != polygon.size()) {
        problem(m_result.degenerate_quads, name + " uses a vertex twice");
        continue;
      }
      for (std::size_t i = 0; i < polygon.size(); ++i)
        if (turn(polygon, i) != wanted)
          problem(m_result.inverted_corners, name + " has an inverted or flat corner at " + vertex_text(polygon[i]));
    }
  }

  void check_edges()
  {
    for (const auto& [edge, n] : m_uses) {
      const auto back = m_uses.find({edge.second, edge.first});
      const bool has_back = back != m_uses.end();
      if (n > 1)
        problem(m_result.non_manifold_edges, "the edge from " + vertex_text(edge.first) + " to " +
                                                 vertex_text(edge.second) +
                                                 " is in several polygons that lie on the same side of it");
      else if (!has_back)
        m_border.push_back({{edge.first, edge.second}});
    }
  }

  void check_vertices()
  {
    std::vector<int> order;
    std::vector<int> n_border(m_points.size(), 0);
    for (std::size_t v = 0; v < m_points.size(); ++v)
      if (m_is_used[v])
        order.push_back(int(v));
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      const auto c = CGAL::compare_xy(m_points[std::size_t(a)], m_points[std::size_t(b)]);
      return c == CGAL::SMALLER || (c == CGAL::EQUAL && a < b);
    });
    for (std::size_t i = 1; i < order.size(); ++i)
      if (m_points[std::size_t(order[i - 1])] == m_points[std::size_t(order[i])])
        problem(m_result.duplicate_vertices, vertex_text(order[i]) + " has the coordinates of vertex " +
                                                 std::to_string(order[i - 1]) + ": the quads there are not connected");
    for (const Numbered_segment& s : m_border)
      if (++n_border[std::size_t(s.ends[0])] == 2)
        problem(m_result.non_manifold_vertices, "several parts of the mesh touch only in " + vertex_text(s.ends[0]));
    m_result.euler_characteristic =
        int(order.size()) - int((m_uses.size() + m_border.size()) / 2) + int(m_mesh.polygons.size());
  }

  void check_border()
  {
    m_result.components = count_sets(
        [&](const auto& join) {
          for (const std::vector<int>& polygon : m_mesh.polygons)
            for (std::size_t i = 1; i < polygon.size(); ++i)
              join(polygon[0], polygon[i]);
        },
        m_is_used);
    std::vector<char> is_on_border(m_points.size(), 0);
    for (const Numbered_segment& s : m_border)
      is_on_border[std::size_t(s.ends[0])] = is_on_border[std::size_t(s.ends[1])] = 1;
    m_result.boundary_loops = count_sets(
        [&](const auto& join) {
          for (const Numbered_segment& s : m_border)
            join(s.ends[0], s.ends[1]);
        },
        is_on_border);
    if (const auto pair = find_segment_conflict(m_points, m_border))
      problem(m_result.overlapping_borders, "the border meets itself near " +
                                                vertex_text(m_border[pair->first].ends[0]) +
                                                ": polygons overlap, or share a part of an edge only");
  }

  /// Number of connected sets among the vertices with a non-zero `member`.
  template <class Joins> static int count_sets(const Joins& joins, const std::vector<char>& member)
  {
    std::vector<int> parent(member.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int v) {
      while (parent[std::size_t(v)] != v)
        v = parent[std::size_t(v)] = parent[std::size_t(parent[std::size_t(v)])];
      return v;
    };
    int n = int(std::count(member.begin(), member.end(), 1));
    joins([&](int a, int b) {
      a = root(a);
      b = root(b);
      n -= a != b;
      parent[std::size_t(a)] = b;
    });
    return n;
  }

  const Labelled_mesh& m_mesh;
  Mesh_validity m_result;
  std::vector<Segment_kernel::Point_2> m_points;
  std::vector<char> m_is_used;
  std::map<std::pair<int, int>, int> m_uses; ///< of directed edges
  std::vector<Numbered_segment> m_border;
};

} // namespace internal

QUADRILLE_INLINE std::vector<std::array<int, 2>> border_edges(const Labelled_mesh& mesh)
{
  std::set<std::pair<int, int>> directed;
  for (const std::vector<int>& polygon : mesh.polygons)
    for (std::size_t i = 0; i < polygon.size(); ++i)
      directed.insert({polygon[i], polygon[(i + 1) % polygon.size()]});
  std::vector<std::array<int, 2>> border;
  for (const auto& [a, b] : directed)
    if (!directed.count({b, a}))
      border.push_back({a, b});
  return border;
}

QUADRILLE_INLINE Mesh_validity check_quad_mesh(const Labelled_mesh& mesh)
{
  return internal::Quad_mesh_checker(mesh).run();
}

QUADRILLE_INLINE Mesh_quality measure_quality(const Labelled_mesh& mesh)
{
  Mesh_quality quality;
  std::vector<int> n_quads(mesh.points.size(), 0);
  std::size_t n = 0;
  double area = 0;
  const auto cross = [&](int a, int b, int c) {
    const auto &p = mesh.points[std::size_t(a)], &q = mesh.points[std::size_t(b)], &r = mesh.points[std::size_t(c)];
    return std::array<double, 2>{(q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]),
                                 (q[0] - p[0]) * (r[0] - p[0]) + (q[1] - p[1]) * (r[1] - p[1])};
  };
  for (const std::vector<int>& polygon : mesh.polygons)
    if (polygon.size() == 4)
      area += cross(polygon[0], polygon[1], polygon[2])[0] + cross(polygon[0], polygon[2], polygon[3])[0];
  const double sign = area < 0 ? -1 : 1;
  quality.scaled_jacobian_min = 1;
  for (const std::vector<int>& polygon : mesh.polygons) {
    if (polygon.size() != 4)
      continue;
    ++n;
    double jacobian = 1, skew = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      ++n_quads[std::size_t(polygon[i])];
      const std::array<double, 2> sc = cross(polygon[i], polygon[(i + 1) % 4], polygon[(i + 3) % 4]);
      const double length = std::hypot(sc[0], sc[1]); // product of the two edge lengths
      jacobian = std::min(jacobian, length > 0 ? sign * sc[0] / length : 0);
      double angle = std::atan2(sign * sc[0], sc[1]) * 180 / CGAL_PI;
      angle += angle < 0 ? 360 : 0;
      skew = std::max(skew, std::abs(angle - 90));
    }
    quality.scaled_jacobian_min = std::min(quality.scaled_jacobian_min, jacobian);
    quality.scaled_jacobian_mean += jacobian;
    quality.skew_mean += skew;
    quality.skew_max = std::max(quality.skew_max, skew);
  }
  if (n == 0)
    return Mesh_quality();
  quality.scaled_jacobian_mean /= double(n);
  quality.skew_mean /= double(n);
  std::vector<char> is_on_border(mesh.points.size(), 0);
  for (const std::array<int, 2>& edge : border_edges(mesh))
    is_on_border[std::size_t(edge[0])] = is_on_border[std::size_t(edge[1])] = 1;
  for (std::size_t v = 0; v < n_quads.size(); ++v)
    if (n_quads[v] != 0 && n_quads[v] != (is_on_border[v] ? 2 : 4))
      ++(is_on_border[v] ? quality.irregular_boundary : quality.irregular)[n_quads[v]];
  return quality;
}

namespace internal {

inline void add_deviation(Log_deviation& deviation, double ratio)
{
  const double value = std::abs(std::log(ratio));
  deviation.mean += (value - deviation.mean) / double(++deviation.n);
  deviation.max = std::max(deviation.max, value);
}

/// Per given edge, the mean lengths of the two sides that leave it in each of the quads beside it.
inline std::vector<std::vector<double>> widths_at_edges(const Labelled_mesh& mesh,
                                                        const std::vector<std::array<int, 2>>& edges)
{
  const auto key = [](int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    return (std::uint64_t(low) << 32) | std::uint64_t(high);
  };
  const auto length = [&](int a, int b) {
    const auto &p = mesh.points[std::size_t(a)], &q = mesh.points[std::size_t(b)];
    return std::hypot(q[0] - p[0], q[1] - p[1]);
  };
  std::unordered_map<std::uint64_t, std::size_t> place;
  for (std::size_t i = 0; i < edges.size(); ++i)
    place.emplace(key(edges[i][0], edges[i][1]), i);
  std::vector<std::vector<double>> widths(edges.size());
  for (const std::vector<int>& polygon : mesh.polygons)
    if (polygon.size() == 4)
      for (std::size_t i = 0; i < 4; ++i) {
        const int a = polygon[i], b = polygon[(i + 1) % 4], c = polygon[(i + 2) % 4], d = polygon[(i + 3) % 4];
        if (const auto edge = place.find(key(a, b)); edge != place.end())
          widths[edge->second].push_back(0.5 * (length(b, c) + length(d, a)));
      }
  return widths;
}

} // namespace internal

QUADRILLE_INLINE Size_error measure_size_error(const Labelled_mesh& mesh, const Planar_domain& domain,
                                               const Domain_sizes& sizes)
{
  const Curve_locator locator(domain);
  const std::vector<std::array<int, 2>> lines = mesh.lines.empty() ? border_edges(mesh) : mesh.lines;
  const std::vector<std::vector<double>> widths = internal::widths_at_edges(mesh, lines);
  Size_error error;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::array<int, 2>& line = lines[i];
    const auto &p = mesh.points[std::size_t(line[0])], &q = mesh.points[std::size_t(line[1])];
    const auto place = locator.nearest({0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])});
    if (!sizes.is_prescribed(place.edge))
      continue;
    const std::array<Frame_size, 2>& ends = sizes.of_edge[std::size_t(place.edge.idx())];
    const auto between = [&](double a, double b) { return a + place.parameter * (b - a); };
    const double size = between(ends[0].tangential, ends[1].tangential);
    const double length = std::hypot(q[0] - p[0], q[1] - p[1]);
    internal::add_deviation(error.length, length / size);
    const double width = between(ends[0].normal, ends[1].normal);
    if (width > 0)
      for (const double actual : widths[i])
        internal::add_deviation(error.aspect, (actual / length) / (width / size));
  }
  return error;
}

} // namespace Quadrille

#endif
