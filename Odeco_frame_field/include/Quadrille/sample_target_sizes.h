// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SAMPLE_TARGET_SIZES_H
#define QUADRILLE_SAMPLE_TARGET_SIZES_H

#include <boost/graph/graph_traits.hpp>
#include <boost/range/iterator_range.hpp>

#include <Eigen/Core>

#include <vector>

namespace Quadrille {

/// Element sizes from a function of the position, as `Odeco_field_options::target_size` wants them.
///
/// \tparam TriangleMesh model of CGAL's `VertexListGraph`
/// \tparam VertexPointMap readable property map, `vertex_descriptor` to a point
/// \tparam SizeFunction `double(const Point&)`; 0 where no size is wanted
///
/// Complexity: one call per vertex.
template <class TriangleMesh, class VertexPointMap, class SizeFunction>
std::vector<double> sample_target_sizes(const TriangleMesh& mesh, const VertexPointMap& points,
                                        const SizeFunction& size)
{
  std::vector<double> sizes;
  sizes.reserve(num_vertices(mesh));
  for (const auto v : boost::make_iterator_range(vertices(mesh)))
    sizes.push_back(double(size(get(points, v))));
  return sizes;
}

/// Metrics from a function of the position, as `Odeco_field_options::target_metric` wants them.
///
/// \tparam MetricFunction `Eigen::Matrix2d(const Point&)`; zero where no metric is wanted. The other parameters are as
/// above. Complexity: one call per vertex.
template <class TriangleMesh, class VertexPointMap, class MetricFunction>
std::vector<Eigen::Matrix2d> sample_target_metrics(const TriangleMesh& mesh, const VertexPointMap& points,
                                                   const MetricFunction& metric)
{
  std::vector<Eigen::Matrix2d> metrics;
  metrics.reserve(num_vertices(mesh));
  for (const auto v : boost::make_iterator_range(vertices(mesh)))
    metrics.push_back(metric(get(points, v)));
  return metrics;
}

} // namespace Quadrille

#endif
