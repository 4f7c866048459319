// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_EXACT_ELIMINATION_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_EXACT_ELIMINATION_H

#include <Quadrille/Seamless_parametrization/internal/Union_find.h>
#include <Quadrille/exceptions.h>

#include <boost/rational.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

using Rational = boost::rational<std::int64_t>;

/// A homogeneous linear form: variable -> coefficient, without zero coefficients.
using Linear_form = std::map<int, Rational>;

inline void add_multiple(Linear_form& form, const Linear_form& other, const Rational& factor)
{
  for (const auto& [variable, coefficient] : other) {
    const auto place = form.emplace(variable, 0).first;
    place->second += factor * coefficient;
    if (place->second == 0)
      form.erase(place);
  }
}

/// Solves a sparse homogeneous system exactly: every variable becomes a form in the free variables.
///
/// Equations between two variables (x = y, x = -y) are the many; a union-find takes them. The few others (where seams
/// end or meet) are eliminated by rational Gaussian elimination, shortest equation first; the pivot is a variable with
/// coefficient 1 or 2 that little else depends on, which keeps both fill and denominators small.
class Exact_elimination {
public:
  /// `uses[i]`: in how many coordinates of the map variable i occurs. `constant`: a variable that is never eliminated
  /// (it stands for the number 1, which makes equations inhomogeneous), -1 if there is none.
  explicit Exact_elimination(std::vector<int> uses, int constant = -1)
      : m_sets(uses.size()), m_uses(std::move(uses)), m_constant(constant)
  {
  }

  void impose_zero(const Linear_form& form)
  {
    if (form.empty())
      return;
    if (form.size() == 2 && !form.count(m_constant)) {
      const auto& [x, a] = *form.begin();
      const auto& [y, b] = *form.rbegin();
      if (boost::abs(a) == boost::abs(b) && unite(x, y, a == b ? -1 : 1))
        return;
    }
    m_equations.push_back(form);
  }

  /// Near-linear in practice: the union-find, and a sparse elimination of the seam ends only.
  /// \throws No_result_error if the equations contradict each other, which they can with a constant only.
  void solve()
  {
    rewrite_in_roots();
    while (!m_by_length.empty()) {
      const int row = m_by_length.begin()->second;
      m_by_length.erase(m_by_length.begin());
      eliminate(row);
    }
    substitute_back();
  }

  /// The variable as a form in free variables. \pre `solve()` was called.
  Linear_form expression(int variable)
  {
    const auto [root, sign] = m_sets.find(variable);
    Linear_form form;
    const auto substitution = m_substitutions.find(root);
    if (substitution == m_substitutions.end())
      form.emplace(root, sign);
    else
      add_multiple(form, substitution->second, sign);
    return form;
  }

private:
  bool unite(int x, int y, int sign)
  {
    const int root_x = m_sets.find(x).first;
    const int root_y = m_sets.find(y).first;
    if (!m_sets.unite(x, y, sign))
      return false;
    const int uses = m_uses[std::size_t(root_x)] + m_uses[std::size_t(root_y)];
    m_uses[std::size_t(m_sets.find(x).first)] = uses;
    return true;
  }

  void rewrite_in_roots()
  {
    std::vector<Linear_form> equations;
    equations.swap(m_equations);
    for (const Linear_form& equation : equations) {
      Linear_form form;
      for (const auto& [variable, coefficient] : equation) {
        const auto [root, sign] = m_sets.find(variable);
        add_multiple(form, {{root, coefficient}}, sign);
      }
      if (form.empty())
        continue;
      const int row = int(m_equations.size());
      for (const auto& term : form)
        m_rows_of[term.first].insert(row);
      m_by_length.emplace(form.size(), row);
      m_equations.push_back(std::move(form));
    }
  }

  /// Units first, then pivots 2, then the rest; among them the variable with the fewest uses.
  int choose_pivot(const Linear_form& equation) const
  {
    const auto rank = [&](const std::pair<const int, Rational>& term) {
      const Rational size = boost::abs(term.second);
      const bool small = size.denominator() == 1 && size.numerator() <= 2;
      return std::make_tuple(term.first == m_constant, !small, m_uses[std::size_t(term.first)]);
    };
    return std::min_element(equation.begin(), equation.end(),
                            [&](const auto& a, const auto& b) { return rank(a) < rank(b); })
        ->first;
  }

  void eliminate(int row)
  {
    Linear_form form = std::move(m_equations[std::size_t(row)]);
    for (const auto& term : form)
      m_rows_of[term.first].erase(row);
    const int pivot = choose_pivot(form);
    if (pivot == m_constant)
      throw No_result_error("map", "the displacements asked for contradict each other");
    const Rational factor = Rational(-1) / form[pivot];
    form.erase(pivot);
    for (auto& term : form)
      term.second *= factor;
    const std::set<int> rows = std::move(m_rows_of[pivot]);
    m_rows_of.erase(pivot);
    for (const int other : rows)
      substitute(other, pivot, form);
    m_order.push_back(pivot);
    m_substitutions.emplace(pivot, std::move(form));
  }

  void substitute(int row, int pivot, const Linear_form& form)
  {
    Linear_form& equation = m_equations[std::size_t(row)];
    m_by_length.erase({equation.size(), row});
    const Rational factor = equation[pivot];
    equation.erase(pivot);
    add_multiple(equation, form, factor);
    for (const auto& term : form) {
      if (equation.count(term.first))
        m_rows_of[term.first].insert(row);
      else
        m_rows_of[term.first].erase(row);
    }
    if (!equation.empty())
      m_by_length.emplace(equation.size(), row);
  }

  /// Later pivots may occur in earlier substitutions, never the other way round.
  void substitute_back()
  {
    for (auto pivot = m_order.rbegin(); pivot != m_order.rend(); ++pivot) {
      Linear_form& form = m_substitutions[*pivot];
      Linear_form result;
      for (const auto& [variable, coefficient] : form) {
        const auto later = m_substitutions.find(variable);
        add_multiple(result, later == m_substitutions.end() ? Linear_form{{variable, 1}} : later->second, coefficient);
      }
      form = std::move(result);
    }
  }

  Signed_union_find m_sets;
  std::vector<int> m_uses; ///< by root: of all variables of its set
  int m_constant;
  std::vector<Linear_form> m_equations;
  std::map<int, std::set<int>> m_rows_of; ///< by variable: the equations left that contain it
  std::set<std::pair<std::size_t, int>> m_by_length;
  std::map<int, Linear_form> m_substitutions;
  std::vector<int> m_order;
};

} // namespace internal
} // namespace Quadrille

#endif
