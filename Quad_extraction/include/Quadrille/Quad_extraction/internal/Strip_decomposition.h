// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_STRIP_DECOMPOSITION_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_STRIP_DECOMPOSITION_H

#include <Quadrille/Quad_extraction/internal/at.h>
#include <Quadrille/Quad_layout.h>
#include <Quadrille/exceptions.h>

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Writes the lengths of a layout's arcs as sums of the widths of strips.
///
/// In a patch, opposite sides are overlaid: each overlap of two arcs is a *link* as wide as the overlap. Strips are
/// walks from link to link, as wide as the narrowest link allows; each uses up a link at least. All widths are exact:
/// they are differences of lengths, and halves of them where a strip runs through a link twice.
class Strip_decomposition {
public:
  explicit Strip_decomposition(const Quad_layout& layout) : m_layout(layout), m_links_at(2 * layout.arcs.size())
  {
    for (int p = 0; p < size_of(layout.patches); ++p)
      for (int side = 0; side < 2; ++side)
        add_links(p, side);
  }

  /// Complexity: the number of arcs times the number of links per strip.
  std::vector<Quad_layout::Strip> run()
  {
    for (int h = 0; h < size_of(m_links_at); ++h)
      if (at(m_layout.left_patch, h) < 0)
        while (open_link(h ^ 1) >= 0)
          add_strip(h ^ 1);
    for (int h = 0; h < size_of(m_links_at); ++h)
      while (open_link(h) >= 0)
        add_strip(h);
    return std::move(m_strips);
  }

private:
  /// Half-arcs `a` and `b` on opposite sides of a patch, which is on the left of both.
  struct Link {
    int a;
    int b;
    double width;
    int patch;
    int side;
  };
  struct Visit {
    int link;
    bool forward; ///< from a to b
  };

  void add_links(int p, int side)
  {
    const Quad_layout::Patch& patch = at(m_layout.patches, p);
    const std::vector<int>& near = at(patch.sides, side);
    const std::vector<int>& far = at(patch.sides, side + 2);
    std::size_t i = 0;
    std::size_t j = far.size() - 1;
    double from_a = m_layout.arc_of(near[i]).length;
    double from_b = m_layout.arc_of(far[j]).length;
    while (true) {
      const double width = std::min(from_a, from_b);
      at(m_links_at, near[i]).push_back(size_of(m_links));
      at(m_links_at, far[j]).push_back(size_of(m_links));
      m_links.push_back({near[i], far[j], width, p, side});
      from_a -= width;
      from_b -= width;
      const bool near_done = from_a == 0 && i + 1 == near.size();
      const bool far_done = from_b == 0 && j == 0;
      if (near_done && far_done)
        return;
      if ((from_a == 0 && near_done) || (from_b == 0 && far_done))
        throw No_result_error("layout", "opposite sides of a patch differ in length");
      if (from_a == 0)
        from_a = m_layout.arc_of(near[++i]).length;
      if (from_b == 0)
        from_b = m_layout.arc_of(far[--j]).length;
    }
  }

  /// A link that leads from half-arc `h` into the patch on its left and is not used up, or -1.
  int open_link(int h)
  {
    std::vector<int>& links = at(m_links_at, h);
    while (!links.empty() && !(at(m_links, links.back()).width > 0))
      links.pop_back();
    return links.empty() ? -1 : links.back();
  }

  /// Follows open links from half-arc `h` to the border, or cuts a closed walk out of what was passed.
  void add_strip(int h)
  {
    std::vector<Visit> walk;
    std::unordered_map<int, int> first_visit; // by half-arc from which a link was entered
    while (true) {
      const auto [place, is_new] = first_visit.emplace(h, size_of(walk));
      if (!is_new) {
        subtract({walk.begin() + place->second, walk.end()}, true);
        return;
      }
      const int link = open_link(h);
      if (link < 0) { // halves were rounded: what is left of the last link is nothing
        at(m_links, walk.back().link).width = 0;
        return;
      }
      walk.push_back({link, at(m_links, link).a == h});
      const int exit = walk.back().forward ? at(m_links, link).b : at(m_links, link).a;
      h = exit ^ 1;
      if (at(m_layout.left_patch, h) < 0) {
        subtract(walk, false);
        return;
      }
    }
  }

  void subtract(const std::vector<Visit>& walk, bool closed)
  {
    std::unordered_map<int, int> times;
    for (const Visit& visit : walk)
      ++times[visit.link];
    Quad_layout::Strip strip;
    strip.length = at(m_links, walk.front().link).width;
    for (const auto& [link, n] : times)
      strip.length = std::min(strip.length, at(m_links, link).width / n);
    for (const Visit& visit : walk) {
      Link& link = at(m_links, visit.link);
      link.width -= strip.length;
      strip.arcs.push_back((visit.forward ? link.a : link.b) / 2);
      strip.patches.push_back({link.patch, link.side});
    }
    if (!closed)
      strip.arcs.push_back((walk.back().forward ? at(m_links, walk.back().link).b : at(m_links, walk.back().link).a) /
                           2);
    m_strips.push_back(std::move(strip));
  }

  const Quad_layout& m_layout;
  std::vector<Link> m_links;
  std::vector<std::vector<int>> m_links_at; ///< by half-arc: those in the patch on its left
  std::vector<Quad_layout::Strip> m_strips;
};

inline std::vector<Quad_layout::Strip> decompose_into_strips(const Quad_layout& layout)
{
  return Strip_decomposition(layout).run();
}

} // namespace internal::extraction
} // namespace Quadrille

#endif
