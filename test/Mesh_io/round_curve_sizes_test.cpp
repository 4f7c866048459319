// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Default sizes at holes and other round outlines.

#include <Quadrille/Size_specification.h>
#include <Quadrille/Surface_domain.h>

#include <CGAL/number_utils.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

using namespace Quadrille;

namespace {

using Outline = std::vector<std::array<double, 2>>;

void add_arc(Outline& outline, double x, double y, double radius, double from, double to, int n)
{
  for (int i = 0; i < n; ++i) {
    const double angle = from + (to - from) * i / n;
    outline.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle)});
  }
}

Outline circle(double radius, int n)
{
  Outline outline;
  add_arc(outline, 0, 0, radius, 0, 2 * CGAL_PI, n);
  return outline;
}

/// Points in between, at most `step` apart.
Outline refine(const Outline& outline, double step)
{
  Outline result;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto &p = outline[i], &q = outline[(i + 1) % outline.size()];
    const int n = int(std::ceil(std::hypot(q[0] - p[0], q[1] - p[1]) / step));
    for (int k = 0; k < n; ++k)
      result.push_back({p[0] + (q[0] - p[0]) * k / n, p[1] + (q[1] - p[1]) * k / n});
  }
  return result;
}

/// Triangles between an outline and a copy of it around the origin that is `ratio` times as large, ring by ring.
Labelled_mesh ring(const Outline& inner, double ratio)
{
  const int n = int(inner.size());
  Labelled_mesh mesh;
  const int n_rings = 1 + int(std::ceil(std::log(ratio) / std::log(1.2)));
  for (int k = 0; k <= n_rings; ++k)
    for (const auto& p : inner) {
      const double scale = std::pow(ratio, double(k) / n_rings);
      mesh.points.push_back({scale * p[0], scale * p[1], 0});
    }
  for (int k = 0; k < n_rings; ++k)
    for (int i = 0; i < n; ++i) {
      const int a = k * n + i, b = k * n + (i + 1) % n;
      mesh.polygons.push_back({a, a + n, b + n});
      mesh.polygons.push_back({a, b + n, b});
    }
  return mesh;
}

struct Sample {
  double radius, size;
};

/// Sizes at the points of the curves; checks that they grow no faster than they may.
template <class Domain> std::vector<Sample> samples(const Domain& domain, double factor = 1)
{
  const Domain_sizes sizes = Size_specification().apply(domain, factor);
  std::vector<Sample> result;
  for (const auto e : domain.mesh.edges()) {
    const auto& ends = sizes.of_edge[e.idx()];
    if (ends[0].is_free())
      continue;
    const auto p = domain.mesh.point(domain.mesh.vertex(e, 0)), q = domain.mesh.point(domain.mesh.vertex(e, 1));
    const double length = std::sqrt(CGAL::to_double((p - q).squared_length()));
    EXPECT_LE(std::abs(ends[0].tangential - ends[1].tangential), 0.5 * length * (1 + 1e-9));
    const auto s = domain.mesh.point(domain.mesh.source(domain.mesh.halfedge(e)));
    result.push_back({std::hypot(CGAL::to_double(s.x()), CGAL::to_double(s.y())), ends[0].tangential});
  }
  return result;
}

TEST(Round_curve_sizes, circles_get_twelve_elements)
{
  for (const int n : {12, 13, 40, 200}) {
    const Planar_domain domain = make_planar_domain(ring(circle(0.6, n), 20), "ring");
    const double perimeter = 1.2 * n * std::sin(CGAL_PI / n), h = 24 * std::sqrt(2.0) / 40;
    for (const Sample& sample : samples(domain)) {
      const double expected = sample.radius < 1 ? perimeter / 12 : h;
      EXPECT_NEAR(sample.size, expected, 0.03 * expected) << n << " " << sample.radius;
    }
    for (const Sample& sample : samples(domain, 0.3))
      EXPECT_NEAR(sample.size, 0.3 * h, 0.03 * h) << "smaller sizes everywhere need no exceptions";
  }
}

TEST(Round_curve_sizes, are_limited_and_scale)
{
  for (const double scale : {1e-8, 1.0, 1e8}) {
    const Planar_domain domain = make_planar_domain(ring(circle(0.01 * scale, 60), 1000), "ring");
    const double h = 20 * std::sqrt(2.0) / 40 * scale;
    double least = h, largest = 0;
    for (const Sample& sample : samples(domain)) {
      least = std::min(least, sample.size);
      largest = std::max(largest, sample.size);
    }
    EXPECT_NEAR(least, h / 8, 1e-9 * h) << "smaller details are not worth it";
    EXPECT_NEAR(largest, h, 0.01 * h);
  }
}

TEST(Round_curve_sizes, fillets_do_not_count_and_slots_do)
{
  Outline rounded, slot;
  for (int k = 0; k < 4; ++k) {
    const double angle = k * CGAL_PI / 2, x = k == 0 || k == 3 ? 3 : -3, y = k < 2 ? 3 : -3;
    add_arc(rounded, x, y, 0.2, angle, angle + CGAL_PI / 2, 12);
    rounded.push_back({x + 0.2 * std::cos(angle + CGAL_PI / 2), y + 0.2 * std::sin(angle + CGAL_PI / 2)});
  }
  for (int k = 0; k < 2; ++k) {
    const double angle = (k - 0.5) * CGAL_PI;
    add_arc(slot, k == 0 ? 3 : -3, 0, 0.2, angle, angle + CGAL_PI, 12);
    slot.push_back({k == 0 ? 3.0 : -3.0, k == 0 ? 0.2 : -0.2});
  }
  const Planar_domain filleted = make_planar_domain(ring(refine(rounded, 0.1), 4), "rounded");
  const double h = samples(filleted).front().size;
  for (const Sample& sample : samples(filleted))
    EXPECT_EQ(sample.size, h);
  const Planar_domain slotted = make_planar_domain(ring(refine(slot, 0.1), 4), "slot");
  double at_end = h, in_the_middle = 0;
  for (const Sample& sample : samples(slotted)) {
    if (std::abs(sample.radius - 3.2) < 0.05)
      at_end = std::min(at_end, sample.size);
    if (sample.radius < 0.3)
      in_the_middle = std::max(in_the_middle, sample.size);
  }
  EXPECT_NEAR(at_end, 0.2 * CGAL_PI / 6, 0.1 / 6) << "up to the middles of the edges around the arc";
  EXPECT_GT(in_the_middle, 2 * at_end);
}

TEST(Round_curve_sizes, zigzags_do_not_count_and_saddle_shaped_holes_do)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  Outline zigzag;
  for (int i = 0; i < 400; ++i) { // turns by up to 33 degrees, back and forth
    const double radius = 6 + 0.015 * unit(random), angle = 2 * CGAL_PI * i / 400;
    zigzag.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  const Planar_domain domain = make_planar_domain(ring(zigzag, 1.5), "zigzag");
  const double h = Size_specification().typical_size(domain);
  for (const Sample& sample : samples(domain))
    EXPECT_DOUBLE_EQ(sample.size, h);

  Labelled_mesh pipe = ring(circle(0.6, 60), 14); // rolled on a cylinder of radius 4 about the y axis
  for (auto& p : pipe.points)
    p = {4 * std::sin(p[0] / 4), p[1], 4 * std::cos(p[0] / 4)};
  for (const double turn : {0.0, 0.7}) {
    Labelled_mesh turned = pipe;
    for (auto& p : turned.points)
      p = {std::cos(turn) * p[0] - std::sin(turn) * p[2], p[1], std::sin(turn) * p[0] + std::cos(turn) * p[2]};
    const Surface_domain surface = make_surface_domain(turned, "pipe");
    const Domain_sizes sizes = Size_specification().apply(surface);
    double least = Size_specification().typical_size(surface);
    for (const auto& ends : sizes.of_edge)
      if (!ends[0].is_free())
        least = std::min(least, ends[0].tangential);
    EXPECT_NEAR(least, 0.6 * CGAL_PI / 6, 0.02);
  }
}

} // namespace
