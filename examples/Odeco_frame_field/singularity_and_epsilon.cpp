// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// How far the tensors around a singularity stay from frames is set by epsilon: fields of a regular pentagon, whose
// sides force one singularity of valence 5, for a range of epsilons in units of the triangle size.
//
// Writes the field of each as singularity_<epsilon>.csv: position and the coefficients q0 ... q4 at every vertex.

#include <Quadrille/odeco_frame_field.h>
#include <Quadrille/read_planar_domain.h>
#include <Quadrille/write_file.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

using Mesh = Quadrille::Planar_domain::Mesh;

template <class Value> auto vector_map(std::vector<Value>& values)
{
  return boost::make_iterator_property_map(values.begin(), boost::identity_property_map());
}

/// 1 on the odeco variety, 0 for a tensor without directions.
double frame_share(const Quadrille::Circular_harmonics& q) { return std::sqrt(18.) * q.tail<2>().norm() / q[0]; }

int main()
{
  try {
    Quadrille::Planar_domain_options domain_options;
    domain_options.triangle_size = 0.25;
    const Quadrille::Planar_domain domain =
        Quadrille::read_planar_domain(QUADRILLE_EXAMPLE_DATA "/pentagon.geo", domain_options);
    const Mesh& mesh = domain.mesh;
    // Frames along the sides, of one size.
    std::vector<Quadrille::Edge_frame_constraint> constraints(mesh.number_of_edges());
    for (const Mesh::Edge_index e : mesh.edges())
      if (mesh.is_border(e))
        constraints[e] = {true, true, 1, 1};

    std::cout
        << "epsilon  radius where tensors are no frames  E_Lie  E_odeco / epsilon^2  (lengths in triangle sizes)\n";
    for (const double epsilon : {64., 32., 16., 8., 4., 2., 1.}) {
      Quadrille::Odeco_field_options options;
      options.starts = 0; // the singularity is there from the start
      options.schedule.smooth_epsilon = options.schedule.final_epsilon = epsilon;
      options.schedule.melt_epsilon = std::max(options.schedule.melt_epsilon, epsilon);
      std::vector<Quadrille::Gradient_pair> gradients(mesh.number_of_faces());
      const Quadrille::Odeco_field_result field =
          Quadrille::odeco_frame_field(mesh, mesh.points(), vector_map(constraints), vector_map(gradients), options);

      // Not near the outline, where tensors soften in the corners.
      double area = 0;
      for (const Mesh::Face_index f : mesh.faces()) {
        double share = 0;
        std::vector<Mesh::Point> corners;
        for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f))) {
          share += std::min(1., frame_share(field.harmonics[v])) / 3;
          corners.push_back(mesh.point(v));
        }
        if (CGAL::squared_distance(corners[0], Mesh::Point(0, 0)) < 25)
          area += (1 - share) * CGAL::area(corners[0], corners[1], corners[2]);
      }
      std::cout << epsilon << "  " << std::sqrt(area / std::acos(-1.)) / domain.triangle_size << "  "
                << field.energy_lie << "  " << field.energy_odeco << "\n";

      std::ostringstream csv, name;
      csv << "x,y,q0,q1,q2,q3,q4\n";
      for (const Mesh::Vertex_index v : mesh.vertices()) {
        csv << mesh.point(v).x() << "," << mesh.point(v).y();
        for (const double q : field.harmonics[v])
          csv << "," << q;
        csv << "\n";
      }
      name << "singularity_" << epsilon << ".csv";
      Quadrille::write_file(name.str(), csv.str());
    }
  } catch (const Quadrille::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
