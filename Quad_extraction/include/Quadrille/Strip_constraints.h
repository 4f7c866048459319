// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_STRIP_CONSTRAINTS_H
#define QUADRILLE_STRIP_CONSTRAINTS_H

#include <Quadrille/Quad_extraction/internal/Undoable_union_find.h>
#include <Quadrille/Quad_layout.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace Quadrille {

/// Decides which strips of a layout may get length 0 so that the quads still have the topology of the domain.
///
/// An arc of length 0 merges its two nodes, a patch with one side of length 0 identifies its two other sides. What is
/// merged into one node, a *cluster*, must be contractible, hold at most one critical node, meet the curves of the
/// domain in one connected piece, and not join an interior singularity with a curve; arcs that are identified must not
/// contain two arcs on curves, nor close up around a ring. Every border loop, closed feature, and pair of curves with
/// the same ends keeps at least `min_loop_edges` edges. Then the collapse preserves the surface, its border, its curves
/// and all valences.
///
/// A quantizer fixes the strips one after another, in any order.
class Strip_constraints {
public:
  /// `min_length`, by strip: least lengths asked for in addition; empty for none.
  explicit Strip_constraints(const Quad_layout& layout, int min_loop_edges = 4, std::vector<int> min_length = {})
      : m_layout(&layout), m_min_loop_edges(min_loop_edges), m_min_length(std::move(min_length)),
        m_is_zero(layout.strips.size(), 0), m_clusters(initial_clusters(layout)),
        m_arc_classes(initial_arc_classes(layout)), m_loops_of_strip(layout.strips.size())
  {
    m_min_length.resize(layout.strips.size(), 0);
    find_loops();
  }

  /// Gives `strip` the smallest admissible length that is at least `wanted`, and returns it.
  /// Complexity: the strip's size times the logarithm of the layout's.
  int fix(int strip, int wanted)
  {
    int length = std::max({wanted, internal::extraction::at(m_min_length, strip), missing_in_loops(strip)});
    if (length == 0 && !try_collapse(strip))
      length = 1;
    for (const auto& [loop, times] : internal::extraction::at(m_loops_of_strip, strip)) {
      internal::extraction::at(m_loops, loop).length += times * length;
      internal::extraction::at(m_loops, loop).unfixed_arcs -= times;
    }
    return length;
  }

private:
  struct Cluster {
    int nodes = 0;
    int arcs = 0;
    int patches = 0;
    int critical = 0;
    int singularities = 0; ///< critical nodes that lie on no curve
    int curve_nodes = 0;
    int curve_arcs = 0;

    Cluster& operator+=(const Cluster& other)
    {
      nodes += other.nodes;
      arcs += other.arcs;
      patches += other.patches;
      critical += other.critical;
      singularities += other.singularities;
      curve_nodes += other.curve_nodes;
      curve_arcs += other.curve_arcs;
      return *this;
    }
    bool is_valid() const
    {
      const bool contractible = nodes - arcs + patches == 1;
      const bool curves_connected = curve_nodes == 0 || curve_nodes - curve_arcs == 1;
      return contractible && critical <= 1 && curves_connected && (singularities == 0 || curve_nodes == 0);
    }
  };
  struct Arc_class {
    int curve_arcs = 0;

    Arc_class& operator+=(const Arc_class& other)
    {
      curve_arcs += other.curve_arcs;
      return *this;
    }
  };
  struct Loop {
    int length = 0;
    int unfixed_arcs = 0;
  };

  static std::vector<Cluster> initial_clusters(const Quad_layout& layout)
  {
    std::vector<Cluster> clusters(layout.nodes.size());
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      const Quad_layout::Node& node = layout.nodes[i];
      clusters[i].nodes = 1;
      clusters[i].critical = node.critical ? 1 : 0;
      clusters[i].singularities = node.critical && !node.constrained ? 1 : 0;
      clusters[i].curve_nodes = node.constrained ? 1 : 0;
    }
    return clusters;
  }

  static std::vector<Arc_class> initial_arc_classes(const Quad_layout& layout)
  {
    std::vector<Arc_class> classes(layout.arcs.size());
    for (std::size_t i = 0; i < classes.size(); ++i)
      classes[i].curve_arcs = layout.arcs[i].curve >= 0 ? 1 : 0;
    return classes;
  }

  void find_loops()
  {
    std::vector<int> border_arc_from(m_layout->nodes.size(), -1);
    for (int a = 0; a < internal::extraction::size_of(m_layout->arcs); ++a)
      if (internal::extraction::at(m_layout->arcs, a).border)
        internal::extraction::at(border_arc_from, internal::extraction::at(m_layout->arcs, a).source) = a;
    for (int& first : border_arc_from)
      if (first >= 0) {
        std::vector<int> arcs;
        for (int a = first; a >= 0;) {
          arcs.push_back(a);
          const int target = internal::extraction::at(m_layout->arcs, a).target;
          internal::extraction::at(border_arc_from, internal::extraction::at(m_layout->arcs, a).source) = -1;
          a = internal::extraction::at(border_arc_from, target);
        }
        add_loop(arcs);
      }
    // Closed chains, and pairs of chains with the same ends.
    std::map<std::pair<int, int>, std::vector<int>> arcs_between;
    for (const Quad_layout::Curve_chain& chain : m_layout->chains) {
      const std::pair<int, int> ends =
          std::minmax(m_layout->source(chain.half_arcs.front()), m_layout->target(chain.half_arcs.back()));
      std::vector<int> arcs;
      for (const int h : chain.half_arcs)
        arcs.push_back(h / 2);
      if (ends.first == ends.second) {
        add_loop(arcs);
        continue;
      }
      const auto [other, is_first] = arcs_between.emplace(ends, arcs);
      if (is_first)
        continue;
      std::vector<int> both = other->second;
      both.insert(both.end(), arcs.begin(), arcs.end());
      add_loop(both);
      other->second = arcs;
    }
  }

  void add_loop(const std::vector<int>& arcs)
  {
    std::vector<int> strips;
    for (const int a : arcs)
      strips.push_back(internal::extraction::at(m_layout->arcs, a).strip);
    std::sort(strips.begin(), strips.end());
    for (std::size_t i = 0; i < strips.size();) {
      const std::size_t begin = i;
      while (i < strips.size() && strips[i] == strips[begin])
        ++i;
      internal::extraction::at(m_loops_of_strip, strips[begin])
          .emplace_back(internal::extraction::size_of(m_loops), static_cast<int>(i - begin));
    }
    m_loops.push_back({0, internal::extraction::size_of(arcs)});
  }

  /// The least length of `strip` that gives the loops that depend on nothing else enough edges.
  int missing_in_loops(int strip) const
  {
    int least = 0;
    for (const auto& [index, times] : internal::extraction::at(m_loops_of_strip, strip)) {
      const Loop& loop = internal::extraction::at(m_loops, index);
      if (loop.unfixed_arcs == times && loop.length < m_min_loop_edges)
        least = std::max(least, (m_min_loop_edges - loop.length + times - 1) / times);
    }
    return least;
  }

  bool try_collapse(int strip)
  {
    internal::extraction::at(m_is_zero, strip) = 1;
    if (collapse(strip)) {
      m_clusters.commit();
      m_arc_classes.commit();
      return true;
    }
    m_clusters.undo();
    m_arc_classes.undo();
    internal::extraction::at(m_is_zero, strip) = 0;
    return false;
  }

  bool collapse(int index)
  {
    const Quad_layout::Strip& strip = internal::extraction::at(m_layout->strips, index);
    for (const int a : strip.arcs) {
      const Quad_layout::Arc& arc = internal::extraction::at(m_layout->arcs, a);
      m_clusters.unite(arc.source, arc.target);
      Cluster more;
      more.arcs = 1;
      more.curve_arcs = arc.curve >= 0 ? 1 : 0;
      m_clusters.add(arc.source, more);
    }
    for (const auto& [p, side] : strip.patches) {
      const auto& half_arcs = internal::extraction::at(m_layout->patches, p).half_arcs;
      const int left = internal::extraction::at(half_arcs, 1 - side) / 2;
      const int right = internal::extraction::at(half_arcs, 3 - side) / 2;
      if (!m_arc_classes.unite(left, right) || m_arc_classes.data(left).curve_arcs > 1)
        return false;
      const int other_strip = internal::extraction::at(m_layout->arcs, left).strip;
      if (internal::extraction::at(m_is_zero, other_strip) && (other_strip != index || side == 0)) {
        Cluster more;
        more.patches = 1;
        m_clusters.add(internal::extraction::at(m_layout->arcs, left).source, more);
      }
    }
    return std::all_of(strip.arcs.begin(), strip.arcs.end(), [this](int a) {
      return m_clusters.data(internal::extraction::at(m_layout->arcs, a).source).is_valid();
    });
  }

  const Quad_layout* m_layout;
  int m_min_loop_edges;
  std::vector<int> m_min_length;
  std::vector<char> m_is_zero;
  internal::extraction::Undoable_union_find<Cluster> m_clusters;
  internal::extraction::Undoable_union_find<Arc_class> m_arc_classes;
  std::vector<Loop> m_loops;
  std::vector<std::vector<std::pair<int, int>>> m_loops_of_strip; ///< loop, number of the strip's arcs on it
};

} // namespace Quadrille

#endif
