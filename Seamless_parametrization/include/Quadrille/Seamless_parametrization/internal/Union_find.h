// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_UNION_FIND_H
#define QUADRILLE_SEAMLESS_PARAMETRIZATION_INTERNAL_UNION_FIND_H

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Disjoint sets whose elements are +1 or -1 times their set's root: for x_i = x_j and x_i = -x_j.
class Signed_union_find {
public:
  explicit Signed_union_find(std::size_t n) : m_parent(n), m_sign(n, 1), m_size(n, 1)
  {
    std::iota(m_parent.begin(), m_parent.end(), 0);
  }

  /// The root of i and the sign s with x_i = s x_root.
  std::pair<int, int> find(int i)
  {
    int root = i;
    int sign = 1;
    while (m_parent[std::size_t(root)] != root) {
      sign *= m_sign[std::size_t(root)];
      root = m_parent[std::size_t(root)];
    }
    const int result_sign = sign;
    while (m_parent[std::size_t(i)] != root) { // path compression
      const int parent = m_parent[std::size_t(i)];
      const int own = m_sign[std::size_t(i)];
      m_parent[std::size_t(i)] = root;
      m_sign[std::size_t(i)] = sign;
      sign *= own;
      i = parent;
    }
    return {root, result_sign};
  }

  /// Imposes x_i = sign x_j. Returns false, and does nothing, if both are of one set already.
  bool unite(int i, int j, int sign)
  {
    const auto [root_i, sign_i] = find(i);
    const auto [root_j, sign_j] = find(j);
    if (root_i == root_j)
      return false;
    const bool swap = m_size[std::size_t(root_i)] > m_size[std::size_t(root_j)];
    const int child = swap ? root_j : root_i;
    const int parent = swap ? root_i : root_j;
    m_parent[std::size_t(child)] = parent;
    m_sign[std::size_t(child)] = sign * sign_i * sign_j;
    m_size[std::size_t(parent)] += m_size[std::size_t(child)];
    return true;
  }

  int size_of_set(int root) const { return m_size[std::size_t(root)]; }

private:
  std::vector<int> m_parent;
  std::vector<int> m_sign;
  std::vector<int> m_size;
};

} // namespace internal
} // namespace Quadrille

#endif
