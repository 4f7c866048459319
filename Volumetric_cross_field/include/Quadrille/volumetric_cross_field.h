// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_VOLUMETRIC_CROSS_FIELD_H
#define QUADRILLE_VOLUMETRIC_CROSS_FIELD_H

#include <Quadrille/Metric_connection.h>
#include <Quadrille/Metric_field.h>
#include <Quadrille/Progress_observer.h>
#include <Quadrille/align_with_boundary.h>
#include <Quadrille/exceptions.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace Quadrille {

struct Cross_field_options {
  std::uint64_t seed = 0;    ///< 0: from the harmonic extension of the alignments; else from random crosses
  int threads = 0;           ///< 0: all cores; the result does not depend on it
  int max_newton_steps = 50; ///< on the mesh itself
  /// The field has settled when a step lowers the energy by less than this share and nodes of the singular graph
  /// neither appear nor vanish; or, without regard to these, by less than a hundredth of it.
  double energy_tolerance = 1e-4;
};

/// A field of crosses at the vertices of a tetrahedral mesh, and how it was found.
struct Volumetric_cross_field {
  /// Per vertex a rotation whose columns are the axes; under a metric in its orthonormal coordinates.
  std::vector<Eigen::Matrix3d> frames;
  /// The sum over edges of w |q - q'|^2 / 2 for crosses q with |q| = 1, w the cotangent weights (the discrete Dirichlet
  /// energy, in units of length): unlike the smooth one it grows with the logarithm of the resolution where there are
  /// singularities.
  double energy = 0;
  bool has_settled = false;
  std::size_t levels = 0, diffusions = 0, newton_steps = 0, conjugate_gradients = 0; ///< counts
  double seconds = 0;
};

/// The smoothest field of crosses with the given alignments: a local minimum of the discrete Dirichlet energy over all
/// fields of exact crosses.
///
/// volume, Section 4, with the boundary conditions, norms and weights that it leaves open: from coarse to fine,
/// implicit diffusion alternates with projection onto the crosses, then Newton's method on the rotations converges.
/// Time and memory are linear in the size of the mesh; no matrix is stored.
///
/// Under a metric (paper metric) crosses are compared by parallel transport: the energy is the sum of
/// w |D q - q'|^2 / 2 with the weights of the metric's Laplacian. \pre `mesh` passes `check_tetrahedral_mesh()`, and
/// `alignments`, `metric` and `connection` were made for it.
/// \throws Cancelled_error
template <class TetrahedralMesh>
Volumetric_cross_field volumetric_cross_field(const TetrahedralMesh& mesh, const Vertex_alignments& alignments,
                                              const Cross_field_options& options = {},
                                              const Progress_observer& progress = {});

/// The same under a metric.
template <class TetrahedralMesh>
Volumetric_cross_field volumetric_cross_field(const TetrahedralMesh& mesh, const Vertex_alignments& alignments,
                                              const Metric_field& metric, const Metric_connection& connection,
                                              const Cross_field_options& options = {},
                                              const Progress_observer& progress = {});

} // namespace Quadrille

#include <Quadrille/Volumetric_cross_field/internal/volumetric_cross_field_impl.h>

#endif
