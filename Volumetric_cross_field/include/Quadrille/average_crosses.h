// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_AVERAGE_CROSSES_H
#define QUADRILLE_AVERAGE_CROSSES_H

#include <Quadrille/align_with_boundary.h>
#include <Quadrille/volumetric_cross_field.h>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace Quadrille {

struct Averaging_options {
  double residual = 1e-5; ///< ends when a sweep changes the crosses by this share of what the first one did (RMS)
  std::size_t max_sweeps = 1000;
  bool exact_projection = false; ///< onto the nearest cross, instead of from the eigentensors as in the paper
  int threads = 0;               ///< 0: all cores; the result does not depend on it
};

/// A field of crosses by the method of paper volume.
struct Averaged_crosses {
  std::vector<Eigen::Matrix3d> frames; ///< per vertex
  std::size_t sweeps = 0;
  double energy = 0; ///< as in `Volumetric_cross_field`
  double seconds = 0;
};

/// The reference: every vertex's tensor becomes the plain mean of its neighbours' and is projected back onto the
/// crosses, all vertices at a time, from the coordinate axes everywhere (volume, Section 4). Alignments, which the
/// paper leaves open, are kept by projecting onto the crosses that have them.
///
/// For comparisons: `volumetric_cross_field()` is faster and finds lower energies. The number of sweeps grows with the
/// number of tetrahedra across the volume squared. \pre as there.
template <class TetrahedralMesh>
Averaged_crosses average_crosses(const TetrahedralMesh& mesh, const Vertex_alignments& alignments,
                                 const Averaging_options& options = {});

} // namespace Quadrille

#include <Quadrille/Volumetric_cross_field/internal/average_crosses_impl.h>

#endif
