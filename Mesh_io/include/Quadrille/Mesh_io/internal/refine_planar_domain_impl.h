// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_REFINE_PLANAR_DOMAIN_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_REFINE_PLANAR_DOMAIN_IMPL_H

#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/exceptions.h>
#include <Quadrille/refine_planar_domain.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace Quadrille {
namespace internal {

/// See `refine_planar_domain`.
class Domain_refiner {
  using Mesh = Planar_domain::Mesh;
  using Point_2 = Planar_domain::Point_2;
  using vertex_descriptor = Planar_domain::vertex_descriptor;
  using halfedge_descriptor = Planar_domain::halfedge_descriptor;
  using face_descriptor = Planar_domain::face_descriptor;

public:
  Domain_refiner(const Planar_domain& domain, std::vector<double> largest_area)
      : m_result{domain, {}}, m_domain(m_result.domain), m_mesh(m_domain.mesh), m_largest_area(std::move(largest_area)),
        m_is_on_curve(m_mesh.number_of_vertices(), 0), m_changed(m_mesh.number_of_faces(), 0)
  {
    for (const auto e : m_mesh.edges())
      if (m_domain.edge_curve[std::size_t(e.idx())] >= 0)
        for (const auto v : {m_mesh.vertex(e, 0), m_mesh.vertex(e, 1)})
          m_is_on_curve[std::size_t(v.idx())] = 1;
  }

  Refined_planar_domain run()
  {
    for (std::size_t f = 0; f < m_largest_area.size(); ++f) // grows with the new faces
      while (area(face(f)) > m_largest_area[f] && bisect_longest_of_path(face(f)))
        ;
    make_delaunay();
    if (!m_domain.edge_tangents.empty())
      m_domain.edge_tangents.resize(m_mesh.number_of_edges(), {});
    m_domain.point_size.resize(m_domain.point_size.empty() ? 0 : m_mesh.number_of_vertices(), 0);
    return std::move(m_result);
  }

private:
  static face_descriptor face(std::size_t f) { return face_descriptor(Mesh::size_type(f)); }
  const Point_2& source(halfedge_descriptor h) const { return m_mesh.point(m_mesh.source(h)); }
  const Point_2& apex(halfedge_descriptor h) const { return m_mesh.point(m_mesh.target(m_mesh.next(h))); }
  double area(face_descriptor f) const
  {
    const halfedge_descriptor h = m_mesh.halfedge(f);
    return CGAL::area(source(h), source(m_mesh.next(h)), apex(h));
  }
  bool is_on_curve(halfedge_descriptor h) const { return m_domain.edge_curve[std::size_t(m_mesh.edge(h).idx())] >= 0; }

  /// Halfedge of a face's longest edge that is not on a curve; null if there is none. Where lengths are equal up to
  /// rounding the numbers of the edges decide, so that scaled and turned domains are refined in the same way.
  halfedge_descriptor longest(face_descriptor f) const
  {
    halfedge_descriptor best = Mesh::null_halfedge();
    std::pair<std::int64_t, int> best_key;
    for (const auto h : m_mesh.halfedges_around_face(m_mesh.halfedge(f))) {
      if (is_on_curve(h))
        continue;
      const double squared_length = CGAL::squared_distance(source(h), source(m_mesh.next(h)));
      const std::pair key(std::int64_t(std::llround(std::ldexp(std::log(squared_length), 24))),
                          int(m_mesh.edge(h).idx()));
      if (best == Mesh::null_halfedge() || key > best_key) {
        best = h;
        best_key = key;
      }
    }
    return best;
  }

  /// Splits the edge at the end of the path of ever longer edges that starts in `f`; false if that is not possible.
  bool bisect_longest_of_path(face_descriptor f)
  {
    halfedge_descriptor h = longest(f);
    if (h == Mesh::null_halfedge())
      return false;
    for (;;) {
      const halfedge_descriptor next = longest(m_mesh.face(m_mesh.opposite(h)));
      if (next == m_mesh.opposite(h))
        return split(h);
      h = next;
    }
  }

  bool split(halfedge_descriptor h)
  {
    const halfedge_descriptor opposite = m_mesh.opposite(h);
    const Point_2 middle = CGAL::midpoint(source(h), source(opposite));
    const auto is_left = [&](const Point_2& p, const Point_2& q) {
      return CGAL::orientation(p, q, middle) == CGAL::COUNTERCLOCKWISE;
    };
    for (const halfedge_descriptor side : {h, opposite})
      if (!is_left(source(m_mesh.next(side)), apex(side)) || !is_left(apex(side), source(side)))
        return false; // too flat for doubles
    m_result.parents.push_back({m_mesh.source(h), m_mesh.target(h)});
    const face_descriptor faces[2] = {m_mesh.face(h), m_mesh.face(opposite)};
    const halfedge_descriptor to_middle = CGAL::Euler::split_edge(h, m_mesh);
    m_mesh.point(m_mesh.target(to_middle)) = middle;
    m_is_on_curve.push_back(0);
    CGAL::Euler::split_face(to_middle, m_mesh.next(h), m_mesh);
    CGAL::Euler::split_face(opposite, m_mesh.next(m_mesh.next(opposite)), m_mesh);
    for (const face_descriptor f : faces) { // the same order as the new faces'
      m_domain.face_region.push_back(m_domain.face_region[std::size_t(f.idx())]);
      m_largest_area.push_back(m_largest_area[std::size_t(f.idx())]);
      m_changed[std::size_t(f.idx())] = 1;
      m_changed.push_back(1);
    }
    m_domain.edge_curve.resize(m_mesh.number_of_edges(), -1);
    m_domain.edge_chain.resize(m_mesh.number_of_edges(), -1);
    return true;
  }

  /// Lawson's flips, in changed faces.
  void make_delaunay()
  {
    std::vector<halfedge_descriptor> stack;
    for (const auto f : m_mesh.faces())
      if (m_changed[std::size_t(f.idx())])
        for (const auto h : m_mesh.halfedges_around_face(m_mesh.halfedge(f)))
          stack.push_back(h);
    while (!stack.empty()) {
      const halfedge_descriptor h = stack.back();
      stack.pop_back();
      if (is_on_curve(h) || !may_flip(h))
        continue;
      CGAL::Euler::flip_edge(h, m_mesh);
      for (const halfedge_descriptor side : {h, m_mesh.opposite(h)}) {
        stack.push_back(m_mesh.next(side));
        stack.push_back(m_mesh.prev(side));
      }
    }
  }

  bool may_flip(halfedge_descriptor h) const
  {
    const halfedge_descriptor opposite = m_mesh.opposite(h);
    if (!m_changed[std::size_t(m_mesh.face(h).idx())] || !m_changed[std::size_t(m_mesh.face(opposite).idx())])
      return false;
    const vertex_descriptor a = m_mesh.target(m_mesh.next(h)), b = m_mesh.target(m_mesh.next(opposite));
    if (m_is_on_curve[std::size_t(a.idx())] && m_is_on_curve[std::size_t(b.idx())])
      return false;
    return exceeds_two_right_angles(h) && CGAL::side_of_oriented_circle(source(h), source(opposite), m_mesh.point(a),
                                                                        m_mesh.point(b)) == CGAL::ON_POSITIVE_SIDE;
  }

  /// Whether the angles opposite to an edge have a sum above 180 degrees, by more than rounding can.
  bool exceeds_two_right_angles(halfedge_descriptor h) const
  {
    double cross[2], dot[2], squared_lengths = 1;
    for (int i = 0; i < 2; ++i, h = m_mesh.opposite(h)) {
      const auto u = source(h) - apex(h), v = source(m_mesh.next(h)) - apex(h);
      cross[i] = u.x() * v.y() - u.y() * v.x();
      dot[i] = u * v;
      squared_lengths *= std::sqrt(u.squared_length() * v.squared_length());
    }
    return cross[0] * dot[1] + dot[0] * cross[1] < -1e-6 * squared_lengths;
  }

  Refined_planar_domain m_result;
  Planar_domain& m_domain;
  Mesh& m_mesh;
  std::vector<double> m_largest_area; ///< per face
  std::vector<char> m_is_on_curve;    ///< per vertex
  std::vector<char> m_changed;        ///< per face
};

} // namespace internal

QUADRILLE_INLINE Refined_planar_domain refine_planar_domain(const Planar_domain& domain,
                                                            const std::vector<double>& largest_area)
{
  if (largest_area.size() != domain.mesh.number_of_faces())
    throw Invalid_argument_error("there are " + std::to_string(largest_area.size()) + " largest areas for " +
                                 std::to_string(domain.mesh.number_of_faces()) + " triangles");
  for (std::size_t f = 0; f < largest_area.size(); ++f)
    if (!(largest_area[f] > 0))
      throw Invalid_argument_error("the largest area of triangle " + std::to_string(f) +
                                   " is not positive, so it could be bisected forever");
  return internal::Domain_refiner(domain, largest_area).run();
}

} // namespace Quadrille

#endif
