// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Quad_extraction/internal/extract_indexed_quads_impl.h>

namespace Quadrille::internal::extraction {

template Indexed_quads<2> extract_indexed_quads<2>(const Seamless_map&, const std::vector<Eigen::Vector2d>&,
                                                   const Quad_extraction_options&, const Layout_quantizer&,
                                                   const Curve_projection<2>&, Quad_extraction_result&);
template Indexed_quads<3> extract_indexed_quads<3>(const Seamless_map&, const std::vector<Eigen::Vector3d>&,
                                                   const Quad_extraction_options&, const Layout_quantizer&,
                                                   const Curve_projection<3>&, Quad_extraction_result&);

} // namespace Quadrille::internal::extraction
