// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_FRAME_SIZE_H
#define QUADRILLE_FRAME_SIZE_H

namespace Quadrille {

/// The element size that a point of a curve asks for, across the curve and along it; 0 leaves one open.
struct Frame_size {
  double normal = 0;
  double tangential = 0;

  Frame_size() = default;
  /// The same size both ways. Implicit: a number is a size.
  Frame_size(double size) : normal(size), tangential(size) {}
  Frame_size(double normal_size, double tangential_size) : normal(normal_size), tangential(tangential_size) {}

  bool is_free() const { return !(normal > 0) && !(tangential > 0); }
};

} // namespace Quadrille

#endif
