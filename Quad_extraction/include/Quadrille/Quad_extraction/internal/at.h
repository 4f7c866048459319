// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_AT_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_AT_H

#include <cstddef>

namespace Quadrille {
namespace internal::extraction {

/// `c[i]` for the `int` indices of meshes and layouts.
template <class Container> decltype(auto) at(Container& c, int i) { return c[std::size_t(i)]; }
template <class Container> decltype(auto) at(const Container& c, int i) { return c[std::size_t(i)]; }

template <class Container> int size_of(const Container& c) { return static_cast<int>(c.size()); }

} // namespace internal::extraction
} // namespace Quadrille

#endif
