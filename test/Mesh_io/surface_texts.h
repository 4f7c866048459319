// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_MESH_IO_SURFACE_TEXTS_H
#define QUADRILLE_TEST_MESH_IO_SURFACE_TEXTS_H

#include <Quadrille/Surface_domain.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace Quadrille {

inline std::string off_text(const std::vector<std::array<double, 3>>& points,
                            const std::vector<std::array<int, 3>>& triangles)
{
  std::ostringstream text;
  text.precision(17);
  text << "OFF\n" << points.size() << " " << triangles.size() << " 0\n";
  for (const std::array<double, 3>& p : points)
    text << p[0] << " " << p[1] << " " << p[2] << "\n";
  for (const std::array<int, 3>& t : triangles)
    text << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
  return text.str();
}

/// A cube with edges of n units and n x n squares on each side, normals outwards unless it is turned inside out. The
/// first points, 0 to n, lie on one edge.
inline std::string cube_text(int n, double unit, bool inside_out = false)
{
  std::vector<std::array<double, 3>> points;
  std::map<std::array<int, 3>, int> index;
  const auto point = [&](const std::array<int, 3>& p) {
    const auto [place, is_new] = index.emplace(p, int(points.size()));
    if (is_new)
      points.push_back({p[0] * unit, p[1] * unit, p[2] * unit});
    return place->second;
  };
  for (int i = 0; i <= n; ++i)
    point({i, 0, 0});
  std::vector<std::array<int, 3>> triangles;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool is_top : {false, true})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> p;
            p[axis] = is_top ? n : 0;
            p[(axis + 1) % 3] = i + di;
            p[(axis + 2) % 3] = j + dj;
            return point(p);
          };
          const std::array<int, 4> q = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (is_top != inside_out) {
            triangles.push_back({q[0], q[1], q[2]});
            triangles.push_back({q[0], q[2], q[3]});
          } else {
            triangles.push_back({q[0], q[2], q[1]});
            triangles.push_back({q[0], q[3], q[2]});
          }
        }
  return off_text(points, triangles);
}

/// A rectangle of n x m unit squares, lifted by `height(i, j)`.
template <class Height> std::string sheet_text(int n, int m, const Height& height)
{
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<int, 3>> triangles;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i)
      points.push_back({double(i), double(j), height(i, j)});
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const int p = j * (n + 1) + i, q = p + n + 1;
      triangles.push_back({p, p + 1, q + 1});
      triangles.push_back({p, q + 1, q});
    }
  return off_text(points, triangles);
}

/// A strip of n squares with half a twist.
inline std::string moebius_text(int n)
{
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<int, 3>> triangles;
  const double pi = std::acos(-1.0);
  for (int i = 0; i < n; ++i)
    for (const double s : {-0.4, 0.4}) {
      const double a = 2 * pi * i / n, r = 1 + s * std::cos(a / 2);
      points.push_back({r * std::cos(a), r * std::sin(a), s * std::sin(a / 2)});
    }
  for (int i = 0; i < n; ++i) {
    const bool last = i + 1 == n;
    const int a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    triangles.push_back({a, c, b});
    triangles.push_back({b, c, d});
  }
  return off_text(points, triangles);
}

/// Two triangles with a ridge between them, in a surface each; one side in the group "front".
inline std::string tent_msh()
{
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 7 \"front\"\n$EndPhysicalNames\n"
         "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 1\n$EndNodes\n"
         "$Elements\n3\n1 1 2 7 5 1 2\n2 2 2 0 1 1 2 3\n3 2 2 0 2 2 4 3\n$EndElements\n";
}

inline std::string obj_of_off(const std::string& off)
{
  std::istringstream in(off);
  std::ostringstream out;
  std::string word;
  std::size_t n = 0, m = 0, edges = 0;
  in >> word >> n >> m >> edges;
  std::array<std::string, 3> x;
  for (std::size_t i = 0; i < n && in >> x[0] >> x[1] >> x[2]; ++i)
    out << "v " << x[0] << " " << x[1] << " " << x[2] << "\n";
  int three = 0, a = 0, b = 0, c = 0;
  for (std::size_t i = 0; i < m && in >> three >> a >> b >> c; ++i)
    out << "f " << a + 1 << " " << b + 1 << " " << c + 1 << "\n";
  return out.str();
}

inline std::string medit_of_off(const std::string& off)
{
  std::istringstream in(off);
  std::ostringstream out;
  std::string word;
  std::size_t n = 0, m = 0, edges = 0;
  in >> word >> n >> m >> edges;
  out << "MeshVersionFormatted 2\nDimension 3\nVertices\n" << n << "\n";
  std::array<std::string, 3> x;
  for (std::size_t i = 0; i < n && in >> x[0] >> x[1] >> x[2]; ++i)
    out << x[0] << " " << x[1] << " " << x[2] << " 0\n";
  out << "Triangles\n" << m << "\n";
  int three = 0, a = 0, b = 0, c = 0;
  for (std::size_t i = 0; i < m && in >> three >> a >> b >> c; ++i)
    out << a + 1 << " " << b + 1 << " " << c + 1 << " 0\n";
  out << "End\n";
  return out.str();
}

inline long euler_characteristic(const Surface_domain& domain)
{
  return long(domain.mesh.number_of_vertices()) - long(domain.mesh.number_of_edges()) +
         long(domain.mesh.number_of_faces());
}

inline double enclosed_volume(const Surface_domain& domain)
{
  double sum = 0;
  const Surface_domain::Point_3 origin = domain.mesh.point(*domain.mesh.vertices().begin());
  for (const auto f : domain.mesh.faces()) {
    const auto h = domain.mesh.halfedge(f);
    sum += CGAL::volume(origin, domain.mesh.point(domain.mesh.source(h)), domain.mesh.point(domain.mesh.target(h)),
                        domain.mesh.point(domain.mesh.target(domain.mesh.next(h))));
  }
  return sum;
}

inline bool has_note(const Surface_domain& domain, const std::string& part)
{
  for (const std::string& note : domain.notes)
    if (note.find(part) != std::string::npos)
      return true;
  return false;
}

/// What every surface promises.
inline void expect_sound(const Surface_domain& domain)
{
  const Surface_domain::Mesh& mesh = domain.mesh;
  EXPECT_TRUE(mesh.is_valid(false));
  ASSERT_EQ(domain.edge_curve.size(), mesh.number_of_edges());
  ASSERT_EQ(domain.edge_chain.size(), mesh.number_of_edges());
  ASSERT_EQ(domain.face_region.size(), mesh.number_of_faces());
  ASSERT_EQ(domain.point_size.size(), mesh.number_of_vertices());
  for (const auto e : mesh.edges())
    if (mesh.is_border(e)) {
      EXPECT_GE(domain.edge_curve[std::size_t(e.idx())], 0);
    }
  for (const int region : domain.face_region)
    EXPECT_LT(std::size_t(region), domain.regions.size());
  std::size_t n_on_curves = 0, n_in_paths = 0;
  for (const int c : domain.edge_curve)
    n_on_curves += c >= 0;
  for (std::size_t c = 0; c < domain.curves.size(); ++c) {
    const Surface_domain::Curve& curve = domain.curves[c];
    n_in_paths += curve.path.size();
    ASSERT_FALSE(curve.path.empty());
    EXPECT_EQ(mesh.source(curve.path.front()), curve.first);
    EXPECT_EQ(mesh.target(curve.path.back()), curve.last);
    for (std::size_t i = 0; i < curve.path.size(); ++i) {
      EXPECT_EQ(domain.edge_curve[std::size_t(mesh.edge(curve.path[i]).idx())], int(c));
      if (i > 0) {
        EXPECT_EQ(mesh.target(curve.path[i - 1]), mesh.source(curve.path[i]));
      }
    }
  }
  EXPECT_EQ(n_on_curves, n_in_paths);
}

} // namespace Quadrille

#endif
