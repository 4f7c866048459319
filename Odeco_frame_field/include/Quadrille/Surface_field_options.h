// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SURFACE_FIELD_OPTIONS_H
#define QUADRILLE_SURFACE_FIELD_OPTIONS_H

#include <Quadrille/Odeco_field_options.h>
#include <Quadrille/Symmetric_tensor_3.h>

#include <vector>

namespace Quadrille {

/// How much the terms of surface, eq. (55) weigh beside the curl energy, by the paper's numbers.
struct Surface_field_weights {
  /// eq. (52); only with `Surface_field_options::terms_as_in_paper`, the schedule's epsilon otherwise
  double odeco = 1;
  double area = 0;  ///< eq. (53): elements have the wanted areas
  double angle = 0; ///< eq. (54): elements are square

  /// Nothing but the prescribed sizes.
  static Surface_field_weights sizing() { return {1, 0, 0}; }
  /// Minimises the distortion of areas; `smooth`: on surfaces without features, where frames could collapse otherwise.
  static Surface_field_weights area_preserving(bool smooth = false) { return {10, 0.1, smooth ? 1e-4 : 0}; }
  /// Minimises the distortion of angles.
  static Surface_field_weights angle_preserving() { return {1, 0, 0.01}; }
  /// Some of both: elements that are nearly square and nearly of one size. Ours, not the paper's.
  static Surface_field_weights isometric() { return {1, 0.01, 0.01}; }
};

/// `solver` is Levenberg-Marquardt with melting, or `lbfgs`: the paper's own way, L-BFGS (ALGLIB) from the smooth
/// field.
struct Surface_field_options : Field_run_options {
  /// Melts more, and freezes less than in the plane: with an odeco term as strong as there, fields integrate with
  /// errors that are two to eight times larger, since singularities freeze before they are where curls vanish.
  Surface_field_options()
  {
    schedule.melt_epsilon = 40;
    schedule.final_epsilon = 12;
  }

  bool isotropic = false; ///< frames with two equal sizes, exactly; `Surface_field_weights::angle` only favours them
  int starts = 4;         ///< number of melted candidates; 0, and `terms_as_in_paper`, only relax the smooth field
  Surface_field_weights weights;
  /// The paper's own energies instead of ours: c(T / |T|) for the odeco term, normals with the eigenvalue 1, and terms
  /// whose sums grow with the number of triangles (4.2.4). Ours divide by areas of frames and take means: fields do not
  /// depend on the unit of sizes then, nor (by more than discretisation) on the triangles, and frames cannot lower the
  /// odeco term by shrinking. A weight means the same in both on 30,000 equal triangles.
  bool terms_as_in_paper = false;
  /// Element sizes wanted inside, per vertex in the order of `vertices(mesh)`, in the unit of coordinates; 0 where none
  /// is wanted; empty: nowhere. Sizes on constrained edges take precedence.
  std::vector<double> target_size;
  double target_size_weight = 10; ///< of half the mean of log(size / target)^2 where there is a target
  /// Of half the mean along weakly constrained edges of (|q - q'| / l)^2, q being the tensor's coefficients, q' the
  /// nearest ones that the constraint allows, and l the length of gradients that is expected there.
  double weak_weight = 10;
  /// The size that elements have on average where nothing says otherwise; 0: about 1,000 of them cover the surface.
  double typical_size = 0;
};

/// The energies of surface, eq. (55), as far as they are in use.
struct Surface_energy_terms {
  double curl = 0;   ///< eqs. (45), (46)
  double odeco = 0;  ///< eq. (52), times its weight
  double sizes = 0;  ///< eq. (53) and attractions to target sizes, times their weights
  double angles = 0; ///< eq. (54), times its weight
  double weak = 0;   ///< weak constraints, times their weight
};

/// The chosen field, and how it came about.
struct Surface_field_result : Field_run_result {
  /// Per face, in the order of `faces(mesh)`: the tensor at its centroid, whose eigenvalues are lengths of gradients.
  std::vector<Spherical_harmonics> harmonics;
  Surface_energy_terms terms; ///< the parts of its energy
  double typical_size = 0;    ///< `Surface_field_options::typical_size`, or what was chosen
};

} // namespace Quadrille

#endif
