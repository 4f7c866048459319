// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_VECTOR_LENGTH_H
#define QUADRILLE_MESH_IO_INTERNAL_VECTOR_LENGTH_H

#include <CGAL/Bbox_2.h>
#include <CGAL/Bbox_3.h>
#include <CGAL/Vector_2.h>
#include <CGAL/Vector_3.h>

#include <cmath>

namespace Quadrille {
namespace internal {

/// Lengths that neither overflow nor underflow.
template <class Kernel> double length_of(const CGAL::Vector_2<Kernel>& v) { return std::hypot(v.x(), v.y()); }
template <class Kernel> double length_of(const CGAL::Vector_3<Kernel>& v) { return std::hypot(v.x(), v.y(), v.z()); }

inline double diagonal_of(const CGAL::Bbox_2& box)
{
  return std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin());
}
inline double diagonal_of(const CGAL::Bbox_3& box)
{
  return std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
}

} // namespace internal
} // namespace Quadrille

#endif
