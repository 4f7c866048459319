// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_REPAIR_MESH_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_REPAIR_MESH_IMPL_H

#include <Quadrille/Mesh_io/internal/Nearest_tree.h>
#include <Quadrille/Mesh_io/internal/Triangle_adjacency.h>
#include <Quadrille/Mesh_io/internal/check_surface.h>
#include <Quadrille/Mesh_io/internal/find_cracks.h>
#include <Quadrille/Mesh_io/internal/triangulate_polygon.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/repair_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// The steps of `repair_mesh()`.
class Mesh_repairer {
public:
  using Triangle = Triangle_adjacency::Triangle;

  Mesh_repairer(const Labelled_mesh& input, Mesh_repair_report& report)
      : m_mesh(input), m_report(report), m_representative(input.points.size())
  {
    std::iota(m_representative.begin(), m_representative.end(), 0);
  }

  Labelled_mesh run()
  {
    if (!has_points() || !divide_polygons())
      return m_mesh;
    merge_short_edges();
    clean();
    // Each layer has fewer flat triangles or shorter edges than the one before, but for rounding.
    for (std::size_t n_left = 2 * number_of_flat_triangles(); n_left > 0 && remove_one_flat_layer(); --n_left)
      clean();
    while (close_cracks())
      clean();
    orient();
    finish();
    return std::move(m_mesh);
  }

private:
  bool has_points() const
  {
    for (const std::vector<int>& polygon : m_mesh.polygons)
      for (const int v : polygon) {
        if (v < 0 || std::size_t(v) >= m_mesh.points.size())
          return false;
        for (const double x : m_mesh.points[std::size_t(v)])
          if (!std::isfinite(x))
            return false;
      }
    return true;
  }

  bool divide_polygons()
  {
    for (std::size_t f = 0; f < m_mesh.polygons.size(); ++f) {
      std::vector<int> corners = m_mesh.polygons[f];
      corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
      while (corners.size() > 1 && corners.front() == corners.back())
        corners.pop_back();
      const int region = f < m_mesh.polygon_region.size() ? m_mesh.polygon_region[f] : -1;
      if (corners.size() < 3) {
        ++m_report.dropped_triangles;
        continue;
      }
      if (corners.size() == 3) {
        add({corners[0], corners[1], corners[2]}, region);
        continue;
      }
      std::vector<Checked_surface::Kernel::Point_3> outline;
      for (const int v : corners)
        outline.emplace_back(m_mesh.points[std::size_t(v)][0], m_mesh.points[std::size_t(v)][1],
                             m_mesh.points[std::size_t(v)][2]);
      const std::vector<Triangle> parts = triangulate_polygon(outline);
      if (parts.empty())
        return false;
      for (const Triangle& t : parts)
        add({corners[std::size_t(t[0])], corners[std::size_t(t[1])], corners[std::size_t(t[2])]}, region);
    }
    return true;
  }

  void add(const Triangle& triangle, int region)
  {
    m_triangles.push_back(triangle);
    m_region.push_back(region);
  }

  Space_kernel::Point_3 point(int v) const { return space_point(m_mesh.points[std::size_t(v)]); }
  double length(int a, int b) const { return length_of(point(b) - point(a)); }

  /// The longest edge of a triangle: from this corner to the next one.
  std::size_t longest_edge(const Triangle& t) const
  {
    const std::array<double, 3> lengths{length(t[0], t[1]), length(t[1], t[2]), length(t[2], t[0])};
    return std::size_t(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
  }

  int find(int v) const
  {
    while (m_representative[std::size_t(v)] != v)
      v = m_representative[std::size_t(v)];
    return v;
  }

  /// The one with the lower number stays.
  void merge(int a, int b)
  {
    a = find(a);
    b = find(b);
    if (a == b)
      return;
    m_representative[std::size_t(std::max(a, b))] = std::min(a, b);
    ++m_report.merged_points;
  }

  void merge_short_edges()
  {
    for (const Triangle& t : m_triangles) {
      const std::size_t i = longest_edge(t);
      const double longest = length(t[i], t[(i + 1) % 3]);
      for (std::size_t k = 0; k < 3; ++k)
        if (length(t[k], t[(k + 1) % 3]) <= Surface_checker::sliver_tolerance * longest)
          merge(t[k], t[(k + 1) % 3]);
    }
  }

  /// Renames merged points, and drops triangles that use a point twice or are repeated.
  void clean()
  {
    std::set<Triangle> seen;
    std::size_t n = 0;
    for (std::size_t t = 0; t < m_triangles.size(); ++t) {
      Triangle triangle = m_triangles[t];
      for (int& v : triangle)
        v = find(v);
      Triangle sorted = triangle;
      std::sort(sorted.begin(), sorted.end());
      if (sorted[0] == sorted[1] || sorted[1] == sorted[2] || !seen.insert(sorted).second) {
        ++m_report.dropped_triangles;
        continue;
      }
      m_triangles[n] = triangle;
      m_region[n++] = m_region[t];
    }
    m_triangles.resize(n);
    m_region.resize(n);
  }

  bool is_flat(const Triangle& t) const
  {
    const std::size_t i = longest_edge(t);
    const double longest = length(t[i], t[(i + 1) % 3]);
    const Space_kernel::Vector_3 p = (point(t[1]) - point(t[0])) / longest, q = (point(t[2]) - point(t[0])) / longest;
    using Exact_point = Checked_surface::Kernel::Point_3;
    const auto exact = [&](int v) {
      const std::array<double, 3>& x = m_mesh.points[std::size_t(v)];
      return Exact_point(x[0], x[1], x[2]);
    };
    return !(length_of(CGAL::cross_product(p, q)) >= Surface_checker::sliver_tolerance) ||
           CGAL::collinear(exact(t[0]), exact(t[1]), exact(t[2]));
  }

  std::size_t number_of_flat_triangles() const
  {
    return std::size_t(
        std::count_if(m_triangles.begin(), m_triangles.end(), [&](const Triangle& t) { return is_flat(t); }));
  }

  /// Drops flat triangles; the other triangle at the longest edge gets the middle corner. Where that one is flat, too,
  /// it comes first, unless both have this longest edge. Returns whether there were any.
  bool remove_one_flat_layer()
  {
    const Triangle_adjacency adjacency(m_triangles);
    std::vector<char> is_changed(m_triangles.size(), 0);
    std::vector<std::pair<Triangle, int>> added;
    std::size_t n_divided = 0;
    for (std::size_t t = 0; t < m_triangles.size(); ++t) {
      if (is_changed[t] || !is_flat(m_triangles[t]))
        continue;
      const std::size_t i = longest_edge(m_triangles[t]);
      const int from = m_triangles[t][i], to = m_triangles[t][(i + 1) % 3], middle = m_triangles[t][(i + 2) % 3];
      const int other = adjacency.neighbor(t, i);
      if (other >= 0) {
        const Triangle& u = m_triangles[std::size_t(other)];
        const std::size_t j = longest_edge(u);
        if (is_changed[std::size_t(other)] ||
            (is_flat(u) && std::minmax(u[j], u[(j + 1) % 3]) != std::minmax(from, to)))
          continue; // in a later layer
      }
      is_changed[t] = 1;
      m_splits.push_back({from, to, middle});
      if (other < 0)
        continue;
      is_changed[std::size_t(other)] = 1;
      for (const int replaced : {from, to}) {
        Triangle part = m_triangles[std::size_t(other)];
        std::replace(part.begin(), part.end(), replaced, middle);
        added.emplace_back(part, m_region[std::size_t(other)]);
      }
      ++n_divided;
    }
    std::size_t n = 0;
    for (std::size_t t = 0; t < m_triangles.size(); ++t)
      if (!is_changed[t]) {
        m_triangles[n] = m_triangles[t];
        m_region[n++] = m_region[t];
      }
    m_report.dropped_triangles += m_triangles.size() - n - n_divided;
    const bool is_any = n < m_triangles.size();
    m_triangles.resize(n);
    m_region.resize(n);
    for (const auto& [triangle, region] : added)
      add(triangle, region);
    return is_any;
  }

  bool close_cracks()
  {
    bool is_any = false;
    for (const Crack& crack : Crack_finder(m_mesh.points, m_triangles)(Triangle_adjacency(m_triangles)))
      if (crack.is_unique)
        for (std::size_t i = 0; i < 2; ++i) {
          is_any = is_any || find(crack.first[i]) != find(crack.second[i]);
          merge(crack.first[i], crack.second[i]);
        }
    return is_any;
  }

  void orient()
  {
    const Triangle_adjacency adjacency(m_triangles);
    const std::size_t n = std::size_t(adjacency.number_of_components());
    std::vector<char> is_closed(n, 1), is_one_sided(n, 0);
    for (const Triangle_adjacency::Side& side : adjacency.border())
      is_closed[std::size_t(adjacency.component(side.triangle))] = 0;
    for (const Triangle_adjacency::Crowded_edge& edge : adjacency.crowded_edges())
      for (const std::size_t t : edge.triangles)
        is_closed[std::size_t(adjacency.component(t))] = 0;
    for (const Triangle_adjacency::Side& side : adjacency.one_sided_edges())
      is_one_sided[std::size_t(adjacency.component(side.triangle))] = 1;
    std::vector<std::size_t> n_all(n, 0), n_turned(n, 0);
    for (std::size_t t = 0; t < m_triangles.size(); ++t) {
      ++n_all[std::size_t(adjacency.component(t))];
      n_turned[std::size_t(adjacency.component(t))] += adjacency.is_turned(t);
    }
    std::vector<Space_kernel::Point_3> points;
    for (const std::array<double, 3>& p : m_mesh.points)
      points.push_back(space_point(p));
    const std::vector<double> volumes = enclosed_volumes(points, m_triangles, adjacency);
    for (std::size_t t = 0; t < m_triangles.size(); ++t) {
      const std::size_t c = std::size_t(adjacency.component(t));
      if (n_turned[c] == 0 || is_one_sided[c])
        continue;
      const bool others = is_closed[c] ? volumes[c] < 0 : 2 * n_turned[c] > n_all[c];
      if (adjacency.is_turned(t) != others) {
        std::swap(m_triangles[t][1], m_triangles[t][2]);
        ++m_report.turned_triangles;
      }
    }
  }

  /// Lines follow merged points and divided edges.
  void finish()
  {
    std::vector<std::array<int, 2>> lines;
    std::vector<int> curves;
    for (std::size_t i = 0; i < m_mesh.lines.size(); ++i) {
      std::vector<int> chain{find(m_mesh.lines[i][0]), find(m_mesh.lines[i][1])};
      for (const Split& split : m_splits)
        for (std::size_t k = 0; k + 1 < chain.size(); ++k)
          if (std::minmax(chain[k], chain[k + 1]) == std::minmax(find(split.from), find(split.to)))
            chain.insert(chain.begin() + std::ptrdiff_t(++k), find(split.middle));
      for (std::size_t k = 0; k + 1 < chain.size(); ++k)
        if (chain[k] != chain[k + 1]) {
          lines.push_back({chain[k], chain[k + 1]});
          curves.push_back(i < m_mesh.line_curve.size() ? m_mesh.line_curve[i] : -1);
        }
    }
    m_mesh.lines = std::move(lines);
    m_mesh.line_curve = std::move(curves);
    m_mesh.polygons.clear();
    for (const Triangle& t : m_triangles)
      m_mesh.polygons.emplace_back(t.begin(), t.end());
    m_mesh.polygon_region = std::move(m_region);
  }

  /// An edge that got a point in its middle.
  struct Split {
    int from, to, middle;
  };

  Labelled_mesh m_mesh;
  Mesh_repair_report& m_report;
  std::vector<int> m_representative; ///< by point: one that it was merged with, or itself
  std::vector<Triangle> m_triangles;
  std::vector<int> m_region; ///< by triangle
  std::vector<Split> m_splits;
};

} // namespace internal

QUADRILLE_INLINE std::string Mesh_repair_report::text() const
{
  const auto counted = [](std::size_t n, const std::string& what, const std::string& done) {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s") + " " + done;
  };
  return counted(merged_points, "point", "merged") + ", " +
         counted(dropped_triangles, "degenerate or repeated triangle", "dropped") + ", " +
         counted(turned_triangles, "triangle", "turned around");
}

QUADRILLE_INLINE Labelled_mesh repair_mesh(const Labelled_mesh& mesh, Mesh_repair_report& report)
{
  return internal::Mesh_repairer(mesh, report).run();
}

} // namespace Quadrille

#endif
