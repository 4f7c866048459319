// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUAD_GROUND_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_QUAD_GROUND_H

#include <Quadrille/Quad_extraction/internal/Indexed_quads.h>
#include <Quadrille/Quad_extraction/internal/Surface_projection.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Planes in which quads are measured, and directions in which vertices move. In the plane there is nothing to choose.
template <int D> struct Quad_frames;

template <> struct Quad_frames<2> {
};

template <> struct Quad_frames<3> {
  using Plane = Eigen::Matrix<double, 2, 3>;
  using Tangents = Eigen::Matrix<double, 3, 2>;

  std::vector<Plane> plane;      ///< by quad: an orthonormal basis as rows, counterclockwise seen from outside
  std::vector<Tangents> tangent; ///< by vertex: an orthonormal basis
};

/// What quads lie on: it says which quads are inverted, and keeps vertices that move where they belong.
template <int D> class Quad_ground;

/// Are all four corners strictly convex and counterclockwise? Exact.
inline bool is_convex(const std::vector<Eigen::Vector2d>& points, const std::array<int, 4>& quad)
{
  for (int i = 0; i < 4; ++i) {
    const auto corner = [&](int k) -> Uv {
      const Eigen::Vector2d& p = at(points, at(quad, (i + k) % 4));
      return {p.x(), p.y()};
    };
    if (orientation_sign(corner(0), corner(1), corner(3)) <= 0)
      return false;
  }
  return true;
}

/// The plane.
template <> class Quad_ground<2> {
public:
  bool is_inverted(const Indexed_quads<2>& quads, int q) const { return !is_convex(quads.points, at(quads.quads, q)); }
  Quad_frames<2> frames(Indexed_quads<2>&) const { return {}; }
  void put_back(Indexed_quads<2>&) const {}
};

/// A triangulated surface. Quads and vertices know triangles nearby, from which they are put back onto the surface.
///
/// A quad counts as inverted if its normal, the cross product of its diagonals, points away from the surface's, or the
/// one of a corner points away from the quad's.
template <> class Quad_ground<3> {
public:
  using Point = Eigen::Vector3d;

  /// The arguments must outlive the object.
  Quad_ground(const Seamless_map& map, const std::vector<Point>& points) : m_surface(map, points) {}

  bool is_inverted(const Indexed_quads<3>& quads, int q) const
  {
    const std::array<Point, 4> p = corners(quads, q);
    return !is_convex(p, (p[2] - p[0]).cross(p[3] - p[1])) ||
           !((p[2] - p[0]).cross(p[3] - p[1]).dot(surface_normal(p, at(quads.face, q))) > 0);
  }

  /// Valid quads lie in their own planes, others in those of the surface. Notes the triangles at the quads' centres.
  Quad_frames<3> frames(Indexed_quads<3>& quads) const
  {
    Quad_frames<3> frames;
    frames.plane.reserve(quads.quads.size());
    std::vector<Point> vertex_normal(quads.points.size(), Point::Zero());
    for (int q = 0; q < size_of(quads.quads); ++q) {
      const std::array<Point, 4> p = corners(quads, q);
      at(quads.face, q) = m_surface.nearest(at(quads.face, q), center(p)).face;
      const Point outwards = surface_normal(p, at(quads.face, q));
      const Point own = (p[2] - p[0]).cross(p[3] - p[1]).normalized();
      constexpr double least_cosine = 0.5; // between them
      const Point normal = own.dot(outwards) > least_cosine && is_convex(p, own) ? own : outwards;
      const Point first = normal.unitOrthogonal();
      frames.plane.emplace_back();
      frames.plane.back() << first.transpose(), normal.cross(first).transpose();
      for (const int v : at(quads.quads, q))
        at(vertex_normal, v) += normal;
    }
    for (const Point& sum : vertex_normal) {
      const Point normal = sum.squaredNorm() > 0 ? Point(sum.normalized()) : Point(Point::UnitZ());
      const Point first = normal.unitOrthogonal();
      frames.tangent.emplace_back();
      frames.tangent.back() << first, normal.cross(first);
    }
    return frames;
  }

  /// Moves the vertices that lie on no curve to the nearest points of the surface.
  void put_back(Indexed_quads<3>& quads) const
  {
    for (int v = 0; v < size_of(quads.points); ++v) {
      Indexed_quads<3>::Vertex& vertex = at(quads.vertices, v);
      if (vertex.constrained)
        continue;
      const Surface_projection::Place place = m_surface.nearest(vertex.face, at(quads.points, v));
      vertex.face = place.face;
      at(quads.points, v) = place.point;
    }
  }

private:
  static std::array<Point, 4> corners(const Indexed_quads<3>& quads, int q)
  {
    const std::array<int, 4>& quad = at(quads.quads, q);
    return {at(quads.points, quad[0]), at(quads.points, quad[1]), at(quads.points, quad[2]), at(quads.points, quad[3])};
  }

  static Point center(const std::array<Point, 4>& p) { return (p[0] + p[1] + p[2] + p[3]) / 4; }

  static bool is_convex(const std::array<Point, 4>& p, const Point& normal)
  {
    for (std::size_t i = 0; i < 4; ++i)
      if (!((p[(i + 1) % 4] - p[i]).cross(p[(i + 3) % 4] - p[i]).dot(normal) > 0))
        return false;
    return true;
  }

  /// The mean over the quad, seen from the triangle at its centre: corners may lie on features, where there are
  /// several.
  Point surface_normal(const std::array<Point, 4>& p, int face) const
  {
    constexpr double towards_corner = 0.7;
    const Point middle = center(p);
    Point sum = m_surface.normal(face);
    for (const Point& corner : p)
      sum += m_surface.normal(m_surface.nearest(face, middle + towards_corner * (corner - middle)).face);
    return sum.squaredNorm() > 0 ? Point(sum.normalized()) : m_surface.normal(face);
  }

  Surface_projection m_surface;
};

/// By quad. Complexity: linear.
template <int D> std::vector<char> inverted_quads(const Indexed_quads<D>& quads, const Quad_ground<D>& ground)
{
  std::vector<char> result;
  for (int q = 0; q < size_of(quads.quads); ++q)
    result.push_back(ground.is_inverted(quads, q) ? 1 : 0);
  return result;
}

} // namespace internal::extraction
} // namespace Quadrille

#endif
