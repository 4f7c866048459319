// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_NEAREST_TREE_H
#define QUADRILLE_MESH_IO_INTERNAL_NEAREST_TREE_H

#include <Quadrille/Mesh_io/internal/vector_length.h>

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// For what is only measured: distances are rounded anyway.
using Space_kernel = CGAL::Simple_cartesian<double>;

inline Space_kernel::Point_3 space_point(const std::array<double, 3>& p)
{
  return Space_kernel::Point_3(p[0], p[1], p[2]);
}

/// The kernel with nearest points that also hold for degenerate triangles and slivers, whose planes say nothing.
struct Nearest_point_kernel : Space_kernel {
  struct Construct_projected_point_3 {
    Point_3 operator()(const Segment_3& segment, const Point_3& p) const
    {
      const Vector_3 along = segment.target() - segment.source();
      const double length = along * along;
      const double t = length > 0 ? (p - segment.source()) * along / length : 0;
      return segment.source() + std::clamp(t, 0.0, 1.0) * along;
    }

    Point_3 operator()(const Triangle_3& triangle, const Point_3& p) const
    {
      const Vector_3 normal = CGAL::cross_product(triangle[1] - triangle[0], triangle[2] - triangle[0]);
      const double length = normal * normal;
      bool is_inside = length > 0;
      for (int i = 0; i < 3 && is_inside; ++i)
        is_inside = CGAL::cross_product(triangle[i + 1] - triangle[i], p - triangle[i]) * normal >= 0;
      if (is_inside)
        return p - ((p - triangle[0]) * normal / length) * normal;
      Point_3 best = triangle[0];
      double least = std::numeric_limits<double>::infinity();
      for (int i = 0; i < 3; ++i) {
        const Point_3 q = (*this)(Segment_3(triangle[i], triangle[i + 1]), p);
        if (const double d = (p - q).squared_length(); d < least) {
          best = q;
          least = d;
        }
      }
      return best;
    }
  };
  Construct_projected_point_3 construct_projected_point_3_object() const { return {}; }
};

/// Finds the nearest of some segments or triangles in space.
/// \tparam Object `Space_kernel::Segment_3` or `Space_kernel::Triangle_3`, with finite coordinates; may be degenerate
template <class Object> class Nearest_tree {
public:
  using Point_3 = Space_kernel::Point_3;

  struct Place {
    Point_3 point;
    std::size_t index = 0; ///< of the object
    double distance = std::numeric_limits<double>::infinity();
  };

  /// Complexity: O(n log n).
  explicit Nearest_tree(std::vector<Object> objects)
      : m_objects(std::move(objects)), m_tree(m_objects.begin(), m_objects.end())
  {
    if (m_objects.empty())
      return;
    m_tree.build(); // now, so that later queries may come from several threads without waiting for each other
    m_tree.accelerate_distance_queries();
  }
  Nearest_tree(const Nearest_tree&) = delete; // the tree refers to the objects
  Nearest_tree& operator=(const Nearest_tree&) = delete;

  /// Without objects, the distance is infinite. Complexity: O(log n) in the usual case.
  Place nearest(const Point_3& p) const
  {
    if (m_objects.empty())
      return {};
    const auto [point, object] = m_tree.closest_point_and_primitive(p);
    return {point, std::size_t(object - m_objects.begin()), length_of(p - point)};
  }

private:
  using Iterator = typename std::vector<Object>::const_iterator;
  using Primitive = std::conditional_t<std::is_same_v<Object, Space_kernel::Segment_3>,
                                       CGAL::AABB_segment_primitive<Nearest_point_kernel, Iterator>,
                                       CGAL::AABB_triangle_primitive<Nearest_point_kernel, Iterator>>;

  std::vector<Object> m_objects;
  CGAL::AABB_tree<CGAL::AABB_traits<Nearest_point_kernel, Primitive>> m_tree;
};

} // namespace internal
} // namespace Quadrille

#endif
