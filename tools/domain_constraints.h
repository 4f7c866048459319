// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_DOMAIN_CONSTRAINTS_H
#define QUADRILLE_TOOLS_DOMAIN_CONSTRAINTS_H

#include "command_line.h"

#include <Quadrille/Frame_edge_constraints.h>
#include <Quadrille/Size_specification.h>
#include <Quadrille/domain_curves.h>
#include <Quadrille/exceptions.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace Quadrille {

/// Frames follow the curves of a domain, and have the sizes that are prescribed there. `is_weak`: of every edge whether
/// that is only weakly so, or empty.
template <class Domain>
std::vector<Edge_frame_constraint> constraints_of(const Domain& domain, const Domain_sizes& sizes,
                                                  const std::vector<char>& is_weak = {})
{
  std::vector<Edge_frame_constraint> constraints(domain.mesh.number_of_edges());
  for (std::size_t e = 0; e < constraints.size(); ++e) {
    const bool weak = !is_weak.empty() && is_weak[e];
    const bool is_on_curve = weak || domain.edge_curve[e] >= 0;
    const bool has_size = !sizes.of_edge[e][0].is_free() || !sizes.of_edge[e][1].is_free();
    constraints[e] = {is_on_curve || has_size, is_on_curve, sizes.of_edge[e][0], sizes.of_edge[e][1], weak};
  }
  return constraints;
}

/// Multiplies all prescribed sizes.
inline void scale_sizes(Domain_sizes& sizes, double factor)
{
  for (std::array<Frame_size, 2>& ends : sizes.of_edge)
    for (Frame_size& size : ends)
      size = {factor * size.normal, factor * size.tangential};
}

/// For the option --quads: the factor of sizes that ask for `estimate` quads.
inline double factor_for_number(std::size_t wanted, double estimate, std::vector<std::string>& notes)
{
  if (wanted == 0 || !(estimate > 0))
    return 1;
  const double factor = std::sqrt(estimate / double(wanted));
  std::ostringstream note;
  note.precision(3);
  note << "sizes are multiplied by about " << factor << ", for " << wanted << " quads";
  notes.push_back(note.str());
  return factor;
}

/// What the option --size asks for. \throws Invalid_argument_error
inline Size_specification size_specification_of(const Quad_arguments& arguments)
{
  Size_specification specification;
  for (const std::string& size : arguments.sizes)
    specification.add(size);
  return specification;
}

/// The curves that an option names. \throws Invalid_argument_error
template <class Domain>
std::vector<int> curves_of_option(const Domain& domain, const std::string& option,
                                  const std::vector<std::string>& names)
{
  std::set<int> curves;
  for (const std::string& name : names) {
    const std::vector<int> named = curves_named(domain, name);
    if (named.empty())
      throw Invalid_argument_error("option " + option + ": there is no curve named '" + name + "' in " + domain.source +
                                   " (" + list_of_curve_names(domain) + ")");
    curves.insert(named.begin(), named.end());
  }
  return {curves.begin(), curves.end()};
}

/// Takes the curves out that the option --unaligned names. \throws Invalid_argument_error
template <class Domain> void remove_unaligned_curves(Domain& domain, const std::vector<std::string>& names)
{
  remove_curves(domain, curves_of_option(domain, "--unaligned", names));
}

/// Takes the curves out that the option --weak names. \returns of every edge whether it was on one
/// \throws Invalid_argument_error
template <class Domain> std::vector<char> remove_weak_curves(Domain& domain, const std::vector<std::string>& names)
{
  std::vector<char> is_weak(domain.mesh.number_of_edges(), 0);
  const std::vector<int> curves = curves_of_option(domain, "--weak", names);
  for (const int c : curves)
    for (const auto h : domain.curves[std::size_t(c)].path)
      is_weak[std::size_t(domain.mesh.edge(h).idx())] = 1;
  remove_curves(domain, curves);
  return is_weak;
}

} // namespace Quadrille

#endif
