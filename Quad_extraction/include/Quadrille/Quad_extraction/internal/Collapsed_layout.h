// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_COLLAPSED_LAYOUT_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_COLLAPSED_LAYOUT_H

#include <Quadrille/Quad_extraction/internal/at.h>
#include <Quadrille/Quad_layout.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// What remains of a layout when the arcs of the strips of length 0 are contracted: clusters of nodes, and classes of
/// arcs that are identified across the patches of width 0.
class Collapsed_layout {
public:
  /// Arcs of positive length that coincide after the collapse.
  struct Arc_class {
    int source = -1; ///< cluster
    int target = -1; ///< cluster
    int length = 0;
    std::vector<int> half_arcs; ///< all directed alike
  };
  struct Cluster {
    std::vector<int> nodes;
    int critical = -1;        ///< the critical node, if there is one
    bool constrained = false; ///< some node lies on a curve
  };

  /// \pre the lengths respect `Strip_constraints`.
  Collapsed_layout(const Quad_layout& layout, std::vector<int> strip_length)
      : m_layout(&layout), m_strip_length(std::move(strip_length))
  {
    find_clusters();
    find_classes();
  }

  int length(int arc) const { return at(m_strip_length, at(m_layout->arcs, arc).strip); }
  const std::vector<Cluster>& clusters() const { return m_clusters; }
  int cluster(int node) const { return at(m_cluster_of, node); }
  const std::vector<Arc_class>& classes() const { return m_classes; }
  /// Class of a half-arc of positive length.
  int arc_class(int half_arc) const { return at(m_class_of, half_arc); }
  /// Is the half-arc directed like its class?
  bool is_forward(int half_arc) const { return at(m_forward, half_arc) != 0; }

private:
  static int find(std::vector<int>& parent, int i)
  {
    while (at(parent, i) != i)
      i = at(parent, i) = at(parent, at(parent, i));
    return i;
  }
  static void unite(std::vector<int>& parent, int i, int j)
  {
    i = find(parent, i);
    j = find(parent, j);
    at(parent, std::max(i, j)) = std::min(i, j);
  }

  void find_clusters()
  {
    std::vector<int> parent(m_layout->nodes.size());
    std::iota(parent.begin(), parent.end(), 0);
    for (int a = 0; a < size_of(m_layout->arcs); ++a)
      if (length(a) == 0)
        unite(parent, at(m_layout->arcs, a).source, at(m_layout->arcs, a).target);
    m_cluster_of.resize(parent.size());
    for (int i = 0; i < size_of(parent); ++i) {
      const int root = find(parent, i);
      if (root == i) {
        at(m_cluster_of, i) = size_of(m_clusters);
        m_clusters.emplace_back();
      }
      Cluster& cluster = at(m_clusters, at(m_cluster_of, i) = at(m_cluster_of, root));
      cluster.nodes.push_back(i);
      cluster.constrained = cluster.constrained || at(m_layout->nodes, i).constrained;
      if (at(m_layout->nodes, i).critical)
        cluster.critical = i;
    }
  }

  void find_classes()
  {
    std::vector<int> parent(2 * m_layout->arcs.size());
    std::iota(parent.begin(), parent.end(), 0);
    for (const Quad_layout::Patch& patch : m_layout->patches)
      for (int side = 0; side < 2; ++side)
        if (length(at(patch.half_arcs, side) / 2) == 0) {
          const int right = at(patch.half_arcs, side + 1);
          const int left = at(patch.half_arcs, (side + 3) % 4);
          unite(parent, right, left ^ 1);
          unite(parent, right ^ 1, left);
        }
    m_class_of.assign(parent.size(), -1);
    m_forward.assign(parent.size(), 0);
    for (int h = 0; h < size_of(parent); ++h) {
      if (length(h / 2) == 0)
        continue;
      const int root = find(parent, h);
      const int reverse_root = find(parent, h ^ 1);
      at(m_forward, h) = root < reverse_root ? 1 : 0;
      const int key = std::min(root, reverse_root);
      if (at(m_class_of, key) < 0) {
        at(m_class_of, key) = size_of(m_classes);
        m_classes.emplace_back();
      }
      at(m_class_of, h) = at(m_class_of, key);
      if (at(m_forward, h)) {
        Arc_class& arcs = at(m_classes, at(m_class_of, h));
        arcs.source = cluster(m_layout->source(h));
        arcs.target = cluster(m_layout->target(h));
        arcs.length = length(h / 2);
        arcs.half_arcs.push_back(h);
      }
    }
  }

  const Quad_layout* m_layout;
  std::vector<int> m_strip_length;
  std::vector<int> m_cluster_of;
  std::vector<Cluster> m_clusters;
  std::vector<int> m_class_of;
  std::vector<char> m_forward;
  std::vector<Arc_class> m_classes;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
