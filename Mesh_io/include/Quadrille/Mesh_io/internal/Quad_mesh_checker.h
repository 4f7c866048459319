// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_QUAD_MESH_CHECKER_H
#define QUADRILLE_MESH_IO_INTERNAL_QUAD_MESH_CHECKER_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/Mesh_quality.h>
#include <Quadrille/Support/internal/segment_intersections.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// What is checked of quad meshes alike in the plane and in space: how the quads are connected. What is geometry is
/// left to derived classes.
class Quad_mesh_checker {
public:
  Quad_mesh_checker(const Quad_mesh_checker&) = delete;
  Quad_mesh_checker& operator=(const Quad_mesh_checker&) = delete;
  virtual ~Quad_mesh_checker() = default;

  Mesh_validity run()
  {
    if (m_mesh.polygons.empty())
      m_result.problems.push_back("there are no polygons");
    if (m_mesh.polygons.empty() || !check_coordinates())
      return std::move(m_result);
    prepare();
    count_edges();
    check_polygons();
    check_edges();
    count_parts();
    check_duplicates();
    check_fans();
    check_border();
    return std::move(m_result);
  }

protected:
  explicit Quad_mesh_checker(const Labelled_mesh& mesh) : m_mesh(mesh) {}

  /// Called when all coordinates are known to be finite.
  virtual void prepare() = 0;
  /// Of a polygon that uses no vertex twice.
  virtual void check_corners(std::size_t f) = 0;
  virtual std::string place_text(int v) const = 0;
  /// Whether vertex `a` comes before `b` in some order of places.
  virtual bool is_before(int a, int b) const = 0;
  /// What is wrong with an edge that several polygons pass in the same direction, `n_back` others in the other one.
  virtual std::string edge_problem(int n, int n_back) const = 0;
  virtual void check_border() {}
  /// Whether different parts may have vertices in one place.
  virtual bool parts_may_touch() const { return false; }

  void problem(std::size_t& count, const std::string& sentence)
  {
    if (count++ == 0)
      m_result.problems.push_back(sentence);
  }

  std::string vertex_text(int v) const { return "vertex " + std::to_string(v) + " at " + place_text(v); }
  static std::string polygon_text(std::size_t f) { return "polygon " + std::to_string(f); }

  const Labelled_mesh& m_mesh;
  Mesh_validity m_result;
  std::vector<Numbered_segment> m_border; ///< edges of one polygon only, in its direction

private:
  class Disjoint_sets {
  public:
    explicit Disjoint_sets(std::size_t n = 0) : m_parent(n) { std::iota(m_parent.begin(), m_parent.end(), 0); }

    /// Whether they were apart.
    bool join(int a, int b)
    {
      a = root(a);
      b = root(b);
      m_parent[std::size_t(a)] = b;
      return a != b;
    }

    int root(int v)
    {
      while (m_parent[std::size_t(v)] != v)
        v = m_parent[std::size_t(v)] = m_parent[std::size_t(m_parent[std::size_t(v)])];
      return v;
    }

  private:
    std::vector<int> m_parent;
  };

  bool check_coordinates()
  {
    m_is_used.assign(m_mesh.points.size(), 0);
    for (const std::vector<int>& polygon : m_mesh.polygons)
      for (const int v : polygon)
        m_is_used[std::size_t(v)] = 1;
    for (std::size_t v = 0; v < m_mesh.points.size(); ++v) {
      const std::array<double, 3>& p = m_mesh.points[v];
      if (!m_is_used[v]) {
        ++m_result.isolated_vertices;
      } else if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) {
        m_result.problems.push_back("vertex " + std::to_string(v) + " has a coordinate that is not a finite number");
        return false;
      }
    }
    return true;
  }

  void count_edges()
  {
    for (const std::vector<int>& polygon : m_mesh.polygons)
      for (std::size_t i = 0; i < polygon.size(); ++i)
        ++m_uses[{polygon[i], polygon[(i + 1) % polygon.size()]}];
  }

  void check_polygons()
  {
    for (std::size_t f = 0; f < m_mesh.polygons.size(); ++f) {
      const std::vector<int>& polygon = m_mesh.polygons[f];
      if (polygon.size() != 4)
        problem(m_result.non_quads, polygon_text(f) + " has " + std::to_string(polygon.size()) + " corners, not 4");
      if (std::set<int>(polygon.begin(), polygon.end()).size() != polygon.size())
        problem(m_result.degenerate_quads, polygon_text(f) + " uses a vertex twice");
      else
        check_corners(f);
    }
  }

  void check_edges()
  {
    std::size_t n_edges = 0;
    for (const auto& [edge, n] : m_uses) {
      const auto back = m_uses.find({edge.second, edge.first});
      const int n_back = back == m_uses.end() ? 0 : back->second;
      n_edges += n_back == 0 || edge.first < edge.second;
      if (n > 1 && (n_back < 2 || edge.first < edge.second))
        problem(m_result.non_manifold_edges, "the edge from " + vertex_text(edge.first) + " to " +
                                                 vertex_text(edge.second) + " " + edge_problem(n, n_back));
      else if (n == 1 && n_back == 0)
        m_border.push_back({{edge.first, edge.second}});
    }
    m_result.euler_characteristic =
        int(std::count(m_is_used.begin(), m_is_used.end(), 1)) - int(n_edges) + int(m_mesh.polygons.size());
  }

  void check_duplicates()
  {
    std::vector<int> order;
    for (std::size_t v = 0; v < m_is_used.size(); ++v)
      if (m_is_used[v])
        order.push_back(int(v));
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return is_before(a, b); });
    for (std::size_t i = 1; i < order.size(); ++i)
      for (std::size_t j = i; j > 0 && !is_before(order[j - 1], order[i]); --j)
        if (should_be_one(order[j - 1], order[i])) {
          problem(m_result.duplicate_vertices, vertex_text(order[i]) + " has the coordinates of vertex " +
                                                   std::to_string(order[j - 1]) +
                                                   ": the quads there are not connected");
          break;
        }
  }

  /// Of two vertices in one place. Closed parts of an assembly touch, and do not belong together for that.
  bool should_be_one(int a, int b)
  {
    return !parts_may_touch() || m_parts.root(a) == m_parts.root(b) ||
           (m_is_on_border[std::size_t(a)] && m_is_on_border[std::size_t(b)]);
  }

  /// Corners at a vertex belong to one fan if edges that leave it connect them. Border edges alone would not tell: a
  /// closed surface may touch itself in a vertex, too.
  void check_fans()
  {
    struct Corner_side {
      int vertex, neighbour, corner;
    };
    std::vector<Corner_side> sides;
    std::vector<int> n_fans(m_is_used.size(), 0); // corners that are not yet joined to others
    int n_corners = 0;
    for (const std::vector<int>& polygon : m_mesh.polygons)
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        sides.push_back({polygon[i], polygon[(i + 1) % polygon.size()], n_corners});
        sides.push_back({polygon[i], polygon[(i + polygon.size() - 1) % polygon.size()], n_corners++});
        ++n_fans[std::size_t(polygon[i])];
      }
    std::sort(sides.begin(), sides.end(), [](const Corner_side& a, const Corner_side& b) {
      return std::array{a.vertex, a.neighbour, a.corner} < std::array{b.vertex, b.neighbour, b.corner};
    });
    Disjoint_sets corners(sides.size() / 2);
    for (std::size_t i = 1; i < sides.size(); ++i)
      if (sides[i].vertex == sides[i - 1].vertex && sides[i].neighbour == sides[i - 1].neighbour)
        n_fans[std::size_t(sides[i].vertex)] -= corners.join(sides[i].corner, sides[i - 1].corner);
    for (std::size_t v = 0; v < n_fans.size(); ++v)
      if (n_fans[v] > 1)
        problem(m_result.non_manifold_vertices, "several parts of the mesh touch only in " + vertex_text(int(v)));
  }

  void count_parts()
  {
    Disjoint_sets border_sets(m_is_used.size());
    m_parts = Disjoint_sets(m_is_used.size());
    m_result.components = int(std::count(m_is_used.begin(), m_is_used.end(), 1));
    for (const std::vector<int>& polygon : m_mesh.polygons)
      for (std::size_t i = 1; i < polygon.size(); ++i)
        m_result.components -= m_parts.join(polygon[0], polygon[i]);
    m_is_on_border.assign(m_is_used.size(), 0);
    for (const Numbered_segment& s : m_border)
      m_is_on_border[std::size_t(s.ends[0])] = m_is_on_border[std::size_t(s.ends[1])] = 1;
    m_result.boundary_loops = int(std::count(m_is_on_border.begin(), m_is_on_border.end(), 1));
    for (const Numbered_segment& s : m_border)
      m_result.boundary_loops -= border_sets.join(s.ends[0], s.ends[1]);
  }

  std::vector<char> m_is_used;
  Disjoint_sets m_parts;
  std::vector<char> m_is_on_border;
  std::map<std::pair<int, int>, int> m_uses; ///< of directed edges
};

} // namespace internal
} // namespace Quadrille

#endif
