// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_WRITE_DOMAIN_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_WRITE_DOMAIN_IMPL_H

#include <Quadrille/Mesh_io/internal/files.h>
#include <Quadrille/Mesh_io/internal/format_numbers.h>
#include <Quadrille/Mesh_io/internal/write_vtu_impl.h>
#include <Quadrille/exceptions.h>
#include <Quadrille/write_file.h>
#include <Quadrille/write_mesh.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

template <class Domain> std::vector<std::array<double, 3>> points_of(const Domain& domain)
{
  std::vector<std::array<double, 3>> points;
  for (const auto v : domain.mesh.vertices()) {
    const auto& p = domain.mesh.point(v);
    if constexpr (Domain::dimension == 2)
      points.push_back({p.x(), p.y(), domain.z});
    else
      points.push_back({p.x(), p.y(), p.z()});
  }
  return points;
}

/// The cells of a field's file, with what they say of themselves.
struct Field_cells {
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> lines;
  std::vector<std::array<int, 1>> singular_vertices;
  std::vector<int> entity;

  template <class Domain> Field_cells(const Domain& domain, const std::vector<int>& valence)
  {
    const auto& mesh = domain.mesh;
    for (const auto f : mesh.faces()) {
      const auto h = mesh.halfedge(f);
      triangles.push_back({int(mesh.source(h).idx()), int(mesh.target(h).idx()), int(mesh.target(mesh.next(h)).idx())});
      entity.push_back(domain.regions[std::size_t(domain.face_region[std::size_t(f.idx())])].tag);
    }
    for (const auto e : mesh.edges())
      if (const int c = domain.edge_curve[std::size_t(e.idx())]; c >= 0) {
        lines.push_back({int(mesh.vertex(e, 0).idx()), int(mesh.vertex(e, 1).idx())});
        entity.push_back(domain.curves[std::size_t(c)].tag);
      }
    for (std::size_t v = 0; v < valence.size(); ++v)
      if (valence[v] != 4)
        singular_vertices.push_back({int(v)});
    entity.resize(size(), 0);
  }

  std::size_t size() const { return triangles.size() + lines.size() + singular_vertices.size(); }

  Vtu_cells vtu() const
  {
    Vtu_cells cells;
    cells.add(triangles, vtk_triangle);
    cells.add(lines, vtk_line);
    cells.add(singular_vertices, vtk_vertex);
    return cells;
  }

  std::vector<int> dimensions() const
  {
    std::vector<int> result(triangles.size(), 2);
    result.resize(triangles.size() + lines.size(), 1);
    result.resize(size(), 0);
    return result;
  }
};

/// Vectors as VTK has them, with three components; zero for all other cells.
template <std::size_t n>
void add_vectors(const std::string& name, const std::vector<std::array<double, n>>& vectors, std::size_t n_cells,
                 std::vector<Vtu_array>& arrays)
{
  std::vector<double> values(3 * n_cells, 0), lengths(n_cells, 0);
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    for (std::size_t k = 0; k < n; ++k)
      values[3 * i + k] = vectors[i][k];
    lengths[i] = std::hypot(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  }
  arrays.push_back({name, 3, std::move(values)});
  arrays.push_back({"size_" + name, 1, std::move(lengths)});
}

} // namespace internal

template <class Domain>
void write_frame_field(const std::string& path, const Domain& domain,
                       const std::vector<std::array<double, Domain::dimension>>& u,
                       const std::vector<std::array<double, Domain::dimension>>& v, const std::vector<int>& valence)
{
  if (u.size() != domain.mesh.number_of_faces() || v.size() != u.size() ||
      valence.size() != domain.mesh.number_of_vertices())
    throw Invalid_argument_error(path + ": a field has two vectors for each triangle and a valence for each vertex");
  const internal::Field_cells cells(domain, valence);
  std::vector<int> is_singular;
  for (const int n : valence)
    is_singular.push_back(n != 4);
  Vtu_data data;
  data.at_points = {{"valence", 1, valence}, {"singular", 1, std::move(is_singular)}};
  internal::add_vectors("u", u, cells.size(), data.at_cells);
  internal::add_vectors("v", v, cells.size(), data.at_cells);
  data.at_cells.push_back({"dimension", 1, cells.dimensions()});
  data.at_cells.push_back({"entity", 1, cells.entity});
  internal::write_vtu_file(path, internal::points_of(domain), cells.vtu(), data);
}

template <class Domain>
void write_corner_map(const std::string& path, const Domain& domain,
                      const std::vector<Planar_domain::Point_2>& corner_uv)
{
  internal::check_extension(path, ".obj");
  std::string text;
  for (const std::array<double, 3>& p : internal::points_of(domain))
    internal::append_line(text, "v", p[0], p[1], p[2]);
  std::string faces;
  std::size_t n = 0;
  for (const auto f : domain.mesh.faces()) {
    faces += "f ";
    for (const auto h : domain.mesh.halfedges_around_face(domain.mesh.halfedge(f))) {
      const Planar_domain::Point_2& uv = corner_uv[std::size_t(h.idx())];
      internal::append_line(text, "vt", uv.x(), uv.y());
      internal::append_number(faces, std::size_t(domain.mesh.target(h).idx()) + 1);
      faces += '/';
      internal::append_number(faces, ++n);
      faces += ' ';
    }
    faces.back() = '\n';
  }
  write_file(path, text + faces);
}

} // namespace Quadrille

#endif
