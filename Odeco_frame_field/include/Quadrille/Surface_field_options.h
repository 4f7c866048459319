// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SURFACE_FIELD_OPTIONS_H
#define QUADRILLE_SURFACE_FIELD_OPTIONS_H

#include <Quadrille/Odeco_field_options.h>
#include <Quadrille/Symmetric_tensor_3.h>

#include <cstdint>
#include <vector>

namespace Quadrille {

/// How much the terms of surface, eq. (55) weigh beside the curl energy, by the paper's numbers.
struct Surface_field_weights {
  double odeco =
      1;           ///< eq. (52); only with `Surface_field_options::terms_as_in_paper`, the schedule's epsilon otherwise
  double area = 0; ///< eq. (53): elements have the wanted areas
  double angle = 0; ///< eq. (54): elements are square

  /// Nothing but the prescribed sizes.
  static Surface_field_weights sizing() { return {1, 0, 0}; }
  /// Minimises the distortion of areas; `smooth`: on surfaces without features, where frames could collapse otherwise.
  static Surface_field_weights area_preserving(bool smooth = false) { return {10, 0.1, smooth ? 1e-4 : 0}; }
  /// Minimises the distortion of angles.
  static Surface_field_weights angle_preserving() { return {1, 0, 0.01}; }
};

struct Surface_field_options {
  bool isotropic = false; ///< frames with two equal sizes, exactly; `Surface_field_weights::angle` only favours them
  bool integrable = true; ///< otherwise only the smooth field is computed, for comparisons
  Surface_field_weights weights;
  /// The paper's own energies instead of ours: c(T / |T|) for the odeco term, normals with the eigenvalue 1, and terms
  /// whose sums grow with the number of triangles (4.2.4). Ours divide by areas of frames and take means: fields do not
  /// depend on the unit of sizes then, nor (by more than discretisation) on the triangles, and frames cannot lower the
  /// odeco term by shrinking. A weight means the same in both on 30,000 equal triangles.
  bool terms_as_in_paper = false;
  /// `lbfgs`: the paper's own way, L-BFGS (ALGLIB) from the smooth field, for comparisons.
  Field_solver_kind solver = Field_solver_kind::levenberg_marquardt;
  int starts = 4;         ///< number of melted candidates; 0 only relaxes the smooth field
  std::uint64_t seed = 1; ///< of the noise; equal seeds give equal fields
  int threads = 0;        ///< 0: all cores
  /// Added to the cost of every start: this times its `size_deviation`.
  double size_deviation_weight = 0.01;
  /// Element sizes wanted inside, per vertex in the order of `vertices(mesh)`, in the unit of coordinates; 0 where none
  /// is wanted; empty: nowhere. Sizes on constrained edges take precedence.
  std::vector<double> target_size;
  double target_size_weight = 10; ///< of half the mean of log(size / target)^2 where there is a target
  /// The size that elements have on average where nothing says otherwise; 0: about 1,000 of them cover the surface.
  double typical_size = 0;
  Melt_and_freeze_schedule schedule;
  const Progress_observer* observer = nullptr;
};

/// The energies of surface, eq. (55), as far as they are in use.
struct Surface_energy_terms {
  double curl = 0;   ///< eqs. (45), (46)
  double odeco = 0;  ///< eq. (52), times its weight
  double sizes = 0;  ///< eq. (53) and attractions to target sizes, times their weights
  double angles = 0; ///< eq. (54), times its weight
};

/// The chosen field, and how it came about.
struct Surface_field_result {
  /// Per face, in the order of `faces(mesh)`: the tensor at its centroid, whose eigenvalues are lengths of gradients.
  std::vector<Spherical_harmonics> harmonics;
  std::vector<Field_start> starts; ///< smooth, relaxed, melted ones by seed
  int chosen = -1;                 ///< index into `starts`
  double energy = 0;               ///< of the chosen field
  Surface_energy_terms terms;      ///< its parts
  double typical_size = 0;         ///< `Surface_field_options::typical_size`, or what was chosen
  int free_corners = 0;            ///< corners of patches whose direction is left free
  int iterations = 0;              ///< over all starts
  double seconds = 0;
};

} // namespace Quadrille

#endif
