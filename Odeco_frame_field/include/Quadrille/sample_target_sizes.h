// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SAMPLE_TARGET_SIZES_H
#define QUADRILLE_SAMPLE_TARGET_SIZES_H

#include <boost/graph/graph_traits.hpp>
#include <boost/range/iterator_range.hpp>

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

} // namespace Quadrille

#endif
