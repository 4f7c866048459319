// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_ESTIMATE_QUADS_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_ESTIMATE_QUADS_IMPL_H

#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/estimate_quads.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Carries the sizes on curves to all vertices: the harmonic extension of their logarithms, which is what an isotropic
/// field without singularities has.
class Size_spreader {
public:
  Size_spreader(const Planar_domain& domain, const Domain_sizes& sizes)
      : m_mesh(domain.mesh), m_log_area(m_mesh.number_of_vertices(), 0), m_n_sizes(m_mesh.number_of_vertices(), 0)
  {
    for (const auto e : m_mesh.edges())
      for (const std::size_t end : {0u, 1u}) {
        const auto h = m_mesh.halfedge(e);
        add_size(end == 0 ? m_mesh.source(h) : m_mesh.target(h), sizes.of_edge[e.idx()][end]);
      }
    // Where curves with different sizes meet, the mean counts.
    for (std::size_t v = 0; v < m_log_area.size(); ++v)
      m_log_area[v] /= std::max(1, m_n_sizes[v]);
    spread();
  }

  bool has_sizes() const
  {
    return std::any_of(m_n_sizes.begin(), m_n_sizes.end(), [](int n) { return n > 0; });
  }
  /// Of an element at vertex `v`. \pre `has_sizes()`
  double element_area(Planar_domain::vertex_descriptor v) const { return std::exp(m_log_area[v.idx()]); }

private:
  void add_size(Planar_domain::vertex_descriptor v, const Frame_size& size)
  {
    if (size.is_free())
      return;
    const double normal = size.normal > 0 ? size.normal : size.tangential;
    const double tangential = size.tangential > 0 ? size.tangential : size.normal;
    m_log_area[v.idx()] += std::log(normal) + std::log(tangential);
    ++m_n_sizes[v.idx()];
  }

  void spread()
  {
    std::vector<int> unknown(m_log_area.size(), -1);
    int n = 0;
    for (std::size_t v = 0; v < m_log_area.size(); ++v)
      if (m_n_sizes[v] == 0)
        unknown[v] = n++;
    if (n == 0 || !has_sizes())
      return;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(n);
    for (const auto e : m_mesh.edges()) {
      const std::size_t a = m_mesh.vertex(e, 0).idx(), b = m_mesh.vertex(e, 1).idx();
      const double weight = edge_weight(e);
      for (const auto& [v, w] : {std::pair(a, b), std::pair(b, a)}) {
        if (unknown[v] < 0)
          continue;
        entries.emplace_back(unknown[v], unknown[v], weight);
        if (unknown[w] >= 0)
          entries.emplace_back(unknown[v], unknown[w], -weight);
        else
          load[unknown[v]] += weight * m_log_area[w];
      }
    }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    // An estimate needs no more digits.
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(matrix);
    solver.setTolerance(1e-4);
    const Eigen::VectorXd solution = solver.solve(load);
    for (std::size_t v = 0; v < unknown.size(); ++v)
      if (unknown[v] >= 0)
        m_log_area[v] = solution[unknown[v]];
  }

  /// Half the cotangents of the angles opposite to the edge; positive, so that no extension leaves the range of the
  /// sizes on the curves, also where triangles are not Delaunay.
  double edge_weight(Planar_domain::edge_descriptor e) const
  {
    double sum = 0;
    for (const auto h : {m_mesh.halfedge(e), m_mesh.opposite(m_mesh.halfedge(e))}) {
      if (m_mesh.is_border(h))
        continue;
      const auto& apex = m_mesh.point(m_mesh.target(m_mesh.next(h)));
      const auto u = m_mesh.point(m_mesh.source(h)) - apex, v = m_mesh.point(m_mesh.target(h)) - apex;
      sum += 0.5 * (u * v) / (u.x() * v.y() - u.y() * v.x());
    }
    return std::max(sum, 1e-3);
  }

  const Planar_domain::Mesh& m_mesh;
  std::vector<double> m_log_area; ///< of elements, by vertex
  std::vector<int> m_n_sizes;     ///< given there
};

} // namespace internal

QUADRILLE_INLINE double estimate_number_of_quads(const Planar_domain& domain, const Domain_sizes& sizes)
{
  const internal::Size_spreader spreader(domain, sizes);
  if (!spreader.has_sizes())
    return 0;
  double n = 0;
  for (const auto f : domain.mesh.faces()) {
    const auto h = domain.mesh.halfedge(f);
    const auto a = domain.mesh.source(h), b = domain.mesh.target(h), c = domain.mesh.target(domain.mesh.next(h));
    const double area = CGAL::area(domain.mesh.point(a), domain.mesh.point(b), domain.mesh.point(c));
    for (const auto v : {a, b, c})
      n += area / 3 / spreader.element_area(v);
  }
  return n;
}

} // namespace Quadrille

#endif
