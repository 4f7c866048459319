// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_HIERARCHY_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_HIERARCHY_H

#include <Quadrille/Odeco_frame_field/internal/Melting_solver.h>
#include <Quadrille/Odeco_frame_field/internal/Mesh_coarsener.h>
#include <Quadrille/Odeco_frame_field/internal/local_triangle_sizes.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// A factor of so many triangles takes about a gigabyte, so beyond that starts take turns and share the threads.
constexpr std::size_t triangles_at_once = 400000;

/// A coarser copy of a mesh, whose edges grow with the triangles around their ends.
template <class Point>
Constrained_triangulation<Point> coarsen_with_local_sizes(const Constrained_triangulation<Point>& finer,
                                                          std::size_t n_faces, std::vector<int>& fine_vertex,
                                                          std::vector<int>& coarse_vertex)
{
  const std::vector<double> face_sizes = local_triangle_sizes(finer.mesh, finer.points);
  std::vector<double> sizes(finer.points.size(), 0.0);
  for (int f = 0; f < finer.mesh.number_of_faces(); ++f)
    for (const int v : finer.mesh.triangle(f))
      sizes[std::size_t(v)] = std::max(sizes[std::size_t(v)], face_sizes[std::size_t(f)]);
  Mesh_coarsener<Point> coarsener(finer, sizes);
  coarsener.coarsen(n_faces);
  return coarsener.result(fine_vertex, coarse_vertex);
}

/// Coarser and coarser copies of a field. Singularities go far in few steps there, and fields that are then made
/// sharper from one copy to the next cost little more than their last few steps, and end lower: on fine triangles
/// alone, melted ones keep singularities that coarse ones do not resolve, and relaxed ones stop in flat valleys.
///
/// `Level` is a coarser field, `Planar_level` or `Surface_level`: `Level(mesh, elements, n_faces)` is made of the next
/// finer one, and has a `mesh`, its `elements`, and `to_finer`, which interpolates. `Level::relaxes_from_coarse`:
/// levels for `relax()` are wanted.
template <class Level> class Field_hierarchy {
public:
  using Mesh = typename Level::Mesh;
  using Elements = typename Level::Elements;
  using Solver = typename Level::Solver;

  /// Fields are melted with about `schedule.coarse_triangles`, or on the given triangles where there are fewer than
  /// twice as many, and relaxed from about `schedule.relax_triangles` on. `elements` are those of `mesh`.
  /// `melts`: some will be melted. `make_solver(level, schedule)` returns a pointer to the solver of a coarser field.
  template <class Make_solver>
  Field_hierarchy(const Mesh& mesh, const Elements& elements, const Melt_and_freeze_schedule& schedule, bool melts,
                  const Make_solver& make_solver)
      : m_finest(mesh), m_finest_elements(elements), m_schedule(schedule)
  {
    add_levels(m_schedule.coarse_triangles, make_solver);
    m_melted = m_levels.size();
    if (melts && m_melted > 0)
      m_smooth = m_solvers.back()->smooth_field();
    if (Level::relaxes_from_coarse)
      add_levels(m_schedule.relax_triangles, make_solver);
  }

  bool can_melt() const { return m_melted > 0; }
  bool can_relax() const { return Level::relaxes_from_coarse && !m_levels.empty(); }

  /// A melted and frozen field of the finest elements, whose `solver` takes the last steps. Adds to `iterations` what
  /// the coarse levels needed. \pre can_melt(), and the hierarchy was made to melt fields
  Eigen::VectorXd melt_and_freeze(std::uint64_t seed, Solver& solver, int& iterations) const
  {
    Solver coarse(*m_solvers[m_melted - 1], 1);
    Eigen::VectorXd x = coarse.melt_and_freeze(m_smooth, seed);
    iterations += coarse.iterations();
    return sharpened(std::move(x), m_melted, solver, 1, iterations);
  }

  /// A field of the finest elements that comes from the smooth one of the coarsest, as above. \pre can_relax()
  Eigen::VectorXd relax(Solver& solver, int threads, int& iterations) const
  {
    Solver coarsest(*m_solvers.back(), threads);
    Eigen::VectorXd x = coarsest.smooth_field();
    coarsest.integrate(x);
    iterations += coarsest.iterations();
    return sharpened(std::move(x), m_levels.size(), solver, threads, iterations);
  }

private:
  const Mesh& mesh(std::size_t depth) const { return depth > 0 ? m_levels[depth - 1]->mesh : m_finest; }
  const Elements& elements(std::size_t depth) const
  {
    return depth > 0 ? m_levels[depth - 1]->elements : m_finest_elements;
  }

  /// About four times fewer triangles each, down to `n_triangles`; none where there are fewer than twice as many.
  template <class Make_solver> void add_levels(int n_triangles, const Make_solver& make_solver)
  {
    const double growth = double(elements(m_levels.size()).number_of_elements()) / n_triangles;
    if (!(growth >= 2))
      return;
    const int n_levels = std::max(1, int(std::lround(std::log(growth) / std::log(4.0))));
    for (int i = 1; i <= n_levels; ++i) {
      const auto n_faces = std::size_t(n_triangles * std::pow(growth, double(n_levels - i) / n_levels));
      const std::size_t depth = m_levels.size();
      auto level = std::make_unique<Level>(mesh(depth), elements(depth), n_faces);
      const std::size_t n_elements = level->elements.number_of_elements();
      if (double(n_elements) > 0.7 * double(elements(depth).number_of_elements()))
        return; // all of the rest is bound to curves
      m_solvers.push_back(make_solver(*level, melt_and_freeze_schedule_for(m_schedule, n_elements)));
      m_levels.push_back(std::move(level));
    }
  }

  /// Takes a field from the given depth to the finest elements.
  Eigen::VectorXd sharpened(Eigen::VectorXd x, std::size_t depth, Solver& finest, int threads, int& iterations) const
  {
    for (std::size_t i = depth; i-- > 0;) {
      const Elements& finer = elements(i);
      x = m_levels[i]->to_finer(m_levels[i]->elements, x, finer);
      const double ratio =
          std::sqrt(double(finer.number_of_elements()) / double(m_levels[i]->elements.number_of_elements()));
      if (i == 0) {
        finest.sharpen(x, ratio);
      } else {
        Solver intermediate(*m_solvers[i - 1], threads);
        intermediate.sharpen(x, ratio);
        iterations += intermediate.iterations();
      }
    }
    return x;
  }

  const Mesh& m_finest;
  const Elements& m_finest_elements;
  Melt_and_freeze_schedule m_schedule;
  std::vector<std::unique_ptr<Level>> m_levels;   ///< from fine to coarse
  std::vector<std::unique_ptr<Solver>> m_solvers; ///< of the levels
  std::size_t m_melted = 0;                       ///< the depth at which fields are melted
  Eigen::VectorXd m_smooth;                       ///< there
};

} // namespace internal
} // namespace Quadrille

#endif
