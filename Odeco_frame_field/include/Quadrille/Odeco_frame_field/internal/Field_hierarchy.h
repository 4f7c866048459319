// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_HIERARCHY_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_HIERARCHY_H

#include <Quadrille/Odeco_frame_field/internal/Melting_solver.h>
#include <Quadrille/Odeco_frame_field/internal/Mesh_coarsener.h>
#include <Quadrille/Odeco_frame_field/internal/local_triangle_sizes.h>

#include <algorithm>
#include <cmath>
#include <memory>
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

/// Coarser and coarser copies of a field: fields are melted on the coarsest one, where a singularity can go everywhere
/// in few steps, and then made sharper from one to the next. Fields of many triangles cost little more than their last
/// few steps that way, and end lower: melted at once, they keep singularities that a coarser one does not resolve.
///
/// `Level` is a coarser field, `Planar_level` or `Surface_level`: `Level(mesh, elements, n_faces)` is made of the next
/// finer one, and has a `mesh`, its `elements`, and `to_finer`, which interpolates.
template <class Level> class Field_hierarchy {
public:
  using Mesh = typename Level::Mesh;
  using Elements = typename Level::Elements;
  using Solver = typename Level::Solver;

  /// No levels where there are fewer than twice `schedule.coarse_triangles`. `elements` are those of `mesh`.
  /// `make_solver(level, schedule)` returns a pointer to the solver of a coarser field; what its method
  /// `smooth_field()` gives on the coarsest one is melted.
  template <class Make_solver>
  Field_hierarchy(const Mesh& mesh, const Elements& elements, const Melt_and_freeze_schedule& schedule,
                  const Make_solver& make_solver)
  {
    const double growth = double(elements.number_of_elements()) / schedule.coarse_triangles;
    if (!(growth >= 2))
      return;
    const int n_levels = std::max(1, int(std::lround(std::log(growth) / std::log(4.0))));
    const Mesh* finer = &mesh;
    const Elements* finer_elements = &elements;
    for (int i = 1; i <= n_levels; ++i) {
      const auto n_faces = std::size_t(schedule.coarse_triangles * std::pow(growth, double(n_levels - i) / n_levels));
      auto level = std::make_unique<Level>(*finer, *finer_elements, n_faces);
      if (double(level->elements.number_of_elements()) > 0.7 * double(finer_elements->number_of_elements()))
        break; // all of the rest is bound to curves
      m_solvers.push_back(
          make_solver(*level, melt_and_freeze_schedule_for(schedule, level->elements.number_of_elements())));
      m_levels.push_back(std::move(level));
      finer = &m_levels.back()->mesh;
      finer_elements = &m_levels.back()->elements;
    }
    if (!m_levels.empty())
      m_smooth = m_solvers.back()->smooth_field();
  }

  bool empty() const { return m_levels.empty(); }

  /// A melted and frozen field of the given elements, whose `solver` takes the last steps. Adds to `iterations` what
  /// the coarse levels needed.
  Eigen::VectorXd melt_and_freeze(std::uint64_t seed, const Elements& elements, Solver& solver, int& iterations) const
  {
    Solver coarsest(*m_solvers.back(), 1);
    Eigen::VectorXd x = coarsest.melt_and_freeze(m_smooth, seed);
    iterations += coarsest.iterations();
    for (std::size_t i = m_levels.size(); i-- > 0;) {
      const Elements& finer = i > 0 ? m_levels[i - 1]->elements : elements;
      x = m_levels[i]->to_finer(m_levels[i]->elements, x, finer);
      const double ratio =
          std::sqrt(double(finer.number_of_elements()) / double(m_levels[i]->elements.number_of_elements()));
      if (i == 0) {
        solver.sharpen(x, ratio);
      } else {
        Solver intermediate(*m_solvers[i - 1], 1);
        intermediate.sharpen(x, ratio);
        iterations += intermediate.iterations();
      }
    }
    return x;
  }

private:
  std::vector<std::unique_ptr<Level>> m_levels;   ///< from fine to coarse
  std::vector<std::unique_ptr<Solver>> m_solvers; ///< of the levels
  Eigen::VectorXd m_smooth;                       ///< on the coarsest
};

} // namespace internal
} // namespace Quadrille

#endif
