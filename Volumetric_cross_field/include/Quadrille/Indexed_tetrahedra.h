// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_INDEXED_TETRAHEDRA_H
#define QUADRILLE_INDEXED_TETRAHEDRA_H

#include <CGAL/Unique_hash_map.h>
#include <CGAL/number_utils.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace Quadrille {

/// Cells of a CGAL triangulation and their vertices by numbers: a model of the concept `TetrahedralMesh`, and the way
/// back from numbers to handles.
///
/// `Triangulation` is a `CGAL::Triangulation_3` or what derives from it, weighted ones included; coordinates become
/// doubles. Cells are numbered in the order in which they are given, vertices in the order in which cells use them.
/// CGAL's cells have the orientation that the concept asks for. Points are copies: numbers and points stay as they are
/// when the triangulation changes, handles only as far as CGAL keeps them. Time and memory are linear in the number of
/// cells.
template <class Triangulation> class Indexed_tetrahedra {
public:
  using Vertex_handle = typename Triangulation::Vertex_handle;
  using Cell_handle = typename Triangulation::Cell_handle;

  /// All finite cells: the convex hull of the points. Of triangulations of lower dimension, nothing.
  explicit Indexed_tetrahedra(const Triangulation& triangulation)
      : Indexed_tetrahedra(triangulation, handles(triangulation.finite_cells_begin(), triangulation.finite_cells_end()))
  {
  }

  /// Some of its cells. \pre they are finite, and each is there once.
  Indexed_tetrahedra(const Triangulation& triangulation, std::vector<Cell_handle> cells) : m_cells(std::move(cells))
  {
    const auto point_of = triangulation.geom_traits().construct_point_3_object(); // without the weight
    CGAL::Unique_hash_map<Vertex_handle, int> number_of(-1);
    m_tetrahedra.resize(m_cells.size());
    for (std::size_t t = 0; t < m_cells.size(); ++t)
      for (int corner = 0; corner < 4; ++corner) {
        const Vertex_handle vertex = m_cells[t]->vertex(corner);
        int& number = number_of[vertex];
        if (number < 0) {
          number = int(m_points.size());
          m_vertices.push_back(vertex);
          const auto& p = point_of(triangulation.point(vertex));
          m_points.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
        }
        m_tetrahedra[t][std::size_t(corner)] = number;
      }
  }

  /// The cells in a mesh complex over such a triangulation (a model of `MeshComplex_3InTriangulation_3`, such as what
  /// `CGAL::make_mesh_3` returns), of all its subdomains.
  template <class Mesh_complex> static Indexed_tetrahedra of_complex(const Mesh_complex& complex)
  {
    return {complex.triangulation(), handles(complex.cells_in_complex_begin(), complex.cells_in_complex_end())};
  }

  std::size_t number_of_vertices() const { return m_points.size(); }
  std::size_t number_of_tetrahedra() const { return m_tetrahedra.size(); }
  const Eigen::Vector3d& point(std::size_t v) const { return m_points[v]; }
  const std::array<int, 4>& tetrahedron(std::size_t t) const { return m_tetrahedra[t]; }

  Vertex_handle vertex_handle(std::size_t v) const { return m_vertices[v]; }
  Cell_handle cell_handle(std::size_t t) const { return m_cells[t]; }

private:
  /// CGAL's iterators over cells become their handles.
  template <class Iterator> static std::vector<Cell_handle> handles(Iterator begin, Iterator end)
  {
    std::vector<Cell_handle> result;
    for (Iterator i = begin; i != end; ++i)
      result.push_back(i);
    return result;
  }

  std::vector<Eigen::Vector3d> m_points;
  std::vector<std::array<int, 4>> m_tetrahedra;
  std::vector<Vertex_handle> m_vertices;
  std::vector<Cell_handle> m_cells;
};

} // namespace Quadrille

#endif
