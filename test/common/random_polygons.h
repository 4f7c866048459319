// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_COMMON_RANDOM_POLYGONS_H
#define QUADRILLE_TEST_COMMON_RANDOM_POLYGONS_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace Quadrille {
namespace test {

/// A polygon with holes and element sizes at its points: a valid domain for every seed, equal for equal seeds.
///
/// Outlines are convex, star-shaped with spikes, staircases, combs with narrow slots, or spirals; holes come at random
/// places wherever they keep away from everything by 1/500 of the diameter. Everything is stretched by up to 1 : 6,
/// turned, and scaled by 1e-6 to 1e6.
class Random_polygon {
public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_2;
  using Ring = std::vector<Point>;

  explicit Random_polygon(std::uint32_t seed) : m_generator(seed)
  {
    m_rings.push_back(outline());
    add_holes();
    transform();
    choose_sizes();
  }

  const std::vector<Ring>& rings() const { return m_rings; } ///< the outline first
  double size_at(const Point& p) const                       ///< element size, 0 for none
  {
    return m_size == 0 ? 0 : m_size * std::exp(m_slope.x() * p.x() + m_slope.y() * p.y());
  }

  /// As a Gmsh script.
  std::string geo() const
  {
    std::ostringstream text;
    text.precision(17);
    std::string loops;
    int first = 1;
    for (std::size_t r = 0; r < m_rings.size(); ++r) {
      const int n = int(m_rings[r].size());
      for (int i = 0; i < n; ++i) {
        const Point& p = m_rings[r][std::size_t(i)];
        text << "Point(" << first + i << ") = {" << p.x() << ", " << p.y() << ", 0";
        if (m_size > 0)
          text << ", " << size_at(p);
        text << "};\n";
      }
      for (int i = 0; i < n; ++i)
        text << "Line(" << first + i << ") = {" << first + i << ", " << first + (i + 1) % n << "};\n";
      text << "Curve Loop(" << r + 1 << ") = {" << first << " : " << first + n - 1 << "};\n";
      loops += (r > 0 ? ", " : "") + std::to_string(r + 1);
      first += n;
    }
    text << "Plane Surface(1) = {" << loops << "};\n";
    return text.str();
  }

private:
  /// The standard distributions differ between libraries.
  double uniform(double low, double high) { return low + (high - low) * (double(m_generator()) / 4294967296.0); }
  int uniform_int(int low, int high) { return low + int(m_generator() % std::uint32_t(high - low + 1)); }

  Ring outline()
  {
    switch (uniform_int(0, 4)) {
    case 0:
      return star(uniform_int(3, 12), 1);
    case 1:
      return star(uniform_int(5, 16), uniform(0.2, 0.9));
    case 2:
      return staircase(uniform_int(2, 6));
    case 3:
      return comb(uniform_int(2, 5));
    default:
      return spiral(uniform_int(8, 24));
    }
  }

  /// Around the origin, with radii between `least` and 1. Neighbours are at least 0.3 of the mean angle apart.
  Ring star(int n, double least)
  {
    std::vector<double> gaps;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      gaps.push_back(uniform(0.3, 1.7));
      sum += gaps.back();
    }
    Ring ring;
    double angle = uniform(0, 2 * CGAL_PI);
    for (const double gap : gaps) {
      const double radius = least < 1 ? uniform(least, 1) : 1;
      ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
      angle += 2 * CGAL_PI * gap / sum;
    }
    return ring;
  }

  Ring staircase(int steps)
  {
    Ring ring{{0, 0}, {double(steps), 0}};
    double height = 0;
    for (int i = steps; i > 0; --i) {
      double next = uniform(0.4, 2.5);
      if (std::abs(next - height) < 0.05)
        next += 0.2;
      ring.emplace_back(i, next);
      ring.emplace_back(i - 1, next);
      height = next;
    }
    return ring;
  }

  /// Teeth upwards with slots between them, of very different widths.
  Ring comb(int teeth)
  {
    Ring ring{{0, 0}};
    std::vector<double> x{0};
    for (int i = 0; i < 2 * teeth - 1; ++i)
      x.push_back(x.back() + (i % 2 == 0 ? uniform(0.3, 1.0) : std::pow(10, uniform(-1.5, -0.2))));
    ring.emplace_back(x.back(), 0);
    for (std::size_t i = x.size(); i-- > 1;) {
      const bool right_side = i % 2 == 1;
      const double top = uniform(0.8, 2), bottom = uniform(0.2, 0.6);
      if (right_side) {
        ring.emplace_back(x[i], top);
        ring.emplace_back(x[i - 1], top);
      } else {
        ring.emplace_back(x[i], bottom);
        ring.emplace_back(x[i - 1], bottom);
      }
    }
    return ring;
  }

  /// A strip that winds around the origin by up to one and a half turns.
  Ring spiral(int n)
  {
    const double turn = uniform(0.7, 3) * CGAL_PI, width = uniform(0.15, 0.5);
    Ring outer, ring;
    for (int i = 0; i <= n; ++i) {
      const double angle = turn * i / n, radius = 0.4 + 0.6 * angle / (2 * CGAL_PI);
      outer.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
      ring.emplace_back((radius - width * 0.6) * std::cos(angle), (radius - width * 0.6) * std::sin(angle));
    }
    ring.insert(ring.end(), outer.rbegin(), outer.rend());
    return Ring(ring.rbegin(), ring.rend());
  }

  void add_holes()
  {
    double low[2] = {m_rings[0][0].x(), m_rings[0][0].y()}, high[2] = {low[0], low[1]};
    for (const Point& p : m_rings[0])
      for (int k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    const double diameter = std::hypot(high[0] - low[0], high[1] - low[1]);
    const int wanted = uniform_int(0, 4);
    for (int attempt = 0; attempt < 12 * wanted && int(m_rings.size()) <= wanted; ++attempt) {
      const double radius = diameter * std::pow(10, uniform(-1.8, -0.6));
      const Point center(uniform(low[0], high[0]), uniform(low[1], high[1]));
      Ring hole = star(uniform_int(3, 9), uniform_int(0, 1) == 0 ? 1 : uniform(0.4, 0.9));
      for (Point& p : hole)
        p = Point(center.x() + radius * p.x(), center.y() + radius * p.y());
      const bool surrounds_another = std::any_of(m_rings.begin() + 1, m_rings.end(),
                                                 [&hole](const Ring& other) { return is_inside({hole}, other[0]); });
      if (is_inside(m_rings, hole[0]) && !surrounds_another && keeps_away(hole, diameter / 500))
        m_rings.push_back(hole);
    }
  }

  static bool is_inside(const std::vector<Ring>& rings, const Point& p)
  {
    bool inside = false;
    for (const Ring& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
        if ((a.y() > p.y()) != (b.y() > p.y()) &&
            (CGAL::orientation(a, b, p) == CGAL::COUNTERCLOCKWISE) == (b.y() > a.y()))
          inside = !inside;
      }
    return inside;
  }

  bool keeps_away(const Ring& hole, double gap) const
  {
    using Segment = Kernel::Segment_2;
    for (const Ring& ring : m_rings)
      for (std::size_t i = 0; i < ring.size(); ++i)
        for (std::size_t j = 0; j < hole.size(); ++j) {
          const Segment s(ring[i], ring[(i + 1) % ring.size()]), t(hole[j], hole[(j + 1) % hole.size()]);
          if (CGAL::do_intersect(s, t) || CGAL::squared_distance(s, t) < gap * gap)
            return false;
        }
    return true;
  }

  void transform()
  {
    const double stretch = uniform_int(0, 2) == 0 ? uniform(1, 6) : 1;
    const double angle = uniform_int(0, 1) == 0 ? uniform(0, 2 * CGAL_PI) : 0;
    const double scale = uniform_int(0, 1) == 0 ? std::pow(10, uniform(-6, 6)) : 1;
    const double c = scale * std::cos(angle), s = scale * std::sin(angle);
    for (Ring& ring : m_rings)
      for (Point& p : ring)
        p = Point(c * stretch * p.x() - s * p.y(), s * stretch * p.x() + c * p.y());
  }

  /// A third have no sizes; the sizes of the others vary by up to 1 : 12.
  void choose_sizes()
  {
    double low[2] = {m_rings[0][0].x(), m_rings[0][0].y()}, high[2] = {low[0], low[1]};
    for (const Point& p : m_rings[0])
      for (int k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    const double diameter = std::hypot(high[0] - low[0], high[1] - low[1]);
    const double ratio = std::log(uniform(1, 12)), angle = uniform(0, 2 * CGAL_PI);
    const double size = diameter / uniform(25, 50);
    if (uniform_int(0, 2) == 0)
      return;
    m_slope = Kernel::Vector_2(ratio / diameter * std::cos(angle), ratio / diameter * std::sin(angle));
    m_size = size * std::exp(-0.5 * (m_slope.x() * (low[0] + high[0]) + m_slope.y() * (low[1] + high[1])));
  }

  std::mt19937 m_generator;
  std::vector<Ring> m_rings;
  double m_size = 0;
  Kernel::Vector_2 m_slope{0, 0};
};

} // namespace test
} // namespace Quadrille

#endif
