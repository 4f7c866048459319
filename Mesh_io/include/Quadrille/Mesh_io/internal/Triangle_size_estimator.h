// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_TRIANGLE_SIZE_ESTIMATOR_H
#define QUADRILLE_MESH_IO_INTERNAL_TRIANGLE_SIZE_ESTIMATOR_H

#include <Quadrille/Mesh_io/internal/Triangle_size_field.h>
#include <Quadrille/Planar_domain.h>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <queue>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Finds how small triangles have to be along the curves of an outline: curvature, short sides, narrow gaps.
///
/// Floating-point heuristics throughout: they choose sizes, and no correctness depends on them.
class Triangle_size_estimator {
public:
  Triangle_size_estimator(const Outline& outline, const Planar_domain_options& options, double largest)
      : m_outline(outline), m_options(options), m_largest(largest), m_region(covered_region(outline)),
        m_curves_at(outline.points.size())
  {
    for (std::size_t c = 0; c < outline.curves.size(); ++c) {
      m_curves_at[std::size_t(outline.curves[c].first)].push_back(int(c));
      m_curves_at[std::size_t(outline.curves[c].last)].push_back(int(c));
    }
  }

  /// Samples, looks at the gaps between samples, and samples again where they turn out to be narrow.
  ///
  /// Where that would take more than the allowed number of triangles, they are not made as small as the
  /// narrowest gaps and details ask for; `coarsened()` tells.
  Triangle_size_field<Point_2> estimate()
  {
    const double max_triangles =
        std::max(double(m_options.max_triangles), 3 * 2.31 * m_region.area() / (m_largest * m_largest));
    for (const double ratio : {500.0, 120.0, 40.0, 15.0, 6.0, 3.0, 1.5}) {
      m_smallest = m_largest / ratio;
      m_sources.clear();
      m_samples.clear();
      add_curvature_and_sides();
      for (int round = 0; round < 3; ++round) {
        const Triangle_size_field<Point_2> field(m_largest, m_options.size_gradation, all_sources());
        sample(field);
        add_gaps();
      }
      Triangle_size_field<Point_2> field(m_largest, m_options.size_gradation, all_sources());
      const double n = count_triangles(field, Point_2(0, 0), 1, max_triangles);
      if (n <= max_triangles)
        return field;
      m_coarsened = true;
    }
    return Triangle_size_field<Point_2>(m_largest, m_options.size_gradation, all_sources());
  }

  bool coarsened() const { return m_coarsened; }

  /// Arc lengths that divide a curve into edges as long as the field says, ends included.
  static std::vector<double> subdivide(const Outline::Curve& curve, const Triangle_size_field<Point_2>& field,
                                       double factor)
  {
    // Integrate 1 / h by steps shorter than h can change over.
    std::vector<double> s{0}, count{0};
    while (s.back() < curve.length()) {
      const double h = factor * field(curve.position_at(s.back()));
      const double step = std::min(0.5 * h, curve.length() / 4);
      const double next = curve.length() - s.back() < 1.5 * step ? curve.length() : s.back() + step;
      const double middle = factor * field(curve.position_at(0.5 * (s.back() + next)));
      count.push_back(count.back() + (next - s.back()) / middle);
      s.push_back(next);
    }
    const int n = std::max(curve.closed() ? 3 : 1, int(std::ceil(count.back() - 0.01)));
    std::vector<double> division{0};
    std::size_t i = 1;
    for (int k = 1; k < n; ++k) {
      const double wanted = count.back() * k / n;
      while (count[i] < wanted)
        ++i;
      division.push_back(s[i - 1] + (s[i] - s[i - 1]) * (wanted - count[i - 1]) / (count[i] - count[i - 1]));
    }
    division.push_back(curve.length());
    return division;
  }

private:
  using Source = Triangle_size_field<Point_2>::Source;
  struct Sample {
    int curve;
    double arc_length;
    Point_2 position;
    double size;
    std::array<int, 2> neighbors; ///< samples before and after on the curve, -1 at its ends
  };

  std::vector<Source> all_sources() const
  {
    std::vector<Source> sources = m_sources;
    for (const Sample& sample : m_samples)
      if (sample.neighbors[1] >= 0) {
        const Sample& next = m_samples[std::size_t(sample.neighbors[1])];
        sources.push_back({sample.position, next.position, std::min(sample.size, next.size)});
      }
    return sources;
  }

  void add_curvature_and_sides()
  {
    const std::vector<double> sides = lengths_of_runs(m_options.corner_degrees * CGAL_PI / 180);
    const std::vector<double> outlines = lengths_of_runs(CGAL_PI);
    for (std::size_t c = 0; c < m_outline.curves.size(); ++c) {
      const Outline::Curve& curve = m_outline.curves[c];
      std::vector<double> size = sizes_by_curvature(curve);
      const double by_elements = std::min(size_by_elements(curve), size_by_name(curve));
      for (std::size_t i = 1; i < size.size(); ++i)
        m_sources.push_back({curve.position[i - 1], curve.position[i],
                             std::clamp(std::min({size[i - 1], size[i], sides[c] / 3,
                                                  outlines[c] / m_options.edges_per_outline, by_elements}),
                                        m_smallest, m_largest)});
    }
  }

  /// What the options say about the curve by its names or tag.
  double size_by_name(const Outline::Curve& curve) const
  {
    double size = m_largest;
    for (const auto& [name, curve_size] : m_options.curve_triangle_size)
      if (name == std::to_string(curve.label.tag) ||
          std::find(curve.label.names.begin(), curve.label.names.end(), name) != curve.label.names.end())
        size = std::min(size, curve_size);
    return size;
  }

  /// Small elements ask for a field of some resolution; but the number of triangles must not follow theirs.
  double size_by_elements(const Outline::Curve& curve) const
  {
    const double first = m_outline.points[std::size_t(curve.first)].size;
    const double last = m_outline.points[std::size_t(curve.last)].size;
    return first > 0 && last > 0 ? std::max(2 * std::min(first, last), 0.5 * m_largest) : m_largest;
  }

  /// For each curve, the length of all curves that are connected with it by points where two curves meet and turn by
  /// less than `largest_turn`; from corner to corner, or around a whole outline.
  std::vector<double> lengths_of_runs(double largest_turn) const
  {
    std::vector<int> parent(m_outline.curves.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int c) {
      while (parent[std::size_t(c)] != c)
        c = parent[std::size_t(c)] = parent[std::size_t(parent[std::size_t(c)])];
      return c;
    };
    for (std::size_t p = 0; p < m_curves_at.size(); ++p)
      for (std::size_t i = 1; i < m_curves_at[p].size(); ++i)
        if (largest_turn >= CGAL_PI ||
            (m_curves_at[p].size() == 2 &&
             CGAL_PI - angle_at(int(p), m_curves_at[p][0], m_curves_at[p][1]) < largest_turn))
          parent[std::size_t(root(m_curves_at[p][i - 1]))] = root(m_curves_at[p][i]);
    std::vector<double> length(parent.size(), 0), result;
    for (std::size_t c = 0; c < parent.size(); ++c)
      length[std::size_t(root(int(c)))] += m_outline.curves[c].length();
    for (std::size_t c = 0; c < parent.size(); ++c)
      result.push_back(length[std::size_t(root(int(c)))]);
    return result;
  }

  /// The angle in [0, pi] between two curves that leave point `p`; pi for a closed curve's own ends.
  double angle_at(int p, int a, int b) const
  {
    if (a == b)
      return CGAL_PI;
    const auto direction = [&](int c) {
      const Outline::Curve& curve = m_outline.curves[std::size_t(c)];
      const std::size_t n = curve.position.size();
      return curve.first == p ? curve.position[1] - curve.position[0] : curve.position[n - 2] - curve.position[n - 1];
    };
    const auto u = direction(a), v = direction(b);
    return std::abs(std::atan2(u.x() * v.y() - u.y() * v.x(), u * v));
  }

  /// Per sample, the length over which the curve turns by the share of one edge. Kinks, which no refinement resolves,
  /// are left out.
  std::vector<double> sizes_by_curvature(const Outline::Curve& curve) const
  {
    const std::size_t n = curve.position.size();
    const double allowed = 2 * CGAL_PI / m_options.edges_per_circle;
    std::vector<double> turned(n, 0), size(n, m_largest);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const auto u = curve.position[i] - curve.position[i - 1], v = curve.position[i + 1] - curve.position[i];
      const double turn = std::abs(std::atan2(u.x() * v.y() - u.y() * v.x(), u * v));
      turned[i] = turned[i - 1] + (turn < allowed ? turn : 0);
    }
    if (n > 1)
      turned[n - 1] = n > 2 ? turned[n - 2] : 0;
    const auto limit = [&](std::size_t i, std::size_t j) {
      if (turned[j] - turned[i] >= allowed) {
        const double share = allowed / (turned[j] - turned[i]);
        const double length = share * (curve.arc_length[j] - curve.arc_length[i]);
        size[i] = std::min(size[i], length);
        size[j] = std::min(size[j], length);
        return true;
      }
      return false;
    };
    for (std::size_t i = 0, j = 0; i < n; ++i) {
      while (j + 1 < n && turned[j] - turned[i] < allowed)
        ++j;
      if (!limit(i, j))
        break;
    }
    if (turned[n - 1] > 0.5 * allowed && turned[n - 1] < allowed)
      std::fill(size.begin(), size.end(), std::min(m_largest, curve.length()));
    return size;
  }

  void sample(const Triangle_size_field<Point_2>& field)
  {
    m_samples.clear();
    for (std::size_t c = 0; c < m_outline.curves.size(); ++c) {
      const Outline::Curve& curve = m_outline.curves[c];
      const std::vector<double> division = subdivide(curve, field, 0.5);
      const int begin = int(m_samples.size()), n = int(division.size());
      for (int i = 0; i < n; ++i) {
        const Point_2 p = curve.position_at(division[std::size_t(i)]);
        m_samples.push_back({int(c),
                             division[std::size_t(i)],
                             p,
                             m_largest,
                             {i > 0 ? begin + i - 1 : -1, i + 1 < n ? begin + i + 1 : -1}});
      }
    }
  }

  /// Neighbours in the Delaunay triangulation of the samples that are far apart along the curves face each other
  /// across a gap.
  void add_gaps()
  {
    using Vertex_base = CGAL::Triangulation_vertex_base_with_info_2<int, Segment_kernel>;
    using Data = CGAL::Triangulation_data_structure_2<Vertex_base>;
    CGAL::Delaunay_triangulation_2<Segment_kernel, Data> delaunay;
    std::vector<std::pair<Point_2, int>> points;
    for (std::size_t i = 0; i < m_samples.size(); ++i)
      points.emplace_back(m_samples[i].position, int(i));
    delaunay.insert(points.begin(), points.end());
    for (auto edge = delaunay.finite_edges_begin(); edge != delaunay.finite_edges_end(); ++edge) {
      const int p = edge->first->vertex(delaunay.cw(edge->second))->info();
      const int q = edge->first->vertex(delaunay.ccw(edge->second))->info();
      consider_gap(p, q);
    }
  }

  void consider_gap(int i, int j)
  {
    Sample &p = m_samples[std::size_t(i)], &q = m_samples[std::size_t(j)];
    const double gap = std::min(distance_to_curve(p.position, q), distance_to_curve(q.position, p));
    double size = std::max(gap / m_options.triangles_per_gap, m_smallest);
    if (size >= m_largest || gap == 0 || !m_region.contains(CGAL::midpoint(p.position, q.position)) ||
        connected_within(p, q, 3 * distance(p.position, q.position)))
      return;
    if (p.curve != q.curve &&
        share_point(p.curve, q.curve)) // the tip of a sharp corner cannot have many triangles across
      size = std::max(size, m_largest / 6);
    p.size = std::min(p.size, size);
    q.size = std::min(q.size, size);
  }

  double distance_to_curve(const Point_2& x, const Sample& sample) const
  {
    double result = distance(x, sample.position);
    for (const int neighbor : sample.neighbors)
      if (neighbor >= 0)
        result = std::min(result, Triangle_size_field<Point_2>::distance_to_segment(
                                      x, sample.position, m_samples[std::size_t(neighbor)].position));
    return result;
  }

  bool share_point(int a, int b) const
  {
    const Outline::Curve &c = m_outline.curves[std::size_t(a)], &d = m_outline.curves[std::size_t(b)];
    return c.first == d.first || c.first == d.last || c.last == d.first || c.last == d.last;
  }

  /// Whether a way along the curves that is not longer than `limit` leads from one sample to the other.
  bool connected_within(const Sample& from, const Sample& to, double limit) const
  {
    if (from.curve == to.curve && std::abs(from.arc_length - to.arc_length) <= limit)
      return true;
    using Entry = std::pair<double, int>; // distance, point
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    const Outline::Curve& start = m_outline.curves[std::size_t(from.curve)];
    queue.emplace(from.arc_length, start.first);
    queue.emplace(start.length() - from.arc_length, start.last);
    std::map<int, double> settled;
    while (!queue.empty() && queue.top().first <= limit) {
      const auto [length, point] = queue.top();
      queue.pop();
      if (!settled.emplace(point, length).second)
        continue;
      for (const int c : m_curves_at[std::size_t(point)]) {
        const Outline::Curve& curve = m_outline.curves[std::size_t(c)];
        if (c == to.curve) {
          if ((curve.first == point && length + to.arc_length <= limit) ||
              (curve.last == point && length + curve.length() - to.arc_length <= limit))
            return true;
        }
        queue.emplace(length + curve.length(), curve.first == point ? curve.last : curve.first);
      }
    }
    return false;
  }

  /// About how many triangles a field asks for in a square, by subdividing it; stops when there are more than `enough`.
  double count_triangles(const Triangle_size_field<Point_2>& field, const Point_2& center, double side,
                         double enough) const
  {
    const double h = field(center);
    if (side <= 2 * h)
      return m_region.contains(center) ? 2.31 * side * side / (h * h) : 0;
    double n = 0;
    for (const double dx : {-0.25, 0.25})
      for (const double dy : {-0.25, 0.25})
        if (n <= enough)
          n += count_triangles(field, Point_2(center.x() + dx * side, center.y() + dy * side), 0.5 * side, enough - n);
    return n;
  }

  const Outline& m_outline;
  const Planar_domain_options& m_options;
  double m_largest;
  double m_smallest = 0; ///< what gaps, curvature and sides may ask for
  bool m_coarsened = false;
  Even_odd_region m_region;
  std::vector<std::vector<int>> m_curves_at; ///< by point
  std::vector<Source> m_sources;             ///< by curvature and short sides
  std::vector<Sample> m_samples;             ///< with sizes by gaps
};

} // namespace internal
} // namespace Quadrille

#endif
