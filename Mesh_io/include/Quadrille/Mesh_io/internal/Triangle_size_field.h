// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_TRIANGLE_SIZE_FIELD_H
#define QUADRILLE_MESH_IO_INTERNAL_TRIANGLE_SIZE_FIELD_H

#include <Quadrille/Mesh_io/internal/vector_length.h>

#include <CGAL/Dimension.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// h(x) = min over segments s of (h_s + gradation * |x - s|), bounded above: the size of triangles at x.
///
/// A tree of bounding boxes answers in about logarithmic time.
template <class Point> class Triangle_size_field {
public:
  struct Source {
    Point p, q;
    double size; ///< at the whole segment
  };

  Triangle_size_field(double largest, double gradation, std::vector<Source> sources)
      : m_largest(largest), m_gradation(gradation), m_sources(std::move(sources))
  {
    m_sources.erase(std::remove_if(m_sources.begin(), m_sources.end(),
                                   [&](const Source& source) { return !(source.size < m_largest); }),
                    m_sources.end());
    if (!m_sources.empty())
      build(0, m_sources.size());
  }

  double operator()(const Point& x) const
  {
    double best = m_largest;
    if (!m_nodes.empty())
      descend(0, x, best);
    return best;
  }

private:
  static constexpr int dimension = CGAL::Ambient_dimension<Point>::value;

  struct Node {
    decltype(std::declval<Point>().bbox()) box;
    double smallest = 0;
    std::size_t begin = 0, end = 0; ///< sources
    std::size_t second_child = 0;   ///< 0 for a leaf; the first child follows its parent
  };

  std::size_t build(std::size_t begin, std::size_t end)
  {
    const std::size_t index = m_nodes.size();
    m_nodes.emplace_back();
    Node node;
    node.begin = begin;
    node.end = end;
    node.smallest = m_sources[begin].size;
    for (std::size_t i = begin; i < end; ++i) {
      node.box += m_sources[i].p.bbox() + m_sources[i].q.bbox();
      node.smallest = std::min(node.smallest, m_sources[i].size);
    }
    if (end - begin > 4) {
      const auto extent = [&](int k) { return (node.box.max)(k) - (node.box.min)(k); };
      int axis = dimension - 1;
      for (int k = dimension - 2; k >= 0; --k)
        axis = extent(k) > extent(axis) ? k : axis;
      const std::size_t middle = (begin + end) / 2;
      const auto key = [axis](const Source& s) { return s.p[axis] + s.q[axis]; };
      std::nth_element(m_sources.begin() + std::ptrdiff_t(begin), m_sources.begin() + std::ptrdiff_t(middle),
                       m_sources.begin() + std::ptrdiff_t(end),
                       [&](const Source& a, const Source& b) { return key(a) < key(b); });
      build(begin, middle);
      node.second_child = build(middle, end);
    }
    m_nodes[index] = node;
    return index;
  }

  void descend(std::size_t index, const Point& x, double& best) const
  {
    const Node& node = m_nodes[index];
    if (lower_bound(node, x) >= best)
      return;
    if (node.second_child == 0) {
      for (std::size_t i = node.begin; i < node.end; ++i)
        best = std::min(best, m_sources[i].size + m_gradation * distance_to_segment(x, m_sources[i].p, m_sources[i].q));
      return;
    }
    std::size_t near = index + 1, far = node.second_child;
    if (lower_bound(m_nodes[far], x) < lower_bound(m_nodes[near], x))
      std::swap(near, far);
    descend(near, x, best);
    descend(far, x, best);
  }

  double lower_bound(const Node& node, const Point& x) const
  {
    const auto outside = [&](int k) { return std::max({(node.box.min)(k)-x[k], 0.0, x[k] - (node.box.max)(k)}); };
    if constexpr (dimension == 2)
      return node.smallest + m_gradation * std::hypot(outside(0), outside(1));
    else
      return node.smallest + m_gradation * std::hypot(outside(0), outside(1), outside(2));
  }

public:
  static double distance_to_segment(const Point& x, const Point& p, const Point& q)
  {
    const auto d = q - p;
    const double squared = d.squared_length();
    const double t = squared > 0 ? std::clamp(((x - p) * d) / squared, 0.0, 1.0) : 0;
    return length_of(x - (p + t * d));
  }

private:
  double m_largest, m_gradation;
  std::vector<Source> m_sources;
  std::vector<Node> m_nodes;
};

} // namespace internal
} // namespace Quadrille

#endif
