// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "svg_picture.h"

#include "pipeline_output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

namespace Quadrille {

namespace {

constexpr double panel_size = 900, margin = 20, title_height = 30;

/// Panels side by side, each with the domain fitted into it.
class Picture {
public:
  explicit Picture(const Planar_domain& domain) : m_domain(domain)
  {
    for (const auto v : domain.mesh.vertices())
      m_box += domain.mesh.point(v).bbox();
    const double width = m_box.xmax() - m_box.xmin(), height = m_box.ymax() - m_box.ymin();
    m_scale = panel_size / std::max(width, height);
    m_width = width * m_scale + 2 * margin;
    m_height = height * m_scale + 2 * margin + title_height;
  }

  void begin_panel(const std::string& title)
  {
    m_x0 = double(m_n_panels % 2) * m_width + margin;
    m_y0 = double(m_n_panels / 2) * m_height + margin + title_height;
    ++m_n_panels;
    m_text += "<text x=\"" + number(m_x0) + "\" y=\"" + number(m_y0 - 12) + "\">" + title + "</text>\n";
  }

  void begin_path(const std::string& style) { m_text += "<path fill=\"none\" " + style + " d=\""; }
  void end_path() { m_text += "\"/>\n"; }

  void line(double ax, double ay, double bx, double by)
  {
    m_text += 'M';
    add_point(ax, ay);
    m_text += 'L';
    add_point(bx, by);
  }

  void circle(double x, double y, const std::string& color)
  {
    m_text += "<circle r=\"5\" cx=\"" + number(m_x0 + (x - m_box.xmin()) * m_scale) + "\" cy=\"" +
              number(m_y0 + (m_box.ymax() - y) * m_scale) + "\" fill=\"" + color + "\"/>\n";
  }

  void outline()
  {
    begin_path("stroke=\"#000\" stroke-width=\"1.5\"");
    const auto& mesh = m_domain.mesh;
    for (const Planar_domain::Curve& curve : m_domain.curves)
      for (const auto h : curve.path)
        line(mesh.point(mesh.source(h)).x(), mesh.point(mesh.source(h)).y(), mesh.point(mesh.target(h)).x(),
             mesh.point(mesh.target(h)).y());
    end_path();
  }

  double scale() const { return m_scale; }

  std::string finish() const
  {
    const double width = m_width * double(std::min(m_n_panels, 2)), height = m_height * double((m_n_panels + 1) / 2);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(width) + "\" height=\"" + number(height) +
           "\" font-family=\"sans-serif\" font-size=\"20\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" +
           m_text + "</svg>\n";
  }

private:
  /// One decimal is a tenth of a pixel.
  static std::string number(double value)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
  }

  void add_point(double x, double y)
  {
    m_text += number(m_x0 + (x - m_box.xmin()) * m_scale) + ' ' + number(m_y0 + (m_box.ymax() - y) * m_scale);
  }

  const Planar_domain& m_domain;
  CGAL::Bbox_2 m_box;
  double m_scale = 1, m_width = 0, m_height = 0, m_x0 = 0, m_y0 = 0;
  int m_n_panels = 0;
  std::string m_text;
};

/// At most one face per cell of a grid of this spacing, so that crosses do not overlap.
std::vector<Planar_domain::face_descriptor> spread_faces(const Planar_domain& domain, double cell)
{
  std::map<std::pair<long, long>, Planar_domain::face_descriptor> chosen;
  for (const auto f : domain.mesh.faces()) {
    const auto h = domain.mesh.halfedge(f);
    const auto c = CGAL::centroid(domain.mesh.point(domain.mesh.source(h)), domain.mesh.point(domain.mesh.target(h)),
                                  domain.mesh.point(domain.mesh.target(domain.mesh.next(h))));
    chosen.emplace(std::pair<long, long>(std::lround(c.x() / cell), std::lround(c.y() / cell)), f);
  }
  std::vector<Planar_domain::face_descriptor> faces;
  for (const auto& [key, f] : chosen)
    faces.push_back(f);
  return faces;
}

void draw_singular_vertices(const Planar_domain& domain, const Frames& frames, Picture& picture)
{
  for (const auto v : domain.mesh.vertices()) {
    const int valence = frames.valence[std::size_t(v.idx())];
    if (valence != 4)
      picture.circle(domain.mesh.point(v).x(), domain.mesh.point(v).y(),
                     valence == 3   ? "#d22"
                     : valence == 5 ? "#22d"
                                    : "#a2a");
  }
}

void draw_field(const Planar_domain& domain, const Frames& frames, Picture& picture)
{
  picture.begin_panel("frame field");
  const double cell = panel_size / 45 / picture.scale();
  double largest = 0;
  for (std::size_t f = 0; f < frames.u.size(); ++f)
    largest =
        std::max({largest, std::hypot(frames.u[f][0], frames.u[f][1]), std::hypot(frames.v[f][0], frames.v[f][1])});
  const double factor = largest > 0 ? 0.5 * cell / largest : 0;
  picture.begin_path("stroke=\"#666\" stroke-width=\"1\"");
  for (const auto f : spread_faces(domain, cell)) {
    const auto h = domain.mesh.halfedge(f);
    const auto c = CGAL::centroid(domain.mesh.point(domain.mesh.source(h)), domain.mesh.point(domain.mesh.target(h)),
                                  domain.mesh.point(domain.mesh.target(domain.mesh.next(h))));
    for (const auto& vector : {frames.u[std::size_t(f.idx())], frames.v[std::size_t(f.idx())]})
      picture.line(c.x() - factor * vector[0], c.y() - factor * vector[1], c.x() + factor * vector[0],
                   c.y() + factor * vector[1]);
  }
  picture.end_path();
  picture.outline();
  draw_singular_vertices(domain, frames, picture);
}

/// The lines u = integer or v = integer, triangle by triangle.
void draw_isolines(const Planar_domain& domain, const std::vector<Planar_domain::Point_2>& corner_uv, int coordinate,
                   const std::string& style, Picture& picture)
{
  const auto& mesh = domain.mesh;
  picture.begin_path(style);
  for (const auto f : mesh.faces()) {
    std::array<Planar_domain::Point_2, 3> p;
    std::array<double, 3> value{};
    std::size_t i = 0;
    for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      p[i] = mesh.point(mesh.target(h));
      value[i++] = corner_uv[std::size_t(h.idx())][coordinate];
    }
    const auto [low, high] = std::minmax({value[0], value[1], value[2]});
    for (double level = std::ceil(low); level <= high && high - low < 1000; ++level) {
      std::vector<Planar_domain::Point_2> ends;
      for (std::size_t k = 0; k < 3; ++k) {
        const double a = value[k], b = value[(k + 1) % 3];
        if ((a < level) != (b < level))
          ends.push_back(p[k] + (level - a) / (b - a) * (p[(k + 1) % 3] - p[k]));
      }
      if (ends.size() == 2)
        picture.line(ends[0].x(), ends[0].y(), ends[1].x(), ends[1].y());
    }
  }
  picture.end_path();
}

void draw_layout(const Planar_domain& domain, const Quad_pipeline_result& result, const Frames& frames,
                 Picture& picture)
{
  picture.begin_panel("layout, " + std::to_string(result.extraction->layout.patches.size()) + " patches");
  picture.begin_path("stroke=\"#c60\" stroke-width=\"1\"");
  for (const auto& polyline : result.extraction->arc_polylines)
    for (std::size_t i = 1; i < polyline.size(); ++i)
      picture.line(polyline[i - 1][0], polyline[i - 1][1], polyline[i][0], polyline[i][1]);
  picture.end_path();
  picture.outline();
  draw_singular_vertices(domain, frames, picture);
}

void draw_quads(const Quad_pipeline_result& result, Picture& picture)
{
  picture.begin_panel("mesh, " + std::to_string(result.quads.number_of_faces()) + " quads");
  picture.begin_path("stroke=\"#246\" stroke-width=\"0.7\"");
  for (const auto e : result.quads.edges()) {
    const auto& p = result.quads.point(result.quads.vertex(e, 0));
    const auto& q = result.quads.point(result.quads.vertex(e, 1));
    picture.line(p.x(), p.y(), q.x(), q.y());
  }
  picture.end_path();
  picture.outline();
}

} // namespace

std::string svg_picture(const Planar_domain& domain, const Quad_pipeline_result& result)
{
  Picture picture(domain);
  const Frames frames = frames_of(domain, result);
  if (result.field)
    draw_field(domain, frames, picture);
  if (result.map) {
    picture.begin_panel("isolines of the map");
    // One colour: across seams u and v may change places.
    for (const int coordinate : {0, 1})
      draw_isolines(domain, result.corner_uv, coordinate, "stroke=\"#287\" stroke-width=\"0.7\"", picture);
    picture.outline();
  }
  if (result.extraction) {
    draw_layout(domain, result, frames, picture);
    draw_quads(result, picture);
  }
  return picture.finish();
}

} // namespace Quadrille
