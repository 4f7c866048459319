// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_UNDOABLE_UNION_FIND_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_UNDOABLE_UNION_FIND_H

#include <Quadrille/Quad_extraction/internal/at.h>

#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Disjoint sets with data per set (added up by `Data::operator+=` on union), whose latest changes can be taken back.
template <class Data> class Undoable_union_find {
public:
  explicit Undoable_union_find(std::vector<Data> data)
      : m_parent(data.size()), m_size(data.size(), 1), m_data(std::move(data))
  {
    for (int i = 0; i < size_of(m_parent); ++i)
      at(m_parent, i) = i;
  }

  /// Complexity: logarithmic (no path compression, so that unions can be undone).
  int find(int i) const
  {
    while (at(m_parent, i) != i)
      i = at(m_parent, i);
    return i;
  }

  const Data& data(int i) const { return at(m_data, find(i)); }

  /// Adds to the data of the set of `i`.
  void add(int i, const Data& more)
  {
    i = find(i);
    remember(i);
    at(m_data, i) += more;
  }

  /// Returns false if `i` and `j` are in one set already.
  bool unite(int i, int j)
  {
    i = find(i);
    j = find(j);
    if (i == j)
      return false;
    if (at(m_size, i) < at(m_size, j) || (at(m_size, i) == at(m_size, j) && j < i))
      std::swap(i, j);
    remember(i);
    remember(j);
    at(m_parent, j) = i;
    at(m_size, i) += at(m_size, j);
    at(m_data, i) += at(m_data, j);
    return true;
  }

  /// Makes the changes since the last `commit` permanent.
  void commit() { m_log.clear(); }

  /// Takes them back.
  void undo()
  {
    for (; !m_log.empty(); m_log.pop_back()) {
      const Change& change = m_log.back();
      at(m_parent, change.index) = change.parent;
      at(m_size, change.index) = change.size;
      at(m_data, change.index) = change.data;
    }
  }

private:
  struct Change {
    int index;
    int parent;
    int size;
    Data data;
  };

  void remember(int i) { m_log.push_back({i, at(m_parent, i), at(m_size, i), at(m_data, i)}); }

  std::vector<int> m_parent;
  std::vector<int> m_size;
  std::vector<Data> m_data;
  std::vector<Change> m_log;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
