// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_LAYOUT_SUMS_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_LAYOUT_SUMS_H

#include <Quadrille/Curve_count.h>
#include <Quadrille/Quad_extraction/internal/at.h>
#include <Quadrille/Quad_layout.h>
#include <Quadrille/exceptions.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

inline long long sum_of(const std::vector<int>& arcs, const std::vector<int>& lengths)
{
  long long sum = 0;
  for (const int a : arcs)
    sum += at(lengths, a);
  return sum;
}

inline std::vector<int> arcs_of(const std::vector<int>& half_arcs)
{
  std::vector<int> arcs;
  for (const int h : half_arcs)
    arcs.push_back(h / 2);
  return arcs;
}

/// Are the lengths not negative and those of opposite sides equal?
inline bool is_consistent(const Quad_layout& layout, const std::vector<int>& lengths)
{
  if (lengths.size() != layout.arcs.size() || std::any_of(lengths.begin(), lengths.end(), [](int n) { return n < 0; }))
    return false;
  for (const Quad_layout::Patch& patch : layout.patches)
    for (std::size_t side = 0; side < 2; ++side)
      if (sum_of(arcs_of(patch.sides[side]), lengths) != sum_of(arcs_of(patch.sides[side + 2]), lengths))
        return false;
  return true;
}

/// A request as it is called in messages.
inline std::string name_of(const Curve_count& request)
{
  if (!request.name.empty())
    return request.name;
  std::string name = request.curves.size() == 1 ? "curve" : "curves";
  for (const int curve : request.curves)
    name += " " + std::to_string(curve);
  return name;
}

/// The arcs on the curves of request `index`. \throws Invalid_argument_error as `Length_constraints`.
inline std::vector<int> requested_arcs(const Quad_layout& layout, const std::vector<Curve_count>& requests, int index)
{
  const Curve_count& request = at(requests, index);
  if (request.count <= 0)
    throw Invalid_argument_error(std::to_string(request.count) + " elements are asked for on " + name_of(request) +
                                 "; at least one is needed");
  const std::set<int> curves(request.curves.begin(), request.curves.end());
  for (int i = 0; i < index; ++i)
    for (const int curve : at(requests, i).curves)
      if (curves.count(curve))
        throw Invalid_argument_error(name_of(at(requests, i)) + " and " + name_of(request) +
                                     ", for which numbers of elements are asked, have curve " + std::to_string(curve) +
                                     " in common");
  std::vector<int> arcs;
  for (int a = 0; a < size_of(layout.arcs); ++a)
    if (curves.count(at(layout.arcs, a).curve))
      arcs.push_back(a);
  if (arcs.empty())
    throw Invalid_argument_error("a number of elements is asked for on " + name_of(request) + ", which is not there");
  return arcs;
}

/// The arcs of every border loop, closed chain of a curve, and pair of chains with the same ends.
inline std::vector<std::vector<int>> curve_loops(const Quad_layout& layout)
{
  std::vector<std::vector<int>> loops;
  std::vector<int> border_arc_from(layout.nodes.size(), -1);
  for (int a = 0; a < size_of(layout.arcs); ++a)
    if (at(layout.arcs, a).border)
      at(border_arc_from, at(layout.arcs, a).source) = a;
  for (const int first : std::vector<int>(border_arc_from)) {
    std::vector<int> arcs;
    for (int a = first; a >= 0 && at(border_arc_from, at(layout.arcs, a).source) >= 0;
         a = at(border_arc_from, at(layout.arcs, a).target)) {
      arcs.push_back(a);
      at(border_arc_from, at(layout.arcs, a).source) = -1;
    }
    if (!arcs.empty())
      loops.push_back(std::move(arcs));
  }
  std::map<std::pair<int, int>, std::vector<int>> arcs_between;
  for (const Quad_layout::Curve_chain& chain : layout.chains) {
    const std::pair<int, int> ends =
        std::minmax(layout.source(chain.half_arcs.front()), layout.target(chain.half_arcs.back()));
    const std::vector<int> arcs = arcs_of(chain.half_arcs);
    if (ends.first == ends.second) {
      loops.push_back(arcs);
      continue;
    }
    const auto [other, is_first] = arcs_between.emplace(ends, arcs);
    if (is_first)
      continue;
    std::vector<int> both = other->second;
    both.insert(both.end(), arcs.begin(), arcs.end());
    loops.push_back(std::move(both));
    other->second = arcs;
  }
  return loops;
}

/// Sets of arcs not all of which may vanish, as far as they are seen at once: curves and separatrices between critical
/// nodes or from singularities to curves, patches between such nodes.
inline std::vector<std::vector<int>> arcs_to_keep(const Quad_layout& layout)
{
  const auto must_part = [&layout](int a, int b) {
    const Quad_layout::Node& p = at(layout.nodes, a);
    const Quad_layout::Node& q = at(layout.nodes, b);
    const bool off_curve =
        (p.critical && !p.constrained && q.constrained) || (q.critical && !q.constrained && p.constrained);
    return a != b && ((p.critical && q.critical) || off_curve);
  };
  std::set<std::vector<int>> kept;
  const auto keep = [&kept](const std::vector<int>& half_arcs, const std::vector<int>& more = {}) {
    std::vector<int> arcs = arcs_of(half_arcs);
    for (const int h : more)
      arcs.push_back(h / 2);
    std::sort(arcs.begin(), arcs.end());
    arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
    kept.insert(std::move(arcs));
  };
  for (const Quad_layout::Curve_chain& chain : layout.chains)
    if (must_part(layout.source(chain.half_arcs.front()), layout.target(chain.half_arcs.back())))
      keep(chain.half_arcs);
  for (const std::vector<int>& separatrix : layout.separatrices)
    if (!separatrix.empty() && must_part(layout.source(separatrix.front()), layout.target(separatrix.back())))
      keep(separatrix);
  for (const Quad_layout::Patch& patch : layout.patches)
    for (std::size_t side = 0; side < 4; ++side) {
      const int corner = layout.source(patch.sides[side].front());
      if (must_part(corner, layout.target(patch.sides[side].back())))
        keep(patch.sides[side]);
      const std::size_t next = (side + 1) % 4;
      if (side < 2 && must_part(corner, layout.target(patch.sides[next].back())))
        keep(patch.sides[side], patch.sides[next]);
    }
  return {kept.begin(), kept.end()};
}

} // namespace internal::extraction
} // namespace Quadrille

#endif
