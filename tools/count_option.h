// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_COUNT_OPTION_H
#define QUADRILLE_TOOLS_COUNT_OPTION_H

#include <Quadrille/Curve_count.h>
#include <Quadrille/Planar_domain.h>
#include <Quadrille/Surface_domain.h>

#include <string>
#include <vector>

namespace Quadrille {

/// `--count NAME=N`.
struct Count_request {
  std::string name;
  int count = 0;
};

/// \throws Invalid_argument_error if `text` is not NAME=N with a positive number N.
Count_request parse_count(const std::string& text);

/// Makes the curves of each request chains of `domain` of their own, so that they keep their ends in the quad mesh, and
/// returns how many elements these chains shall have together.
/// \tparam Domain `Planar_domain` or `Surface_domain`
/// \throws Invalid_argument_error if there is no curve of that name, or a curve is in two requests.
template <class Domain>
std::vector<Curve_count> split_off_counted_curves(const std::vector<Count_request>& requests, Domain& domain);

} // namespace Quadrille

#endif
