// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_CLOSED_SURFACE_H
#define QUADRILLE_MESH_IO_INTERNAL_CLOSED_SURFACE_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Mesh_io/internal/format_place.h>
#include <Quadrille/Mesh_io/internal/triangulate_polygon.h>
#include <Quadrille/exceptions.h>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// The triangles of a surface, once it is certain that every edge belongs to two of them.
///
/// Points with equal coordinates become one, polygons with more than three corners are triangulated. The order of the
/// corners does not matter: what is inside is found by counting surfaces, from the outside inwards.
class Closed_surface {
public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point_3 = Kernel::Point_3;
  using Triangle_3 = Kernel::Triangle_3;

  /// \throws Invalid_input_error naming the polygon or edge and its place
  Closed_surface(const Labelled_mesh& mesh, const std::string& path) : m_path(path)
  {
    merge_points(mesh);
    for (std::size_t f = 0; f < mesh.polygons.size(); ++f)
      add_polygon(mesh.polygons[f], f);
    if (m_triangles.empty())
      fail("there are no triangles, so there is nothing to fill with tetrahedra");
    for (const std::array<int, 2>& line : mesh.lines)
      m_lines.push_back({m_index[std::size_t(line[0])], m_index[std::size_t(line[1])]});
    remove_unused_points();
    pair_triangles();
    check_self_intersections();
    find_components();
    if (m_n_components > 1)
      find_holes();
  }

  const std::vector<Point_3>& points() const { return m_points; }
  const std::vector<std::array<int, 3>>& triangles() const { return m_triangles; }
  const std::vector<std::array<int, 2>>& lines() const { return m_lines; } ///< of the file
  const std::vector<Point_3>& holes() const { return m_holes; }            ///< a point in each cavity
  CGAL::Bbox_3 bbox() const { return CGAL::bbox_3(m_points.begin(), m_points.end()); }

  double area() const
  {
    double sum = 0;
    for (std::size_t t = 0; t < m_triangles.size(); ++t)
      sum += std::sqrt(triangle(t).squared_area());
    return sum;
  }

  /// Of what is to be filled.
  double volume() const
  {
    std::vector<double> sums(std::size_t(m_n_components), 0);
    const Point_3& origin = m_points.front();
    for (std::size_t t = 0; t < m_triangles.size(); ++t)
      sums[std::size_t(m_component[t])] +=
          (m_is_turned[t] ? -1 : 1) * CGAL::volume(origin, corner(t, 0), corner(t, 1), corner(t, 2));
    double sum = 0;
    for (std::size_t c = 0; c < sums.size(); ++c)
      sum += (m_depth[c] % 2 == 0 ? 1 : -1) * std::abs(sums[c]);
    return sum;
  }

private:
  /// A component with what tells whether a point is inside.
  struct Component {
    using Mesh = CGAL::Surface_mesh<Point_3>;
    using Side = CGAL::Side_of_triangle_mesh<Mesh, Kernel>;

    std::vector<Triangle_3> triangles;
    Mesh mesh; ///< of the same triangles, each for itself
    std::unique_ptr<Side::AABB_tree> tree;
    std::unique_ptr<Side> side;

    void build()
    {
      for (const Triangle_3& t : triangles)
        mesh.add_face(mesh.add_vertex(t[0]), mesh.add_vertex(t[1]), mesh.add_vertex(t[2]));
      tree = std::make_unique<Side::AABB_tree>(faces(mesh).first, faces(mesh).second, mesh);
      side = std::make_unique<Side>(*tree);
    }
  };

  [[noreturn]] void fail(const std::string& reason) const { throw Invalid_input_error(m_path + ": " + reason); }

  const Point_3& corner(std::size_t t, std::size_t i) const { return m_points[std::size_t(m_triangles[t][i])]; }
  Triangle_3 triangle(std::size_t t) const { return Triangle_3(corner(t, 0), corner(t, 1), corner(t, 2)); }

  void merge_points(const Labelled_mesh& mesh)
  {
    std::vector<int> order(mesh.points.size());
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
      for (const double x : mesh.points[v])
        if (!std::isfinite(x))
          fail("point " + std::to_string(v) + " has a coordinate that is not a finite number");
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return std::pair(mesh.points[std::size_t(a)], a) < std::pair(mesh.points[std::size_t(b)], b);
    });
    std::vector<int> representative(mesh.points.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool is_new = i == 0 || mesh.points[std::size_t(order[i])] != mesh.points[std::size_t(order[i - 1])];
      representative[std::size_t(order[i])] = is_new ? order[i] : representative[std::size_t(order[i - 1])];
    }
    m_index.resize(mesh.points.size());
    for (std::size_t v = 0; v < mesh.points.size(); ++v) { // the first of equal points comes first
      if (representative[v] == int(v)) {
        m_index[v] = int(m_points.size());
        m_points.emplace_back(mesh.points[v][0], mesh.points[v][1], mesh.points[v][2]);
      } else {
        m_index[v] = m_index[std::size_t(representative[v])];
      }
    }
  }

  void add_polygon(const std::vector<int>& polygon, std::size_t f)
  {
    std::vector<int> corners;
    for (const int v : polygon)
      if (const int p = m_index[std::size_t(v)]; corners.empty() || (p != corners.back() && p != corners.front()))
        corners.push_back(p);
    if (corners.size() < 3) // a polygon whose corners are at two places closes no gap and bounds nothing
      return;
    if (corners.size() == 3) {
      add_triangle({corners[0], corners[1], corners[2]}, f);
      return;
    }
    std::vector<Point_3> outline;
    for (const int p : corners)
      outline.push_back(m_points[std::size_t(p)]);
    const std::vector<std::array<int, 3>> triangles = triangulate_polygon(outline);
    if (triangles.empty())
      fail("polygon " + std::to_string(f) + " at " + place_in_words(outline.front()) +
           " cannot be divided into triangles");
    for (const std::array<int, 3>& t : triangles)
      add_triangle({corners[std::size_t(t[0])], corners[std::size_t(t[1])], corners[std::size_t(t[2])]}, f);
  }

  void add_triangle(const std::array<int, 3>& t, std::size_t f)
  {
    const Point_3& p = m_points[std::size_t(t[0])];
    if (CGAL::collinear(p, m_points[std::size_t(t[1])], m_points[std::size_t(t[2])]))
      fail("polygon " + std::to_string(f) + " at " + place_in_words(p) + " is degenerate: its corners lie on a line");
    m_triangles.push_back(t);
    m_polygon.push_back(f);
  }

  void remove_unused_points()
  {
    std::vector<int> index(m_points.size(), -1);
    for (const std::array<int, 3>& t : m_triangles)
      for (const int v : t)
        index[std::size_t(v)] = 0;
    int n = 0;
    for (std::size_t v = 0; v < index.size(); ++v)
      if (index[v] == 0) {
        m_points[std::size_t(n)] = m_points[v];
        index[v] = n++;
      }
    m_points.resize(std::size_t(n));
    for (std::array<int, 3>& t : m_triangles)
      for (int& v : t)
        v = index[std::size_t(v)];
    std::vector<std::array<int, 2>> lines;
    for (const std::array<int, 2>& line : m_lines)
      if (const int a = index[std::size_t(line[0])], b = index[std::size_t(line[1])]; a >= 0 && b >= 0 && a != b)
        lines.push_back({a, b});
    m_lines = std::move(lines);
  }

  /// Finds the neighbours across the three edges of each triangle.
  void pair_triangles()
  {
    struct Side_of_edge {
      std::array<int, 2> ends;
      std::size_t triangle, edge;
    };
    std::vector<Side_of_edge> sides;
    for (std::size_t t = 0; t < m_triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [a, b] = std::minmax(m_triangles[t][i], m_triangles[t][(i + 1) % 3]);
        sides.push_back({{a, b}, t, i});
      }
    std::sort(sides.begin(), sides.end(), [](const Side_of_edge& a, const Side_of_edge& b) {
      return std::pair(a.ends, a.triangle) < std::pair(b.ends, b.triangle);
    });
    m_neighbors.resize(m_triangles.size());
    std::size_t n_bad = 0;
    std::string first_bad;
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
      while (end < sides.size() && sides[end].ends == sides[i].ends)
        ++end;
      if (end - i == 2) {
        m_neighbors[sides[i].triangle][sides[i].edge] = sides[i + 1].triangle;
        m_neighbors[sides[i + 1].triangle][sides[i + 1].edge] = sides[i].triangle;
      } else if (n_bad++ == 0) {
        first_bad = "the edge from " + place_in_words(m_points[std::size_t(sides[i].ends[0])]) + " to " +
                    place_in_words(m_points[std::size_t(sides[i].ends[1])]) + " belongs to " +
                    (end - i == 1 ? "1 triangle" : std::to_string(end - i) + " triangles");
      }
    }
    if (n_bad > 0)
      fail("the surface is not closed: " + first_bad + ", not to 2 (so do " + std::to_string(n_bad - 1) +
           " other edges); what it encloses cannot be filled");
  }

  /// Triangles that are connected by edges; those to turn so that all have the same side outside.
  void find_components()
  {
    m_component.assign(m_triangles.size(), -1);
    m_is_turned.assign(m_triangles.size(), 0);
    for (std::size_t seed = 0; seed < m_triangles.size(); ++seed) {
      if (m_component[seed] >= 0)
        continue;
      std::vector<std::size_t> stack = {seed};
      m_component[seed] = m_n_components++;
      while (!stack.empty()) {
        const std::size_t t = stack.back();
        stack.pop_back();
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t u = m_neighbors[t][i];
          if (m_component[u] >= 0)
            continue;
          m_component[u] = m_component[t];
          m_is_turned[u] = m_is_turned[t] ^ has_edge(u, m_triangles[t][i], m_triangles[t][(i + 1) % 3]);
          stack.push_back(u);
        }
      }
    }
    m_depth.assign(std::size_t(m_n_components), 0);
  }

  bool has_edge(std::size_t t, int a, int b) const
  {
    for (std::size_t i = 0; i < 3; ++i)
      if (m_triangles[t][i] == a && m_triangles[t][(i + 1) % 3] == b)
        return true;
    return false;
  }

  /// Every second surface from outside inwards bounds a cavity.
  void find_holes()
  {
    std::vector<Component> components{std::size_t(m_n_components)};
    for (std::size_t t = 0; t < m_triangles.size(); ++t)
      components[std::size_t(m_component[t])].triangles.push_back(triangle(t));
    for (Component& component : components)
      component.build();
    for (std::size_t c = 0; c < components.size(); ++c)
      for (std::size_t other = 0; other < components.size(); ++other)
        if (other != c && is_inside(components[c], components[other]))
          ++m_depth[c];
    for (std::size_t c = 0; c < components.size(); ++c)
      if (m_depth[c] % 2 == 1)
        m_holes.push_back(point_in_cavity(components[c], components, m_depth[c] + 1));
  }

  /// Components may touch, so the first point that is not on the other surface decides.
  static bool is_inside(const Component& component, const Component& other)
  {
    for (const Triangle_3& t : component.triangles) {
      const CGAL::Bounded_side side = (*other.side)(CGAL::centroid(t));
      if (side != CGAL::ON_BOUNDARY)
        return side == CGAL::ON_BOUNDED_SIDE;
    }
    return false;
  }

  /// A point that has `depth` surfaces around it, as far from them as can be found from some of the triangles.
  Point_3 point_in_cavity(const Component& cavity, const std::vector<Component>& components, int depth) const
  {
    Point_3 best;
    double largest = 0;
    const std::size_t step = cavity.triangles.size() / 50 + 1;
    for (std::size_t i = 0; i < cavity.triangles.size(); i += step)
      for (const double sign : {1.0, -1.0}) {
        const Triangle_3& t = cavity.triangles[i];
        const Point_3 from = CGAL::centroid(t);
        const Kernel::Ray_3 ray(from, sign * t.supporting_plane().orthogonal_vector());
        double nearest = -1;
        for (const Component& component : components)
          for (const Point_3& p : hits(ray, component, &component == &cavity ? int(i) : -1))
            if (const double distance = CGAL::squared_distance(from, p); nearest < 0 || distance < nearest)
              nearest = distance;
        if (nearest <= largest)
          continue;
        const Point_3 middle = from + 0.5 * std::sqrt(nearest / ray.to_vector().squared_length()) * ray.to_vector();
        int n_around = 0;
        for (const Component& component : components)
          n_around += (*component.side)(middle) == CGAL::ON_BOUNDED_SIDE;
        if (n_around == depth) {
          best = middle;
          largest = nearest;
        }
      }
    if (!(largest > 0))
      fail("no point was found in the cavity at " + place_in_words(cavity.triangles.front()[0]));
    return best;
  }

  static std::vector<Point_3> hits(const Kernel::Ray_3& ray, const Component& component, int ignored_triangle)
  {
    std::vector<Component::Side::AABB_tree::Intersection_and_primitive_id<Kernel::Ray_3>::Type> found;
    component.tree->all_intersections(ray, std::back_inserter(found));
    std::vector<Point_3> points;
    for (const auto& [intersection, face] : found)
      if (const Point_3* p = boost::get<Point_3>(&intersection); p && int(face.idx()) != ignored_triangle)
        points.push_back(*p);
    return points;
  }

  /// TetGen would find that out, too, but Debian's version crashes where it reports it.
  void check_self_intersections() const
  {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
    std::vector<Box> boxes;
    for (std::size_t t = 0; t < m_triangles.size(); ++t)
      boxes.emplace_back(triangle(t).bbox(), t);
    std::pair<std::size_t, std::size_t> first(m_triangles.size(), 0);
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
      const std::pair<std::size_t, std::size_t> both(std::min(a.info(), b.info()), std::max(a.info(), b.info()));
      if (both < first && intersect(both.first, both.second))
        first = both;
    });
    if (first.first == m_triangles.size())
      return;
    fail("the surface intersects itself: polygons " + std::to_string(m_polygon[first.first]) + " and " +
         std::to_string(m_polygon[first.second]) + " intersect, near " +
         place_in_words(CGAL::centroid(corner(first.first, 0), corner(first.first, 1), corner(first.first, 2))) +
         " and " +
         place_in_words(CGAL::centroid(corner(first.second, 0), corner(first.second, 1), corner(first.second, 2))) +
         " (polygons are counted from 0)");
  }

  /// Whether two triangles have more in common than their common vertices and edge.
  bool intersect(std::size_t a, std::size_t b) const
  {
    std::vector<std::size_t> common_a, common_b; // positions
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (m_triangles[a][i] == m_triangles[b][j]) {
          common_a.push_back(i);
          common_b.push_back(j);
        }
    if (common_a.empty())
      return CGAL::do_intersect(triangle(a), triangle(b));
    if (common_a.size() == 3)
      return true;
    if (common_a.size() == 2) {
      const Point_3 &p = corner(a, common_a[0]), &q = corner(a, common_a[1]);
      const Point_3 &r = corner(a, 3 - common_a[0] - common_a[1]), &s = corner(b, 3 - common_b[0] - common_b[1]);
      return CGAL::coplanar(p, q, r, s) && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
    }
    const auto opposite = [this](std::size_t t, std::size_t i) {
      return Kernel::Segment_3(corner(t, (i + 1) % 3), corner(t, (i + 2) % 3));
    };
    return CGAL::do_intersect(triangle(a), opposite(b, common_b[0])) ||
           CGAL::do_intersect(triangle(b), opposite(a, common_a[0]));
  }

  const std::string& m_path;
  std::vector<int> m_index; ///< of the file's points, until unused ones are removed
  std::vector<Point_3> m_points;
  std::vector<std::array<int, 3>> m_triangles;
  std::vector<std::size_t> m_polygon; ///< of the file, per triangle
  std::vector<std::array<int, 2>> m_lines;
  std::vector<std::array<std::size_t, 3>> m_neighbors;
  std::vector<int> m_component;
  std::vector<char> m_is_turned;
  int m_n_components = 0;
  std::vector<int> m_depth; ///< per component, how many others are around it
  std::vector<Point_3> m_holes;
};

} // namespace internal
} // namespace Quadrille

#endif
