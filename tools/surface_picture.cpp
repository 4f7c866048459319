// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "surface_picture.h"

#include "Picture_view.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>

namespace Quadrille {

namespace {

/// By pixel of a page, how near to the viewer the nearest triangle is.
class Depth_image {
public:
  Depth_image(double width, double height)
      : m_width(int(width) + 1), m_height(int(height) + 1),
        m_depth(std::size_t(m_width) * std::size_t(m_height), -std::numeric_limits<double>::infinity())
  {
  }

  void add(const std::array<Eigen::Vector3d, 3>& corners)
  {
    const auto& [a, b, c] = corners;
    const double area = cross(b - a, c - a);
    if (area == 0)
      return;
    const int left = int(std::floor(std::min({a[0], b[0], c[0]}))), right = int(std::max({a[0], b[0], c[0]}));
    const int top = int(std::floor(std::min({a[1], b[1], c[1]}))), bottom = int(std::max({a[1], b[1], c[1]}));
    for (int y = std::max(top, 0); y <= std::min(bottom, m_height - 1); ++y)
      for (int x = std::max(left, 0); x <= std::min(right, m_width - 1); ++x) {
        const Eigen::Vector3d p(x + 0.5, y + 0.5, 0);
        const double s = cross(p - a, c - a) / area, t = cross(b - a, p - a) / area;
        if (s < 0 || t < 0 || s + t > 1)
          continue;
        double& depth = m_depth[std::size_t(y) * std::size_t(m_width) + std::size_t(x)];
        depth = std::max(depth, a[2] + s * (b[2] - a[2]) + t * (c[2] - a[2]));
      }
  }

  /// Whether nothing is before `p`. Pixels have a size, and surfaces slope: points of a surface are in front of a
  /// part of the pixel or of one next to it.
  bool shows(const Eigen::Vector3d& p) const
  {
    constexpr double slack = 2;
    double farthest = std::numeric_limits<double>::infinity();
    for (int y = int(p[1]) - 1; y <= int(p[1]) + 1; ++y)
      for (int x = int(p[0]) - 1; x <= int(p[0]) + 1; ++x)
        if (x >= 0 && y >= 0 && x < m_width && y < m_height)
          farthest = std::min(farthest, m_depth[std::size_t(y) * std::size_t(m_width) + std::size_t(x)]);
    return p[2] > farthest - slack;
  }

private:
  static double cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a[0] * b[1] - a[1] * b[0]; }

  int m_width, m_height;
  std::vector<double> m_depth;
};

class Surface_picture {
public:
  explicit Surface_picture(const Surface_drawing& drawing)
      : m_drawing(drawing), m_view(drawing.points, drawing.toward_viewer), m_depth(m_view.width(), m_view.height())
  {
    const bool closed = is_closed();
    for (std::size_t f = 0; f < drawing.triangles.size(); ++f) {
      m_corners.push_back(
          {on_page(drawing.triangles[f][0]), on_page(drawing.triangles[f][1]), on_page(drawing.triangles[f][2])});
      m_depth.add(m_corners[f]);
      m_normals.push_back(m_view.turned(normal(f)));
      if (!closed || m_normals[f][2] > 0)
        m_in_view.push_back(f);
    }
  }

  std::string draw()
  {
    m_text = m_view.page();
    shade();
    draw_isolines();
    draw_frames();
    draw_edges(m_drawing.mesh_edges, "stroke=\"#246\" stroke-width=\"0.7\"");
    draw_edges(m_drawing.feature_edges, "stroke=\"#000\" stroke-width=\"1.6\" stroke-linecap=\"round\"");
    for (const auto& [v, valence] : m_drawing.singular_vertices)
      if (m_depth.shows(on_page(v)))
        m_text += Picture_view::dot(on_page(v), 5, valence == 3 ? "#d22" : valence == 5 ? "#22d" : "#a2a");
    return m_text + "</svg>\n";
  }

private:
  Eigen::Vector3d point(int v) const { return Eigen::Vector3d::Map(m_drawing.points[std::size_t(v)].data()); }
  Eigen::Vector3d on_page(int v) const { return m_view(point(v)); }

  Eigen::Vector3d normal(std::size_t f) const
  {
    const auto& [a, b, c] = m_drawing.triangles[f];
    return (point(b) - point(a)).cross(point(c) - point(a)).normalized();
  }

  bool is_closed() const
  {
    std::map<std::array<int, 2>, int> sides;
    for (const auto& t : m_drawing.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        ++sides[{std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])}];
    return std::all_of(sides.begin(), sides.end(), [](const auto& side) { return side.second == 2; });
  }

  /// A stroke between two places, if it is seen: tested at its middle, a little before the surface.
  void add_stroke(std::string& path, const Eigen::Vector3d& a, const Eigen::Vector3d& b) const
  {
    if (m_depth.shows(0.5 * (a + b)))
      path += "M" + Picture_view::place(a) + "L" + Picture_view::place(b);
  }

  void add_path(const std::string& style, const std::string& path)
  {
    if (!path.empty())
      m_text += "<path fill=\"none\" " + style + " d=\"" + path + "\"/>\n";
  }

  /// From far to near.
  void shade()
  {
    constexpr std::size_t most = 200000; // viewers of SVG get slow
    if (m_in_view.size() > most)
      return;
    std::vector<std::size_t> order = m_in_view;
    const auto depth = [&](std::size_t f) { return m_corners[f][0][2] + m_corners[f][1][2] + m_corners[f][2][2]; };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t f, std::size_t g) { return depth(f) < depth(g); });
    for (const std::size_t f : order) {
      const bool back = m_normals[f][2] < 0;
      const int gray = int(170 + 75 * std::abs(m_normals[f].dot(Eigen::Vector3d(-0.3, 0.45, 0.84))));
      char color[8];
      std::snprintf(color, sizeof color, "#%02x%02x%02x", back ? gray - 22 : gray, back ? gray - 10 : gray,
                    std::min(gray + 4, 255));
      m_text += "<path fill=\"" + std::string(color) + "\" stroke=\"" + color + "\" stroke-width=\"0.5\" d=\"M" +
                Picture_view::place(m_corners[f][0]) + "L" + Picture_view::place(m_corners[f][1]) + "L" +
                Picture_view::place(m_corners[f][2]) + "Z\"/>\n";
    }
  }

  void draw_isolines()
  {
    if (m_drawing.uv.empty())
      return;
    const char* const styles[] = {"stroke=\"#c60\" stroke-width=\"1\"", "stroke=\"#083\" stroke-width=\"1\""};
    for (int i = 0; i < 2; ++i) {
      std::string path;
      for (const std::size_t f : m_in_view)
        add_isolines(path, f, i);
      add_path(styles[i], path);
    }
  }

  /// Where coordinate `i` is a multiple of the spacing in a triangle.
  void add_isolines(std::string& path, std::size_t f, int i) const
  {
    constexpr double most = 50;    // denser lines are no picture
    constexpr double equal = 1e-9; // so that lines along edges are seen by the triangles on both sides
    std::array<double, 3> x;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = m_drawing.uv[f][k][i] / m_drawing.isoline_spacing;
      if (std::abs(x[k] - std::round(x[k])) < equal)
        x[k] = std::round(x[k]);
    }
    const double low = std::ceil(std::min({x[0], x[1], x[2]})), high = std::floor(std::max({x[0], x[1], x[2]}));
    if (!(high - low <= most))
      return;
    for (double level = low; level <= high; ++level) {
      std::vector<Eigen::Vector3d> ends;
      for (std::size_t k = 0; k < 3; ++k) {
        const double a = x[k] - level, b = x[(k + 1) % 3] - level;
        if (a == 0)
          ends.push_back(m_corners[f][k]);
        else if (a * b < 0)
          ends.push_back(m_corners[f][k] + a / (a - b) * (m_corners[f][(k + 1) % 3] - m_corners[f][k]));
      }
      if (ends.size() == 2)
        add_stroke(path, ends[0], ends[1]);
    }
  }

  double size(std::size_t f) const { return std::sqrt(m_drawing.frames[f][0].norm() * m_drawing.frames[f][1].norm()); }

  /// Of the seen triangles that have a frame and are not seen from the side, by cell of a grid on the page, the one
  /// nearest to the middle.
  std::vector<std::size_t> spread_triangles(double cell) const
  {
    std::map<std::array<long, 2>, std::pair<double, std::size_t>> chosen;
    for (const std::size_t f : m_in_view) {
      const Eigen::Vector3d centroid = middle(f);
      const bool has_frame = size(f) > 0 && std::isfinite(size(f));
      if (!has_frame || std::abs(m_normals[f][2]) < 0.15 || !m_depth.shows(centroid))
        continue;
      const Eigen::Vector2d at = centroid.head<2>() / cell;
      const std::array<long, 2> key = {std::lround(at[0]), std::lround(at[1])};
      const std::pair<double, std::size_t> candidate(std::hypot(at[0] - double(key[0]), at[1] - double(key[1])), f);
      const auto [place, is_new] = chosen.emplace(key, candidate);
      if (!is_new)
        place->second = std::min(place->second, candidate);
    }
    std::vector<std::size_t> triangles;
    for (const auto& [key, candidate] : chosen)
      triangles.push_back(candidate.second);
    return triangles;
  }

  Eigen::Vector3d middle(std::size_t f) const { return (m_corners[f][0] + m_corners[f][1] + m_corners[f][2]) / 3; }

  void draw_frames()
  {
    if (m_drawing.frames.empty())
      return;
    constexpr double cell = 20;
    const std::vector<std::size_t> triangles = spread_triangles(cell);
    double low = HUGE_VAL, high = 0;
    for (const std::size_t f : triangles) {
      low = std::min(low, size(f));
      high = std::max(high, size(f));
    }
    constexpr int n_colors = 16;
    std::array<std::string, n_colors> paths;
    for (const std::size_t f : triangles) {
      // Logarithmic; sizes that are all but equal are in the middle.
      const double range = std::log(high / low);
      const double share = range > 0.01 ? std::log(size(f) / low) / range : 0.5;
      std::string& path = paths[std::size_t(std::clamp(int(share * n_colors), 0, n_colors - 1))];
      const double longest = std::max(m_drawing.frames[f][0].norm(), m_drawing.frames[f][1].norm());
      for (const Eigen::Vector3d& vector : m_drawing.frames[f]) {
        const Eigen::Vector3d arm = m_view.turned(vector) * (0.45 * cell / longest);
        const Eigen::Vector3d step(arm[0], -arm[1], arm[2]); // down the page
        path += "M" + Picture_view::place(middle(f) - step) + "L" + Picture_view::place(middle(f) + step);
      }
    }
    for (int i = 0; i < n_colors; ++i) {
      const double t = (i + 0.5) / n_colors;
      char style[48];
      std::snprintf(style, sizeof style, "stroke=\"#%02x%02x%02x\" stroke-width=\"1.3\"", int(220 * t),
                    int(110 * (1 - std::abs(2 * t - 1))), int(220 * (1 - t)));
      add_path(style, paths[std::size_t(i)]);
    }
  }

  void draw_edges(const std::vector<std::array<int, 2>>& edges, const std::string& style)
  {
    std::string path;
    for (const auto& [u, v] : edges)
      add_stroke(path, on_page(u), on_page(v));
    add_path(style, path);
  }

  const Surface_drawing& m_drawing;
  Picture_view m_view;
  Depth_image m_depth;
  std::vector<std::array<Eigen::Vector3d, 3>> m_corners; ///< on the page
  std::vector<Eigen::Vector3d> m_normals;                ///< in the axes of the view
  std::vector<std::size_t> m_in_view;                    ///< triangles that are not turned away
  std::string m_text;
};

} // namespace

std::string surface_picture(const Surface_drawing& drawing) { return Surface_picture(drawing).draw(); }

} // namespace Quadrille
