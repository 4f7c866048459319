// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FIELD_OPTIONS_H
#define QUADRILLE_ODECO_FIELD_OPTIONS_H

#include <Quadrille/Progress_observer.h>
#include <Quadrille/Symmetric_tensor_2.h>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace Quadrille {

/// The minimiser of the field's energies.
enum class Field_solver_kind {
  levenberg_marquardt, ///< with melting and freezing
  lbfgs,               ///< planar-2's own: L-BFGS (ALGLIB), first on E_smooth, then on E_integ; for comparisons
  lbfgs_kappa          ///< planar-1's own: L-BFGS (ALGLIB) on E_kappa, kappa from 1 to 0; for comparisons
};

/// How melting and freezing places singularities. Epsilons are in units of the local triangle size.
struct Melt_and_freeze_schedule {
  double smooth_epsilon = 2; ///< of the smooth start
  /// Triangulations with at least twice as many are coarsened to about so many triangles, and melted and frozen there.
  int coarse_triangles = 5000;
  /// On surfaces the relaxed field comes from the smooth one of a triangulation coarsened to about so many.
  int relax_triangles = 500;
  /// Large: singularities are cheap and move. Times sqrt(n / 2500) for n > 2500 triangles, and 2 for even seeds. On
  /// surfaces 40.
  double melt_epsilon = 20;
  double size_attraction = 1; ///< weight of the mean squared log(size / expected), while melted
  /// On surfaces, weight of the Dirichlet energy, while melted: singularities of opposite index attract each other
  /// then.
  double smooth_attraction = 0.1;
  /// Anisotropic fields in the plane, always: weight of half the integral of |grad log(sqrt(size_u size_v) /
  /// expected)|^2. Without it sizes may jump next to curves, since integrability does not restrict how a size changes
  /// along its own vector.
  double grading_attraction = 0.2;
  double noise = 0.9;        ///< on q0, q3, q4, relative to q0 (half on q1, q2); below about 0.5 nothing happens
  int melt_steps = 15;       ///< Levenberg-Marquardt steps that take the noise out
  int soft_iterations = 200; ///< preconditioned L-BFGS iterations at the melting epsilon
  double freeze_ratio = 1.5; ///< between consecutive epsilons
  int freeze_steps = 5;      ///< Levenberg-Marquardt steps per epsilon
  double final_epsilon = 3;  ///< small: singularities are sharp, and cannot move any more; on surfaces 12
  int sharpen_steps = 3;     ///< Levenberg-Marquardt steps per halved epsilon, from coarse triangles to finer ones
  int final_steps = 40;      ///< at most
};

/// What the options of fields in the plane and on surfaces have in common.
struct Field_run_options {
  bool integrable = true; ///< otherwise only the smooth field is computed, for comparisons
  Field_solver_kind solver = Field_solver_kind::levenberg_marquardt;
  std::uint64_t seed = 1; ///< of the noise; equal seeds give equal fields
  int threads = 0;        ///< 0: all cores
  /// Added to the cost of every start: this times its `size_deviation`. Starts that integrate about equally well are
  /// then told apart by how far sizes stray between the curves where they are prescribed.
  double size_deviation_weight = 0.01;
  Melt_and_freeze_schedule schedule;
  const Progress_observer* observer = nullptr;
};

struct Odeco_field_options : Field_run_options {
  bool isotropic = true; ///< frames with two equal sizes; otherwise sizes may differ, also where that is not asked for
  int starts = 8;        ///< number of melted candidates; 0 only relaxes the smooth field
  /// Element sizes wanted inside, per vertex in the order of `vertices(mesh)` and in the mesh's unit; 0 where none is
  /// wanted; empty: nowhere. See `sample_target_sizes()`. Sizes on constrained edges take precedence.
  std::vector<double> target_size;
  /// The same with directions: per vertex a symmetric positive definite metric M (unit: 1 / size^2) in which the edges
  /// d of elements should have length 1, d^T M d = 1; zero where none is wanted; empty: nowhere. Where both are given,
  /// the metric counts. Of isotropic frames it asks for the size det(M)^(-1/4).
  std::vector<Eigen::Matrix2d> target_metric;
  /// Weight of the mean of log(size / target)^2 over where there is a target, and in anisotropic fields of that of
  /// |M^(1/4) S M^(1/4) - I|^2, where S has the sizes as eigenvalues and the directions as eigenvectors. A larger one
  /// meets targets more closely, at the cost of integrability.
  double target_size_weight = 10;
  /// Fix the targets instead of attracting to them: sizes as isotropic frames, metrics with both sizes and directions.
  bool impose_target_size = false;
  /// A field to start from, per vertex in the order of `vertices(mesh)`, such as that of a coarser triangulation:
  /// instead of all other starts it is minimised at the final epsilon, where singularities stay where they are. Empty:
  /// there is none.
  std::vector<Circular_harmonics> initial_field;
};

/// One candidate field.
struct Field_start {
  enum class Kind {
    smooth,  ///< minimises E_smooth: the reference, never chosen when there is another
    relaxed, ///< the smooth field (on surfaces that of coarse triangles), then E_integ
    melted,  ///< melted and frozen
    initial  ///< `Odeco_field_options::initial_field`, then E_integ
  };
  Kind kind = Kind::smooth;
  std::uint64_t seed = 0;
  bool valid = false;        ///< positive sizes everywhere
  double energy = 0;         ///< E_integ at the final epsilon, and the attractions to sizes
  double energy_lie = 0;     ///< its part E_Lie; planar-2, eq. (30)
  double energy_odeco = 0;   ///< its part E_odeco / epsilon^2; planar-2, eqs. (31), (33)
  double size_deviation = 0; ///< mean over the area of log(size / expected)^2, expected: harmonic between the curves
  double cost = 0;           ///< the evaluator's (without one, the energy), and the weighted size deviation
  int iterations = 0;
  double seconds = 0;
};

/// How a field came about, in the plane or on a surface.
struct Field_run_result {
  std::vector<Field_start> starts; ///< smooth, relaxed, melted ones by seed; or the initial one alone
  int chosen = -1;                 ///< index into `starts`
  double energy = 0;               ///< E_integ of the chosen field, and the attractions to sizes
  int free_corners = 0;            ///< corners whose direction is left free
  int iterations = 0;              ///< over all starts
  double seconds = 0;              ///< without those of `Field_evaluator::choose`
};

/// The chosen field, and how it came about.
struct Odeco_field_result : Field_run_result {
  std::vector<Circular_harmonics> harmonics; ///< per vertex, in the order of `vertices(mesh)`; eigenvalues are sizes
  double energy_lie = 0;                     ///< its E_Lie; planar-2, eq. (30)
  double energy_odeco = 0;                   ///< its E_odeco / epsilon^2; planar-2, eqs. (31), (33)
};

} // namespace Quadrille

#endif
