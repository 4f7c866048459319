// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUANTIZE_LAYOUT_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUANTIZE_LAYOUT_H

#include <Quadrille/Length_constraints.h>
#include <Quadrille/Optimal_quantizer.h>
#include <Quadrille/Quad_extraction/internal/Length_deviation.h>
#include <Quadrille/Quad_extraction_options.h>
#include <Quadrille/Quad_layout.h>
#include <Quadrille/Quantization.h>
#include <Quadrille/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// The sum of the patches' areas, by a function of the arcs.
template <class Length> double area_of_patches(const Quad_layout& layout, const Length& length_of_arc)
{
  double sum = 0;
  for (const Quad_layout::Patch& patch : layout.patches) {
    std::array<double, 2> length = {0, 0};
    for (std::size_t side = 0; side < 2; ++side)
      for (const int h : patch.sides[side])
        length[side] += length_of_arc(h / 2);
    sum += length[0] * length[1];
  }
  return sum;
}

inline double map_area(const Quad_layout& layout)
{
  return area_of_patches(layout, [&](int a) { return at(layout.arcs, a).length; });
}

inline double number_of_quads(const Quad_layout& layout, const std::vector<int>& lengths)
{
  return area_of_patches(layout, [&](int a) { return double(at(lengths, a)); });
}

/// Makes the lengths of a layout integer, after scaling them for a wanted number of quads.
class Layout_quantization {
public:
  /// \param constraints learn from every answer of `quantizer`
  Layout_quantization(const Quad_layout& layout, const Layout_quantizer& quantizer,
                      const Quad_extraction_options& options, Length_constraints& constraints)
      : m_layout(layout), m_quantizer(quantizer), m_options(options), m_constraints(constraints), m_scaled(layout)
  {
    if (options.quads > 0)
      m_scale = std::sqrt(double(options.quads) / map_area(layout));
  }

  /// With the constraints of now, which may have grown since the last time.
  /// \throws No_result_error if an answer of the quantizer breaks the constraints, or there are too many quads.
  Quantization run()
  {
    Quantization result = m_options.quads > 0 ? best_for_number() : answer(1);
    const Length_deviation deviation(m_scaled);
    result.cost = deviation.cost(result.lengths);
    result.deviation = deviation.relative(result.cost);
    if (m_options.measure_gap && !std::isfinite(result.lower_bound))
      result.lower_bound = quantization_bound(m_scaled, m_constraints);
    if (std::isfinite(result.lower_bound))
      result.optimality_gap = result.cost > 0 ? std::max(0.0, result.cost - result.lower_bound) / result.cost : 0;
    const double n = number_of_quads(m_layout, result.lengths);
    if (n > double(m_options.max_quads))
      throw No_result_error("quantization", "the mesh would have " + std::to_string(n) +
                                                " quads; ask for larger elements or raise max_quads");
    return result;
  }

  /// What the lengths were multiplied by in the last run.
  double scale() const { return m_scale; }
  /// The layout with these lengths.
  const Quad_layout& scaled() const { return m_scaled; }

private:
  void set_scale(double scale)
  {
    m_scale = scale;
    for (std::size_t a = 0; a < m_layout.arcs.size(); ++a)
      m_scaled.arcs[a].length = scale * m_layout.arcs[a].length;
    for (std::size_t s = 0; s < m_layout.strips.size(); ++s)
      m_scaled.strips[s].length = scale * m_layout.strips[s].length;
  }

  Quantization answer(double scale)
  {
    set_scale(scale);
    Quantization result = m_quantizer(m_scaled, m_constraints);
    if (!m_constraints.learn(result.lengths))
      throw No_result_error("quantization", "the lengths of the " + result.method +
                                                " quantizer would merge what must stay apart, miss a requested count, "
                                                "or differ on opposite sides of a patch");
    return result;
  }

  /// Numbers grow with the scale, but not evenly, since small lengths stay what they are.
  Quantization best_for_number()
  {
    constexpr int max_trials = 8;
    constexpr double tolerance = 0.02;
    const double wanted = double(m_options.quads);
    double too_few = 0, too_many = std::numeric_limits<double>::infinity(); // scales
    double scale = m_scale, best_scale = 0, least_error = std::numeric_limits<double>::infinity(), work = 0;
    Quantization best;
    for (int trial = 0; trial < max_trials; ++trial) {
      Quantization candidate = answer(scale);
      work += candidate.work;
      const double ratio = number_of_quads(m_layout, candidate.lengths) / wanted;
      if (std::abs(std::log(ratio)) < least_error) {
        least_error = std::abs(std::log(ratio));
        best_scale = scale;
        best = std::move(candidate);
      }
      if (least_error <= tolerance)
        break;
      (ratio < 1 ? too_few : too_many) = scale;
      scale /= std::sqrt(ratio);
      if (!(scale > too_few && scale < too_many))
        scale = std::isfinite(too_many) ? (too_few + too_many) / 2 : 2 * too_few;
    }
    set_scale(best_scale);
    best.work = work;
    return best;
  }

  const Quad_layout& m_layout;
  const Layout_quantizer& m_quantizer;
  const Quad_extraction_options& m_options;
  Length_constraints& m_constraints;
  Quad_layout m_scaled;
  double m_scale = 1;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
