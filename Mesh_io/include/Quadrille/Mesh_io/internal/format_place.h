// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_FORMAT_PLACE_H
#define QUADRILLE_MESH_IO_INTERNAL_FORMAT_PLACE_H

#include <CGAL/Dimension.h>

#include <cstdio>
#include <string>

namespace Quadrille {
namespace internal {

/// A place in the plane for messages.
inline std::string format_place(double x, double y)
{
  char text[64];
  std::snprintf(text, sizeof text, "(%.6g, %.6g)", x, y);
  return text;
}

/// A place in space for messages.
template <class Coordinates> std::string place_in_words(const Coordinates& p)
{
  char text[100];
  std::snprintf(text, sizeof text, "(%.9g, %.9g, %.9g)", double(p[0]), double(p[1]), double(p[2]));
  return text;
}

/// The same for a place with three coordinates in a domain whose points may have two.
template <class Point, class Coordinates> std::string domain_place(const Coordinates& p)
{
  if constexpr (CGAL::Ambient_dimension<Point>::value == 2)
    return format_place(double(p[0]), double(p[1]));
  else
    return place_in_words(p);
}

/// A number for messages.
inline std::string format_value(double x)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

} // namespace internal
} // namespace Quadrille

#endif
