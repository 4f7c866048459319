// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_COLLAPSE_CHECK_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_COLLAPSE_CHECK_H

#include <Quadrille/Quad_extraction/internal/Collapsed_layout.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Finds out whether a collapse keeps the surface, its border, its curves and all valences.
///
/// What becomes one vertex must be contractible, contain at most one critical node, meet the curves in one connected
/// piece, and not join an interior singularity with a curve; what becomes one edge must be contractible and contain at
/// most one edge on a curve. Then the collapse is a deformation of the domain.
class Collapse_check {
public:
  explicit Collapse_check(const Collapsed_layout& collapsed) : m_collapsed(collapsed), m_layout(collapsed.layout()) {}

  /// Sets of arcs all of which have length 0, and one of each of which must not. Empty if the collapse is good.
  /// Complexity: linear, plus what is wrong times its size.
  std::vector<std::vector<int>> run()
  {
    check_vertices();
    check_edges();
    std::sort(m_conflicts.begin(), m_conflicts.end());
    m_conflicts.erase(std::unique(m_conflicts.begin(), m_conflicts.end()), m_conflicts.end());
    return std::move(m_conflicts);
  }

private:
  using Link = Collapsed_layout::Link;

  /// Points or unit edges that become one, with the links between them, and a tree of links.
  struct Class {
    std::vector<int> elements; ///< sorted
    std::vector<Link> links;
    std::vector<int> cells; ///< patches without any width

    int index(int element) const
    {
      return static_cast<int>(std::lower_bound(elements.begin(), elements.end(), element) - elements.begin());
    }
  };

  bool is_on_curve(int point) const
  {
    if (point < size_of(m_layout.nodes))
      return at(m_layout.nodes, point).constrained;
    return at(m_point_on_curve, point - size_of(m_layout.nodes)) != 0;
  }
  bool is_critical(int point) const { return point < size_of(m_layout.nodes) && at(m_layout.nodes, point).critical; }
  bool is_curve_link(const Link& link) const { return link.arc >= 0 && at(m_layout.arcs, link.arc).curve >= 0; }

  void check_vertices()
  {
    struct Count {
      int euler = 0, critical = 0, singularities = 0, curve = 0;
      bool on_curve = false;
    };
    for (int a = 0; a < size_of(m_layout.arcs); ++a)
      m_point_on_curve.insert(m_point_on_curve.end(), std::size_t(std::max(0, m_collapsed.length(a) - 1)),
                              at(m_layout.arcs, a).curve >= 0 ? 1 : 0);
    std::vector<Count> counts(std::size_t(m_collapsed.number_of_vertices()));
    for (int p = 0; p < m_collapsed.number_of_points(); ++p) {
      Count& count = at(counts, m_collapsed.vertex(p));
      ++count.euler;
      count.critical += is_critical(p) ? 1 : 0;
      count.singularities += is_critical(p) && !is_on_curve(p) ? 1 : 0;
      count.curve += is_on_curve(p) ? 1 : 0;
      count.on_curve = count.on_curve || is_on_curve(p);
    }
    for (const Link& link : m_collapsed.point_links()) {
      Count& count = at(counts, m_collapsed.vertex(link.a));
      --count.euler;
      count.curve -= is_curve_link(link) ? 1 : 0;
    }
    std::map<int, std::vector<int>> cells; // patches without any width, by vertex
    for (int p = 0; p < size_of(m_layout.patches); ++p)
      if (m_collapsed.side_length(p, 0) == 0 && m_collapsed.side_length(p, 1) == 0) {
        const int vertex = m_collapsed.vertex(m_layout.source(at(m_layout.patches, p).sides[0].front()));
        cells[vertex].push_back(p);
        ++at(counts, vertex).euler;
      }
    std::vector<char> bad;
    bool any = false;
    for (const Count& count : counts) {
      bad.push_back(count.euler != 1 || count.critical > 1 || (count.on_curve && count.curve != 1) ||
                    (count.on_curve && count.singularities > 0));
      any = any || bad.back();
    }
    if (!any)
      return;
    for (Class& merged : collect(bad, m_collapsed.number_of_points(), m_collapsed.point_links(),
                                 [this](int p) { return m_collapsed.vertex(p); })) {
      merged.cells = cells[m_collapsed.vertex(merged.elements.front())];
      separate_vertices(merged);
    }
  }

  void check_edges()
  {
    std::vector<int> curve_of;
    for (int a = 0; a < size_of(m_layout.arcs); ++a)
      curve_of.insert(curve_of.end(), std::size_t(m_collapsed.length(a)), at(m_layout.arcs, a).curve);
    std::vector<int> euler(std::size_t(m_collapsed.number_of_edge_classes()), 0);
    std::vector<int> on_curves(euler.size(), 0);
    for (int e = 0; e < m_collapsed.number_of_edges(); ++e) {
      ++at(euler, m_collapsed.edge_class(e));
      at(on_curves, m_collapsed.edge_class(e)) += at(curve_of, e) >= 0 ? 1 : 0;
    }
    for (const Link& link : m_collapsed.edge_links())
      --at(euler, m_collapsed.edge_class(link.a));
    std::vector<char> bad;
    bool any = false;
    for (std::size_t c = 0; c < euler.size(); ++c) {
      bad.push_back(euler[c] != 1 || on_curves[c] > 1);
      any = any || bad.back();
    }
    if (!any)
      return;
    for (const Class& merged : collect(bad, m_collapsed.number_of_edges(), m_collapsed.edge_links(),
                                       [this](int e) { return m_collapsed.edge_class(e); })) {
      const auto is_target = [&](int e) { return at(curve_of, e) >= 0; };
      for (const int e : merged.elements)
        if (is_target(e))
          separate(merged, {e}, is_target);
      open_rings(merged);
    }
  }

  template <class Class_of>
  std::vector<Class> collect(const std::vector<char>& bad, int n, const std::vector<Link>& links,
                             const Class_of& class_of) const
  {
    std::vector<int> index(bad.size(), -1);
    std::vector<Class> classes;
    for (int i = 0; i < n; ++i)
      if (at(bad, class_of(i))) {
        int& c = at(index, class_of(i));
        if (c < 0) {
          c = size_of(classes);
          classes.emplace_back();
        }
        at(classes, c).elements.push_back(i);
      }
    for (const Link& link : links)
      if (at(bad, class_of(link.a)))
        at(classes, at(index, class_of(link.a))).links.push_back(link);
    return classes;
  }

  void separate_vertices(const Class& merged)
  {
    const std::size_t before = m_conflicts.size();
    for (const int p : merged.elements) {
      if (!is_critical(p))
        continue;
      separate(merged, {p}, [this](int q) { return is_critical(q); });
      if (!is_on_curve(p))
        separate(merged, {p}, [this](int q) { return is_on_curve(q); });
    }
    if (m_conflicts.size() == before)
      open_rings(merged);
    if (m_conflicts.size() == before)
      separate_curves(merged);
  }

  /// Several pieces of curves, or a closed one.
  void separate_curves(const Class& merged)
  {
    Class curves;
    std::copy_if(merged.elements.begin(), merged.elements.end(), std::back_inserter(curves.elements),
                 [this](int p) { return is_on_curve(p); });
    std::copy_if(merged.links.begin(), merged.links.end(), std::back_inserter(curves.links),
                 [this](const Link& link) { return is_curve_link(link); });
    const std::vector<int> piece = reached(curves, curves.elements.front());
    if (piece.size() < curves.elements.size())
      separate(merged, piece, [this](int q) { return is_on_curve(q); });
    else
      open_rings(curves);
  }

  static std::vector<int> reached(const Class& merged, int start)
  {
    const Tree tree = grow(merged, {start}, [](int) { return false; });
    std::vector<int> result;
    for (int i = 0; i < size_of(merged.elements); ++i)
      if (at(tree.reached, i))
        result.push_back(at(merged.elements, i));
    return result;
  }

  /// For every element the link by which it was reached from the start, and who was reached first of the targets.
  struct Tree {
    std::vector<int> link;
    std::vector<int> from;
    std::vector<char> reached;
    int found = -1;
  };

  /// Breadth-first from `start`, preferring arcs to patches; stops at the first target outside `start`.
  static Tree grow(const Class& merged, const std::vector<int>& start, const std::function<bool(int)>& is_target)
  {
    const std::size_t n = merged.elements.size();
    std::vector<std::vector<int>> links_at(n);
    for (int l = 0; l < size_of(merged.links); ++l) {
      at(links_at, merged.index(at(merged.links, l).a)).push_back(l);
      at(links_at, merged.index(at(merged.links, l).b)).push_back(l);
    }
    Tree tree{std::vector<int>(n, -1), std::vector<int>(n, -1), std::vector<char>(n, 0)};
    std::deque<std::array<int, 3>> front; // element, link to it, where from
    for (const int e : start)
      front.push_back({merged.index(e), -1, -1});
    std::size_t to_start = start.size();
    while (!front.empty()) {
      const auto [i, link, from] = front.front();
      front.pop_front();
      const bool is_start = to_start > 0;
      to_start -= is_start ? 1 : 0;
      if (at(tree.reached, i))
        continue;
      at(tree.reached, i) = 1;
      at(tree.link, i) = link;
      at(tree.from, i) = from;
      if (!is_start && is_target(at(merged.elements, i))) {
        tree.found = i;
        return tree;
      }
      for (const int l : at(links_at, i)) {
        const int a = merged.index(at(merged.links, l).a);
        const int other = a == i ? merged.index(at(merged.links, l).b) : a;
        if (at(tree.reached, other))
          continue;
        if (at(merged.links, l).arc >= 0 && to_start == 0)
          front.push_front({other, l, i});
        else
          front.push_back({other, l, i});
      }
    }
    return tree;
  }

  /// The links from element `i` (an index) to the root.
  static std::vector<int> path(const Tree& tree, int i)
  {
    std::vector<int> links;
    for (; at(tree.link, i) >= 0; i = at(tree.from, i))
      links.push_back(at(tree.link, i));
    return links;
  }

  void separate(const Class& merged, const std::vector<int>& start, const std::function<bool(int)>& is_target)
  {
    const Tree tree = grow(merged, start, is_target);
    if (tree.found >= 0)
      add_conflict(merged, path(tree, tree.found));
  }

  /// A conflict for each ring in the class that its cells do not fill.
  void open_rings(const Class& merged)
  {
    const Tree tree = grow(merged, {merged.elements.front()}, [](int) { return false; });
    std::vector<char> in_tree(merged.links.size(), 0);
    for (const int link : tree.link)
      if (link >= 0)
        at(in_tree, link) = 1;
    // Cells and the outside, joined across links: a link that joins what is joined already closes a ring.
    std::vector<int> parent(merged.cells.size() + 1);
    for (int i = 0; i < size_of(parent); ++i)
      at(parent, i) = i;
    const auto find = [&parent](int i) {
      while (at(parent, i) != i)
        i = at(parent, i) = at(parent, at(parent, i));
      return i;
    };
    const auto cell = [&](int half_arc) {
      const int p = at(m_layout.left_patch, half_arc);
      const auto place = std::lower_bound(merged.cells.begin(), merged.cells.end(), p);
      return place != merged.cells.end() && *place == p ? static_cast<int>(place - merged.cells.begin()) + 1 : 0;
    };
    for (int l = 0; l < size_of(merged.links); ++l) {
      if (at(in_tree, l))
        continue;
      const Link& link = at(merged.links, l);
      const int left = link.arc >= 0 ? find(cell(2 * link.arc)) : 0;
      const int right = link.arc >= 0 ? find(cell(2 * link.arc + 1)) : 0;
      if (left != right) {
        at(parent, std::max(left, right)) = std::min(left, right);
        continue;
      }
      std::vector<int> ring = path(tree, merged.index(link.a));
      for (const int other : path(tree, merged.index(link.b))) { // what both paths share does not belong to the ring
        const auto shared = std::find(ring.begin(), ring.end(), other);
        if (shared != ring.end())
          ring.erase(shared);
        else
          ring.push_back(other);
      }
      ring.push_back(l);
      add_conflict(merged, ring);
    }
  }

  void add_conflict(const Class& merged, const std::vector<int>& links)
  {
    std::vector<int> arcs;
    for (const int l : links) {
      const Link& link = at(merged.links, l);
      if (link.arc >= 0) {
        arcs.push_back(link.arc);
        continue;
      }
      const int side = m_collapsed.side_length(link.patch, 0) == 0 ? 0 : 1; // the side without length
      for (const int h : at(at(m_layout.patches, link.patch).sides, side))
        arcs.push_back(h / 2);
    }
    std::sort(arcs.begin(), arcs.end());
    arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
    m_conflicts.push_back(std::move(arcs));
  }

  const Collapsed_layout& m_collapsed;
  const Quad_layout& m_layout;
  std::vector<char> m_point_on_curve; ///< by inner point of an arc
  std::vector<std::vector<int>> m_conflicts;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
