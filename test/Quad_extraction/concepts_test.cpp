// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Archetypes: what a model offers here is all that the package may ask of it.

#include "extraction_helpers.h"

#include <gtest/gtest.h>

using namespace quad_extraction_test;

namespace {

/// A point with nothing but coordinates.
class Point_archetype {
public:
  Point_archetype(double x, double y) : m_x(x), m_y(y) {}
  double x() const { return m_x; }
  double y() const { return m_y; }

private:
  double m_x, m_y;
};

/// A readable property map with nothing but `get`.
template <class Key, class Value> struct Readable_map_archetype {
  using key_type = Key;
  using value_type = Value;
  using reference = Value;
  using category = boost::readable_property_map_tag;
  const std::vector<Value>* values;

  friend Value get(const Readable_map_archetype& map, const Key& key) { return (*map.values)[std::size_t(key)]; }
};

class Quantizer_archetype {
public:
  explicit Quantizer_archetype(int length) : m_length(length) {}
  Quadrille::Quantization operator()(const Quadrille::Quad_layout& layout, Quadrille::Length_constraints&) const
  {
    Quadrille::Quantization result;
    result.lengths.assign(layout.arcs.size(), m_length);
    return result;
  }

private:
  int m_length;
};

class Projector_archetype {
public:
  explicit Projector_archetype(int) {}
  Point_archetype operator()(int, const Point_archetype& p) const { return p; }
};

} // namespace

TEST(Concepts, archetypes_suffice)
{
  const Mapped_mesh mapped = cell_grid(2, 1).build();
  CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3> mesh; // its own points must not be used
  using Graph = decltype(mesh);
  for (std::size_t v = 0; v < mapped.points.size(); ++v)
    mesh.add_vertex({});
  std::vector<Point_archetype> points, uv(3 * mapped.triangles.size() * 2, Point_archetype(0, 0));
  for (const Point& p : mapped.points)
    points.emplace_back(p[0], p[1]);
  std::vector<int> curve(3 * mapped.triangles.size(), -1);
  for (std::size_t f = 0; f < mapped.triangles.size(); ++f) {
    const auto vertex = [&](std::size_t i) { return Graph::Vertex_index(unsigned(mapped.triangles[f][i % 3])); };
    mesh.add_face(vertex(0), vertex(1), vertex(2));
    for (std::size_t i = 0; i < 3; ++i) {
      const auto h = mesh.halfedge(vertex(i), vertex(i + 1));
      const Point& at_target = mapped.corner_uv[3 * f + (i + 1) % 3];
      uv[h.idx()] = Point_archetype(at_target[0], at_target[1]);
      curve[mesh.edge(h).idx()] = mapped.curve[3 * f + i];
    }
  }
  const Readable_map_archetype<Graph::Vertex_index, Point_archetype> point_map{&points};
  const Readable_map_archetype<Graph::Halfedge_index, Point_archetype> uv_map{&uv};
  const Readable_map_archetype<Graph::Edge_index, int> curve_map{&curve};
  const Readable_map_archetype<Graph::Face_index, int> region_map{&mapped.region};
  Mesh quads;
  const auto result = Quadrille::extract_quads(mesh, point_map, uv_map, curve_map, region_map, quads, {},
                                               Quantizer_archetype(5), Projector_archetype(0));
  EXPECT_EQ(quads.number_of_faces(), 25U);
  EXPECT_EQ(result.layout.patches.size(), 1U);
}
