// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_SINGULAR_GRAPH_BUILDER_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_SINGULAR_GRAPH_BUILDER_H

#include <Quadrille/Singular_graph.h>
#include <Quadrille/Volumetric_cross_field/internal/build_singular_graph.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Makes the graph of raw paths: joins nodes that the mesh does not resolve, smooths the curves, tells their valences,
/// and says what stands against a hexahedral mesh.
class Singular_graph_builder {
public:
  Singular_graph_builder(const Singular_face_paths& raw, const Singular_graph_options& options)
      : m_paths(raw.paths), m_points(raw.nodes), m_options(options)
  {
  }

  Singular_graph build()
  {
    join_nodes();
    join_paths();
    make_graph();
    smooth();
    for (Singular_graph::Arc& arc : m_graph.arcs)
      finish(arc);
    find_obstacles();
    return std::move(m_graph);
  }

private:
  using Path = Singular_face_paths::Path;
  using Passage = Singular_face_paths::Passage;
  using Kind = Octahedral_rotation::Kind;
  using Arc = Singular_graph::Arc;
  using Valence = Singular_graph::Valence;
  static constexpr int at_boundary = Singular_graph::at_boundary;

  int leader(int node) const
  {
    while (m_leader[std::size_t(node)] != node)
      node = m_leader[std::size_t(node)];
    return node;
  }

  /// Contracts what is shorter than the mesh resolves.
  void join_nodes()
  {
    m_leader.resize(m_points.size());
    for (std::size_t i = 0; i < m_leader.size(); ++i)
      m_leader[i] = int(i);
    std::vector<Path> kept;
    for (Path& path : m_paths) {
      const bool has_start = path.from != at_boundary, has_end = path.to != at_boundary;
      if (has_start != has_end || !is_unresolved(path)) {
        kept.push_back(std::move(path));
      } else if (has_start) {
        const int a = leader(path.from), b = leader(path.to);
        m_leader[std::size_t(std::max(a, b))] = std::min(a, b);
      } else if (is_across(path)) {
        ++m_graph.unresolved_arcs;
      } else {
        kept.push_back(std::move(path));
      }
    }
    m_paths.swap(kept);
    std::vector<Eigen::Vector3d> sums(m_points.size(), Eigen::Vector3d::Zero());
    std::vector<double> counts(m_points.size(), 0);
    for (std::size_t i = 0; i < m_points.size(); ++i) {
      sums[std::size_t(leader(int(i)))] += m_points[i];
      ++counts[std::size_t(leader(int(i)))];
    }
    for (std::size_t i = 0; i < m_points.size(); ++i)
      m_points[i] = sums[i] / std::max(counts[i], 1.0);
    for (Path& path : m_paths) {
      if (path.from != at_boundary)
        path.from = leader(path.from);
      if (path.to != at_boundary)
        path.to = leader(path.to);
    }
  }

  bool is_unresolved(const Path& path) const
  {
    // Not its length, since it zigzags through the tetrahedra.
    const Eigen::Vector3d from =
        path.from != at_boundary ? m_points[std::size_t(path.from)] : path.passages.front().point;
    double extent = path.to != at_boundary ? (m_points[std::size_t(path.to)] - from).norm() : 0;
    for (const Passage& passage : path.passages)
      extent = std::max(extent, (passage.point - from).norm());
    const double factor = path.kind == Kind::quarter_turn ? 1 : 3;
    return path.tetrahedra.empty() || extent < factor * m_options.resolution * path.edge_length;
  }

  /// Whether the axis lies across a short path: no singular curve, but frames on the boundary that are not resolved. A
  /// plate of a single layer of tetrahedra has short paths too, but along their axis.
  static bool is_across(const Path& path)
  {
    if (path.is_loop)
      return true;
    const Eigen::Vector3d chord = path.passages.back().point - path.passages.front().point;
    double sum = 0, length = 0;
    for (const Passage& passage : path.passages) {
      sum += passage.axis.dot(passage.root * chord);
      length += (passage.root * chord).norm();
    }
    return !(std::abs(sum) > 0.5 * length);
  }

  std::vector<std::vector<std::size_t>> ends_at_nodes() const
  {
    std::vector<std::vector<std::size_t>> ends(m_points.size());
    for (std::size_t p = 0; p < m_paths.size(); ++p) {
      if (m_paths[p].is_loop)
        continue;
      for (const int node : {m_paths[p].from, m_paths[p].to})
        if (node != at_boundary)
          ends[std::size_t(node)].push_back(p);
    }
    return ends;
  }

  static void reverse(Path& path)
  {
    std::swap(path.from, path.to);
    std::reverse(path.passages.begin(), path.passages.end());
    std::reverse(path.tetrahedra.begin(), path.tetrahedra.end());
    for (Passage& passage : path.passages)
      passage.axis = -passage.axis;
  }

  /// Where only two ends of paths are left at a node, they go on in each other.
  void join_paths()
  {
    for (std::size_t node = 0; node < m_points.size(); ++node) {
      const std::vector<std::size_t> ends = ends_at_nodes()[node];
      if (ends.size() != 2)
        continue;
      Path& first = m_paths[ends[0]];
      if (ends[0] == ends[1]) {
        first.is_loop = true;
        continue;
      }
      Path second = std::move(m_paths[ends[1]]);
      if (first.to != int(node))
        reverse(first);
      if (second.from != int(node))
        reverse(second);
      const double weights[] = {double(first.tetrahedra.size()), double(second.tetrahedra.size())};
      first.edge_length =
          (weights[0] * first.edge_length + weights[1] * second.edge_length) / std::max(weights[0] + weights[1], 1.0);
      first.passages.insert(first.passages.end(), second.passages.begin(), second.passages.end());
      first.tetrahedra.insert(first.tetrahedra.end(), second.tetrahedra.begin(), second.tetrahedra.end());
      first.to = second.to;
      m_paths.erase(m_paths.begin() + std::ptrdiff_t(ends[1]));
    }
  }

  void make_graph()
  {
    const std::vector<std::vector<std::size_t>> ends = ends_at_nodes();
    std::vector<int> number(m_points.size(), at_boundary);
    for (std::size_t node = 0; node < m_points.size(); ++node)
      if (ends[node].size() > 2 || ends[node].size() == 1) {
        number[node] = int(m_graph.nodes.size());
        Singular_graph::Node result{m_points[node], {}};
        for (const std::size_t path : ends[node])
          result.arcs.push_back(int(path));
        m_graph.nodes.push_back(std::move(result));
      }
    for (const Path& path : m_paths) {
      Arc arc;
      arc.is_loop = path.is_loop;
      arc.tetrahedra = path.tetrahedra;
      if (!path.is_loop) {
        arc.from = path.from == at_boundary ? at_boundary : number[std::size_t(path.from)];
        arc.to = path.to == at_boundary ? at_boundary : number[std::size_t(path.to)];
        m_graph.boundary_ends += std::size_t(arc.from == at_boundary) + std::size_t(arc.to == at_boundary);
      } else {
        ++m_graph.loops;
      }
      if (arc.from != at_boundary)
        arc.points.push_back(m_graph.nodes[std::size_t(arc.from)].point);
      for (const Passage& passage : path.passages)
        arc.points.push_back(passage.point);
      if (arc.to != at_boundary)
        arc.points.push_back(m_graph.nodes[std::size_t(arc.to)].point);
      m_graph.arcs.push_back(std::move(arc));
    }
  }

  void smooth()
  {
    for (int step = 0; step < m_options.smoothing_steps; ++step) {
      for (Arc& arc : m_graph.arcs) {
        const std::vector<Eigen::Vector3d> before = arc.points;
        const std::size_t n = before.size();
        for (std::size_t i = 0; i < n; ++i)
          if (arc.is_loop || (i > 0 && i + 1 < n))
            arc.points[i] = 0.5 * before[i] + 0.25 * (before[(i + n - 1) % n] + before[(i + 1) % n]);
      }
      for (std::size_t k = 0; k < m_graph.nodes.size(); ++k)
        smooth_node(int(k));
    }
  }

  void smooth_node(int k)
  {
    Singular_graph::Node& node = m_graph.nodes[std::size_t(k)];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0;
    const std::set<int> arcs(node.arcs.begin(), node.arcs.end());
    for (const int a : arcs) {
      const Arc& arc = m_graph.arcs[std::size_t(a)];
      if (arc.points.size() < 2)
        continue;
      if (arc.from == k) {
        sum += arc.points[1];
        ++count;
      }
      if (arc.to == k) {
        sum += arc.points[arc.points.size() - 2];
        ++count;
      }
    }
    if (count == 0)
      return;
    node.point = 0.5 * node.point + 0.5 * sum / count;
    for (const int a : arcs) {
      Arc& arc = m_graph.arcs[std::size_t(a)];
      if (arc.from == k)
        arc.points.front() = node.point;
      if (arc.to == k)
        arc.points.back() = node.point;
    }
  }

  /// Length, alignment and valence of a smoothed arc.
  void finish(Arc& arc) const
  {
    const Path& path = m_paths[std::size_t(&arc - m_graph.arcs.data())];
    const std::size_t n = arc.points.size();
    for (std::size_t i = 0; i + 1 < n; ++i)
      arc.length += (arc.points[i + 1] - arc.points[i]).norm();
    if (arc.is_loop)
      arc.length += (arc.points.front() - arc.points.back()).norm();
    arc.alignment.assign(n, 0);
    const bool has_axis = path.kind == Kind::quarter_turn || path.kind == Kind::half_turn;
    const std::size_t skipped = arc.from != at_boundary ? 1 : 0;
    for (std::size_t i = 0; i < path.passages.size() && has_axis; ++i) {
      const std::size_t at = i + skipped;
      const std::size_t before = at > 0 ? at - 1 : (arc.is_loop ? n - 1 : at);
      const std::size_t after = at + 1 < n ? at + 1 : (arc.is_loop ? 0 : at);
      const Eigen::Vector3d tangent = path.passages[i].root * (arc.points[after] - arc.points[before]);
      if (tangent.norm() > 0)
        arc.alignment[at] = path.passages[i].axis.dot(tangent.normalized());
    }
    if (n > 2 && arc.from != at_boundary)
      arc.alignment.front() = arc.alignment[1];
    if (n > 2 && arc.to != at_boundary)
      arc.alignment.back() = arc.alignment[n - 2];
    arc.valence = valence_of(path, arc);
  }

  /// By the sense in which the axis goes along the curve.
  static Valence valence_of(const Path& path, const Arc& arc)
  {
    if (path.kind == Kind::third_turn || path.kind == Kind::diagonal_half_turn)
      return Valence::compound;
    double sum = 0;
    const auto for_each_segment = [&](const auto& function) {
      const std::size_t n = arc.points.size();
      for (std::size_t i = 0; i + 1 < n + (arc.is_loop ? 1 : 0); ++i) {
        const std::size_t next = (i + 1) % n;
        function((arc.points[next] - arc.points[i]).norm(), 0.5 * (arc.alignment[i] + arc.alignment[next]));
      }
    };
    for_each_segment([&](double length, double alignment) { sum += length * alignment; });
    // Where the frames' axis lies across the curve, or beyond, the valence is not the one that it is elsewhere. That
    // stretch is often short: such arcs bend where they come close to the boundary.
    constexpr double across = 0.2;
    double other = 0;
    for_each_segment(
        [&](double length, double alignment) { other += (sum < 0 ? -alignment : alignment) < across ? length : 0; });
    if (!path.tetrahedra.empty() && other > 0.25 * path.edge_length && arc.length > 2 * path.edge_length)
      return Valence::mixed;
    if (path.kind == Kind::half_turn)
      return sum < 0 ? Valence::two : Valence::six;
    return sum < 0 ? Valence::three : Valence::five;
  }

  void find_obstacles()
  {
    for (std::size_t a = 0; a < m_graph.arcs.size(); ++a) {
      const Valence valence = m_graph.arcs[a].valence;
      if (valence == Valence::mixed)
        m_graph.obstacles.push_back({int(a), -1, "the valence changes between 3 and 5 along the arc"});
      if (valence == Valence::compound)
        m_graph.obstacles.push_back({int(a), -1, "the frames turn about no axis of theirs around the arc"});
      if (valence == Valence::two)
        m_graph.obstacles.push_back({int(a), -1, "the arc has valence 2"});
    }
    for (std::size_t k = 0; k < m_graph.nodes.size(); ++k)
      if (!is_possible(m_graph.nodes[k]))
        m_graph.obstacles.push_back({-1, int(k), "no arrangement of hexahedra has a vertex with such arcs"});
  }

  /// The hexahedra at an inner vertex are a triangulation of a sphere with a vertex for each edge: with numbers of
  /// edges of valence 3, 4 and 5 for which 3 n3 + 2 n4 + n5 = 12 and that exist. Those with valence up to 5 are all
  /// known.
  bool is_possible(const Singular_graph::Node& node) const
  {
    std::array<int, 2> numbers = {0, 0}; // of valence 3 and 5
    for (const int a : node.arcs) {
      const Valence valence = m_graph.arcs[std::size_t(a)].valence;
      if (valence != Valence::three && valence != Valence::five)
        return true; // reported with the arc, or beyond the list
      ++numbers[valence == Valence::three ? 0 : 1];
    }
    static const std::set<std::array<int, 2>> possible = {{4, 0}, {2, 2}, {1, 3}, {2, 6},
                                                          {0, 4}, {0, 6}, {0, 8}, {0, 12}};
    return possible.count(numbers) != 0;
  }

  std::vector<Path> m_paths;
  std::vector<Eigen::Vector3d> m_points; ///< of the raw nodes, then of their leaders
  std::vector<int> m_leader;
  Singular_graph_options m_options;
  Singular_graph m_graph;
};

QUADRILLE_INLINE Singular_graph build_singular_graph(const Singular_face_paths& paths,
                                                     const Singular_graph_options& options)
{
  return Singular_graph_builder(paths, options).build();
}

} // namespace internal
} // namespace Quadrille

#endif
