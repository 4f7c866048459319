// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_TRIANGLE_SIZE_FIELD_H
#define QUADRILLE_MESH_IO_INTERNAL_TRIANGLE_SIZE_FIELD_H

#include <Quadrille/Mesh_io/internal/Outline.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace Quadrille {
namespace internal {

/// h(x) = min over segments s of (h_s + gradation * |x - s|), bounded above: the size of triangles at x.
///
/// A tree of bounding boxes answers in about logarithmic time.
class Triangle_size_field {
public:
  struct Source {
    Point_2 p, q;
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

  double operator()(const Point_2& x) const
  {
    double best = m_largest;
    if (!m_nodes.empty())
      descend(0, x, best);
    return best;
  }

private:
  struct Node {
    CGAL::Bbox_2 box;
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
      const bool by_x = node.box.xmax() - node.box.xmin() > node.box.ymax() - node.box.ymin();
      const std::size_t middle = (begin + end) / 2;
      const auto key = [by_x](const Source& s) { return by_x ? s.p.x() + s.q.x() : s.p.y() + s.q.y(); };
      std::nth_element(m_sources.begin() + std::ptrdiff_t(begin), m_sources.begin() + std::ptrdiff_t(middle),
                       m_sources.begin() + std::ptrdiff_t(end),
                       [&](const Source& a, const Source& b) { return key(a) < key(b); });
      build(begin, middle);
      node.second_child = build(middle, end);
    }
    m_nodes[index] = node;
    return index;
  }

  void descend(std::size_t index, const Point_2& x, double& best) const
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

  double lower_bound(const Node& node, const Point_2& x) const
  {
    const double dx = std::max({node.box.xmin() - x.x(), 0.0, x.x() - node.box.xmax()});
    const double dy = std::max({node.box.ymin() - x.y(), 0.0, x.y() - node.box.ymax()});
    return node.smallest + m_gradation * std::hypot(dx, dy);
  }

public:
  static double distance_to_segment(const Point_2& x, const Point_2& p, const Point_2& q)
  {
    const auto d = q - p;
    const double squared = d.squared_length();
    const double t = squared > 0 ? std::clamp(((x - p) * d) / squared, 0.0, 1.0) : 0;
    return distance(x, p + t * d);
  }

private:
  double m_largest, m_gradation;
  std::vector<Source> m_sources;
  std::vector<Node> m_nodes;
};

} // namespace internal
} // namespace Quadrille

#endif
