// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_LABELLED_MESH_H
#define QUADRILLE_LABELLED_MESH_H

#include <array>
#include <string>
#include <vector>

namespace Quadrille {

/// A named set of curves or surfaces, as Gmsh has them.
struct Physical_group {
  int dimension = 0; ///< 1: of curves, 2: of surfaces
  int tag = 0;
  std::string name; ///< the decimal tag when the file gives no name
};

/// A curve or surface of the model: its tag, and the names of the physical groups that it belongs to.
struct Entity_label {
  int tag = 0;
  std::vector<std::string> names;
};

/// Polygons with labels, as mesh files hold them: the common form that readers fill and writers take.
///
/// Nothing is promised about the polygons: `check_quad_mesh()`, `make_planar_domain()` and `make_surface_domain()`
/// examine them.
struct Labelled_mesh {
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<int>> polygons; ///< indices into `points`, in the order around the polygon
  std::vector<int> polygon_region;        ///< per polygon: index into `regions`, -1 when unlabelled
  std::vector<std::array<int, 2>> lines;  ///< edges that lie on curves of the model
  std::vector<int> line_curve;            ///< per line: index into `curves`, -1 when unlabelled
  std::vector<Entity_label> curves;
  std::vector<Entity_label> regions;
  std::vector<Physical_group> groups; ///< all that the labels mention
};

} // namespace Quadrille

#endif
