// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Quads of a quarter annulus from its logarithm, a seamless map given by a formula; writes quads_from_a_map.off.

#include <Quadrille/quad_extraction.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <fstream>
#include <iostream>

using Point = CGAL::Simple_cartesian<double>::Point_2;
using Mesh = CGAL::Surface_mesh<Point>;

int main()
{
  const int n = 16;
  const double quarter = std::acos(0.0);
  Mesh mesh; // u = 10 log(radius), v = 10 angle
  auto uv = mesh.add_property_map<Mesh::Halfedge_index, Point>("h:uv").first;
  auto curve = mesh.add_property_map<Mesh::Edge_index, int>("e:curve", -1).first;
  auto region = mesh.add_property_map<Mesh::Face_index, int>("f:region", 0).first;
  const auto exact = [](double x) { return std::round(x * 1048576) / 1048576; }; // multiples of 2^-20
  std::vector<Point> map_of_vertex;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double radius = std::exp(double(i) / n), angle = quarter * j / n;
      mesh.add_vertex(Point(radius * std::cos(angle), radius * std::sin(angle)));
      map_of_vertex.emplace_back(exact(10.0 * i / n), exact(10 * angle));
    }
  const auto vertex = [](int i, int j) { return Mesh::Vertex_index(unsigned(j * (n + 1) + i)); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.add_face(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      mesh.add_face(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  for (const auto h : mesh.halfedges())
    uv[h] = map_of_vertex[mesh.target(h)];
  for (const auto e : mesh.edges())
    if (mesh.is_border(e))
      curve[e] = 1;

  Mesh quads;
  const auto result = Quadrille::extract_quads(mesh, mesh.points(), uv, curve, region, quads);
  std::cout << quads.number_of_faces() << " quads from " << result.layout.patches.size() << " patches, area change "
            << 100 * result.area_change_relative << " %\n";
  std::ofstream out("quads_from_a_map.off");
  out << "OFF\n" << quads.number_of_vertices() << ' ' << quads.number_of_faces() << " 0\n";
  for (const auto v : quads.vertices())
    out << quads.point(v).x() << ' ' << quads.point(v).y() << " 0\n";
  for (const auto f : quads.faces()) {
    out << 4;
    for (const auto v : quads.vertices_around_face(quads.halfedge(f)))
      out << ' ' << v.idx();
    out << '\n';
  }
}
