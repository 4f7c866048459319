// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_SEAMLESS_CONSTRAINTS_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_SEAMLESS_CONSTRAINTS_H

#include <Quadrille/Map_displacement.h>
#include <Quadrille/Seamless_parametrization/internal/Cut_graph.h>
#include <Quadrille/Seamless_parametrization/internal/Exact_elimination.h>
#include <Quadrille/Seamless_parametrization/internal/Frame_topology.h>
#include <Quadrille/Support/internal/Indexed_triangulation.h>
#include <Quadrille/exceptions.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Coordinates as exact integer combinations of free parameters: x = (1 / denominator) (C y + c).
///
/// A copy of a vertex is what the cuts leave of it: as many copies as there are wedges between cut edges. Row
/// 2 copy + c gives coordinate c (0: u, 1: v) of the copy.
struct Seamless_space {
  struct Entry {
    int parameter;
    std::int64_t coefficient;
  };

  std::vector<int> copy_of_corner;
  int number_of_copies = 0;
  int number_of_parameters = 0;
  std::int64_t denominator = 1;
  std::vector<std::size_t> first_entry; ///< by row, and the end
  std::vector<Entry> entries;
  std::vector<std::int64_t> constants; ///< by row; zero but for maps with prescribed displacements

  const Entry* begin(int row) const { return entries.data() + first_entry[std::size_t(row)]; }
  const Entry* end(int row) const { return entries.data() + first_entry[std::size_t(row) + 1]; }
  double constant(int row) const { return double(constants[std::size_t(row)]) / double(denominator); }
};

/// Writes down the seam, alignment and gauge constraints over the integers, prescribed displacements included, and
/// eliminates them.
///
/// Variables: the coordinates of one copy of every vertex, and a translation for every path of the cut graph. The
/// other copies follow by turning and translating; going once around a vertex must lead back (closing relation).
class Seamless_constraints {
public:
  Seamless_constraints(const Indexed_triangulation& mesh, const Frame_topology& topology, const Cut_graph& cut,
                       const std::vector<Map_displacement>& displacements = {})
      : m_mesh(mesh), m_topology(topology), m_cut(cut), m_displacements(displacements)
  {
  }

  /// \throws No_result_error if denominators grow beyond what doubles can carry, or displacements contradict each
  /// other.
  Seamless_space operator()()
  {
    express_copies();
    Exact_elimination elimination(count_uses(), constant_variable());
    for (const auto& [v, closing] : m_closing_relations)
      for (int c = 0; c < 2; ++c) {
        Linear_form relation = scalar_form(closing, c);
        add_multiple(relation, {{2 * v + c, 1}}, -1);
        elimination.impose_zero(relation);
      }
    align(elimination);
    displace(elimination);
    fix_translations(elimination);
    elimination.solve();
    collect(elimination);
    return std::move(m_space);
  }

private:
  /// R^rotation (coordinates of `vertex`) + the sum of R^r T over the pairs (path, r).
  struct Copy {
    int vertex = -1;
    int rotation = 0;
    std::vector<std::pair<int, int>> translations;
  };

  /// The coordinates of a point beyond halfedge h, given on h's own side.
  Copy cross_cut(Copy copy, int h) const
  {
    const int path = m_cut.path_of[std::size_t(h)];
    const int k = m_cut.paths[std::size_t(path)].matching;
    const bool forward = m_cut.is_forward[std::size_t(h)] != 0;
    // Forward: R^k x + T. Back: R^-k (x - T) = R^-k x + R^(2-k) T.
    const int turn = forward ? k : 4 - k;
    copy.rotation = (copy.rotation + turn) & 3;
    for (auto& translation : copy.translations)
      translation.second = (translation.second + turn) & 3;
    const std::pair<int, int> added(path, forward ? 0 : (6 - k) & 3);
    const std::pair<int, int> negated(path, (added.second + 2) & 3);
    const auto cancelled = std::find(copy.translations.begin(), copy.translations.end(), negated);
    if (cancelled != copy.translations.end())
      copy.translations.erase(cancelled);
    else
      copy.translations.push_back(added);
    return copy;
  }

  void express_copies()
  {
    m_space.copy_of_corner.assign(std::size_t(m_mesh.number_of_halfedges()), -1);
    for (int v = 0; v < m_mesh.number_of_vertices(); ++v) {
      const int start = first_corner(v);
      if (start < 0)
        continue;
      Copy copy;
      copy.vertex = v;
      m_copies.push_back(copy);
      int h = start;
      do {
        m_space.copy_of_corner[std::size_t(h)] = int(m_copies.size()) - 1;
        const int incoming = Indexed_triangulation::prev(h);
        h = m_mesh.opposite(incoming);
        if (h < 0 || !m_cut.is_cut[std::size_t(h)])
          continue;
        copy = cross_cut(std::move(copy), incoming);
        if (h != start)
          m_copies.push_back(copy);
        else if (copy.rotation != 0 || !copy.translations.empty())
          m_closing_relations.emplace_back(v, copy);
      } while (h >= 0 && h != start);
    }
    m_space.number_of_copies = int(m_copies.size());
  }

  /// Where the walk around v starts: at the boundary or behind a cut edge if there is one.
  int first_corner(int v) const
  {
    const int start = m_mesh.outgoing(v);
    if (start < 0 || m_mesh.is_boundary(start))
      return start;
    int h = start;
    while (!m_cut.is_cut[std::size_t(h)]) {
      h = m_mesh.next_around_source(h);
      if (h == start)
        break;
    }
    return h;
  }

  /// The variable that stands for the number 1.
  int constant_variable() const { return translation_variable(int(m_cut.paths.size()), 0); }
  std::size_t number_of_variables() const { return std::size_t(constant_variable()) + 1; }

  int translation_variable(int path, int c) const { return 2 * (m_mesh.number_of_vertices() + path) + c; }

  /// Coordinate c of R^k (x, y) where x and y are the variables `first` and `first + 1`.
  static Linear_form turned(int first, int k, int c)
  {
    // R (x, y) = (-y, x)
    static constexpr int which[4][2] = {{0, 1}, {1, 0}, {0, 1}, {1, 0}};
    static constexpr int sign[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    return {{first + which[k & 3][c], sign[k & 3][c]}};
  }

  Linear_form scalar_form(const Copy& copy, int c) const
  {
    Linear_form form = turned(2 * copy.vertex, copy.rotation, c);
    for (const auto& [path, rotation] : copy.translations)
      add_multiple(form, turned(translation_variable(path, 0), rotation, c), 1);
    return form;
  }

  std::vector<int> count_uses() const
  {
    std::vector<int> uses(number_of_variables(), 0);
    for (const Copy& copy : m_copies)
      for (std::size_t c = 0; c < 2; ++c) {
        ++uses[2 * std::size_t(copy.vertex) + c];
        for (const auto& translation : copy.translations)
          ++uses[std::size_t(translation_variable(translation.first, int(c)))];
      }
    return uses;
  }

  const Copy& copy_at(int corner) const { return m_copies[std::size_t(m_space.copy_of_corner[std::size_t(corner)])]; }

  /// One coordinate is constant along every constrained edge. The other side of a feature edge follows from its seam.
  void align(Exact_elimination& elimination) const
  {
    for (int h = 0; h < m_mesh.number_of_halfedges(); ++h) {
      if (m_topology.alignment[std::size_t(h)] < 0 || m_mesh.opposite(h) > h)
        continue;
      const int constant = 1 - ((m_topology.alignment[std::size_t(h)] + m_cut.face_rotation[std::size_t(h / 3)]) & 1);
      Linear_form difference = scalar_form(copy_at(h), constant);
      add_multiple(difference, scalar_form(copy_at(Indexed_triangulation::next(h)), constant), -1);
      elimination.impose_zero(difference);
    }
  }

  /// The end of a displacement is its start, seen through the crossed edges, plus its value.
  void displace(Exact_elimination& elimination) const
  {
    for (const Map_displacement& displacement : m_displacements) {
      Copy start = copy_at(displacement.source_corner);
      for (const int h : displacement.crossed_halfedges)
        if (m_cut.is_cut[std::size_t(h)])
          start = cross_cut(std::move(start), h);
      const int rotation = m_cut.face_rotation[std::size_t(displacement.target_corner / 3)];
      for (int c = 0; c < 2; ++c) {
        // Coordinate c of the face's chart is +- coordinate `combed` of the combed one.
        const Linear_form chart = turned(0, -rotation, c);
        const int combed = chart.begin()->first;
        const std::optional<int>& value = displacement.value[std::size_t(c)];
        if (!value)
          continue;
        Linear_form difference = scalar_form(copy_at(displacement.target_corner), combed);
        add_multiple(difference, scalar_form(start, combed), -1);
        add_multiple(difference, {{constant_variable(), 1}}, -chart.begin()->second * Rational(*value));
        elimination.impose_zero(difference);
      }
    }
  }

  /// A vertex of every component becomes the origin: the start of its first displacement, if there is one, so that
  /// integer displacements lead to integer coordinates.
  void fix_translations(Exact_elimination& elimination) const
  {
    std::vector<char> done(std::size_t(m_cut.number_of_components), 0);
    for (const Map_displacement& displacement : m_displacements)
      if (char& fixed = done[std::size_t(m_cut.component[std::size_t(displacement.source_corner / 3)])]; !fixed) {
        fixed = 1;
        for (int c = 0; c < 2; ++c)
          elimination.impose_zero(scalar_form(copy_at(displacement.source_corner), c));
      }
    for (int v = 0; v < m_mesh.number_of_vertices(); ++v) {
      if (m_mesh.outgoing(v) < 0)
        continue;
      char& fixed = done[std::size_t(m_cut.component[std::size_t(m_mesh.outgoing(v) / 3)])];
      if (fixed)
        continue;
      fixed = 1;
      elimination.impose_zero({{2 * v, 1}});
      elimination.impose_zero({{2 * v + 1, 1}});
    }
  }

  void collect(Exact_elimination& elimination)
  {
    std::vector<Linear_form> rows;
    rows.reserve(2 * m_copies.size());
    std::vector<Linear_form> solved(number_of_variables());
    for (std::size_t i = 0; i < solved.size(); ++i)
      if (int(i) >= 2 * m_mesh.number_of_vertices() || m_mesh.outgoing(int(i) / 2) >= 0)
        solved[i] = elimination.expression(int(i));
    std::vector<int> parameter(solved.size(), -1);
    for (const Copy& copy : m_copies)
      for (int c = 0; c < 2; ++c) {
        Linear_form row;
        for (const auto& [variable, coefficient] : scalar_form(copy, c))
          add_multiple(row, solved[std::size_t(variable)], coefficient);
        for (const auto& [variable, coefficient] : row) {
          if (parameter[std::size_t(variable)] < 0 && variable != constant_variable())
            parameter[std::size_t(variable)] = m_space.number_of_parameters++;
          m_space.denominator = std::lcm(m_space.denominator, coefficient.denominator());
        }
        rows.push_back(std::move(row));
      }
    if (m_space.denominator > 1024)
      throw No_result_error("map", "the seams' constraints need fractions with denominator " +
                                       std::to_string(m_space.denominator));
    m_space.first_entry.push_back(0);
    for (const Linear_form& row : rows) {
      m_space.constants.push_back(0);
      for (const auto& [variable, coefficient] : row) {
        const std::int64_t integer = coefficient.numerator() * (m_space.denominator / coefficient.denominator());
        if (variable == constant_variable())
          m_space.constants.back() = integer;
        else
          m_space.entries.push_back({parameter[std::size_t(variable)], integer});
      }
      m_space.first_entry.push_back(m_space.entries.size());
    }
  }

  const Indexed_triangulation& m_mesh;
  const Frame_topology& m_topology;
  const Cut_graph& m_cut;
  const std::vector<Map_displacement>& m_displacements;
  std::vector<Copy> m_copies;
  std::vector<std::pair<int, Copy>> m_closing_relations;
  Seamless_space m_space;
};

} // namespace internal
} // namespace Quadrille

#endif
