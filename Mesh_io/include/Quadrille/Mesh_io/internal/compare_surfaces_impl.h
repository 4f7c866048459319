// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_COMPARE_SURFACES_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_COMPARE_SURFACES_IMPL_H

#include <Quadrille/Mesh_io/internal/Nearest_tree.h>
#include <Quadrille/Mesh_io/internal/quad_geometry.h>
#include <Quadrille/Mesh_io/internal/vector_length.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/compare_surfaces.h>
#include <Quadrille/exceptions.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

class Surface_comparer {
public:
  Surface_comparer(const Labelled_mesh& mesh, const Surface_domain& domain) : m_mesh(mesh), m_domain(domain) {}

  Surface_comparison run()
  {
    check_mesh();
    find_patches();
    find_edges();
    const std::vector<Triangle_3> surface = triangles_of_domain(), patches = triangles_of_patches();
    m_result.area_relative = area_of(patches) / area_of(surface) - 1;
    measure_to(surface);
    count_flipped(surface);
    measure_from(surface, patches);
    measure_curves();
    CGAL::Bbox_3 box;
    for (const auto v : m_domain.mesh.vertices())
      box += m_domain.mesh.point(v).bbox();
    m_result.hausdorff = std::max(m_result.to_surface_max, m_result.from_surface_max);
    m_result.hausdorff_relative = m_result.hausdorff / diagonal_of(box);
    m_result.feature_distance_max_relative = m_result.feature_distance_max / diagonal_of(box);
    return m_result;
  }

private:
  using Point_3 = Space_kernel::Point_3;
  using Vector_3 = Space_kernel::Vector_3;
  using Segment_3 = Space_kernel::Segment_3;
  using Triangle_3 = Space_kernel::Triangle_3;

  /// Where polygons meet, or one ends.
  struct Edge {
    std::array<int, 2> ends;
    bool is_sharp = false; ///< or on the border
  };

  void check_mesh() const
  {
    if (m_mesh.polygons.empty())
      throw Invalid_argument_error("a mesh without polygons cannot be compared with a surface");
    const auto check = [&](int v) {
      for (const double x : m_mesh.points[std::size_t(v)])
        if (!std::isfinite(x))
          throw Invalid_argument_error("vertex " + std::to_string(v) +
                                       " of a mesh has a coordinate that is not a finite number");
    };
    for (const std::vector<int>& polygon : m_mesh.polygons)
      std::for_each(polygon.begin(), polygon.end(), check);
    for (const std::array<int, 2>& line : m_mesh.lines)
      std::for_each(line.begin(), line.end(), check);
  }

  Point_3 point(int v) const { return space_point(m_mesh, v); }
  Point_3 point(Surface_domain::vertex_descriptor v) const
  {
    const Surface_domain::Point_3& p = m_domain.mesh.point(v);
    return {p.x(), p.y(), p.z()};
  }

  /// Quads, and triangles as quads whose last two corners are the same.
  void find_patches()
  {
    for (const std::vector<int>& p : m_mesh.polygons)
      if (p.size() == 4)
        m_patches.push_back({p[0], p[1], p[2], p[3]});
      else
        for (std::size_t i = 2; i < p.size(); ++i)
          m_patches.push_back({p[0], p[i - 1], p[i], p[i]});
  }

  void find_edges()
  {
    struct Side {
      int low, high;
      std::size_t polygon;
      bool is_forward;
    };
    std::vector<Side> sides;
    std::vector<Vector_3> normals;
    for (std::size_t f = 0; f < m_mesh.polygons.size(); ++f) {
      const std::vector<int>& p = m_mesh.polygons[f];
      normals.push_back(direction_of(doubled_area_vector(m_mesh, p)));
      for (std::size_t i = 0; i < p.size(); ++i) {
        const int a = p[i], b = p[(i + 1) % p.size()];
        sides.push_back({std::min(a, b), std::max(a, b), f, a < b});
      }
    }
    const auto ends = [](const Side& s) { return std::array{s.low, s.high}; };
    std::stable_sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) { return ends(a) < ends(b); });
    const double cosine = std::cos(Surface_domain_options().crease_angle * CGAL_PI / 180);
    for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
      while (next < sides.size() && ends(sides[next]) == ends(sides[i]))
        ++next;
      bool is_sharp = next - i != 2;
      if (!is_sharp) {
        const double product = normals[sides[i].polygon] * normals[sides[i + 1].polygon];
        is_sharp = (sides[i].is_forward == sides[i + 1].is_forward ? -product : product) < cosine;
      }
      m_edges.push_back({ends(sides[i]), is_sharp});
    }
  }

  std::vector<Triangle_3> triangles_of_domain() const
  {
    std::vector<Triangle_3> triangles;
    for (const auto f : m_domain.mesh.faces()) {
      const auto h = m_domain.mesh.halfedge(f);
      triangles.emplace_back(point(m_domain.mesh.source(h)), point(m_domain.mesh.target(h)),
                             point(m_domain.mesh.target(m_domain.mesh.next(h))));
    }
    return triangles;
  }

  std::vector<Triangle_3> triangles_of_patches() const
  {
    std::vector<Triangle_3> triangles;
    for (const auto& [a, b, c, d] : m_patches) {
      const Point_3 p = point(a), q = point(b), r = point(c), s = point(d);
      if (c == d) {
        triangles.emplace_back(p, q, r);
      } else if (CGAL::squared_distance(q, s) < CGAL::squared_distance(p, r)) {
        triangles.emplace_back(q, r, s);
        triangles.emplace_back(q, s, p);
      } else {
        triangles.emplace_back(p, q, r);
        triangles.emplace_back(p, r, s);
      }
    }
    return triangles;
  }

  static Vector_3 doubled_area_vector_of(const Triangle_3& t) { return CGAL::cross_product(t[1] - t[0], t[2] - t[0]); }

  static double area_of(const std::vector<Triangle_3>& triangles)
  {
    double sum = 0;
    for (const Triangle_3& t : triangles)
      sum += 0.5 * length_of(doubled_area_vector_of(t));
    return sum;
  }

  /// Each vertex and edge of the mesh once, and the patches inside.
  void measure_to(const std::vector<Triangle_3>& surface)
  {
    const Nearest_tree<Triangle_3> tree(surface);
    const auto measure = [&](const Point_3& p) {
      m_result.to_surface_max = std::max(m_result.to_surface_max, tree.nearest(p).distance);
    };
    std::vector<char> is_used(m_mesh.points.size(), 0);
    for (const Edge& edge : m_edges) {
      const Point_3 p = point(edge.ends[0]);
      const Vector_3 along = point(edge.ends[1]) - p;
      for (int i = 1; i < n_cells; ++i)
        measure(p + double(i) / n_cells * along);
      is_used[std::size_t(edge.ends[0])] = is_used[std::size_t(edge.ends[1])] = 1;
    }
    for (std::size_t v = 0; v < is_used.size(); ++v)
      if (is_used[v])
        measure(point(int(v)));
    for (const std::array<int, 4>& patch : m_patches)
      for (int i = 1; i < n_cells; ++i)
        for (int j = 1; j < n_cells; ++j)
          measure(bilinear(patch, double(i) / n_cells, double(j) / n_cells));
  }

  /// Where the mesh tells which surface a quad is of, what is nearer on another one does not matter: the other side of
  /// a thin wall, or a part that touches.
  void count_flipped(const std::vector<Triangle_3>& surface)
  {
    std::map<int, std::vector<Triangle_3>> surface_of; // by tag
    for (const auto f : m_domain.mesh.faces())
      surface_of[m_domain.regions[std::size_t(m_domain.face_region[f.idx()])].tag].push_back(surface[f.idx()]);
    std::map<int, std::vector<std::size_t>> quads_of; // by tag
    std::vector<std::size_t> others;
    for (std::size_t f = 0; f < m_mesh.polygons.size(); ++f) {
      if (m_mesh.polygons[f].size() != 4)
        continue;
      const int region = m_mesh.polygon_region[f];
      const int tag = region < 0 ? 0 : m_mesh.regions[std::size_t(region)].tag;
      (region >= 0 && surface_of.count(tag) ? quads_of[tag] : others).push_back(f);
    }
    for (const auto& [tag, quads] : quads_of)
      count_flipped(quads, surface_of[tag]);
    count_flipped(others, surface);
  }

  void count_flipped(const std::vector<std::size_t>& quads, const std::vector<Triangle_3>& surface)
  {
    if (quads.empty())
      return;
    const Nearest_tree<Triangle_3> tree(surface);
    for (const std::size_t f : quads) {
      const std::vector<int>& q = m_mesh.polygons[f];
      const Vector_3 normal =
          doubled_area_vector_of(surface[tree.nearest(bilinear({q[0], q[1], q[2], q[3]}, 0.5, 0.5)).index]);
      m_result.flipped_quads += doubled_area_vector(m_mesh, q) * normal < 0;
    }
  }

  Point_3 bilinear(const std::array<int, 4>& patch, double s, double t) const
  {
    const Point_3 p = point(patch[0]);
    return p + s * (1 - t) * (point(patch[1]) - p) + s * t * (point(patch[2]) - p) +
           (1 - s) * t * (point(patch[3]) - p);
  }

  void measure_from(const std::vector<Triangle_3>& surface, const std::vector<Triangle_3>& patches)
  {
    const Nearest_tree<Triangle_3> tree(patches);
    const auto measure = [&](const Point_3& p) {
      m_result.from_surface_max = std::max(m_result.from_surface_max, tree.nearest(p).distance);
    };
    for (const auto v : m_domain.mesh.vertices())
      measure(point(v));
    for (const Triangle_3& t : surface)
      measure(CGAL::centroid(t));
  }

  void measure_curves()
  {
    std::vector<Segment_3> lines;
    for (const std::array<int, 2>& line : m_mesh.lines)
      lines.emplace_back(point(line[0]), point(line[1]));
    if (lines.empty())
      for (const Edge& edge : m_edges)
        if (edge.is_sharp)
          lines.emplace_back(point(edge.ends[0]), point(edge.ends[1]));
    const Nearest_tree<Segment_3> tree(std::move(lines));
    for (const auto e : m_domain.mesh.edges())
      if (m_domain.edge_curve[std::size_t(e.idx())] >= 0) {
        const auto h = m_domain.mesh.halfedge(e);
        const Point_3 p = point(m_domain.mesh.source(h)), q = point(m_domain.mesh.target(h));
        for (const Point_3& place : {p, CGAL::midpoint(p, q), q})
          m_result.feature_distance_max = std::max(m_result.feature_distance_max, tree.nearest(place).distance);
      }
  }

  static constexpr int n_cells = 4; ///< along a side of a quad, between the points at which it is compared

  const Labelled_mesh& m_mesh;
  const Surface_domain& m_domain;
  Surface_comparison m_result;
  std::vector<std::array<int, 4>> m_patches;
  std::vector<Edge> m_edges;
};

} // namespace internal

QUADRILLE_INLINE Surface_comparison compare_with_surface(const Labelled_mesh& mesh, const Surface_domain& domain)
{
  return internal::Surface_comparer(mesh, domain).run();
}

} // namespace Quadrille

#endif
