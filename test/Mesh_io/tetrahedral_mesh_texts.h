// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_MESH_IO_TETRAHEDRAL_MESH_TEXTS_H
#define QUADRILLE_TEST_MESH_IO_TETRAHEDRAL_MESH_TEXTS_H

#include <Quadrille/Tetrahedral_mesh.h>

#include <map>
#include <sstream>
#include <string>

/// A tetrahedral mesh in the formats that are read, written plainly and independently of the package.
class Tetrahedral_mesh_texts {
public:
  explicit Tetrahedral_mesh_texts(Quadrille::Tetrahedral_mesh mesh) : m_mesh(std::move(mesh)) {}

  std::string medit() const
  {
    std::string text = "MeshVersionFormatted 2\n# a comment\n\nDimension\n3\n";
    text += "Edges\n" + count(m_mesh.feature_edges) + rows(m_mesh.feature_edges, 1, " 7");
    text += "Ridges\n2\n1\n2\n";
    text += "Tetrahedra # here\n" + count(m_mesh.tetrahedra) + rows(m_mesh.tetrahedra, 1, " 0");
    text += "Vertices\n" + count(m_mesh.points) + rows(m_mesh.points, 0, " 3");
    return text + "Corners 1\n1\nEnd\n";
  }

  std::string vtk() const
  {
    std::string text = "# vtk DataFile Version 2.0\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " +
                       std::to_string(m_mesh.points.size()) + " double\n" + rows(m_mesh.points, 0) + "\nCELLS ";
    const std::size_t n_lines = m_mesh.feature_edges.size(), n = m_mesh.tetrahedra.size() + n_lines + 1;
    text += std::to_string(n) + " " + std::to_string(5 * m_mesh.tetrahedra.size() + 3 * n_lines + 4) + "\n3 0 1 2\n" +
            rows(m_mesh.feature_edges, 0, "", "2 ") + rows(m_mesh.tetrahedra, 0, "", "4 ");
    text += "\nCELL_TYPES " + std::to_string(n) + "\n5\n";
    for (std::size_t i = 1; i < n; ++i)
      text += i <= n_lines ? "3\n" : "10\n";
    return text + "CELL_DATA " + std::to_string(n) + "\n";
  }

  std::string vtk_5() const
  {
    std::ostringstream offsets;
    std::size_t offset = 0;
    for (std::size_t i = 0; i <= m_mesh.tetrahedra.size() + m_mesh.feature_edges.size(); ++i) {
      offsets << offset << (i % 9 == 8 ? '\n' : ' ');
      offset += i < m_mesh.feature_edges.size() ? 2 : 4;
    }
    const std::size_t n_lines = m_mesh.feature_edges.size(), n = m_mesh.tetrahedra.size() + n_lines;
    std::string text = "# vtk DataFile Version 5.1\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\nFIELD FieldData 1\n"
                       "TimeValue 1 1 double\n0.5\nPOINTS " +
                       std::to_string(m_mesh.points.size()) + " double\n" + rows(m_mesh.points, 0) +
                       "\nMETADATA\nINFORMATION 0\n\nCELLS " + std::to_string(n + 1) + " " +
                       std::to_string(4 * m_mesh.tetrahedra.size() + 2 * n_lines) + "\nOFFSETS vtktypeint64\n" +
                       offsets.str() + "\nCONNECTIVITY vtktypeint64\n" + rows(m_mesh.feature_edges, 0) +
                       rows(m_mesh.tetrahedra, 0) + "CELL_TYPES " + std::to_string(n) + "\n";
    for (std::size_t i = 0; i < n; ++i)
      text += i < n_lines ? "3\n" : "10\n";
    return text;
  }

  std::string vtk_binary() const
  {
    std::string text = "# vtk DataFile Version 3.0\ntitle\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS " +
                       std::to_string(m_mesh.points.size()) + " double\n";
    for (const auto& p : m_mesh.points)
      for (const double x : p)
        append_big_endian(text, x);
    const std::size_t n_lines = m_mesh.feature_edges.size(), n = m_mesh.tetrahedra.size() + n_lines;
    text += "\nCELLS " + std::to_string(n) + " " + std::to_string(5 * m_mesh.tetrahedra.size() + 3 * n_lines) + "\n";
    append_lists(text, m_mesh.feature_edges);
    append_lists(text, m_mesh.tetrahedra);
    text += "\nCELL_TYPES " + std::to_string(n) + "\n";
    for (std::size_t i = 0; i < n; ++i)
      append_big_endian(text, i < n_lines ? 3 : 10);
    return text + "\n";
  }

  std::string node(int first) const
  {
    return "# points\n" + std::to_string(m_mesh.points.size()) + "  3  1  1 # header\n\n" +
           numbered_rows(m_mesh.points, first, 0, "  0.5  1");
  }
  std::string ele(int first) const
  {
    return std::to_string(m_mesh.tetrahedra.size()) + "  4  1\n" +
           numbered_rows(m_mesh.tetrahedra, first, first, "  9") + "# made by hand\n";
  }
  /// All edges from the first vertex, unmarked, and the features.
  std::string edge(int first) const
  {
    std::vector<std::array<int, 2>> unmarked;
    for (int v = 1; v < int(m_mesh.points.size()); ++v)
      unmarked.push_back({0, v});
    return std::to_string(m_mesh.feature_edges.size() + unmarked.size()) + " 1\n" +
           numbered_rows(unmarked, first, first, " 0") + numbered_rows(m_mesh.feature_edges, first, first, " -1");
  }

  std::string ovm() const
  {
    std::map<std::array<int, 2>, int> edge_index;
    std::map<std::array<int, 3>, int> face_index;
    std::string edges, faces, cells, marks;
    for (const std::array<int, 4>& t : m_mesh.tetrahedra) {
      cells += "4";
      for (const auto& f : {std::array{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}) {
        std::array<int, 3> c = {t[std::size_t(f[0])], t[std::size_t(f[1])], t[std::size_t(f[2])]}, sorted = c;
        std::sort(sorted.begin(), sorted.end());
        const auto [face, is_new] = face_index.emplace(sorted, int(face_index.size()));
        cells += ' ' + std::to_string(2 * face->second + (is_new ? 0 : 1));
        if (!is_new)
          continue;
        faces += "3";
        for (std::size_t i = 0; i < 3; ++i) {
          const int a = c[i], b = c[(i + 1) % 3];
          const std::array<int, 2> ends = {std::max(a, b), std::min(a, b)};
          const auto [edge, is_new_edge] = edge_index.emplace(ends, int(edge_index.size()));
          if (is_new_edge)
            edges += std::to_string(ends[0]) + " " + std::to_string(ends[1]) + "\n";
          faces += ' ' + std::to_string(2 * edge->second + (ends[0] == a ? 0 : 1));
        }
        faces += '\n';
      }
      cells += '\n';
    }
    std::vector<int> mark(edge_index.size(), 0);
    for (const std::array<int, 2>& e : m_mesh.feature_edges)
      mark[std::size_t(edge_index.at({std::max(e[0], e[1]), std::min(e[0], e[1])}))] = 1;
    for (const int m : mark)
      marks += std::to_string(m) + "\n";
    return "OVM ASCII\nVertices\n" + count(m_mesh.points) + rows(m_mesh.points, 0) + "Edges\n" + count(edge_index) +
           edges + "Faces\n" + count(face_index) + faces + "Polyhedra\n" + count(m_mesh.tetrahedra) + cells +
           "CProp double \"quality\"\n" + std::string("0.5\n") + "EProp int \"AlgoHex::FeatureEdges\"\n" + marks +
           "VProp int \"other\"\n1\n";
  }

  std::string msh_2_2() const
  {
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + count(m_mesh.points) +
                       numbered_rows(m_mesh.points, 1, 0) + "$EndNodes\n$Elements\n" +
                       std::to_string(m_mesh.tetrahedra.size() + m_mesh.feature_edges.size()) + "\n";
    std::size_t n = 0;
    for (const auto& e : m_mesh.feature_edges)
      text += std::to_string(++n) + " 1 2 0 1 " + row(e, 1) + "\n";
    for (const auto& t : m_mesh.tetrahedra)
      text += std::to_string(++n) + " 4 2 0 1 " + row(t, 1) + "\n";
    return text + "$EndElements\n";
  }

private:
  template <class Container> static std::string count(const Container& c) { return std::to_string(c.size()) + "\n"; }

  template <class Row> static std::string row(const Row& values, int first)
  {
    std::ostringstream text;
    text.precision(17);
    for (std::size_t i = 0; i < values.size(); ++i)
      text << (i == 0 ? "" : " ") << values[i] + first;
    return text.str();
  }
  template <class Rows>
  static std::string rows(const Rows& all, int first, const std::string& suffix = "", const std::string& prefix = "")
  {
    std::string text;
    for (const auto& values : all)
      text += prefix + row(values, first) + suffix + "\n";
    return text;
  }
  template <class Rows>
  static std::string numbered_rows(const Rows& all, int first_row, int first, const std::string& suffix = "")
  {
    std::string text;
    for (std::size_t i = 0; i < all.size(); ++i)
      text += "  " + std::to_string(i + std::size_t(first_row)) + " " + row(all[i], first) + suffix + "\n";
    return text;
  }

  template <class Number> static void append_big_endian(std::string& text, Number value)
  {
    const char* bytes = reinterpret_cast<const char*>(&value);
    for (std::size_t i = sizeof value; i-- > 0;)
      text += bytes[i];
  }
  template <class Lists> static void append_lists(std::string& text, const Lists& lists)
  {
    for (const auto& list : lists) {
      append_big_endian(text, int(list.size()));
      for (const int v : list)
        append_big_endian(text, v);
    }
  }

  Quadrille::Tetrahedral_mesh m_mesh;
};

#endif
