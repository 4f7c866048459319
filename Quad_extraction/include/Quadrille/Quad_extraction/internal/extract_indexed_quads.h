// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_EXTRACT_INDEXED_QUADS_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_EXTRACT_INDEXED_QUADS_H

#include <Quadrille/Length_constraints.h>
#include <Quadrille/Quad_extraction/internal/Indexed_quads.h>
#include <Quadrille/Quad_extraction/internal/Seamless_map.h>
#include <Quadrille/Quad_extraction_options.h>

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Models of `Quantizer` and `CurveProjector`.
using Layout_quantizer = std::function<Quantization(const Quad_layout&, Length_constraints&)>;
template <int D>
using Curve_projection = std::function<Eigen::Matrix<double, D, 1>(int curve, const Eigen::Matrix<double, D, 1>&)>;

/// From index arrays to a quad mesh as index arrays; `extract_quads` without CGAL. For D = 2 and 3.
template <int D>
Indexed_quads<D> extract_indexed_quads(const Seamless_map& map, const std::vector<Eigen::Matrix<double, D, 1>>& points,
                                       const Quad_extraction_options& options, const Layout_quantizer& quantizer,
                                       const Curve_projection<D>& project, Quad_extraction_result& result);

} // namespace internal::extraction
} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Quad_extraction/internal/extract_indexed_quads_impl.h>
#endif

#endif
