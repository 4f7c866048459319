// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_PLANAR_QUAD_MESH_CHECKER_H
#define QUADRILLE_MESH_IO_INTERNAL_PLANAR_QUAD_MESH_CHECKER_H

#include <Quadrille/Mesh_io/internal/Quad_mesh_checker.h>
#include <Quadrille/Mesh_io/internal/format_place.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

/// In a plane z = constant, all quads have the same orientation, and they do not overlap if their border does not.
class Planar_quad_mesh_checker : public Quad_mesh_checker {
public:
  explicit Planar_quad_mesh_checker(const Labelled_mesh& mesh) : Quad_mesh_checker(mesh) {}

private:
  void prepare() override
  {
    for (const auto& [x, y, z] : m_mesh.points) {
      const bool is_finite = std::isfinite(x) && std::isfinite(y); // always, if a polygon uses it
      m_points.push_back(is_finite ? Segment_kernel::Point_2(x, y) : Segment_kernel::Point_2(0, 0));
    }
    m_result.clockwise = true;
    for (const std::vector<int>& polygon : m_mesh.polygons)
      for (std::size_t i = 0; i < polygon.size(); ++i)
        m_result.clockwise = m_result.clockwise && turn(polygon, i) == CGAL::CLOCKWISE;
  }

  CGAL::Orientation turn(const std::vector<int>& polygon, std::size_t i) const
  {
    const std::size_t n = polygon.size();
    return CGAL::orientation(m_points[std::size_t(polygon[(i + n - 1) % n])], m_points[std::size_t(polygon[i])],
                             m_points[std::size_t(polygon[(i + 1) % n])]);
  }

  void check_corners(std::size_t f) override
  {
    const CGAL::Orientation wanted = m_result.clockwise ? CGAL::CLOCKWISE : CGAL::COUNTERCLOCKWISE;
    const std::vector<int>& polygon = m_mesh.polygons[f];
    for (std::size_t i = 0; i < polygon.size(); ++i)
      if (turn(polygon, i) != wanted)
        problem(m_result.inverted_corners,
                polygon_text(f) + " has an inverted or flat corner at " + vertex_text(polygon[i]));
  }

  std::string place_text(int v) const override
  {
    return format_place(m_points[std::size_t(v)].x(), m_points[std::size_t(v)].y());
  }

  bool is_before(int a, int b) const override
  {
    return CGAL::compare_xy(m_points[std::size_t(a)], m_points[std::size_t(b)]) == CGAL::SMALLER;
  }

  std::string edge_problem(int, int) const override { return "is in several polygons that lie on the same side of it"; }

  void check_border() override
  {
    if (const auto pair = find_segment_conflict(m_points, m_border))
      problem(m_result.overlapping_borders, "the border meets itself near " +
                                                vertex_text(m_border[pair->first].ends[0]) +
                                                ": polygons overlap, or share a part of an edge only");
  }

  std::vector<Segment_kernel::Point_2> m_points;
};

} // namespace internal
} // namespace Quadrille

#endif
