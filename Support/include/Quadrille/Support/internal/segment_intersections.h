// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SUPPORT_INTERNAL_SEGMENT_INTERSECTIONS_H
#define QUADRILLE_SUPPORT_INTERNAL_SEGMENT_INTERSECTIONS_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

using Segment_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// A segment between two numbered points; segments that share a number share that end.
struct Numbered_segment {
  std::array<int, 2> ends;
};

/// Whether two segments meet anywhere but in an end point that they share by number. Exact.
inline bool segments_conflict(const std::vector<Segment_kernel::Point_2>& points, const Numbered_segment& s,
                              const Numbered_segment& t)
{
  const auto at = [&](int i) -> const Segment_kernel::Point_2& { return points[std::size_t(i)]; };
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      if (s.ends[i] == t.ends[j]) {
        const int a = s.ends[1 - i], b = t.ends[1 - j], o = s.ends[i];
        if (a == b)
          return true;
        return CGAL::orientation(at(o), at(a), at(b)) == CGAL::COLLINEAR &&
               !CGAL::collinear_are_strictly_ordered_along_line(at(a), at(o), at(b));
      }
  return CGAL::do_intersect(Segment_kernel::Segment_2(at(s.ends[0]), at(s.ends[1])),
                            Segment_kernel::Segment_2(at(t.ends[0]), at(t.ends[1])));
}

/// Calls `visit(i, j)`, i < j, for all pairs of segments whose boxes meet, in any order. Complexity: O(n log n +
/// pairs).
template <class Visitor>
void visit_close_segments(const std::vector<Segment_kernel::Point_2>& points,
                          const std::vector<Numbered_segment>& segments, const Visitor& visit)
{
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, std::size_t>;
  std::vector<Box> boxes;
  boxes.reserve(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i)
    boxes.emplace_back(
        points[std::size_t(segments[i].ends[0])].bbox() + points[std::size_t(segments[i].ends[1])].bbox(), i);
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    visit(std::min(a.info(), b.info()), std::max(a.info(), b.info()));
  });
}

/// The pair of conflicting segments with the smallest indices, if there is one.
inline std::optional<std::pair<std::size_t, std::size_t>>
find_segment_conflict(const std::vector<Segment_kernel::Point_2>& points, const std::vector<Numbered_segment>& segments)
{
  std::optional<std::pair<std::size_t, std::size_t>> found;
  visit_close_segments(points, segments, [&](std::size_t i, std::size_t j) {
    const std::pair<std::size_t, std::size_t> pair(i, j);
    if ((!found || pair < *found) && segments_conflict(points, segments[i], segments[j]))
      found = pair;
  });
  return found;
}

} // namespace internal
} // namespace Quadrille

#endif
