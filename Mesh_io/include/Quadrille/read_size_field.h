// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_READ_SIZE_FIELD_H
#define QUADRILLE_READ_SIZE_FIELD_H

#include <Quadrille/Planar_domain.h>
#include <Quadrille/Surface_domain.h>
#include <Quadrille/exceptions.h>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace Quadrille {

/// What a file says of element sizes inside a domain, per vertex of its mesh and in its unit: what
/// `Odeco_field_options::target_size` and `target_metric` want. Empty: no sizes, or no metrics, in the file.
struct Size_field {
  std::vector<double> size;            ///< 0 where the file says nothing
  std::vector<Eigen::Matrix2d> metric; ///< edges d of elements should have d^T M d = 1; zero where it says nothing
};

/// Reads the element sizes that are wanted inside a domain.
///
/// * `.pos`, `.msh`: Gmsh post-processing views with one scalar per node, a size (what Gmsh takes as a background
///   field), or one tensor, a metric; interpolated at the vertices. The last view of the file counts, and its last time
///   step. Of the nine entries of a tensor those in the plane are used.
/// * `.txt`, `.csv`: a line `x y size [radius]` or `x y size size angle [radius]` per place, separated by spaces or
///   commas; `#` starts a comment. The angle is that of the first size's direction, in degrees from the x-axis. Sizes
///   are wanted within the radius (default: twice the larger size); where several places overlap, at each vertex those
///   of the nearest one. A place whose circle has no vertex in it counts for the vertex nearest to it.
///
/// Complexity: O((n + m) log m) for n vertices and m elements or places.
/// \throws Invalid_input_error naming the file, the place in it and the reason, if it cannot be read, has no such data,
/// sizes or metrics that are not positive and finite, or nothing inside the domain.
/// \throws Invalid_argument_error for other file names.
Size_field read_size_field(const std::string& path, const Planar_domain& domain, double time_limit_seconds = 120);

/// The same on a surface: views with one scalar per node, and places `x y z size [radius]`, whose radius is the
/// distance in space. \returns per vertex the size, 0 where the file says nothing
std::vector<double> read_size_field(const std::string& path, const Surface_domain& domain,
                                    double time_limit_seconds = 120);

} // namespace Quadrille

#ifndef QUADRILLE_SEPARATE_COMPILATION
#include <Quadrille/Mesh_io/internal/read_size_field.h>
#endif

#endif
