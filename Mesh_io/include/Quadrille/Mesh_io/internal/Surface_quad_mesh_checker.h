// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_SURFACE_QUAD_MESH_CHECKER_H
#define QUADRILLE_MESH_IO_INTERNAL_SURFACE_QUAD_MESH_CHECKER_H

#include <Quadrille/Mesh_io/internal/Quad_mesh_checker.h>
#include <Quadrille/Mesh_io/internal/format_place.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Filtered_predicate.h>

#include <cstddef>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

/// On which side of a quad's plane a corner turns to the left: the sign of (next - at) x (previous - at) times the
/// quad's normal (opposite - at) x (previous - next).
template <class Kernel> struct Corner_side_3 {
  using result_type = typename Kernel::Sign;

  template <class Point>
  result_type operator()(const Point& at, const Point& next, const Point& opposite, const Point& previous) const
  {
    return CGAL::sign(CGAL::cross_product(next - at, previous - at) *
                      CGAL::cross_product(opposite - at, previous - next));
  }
};

/// On a surface, every quad has its own normal, and neighbours agree by the direction in which they pass their edge.
/// Whether the surface intersects itself is not asked.
class Surface_quad_mesh_checker : public Quad_mesh_checker {
public:
  explicit Surface_quad_mesh_checker(const Labelled_mesh& mesh) : Quad_mesh_checker(mesh) {}

private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Exact_corner_side =
      CGAL::Filtered_predicate<Corner_side_3<Kernel::Exact_kernel>, Corner_side_3<Kernel::Approximate_kernel>,
                               Kernel::C2E, Kernel::C2F>;

  void prepare() override
  {
    for (const auto& [x, y, z] : m_mesh.points)
      m_points.emplace_back(x, y, z);
  }

  void check_corners(std::size_t f) override
  {
    const std::vector<int>& polygon = m_mesh.polygons[f];
    if (polygon.size() != 4)
      return;
    const auto at = [&](std::size_t i) { return m_points[std::size_t(polygon[i % 4])]; };
    for (std::size_t i = 0; i < 4; ++i)
      if (Exact_corner_side()(at(i), at(i + 1), at(i + 2), at(i + 3)) != CGAL::POSITIVE)
        problem(m_result.inverted_corners,
                polygon_text(f) + " has an inverted or flat corner at " + vertex_text(polygon[i]));
  }

  std::string place_text(int v) const override { return place_in_words(m_mesh.points[std::size_t(v)]); }

  bool is_before(int a, int b) const override { return m_mesh.points[std::size_t(a)] < m_mesh.points[std::size_t(b)]; }

  bool parts_may_touch() const override { return true; }

  std::string edge_problem(int n, int n_back) const override
  {
    if (n + n_back == 2)
      return "is passed by two polygons in the same direction: they are not oriented consistently";
    return "is in " + std::to_string(n + n_back) + " polygons, not in one or two";
  }

  std::vector<Kernel::Point_3> m_points;
};

} // namespace internal
} // namespace Quadrille

#endif
