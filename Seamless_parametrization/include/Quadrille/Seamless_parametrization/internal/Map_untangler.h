// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_MAP_UNTANGLER_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_MAP_UNTANGLER_H

#include <Quadrille/Seamless_parametrization/internal/Map_region.h>
#include <Quadrille/Seamless_parametrization/internal/Reduced_elements.h>
#include <Quadrille/Seamless_parametrization/internal/Seamless_constraints.h>
#include <Quadrille/Seamless_parametrization/internal/Seamless_map_data.h>
#include <Quadrille/Seamless_parametrization/internal/Tangent_geometry.h>
#include <Quadrille/Seamless_parametrization/internal/exact_map.h>
#include <Quadrille/Seamless_parametrization/internal/untangle_map.h>
#include <Quadrille/Seamless_parametrization_options.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Unfolds a seamless map: first around what is folded, while the rest stays, and then, if need be, everywhere.
/// `map` always holds the least folded map so far.
template <class Solver> class Map_untangler {
public:
  /// `combed`: by face, the wanted gradients in combed coordinates. `stop_misturned`: see `untangle`.
  Map_untangler(const Indexed_triangulation& mesh, const Tangent_geometry& geometry, const Seamless_space& space,
                const std::vector<Gradient_pair>& combed, const Seamless_parametrization_options& options,
                bool stop_misturned, Seamless_map_data& map)
      : m_mesh(mesh), m_geometry(geometry), m_space(space), m_combed(combed), m_options(options),
        m_stop_misturned(stop_misturned), m_map(map), m_aligned(aligned_halfedges(map.topology, map.cut))
  {
    double total = 0.0;
    for (std::size_t f = 0; f < combed.size(); ++f) {
      m_weights.push_back(geometry.area(int(f)) * cross(combed[f].first, combed[f].second));
      total += m_weights.back();
    }
    for (double& weight : m_weights)
      weight /= total;
  }

  /// By face: for integrating, the same in the parameter plane for all triangles that are smaller than the mean.
  std::vector<double> even_weights() const
  {
    std::vector<double> weights;
    for (std::size_t f = 0; f < m_combed.size(); ++f)
      weights.push_back(std::max(m_weights[f], 1.0 / double(m_weights.size())) /
                        cross(m_combed[f].first, m_combed[f].second));
    return weights;
  }

  enum class Outcome { done, folded, not_tried };

  /// From `y`, the parameters of the map so far: within 3, 9 and 27 rings of faces around what is folded.
  /// `folded`: not even the widest region was enough; `not_tried`: it would be much of the map.
  Outcome untangle_around_folds(const Eigen::VectorXd& y)
  {
    constexpr int branch_point_rings = 9;
    Eigen::VectorXd best = y;
    for (const int rings : {3, 9, 27}) {
      const std::vector<int> seeds = folded_faces();
      if (seeds.empty())
        return Outcome::not_tried;
      // Where a branch point belongs shows only if what is around it may move by much more than it is off; what is
      // folded reaches about as far.
      if (m_stop_misturned && is_near_branch_point(seeds) &&
          (rings < branch_point_rings || std::size_t(rings) < largest_cluster(m_mesh, seeds)))
        continue;
      const Map_region region = map_region(m_mesh, m_space, seeds, rings);
      if (4 * region.faces.size() > m_combed.size())
        return Outcome::not_tried;
      if (region.parameters.empty())
        continue;
      Reduced_elements elements(m_space, region, best);
      Solver solver;
      solver.analyze(elements.matrix());
      const Eigen::VectorXd start = best(region.parameters);
      const auto complete = [&, fixed = best](const Eigen::VectorXd& local) {
        Eigen::VectorXd all = fixed;
        all(region.parameters) = local;
        return all;
      };
      if (run(region, elements, solver, {start}, complete, best))
        return Outcome::done;
    }
    return Outcome::folded;
  }

  /// From one of `starts` after the other. `elements` and `solver`: of the whole map.
  void untangle_everywhere(Reduced_elements& elements, Solver& solver, const std::vector<Eigen::VectorXd>& starts)
  {
    Eigen::VectorXd best;
    run(
        whole_map(m_space), elements, solver, starts, [](const Eigen::VectorXd& y) { return y; }, best);
  }

private:
  /// Whether there is a singularity near that should perhaps be elsewhere.
  bool is_near_branch_point(const std::vector<int>& faces) const
  {
    const std::vector<char> is_near = faces_around(m_mesh, faces, 2);
    for (std::size_t corner = 0; corner < m_map.topology.sector_of_corner.size(); ++corner) {
      const auto& sector = m_map.topology.sectors[std::size_t(m_map.topology.sector_of_corner[corner])];
      if (is_near[corner / 3] && !sector.constrained && sector.quadrants > 4)
        return true;
    }
    return false;
  }

  /// What has to move: flipped faces that the constraints do not flatten, and those at reversed edges.
  std::vector<int> folded_faces() const
  {
    std::vector<int> faces;
    std::set_difference(m_map.flipped_faces.begin(), m_map.flipped_faces.end(), m_map.flat_faces.begin(),
                        m_map.flat_faces.end(), std::back_inserter(faces));
    for (const Aligned_halfedge& edge : m_aligned)
      if (is_reversed(edge, m_map.uv))
        faces.push_back(edge.halfedge / 3);
    return faces;
  }

  /// Minimises over the parameters of `region`; `complete` makes those of the whole map of them, and `best` is the
  /// least folded one. Returns whether there is nothing left to do.
  template <class Complete>
  bool run(const Map_region& region, Reduced_elements& elements, Solver& solver,
           const std::vector<Eigen::VectorXd>& starts, const Complete& complete, Eigen::VectorXd& best)
  {
    std::vector<double> weights = m_weights;
    for (const int f : m_map.flat_faces)
      weights[std::size_t(f)] = 0.0;
    Untangling_problem problem(m_geometry, m_combed, m_aligned, weights, region.faces, elements, m_options.threads);
    std::vector<Untangling_start> runs;
    for (const Eigen::VectorXd& start : starts) {
      runs.push_back({start, 0.1, 8});
      runs.push_back({start, 1.0, 12});
    }
    bool is_done = false;
    const auto count_invalid = [&](const Eigen::VectorXd& local) {
      Eigen::VectorXd y = complete(local);
      const std::size_t n_invalid = look_at(y, best);
      is_done = n_invalid == m_map.flat_faces.size();
      return int(n_invalid) - int(m_map.flat_faces.size());
    };
    Eigen::VectorXd y;
    m_map.untangling_rounds +=
        untangle(problem, y, runs, m_options.max_untangling_rounds, m_stop_misturned, solver, count_invalid);
    return is_done || (m_stop_misturned && !m_map.misturned_vertices.empty());
  }

  /// Takes over the map of `y` if it is less folded, or is one to stop at. Returns the number of its faults.
  std::size_t look_at(Eigen::VectorXd& y, Eigen::VectorXd& best)
  {
    std::vector<Eigen::Vector2d> uv = round_to_exact_map(m_space, y);
    std::vector<int> flipped = flipped_faces(uv), misturned;
    const int reversed = number_of_reversed(m_aligned, uv);
    if (flipped.empty() && reversed == 0)
      misturned = misturned_vertices(m_mesh, m_map.topology, uv);
    const std::size_t n_invalid = flipped.size() + std::size_t(reversed) + misturned.size();
    if ((m_stop_misturned && !misturned.empty()) || n_invalid <= m_map.n_invalid()) {
      m_map.uv = std::move(uv);
      m_map.flipped_faces = std::move(flipped);
      m_map.reversed_edges = reversed;
      m_map.misturned_vertices = std::move(misturned);
      best = std::move(y);
    }
    return n_invalid;
  }

  const Indexed_triangulation& m_mesh;
  const Tangent_geometry& m_geometry;
  const Seamless_space& m_space;
  const std::vector<Gradient_pair>& m_combed;
  const Seamless_parametrization_options& m_options;
  bool m_stop_misturned;
  Seamless_map_data& m_map;
  std::vector<Aligned_halfedge> m_aligned;
  std::vector<double> m_weights; ///< by face: its area in the parameter plane, relative to all
};

} // namespace internal
} // namespace Quadrille

#endif
