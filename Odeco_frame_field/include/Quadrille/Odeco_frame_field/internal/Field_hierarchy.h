// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_HIERARCHY_H
#define QUADRILLE_ODECO_FRAME_FIELD_INTERNAL_FIELD_HIERARCHY_H

#include <Quadrille/Odeco_frame_field/internal/Field_prolongation.h>
#include <Quadrille/Odeco_frame_field/internal/Field_solver.h>
#include <Quadrille/Odeco_frame_field/internal/Mesh_coarsener.h>
#include <Quadrille/Odeco_frame_field/internal/local_triangle_sizes.h>

#include <cmath>
#include <memory>
#include <vector>

namespace Quadrille {
namespace internal {

/// Coarser and coarser copies of a field: fields are melted on the coarsest one, where a singularity can go everywhere
/// in few steps, and then made sharper from one to the next. Fields of many triangles cost little more than their last
/// few steps that way, and end lower: melted at once, they keep singularities that a coarser one does not resolve.
template <int N> class Field_hierarchy {
public:
  /// No levels where `mesh` has fewer than twice `schedule.coarse_triangles`. `elements` are those of `mesh`.
  Field_hierarchy(const Constrained_mesh& mesh, const Field_elements<N>& elements,
                  const Melt_and_freeze_schedule& schedule, int threads, const Progress_observer* observer,
                  double target_attraction)
  {
    const double growth = double(mesh.mesh.number_of_faces()) / schedule.coarse_triangles;
    if (!(growth >= 2))
      return;
    const int n_levels = std::max(1, int(std::lround(std::log(growth) / std::log(4.0))));
    const Constrained_mesh* finer = &mesh;
    const Field_elements<N>* finer_elements = &elements;
    for (int i = 1; i <= n_levels; ++i) {
      const auto n_faces = std::size_t(schedule.coarse_triangles * std::pow(growth, double(n_levels - i) / n_levels));
      auto level = std::make_unique<Level>(*finer, *finer_elements, n_faces);
      if (level->mesh.mesh.number_of_faces() > 0.7 * finer->mesh.number_of_faces())
        break; // all of the rest is bound to curves
      level->solver = std::make_unique<Field_solver<N>>(
          level->elements, melt_and_freeze_schedule_for(schedule, level->elements.number_of_elements()), threads,
          observer, Field_solver_kind::levenberg_marquardt, target_attraction);
      m_levels.push_back(std::move(level));
      finer = &m_levels.back()->mesh;
      finer_elements = &m_levels.back()->elements;
    }
    if (!m_levels.empty())
      m_smooth = m_levels.back()->solver->smooth_field(1);
  }

  bool empty() const { return m_levels.empty(); }

  /// A melted and frozen field of the given elements, whose `solver` takes the last steps. Adds to `iterations` what
  /// the coarse levels needed.
  Eigen::VectorXd melt_and_freeze(std::uint64_t seed, const Field_elements<N>& elements, Field_solver<N>& solver,
                                  int& iterations) const
  {
    Field_solver<N> coarsest(*m_levels.back()->solver, 1);
    Eigen::VectorXd x = coarsest.melt_and_freeze(m_smooth, seed);
    iterations += coarsest.iterations();
    for (std::size_t i = m_levels.size(); i-- > 0;) {
      const Field_elements<N>& finer = i > 0 ? m_levels[i - 1]->elements : elements;
      x = m_levels[i]->to_finer(m_levels[i]->elements, x, finer);
      const double ratio =
          std::sqrt(double(finer.number_of_elements()) / double(m_levels[i]->elements.number_of_elements()));
      if (i == 0) {
        solver.sharpen(x, ratio);
      } else {
        Field_solver<N> intermediate(*m_levels[i - 1]->solver, 1);
        intermediate.sharpen(x, ratio);
        iterations += intermediate.iterations();
      }
    }
    return x;
  }

private:
  struct Level {
    Level(const Constrained_mesh& finer, const Field_elements<N>& finer_elements, std::size_t n_faces)
        : mesh(coarsened(finer, n_faces)), elements(restricted_elements(finer_elements)),
          to_finer(mesh.mesh, mesh.points, finer.points, coarse_vertex)
    {
    }

    Constrained_mesh coarsened(const Constrained_mesh& finer, std::size_t n_faces)
    {
      const std::vector<double> face_sizes = local_triangle_sizes(finer.mesh, finer.points);
      std::vector<double> sizes(finer.points.size(), 0.0);
      for (int f = 0; f < finer.mesh.number_of_faces(); ++f)
        for (const int v : finer.mesh.triangle(f))
          sizes[std::size_t(v)] = std::max(sizes[std::size_t(v)], face_sizes[std::size_t(f)]);
      Mesh_coarsener coarsener(finer, sizes);
      coarsener.coarsen(n_faces);
      return coarsener.result(fine_vertex, coarse_vertex);
    }

    /// What holds at a vertex of the finer mesh holds at the same vertex here.
    Field_elements<N> restricted_elements(const Field_elements<N>& finer) const
    {
      std::vector<Vertex_restriction<N>> restrictions;
      std::vector<double> log_sizes;
      for (const int v : fine_vertex) {
        restrictions.push_back(finer.restriction(std::size_t(v)));
        log_sizes.push_back(finer.expected_log_size(std::size_t(v)));
      }
      return Field_elements<N>(mesh.mesh, mesh.points, local_triangle_sizes(mesh.mesh, mesh.points),
                               std::move(restrictions), std::move(log_sizes), finer.targets().at(fine_vertex));
    }

    std::vector<int> fine_vertex, coarse_vertex;
    Constrained_mesh mesh;
    Field_elements<N> elements;
    Field_prolongation to_finer;
    std::unique_ptr<Field_solver<N>> solver;
  };

  std::vector<std::unique_ptr<Level>> m_levels; ///< from fine to coarse
  Eigen::VectorXd m_smooth;                     ///< on the coarsest
};

} // namespace internal
} // namespace Quadrille

#endif
