// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SURFACE_TANGENT_TRAITS_H
#define QUADRILLE_SURFACE_TANGENT_TRAITS_H

#include <Quadrille/exceptions.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>

namespace Quadrille {

/// Tangent planes of a triangulated surface in space: the basis of a face is the direction of its first halfedge,
/// `halfedge(f, mesh)`, and that direction turned by 90 degrees counterclockwise as seen from outside. A model of
/// `TangentPlaneTraits`.
///
/// `VertexPointMap` is a readable property map from vertices to points with `x()`, `y()` and `z()`. Bases are computed
/// when asked for, at constant cost; all members throw `Invalid_input_error`, naming the corners, for a triangle that
/// is degenerate up to rounding (its height above the first edge is below 1e-14 of its longest edge) or has coordinates
/// that are not finite.
template <class TriangleMesh, class VertexPointMap> class Surface_tangent_traits {
public:
  using halfedge_descriptor = typename boost::graph_traits<TriangleMesh>::halfedge_descriptor;
  using face_descriptor = typename boost::graph_traits<TriangleMesh>::face_descriptor;

  /// \pre `mesh` outlives the traits.
  Surface_tangent_traits(const TriangleMesh& mesh, VertexPointMap points) : m_mesh(mesh), m_points(points) {}

  /// The basis of a face, by columns: B p is the vector of space with the coordinates p. The product of the columns is
  /// the normal, about which the face's halfedges run counterclockwise.
  Eigen::Matrix<double, 3, 2> basis(face_descriptor f) const
  {
    const halfedge_descriptor h = halfedge(f, m_mesh);
    const Eigen::Vector3d first = vector(h), second = vector(next(h, m_mesh)), third = vector(prev(h, m_mesh));
    const double scale = std::max({first.norm(), second.norm(), third.norm()});
    const Eigen::Vector3d x = first / first.norm();
    const Eigen::Vector3d normal = x.cross(second / scale);
    if (!(normal.norm() > 1e-14)) // nor if it is not a number
      throw Invalid_input_error("the triangle with the corners " + corners(h) +
                                " is degenerate or has a coordinate that is not a finite number; remove it or move "
                                "its corners");
    Eigen::Matrix<double, 3, 2> result;
    result << x, normal.normalized().cross(x);
    return result;
  }

  /// The coordinates of a vector of space in the basis of a face: of its part in the face's plane. So gradients that
  /// are given in space become values of a `FaceGradientMap`.
  Eigen::Vector2d coordinates(face_descriptor f, const Eigen::Vector3d& vector) const
  {
    return basis(f).transpose() * vector;
  }

  /// The vector from the source of `h` to its target.
  std::array<double, 2> edge_vector(halfedge_descriptor h) const
  {
    const Eigen::Vector2d v = coordinates(face(h, m_mesh), vector(h));
    return {v.x(), v.y()};
  }

  /// By the edge itself, whose direction is the same on both sides when they are unfolded.
  double transport_angle(halfedge_descriptor h) const
  {
    const std::array<double, 2> here = edge_vector(h), there = edge_vector(opposite(h, m_mesh));
    // The quotient of - there and here as complex numbers; that of the opposite halfedge is its conjugate, exactly.
    return std::atan2(there[0] * here[1] - there[1] * here[0], -there[0] * here[0] - there[1] * here[1]);
  }

private:
  Eigen::Vector3d point(halfedge_descriptor h) const
  {
    const auto& p = get(m_points, target(h, m_mesh));
    return {double(p.x()), double(p.y()), double(p.z())};
  }
  Eigen::Vector3d vector(halfedge_descriptor h) const { return point(h) - point(opposite(h, m_mesh)); }

  std::string corners(halfedge_descriptor h) const
  {
    std::ostringstream text;
    for (int i = 0; i < 3; ++i, h = next(h, m_mesh)) {
      const Eigen::Vector3d p = point(h);
      text << (i == 0 ? "(" : i == 1 ? ", (" : " and (") << p.x() << ", " << p.y() << ", " << p.z() << ")";
    }
    return text.str();
  }

  const TriangleMesh& m_mesh;
  VertexPointMap m_points;
};

} // namespace Quadrille

#endif
