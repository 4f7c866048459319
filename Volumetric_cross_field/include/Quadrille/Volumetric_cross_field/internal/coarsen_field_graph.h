// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_COARSEN_FIELD_GRAPH_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_INTERNAL_COARSEN_FIELD_GRAPH_H

#include <Quadrille/Volumetric_cross_field/internal/Field_graph.h>
#include <Quadrille/Volumetric_cross_field/internal/connection_form.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// A graph of aggregates of a finer one.
struct Coarse_field_graph {
  Field_graph graph;
  std::vector<int> aggregate_of;        ///< per fine vertex
  std::vector<Eigen::Matrix3d> to_fine; ///< carries frames from the aggregate to the fine vertex; empty: the identity
};

/// Aggregates vertices with their neighbours, so that about one in fifteen remains (a spacing 2.5 times as large). Only
/// vertices with alignments of the same kind, and nearly the same, share an aggregate; so the coarse graph poses a
/// problem of the same form. An aggregate's cross stands for those of all its vertices: the coarse energy is too large
/// by some factor, about the same everywhere, which does not move its minima.
class Field_graph_coarsener {
public:
  explicit Field_graph_coarsener(const Field_graph& fine) : m_fine(fine) {}

  Coarse_field_graph coarsen()
  {
    const std::size_t n = m_fine.number_of_vertices();
    m_coarse.aggregate_of.assign(n, none);
    if (has_turns())
      m_coarse.to_fine.assign(n, Eigen::Matrix3d::Identity());
    for (std::size_t v = 0; v < n; ++v)
      if (is_clear(v))
        found(v);
    join_neighbours();
    for (std::size_t v = 0; v < n; ++v)
      if (m_coarse.aggregate_of[v] == none)
        found(v);
    add_alignments();
    add_edges();
    return std::move(m_coarse);
  }

private:
  static constexpr int none = -1;

  bool has_turns() const { return !m_fine.turn.empty(); }

  /// Whether vertex v may share a cross with its neighbour across edge e.
  bool are_alike(std::size_t v, std::size_t e) const
  {
    const Cross_alignment *a = m_fine.alignment(v), *b = m_fine.alignment(std::size_t(m_fine.edges[e].neighbour));
    if (!a || !b)
      return !a && !b;
    if (a->is_fixed != b->is_fixed)
      return false;
    const Eigen::Matrix3d frame = has_turns() ? m_fine.turn[e] * b->crosses.frame : b->crosses.frame;
    if (a->is_fixed)
      return product_of_crosses(a->crosses.frame.transpose() * frame) > 0.9; // 10 degrees
    return std::abs(a->crosses.frame.col(2).dot(frame.col(2))) > 0.94;       // 20 degrees
  }

  bool is_clear(std::size_t v) const
  {
    if (m_coarse.aggregate_of[v] != none)
      return false;
    for (std::size_t e = m_fine.first[v]; e < m_fine.first[v + 1]; ++e)
      if (m_coarse.aggregate_of[std::size_t(m_fine.edges[e].neighbour)] != none && are_alike(v, e))
        return false;
    return true;
  }

  void found(std::size_t v)
  {
    const int aggregate = int(m_seeds.size());
    m_seeds.push_back(v);
    m_coarse.aggregate_of[v] = aggregate;
    for (std::size_t e = m_fine.first[v]; e < m_fine.first[v + 1]; ++e) {
      const std::size_t u = std::size_t(m_fine.edges[e].neighbour);
      if (m_coarse.aggregate_of[u] == none && m_fine.edges[e].weight > 0 && are_alike(v, e)) {
        m_coarse.aggregate_of[u] = aggregate;
        if (has_turns())
          m_coarse.to_fine[u] = m_fine.turn[e].transpose();
      }
    }
  }

  /// What is left over joins the aggregate of the neighbour that it is tied to most.
  void join_neighbours()
  {
    std::vector<int> joined = m_coarse.aggregate_of;
    for (std::size_t v = 0; v < joined.size(); ++v) {
      if (joined[v] != none)
        continue;
      float strongest = 0;
      for (std::size_t e = m_fine.first[v]; e < m_fine.first[v + 1]; ++e) {
        const std::size_t u = std::size_t(m_fine.edges[e].neighbour);
        if (m_coarse.aggregate_of[u] == none || !(m_fine.edges[e].weight > strongest) || !are_alike(v, e))
          continue;
        strongest = m_fine.edges[e].weight;
        joined[v] = m_coarse.aggregate_of[u];
        if (has_turns())
          m_coarse.to_fine[v] = m_fine.turn[e] * m_coarse.to_fine[u];
      }
    }
    m_coarse.aggregate_of.swap(joined);
  }

  void add_alignments()
  {
    Field_graph& graph = m_coarse.graph;
    graph.mass.assign(m_seeds.size(), 0);
    std::vector<Eigen::Vector3d> axes(m_seeds.size(), Eigen::Vector3d::Zero());
    for (std::size_t v = 0; v < m_fine.number_of_vertices(); ++v) {
      const std::size_t aggregate = std::size_t(m_coarse.aggregate_of[v]);
      graph.mass[aggregate] += m_fine.mass[v];
      const Cross_alignment* alignment = m_fine.alignment(v);
      if (!alignment || alignment->is_fixed)
        continue;
      Eigen::Vector3d axis = alignment->crosses.frame.col(2);
      if (has_turns())
        axis = (m_coarse.to_fine[v].transpose() * axis).eval();
      const Cross_alignment* of_seed = m_fine.alignment(m_seeds[aggregate]);
      axes[aggregate] += axis.dot(of_seed->crosses.frame.col(2)) < 0 ? Eigen::Vector3d(-axis) : axis;
    }
    graph.alignment_of.assign(m_seeds.size(), Field_graph::is_free);
    for (std::size_t a = 0; a < m_seeds.size(); ++a) {
      const Cross_alignment* of_seed = m_fine.alignment(m_seeds[a]);
      if (!of_seed)
        continue;
      graph.alignment_of[a] = int(graph.alignments.size());
      graph.alignments.push_back(of_seed->is_fixed ? *of_seed : Cross_alignment::with_axis(axes[a].normalized()));
    }
  }

  /// What the fine edges between two aggregates add up to.
  struct Bundle {
    double weight = 0, absolute_weight = 0;
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    bool is_met = false;
  };

  void add_edges()
  {
    Field_graph& graph = m_coarse.graph;
    const std::size_t n = m_seeds.size();
    std::vector<std::size_t> first(n + 1, 0), members(m_coarse.aggregate_of.size());
    for (const int aggregate : m_coarse.aggregate_of)
      ++first[std::size_t(aggregate) + 1];
    for (std::size_t a = 0; a < n; ++a)
      first[a + 1] += first[a];
    std::vector<std::size_t> end(first.begin(), first.end() - 1);
    for (std::size_t v = 0; v < members.size(); ++v)
      members[end[std::size_t(m_coarse.aggregate_of[v])]++] = v;
    graph.first.assign(1, 0);
    std::vector<double> weights;
    std::vector<Bundle> bundles(n);
    std::vector<int> met;
    for (std::size_t a = 0; a < n; ++a) {
      met.clear();
      for (std::size_t m = first[a]; m < first[a + 1]; ++m)
        for (std::size_t e = m_fine.first[members[m]]; e < m_fine.first[members[m] + 1]; ++e)
          collect(members[m], e, bundles, met);
      std::sort(met.begin(), met.end());
      for (const int other : met) {
        Bundle& bundle = bundles[std::size_t(other)];
        graph.edges.push_back({other, 0});
        weights.push_back(bundle.weight);
        if (has_turns())
          graph.turn.push_back(rotation_of(bundle.turn / bundle.absolute_weight));
        bundle = Bundle();
      }
      graph.first.push_back(graph.edges.size());
    }
    graph.energy_unit = m_fine.energy_unit;
    graph.set_weights(weights, 1);
    graph.set_transport(1);
  }

  void collect(std::size_t v, std::size_t e, std::vector<Bundle>& bundles, std::vector<int>& met) const
  {
    const std::size_t u = std::size_t(m_fine.edges[e].neighbour);
    const int other = m_coarse.aggregate_of[u];
    if (other == m_coarse.aggregate_of[v])
      return;
    Bundle& bundle = bundles[std::size_t(other)];
    if (!bundle.is_met)
      met.push_back(other);
    bundle.is_met = true;
    const double weight = double(m_fine.edges[e].weight);
    bundle.weight += weight;
    bundle.absolute_weight += std::abs(weight);
    if (has_turns())
      bundle.turn +=
          std::abs(weight) * rotation_vector_of(m_coarse.to_fine[v].transpose() * m_fine.turn[e] * m_coarse.to_fine[u]);
  }

  const Field_graph& m_fine;
  Coarse_field_graph m_coarse;
  std::vector<std::size_t> m_seeds; ///< per aggregate
};

} // namespace internal
} // namespace Quadrille

#endif
