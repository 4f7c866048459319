// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_WRITE_TETRAHEDRAL_MESH_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_WRITE_TETRAHEDRAL_MESH_IMPL_H

#include <Quadrille/Mesh_io/internal/files.h>
#include <Quadrille/Mesh_io/internal/format_numbers.h>
#include <Quadrille/Mesh_io/internal/write_vtu_impl.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/exceptions.h>
#include <Quadrille/write_file.h>
#include <Quadrille/write_tetrahedral_mesh.h>

#include <algorithm>
#include <array>
#include <ostream>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

/// Lines of text, collected and written in large pieces.
class Line_writer {
public:
  explicit Line_writer(std::ostream& file) : m_file(file) {}
  ~Line_writer() { flush(); }
  Line_writer(const Line_writer&) = delete;
  Line_writer& operator=(const Line_writer&) = delete;

  template <class... T> void line(const T&... values)
  {
    append_line(m_text, values...);
    if (m_text.size() > 1'000'000)
      flush();
  }

private:
  void flush()
  {
    m_file.write(m_text.data(), std::streamsize(m_text.size()));
    m_text.clear();
  }

  std::ostream& m_file;
  std::string m_text;
};

inline void write_medit_text(const Tetrahedral_mesh& mesh, Line_writer& out)
{
  out.line("MeshVersionFormatted 2\nDimension 3\nVertices");
  out.line(mesh.points.size());
  for (const std::array<double, 3>& p : mesh.points)
    out.line(p[0], p[1], p[2], 0);
  if (!mesh.feature_edges.empty()) {
    out.line("Edges");
    out.line(mesh.feature_edges.size());
    for (const std::array<int, 2>& e : mesh.feature_edges)
      out.line(e[0] + 1, e[1] + 1, 1);
  }
  out.line("Tetrahedra");
  out.line(mesh.tetrahedra.size());
  for (const std::array<int, 4>& t : mesh.tetrahedra)
    out.line(t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1, 1);
  out.line("End");
}

inline void write_vtk_text(const Tetrahedral_mesh& mesh, Line_writer& out)
{
  out.line("# vtk DataFile Version 2.0\nQuadrille\nASCII\nDATASET UNSTRUCTURED_GRID");
  out.line("POINTS", mesh.points.size(), "double");
  for (const std::array<double, 3>& p : mesh.points)
    out.line(p[0], p[1], p[2]);
  const std::size_t n_lines = mesh.feature_edges.size(), n_tetrahedra = mesh.tetrahedra.size();
  out.line("CELLS", n_lines + n_tetrahedra, 3 * n_lines + 5 * n_tetrahedra);
  for (const std::array<int, 2>& e : mesh.feature_edges)
    out.line(2, e[0], e[1]);
  for (const std::array<int, 4>& t : mesh.tetrahedra)
    out.line(4, t[0], t[1], t[2], t[3]);
  out.line("CELL_TYPES", n_lines + n_tetrahedra);
  for (std::size_t c = 0; c < n_lines + n_tetrahedra; ++c)
    out.line(int(c < n_lines ? vtk_line : vtk_tetrahedron));
}

/// One volume has the tetrahedra and all nodes, one curve the feature edges.
inline void write_msh_text(const Tetrahedral_mesh& mesh, Line_writer& out)
{
  std::array<double, 3> low{}, high{};
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = v == 0 ? mesh.points[v][k] : std::min(low[k], mesh.points[v][k]);
      high[k] = v == 0 ? mesh.points[v][k] : std::max(high[k], mesh.points[v][k]);
    }
  const std::size_t n_points = mesh.points.size(), n_lines = mesh.feature_edges.size(),
                    n_tetrahedra = mesh.tetrahedra.size(), n = n_lines + n_tetrahedra;
  const int n_curves = n_lines > 0 ? 1 : 0;
  out.line("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities");
  out.line(0, n_curves, 0, 1);
  for (int i = 0; i < n_curves + 1; ++i) // without physical groups and boundaries
    out.line(1, low[0], low[1], low[2], high[0], high[1], high[2], 0, 0);
  out.line("$EndEntities\n$Nodes");
  out.line(1, n_points, n_points > 0 ? 1 : 0, n_points);
  out.line(3, 1, 0, n_points);
  for (std::size_t v = 0; v < n_points; ++v)
    out.line(v + 1);
  for (const std::array<double, 3>& p : mesh.points)
    out.line(p[0], p[1], p[2]);
  out.line("$EndNodes\n$Elements");
  out.line(n_curves + 1, n, n > 0 ? 1 : 0, n);
  std::size_t tag = 0;
  if (n_curves > 0)
    out.line(1, 1, 1, n_lines);
  for (const std::array<int, 2>& e : mesh.feature_edges)
    out.line(++tag, e[0] + 1, e[1] + 1);
  out.line(3, 1, 4, n_tetrahedra);
  for (const std::array<int, 4>& t : mesh.tetrahedra)
    out.line(++tag, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1);
  out.line("$EndElements");
}

template <class Write> void write_lines(const std::string& path, const Write& write)
{
  write_file_by(path, [&](std::ostream& file) {
    Line_writer out(file);
    write(out);
  });
}

} // namespace internal

QUADRILLE_INLINE void write_tetrahedral_mesh(const std::string& path, const Tetrahedral_mesh& mesh)
{
  const std::string extension = internal::extension_of(path);
  if (extension == ".mesh")
    return internal::write_lines(path, [&](internal::Line_writer& out) { internal::write_medit_text(mesh, out); });
  if (extension == ".vtk")
    return internal::write_lines(path, [&](internal::Line_writer& out) { internal::write_vtk_text(mesh, out); });
  if (extension == ".msh")
    return internal::write_lines(path, [&](internal::Line_writer& out) { internal::write_msh_text(mesh, out); });
  if (extension != ".vtu")
    throw Invalid_argument_error(path + ": unknown format '" + extension +
                                 "' for tetrahedra; known are .mesh .vtk .msh .vtu");
  internal::Vtu_cells cells;
  cells.add(mesh.feature_edges, internal::vtk_line);
  cells.add(mesh.tetrahedra, internal::vtk_tetrahedron);
  internal::write_vtu_file(path, mesh.points, cells, {});
}

QUADRILLE_INLINE void write_frames(const std::string& path, const Tetrahedral_mesh& mesh,
                                   const std::vector<Eigen::Matrix3d>& frames)
{
  const std::string extension = internal::extension_of(path);
  if (extension != ".fra" && extension != ".ff3")
    throw Invalid_argument_error(path + ": unknown format '" + extension + "' for frames; known are .fra .ff3");
  if (frames.size() != mesh.tetrahedra.size())
    throw Invalid_argument_error(path + ": there are " + std::to_string(frames.size()) + " frames and " +
                                 std::to_string(mesh.tetrahedra.size()) + " tetrahedra");
  internal::write_lines(path, [&](internal::Line_writer& out) {
    if (extension == ".fra") {
      out.line("FRA 1");
      out.line(frames.size(), 3, 1);
      for (const Eigen::Matrix3d& f : frames)
        for (int j = 0; j < 3; ++j)
          out.line(f(0, j), f(1, j), f(2, j));
    } else {
      out.line(9, frames.size());
      for (const Eigen::Matrix3d& f : frames)
        out.line(f(0, 0), f(1, 0), f(2, 0), f(0, 1), f(1, 1), f(2, 1), f(0, 2), f(1, 2), f(2, 2));
    }
  });
}

} // namespace Quadrille

#endif
