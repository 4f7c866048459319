// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// A cross field under a metric that is pulled back from a bent bar: in the metric the bar is straight, so the field has
// no singularity and its axes follow the bend.

#include <Quadrille/Metric_connection.h>
#include <Quadrille/Metric_field.h>
#include <Quadrille/Singular_graph.h>
#include <Quadrille/align_with_boundary.h>
#include <Quadrille/fill_with_tetrahedra.h>
#include <Quadrille/volumetric_cross_field.h>

#include <Eigen/Dense>

#include <cmath>
#include <iostream>

int main()
{
  using namespace Quadrille;

  Filling_options filling;
  filling.tetrahedron_size = 0.15;
  const Tetrahedral_mesh mesh = load_tetrahedral_mesh(QUADRILLE_EXAMPLE_DATA "/bent_bar.geo", filling);

  // (x, y, z) -> (angle, log of the radius, z) takes a quarter of a ring to a box.
  const Metric_field metric = Metric_field::pulled_back(mesh, [](const Eigen::Vector3d& p) {
    const double r2 = p.x() * p.x() + p.y() * p.y();
    Eigen::Matrix3d J;
    J << -p.y() / r2, p.x() / r2, 0, p.x() / r2, p.y() / r2, 0, 0, 0, 1;
    return J;
  });
  const Metric_connection connection(mesh, metric);
  const Vertex_alignments alignments = align_with_boundary(mesh, {}, mesh.feature_edges, &metric);
  const Volumetric_cross_field field = volumetric_cross_field(mesh, alignments, metric, connection);
  const Singular_graph graph = singular_graph(mesh, field.frames, metric, connection);

  // Frames are in the orthonormal coordinates of the metric; in space their axes are the columns of A^-1 R.
  double worst = 1;
  for (std::size_t v = 0; v < mesh.number_of_vertices(); ++v) {
    const Eigen::Matrix3d frame = (metric[v].inverse() * field.frames[v]).colwise().normalized();
    const Eigen::Vector3d p = mesh.point(v), radius = Eigen::Vector3d(p.x(), p.y(), 0).normalized();
    worst = std::min(worst, (frame.transpose() * radius).cwiseAbs().maxCoeff());
  }
  std::cout << "energy " << field.energy << ", " << graph.arcs.size()
            << " singular arcs; the axes follow the bend up to "
            << std::acos(std::min(worst, 1.0)) * 180 / std::acos(-1.0) << " degrees\n";
  return graph.arcs.empty() && worst > 0.99 ? 0 : 1;
}
