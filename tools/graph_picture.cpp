// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Picture_view.h"
#include "cross_output.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace Quadrille {

namespace {

using Triangle = std::array<int, 3>;

/// The faces of one tetrahedron only, counterclockwise seen from outside.
std::vector<Triangle> boundary_of(const Tetrahedral_mesh& mesh)
{
  struct Face {
    Triangle sorted, corners;
  };
  std::vector<Face> faces;
  faces.reserve(4 * mesh.tetrahedra.size());
  for (const auto& [a, b, c, d] : mesh.tetrahedra)
    for (const Triangle& corners : {Triangle{b, c, d}, Triangle{a, d, c}, Triangle{a, b, d}, Triangle{a, c, b}}) {
      Triangle sorted = corners;
      std::sort(sorted.begin(), sorted.end());
      faces.push_back({sorted, corners});
    }
  std::sort(faces.begin(), faces.end(), [](const Face& f, const Face& g) { return f.sorted < g.sorted; });
  std::vector<Triangle> result;
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (i + 1 < faces.size() && faces[i].sorted == faces[i + 1].sorted)
      ++i;
    else
      result.push_back(faces[i].corners);
  return result;
}

class Graph_picture {
public:
  Graph_picture(const Tetrahedral_mesh& mesh, const Singular_graph& graph, double crease_angle)
      : m_mesh(mesh), m_graph(graph), m_view(mesh.points), m_cosine(std::cos(crease_angle * std::acos(-1.0) / 180))
  {
  }

  std::string draw()
  {
    m_text = m_view.page();
    const std::vector<Triangle> boundary = boundary_of(m_mesh);
    std::vector<Eigen::Vector3d> normals;
    for (const Triangle& t : boundary) {
      const Eigen::Vector3d a = m_mesh.point(std::size_t(t[0]));
      const Eigen::Vector3d b = m_mesh.point(std::size_t(t[1])), c = m_mesh.point(std::size_t(t[2]));
      normals.push_back(m_view.turned((b - a).cross(c - a).normalized()));
    }
    draw_surface(boundary, normals);
    draw_edges(boundary, normals);
    draw_graph();
    return m_text + "</svg>\n";
  }

private:
  static std::string point(const Eigen::Vector3d& p) { return Picture_view::place(p); }

  /// The far side, shaded, so that the inside is open to view.
  void draw_surface(const std::vector<Triangle>& boundary, const std::vector<Eigen::Vector3d>& normals)
  {
    constexpr std::size_t most = 60000; // viewers of SVG get slow
    if (boundary.size() > most)
      return;
    for (std::size_t f = 0; f < boundary.size(); ++f) {
      if (normals[f][2] > 0)
        continue;
      const int gray = int(232 + 20 * std::abs(normals[f].dot(Eigen::Vector3d(0.4, 0.5, 0.77))));
      char color[8];
      std::snprintf(color, sizeof color, "#%02x%02x%02x", gray, gray, std::min(gray + 3, 255));
      m_text += "<path fill=\"" + std::string(color) + "\" stroke=\"" + color + "\" stroke-width=\"0.5\" d=\"M";
      for (std::size_t i = 0; i < 3; ++i)
        m_text += (i > 0 ? "L" : "") + point(m_view(m_mesh.point(std::size_t(boundary[f][i]))));
      m_text += "Z\"/>\n";
    }
  }

  /// Creases, and where the surface turns away.
  void draw_edges(const std::vector<Triangle>& boundary, const std::vector<Eigen::Vector3d>& normals)
  {
    std::map<std::array<int, 2>, std::size_t> open;
    std::string creases, outline;
    for (std::size_t f = 0; f < boundary.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i) {
        const int u = boundary[f][i], v = boundary[f][(i + 1) % 3];
        const auto [place, is_new] = open.emplace(std::array<int, 2>{std::min(u, v), std::max(u, v)}, f);
        if (is_new)
          continue;
        const Eigen::Vector3d &a = normals[f], &b = normals[place->second];
        open.erase(place);
        const bool is_crease = a.dot(b) < m_cosine;
        if (!is_crease && (a[2] > 0) == (b[2] > 0))
          continue;
        (is_crease ? creases : outline) +=
            "M" + point(m_view(m_mesh.point(std::size_t(u)))) + "L" + point(m_view(m_mesh.point(std::size_t(v))));
      }
    m_text += "<path fill=\"none\" stroke=\"#999\" stroke-width=\"1\" d=\"" + outline + "\"/>\n";
    m_text += "<path fill=\"none\" stroke=\"#555\" stroke-width=\"1.2\" d=\"" + creases + "\"/>\n";
  }

  static const char* color(Singular_graph::Valence valence)
  {
    switch (valence) {
    case Singular_graph::Valence::three:
      return "#d22";
    case Singular_graph::Valence::five:
      return "#24c";
    default:
      return "#a2c";
    }
  }

  void draw_graph()
  {
    for (const Singular_graph::Arc& arc : m_graph.arcs) {
      m_text += "<path fill=\"none\" stroke-linecap=\"round\" stroke-width=\"3\" stroke=\"" +
                std::string(color(arc.valence)) + "\" d=\"";
      for (std::size_t i = 0; i < arc.points.size(); ++i)
        m_text += (i > 0 ? "L" : "M") + point(m_view(arc.points[i]));
      m_text += arc.is_loop ? "Z\"/>\n" : "\"/>\n";
      if (arc.is_loop || arc.points.empty())
        continue;
      if (arc.from == Singular_graph::at_boundary)
        dot(arc.points.front(), 4, color(arc.valence));
      if (arc.to == Singular_graph::at_boundary)
        dot(arc.points.back(), 4, color(arc.valence));
    }
    for (const Singular_graph::Node& node : m_graph.nodes)
      dot(node.point, 6, "#000");
  }

  void dot(const Eigen::Vector3d& p, int radius, const char* fill)
  {
    m_text += Picture_view::dot(m_view(p), radius, fill);
  }

  const Tetrahedral_mesh& m_mesh;
  const Singular_graph& m_graph;
  Picture_view m_view;
  double m_cosine;
  std::string m_text;
};

} // namespace

std::string svg_picture_of_graph(const Tetrahedral_mesh& mesh, const Singular_graph& graph, double crease_angle)
{
  return Graph_picture(mesh, graph, crease_angle).draw();
}

} // namespace Quadrille
