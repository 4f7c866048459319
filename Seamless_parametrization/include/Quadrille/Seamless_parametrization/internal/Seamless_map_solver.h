// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_SEAMLESS_MAP_SOLVER_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_SEAMLESS_MAP_SOLVER_H

#include <Quadrille/Cholesky_solver.h>
#include <Quadrille/Map_displacement.h>
#include <Quadrille/Seamless_parametrization/internal/Curve_conflict_resolver.h>
#include <Quadrille/Seamless_parametrization/internal/Cut_graph.h>
#include <Quadrille/Seamless_parametrization/internal/Frame_topology.h>
#include <Quadrille/Seamless_parametrization/internal/Map_untangler.h>
#include <Quadrille/Seamless_parametrization/internal/Reduced_elements.h>
#include <Quadrille/Seamless_parametrization/internal/Seamless_constraints.h>
#include <Quadrille/Seamless_parametrization/internal/Seamless_map_data.h>
#include <Quadrille/Seamless_parametrization/internal/Tangent_geometry.h>
#include <Quadrille/Seamless_parametrization/internal/exact_map.h>
#include <Quadrille/Seamless_parametrization/internal/move_singularities.h>
#include <Quadrille/Seamless_parametrization/internal/repair_quadrants.h>
#include <Quadrille/Seamless_parametrization_options.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>
#include <Quadrille/exceptions.h>

#include <Eigen/Core>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Computes seamless maps of one surface for any number of frame fields. Constant: several threads may share one.
/// `Solver` is a model of `SparseCholeskySolver`.
template <class Solver = Cholesky_solver> class Seamless_map_solver {
public:
  /// `constrained`: by halfedge, equal on both sides of an edge; boundary edges are constrained anyway.
  /// `displacements`: that the maps have to have, in the charts of the gradients.
  /// \pre `mesh` outlives the solver. \throws Invalid_input_error if the mesh has no face.
  Seamless_map_solver(const Indexed_triangulation& mesh, Tangent_geometry geometry, std::vector<char> constrained,
                      std::vector<Map_displacement> displacements = {})
      : m_mesh(mesh), m_geometry(std::move(geometry)), m_constrained(std::move(constrained)),
        m_displacements(std::move(displacements))
  {
    if (mesh.number_of_faces() == 0)
      throw Invalid_input_error("the mesh has no triangle");
    m_constrained.resize(std::size_t(mesh.number_of_halfedges()), 0);
    for (int h = 0; h < mesh.number_of_halfedges(); ++h)
      if (mesh.is_boundary(h))
        m_constrained[std::size_t(h)] = 1;
  }

  const Tangent_geometry& geometry() const { return m_geometry; }

  /// Matchings, alignments and quadrants of the frames, repaired where `options` allow it.
  /// \throws No_result_error if a sector has no quadrant.
  Frame_topology topology(const std::vector<Gradient_pair>& gradients,
                          const Seamless_parametrization_options& options = {}) const;

  /// Complexity: near-linear but for the Cholesky factorisation, O(n^1.5).
  /// \throws No_result_error if there is no map with these frames; flipped faces do not count as that.
  Seamless_map_data operator()(const std::vector<Gradient_pair>& gradients,
                               const Seamless_parametrization_options& options = {}) const;

private:
  enum class Untangling { none, around_folds, everywhere };

  /// The map with the given topology. `stop_misturned`: see `untangle`. Untangling around folds goes on everywhere
  /// where it cannot tell. Returns whether it was not everywhere, but could be.
  bool compute(const std::vector<Gradient_pair>& gradients, const Seamless_parametrization_options& options,
               Untangling untangling, bool stop_misturned, Seamless_map_data& map) const
  {
    map.cut = Cut_graph_builder(m_mesh, m_geometry, map.topology)();
    const Seamless_space space = Seamless_constraints(m_mesh, map.topology, map.cut, m_displacements)();
    std::vector<Gradient_pair> combed;
    for (std::size_t f = 0; f < gradients.size(); ++f)
      combed.push_back(rotate_quarters(gradients[f], map.cut.face_rotation[f]));

    Reduced_elements elements(space);
    Solver solver;
    Eigen::VectorXd y = integrate(combed, elements, solver);
    map.uv = round_to_exact_map(space, y);
    map.flipped_faces = flipped_faces(map.uv);
    map.flipped_before_untangling = int(map.flipped_faces.size());
    find_flat_faces(space, map);
    map.reversed_edges = number_of_reversed(aligned_halfedges(map.topology, map.cut), map.uv);
    map.misturned_vertices.clear();
    if (map.flipped_faces.empty())
      map.misturned_vertices = misturned_vertices(m_mesh, map.topology, map.uv);
    bool can_go_on = false;
    if (untangling != Untangling::none && map.n_invalid() > map.flat_faces.size()) {
      using Untangler = Map_untangler<Solver>;
      Untangler untangler(m_mesh, m_geometry, space, combed, options, stop_misturned, map);
      const typename Untangler::Outcome outcome = untangler.untangle_around_folds(y);
      can_go_on = untangling == Untangling::around_folds && outcome == Untangler::Outcome::folded;
      if (!can_go_on && outcome != Untangler::Outcome::done) {
        // Where sizes differ much, small triangles fold because larger ones outweigh them.
        const Eigen::VectorXd even_start = integrate(combed, elements, solver, untangler.even_weights());
        untangler.untangle_everywhere(elements, solver, {even_start, y});
      }
    }
    verify(map);
    measure(combed, map);
    return can_go_on;
  }

  /// Minimises (36), with weights, over the free parameters; exact for piecewise linear coordinates. `weights`: by
  /// face, the areas unless given. What misses the unit of u by a tenth then counts the same for elements of all sizes;
  /// so that it does for elements that are not square, too, u is weighted by l/m and v by m/l, with the sizes l and m.
  Eigen::VectorXd integrate(const std::vector<Gradient_pair>& combed, Reduced_elements& elements, Solver& solver,
                            const std::vector<double>& weights = {}) const
  {
    elements.set_zero();
    Eigen::VectorXd y = Eigen::VectorXd::Zero(elements.number_of_parameters());
    for (int f = 0; f < m_mesh.number_of_faces(); ++f) {
      const double area = weights.empty() ? m_geometry.area(f) : weights[std::size_t(f)];
      const Gradient_pair& target = combed[std::size_t(f)];
      const double aspect = target.first.norm() / target.second.norm();
      const double weight[2] = {area / aspect, area * aspect};
      Corner_vector load;
      Corner_matrix stiffness = Corner_matrix::Zero();
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector2d gradient = m_geometry.hat_gradient(3 * f + i);
        load.segment<2>(2 * i) << weight[0] * gradient.dot(target.first), weight[1] * gradient.dot(target.second);
        for (int j = 0; j <= i; ++j) {
          const double product = gradient.dot(m_geometry.hat_gradient(3 * f + j));
          for (int c = 0; c < 2; ++c)
            stiffness(2 * i + c, 2 * j + c) = stiffness(2 * j + c, 2 * i + c) = weight[c] * product;
        }
      }
      load -= stiffness * elements.corners(std::size_t(f), y);
      elements.add(std::size_t(f), load, stiffness);
    }
    if (y.size() == 0)
      return y;
    solver.analyze(elements.matrix());
    if (!solver.factorize(elements.matrix()))
      throw No_result_error("map", "the integration of the frame field is singular; the triangulation has triangles "
                                   "that are degenerate in double precision");
    solver.solve(elements.gradient(), y);
    return y;
  }

  /// Faces whose corners share one coordinate in every map that satisfies the constraints.
  void find_flat_faces(const Seamless_space& space, Seamless_map_data& map) const
  {
    map.flat_faces.clear();
    const auto same = [&](int row, int other) {
      return space.constant(row) == space.constant(other) &&
             std::equal(space.begin(row), space.end(row), space.begin(other), space.end(other),
                        [](const auto& a, const auto& b) {
                          return a.parameter == b.parameter && a.coefficient == b.coefficient;
                        });
    };
    for (const int f : map.flipped_faces) {
      const int* copy = space.copy_of_corner.data() + 3 * f;
      for (int c = 0; c < 2; ++c)
        if (same(2 * copy[0] + c, 2 * copy[1] + c) && same(2 * copy[0] + c, 2 * copy[2] + c)) {
          map.flat_faces.push_back(f);
          break;
        }
    }
  }

  /// `compute()`, while singularities move to where maps have their branch points.
  void settle(const std::vector<Gradient_pair>& gradients, const Seamless_parametrization_options& options,
              Seamless_map_data& map) const
  {
    constexpr int max_moves = 16; // each leaves about three quarters of the distance
    Untangling untangling = Untangling::around_folds;
    for (int moves = 0;; ++moves) {
      const bool may_move = options.move_singularities && moves < max_moves;
      const bool can_go_on = compute(gradients, options, may_move ? untangling : Untangling::everywhere, may_move, map);
      if (!may_move || map.n_invalid() == 0)
        return;
      Singularity_mover mover(m_mesh, map.topology);
      const int n_moved = map.flipped_faces.empty() ? mover(map.misturned_vertices, turned_quadrants(m_mesh, map.uv))
                                                    : mover.hand_to_curves(map.flipped_faces, map.uv);
      if (n_moved == 0 && !can_go_on)
        return;
      untangling = n_moved == 0 ? Untangling::everywhere : Untangling::around_folds;
      map.moved_singularities += n_moved;
    }
  }

  void verify(Seamless_map_data& map) const
  {
    map.seam_residual_max = seam_residual(m_mesh, map.cut, map.uv);
    const double misaligned = alignment_residual(m_mesh, map.topology, map.cut, map.uv);
    if (map.seam_residual_max != 0.0 || misaligned != 0.0)
      throw No_result_error("map", "rounding left the seams open by " + std::to_string(map.seam_residual_max) +
                                       " and the constrained edges unaligned by " + std::to_string(misaligned));
    map.matching.assign(std::size_t(m_mesh.number_of_halfedges()), 0);
    for (std::size_t p = 0; p < map.cut.paths.size(); ++p)
      for (const int h : map.cut.paths[p].halfedges) {
        map.matching[std::size_t(h)] = map.cut.paths[p].matching;
        map.matching[std::size_t(m_mesh.opposite(h))] = -map.cut.paths[p].matching & 3;
      }
  }

  void measure(const std::vector<Gradient_pair>& combed, Seamless_map_data& map) const
  {
    double total_area = 0.0;
    map.integration_residual = 0.0;
    map.integration_error = 0.0;
    for (int f = 0; f < m_mesh.number_of_faces(); ++f) {
      Eigen::Vector2d du = -combed[std::size_t(f)].first;
      Eigen::Vector2d dv = -combed[std::size_t(f)].second;
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const Eigen::Vector2d gradient = m_geometry.hat_gradient(h);
        du += map.uv[std::size_t(h)].x() * gradient;
        dv += map.uv[std::size_t(h)].y() * gradient;
      }
      const double area = m_geometry.area(f);
      total_area += area;
      map.integration_residual += area * (du.squaredNorm() + dv.squaredNorm());
      map.integration_error += area * (du.squaredNorm() / combed[std::size_t(f)].first.squaredNorm() +
                                       dv.squaredNorm() / combed[std::size_t(f)].second.squaredNorm());
    }
    map.integration_error /= 3.0 * total_area;
  }

  const Indexed_triangulation& m_mesh;
  Tangent_geometry m_geometry;
  std::vector<char> m_constrained;
  std::vector<Map_displacement> m_displacements;
};

// Defined outside of the class, so that they can be compiled separately.

template <class Solver>
Frame_topology Seamless_map_solver<Solver>::topology(const std::vector<Gradient_pair>& gradients,
                                                     const Seamless_parametrization_options& options) const
{
  Frame_topology topology = Frame_topology_builder(m_mesh, m_geometry, m_constrained, gradients)();
  std::vector<int> missing;
  if (options.repair_corners)
    missing = Quadrant_repair(m_mesh, topology)();
  else
    for (std::size_t s = 0; s < topology.sectors.size(); ++s)
      if (topology.sectors[s].quadrants < 1)
        missing.push_back(int(s));
  if (!missing.empty()) {
    const Frame_topology::Sector& sector = topology.sectors[std::size_t(missing.front())];
    throw No_result_error("map", "the frames turn by " + std::to_string(sector.quadrants) +
                                     " quarters in a corner of vertex " + std::to_string(sector.vertex) +
                                     ", where a quadrilateral needs at least one (" + std::to_string(missing.size()) +
                                     " such corners in all)");
  }
  return topology;
}

template <class Solver>
Seamless_map_data Seamless_map_solver<Solver>::operator()(const std::vector<Gradient_pair>& gradients,
                                                          const Seamless_parametrization_options& options) const
{
  const auto start = std::chrono::steady_clock::now();
  Seamless_map_data map;
  map.topology = topology(gradients, options);
  compute(gradients, options, Untangling::none, false, map);
  const int flipped_before_untangling = map.flipped_before_untangling;
  if (options.untangle && map.n_invalid() > map.flat_faces.size()) {
    if (options.repair_corners)
      Curve_conflict_resolver<Solver>(m_mesh, m_geometry, gradients)(map.topology);
    settle(gradients, options, map);
    map.flipped_before_untangling = flipped_before_untangling;
  }
  map.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return map;
}

#ifdef QUADRILLE_SEPARATE_COMPILATION
extern template class Seamless_map_solver<Cholesky_solver>;
#endif

} // namespace internal
} // namespace Quadrille

#endif
