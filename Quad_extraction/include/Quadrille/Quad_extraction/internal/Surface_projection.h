// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_SURFACE_PROJECTION_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_SURFACE_PROJECTION_H

#include <Quadrille/Quad_extraction/internal/Seamless_map.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Nearest points on a triangulated surface, found by walking from a triangle nearby to where no neighbour is nearer.
///
/// Unlike the nearest point of the whole surface, one that is found by walking stays on its side of a thin wall and of
/// a feature curve, however far elements that are large for the shape carry the point away from it.
class Surface_projection {
public:
  using Point = Eigen::Vector3d;

  struct Place {
    int face = -1;
    Point point = Point::Zero();
  };

  /// Both arguments must outlive the object. Curves of the map are not crossed.
  Surface_projection(const Seamless_map& map, const std::vector<Point>& points) : m_map(&map), m_points(&points)
  {
    m_normal.reserve(std::size_t(map.mesh().number_of_faces()));
    for (int f = 0; f < map.mesh().number_of_faces(); ++f)
      m_normal.push_back((corner(f, 1) - corner(f, 0)).cross(corner(f, 2) - corner(f, 0)).normalized());
  }

  const Point& normal(int face) const { return at(m_normal, face); }

  /// Complexity: proportional to the number of triangles on the way.
  Place nearest(int face, const Point& target) const
  {
    Nearest best = nearest_in(face, target);
    for (bool is_better = true; is_better;) {
      is_better = false;
      const Nearest here = best;
      for_each_neighbor(here, [&](int neighbor) {
        const Nearest there = nearest_in(neighbor, target);
        if (there.squared_distance < best.squared_distance) {
          best = there;
          is_better = true;
        }
      });
    }
    return {best.face, best.point};
  }

private:
  struct Nearest {
    int face;
    std::array<double, 3> weights; ///< barycentric; those that are 0 tell the side or corner that holds the point
    Point point;
    double squared_distance;
  };

  const Point& corner(int f, std::size_t i) const { return at(*m_points, m_map->mesh().triangle(f)[i]); }

  Nearest nearest_in(int f, const Point& target) const
  {
    const Point &a = corner(f, 0), &b = corner(f, 1), &c = corner(f, 2);
    const Point n = (b - a).cross(c - a);
    const double area = n.squaredNorm();
    std::array<double, 3> weights = {(c - b).cross(target - b).dot(n) / area, (a - c).cross(target - c).dot(n) / area,
                                     (b - a).cross(target - a).dot(n) / area};
    if (*std::min_element(weights.begin(), weights.end()) < 0) {
      double least = std::numeric_limits<double>::infinity();
      const std::array<double, 3> outside = weights;
      for (std::size_t i = 0; i < 3; ++i) {
        if (outside[i] >= 0)
          continue; // the nearest point lies on a side that the target is beyond
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        const Point side = corner(f, k) - corner(f, j);
        const double t = std::clamp(side.dot(target - corner(f, j)) / side.squaredNorm(), 0.0, 1.0);
        const double distance = (corner(f, j) + t * side - target).squaredNorm();
        if (distance < least) {
          least = distance;
          weights[i] = 0;
          weights[j] = 1 - t;
          weights[k] = t;
        }
      }
    }
    const Point point = weights[0] * a + weights[1] * b + weights[2] * c;
    return {f, weights, point, (point - target).squaredNorm()};
  }

  /// The triangles that share the side or corner that holds the point, on the same side of all curves.
  template <class Function> void for_each_neighbor(const Nearest& place, Function f) const
  {
    const Indexed_triangulation& mesh = m_map->mesh();
    const int first = 3 * place.face;
    const auto n_zero = std::count(place.weights.begin(), place.weights.end(), 0.0);
    if (n_zero == 1) {
      const int opposite_corner =
          int(std::find(place.weights.begin(), place.weights.end(), 0.0) - place.weights.begin());
      const int side = Indexed_triangulation::next(first + opposite_corner);
      if (!mesh.is_boundary(side) && !m_map->is_constrained(side))
        f(Indexed_triangulation::face(mesh.opposite(side)));
    } else if (n_zero == 2) {
      const auto is_one = std::find_if(place.weights.begin(), place.weights.end(), [](double w) { return w != 0; });
      const int start = first + int(is_one - place.weights.begin());
      const auto may_cross = [&](int h) { return !mesh.is_boundary(h) && !m_map->is_constrained(h); };
      int h = start;
      while (may_cross(Indexed_triangulation::prev(h))) {
        h = mesh.next_around_source(h);
        if (h == start)
          return;
        f(Indexed_triangulation::face(h));
      }
      h = start;
      while (may_cross(h)) {
        h = mesh.previous_around_source(h);
        f(Indexed_triangulation::face(h));
      }
    }
  }

  const Seamless_map* m_map;
  const std::vector<Point>* m_points;
  std::vector<Point> m_normal;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
